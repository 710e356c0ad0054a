//! Curves: Theorems 1 and 4, Corollaries 1 and 4, (9), and what is said of control vertices.

use num_traits::{Signed, Zero};

use super::nets::{at, ratio};
use super::printed::{self, Fraction};
use crate::bound::Against;
use crate::bound::curve::{CurveConstant, curve_constant};
use crate::paper::words::claim;
use crate::paper::{Claim, Verdict};
use crate::scalar::{Rational, Ring};
use crate::scheme::curve::{Degree, Ends, bezier_segment, refine};

/// The values at the unit polygons of a map of polygons to numbers.
fn functional(points: usize, of: impl Fn(&[Rational]) -> Rational) -> Vec<Rational> {
    let unit = |i: usize| {
        let mut polygon = vec![Rational::zero(); points];
        polygon[i] = <Rational as Ring>::from_integer(1);
        of(&polygon)
    };
    (0..points).map(unit).collect()
}

/// L - C on a segment, as Bernstein coefficients of C's degree in each of its linear pieces.
///
/// Cubic: L runs from P_1 to P_2 over [0, 1]. Quadratic: from the middle of P_0, P_1 to P_1 over
/// [0, 1/2], and on to the middle of P_1, P_2; both halves are curve segments of the refined polygon.
fn pieces(degree: Degree, polygon: &[Rational]) -> Vec<Rational> {
    let half = ratio(1, 2);
    let chord = |a: &Rational, b: &Rational, parts: i64| -> Vec<Rational> {
        (0..=parts)
            .map(|i| a * ratio(parts - i, parts) + b * ratio(i, parts))
            .collect()
    };
    let less = |line: Vec<Rational>, curve: &[Rational]| -> Vec<Rational> {
        line.iter().zip(curve).map(|(l, c)| l - c).collect()
    };
    match degree {
        Degree::Cubic => {
            let curve = bezier_segment::<Rational, Rational>(degree, Ends::Open, polygon, 0);
            less(chord(&polygon[1], &polygon[2], 3), &curve)
        }
        Degree::Quadratic => {
            let refined = refine::<Rational, _>(degree, Ends::Open, polygon);
            let middles = [0, 1].map(|i| (&polygon[i] + &polygon[i + 1]) * &half);
            let segment = |i| bezier_segment::<Rational, Rational>(degree, Ends::Open, &refined, i);
            let first = less(chord(&middles[0], &polygon[1], 2), &segment(0));
            let second = less(chord(&polygon[1], &middles[1], 2), &segment(1));
            first.into_iter().chain(second).collect()
        }
    }
}

/// The constant of a curve against its polygon; a control vertex is at an end of an edge.
fn control(degree: Degree) -> Option<CurveConstant> {
    curve_constant(degree, Against::Control)
}

/// Whether a constant is attained at a control vertex.
fn is_at_a_vertex(constant: &CurveConstant) -> bool {
    [0, 1].map(|end| ratio(end, 1)).contains(&constant.at)
}

