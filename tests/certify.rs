//! Certificates of Hausdorff distances: what the library writes, the checker verifies, and its enclosure
//! meets that of the measurement, which is another search in other arithmetic.

use subcert::certificate::{Certificate, Claim};
use subcert::distance::certify::{Boundary, CertifyError, Flat, Request, certify};
use subcert::distance::hausdorff::{self, Facets, Goal, Side, measure};
use subcert::distance::model::Against;
use subcert::mesh::{Mesh, Point, Topology};
use subcert::scalar::{Field, Rational, Ring, float::round_to_nearest};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

fn mesh(points: &[[i64; 3]], faces: &[&[u32]]) -> Mesh<Rational> {
    let point = |p: &[i64; 3]| Point(p.map(<Rational as Ring>::from_integer));
    let starts = std::iter::once(0).chain(faces.iter().scan(0, |sum, face| {
        *sum += face.len() as u32;
        Some(*sum)
    }));
    let corners = faces.concat();
    Mesh {
        topology: Topology::from_polygons(points.len(), starts.collect(), corners).expect("a mesh"),
        positions: points.iter().map(point).collect(),
    }
}

/// A roof of eight triangles round a vertex of valence 8, which is irrational with the original weights.
fn roof() -> Mesh<Rational> {
    let ring = [
        [4, 0],
        [3, 3],
        [0, 4],
        [-3, 3],
        [-4, 0],
        [-3, -3],
        [0, -4],
        [3, -3],
    ];
    let height = |i: usize| i64::from(!i.is_multiple_of(2));
    let mut points = vec![[0, 0, 3]];
    points.extend(
        ring.iter()
            .enumerate()
            .map(|(i, [x, y])| [*x, *y, height(i)]),
    );
    let faces: Vec<[u32; 3]> = (0..8).map(|i| [0, 1 + i, 1 + (i + 1) % 8]).collect();
    let faces: Vec<&[u32]> = faces.iter().map(|f| &f[..]).collect();
    mesh(&points, &faces)
}

/// A prism with a pentagon on top: polygons, boundary below.
fn pentagon() -> Mesh<Rational> {
    let around = [[5, 0], [2, 5], [-4, 3], [-4, -3], [2, -5]];
    let at = |z: i64| around.iter().map(move |[x, y]| [*x, *y, z]);
    let points: Vec<[i64; 3]> = at(4).chain(at(0)).collect();
    let sides: Vec<[u32; 4]> = (0..5)
        .map(|i| [i, 5 + i, 5 + (i + 1) % 5, (i + 1) % 5])
        .collect();
    let mut faces: Vec<&[u32]> = vec![&[0, 1, 2, 3, 4]];
    faces.extend(sides.iter().map(|f| &f[..]));
    mesh(&points, &faces)
}

fn request(scheme: Scheme, boundary: Boundary, facets: Facets, side: Side) -> Request<'static> {
    Request {
        scheme,
        boundary,
        level: 0,
        flat: Flat::Control,
        facets,
        side,
        gap: 0.05,
        vertices: true,
    }
}

fn number(text: &str) -> Rational {
    let (p, q) = text.split_once('/').unwrap_or((text, "1"));
    Rational::new(p.parse().expect("digits"), q.parse().expect("digits"))
}

fn verified(certificate: &Certificate) -> [Rational; 2] {
    let mut text = Vec::new();
    certificate.write(&mut text).expect("memory");
    let verdict = subcert_check::check(&text);
    assert!(
        verdict.outcome.is_ok(),
        "{:?}: {:?}",
        verdict.claim,
        verdict.outcome
    );
    let Claim::Hausdorff(claim) = &certificate.claim else {
        panic!("another claim")
    };
    [number(&claim.lo), number(&claim.hi)]
}

/// The measured enclosure has a point in common with the proved one.
fn meets(mesh: &Mesh<Rational>, request: &Request<'_>, [lo, hi]: &[Rational; 2]) {
    let nearest = |p: &Point<Rational>| Point(p.0.each_ref().map(round_to_nearest));
    let floats = Mesh {
        topology: mesh.topology.clone(),
        positions: mesh.positions.iter().map(nearest).collect(),
    };
    let corner = match request.boundary {
        Boundary::Sharp => CornerRule::Sharp,
        _ => CornerRule::Smooth,
    };
    let asked = hausdorff::Request {
        scheme: request.scheme,
        corner,
        level: request.level,
        against: Against::Control,
        side: request.side,
        facets: request.facets,
        goal: Goal::default(),
    };
    let found = measure(&floats, None, &asked, &|_, _| ()).expect("a measurement");
    let exact = |x: f64| Rational::from_float(x).expect("finite");
    assert!(
        exact(found.lo) <= *hi && *lo <= exact(found.hi),
        "{found:?} {lo} {hi}"
    );
    assert!(
        hi.clone() <= lo.clone() * &Rational::ratio(11, 10),
        "not as close as asked"
    );
}

#[test]
fn open_meshes_and_polygons() {
    let original = Scheme::Loop(LoopWeights::Original);
    for side in [Side::SurfaceToMesh, Side::MeshToSurface] {
        for (mesh, scheme, boundary, facets) in [
            (roof(), original, Boundary::Smooth, Facets::Triangles),
            (roof(), original, Boundary::Sharp, Facets::Triangles),
            (
                pentagon(),
                Scheme::CatmullClark,
                Boundary::Smooth,
                Facets::Bilinear,
            ),
            (
                pentagon(),
                Scheme::CatmullClark,
                Boundary::Sharp,
                Facets::Triangles,
            ),
        ] {
            let request = request(scheme, boundary, facets, side);
            let proof = certify(&mesh, &request, None).expect("a proof");
            meets(&mesh, &request, &verified(&proof));
        }
    }
}

#[test]
fn what_has_no_certificate() {
    let smooth = |scheme| request(scheme, Boundary::Smooth, Facets::Bilinear, Side::Both);
    let doo_sabin = certify(&pentagon(), &smooth(Scheme::DooSabin), None);
    assert_eq!(doo_sabin.unwrap_err(), CertifyError::DooSabin);
    let fine = Request {
        level: 6,
        ..smooth(Scheme::CatmullClark)
    };
    let many = certify(&pentagon(), &fine, None).unwrap_err();
    assert!(matches!(many, CertifyError::TooManyFaces { faces } if faces > 2000));
    // All faces of the roof end at the boundary.
    let none = Request {
        boundary: Boundary::None,
        ..smooth(Scheme::Loop(LoopWeights::Original))
    };
    assert_eq!(
        certify(&roof(), &none, None).unwrap_err(),
        CertifyError::NoSurface
    );
    // A regular grid in a plane: over its inner faces the surface is the mesh.
    let flat: Vec<[i64; 3]> = (0..25).map(|k| [k % 5, k / 5, 0]).collect();
    let halves = |k: u32| {
        let v = k % 4 + 5 * (k / 4);
        [[v, v + 1, v + 5], [v + 1, v + 6, v + 5]]
    };
    let faces: Vec<[u32; 3]> = (0..16).flat_map(halves).collect();
    let faces: Vec<&[u32]> = faces.iter().map(|f| &f[..]).collect();
    let plane = Request {
        boundary: Boundary::None,
        side: Side::SurfaceToMesh,
        ..smooth(Scheme::Loop(LoopWeights::Original))
    };
    assert_eq!(
        certify(&mesh(&flat, &faces), &plane, None).unwrap_err(),
        CertifyError::NoDistance
    );
}
