//! `f64` refinement: its certified error and its independence of threads.

use num_traits::Signed;
use subcert::mesh::{Mesh, Point};
use subcert::refine::{
    RefineError, Refiner, enclose_limits, enclose_refined, limit_positions, position_error_bound,
    refine, refine_positions,
};
use subcert::scalar::Rational;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

use crate::exact::{SCHEMES, WARREN, exactly};
use crate::meshes::{Random, topology, torus, zoo};

fn random_points(count: u32, seed: u64) -> Vec<Point<f64>> {
    let mut random = Random(seed);
    (0..count)
        .map(|_| Point(std::array::from_fn(|_| 100.0 * random.signed())))
        .collect()
}

fn largest_difference(points: &[Point<f64>], exact: &[Point<Rational>]) -> Rational {
    assert_eq!(points.len(), exact.len());
    let computed = exactly(points);
    let pairs = computed.iter().zip(exact);
    let differences = pairs.flat_map(|(a, b)| (0..3).map(move |i| (&a.0[i] - &b.0[i]).abs()));
    differences.max().unwrap()
}

#[test]
fn the_error_bound_holds_and_is_not_idle() {
    let mut sharpest = 0f64;
    let mut compared = [0; 3];
    for (case, (name, vertices, faces)) in zoo().into_iter().enumerate() {
        for (kind, scheme) in SCHEMES.into_iter().enumerate() {
            let topology = topology(vertices, &faces);
            let positions = random_points(vertices as u32, case as u64);
            let mut exact = Mesh {
                topology: topology.clone(),
                positions: exactly(&positions),
            };
            let mesh = Mesh {
                topology,
                positions,
            };
            let largest = mesh
                .positions
                .iter()
                .flat_map(|p| p.0)
                .fold(0f64, |m, x| m.max(x.abs()));
            for level in 1..=3 {
                exact = match refine(scheme, CornerRule::Smooth, &exact, 1) {
                    Ok(finer) => finer,
                    Err(RefineError::NotATriangle { .. } | RefineError::Unrepresentable { .. }) => {
                        break;
                    }
                    Err(other) => panic!("{name}: {other}"),
                };
                let (fine, enclosed) =
                    enclose_refined(scheme, CornerRule::Smooth, &mesh, level).unwrap();
                assert_eq!(fine, exact.topology);
                let bound = Rational::from_float(enclosed.radius).unwrap();
                let error = largest_difference(&enclosed.positions, &exact.positions);
                assert!(error <= bound, "{name}, {}, level {level}", scheme.name());
                sharpest =
                    sharpest.max(num_traits::ToPrimitive::to_f64(&(&error / &bound)).unwrap());

                let before = position_error_bound(scheme, &mesh.topology, largest, level).unwrap();
                assert!(
                    before >= enclosed.radius && before < 3.0 * enclosed.radius,
                    "{name}"
                );

                let limits = enclose_limits(scheme, CornerRule::Smooth, &fine, &enclosed).unwrap();
                if let Ok(exact_limits) = limit_positions::<Rational, _>(
                    scheme,
                    CornerRule::Smooth,
                    &exact.topology,
                    &exact.positions,
                ) {
                    let error = largest_difference(&limits.positions, &exact_limits);
                    assert!(
                        error <= Rational::from_float(limits.radius).unwrap(),
                        "{name}"
                    );
                }
                compared[kind] += 1;
            }
        }
    }
    assert!(compared.iter().all(|&count| count > 10), "{compared:?}");
    // A bound a hundred times smaller would be false somewhere here (a thousand times, all the more).
    assert!(sharpest > 0.01 && sharpest <= 1.0, "{sharpest}");
}

