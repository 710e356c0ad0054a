//! Section 2.1: curve segments, Lemmas 1 and 2, the inequality (6).
//!
//! The 4 x 4 net of a regular patch is the local net of N = 4, all sixteen points of it: V_(i,j) of the paper
//! lies at (i - 1, j - 1) of the lattice. So masks and norms are those of [`Setting`].

use num_traits::Zero;

use super::functional::Functional;
use super::norm::{Norm, number};
use super::printed;
use super::setting::Setting;
use super::violation::texts;
use crate::bernstein::conversion::cubic_bezier_from_net;
use crate::bernstein::from_net;
use crate::bernstein::tensor::Bicubic;
use crate::paper::words::claim;
use crate::paper::{Claim, Counterexample, Verdict};
use crate::scalar::{Field, Rational, Ring};
use crate::scheme::{IntegerRow, catmull_clark};

/// The valence of regular vertices.
pub const REGULAR: u32 = 4;

/// Of claims about regular patches.
pub const SCOPE: &str = "regular patches (N = 4)";

/// The label of V_(i,j), 0 <= i, j <= 3 on level 0 and <= 4 on level 1.
pub fn grid_label(i: usize, j: usize) -> usize {
    let label = catmull_clark::lattice_label(REGULAR, i as i32 - 1, j as i32 - 1);
    // At N = 4 the ring closes: V9 is at (-1, -1).
    label.unwrap_or(2 * REGULAR as usize + 1)
}

/// The label of a point as printed in section 2.1: `V01`.
pub fn printed_label(text: &str) -> Option<usize> {
    let digits: Vec<usize> = text
        .strip_prefix('V')?
        .chars()
        .map(|c| c.to_digit(10).map(|d| d as usize))
        .collect::<Option<_>>()?;
    match digits[..] {
        [i, j] => Some(grid_label(i, j)),
        _ => None,
    }
}

/// The sixteen points in grid order from a corner (i, j) of a level, u fastest.
pub fn window(points: &[Functional], i: usize, j: usize) -> [Functional; 16] {
    std::array::from_fn(|at| points[grid_label(i + at % 4, j + at / 4) - 1].clone())
}

/// The Bernstein coefficients of S - L over the middle face of a 4 x 4 net.
pub fn surface_minus_face(net: &[Functional; 16]) -> [Functional; 16] {
    let mut surface = from_net::bicubic::<Rational, _>(net);
    let corners = [5, 6, 10, 9].map(|i| net[i].clone());
    surface.subtract::<Rational>(&Bicubic::from_bilinear::<Rational>(&corners));
    surface.0
}

/// The net `(i² + j²) / 2`: all its second differences are -1.
pub fn bowl() -> Vec<Rational> {
    lattice_net(|i, j| Rational::ratio(i * i + j * j, 2))
}

/// The net `(i² - j²) / 2`: second differences -1 and 1.
fn saddle() -> Vec<Rational> {
    lattice_net(|i, j| Rational::ratio(i * i - j * j, 2))
}

fn lattice_net(value: impl Fn(i64, i64) -> Rational) -> Vec<Rational> {
    let mut net = vec![Rational::zero(); catmull_clark::local_net_size(REGULAR)];
    for i in 0..4 {
        for j in 0..4 {
            net[grid_label(i, j) - 1] = value(i as i64 - 1, j as i64 - 1);
        }
    }
    net
}

/// The claims of section 2.1 up to (6).
pub fn claims(setting: &Setting) -> Vec<Claim> {
    vec![
        curve_identity(),
        lemma_1(),
        lemma_2(setting),
        not_at_corners(setting),
    ]
}

/// The segment and its leg as Bernstein coefficients of L - C; V_0 .. V_3 are the points 1 .. 4.
fn leg_minus_curve() -> [Functional; 4] {
    let points: [Functional; 4] = std::array::from_fn(|i| Functional::point(4, i + 1));
    let curve = cubic_bezier_from_net::<Rational, _>(&points);
    let leg = |i: i64| {
        points[1].clone() * &Rational::ratio(3 - i, 3)
            + &(points[2].clone() * &Rational::ratio(i, 3))
    };
    [0, 1, 2, 3].map(|i| leg(i as i64) - &curve[i])
}

/// `2 V_1 - V_0 - V_2` and `2 V_2 - V_1 - V_3`.
fn curve_rows() -> [IntegerRow; 2] {
    [1, 2].map(|b| IntegerRow::new([(b, 2), (b - 1, -1), (b + 1, -1)]))
}

