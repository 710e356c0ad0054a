//! Hausdorff distances against known values, and against brute force.
//!
//! Sources of expected values: geometry done by hand where a comment says so; dense samples of
//! `tests/oracle`, which was written from the definitions alone; the same set given in another way.

#[path = "../oracle/mod.rs"]
mod oracle;
mod samples;

use num_bigint::BigInt;
use num_rational::BigRational;
use oracle::nets::{self, Net, Random};
use subcert::distance::hausdorff::{
    Facets, Goal, HausdorffError, Measurement, Request, Side, measure, mesh_to_mesh,
};
use subcert::distance::measure::MeasureError;
use subcert::distance::model::Against;
use subcert::mesh::{Mesh, Point, Topology};
use subcert::refine::refine;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const SEED: u64 = 20260802;
const SIDES: [Side; 3] = [Side::SurfaceToMesh, Side::MeshToSurface, Side::Both];

fn mesh(points: &[[f64; 3]], faces: &[&[u32]]) -> Mesh {
    let mut start = vec![0];
    let mut corners = Vec::new();
    for face in faces {
        corners.extend_from_slice(face);
        start.push(corners.len() as u32);
    }
    let topology = Topology::from_polygons(points.len(), start, corners).expect("a manifold");
    let positions = points.iter().map(|p| Point(*p)).collect();
    Mesh {
        topology,
        positions,
    }
}

fn of_net(net: &Net) -> Mesh {
    let points: Vec<[f64; 3]> = net.points.iter().map(|p| p.map(|x| x as f64)).collect();
    let faces: Vec<Vec<u32>> = net
        .faces
        .iter()
        .map(|face| face.iter().map(|&v| v as u32).collect())
        .collect();
    let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
    mesh(&points, &faces)
}

fn goal(diagonal_gap: f64) -> Goal {
    Goal {
        diagonal_gap,
        ..Goal::default()
    }
}

fn request(scheme: Scheme, side: Side, gap: f64) -> Request {
    Request {
        scheme,
        corner: CornerRule::Smooth,
        level: 0,
        against: Against::Control,
        side,
        facets: Facets::Bilinear,
        goal: goal(gap),
    }
}

fn quiet(_: u32, _: u32) {}

fn between(a: &Mesh, b: &Mesh, side: Side, gap: f64) -> Measurement {
    mesh_to_mesh(a, b, side, Facets::Triangles, goal(gap), &quiet).expect("measured")
}

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).expect("a finite number")
}

fn ratio(p: i64, q: i64) -> BigRational {
    BigRational::new(BigInt::from(p), BigInt::from(q))
}

/// `lo^2 <= square <= hi^2`, decided exactly.
fn encloses_square(found: &Measurement, square: &BigRational) -> bool {
    let (lo, hi) = (exact(found.lo), exact(found.hi));
    &(&lo * &lo) <= square && square <= &(&hi * &hi)
}

/// The skew quad on four corners of a cube, cut along either diagonal. The four corners are a regular
/// tetrahedron of edge sqrt 2, each cut two of its faces. The middle of an edge is as far from either
/// face that does not hold it as half the height, 2 / sqrt 3 / 2; every other point of the two faces is
/// nearer, since the distance to a face not holding the edge falls linearly from an end of the height.
#[test]
fn the_diagonals_of_a_skew_quad_are_one_over_root_three_apart() {
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
    ];
    let first = mesh(&points, &[&[0, 1, 2], &[0, 2, 3]]);
    let second = mesh(&points, &[&[0, 1, 3], &[1, 2, 3]]);
    for gap in [1e-4, 1e-9, 1e-12] {
        for side in SIDES {
            let found = between(&first, &second, side, gap);
            assert!(found.met, "{found:?}");
            assert!(encloses_square(&found, &ratio(1, 3)), "{side:?} {found:?}");
            assert!(
                found.hi - found.lo <= gap * 3f64.sqrt() * 1.001,
                "{found:?}"
            );
            let witness = found.witness.expect("a witness");
            let distance: f64 = (0..3)
                .map(|i| (witness.point[i] - witness.foot[i]).powi(2))
                .sum();
            assert!((distance.sqrt() - found.lo).abs() <= gap, "{witness:?}");
        }
    }
}

