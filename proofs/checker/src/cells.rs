//! Cells: a quartic of weights is at most the bound on its triangle, shown in one of four ways.

use std::iter::repeat_n;

use num_rational::BigRational;
use num_traits::Zero;

use crate::file::{By, Name, Number};
use crate::polynomial::Polynomial;
use crate::rational::{decimal, ratio};
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::space::Space;
use crate::word::{Triangle, barycentric, bernstein, exponents, index, is_in_triangle};

/// The most splits inside each other.
const SPLITS: usize = 12;

type Bound<'a> = &'a Polynomial;

/// Shows that the quartic with the coefficients `c / q` is at most `bound / q`.
///
/// # Errors
///
/// If and only if it is not shown: rule `cell-hull`, `cell-edge`, `cell-concave`, `cell-split` (if
/// that is what is wrong), for "regular" `cell-regular`, for a way that there is not `format`; or the
/// work allowed is used up.
pub fn check(space: &Space, c: &[Polynomial], bound: Bound, by: &By, splits: usize) -> Outcome<()> {
    space.charge(64 * c.iter().map(Polynomial::cost).sum::<u64>())?;
    match by {
        By::Alone(Name::Hull) => hull(space, c, bound, Rule::CellHull, |_| true),
        By::Edge(Name::Edge, opposite, Number(s)) => edge(space, c, bound, *opposite, s),
        By::Concave(Name::Concave, Number(v), Number(w)) => concave(space, c, bound, v, w),
        By::Split(Name::Split, quarters) => split(space, c, bound, quarters, splits),
        By::Alone(Name::Regular) => Err(Rejection::new(Rule::CellRegular, "inside a split")),
        _ => Err(Rejection::new(Rule::Format, "there is no such way to show a cell")),
    }
}

/// The coefficients with these exponents are at most the bound.
fn hull(
    space: &Space,
    c: &[Polynomial],
    bound: Bound,
    rule: Rule,
    these: impl Fn(&[usize; 3]) -> bool,
) -> Outcome<()> {
    let these = exponents(4).into_iter().zip(c).enumerate().filter(|(_, (e, _))| these(e));
    for (i, (_, c)) in these {
        space.at_most(c, bound, rule, format_args!("coefficient {i}"))?;
    }
    Ok(())
}

/// `Σ weights_i c_i`.
fn combine(weights: &[BigRational], c: &[Polynomial]) -> Polynomial {
    let terms = weights.iter().zip(c).map(|(x, c)| c.scale(x));
    terms.fold(Polynomial::integer(0), |sum, term| &sum + &term)
}

/// `a - x - y + c`.
fn second(a: &Polynomial, x: &Polynomial, y: &Polynomial, c: &Polynomial) -> Polynomial {
    &(a + c) - &(x + y)
}

/// The Bernstein polynomials of a degree on [0, 1] at s: those of the triangle on w = 0.
fn on_interval(degree: usize, s: &BigRational) -> Vec<BigRational> {
    let values = bernstein(degree, s, &BigRational::zero());
    (0..=degree).map(|j| values[index(j, 0)].clone()).collect()
}

fn edge(
    space: &Space,
    c: &[Polynomial],
    bound: Bound,
    opposite: usize,
    s: &BigRational,
) -> Outcome<()> {
    let rule = Rule::CellEdge;
    let valid = opposite < 3 && is_in_triangle(s, &BigRational::zero());
    ensure!(valid, rule, "there is no such edge, or no such point on it");
    hull(space, c, bound, rule, |e| e[opposite] > 0)?;
    let on = |m: usize| match opposite {
        0 => index(4 - m, m), // from corner 1 to 2
        1 => index(0, m),     // from corner 0 to 2
        _ => index(m, 0),     // from corner 0 to 1
    };
    let f: Vec<_> = (0..=4).map(|m| c[on(m)].clone()).collect();
    for three in f.windows(3) {
        let bend = second(&three[0], &three[1], &three[1], &three[2]);
        space.at_most(&bend, &Polynomial::integer(0), rule, "a second difference on the edge")?;
    }
    let value = combine(&on_interval(4, s), &f);
    let steps: Vec<_> = f.windows(2).map(|pair| &pair[1] - &pair[0]).collect();
    let slope = combine(&on_interval(3, s), &steps).scale(&ratio(4, 1));
    for end in [0, 1] {
        let tangent = &value + &slope.scale(&(ratio(end, 1) - s));
        space.at_most(&tangent, bound, rule, format_args!("the tangent at {end}"))?;
    }
    Ok(())
}