fn curve_identity() -> Claim {
    let [a, b] = curve_rows().map(|row| Functional::of_row(&row, 4) * &Rational::ratio(1, 6));
    let zero = Functional::zero();
    // (1-t)^3 and t^3 are the first and the last Bernstein polynomial.
    let found = leg_minus_curve();
    let same = found
        .iter()
        .zip([&a, &zero, &zero, &b])
        .all(|(x, y)| x.same(y));
    claim(
        "curve-identity",
        "(1)",
        "L(t) - C(t) = (1-t)³/6 (2V_1 - V_0 - V_2) + t³/6 (2V_2 - V_1 - V_3).",
        Verdict::of(Some(same)),
        "compared coefficient by coefficient in Bernstein form",
        "cubic segments",
    )
}

fn lemma_1() -> Claim {
    let norm = Norm::new(curve_rows().to_vec(), 4);
    let sups = leg_minus_curve().map(|t| norm.sup(&t));
    let sixth = Rational::ratio(1, 6);
    // The ends attain 1/6; if the inner coefficients are below it, nothing else does.
    let ends = [0, 3].iter().all(|&i| sups[i].value() == Some(&sixth));
    let inner = [1, 2]
        .iter()
        .all(|&i| sups[i].order(&sixth) == Some(std::cmp::Ordering::Less));
    let verdict = match ends && inner {
        true => Verdict::Sharp,
        false => Verdict::of(Some(false)),
    };
    let texts: Vec<String> = sups.iter().map(ToString::to_string).collect();
    claim(
        "lemma-1",
        "Lemma 1, (2)",
        "max |L - C| is taken at an end of the segment and is a sixth of the larger second difference there.",
        verdict,
        format!(
            "suprema of the four Bernstein coefficients of L - C over the second differences: {}",
            texts.join(", ")
        ),
        "cubic segments",
    )
}

fn lemma_2(setting: &Setting) -> Claim {
    let coefficients = surface_minus_face(&window(&setting.levels[0], 0, 0));
    let third = Rational::ratio(printed::THIRD.0, printed::THIRD.1);
    let (at, largest) = setting.z.largest(&coefficients);
    let attained = coefficients[0].at(&bowl());
    let sharp =
        largest.value() == Some(&third) && attained.clone() * &attained == third.clone() * &third;
    Claim {
        counterexample: Some(Counterexample {
            valence: REGULAR,
            net: texts(&bowl()),
            what: format!("all second differences are -1 and S - L = {attained} at the corners"),
        }),
        ..claim(
            "lemma-2",
            "Lemma 2, (3)",
            "max |L - S| <= M^0 / 3.",
            match sharp {
                true => Verdict::Sharp,
                false => Verdict::of(largest.at_most(&third)),
            },
            format!(
                "sixteen linear programs, one for each Bernstein coefficient of S - L: the largest is {largest} \
                 (coefficient {at}, a corner). (The derivation names the curves i = 1, 2, 3; there are four, i = 0 .. 3.)"
            ),
            SCOPE,
        )
    }
}

fn not_at_corners(setting: &Setting) -> Claim {
    let coefficients = surface_minus_face(&window(&setting.levels[0], 0, 0));
    let net = saddle();
    let patch: Bicubic<Rational> =
        crate::bernstein::tensor::Tensor(coefficients.map(|coefficient| coefficient.at(&net)));
    let corners = [0, 3, 12, 15].iter().all(|&i| patch.0[i].is_zero());
    let half = Rational::ratio(1, 2);
    let zero = <Rational as Ring>::from_integer(0);
    let (middle, _) =
        crate::bernstein::Patch::<Rational, Rational>::evaluate(&patch, [&half, &zero]);
    Claim {
        counterexample: Some(Counterexample {
            valence: REGULAR,
            net: texts(&net),
            what: format!(
                "S = L at the corners and S - L = {} in the middle of an edge",
                number(&middle)
            ),
        }),
        ..claim(
            "not-at-corners",
            "after Lemma 2",
            "Unlike for curves, max |L - S| need not be taken at a corner (\"usually\" it is not).",
            Verdict::of(Some(corners && !middle.is_zero())),
            "there is a net with S = L at all four corners and S ≠ L elsewhere; how usual that is can't be decided",
            SCOPE,
        )
    }
}