/// A square and its copy moved by (a, b, c): every point of the copy is |c| above the plane, and the
/// corner that leaves the square goes a and b beyond it. Both sides are sqrt(a^2 + b^2 + c^2) by hand.
#[test]
fn moved_squares_are_as_far_apart_as_they_are_moved() {
    let square = |[a, b, c]: [f64; 3]| {
        let at = |x: f64, y: f64| [x + a, y + b, c];
        let points = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
        mesh(&points, &[&[0, 1, 2, 3]])
    };
    for (step, quarters) in [
        ([0.0, 0.0, 0.5], 4),
        ([0.25, 0.0, 0.0], 1),
        ([0.75, 1.0, 0.5], 29),
        ([3.0, 4.0, 0.0], 400),
    ] {
        let (here, there) = (square([0.0; 3]), square(step));
        for side in SIDES {
            for facets in [Facets::Bilinear, Facets::Triangles] {
                let found = mesh_to_mesh(&here, &there, side, facets, goal(1e-9), &quiet);
                let found = found.expect("measured");
                assert!(
                    encloses_square(&found, &ratio(quarters, 16)),
                    "{step:?} {found:?}"
                );
                assert!(
                    found.met && found.hi - found.lo <= 2e-9,
                    "{step:?} {found:?}"
                );
            }
        }
    }
    // A square in a larger one: one side is 0, the other the corner's distance sqrt 2.
    let at = |x: f64, y: f64| [x, y, 0.0];
    let large = [at(-1.0, -1.0), at(2.0, -1.0), at(2.0, 2.0), at(-1.0, 2.0)];
    let large = mesh(&large, &[&[0, 1, 2, 3]]);
    let small = square([0.0; 3]);
    let inside = between(&small, &large, Side::SurfaceToMesh, 1e-9);
    assert!(inside.lo == 0.0 && inside.hi <= 1e-8, "{inside:?}");
    for side in [Side::MeshToSurface, Side::Both] {
        let found = between(&small, &large, side, 1e-9);
        assert!(encloses_square(&found, &ratio(2, 1)), "{found:?}");
    }
}

/// z = x y over the unit square and the fan from the first corner: the planes z = y and z = x.
///
/// *Quad to fan.* From (t, t, t^2) the nearest point of z = y is (t, s, s), s = (t + t^2) / 2, in the
/// triangle, at t (1 - t) / sqrt 2: largest at t = 1/2, 1 / (4 sqrt 2). Off the diagonal, at (x, y), the
/// distance to z = y is y (1 - x) / sqrt 2 for y <= x, at most that.
///
/// *Fan to quad.* On the diagonal the foot of (t, t, t) is (s, s, s^2) with s - t + s (s^2 - t) = 0, so
/// t = (s + s^3) / (1 + s), and the distance is s (1 - s) sqrt(2 s^2 + 1) / (1 + s). Its logarithmic
/// derivative 1/s - 1/(1 - s) + 2 s / (2 s^2 + 1) - 1/(1 + s) vanishes at s = 1/2: 1 / (2 sqrt 6). The
/// ridge of the fan is its part above the saddle that is farthest from it.
#[test]
fn a_bent_quad_and_its_fan() {
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 1.0],
        [0.0, 1.0, 0.0],
    ];
    let quad = mesh(&points, &[&[0, 1, 2, 3]]);
    let fan = mesh(&points, &[&[0, 1, 2], &[0, 2, 3]]);
    for (side, inverse) in [
        (Side::SurfaceToMesh, 32),
        (Side::MeshToSurface, 24),
        (Side::Both, 24),
    ] {
        let found = mesh_to_mesh(&quad, &fan, side, Facets::Bilinear, goal(1e-7), &quiet);
        let found = found.expect("measured");
        assert!(found.met && found.hi - found.lo <= 2e-7, "{found:?}");
        let exact = ratio(1, inverse);
        assert!(encloses_square(&found, &exact), "{side:?} {found:?}");
    }
    let same = mesh_to_mesh(
        &quad,
        &fan,
        Side::Both,
        Facets::Triangles,
        goal(1e-9),
        &quiet,
    );
    let same = same.expect("measured");
    assert!(same.lo == 0.0 && same.hi <= 2e-9, "{same:?}");
}