fn concave(
    space: &Space,
    c: &[Polynomial],
    bound: Bound,
    v: &BigRational,
    w: &BigRational,
) -> Outcome<()> {
    let rule = Rule::CellConcave;
    ensure!(is_in_triangle(v, w), rule, "the point is not in the triangle");
    let at = |j: usize, k: usize| &c[index(j, k)];
    let zero = Polynomial::integer(0);
    for [_, j, k] in exponents(2) {
        let aa = second(at(j + 2, k), at(j + 1, k), at(j + 1, k), at(j, k));
        let bb = second(at(j, k + 2), at(j, k + 1), at(j, k + 1), at(j, k));
        let ab = second(at(j + 1, k + 1), at(j + 1, k), at(j, k + 1), at(j, k));
        space.at_most(&aa, &zero, rule, "a second derivative in v")?;
        space.at_most(&bb, &zero, rule, "a second derivative in w")?;
        let [square, product] = [&ab * &ab, &aa * &bb];
        let definite = (&square - &product).is_at_most_zero(&space.beta);
        let [aa, ab, bb] = [aa, ab, bb].map(|x| decimal(&space.near(&x), 12));
        ensure!(definite, rule, "second derivatives {aa}, {ab}, {bb}: not shown to be concave");
    }
    let value = combine(&bernstein(4, v, w), c);
    let slope = |step: [usize; 2]| {
        let rise = |&[_, j, k]: &[usize; 3]| at(j + step[0], k + step[1]) - at(j, k);
        let rises: Vec<_> = exponents(3).iter().map(rise).collect();
        combine(&bernstein(3, v, w), &rises).scale(&ratio(4, 1))
    };
    let (slope_v, slope_w) = (slope([1, 0]), slope([0, 1]));
    for (x, y) in [(0, 0), (1, 0), (0, 1)] {
        let rise = &slope_v.scale(&(ratio(x, 1) - v)) + &slope_w.scale(&(ratio(y, 1) - w));
        space.at_most(&(&value + &rise), bound, rule, format_args!("the plane at ({x}, {y})"))?;
    }
    Ok(())
}

/// Each quarter in its way.
fn split(
    space: &Space,
    c: &[Polynomial],
    bound: Bound,
    quarters: &[By; 4],
    splits: usize,
) -> Outcome<()> {
    let rule = Rule::CellSplit;
    ensure!(splits < SPLITS, rule, "more than {SPLITS} splits inside each other");
    for (letter, by) in (0..).zip(quarters) {
        let inner = |fault: Rejection| {
            Rejection::new(fault.rule, format!("quarter {letter}: {}", fault.why))
        };
        check(space, &restricted(c, letter), bound, by, splits + 1).map_err(inner)?;
    }
    Ok(())
}

