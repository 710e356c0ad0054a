//! Why a bound holds over a part: the weights of a target's Bernstein coefficients in a basis, and
//! three reasons why the quartic they form stays below a number.
//!
//! Let `t(v,w) = Σ t_i B_i(v,w)` and `t_i = Σ_l x_l^i α_l` in one basis. Then
//! `‖t(v,w)‖ <= Σ_l |Σ_i x_l^i B_i| <= c(v,w) = Σ_i c_i B_i(v,w)`, `c_i = Σ_l |x_l^i|`. Where no x_l
//! changes its sign over the part, c is the value of the basis' dual net: sharp.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::functional::{ExactFunctional, FloatFunctional, Integer};
use super::value::{RingWeight, Value, value_of};
use super::word::quarter_corners;
use crate::bernstein::Patch;
use crate::bernstein::triangle::{QuarticTriangle, index};
use crate::lp::Basis;
use crate::scalar::{Field, Module, Rational};

/// Why a quartic stays below a bound over its triangle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum By {
    /// All coefficients do.
    Hull,
    /// The coefficients off one edge do; on the edge the quartic is concave and its tangent at a
    /// parameter does at both ends. Edge e is opposite to corner e.
    Edge(usize, Rational),
    /// For words shorter than k: the second differences of the word's net, d levels above k, are at most
    /// the bound over [`regular_factor`]. No quartic is involved.
    Regular,
    /// Each of the four quarters is below the bound for its own reason, in the order of letters.
    Split(Box<[By; 4]>),
    /// The quartic is concave, and its tangent plane at a point does at the three corners.
    Concave(Rational, Rational),
}

/// The weight `Σ |x_l|` of a functional in a basis; `None` if it is not in the span of the rows.
///
/// Where the sign of x_l is not certain on the fine enclosure of b, a rational at least |x_l q| takes
/// its place.
pub fn exact_weight<T: Integer>(
    weight: &RingWeight,
    t: &ExactFunctional<T>,
    basis: &Basis,
) -> Option<Value> {
    let degree = t.numerators.len();
    let polynomial = |column: &[i64]| -> Vec<T> {
        let dot = |row: &Vec<T>| {
            let mut sum = T::zero();
            for (a, &k) in row.iter().zip(column).filter(|(_, k)| **k != 0) {
                sum.add_scaled(a, k);
            }
            sum
        };
        t.numerators.iter().map(dot).collect()
    };
    let in_span = |net: &[i64]| polynomial(net).iter().all(Integer::is_zero);
    if !basis.kernel().all(in_span) {
        return None;
    }
    let mut sum = vec![T::zero(); degree];
    let mut slack = Rational::zero();
    for (_, column) in basis.row_columns() {
        let x = polynomial(column);
        match weight.sign(&x) {
            Some(sign) => {
                for (s, c) in sum.iter_mut().zip(&x) {
                    s.add_scaled(c, i64::from(sign));
                }
            }
            None => slack += weight.magnitude(&x),
        }
    }
    let denominator = BigInt::from(t.denominator) * basis.determinant().abs();
    let slack = slack / Rational::from_integer(denominator.clone());
    Some(value_of(&sum, &denominator) + &Value::new(vec![slack]))
}

/// [`exact_weight`] in `f64`: a proposal. `columns` are those of the basis' rows, divided by the
/// determinant.
pub fn float_weight(t: &FloatFunctional, columns: &[Vec<f64>]) -> f64 {
    columns.iter().map(|column| t.at(column).abs()).sum()
}

/// `C_d = 4^-d / 2` and `B_d = 4^-d / 3` of regular nets: |S - F_d| <= factor M.
///
/// Each second difference of a refined regular net is a mean of second differences over 4, so M falls
/// by 4^-1 a level, also over all parts. A step moves vertex points by at most 3/8 M and edge points by
/// M/8 off F_0, hence |F_1 - F_0| <= 3/8 M and |S - F_0| <= 3/8 (1 + 1/4 + ..) M = M/2. B_0 = 1/3 is
/// Theorem 2 of HW.
pub fn regular_factor(against: super::nets::Against, d: usize) -> Rational {
    let denominator = match against {
        super::nets::Against::Control => 2,
        super::nets::Against::Limit => 3,
    };
    Rational::new(BigInt::from(1), BigInt::from(denominator) << (2 * d))
}