#[test]
fn original_weights_are_enclosed_too() {
    // 6 at every vertex but the enclosure of the mask is that of 2 cos(2 pi / 5) and others
    for (name, vertices, faces) in zoo() {
        let mesh = Mesh {
            topology: topology(vertices, &faces),
            positions: random_points(vertices as u32, 9),
        };
        let scheme = Scheme::Loop(LoopWeights::Original);
        let Ok((_, enclosed)) = enclose_refined(scheme, CornerRule::Sharp, &mesh, 2) else {
            continue;
        };
        let intervals = Mesh {
            topology: mesh.topology.clone(),
            positions: mesh
                .positions
                .iter()
                .map(|p| Point(p.0.map(subcert::scalar::Interval::point)))
                .collect(),
        };
        let boxes = refine(scheme, CornerRule::Sharp, &intervals, 2)
            .unwrap()
            .positions;
        for (x, b) in enclosed.positions.iter().zip(&boxes) {
            for i in 0..3 {
                let reach = subcert::scalar::Interval::new(
                    x.0[i] - 2.0 * enclosed.radius,
                    x.0[i] + 2.0 * enclosed.radius,
                );
                assert!(reach.intersection(b.0[i]).is_some(), "{name}");
            }
        }
    }
}

#[test]
fn subnormal_coordinates_are_enclosed() {
    let tiny = f64::from_bits(1);
    let mesh = torus(3, 4, true);
    let mut random = Random(7);
    let positions: Vec<_> = (0..12)
        .map(|_| Point(std::array::from_fn(|_| tiny * random.below(9) as f64)))
        .collect();
    let exact = Mesh {
        topology: mesh.clone(),
        positions: exactly(&positions),
    };
    let exact = refine(WARREN, CornerRule::Smooth, &exact, 1).unwrap();
    let mesh = Mesh {
        topology: mesh,
        positions,
    };
    let (_, enclosed) = enclose_refined(WARREN, CornerRule::Smooth, &mesh, 1).unwrap();
    let error = largest_difference(&enclosed.positions, &exact.positions);
    assert!(error > Rational::from_integer(0.into()));
    assert!(error <= Rational::from_float(enclosed.radius).unwrap());
}

#[test]
fn infinite_and_huge_coordinates_are_refused() {
    let mesh = torus(3, 4, true);
    let mut positions = random_points(12, 1);
    for bad in [f64::INFINITY, f64::NAN, -f64::MAX] {
        positions[5].0[2] = bad;
        let mut out = Vec::new();
        let error = Refiner::new(WARREN, CornerRule::Smooth)
            .enclose_into(&mesh, &positions, 0.0, &mut out)
            .unwrap_err();
        assert_eq!(error, RefineError::NotFinite { vertex: 5 });
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let pools = [1, 2, 3, 7].map(|n| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .build()
            .unwrap()
    });
    let original = Scheme::Loop(LoopWeights::Original);
    for (scheme, triangles) in [
        (original, true),
        (Scheme::CatmullClark, false),
        (Scheme::DooSabin, false),
    ] {
        let mesh = torus(130, 140, triangles);
        let points = random_points(mesh.vertex_count(), 11);
        let bits = |points: Vec<Point<f64>>| -> Vec<u64> {
            points.iter().flat_map(|p| p.0.map(f64::to_bits)).collect()
        };
        let results: Vec<_> = pools
            .iter()
            .map(|pool| {
                pool.install(|| {
                    let refined =
                        refine_positions::<f64, _>(scheme, CornerRule::Smooth, &mesh, &points)
                            .unwrap();
                    let limits =
                        limit_positions::<f64, _>(scheme, CornerRule::Smooth, &mesh, &points)
                            .unwrap();
                    let mut out = Vec::new();
                    let radius = Refiner::new(scheme, CornerRule::Smooth)
                        .enclose_into(&mesh, &points, 0.0, &mut out)
                        .unwrap();
                    (bits(refined), bits(limits), bits(out), radius.to_bits())
                })
            })
            .collect();
        assert!(
            results.iter().all(|result| *result == results[0]),
            "{}",
            scheme.name()
        );
    }
}
