//! Cells: a quartic of weights is at most the bound on its triangle, shown in one of three ways.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::file::{By, Number};
use crate::polynomial::Polynomial;
use crate::rational::ratio;
use crate::reject::{Outcome, Rule, require};
use crate::space::Space;
use crate::word::{bernstein, exponents, index};

/// Shows that the quartic with the coefficients `c / q` is at most `bound / q`.
///
/// # Errors
///
/// If and only if the way given does not show it: rule `cell-hull`, `cell-edge` or `cell-concave`.
pub fn check(space: &Space, c: &[Polynomial], bound: &Polynomial, by: &By) -> Outcome<()> {
    match by {
        By::Hull(_) => coefficients(space, c, 0..c.len(), bound, Rule::CellHull),
        By::Edge(_, opposite, Number(s)) => edge(space, c, bound, *opposite, s),
        By::Concave(_, Number(v), Number(w)) => concave(space, c, bound, v, w),
    }
}

/// The rule by which a cell is shown.
pub fn rule(by: &By) -> Rule {
    match by {
        By::Hull(_) => Rule::CellHull,
        By::Edge(..) => Rule::CellEdge,
        By::Concave(..) => Rule::CellConcave,
    }
}

fn coefficients(
    space: &Space,
    c: &[Polynomial],
    indices: impl IntoIterator<Item = usize>,
    bound: &Polynomial,
    rule: Rule,
) -> Outcome<()> {
    for i in indices {
        space.require_at_most(&c[i], bound, rule, || format!("coefficient {i}"))?;
    }
    Ok(())
}

/// `Σ weights_i c_i`.
fn combine(weights: &[BigRational], c: &[Polynomial]) -> Polynomial {
    weights
        .iter()
        .zip(c)
        .fold(Polynomial::integer(0), |sum, (x, c)| &sum + &c.scale(x))
}

/// The second difference `a - 2b + c`, or with b = (x + y)/2 any `a - x - y + c`.
fn second(a: &Polynomial, x: &Polynomial, y: &Polynomial, c: &Polynomial) -> Polynomial {
    &(a + c) - &(x + y)
}

/// `B_i(s)` of degree m on [0, 1]: those of the triangle on the edge w = 0.
fn on_interval(degree: usize, s: &BigRational) -> Vec<BigRational> {
    let values = bernstein(degree, s, &BigRational::zero());
    (0..=degree).map(|j| values[index(j, 0)].clone()).collect()
}

fn edge(
    space: &Space,
    c: &[Polynomial],
    bound: &Polynomial,
    opposite: usize,
    s: &BigRational,
) -> Outcome<()> {
    let rule = Rule::CellEdge;
    require(opposite < 3, rule, || {
        "there is no corner opposite to the edge".into()
    })?;
    let one = BigRational::one();
    require(!s.is_negative() && s <= &one, rule, || {
        "the parameter on the edge is not from 0 to 1".into()
    })?;
    let off = exponents(4)
        .into_iter()
        .enumerate()
        .filter(|(_, e)| e[opposite] > 0)
        .map(|(i, _)| i);
    coefficients(space, c, off, bound, rule)?;
    // e = 0: from corner 1 to 2; e = 1: from 0 to 2; e = 2: from 0 to 1.
    let on = (0..=4).map(|m| match opposite {
        0 => index(4 - m, m),
        1 => index(0, m),
        _ => index(m, 0),
    });
    let f: Vec<Polynomial> = on.map(|i| c[i].clone()).collect();
    let zero = Polynomial::integer(0);
    for three in f.windows(3) {
        let bend = second(&three[0], &three[1], &three[1], &three[2]);
        space.require_at_most(&bend, &zero, rule, || {
            "a second difference on the edge".into()
        })?;
    }
    let value = combine(&on_interval(4, s), &f);
    let steps: Vec<_> = f.windows(2).map(|pair| &pair[1] - &pair[0]).collect();
    let slope = combine(&on_interval(3, s), &steps).scale(&ratio(4, 1));
    for end in [BigRational::zero(), one] {
        let tangent = &value + &slope.scale(&(&end - s));
        space.require_at_most(&tangent, bound, rule, || format!("the tangent at {end}"))?;
    }
    Ok(())
}

