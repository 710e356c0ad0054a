//! Certificates of Hausdorff distances: written by the library, verified by the checker.

use subcert::certificate::Claim;
use subcert::distance::certify::{Boundary, Eigen, Flat, Request, certify};
use subcert::distance::hausdorff::{Facets, Side};
use subcert::mesh::{Mesh, Point, Topology};
use subcert::scalar::{Field, Rational};
use subcert::scheme::{LoopWeights, Scheme};
use subcert::spectrum::{Rules, eigen_mesh::eigen_mesh};

fn mesh(points: &[[i64; 3]], arity: u32, faces: &[u32]) -> Mesh<Rational> {
    let point = |p: &[i64; 3]| Point(p.map(|x| Rational::ratio(x, 1)));
    Mesh {
        topology: Topology::from_uniform(points.len(), arity, faces.to_vec()).unwrap(),
        positions: points.iter().map(point).collect(),
    }
}

fn octahedron() -> Mesh<Rational> {
    let points = [
        [2, 0, 0],
        [0, 3, 0],
        [-2, 0, 0],
        [0, -3, 0],
        [0, 0, 4],
        [0, 0, -4],
    ];
    let faces = [
        0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5,
    ];
    mesh(&points, 3, &faces)
}

#[test]
fn octahedron_both_sides() {
    for side in [Side::SurfaceToMesh, Side::MeshToSurface] {
        let request = Request {
            scheme: Scheme::Loop(LoopWeights::Original),
            boundary: Boundary::Smooth,
            level: 0,
            flat: Flat::Control,
            facets: Facets::Triangles,
            side,
            gap: 0.02,
            vertices: true,
        };
        let start = std::time::Instant::now();
        let certificate = certify(&octahedron(), &request, None).unwrap();
        let mut text = Vec::new();
        certificate.write(&mut text).unwrap();
        eprintln!("{side:?} {:?} {} bytes", start.elapsed(), text.len());
        std::fs::write(format!("/tmp/oct-{side:?}.json"), &text).unwrap();
        let verdict = subcert_check::check(&text);
        eprintln!("{:?} {:?}", verdict.claim, verdict.outcome);
    }
}

#[test]
fn saddles() {
    for (rules, scheme, n) in [
        (
            Rules::Loop(LoopWeights::Original),
            Scheme::Loop(LoopWeights::Original),
            5,
        ),
        (
            Rules::Loop(LoopWeights::Original),
            Scheme::Loop(LoopWeights::Original),
            8,
        ),
        (Rules::CatmullClark, Scheme::CatmullClark, 8),
    ] {
        let amplitude = Rational::ratio(1, 1);
        let net = eigen_mesh(rules, n, 2, &amplitude).unwrap();
        let is_loop = scheme != Scheme::CatmullClark;
        let request = Request {
            scheme,
            boundary: Boundary::None,
            level: 0,
            flat: Flat::Control,
            facets: if is_loop {
                Facets::Triangles
            } else {
                Facets::Bilinear
            },
            side: Side::SurfaceToMesh,
            gap: 0.01,
            vertices: true,
        };
        let eigen = Eigen {
            valence: n,
            frequency: 2,
            amplitude,
            within: net.within,
        };
        let start = std::time::Instant::now();
        let certificate = certify(&net.mesh, &request, is_loop.then_some(&eigen)).unwrap();
        let mut text = Vec::new();
        certificate.write(&mut text).unwrap();
        let Claim::Hausdorff(claim) = &certificate.claim else {
            panic!()
        };
        let f = |s: &str| {
            let (p, q) = s.split_once('/').unwrap();
            p.parse::<f64>().unwrap() / q.parse::<f64>().unwrap()
        };
        eprintln!(
            "{scheme:?} {n} {:?} {} bytes lo {} hi {} vertex {}",
            start.elapsed(),
            text.len(),
            f(&claim.lo),
            f(&claim.hi),
            f(claim.vertex.as_ref().unwrap())
        );
        std::fs::write(format!("/tmp/saddle-{}-{n}.json", scheme.name()), &text).unwrap();
        let start = std::time::Instant::now();
        let verdict = subcert_check::check(&text);
        eprintln!(
            "{:?} {:?} {:?}",
            start.elapsed(),
            verdict.claim,
            verdict.outcome
        );
    }
}