/// A theorem `distance <= c M_i <= c 4^-i M_0`, and the depth that follows from it.
fn theorem(
    degree: Degree,
    [id, corollary]: [&'static str; 2],
    [place, corollary_place]: [&'static str; 2],
    constant: Fraction,
) -> [Claim; 2] {
    let printed = ratio(constant.0, constant.1);
    let quarter = ratio(printed::QUARTER.0, printed::QUARTER.1);
    let found = control(degree);
    let sharp = found
        .as_ref()
        .map(|s| s.value == printed && s.rate == quarter);
    let holds = found
        .as_ref()
        .map(|s| s.value <= printed && s.rate <= quarter);
    let verdict = match (sharp, holds) {
        (Some(true), _) => Verdict::Sharp,
        (_, Some(true)) => Verdict::Loose,
        (_, other) => Verdict::of(other),
    };
    let name = match degree {
        Degree::Cubic => "cubic",
        Degree::Quadratic => "quadratic",
    };
    let text = match &found {
        Some(s) => format!(
            "sup |L - C| / M = {}, taken {}; sup M_1 / M_0 = {}: exact linear programs. Polygons with \
             constant second differences attain both at every level",
            s.value,
            match is_at_a_vertex(s) {
                true => "at a control vertex",
                false => "between control vertices",
            },
            s.rate
        ),
        None => "a program has no solution".into(),
    };
    let scope = format!("uniform {name} B-spline curves, L and C at the same parameter");
    [
        claim(
            id,
            place,
            format!(
                "|L_p(t) - C_p(t)| <= M_i / {} <= 4^-i M_0 / {0}.",
                constant.1
            ),
            verdict,
            text,
            scope.clone(),
        ),
        claim(
            corollary,
            corollary_place,
            format!(
                "Within ε after i steps if i >= log_4(M_0 / {} ε).",
                constant.1
            ),
            verdict,
            format!(
                "follows from the theorem, with >= as printed; as |L - C| = 4^-i M_0 / {} for constant \
                 second differences, no smaller depth serves all curves. Negative values mean no step",
                constant.1
            ),
            scope,
        ),
    ]
}

/// (9) and the image of P_1, against the scheme.
fn masks() -> Claim {
    let [near, far] = printed::CHAIKIN.map(|(p, q)| ratio(p, q));
    let polygon = super::nets::integers(&[7, -5, 11]);
    let refined = refine::<Rational, _>(Degree::Quadratic, Ends::Open, &polygon);
    let by_9 = |i: usize| {
        let (p, q) = (&polygon[i], &polygon[i + 1]);
        [p * &near + q * &far, p * &far + q * &near]
    };
    let same = refined.as_slice() == [by_9(0), by_9(1)].concat();
    let image = printed::LIMIT_OF_QUADRATIC.map(|(p, q)| ratio(p, q));
    // By subdivision: the middle of the two points that P_1 has become is on the curve for ever.
    let middle = functional(3, |p| {
        let fine = refine::<Rational, _>(Degree::Quadratic, Ends::Open, p);
        (&fine[1] + &fine[2]) * ratio(1, 2)
    });
    claim(
        "eq-9",
        "(9), proof of Theorem 4",
        "Even and odd vertices (3/4, 1/4), (1/4, 3/4); the image of P_1 is (P_0 + 6 P_1 + P_2) / 8.",
        Verdict::of(Some(same && middle == image)),
        "the rules of the scheme, and the middle of an edge that stays on the curve",
        "uniform quadratic B-spline curves",
    )
}

/// Control vertices are farthest: of curves.
fn farthest() -> Claim {
    let truth = [Degree::Quadratic, Degree::Cubic].map(|degree| {
        let constant = control(degree)?;
        let points = degree.get() + 1;
        // |L - C| on a piece is at most the larger distance at its two ends: every Bernstein
        // coefficient is a combination of those of the ends with weights of sum at most 1.
        let ends = |p: &[Rational]| -> Vec<Rational> {
            let all = pieces(degree, p);
            let size = degree.get() + 1;
            all.chunks(size)
                .flat_map(|piece| [piece[0].clone(), piece[size - 1].clone()])
                .collect()
        };
        let count = pieces(degree, &vec![Rational::zero(); points]).len();
        let size = points;
        let inside = (0..count).all(|i| {
            let t = functional(points, |p| pieces(degree, p)[i].clone());
            let piece = i / size;
            let of = |e: usize| functional(points, move |p| ends(p)[2 * piece + e].clone());
            proportional_sum(&t, &of(0), &of(1))
        });
        Some(inside && is_at_a_vertex(&constant))
    });
    let both = match truth {
        [Some(a), Some(b)] => Some(a && b),
        _ => None,
    };
    claim(
        "farthest-curves",
        "section 3, Figure 7",
        "The control vertices are the most distant points from the limit curve; between them it is less.",
        Verdict::of(both),
        "cubic: L - C = (1-t)^3 d_0 + t^3 d_1, d_0 and d_1 the displacements of the ends, at most a \
         quarter of the larger at the middle; quadratic: L - C = (2t)^2 d on either side of the vertex",
        "uniform quadratic and cubic B-spline curves, parametric distance",
    )
}

/// Whether t = x a + y b with |x| + |y| <= 1; a or b may be 0.
fn proportional_sum(t: &[Rational], a: &[Rational], b: &[Rational]) -> bool {
    let steps = [0, 1].map(|i| ratio(i, 1));
    let candidates = steps.iter().flat_map(|x| steps.iter().map(move |y| (x, y)));
    candidates
        .filter(|(x, y)| (*x + *y) <= ratio(1, 1))
        .any(|(x, y)| (0..t.len()).all(|i| t[i] == x * &a[i] + y * &b[i]))
}

/// D at a level against d at the next: curves.
fn monotone() -> Claim {
    let rates = [Degree::Quadratic, Degree::Cubic].map(|d| control(d).map(|s| s.rate));
    let less = rates
        .iter()
        .map(|r| r.as_ref().map(|r| *r < ratio(1, 1)))
        .try_fold(true, |all, r| Some(all && r?));
    claim(
        "monotone-curves",
        "section 1, Figure 1",
        "The maximum distance D at a level is always larger than the distance d at the next.",
        Verdict::of(less),
        "D is 1/6 or 1/8 of the largest second difference, which falls by 4 at least: d <= D / 4, unless \
         both are 0 (straight polygons)",
        "uniform quadratic and cubic B-spline curves that are not straight",
    )
}

/// The displayed equations in the proof of Theorem 4.
fn proof_of_theorem_4() -> Claim {
    let quarter = ratio(1, 4);
    let difference = |p: &[Rational], i: usize| &p[i] - &p[i + 1] * ratio(2, 1) + &p[i + 2];
    let old = functional(3, |p| difference(p, 0));
    let equal = (0..2).all(|i| {
        let fine = functional(3, |p| {
            difference(&refine::<Rational, _>(Degree::Quadratic, Ends::Open, p), i)
        });
        fine.iter()
            .zip(&old)
            .all(|(a, b)| a.abs() == (b * &quarter).abs())
    });
    let net = super::nets::integers(&[0, 0, 1]);
    claim(
        "theorem-4-proof",
        "proof of Theorem 4",
        "Both second differences of the refined polygon are a quarter of the old one in size.",
        Verdict::of(Some(equal && at(&old, &net) == ratio(1, 1))),
        "an identity of functionals",
        "uniform quadratic B-spline curves",
    )
}

/// The claims on curves.
pub fn claims() -> Vec<Claim> {
    let mut claims = Vec::new();
    claims.extend(theorem(
        Degree::Cubic,
        ["theorem-1", "corollary-1"],
        ["Theorem 1, (6)", "Corollary 1"],
        printed::THEOREM_1,
    ));
    claims.push(masks());
    claims.extend(theorem(
        Degree::Quadratic,
        ["theorem-4", "corollary-4"],
        ["Theorem 4, (10)", "Corollary 4"],
        printed::THEOREM_4,
    ));
    claims.extend([proof_of_theorem_4(), farthest(), monotone()]);
    claims
}