fn concave(
    space: &Space,
    c: &[Polynomial],
    bound: &Polynomial,
    v: &BigRational,
    w: &BigRational,
) -> Outcome<()> {
    let rule = Rule::CellConcave;
    let one = BigRational::one();
    let inside = !v.is_negative() && !w.is_negative() && v + w <= one;
    require(inside, rule, || "the point is not in the triangle".into())?;
    let at = |j: usize, k: usize| &c[index(j, k)];
    let zero = Polynomial::integer(0);
    for [_, j, k] in exponents(2) {
        let aa = second(at(j + 2, k), at(j + 1, k), at(j + 1, k), at(j, k));
        let bb = second(at(j, k + 2), at(j, k + 1), at(j, k + 1), at(j, k));
        let ab = second(at(j + 1, k + 1), at(j + 1, k), at(j, k + 1), at(j, k));
        space.require_at_most(&aa, &zero, rule, || "a second derivative in v".into())?;
        space.require_at_most(&bb, &zero, rule, || "a second derivative in w".into())?;
        let definite = (&ab * &ab).is_at_most(&(&aa * &bb), &space.beta);
        require(definite, rule, || {
            let [aa, ab, bb] =
                [&aa, &ab, &bb].map(|x| crate::rational::decimal(&space.near(x), 12));
            format!("the second derivatives {aa}, {ab}, {bb} are not shown to be concave")
        })?;
    }
    let value = combine(&bernstein(4, v, w), c);
    let slope = |step: fn(usize, usize) -> usize| {
        let steps: Vec<_> = exponents(3)
            .iter()
            .map(|&[_, j, k]| &c[step(j, k)] - at(j, k))
            .collect();
        combine(&bernstein(3, v, w), &steps).scale(&ratio(4, 1))
    };
    let (slope_v, slope_w) = (slope(|j, k| index(j + 1, k)), slope(|j, k| index(j, k + 1)));
    for (x, y) in [(0, 0), (1, 0), (0, 1)] {
        let rise = &slope_v.scale(&(ratio(x, 1) - v)) + &slope_w.scale(&(ratio(y, 1) - w));
        space.require_at_most(&(&value + &rise), bound, rule, || {
            format!("the tangent plane at ({x}, {y})")
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{ConcaveName, EdgeName, HullName, Weights};

    /// The coefficients of `x0 + a v + b w + p v^2 + 2 h v w + r w^2`, raised to degree 4.
    fn quartic([x0, a, b, p, h, r]: [i64; 6]) -> Vec<Polynomial> {
        let blossom = |j: usize, k: usize| {
            let (j, k) = (j as i64, k as i64);
            let second = p * j * (j - 1) + 2 * h * j * k + r * k * (k - 1);
            ratio(x0, 1) + ratio(a * j + b * k, 4) + ratio(second, 12)
        };
        exponents(4)
            .into_iter()
            .map(|[_, j, k]| Polynomial::constant(&blossom(j, k)))
            .collect()
    }

    fn shows(c: &[Polynomial], bound: BigRational, by: &By) -> bool {
        let space = Space::rational(Weights::Warren, 6).unwrap();
        let over_q = |x: &Polynomial| &space.q * x;
        let c: Vec<_> = c.iter().map(over_q).collect();
        check(&space, &c, &space.q.scale(&bound), by).is_ok()
    }

    #[test]
    fn a_concave_quadratic_with_its_maximum_inside() {
        // 2v + 2w - 3v^2 - 3w^2 - 2vw has the maximum 1/2 at (1/4, 1/4).
        let c = quartic([0, 2, 2, -3, -1, -3]);
        let by = |v, w| By::Concave(ConcaveName::Concave, Number(v), Number(w));
        assert!(shows(&c, ratio(1, 2), &by(ratio(1, 4), ratio(1, 4))));
        assert!(!shows(
            &c,
            ratio(1, 2) - ratio(1, 1_000_000),
            &by(ratio(1, 4), ratio(1, 4))
        ));
        assert!(!shows(&c, ratio(1, 2), &by(ratio(1, 5), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2), &by(ratio(-1, 4), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2), &By::Hull(HullName::Hull)));
        // A saddle, and a valley, stay below their bound but are not concave.
        assert!(!shows(
            &quartic([0, 2, 2, -3, -4, -3]),
            ratio(9, 1),
            &by(ratio(1, 4), ratio(1, 4))
        ));
        assert!(!shows(
            &quartic([0, 0, 0, 1, 0, -1]),
            ratio(9, 1),
            &by(ratio(1, 4), ratio(1, 4))
        ));
    }

    #[test]
    fn an_edge_with_its_maximum_inside() {
        // On each edge in turn 4 s (1 - s), less 9 r away from it: the maximum is 1 at s = 1/2.
        let edges = [
            quartic([-9, 9 + 4, 9, -4, 0, 0]), // v + w = 1: 4v - 4v^2 on it, v = 1 - s
            quartic([0, -9, 4, 0, 0, -4]),     // v = 0
            quartic([0, 4, -9, -4, 0, 0]),     // w = 0
        ];
        for (e, c) in edges.iter().enumerate() {
            let by = |e, s| By::Edge(EdgeName::Edge, e, Number(s));
            assert!(shows(c, ratio(1, 1), &by(e, ratio(1, 2))), "edge {e}");
            assert!(!shows(c, ratio(1, 1), &by(e, ratio(1, 3))));
            assert!(!shows(c, ratio(1, 1), &by(e, ratio(3, 2))));
            assert!(!shows(c, ratio(1, 1), &by((e + 1) % 3, ratio(1, 2))));
            assert!(!shows(c, ratio(1, 1), &by(3, ratio(1, 2))));
            assert!(!shows(c, ratio(999, 1000), &by(e, ratio(1, 2))));
            assert!(!shows(c, ratio(1, 1), &By::Hull(HullName::Hull)));
        }
        // An asymmetric one tells the direction: s (1 - s) (2 + ..): f = 3s - 2s^2 - .., its maximum at s = 3/4.
        let c = quartic([0, 3, -9, -2, 0, 0]);
        assert!(shows(
            &c,
            ratio(9, 8),
            &By::Edge(EdgeName::Edge, 2, Number(ratio(3, 4)))
        ));
        assert!(!shows(
            &c,
            ratio(9, 8),
            &By::Edge(EdgeName::Edge, 2, Number(ratio(1, 4)))
        ));
    }
}