/// A flat pentagon by its five bilinear quarters, and by a fan, is the same set; a hexagon bent up and
/// down by 1 has its centroid at height 0, in the plane of a small triangle there. The triangle's
/// corners are within 0.01 of the centroid, and the quarters are graphs of slope below 2 near it.
#[test]
fn polygons_are_their_quarters() {
    let ring = |n: usize, height: fn(usize) -> f64| -> Vec<[f64; 3]> {
        let angle = |k: usize| k as f64 * std::f64::consts::TAU / n as f64;
        (0..n)
            .map(|k| [angle(k).cos(), angle(k).sin(), height(k)])
            .collect()
    };
    let pentagon = ring(5, |_| 1.0);
    let whole = mesh(&pentagon, &[&[0, 1, 2, 3, 4]]);
    let fan = mesh(&pentagon, &[&[0, 1, 2], &[0, 2, 3], &[0, 3, 4]]);
    for side in SIDES {
        let found = mesh_to_mesh(&whole, &fan, side, Facets::Bilinear, goal(1e-3), &quiet);
        let found = found.expect("measured");
        assert!(
            found.met && found.lo <= 1e-12 && found.hi <= 3e-3,
            "{found:?}"
        );
    }
    let bent = ring(6, |k| 5.0 + if k % 2 == 0 { 1.0 } else { -1.0 });
    let bent = mesh(&bent, &[&[0, 1, 2, 3, 4, 5]]);
    let small = ring(3, |_| 5.0)
        .into_iter()
        .map(|[x, y, z]| [0.01 * x, 0.01 * y, z]);
    let small = mesh(&small.collect::<Vec<_>>(), &[&[0, 1, 2]]);
    let found = mesh_to_mesh(
        &small,
        &bent,
        Side::SurfaceToMesh,
        Facets::Bilinear,
        goal(1e-2),
        &quiet,
    );
    assert!(found.expect("measured").hi <= 0.02);
}

/// A planar regular grid is its own surface away from the boundary, and with pinned corners
/// everywhere: distance 0 is found and ends at the level of rounding errors.
#[test]
fn distance_zero_ends() {
    let quads = nets::grid(4, 3, true, false);
    let points: Vec<[i64; 3]> = (0..20).map(|k| [k / 4, k % 4, 0]).collect();
    let net = Net {
        name: "plane".into(),
        points,
        faces: quads,
    };
    let plane = of_net(&net);
    for side in SIDES {
        let mut request = request(Scheme::CatmullClark, side, 0.0);
        request.corner = CornerRule::Sharp;
        request.goal.gap = 1e-9;
        let found = measure(&plane, None, &request, &quiet).expect("measured");
        assert!(found.met && found.rounding_level, "{found:?}");
        assert!(found.lo == 0.0 && found.hi <= 1e-9, "{found:?}");
        request.facets = Facets::Triangles;
        request.goal = goal(1e-3);
        let found = measure(&plane, None, &request, &quiet).expect("measured");
        assert!(
            found.met && found.lo == 0.0 && found.hi <= 5e-3,
            "{found:?}"
        );
    }
}

fn bumpy(n: usize) -> Mesh {
    let mut random = Random(SEED);
    let net = nets::with_points(
        "torus".into(),
        nets::grid(n, n, false, true),
        9,
        &mut random,
    );
    of_net(&net)
}

