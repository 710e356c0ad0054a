//! Certificates of Hausdorff distances: written by the library, verified by the checker.

use subcert::distance::certify::{Boundary, Facets, Flat, Request, Side, certify};
use subcert::mesh::{Mesh, Point, Topology};
use subcert::scalar::{Field, Rational};
use subcert::scheme::{LoopWeights, Scheme};

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
    }
}