/// The coefficients on a quarter: (i, j, k) is the blossom at i, j, k times its corners 0, 1, 2.
fn restricted(c: &[Polynomial], letter: u8) -> Vec<Polynomial> {
    let corners = Triangle::of(&[letter]).0.map(|[v, w]| barycentric(&v, &w));
    // One argument of the blossom, a point with barycentric coordinates, is put in.
    let put_in = |c: Vec<Polynomial>, (degree, point): (usize, &[BigRational; 3])| {
        let three = |[_, j, k]: [usize; 3]| {
            [index(j, k), index(j + 1, k), index(j, k + 1)].map(|i| c[i].clone())
        };
        exponents(degree).into_iter().map(|e| combine(point, &three(e))).collect()
    };
    let blossom = |times: [usize; 3]| {
        let points = corners.iter().zip(times).flat_map(|(corner, i)| repeat_n(corner, i));
        (0..4).rev().zip(points).fold(c.to_vec(), put_in).swap_remove(0)
    };
    exponents(4).into_iter().map(blossom).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cosine::rational_beta;
    use crate::file::{Number, Weights};
    use crate::polynomial::Beta;

    /// The coefficients of `x0 + a v + b w + p v^2 + 2 h v w + r w^2`, raised to degree 4.
    fn quartic([x0, a, b, p, h, r]: [i64; 6]) -> Vec<Polynomial> {
        let blossom = |j: usize, k: usize| {
            let (j, k) = (j as i64, k as i64);
            let second = p * j * (j - 1) + 2 * h * j * k + r * k * (k - 1);
            ratio(x0, 1) + ratio(a * j + b * k, 4) + ratio(second, 12)
        };
        exponents(4).into_iter().map(|[_, j, k]| Polynomial::constant(&blossom(j, k))).collect()
    }

    fn shows(c: &[Polynomial], bound: BigRational, by: &By) -> bool {
        let space = Space::of(6, Beta::exact(&rational_beta(Weights::Warren, 6).unwrap()));
        let over_q = |x: &Polynomial| &space.q * x;
        let c: Vec<_> = c.iter().map(over_q).collect();
        check(&space, &c, &space.q.scale(&bound), by, 0).is_ok()
    }

    #[test]
    fn a_concave_quadratic_with_its_maximum_inside() {
        // 2v + 2w - 3v^2 - 3w^2 - 2vw has the maximum 1/2 at (1/4, 1/4).
        let c = quartic([0, 2, 2, -3, -1, -3]);
        let by = |v, w| By::Concave(Name::Concave, Number(v), Number(w));
        assert!(shows(&c, ratio(1, 2), &by(ratio(1, 4), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2) - ratio(1, 1_000_000), &by(ratio(1, 4), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2), &by(ratio(1, 5), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2), &by(ratio(-1, 4), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2), &By::Alone(Name::Hull)));
        // A saddle, and a valley, stay below their bound but are not concave.
        assert!(!shows(
            &quartic([0, 2, 2, -3, -4, -3]),
            ratio(9, 1),
            &by(ratio(1, 4), ratio(1, 4))
        ));
        assert!(!shows(&quartic([0, 0, 0, 1, 0, -1]), ratio(9, 1), &by(ratio(1, 4), ratio(1, 4))));
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
            let by = |e, s| By::Edge(Name::Edge, e, Number(s));
            assert!(shows(c, ratio(1, 1), &by(e, ratio(1, 2))), "edge {e}");
            assert!(!shows(c, ratio(1, 1), &by(e, ratio(1, 3))));
            assert!(!shows(c, ratio(1, 1), &by(e, ratio(3, 2))));
            assert!(!shows(c, ratio(1, 1), &by((e + 1) % 3, ratio(1, 2))));
            assert!(!shows(c, ratio(1, 1), &by(3, ratio(1, 2))));
            assert!(!shows(c, ratio(999, 1000), &by(e, ratio(1, 2))));
            assert!(!shows(c, ratio(1, 1), &By::Alone(Name::Hull)));
        }
        // An asymmetric one tells the direction: s (1 - s) (2 + ..): f = 3s - 2s^2 - .., its maximum at s = 3/4.
        let c = quartic([0, 3, -9, -2, 0, 0]);
        assert!(shows(&c, ratio(9, 8), &By::Edge(Name::Edge, 2, Number(ratio(3, 4)))));
        assert!(!shows(&c, ratio(9, 8), &By::Edge(Name::Edge, 2, Number(ratio(1, 4)))));
    }
}