/// Whether the quartic with the given coefficients is at most `bound` over its triangle, for the
/// given reason; exact.
pub fn holds(weight: &RingWeight, c: &[Value; 15], by: &By, bound: &Value) -> bool {
    let below = |value: &Value| weight.at_most(value, bound);
    match by {
        By::Hull => c.iter().all(below),
        By::Regular => false,
        By::Split(reasons) => {
            let quarters = quarters::<Rational, Value>(c);
            let pairs = quarters.iter().zip(reasons.iter());
            pairs.into_iter().all(|(c, by)| holds(weight, c, by, bound))
        }
        By::Edge(edge, at) => {
            let on = edge_indices(*edge);
            if !(0..15).all(|i| on.contains(&i) || below(&c[i])) {
                return false;
            }
            let f = on.map(|i| c[i].clone());
            let concave = f.windows(3).all(|w| {
                let second = w[0].clone() + &w[2] - &(w[1].clone() * &two());
                weight.at_most(&second, &Value::zero())
            });
            let (value, slope) = evaluate_quartic(&f, at);
            let start = value.clone() - &(slope.clone() * at);
            let end = value + &(slope * &(Rational::one() - at));
            let inside = !at.is_negative() && *at <= Rational::one();
            inside && concave && below(&start) && below(&end)
        }
        By::Concave(v, w) => {
            // Concavity is known on the triangle only.
            let inside = !v.is_negative() && !w.is_negative() && v + w <= Rational::one();
            let patch = QuarticTriangle(c.clone());
            let [vv, vw, ww] = Patch::<Rational, Value>::second_derivatives(&patch);
            let concave = (0..6).all(|i| negative_semidefinite(weight, &vv[i], &vw[i], &ww[i]));
            let (value, [gv, gw]) = patch.evaluate([v, w]);
            let origin = value - &(gv.clone() * v) - &(gw.clone() * w);
            inside
                && concave
                && below(&origin)
                && below(&(origin.clone() + &gv))
                && below(&(origin + &gw))
        }
    }
}

/// Indices of the coefficients on the edge opposite to a corner, from its lower corner to the higher.
pub fn edge_indices(edge: usize) -> [usize; 5] {
    std::array::from_fn(|i| match edge {
        0 => index(4 - i, i),
        1 => index(0, i),
        _ => index(i, 0),
    })
}

fn two() -> Rational {
    Rational::from_integer(BigInt::from(2))
}

/// Value and slope of a quartic in Bernstein form on [0, 1], by de Casteljau's algorithm.
fn evaluate_quartic(f: &[Value; 5], at: &Rational) -> (Value, Value) {
    let rest = Rational::one() - at;
    let mut level = f.to_vec();
    while level.len() > 2 {
        let mean = |pair: &[Value]| pair[0].clone() * &rest + &(pair[1].clone() * at);
        level = level.windows(2).map(mean).collect();
    }
    let slope = (level[1].clone() - &level[0]) * &Rational::from_integer(BigInt::from(4));
    (level[0].clone() * &rest + &(level[1].clone() * at), slope)
}

/// Whether [[a, b], [b, d]] has no positive eigenvalue: a <= 0, d <= 0, b^2 <= a d. The factor 1/q is
/// common to the three.
fn negative_semidefinite(weight: &RingWeight, a: &Value, b: &Value, d: &Value) -> bool {
    let zero = Value::zero();
    let product = |x: &Value, y: &Value| {
        let (x, y) = (x.coefficients(), y.coefficients());
        let mut sums = vec![Rational::zero(); x.len() + y.len()];
        for (i, p) in x.iter().enumerate() {
            for (j, q) in y.iter().enumerate() {
                sums[i + j] += p * q;
            }
        }
        Value::new(sums)
    };
    weight.at_most(a, &zero)
        && weight.at_most(d, &zero)
        && weight.at_most(&product(b, b), &product(a, d))
}

/// The Bernstein coefficients over the four quarters of the triangle, in the order of letters.
///
/// Coefficient (i, j, k) of a quarter with corners p, q, r is the blossom at i times p, j times q, k
/// times r: four de Casteljau steps, one for each argument.
pub fn quarters<S: Field, V: Module<S>>(c: &[V; 15]) -> [[V; 15]; 4] {
    let half = |[v, w]: [i64; 2]| [2 - v - w, v, w].map(|p| S::ratio(p, 2));
    std::array::from_fn(|letter| {
        let corners = quarter_corners(letter as u8).map(half);
        std::array::from_fn(|at| {
            let (i, j) = multi_index(at);
            let argument = |step: usize| match step {
                _ if step < i => &corners[0],
                _ if step < i + j => &corners[1],
                _ => &corners[2],
            };
            let mut level: Vec<V> = c.to_vec();
            for step in 0..4 {
                let [u, v, w] = argument(step);
                let rows = 3 - step;
                let mut next = Vec::with_capacity(10);
                for r in 0..=rows {
                    for k in 0..=r {
                        let (j, here) = (r - k, index(r - k, k));
                        next.push(
                            level[here].clone() * u
                                + &(level[index(j + 1, k)].clone() * v)
                                + &(level[index(j, k + 1)].clone() * w),
                        );
                    }
                }
                level = next;
            }
            level[0].clone()
        })
    })
}

