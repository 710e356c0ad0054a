//! Constants of uniform B-spline curves: the distance of a curve to its polygon.
//!
//! For an edge (P1, P2) of a control polygon, between P0 and P3, M is the larger of the second
//! differences at P1 and P2. The curve over the edge is one cubic, or the two halves of quadratics that
//! meet over its middle; C_0 and B_0 are sup |S - F| / M, F the edge itself or the chord between the
//! limit points of its ends, over the same parameters.
//!
//! **All levels.** A second difference of the refined polygon is a mean of second differences, over 4: the
//! rate is `r_k = 4^-k`, proved for one step by the least weights of the new differences, and attained
//! by the polygons with constant second differences, which stay so. If such a polygon attains C_0 too,
//! then `C_k = 4^-k C_0`.
//!
//! The two rows are independent, so multipliers are unique; where none changes its sign over a piece,
//! `sup |S - F| / M` at a parameter is the polynomial `Σ_i (Σ_l |x_l^i|) B_i` there.
//!
//! Source: CY (1), (2) and LN Theorem 1 (cubic, against the polygon: 1/6); LN Theorem 4 (quadratic: 1/8);
//! against the limit points derived here.

use num_traits::{Signed, Zero};

use super::nets::Against;
use crate::bernstein::midpoint;
use crate::lp::Rows;
use crate::scalar::{Field, Rational, Ring};
use crate::scheme::IntegerRow;
use crate::scheme::curve::{self, Degree, Ends};

/// Points of the net of an edge.
const POINTS: usize = 4;

/// A constant of curves at level 0, and the rate of one step.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveConstant {
    /// C_0 or B_0, in the norm of second differences.
    pub value: Rational,
    /// r_1; `C_k = r_1^k C_0`.
    pub rate: Rational,
    /// Where the constant is attained, on the edge from P1 (0) to P2 (1).
    pub at: Rational,
}

impl CurveConstant {
    /// The constant of level k, `r_1^k` times that of level 0.
    pub fn level(&self, k: usize) -> Rational {
        (0..k).fold(self.value.clone(), |value, _| value * &self.rate)
    }
}

fn rows() -> Rows {
    let row = |at: usize| IntegerRow::new([(at - 1, -1), (at, 2), (at + 1, -1)]);
    Rows::new(vec![row(1), row(2)], POINTS)
}

/// The Bernstein coefficients of S over the pieces of an edge, in order.
fn pieces(degree: Degree, net: &[Rational]) -> Vec<Vec<Rational>> {
    let segment = |points: &[Rational]| {
        let all = curve::bezier_segment::<Rational, Rational>(degree, Ends::Open, points, 0);
        all.to_vec()
    };
    match degree {
        Degree::Cubic => vec![segment(net)],
        Degree::Quadratic => {
            let half = |c: &[Rational]| {
                let (a, b) = (
                    midpoint::<Rational, _>(&c[0], &c[1]),
                    midpoint::<Rational, _>(&c[1], &c[2]),
                );
                let middle = midpoint::<Rational, _>(&a, &b);
                [[c[0].clone(), a, middle.clone()], [middle, b, c[2].clone()]]
            };
            let [_, before] = half(&segment(&net[..3]));
            let [after, _] = half(&segment(&net[1..]));
            vec![before.to_vec(), after.to_vec()]
        }
    }
}

/// The Bernstein coefficients of S - F over the pieces.
fn difference(degree: Degree, against: Against, net: &[Rational]) -> Vec<Vec<Rational>> {
    let pieces = pieces(degree, net);
    let ends = match against {
        Against::Control => [net[1].clone(), net[2].clone()],
        Against::Limit => {
            let last = pieces[pieces.len() - 1].last();
            [pieces[0][0].clone(), last.expect("coefficients").clone()]
        }
    };
    let count = pieces.len() as i64;
    let minus = |(piece, surface): (i64, Vec<Rational>)| -> Vec<Rational> {
        let d = surface.len() as i64 - 1;
        let node = |i: i64| {
            let s = Rational::ratio(piece * d + i, count * d);
            &ends[0] + (&ends[1] - &ends[0]) * s
        };
        (0..).zip(surface).map(|(i, s)| s - node(i)).collect()
    };
    (0..).zip(pieces).map(minus).collect()
}

/// The value of a functional at each unit net: its coefficients.
fn coefficients<T>(of: impl Fn(&[Rational]) -> T) -> Vec<T> {
    let unit = |point: usize| -> Vec<Rational> {
        let at = |i: usize| <Rational as Ring>::from_integer(i64::from(i == point));
        (0..POINTS).map(at).collect()
    };
    (0..POINTS).map(|point| of(&unit(point))).collect()
}