/// The own mesh at level K, given as another mesh, is the same set.
#[test]
fn another_mesh_may_be_its_own() {
    let mesh = bumpy(4);
    for scheme in [
        Scheme::Loop(LoopWeights::Original),
        Scheme::CatmullClark,
        Scheme::DooSabin,
    ] {
        for side in SIDES {
            let mut own = request(scheme, side, 1e-4);
            own.level = 1;
            let other = refine(scheme, CornerRule::Smooth, &mesh, 1).expect("refined");
            let with_own = measure(&mesh, None, &own, &quiet).expect("measured");
            let with_other = measure(&mesh, Some(&other), &own, &quiet).expect("measured");
            assert!(
                with_own.lo <= with_other.hi && with_other.lo <= with_own.hi,
                "{scheme:?} {side:?}: {with_own:?} {with_other:?}"
            );
            assert!(with_other.met);
            // A fine limit mesh stands in for the surface: both are met within what it is off by.
            if side == Side::SurfaceToMesh && scheme != Scheme::DooSabin {
                let fine = refine(scheme, CornerRule::Smooth, &mesh, 4).expect("refined");
                let near = mesh_to_mesh(&fine, &other, side, Facets::Bilinear, goal(1e-4), &quiet);
                let near = near.expect("measured");
                assert!(
                    (near.hi - with_own.hi).abs() <= 0.05 * with_own.hi,
                    "{near:?} {with_own:?}"
                );
            }
        }
    }
}

/// Powers of two change no digit; moving, turning and mirroring change no distance.
#[test]
fn distances_do_not_depend_on_where_and_how_large() {
    let mesh = bumpy(5);
    let scheme = Scheme::Loop(LoopWeights::Original);
    let map = |f: &dyn Fn([f64; 3]) -> [f64; 3]| Mesh {
        topology: mesh.topology.clone(),
        positions: mesh.positions.iter().map(|p| Point(f(p.0))).collect(),
    };
    for side in SIDES {
        let request = request(scheme, side, 1e-5);
        let here = measure(&mesh, None, &request, &quiet).expect("measured");
        for exponent in [-990, -300, 7, 900] {
            let k = 2f64.powi(exponent);
            let scaled = measure(&map(&|p| p.map(|x| x * k)), None, &request, &quiet);
            let scaled = scaled.expect("measured");
            let apart = |a: f64, b: f64| (a / k - b).abs() <= 4.0 * f64::EPSILON * b;
            assert!(
                apart(scaled.lo, here.lo) && apart(scaled.hi, here.hi),
                "{scaled:?}"
            );
        }
        let moved = [
            map(&|[x, y, z]| [y, -x, z]),
            map(&|[x, y, z]| [x + 1e6, y - 3e6, z + 1e6]),
            map(&|[x, y, z]| [-x, y, z]),
        ];
        for other in moved {
            let found = measure(&other, None, &request, &quiet).expect("measured");
            assert!(found.met);
            let overlap = found.lo <= here.hi && here.lo <= found.hi;
            assert!(overlap, "{side:?}: {found:?} {here:?}");
        }
    }
}

#[test]
fn a_budget_of_nothing_still_encloses() {
    let mesh = bumpy(6);
    for side in SIDES {
        let mut request = request(Scheme::Loop(LoopWeights::Warren), side, 1e-9);
        let whole = measure(&mesh, None, &request, &quiet).expect("measured");
        request.goal.budget = Some(std::time::Duration::ZERO);
        for other in [None, Some(&mesh)] {
            let found = measure(&mesh, other, &request, &quiet).expect("measured");
            assert!(!found.met, "{found:?}");
            assert!(
                found.lo <= whole.hi && whole.lo <= found.hi && found.hi < 1e3,
                "{found:?}"
            );
        }
    }
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let cube = mesh(
        &[
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
        ],
        &[&[0, 1, 2, 3]],
    );
    let refused = |request: &Request| measure(&cube, None, request, &quiet).expect_err("refused");
    let doo_sabin = request(Scheme::DooSabin, Side::Both, 1e-4);
    assert_eq!(
        refused(&doo_sabin),
        HausdorffError::Surface(MeasureError::EmptySurface)
    );
    let quarters = Request {
        facets: Facets::Triangles,
        ..doo_sabin
    };
    assert_eq!(refused(&quarters), HausdorffError::Quarters);
    let triangles = request(Scheme::Loop(LoopWeights::Original), Side::Both, 1e-4);
    assert!(matches!(refused(&triangles), HausdorffError::Surface(_)));
    let mut broken = cube.clone();
    broken.positions[2].0[1] = f64::NAN;
    let found = mesh_to_mesh(
        &cube,
        &broken,
        Side::Both,
        Facets::Bilinear,
        goal(1e-4),
        &quiet,
    );
    assert!(
        matches!(found, Err(HausdorffError::Surface(_))),
        "{found:?}"
    );
}
