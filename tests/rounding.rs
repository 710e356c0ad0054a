//! The rounding bound at work: float enclosures against exact ones, compared as rationals.
//!
//! Nets with the largest distance at a vertex have an exact squared distance: the exact search ends
//! with equal bounds there. A float enclosure that is asked to be as tight as `f64` allows must still
//! contain it. Setting the rounding bound to 0 makes this test fail.

#[allow(unused_imports)] // its nets are enough here
mod oracle;

use num_traits::Zero;
use oracle::nets::{self, Random};
use subcert::distance::measure::{Request, measure, measure_enclosing, measure_exact};
use subcert::distance::model::Against;
use subcert::distance::parametric::Goal;
use subcert::mesh::{Mesh, Point, Topology};
use subcert::scalar::Rational;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const SEED: u64 = 0x5eed_0001;

/// Random coordinates with all 53 bits, in [-1, 1), moved by `shift`.
fn positions(count: usize, shift: f64, random: &mut Random) -> Vec<Point<f64>> {
    let mut coordinate = || (random.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0 + shift;
    (0..count)
        .map(|_| Point([coordinate(), coordinate(), coordinate()]))
        .collect()
}

#[test]
fn float_and_interval_enclosures_contain_the_exact_distance() {
    let random = &mut Random(SEED);
    let (mut tight, mut total) = (0, 0);
    for round in 0..24 {
        let (faces, scheme) = match round % 4 {
            0 => (
                nets::grid(3, 4, false, true),
                Scheme::Loop(LoopWeights::Original),
            ),
            1 => (nets::bipyramid(4), Scheme::Loop(LoopWeights::Warren)),
            2 => (nets::grid(3, 4, true, true), Scheme::CatmullClark),
            _ => (nets::grid(4, 3, true, true), Scheme::DooSabin),
        };
        let shift = [0.0, 3.0, 1e6][round / 4 % 3];
        let corners: Vec<u32> = faces.iter().flatten().map(|&v| v as u32).collect();
        let count = nets::vertex_count(&faces);
        let topology =
            Topology::from_uniform(count, faces[0].len() as u32, corners).expect("a manifold");
        let mesh = Mesh {
            topology: topology.clone(),
            positions: positions(count, shift, random),
        };
        let rational = |x: f64| Rational::from_float(x).expect("finite");
        let exact_positions = mesh
            .positions
            .iter()
            .map(|p| Point(p.0.map(rational)))
            .collect();
        let exact_mesh = Mesh {
            topology,
            positions: exact_positions,
        };
        for against in [Against::Control, Against::Limit] {
            for level in [0, 1] {
                let goal = Goal {
                    gap: 1e-4,
                    cells: 20_000,
                    ..Goal::default()
                };
                let request = Request {
                    scheme,
                    corner: CornerRule::Smooth,
                    level,
                    against,
                    goal,
                };
                let exact =
                    measure_exact(&exact_mesh, &request, &|_, _| ()).expect("rational masks");
                let [lower, upper] = exact.squares.expect("squares");
                assert!(lower <= upper);
                // As tight as f64 allows; whether that is reached does not matter here.
                let goal = Goal {
                    gap: 1e-13,
                    cells: 5_000,
                    ..Goal::default()
                };
                let request = Request { goal, ..request };
                let float = measure(&mesh, &request, &|_, _| ()).expect("measured");
                let interval = measure_enclosing(&mesh, &request, &|_, _| ()).expect("measured");
                for found in [float, interval] {
                    let (lo, hi) = (rational(found.lo), rational(found.hi));
                    let what = format!("round {round}, {against:?}, level {level}: {found:?}");
                    assert!(lo.clone() * &lo <= upper, "lo is too large: {what}");
                    assert!(hi.clone() * &hi >= lower, "hi is too small: {what}");
                }
                total += 1;
                if lower == upper && !lower.is_zero() {
                    tight += 1;
                }
            }
        }
    }
    // The comparison has no slack in these cases: the exact distance is one number.
    assert!(
        tight * 4 >= total,
        "only {tight} of {total} nets have an exact distance"
    );
}