/// (i, j) of the coefficient with an index.
fn multi_index(at: usize) -> (usize, usize) {
    let r = (0..=4).rfind(|r| r * (r + 1) / 2 <= at).unwrap_or(0);
    let k = at - r * (r + 1) / 2;
    (4 - r, r - k)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::LoopWeights;

    const N: u32 = 7;

    /// The coefficients of `x + a v + b w + p v^2 + 2 h v w + r w^2`, by its blossom
    /// `x + (a j + b k)/4 + (p j (j-1) + 2 h j k + r k (k-1))/12`.
    fn quadratic([x, a, b, p, h, r]: [i64; 6]) -> [Value; 15] {
        std::array::from_fn(|at| {
            let (i, j) = multi_index(at);
            let (j, k) = (j as i64, (4 - i - j) as i64);
            let twelve =
                12 * x + 3 * (a * j + b * k) + p * j * (j - 1) + 2 * h * j * k + r * k * (k - 1);
            Value::rational(N, &<Rational as Field>::ratio(twelve, 12))
        })
    }

    fn shows(c: &[Value; 15], (p, q): (i64, i64), by: &By) -> bool {
        let weight = RingWeight::new(LoopWeights::Original, N);
        holds(
            &weight,
            c,
            by,
            &Value::rational(N, &<Rational as Field>::ratio(p, q)),
        )
    }

    fn ratio(p: i64, q: i64) -> Rational {
        <Rational as Field>::ratio(p, q)
    }

    /// 3v + 3w - 4v^2 - 4vw - 4w^2: its slopes 3 - 8v - 4w and 3 - 4v - 8w vanish at (1/4, 1/4), its
    /// maximum is 3/4.
    #[test]
    fn a_concave_quadratic_and_its_maximum() {
        let c = quadratic([0, 3, 3, -4, -2, -4]);
        let at = |p, q| By::Concave(ratio(p, q), ratio(p, q));
        assert!(shows(&c, (3, 4), &at(1, 4)));
        assert!(!shows(&c, (749_999, 1_000_000), &at(1, 4)));
        assert!(!shows(&c, (3, 4), &at(1, 5)));
        assert!(!shows(&c, (9, 1), &at(2, 3)));
        assert!(!shows(&c, (3, 4), &By::Hull));
    }

    #[test]
    fn what_is_not_concave_is_not_shown_to_be() {
        // A saddle, a valley, and a mixed derivative too large for its squares.
        for c in [
            [0, 0, 0, -1, 0, 1],
            [0, 0, 0, 1, 0, -1],
            [0, 0, 0, -1, 3, -1],
        ] {
            assert!(!shows(
                &quadratic(c),
                (9, 1),
                &By::Concave(ratio(1, 4), ratio(1, 4))
            ));
        }
    }

    /// On w = 0: 4v - 4v^2, at most 1; 9 w less away from it.
    #[test]
    fn an_edge_and_its_maximum() {
        let c = quadratic([0, 4, -9, -4, 0, 0]);
        assert!(shows(&c, (1, 1), &By::Edge(2, ratio(1, 2))));
        assert!(!shows(&c, (999, 1000), &By::Edge(2, ratio(1, 2))));
        assert!(!shows(&c, (1, 1), &By::Edge(2, ratio(1, 3))));
        assert!(!shows(&c, (1, 1), &By::Edge(2, ratio(3, 2))));
        assert!(!shows(&c, (1, 1), &By::Edge(1, ratio(1, 2))));
        // Convex along the edge; and a bump off the edge.
        assert!(!shows(
            &quadratic([0, -4, -9, 4, 0, 0]),
            (1, 1),
            &By::Edge(2, ratio(1, 2))
        ));
        assert!(!shows(
            &quadratic([0, 4, 9, -4, 0, 0]),
            (1, 1),
            &By::Edge(2, ratio(1, 2))
        ));
    }

    /// Each quarter's coefficients at its corners are the quartic's values there.
    #[test]
    fn quarters_take_the_quartic_with_them() {
        let c = quadratic([1, 2, 3, -4, 5, -6]);
        let patch = QuarticTriangle(c.clone());
        for (letter, quarter) in quarters::<Rational, Value>(&c).iter().enumerate() {
            for (corner, at) in [0, 10, 14].into_iter().enumerate() {
                let [v, w] = quarter_corners(letter as u8)[corner].map(|x| ratio(x, 2));
                assert_eq!(patch.evaluate([&v, &w]).0, quarter[at]);
            }
        }
        let hulls = By::Split(Box::new([By::Hull, By::Hull, By::Hull, By::Hull]));
        assert!(shows(&quadratic([0, 1, 1, 0, 0, 0]), (1, 1), &hulls));
        assert!(!shows(&quadratic([0, 1, 1, 0, 0, 0]), (9, 10), &hulls));
    }

    /// No quartic is bounded by a reason that is not about quartics.
    #[test]
    fn regular_is_no_reason_for_a_quartic() {
        assert!(!shows(&quadratic([0; 6]), (1, 1), &By::Regular));
    }
}