/// The largest value of a polynomial on [0, 1] and where: at an end if no coefficient is larger; else at
/// 1/2 if it is concave and flat there.
fn maximum(c: &[Rational]) -> Option<(Rational, Rational)> {
    let largest = c.iter().max()?;
    for (end, at) in [(0, 0), (c.len() - 1, 1)] {
        if c[end] == *largest {
            return Some((largest.clone(), Rational::ratio(at, 1)));
        }
    }
    let two = Rational::ratio(2, 1);
    let concave = c
        .windows(3)
        .all(|w| !(&w[0] + &w[2] - &w[1] * &two).is_positive());
    let mut level = c.to_vec();
    while level.len() > 2 {
        level = level
            .windows(2)
            .map(|pair| (&pair[0] + &pair[1]) / &two)
            .collect();
    }
    let flat = level[0] == level[1];
    (concave && flat).then(|| (level[0].clone(), Rational::ratio(1, 2)))
}

/// A constant of a curve; `None` if the argument above does not apply (it does for both degrees).
///
/// ```
/// use subcert::bound::Against;
/// use subcert::bound::curve::curve_constant;
/// use subcert::scalar::{Field, Rational};
/// use subcert::scheme::curve::Degree;
/// // LN Theorem 1: |L - C| <= M/6, and no less will do.
/// let constant = curve_constant(Degree::Cubic, Against::Control).unwrap();
/// assert_eq!(constant.value, Rational::ratio(1, 6));
/// assert_eq!(constant.level(2), Rational::ratio(1, 96));
/// ```
pub fn curve_constant(degree: Degree, against: Against) -> Option<CurveConstant> {
    let rows = rows();
    let by_point = coefficients(|net| difference(degree, against, net));
    let pieces = by_point[0].len();
    let mut best: Option<(Rational, Rational)> = None;
    for piece in 0..pieces {
        let count = by_point[0][piece].len();
        let mut weights = Vec::with_capacity(count);
        let mut signs = vec![0i32; rows.rows().len()];
        for i in 0..count {
            let t: Vec<Rational> = by_point.iter().map(|of| of[piece][i].clone()).collect();
            let solution = rows.minimise(&t, rows.start())?;
            for (sign, x) in signs.iter_mut().zip(&solution.x) {
                let own = i32::from(x.is_positive()) - i32::from(x.is_negative());
                if own * *sign < 0 {
                    return None;
                }
                *sign += own;
            }
            weights.push(solution.value);
        }
        // The polygon of constant second differences attains the weights, if all signs agree.
        if signs.iter().any(|a| signs.iter().any(|b| a * b < 0)) {
            return None;
        }
        let (value, at) = maximum(&weights)?;
        let along = (Rational::ratio(piece as i64, 1) + at) / Rational::ratio(pieces as i64, 1);
        if best.as_ref().is_none_or(|(known, _)| value > *known) {
            best = Some((value, along));
        }
    }
    let (value, at) = best?;
    Some(CurveConstant {
        value,
        rate: rate(degree)?,
        at,
    })
}

/// The largest weight of a second difference after one step.
fn rate(degree: Degree) -> Option<Rational> {
    let rows = rows();
    let refined = coefficients(|net| {
        let next = curve::refine::<Rational, Rational>(degree, Ends::Open, net);
        let second = |w: &[Rational]| &w[1] * Rational::ratio(2, 1) - &w[0] - &w[2];
        next.windows(3).map(second).collect::<Vec<_>>()
    });
    let mut largest = Rational::zero();
    for l in 0..refined[0].len() {
        let t: Vec<Rational> = refined.iter().map(|of| of[l].clone()).collect();
        largest = largest.max(rows.minimise(&t, rows.start())?.value);
    }
    Some(largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cubic: 1/6 at the ends, and 1/8 in the middle of a chord, as |C''| <= M. Quadratic: 1/8 at the
    /// vertices (LN Theorem 4). Between its limit points the quadratic touches the edge in the middle,
    /// and with constant second differences 1 the limit points are 1/8 off the polygon: 1/8 again.
    #[test]
    fn curves_in_closed_form() {
        let quarter = Rational::ratio(1, 4);
        for (degree, against, value, at) in [
            (Degree::Cubic, Against::Control, (1, 6), (0, 1)),
            (Degree::Cubic, Against::Limit, (1, 8), (1, 2)),
            (Degree::Quadratic, Against::Control, (1, 8), (0, 1)),
            (Degree::Quadratic, Against::Limit, (1, 8), (1, 2)),
        ] {
            let constant = curve_constant(degree, against).expect("a constant");
            let ratio = |(p, q)| Rational::ratio(p, q);
            assert_eq!(constant.value, ratio(value), "{degree:?} {against:?}");
            assert_eq!(constant.at, ratio(at), "{degree:?} {against:?}");
            assert_eq!(constant.rate, quarter);
        }
    }

    /// Parabolas attain every level: their second differences stay constant.
    #[test]
    fn parabolas_attain_the_rate() {
        for degree in [Degree::Cubic, Degree::Quadratic] {
            let mut net: Vec<Rational> = (0..6).map(|i| Rational::ratio(i * i, 2)).collect();
            for k in 0..4 {
                let second = |w: &[Rational]| (&w[1] * Rational::ratio(2, 1) - &w[0] - &w[2]).abs();
                let largest = net.windows(3).map(second).max().expect("points");
                assert_eq!(largest, Rational::ratio(1, 1 << (2 * k)));
                net = curve::refine::<Rational, Rational>(degree, Ends::Open, &net);
            }
        }
    }
}
