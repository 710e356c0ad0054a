//! Why a bound holds over a part: the weights of a target's Bernstein coefficients in a basis, and
//! three reasons why the polynomial they form stays below a number.
//!
//! Let `t(v,w) = Σ t_i B_i(v,w)` and `t_i = Σ_l x_l^i α_l` in one basis. Then
//! `‖t(v,w)‖ <= Σ_l |Σ_i x_l^i B_i| <= c(v,w) = Σ_i c_i B_i(v,w)`, `c_i = Σ_l |x_l^i|`. Where no x_l
//! changes its sign over the part, c is the value of the basis' dual net: sharp.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::functional::{ExactFunctional, FloatFunctional, Integer};
use super::shape::Shape;
use super::value::{Numbers, Value, value_of};
use crate::lp::Basis;
use crate::scalar::Rational;

/// Why a polynomial stays below a bound over its domain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum By {
    /// All coefficients do.
    Hull,
    /// The coefficients off one edge do; on the edge the polynomial is concave and its tangent at a
    /// parameter does at both ends. Edges as in [`Shape::edge`].
    Edge(usize, Rational),
    /// For words shorter than k: the differences of the word's net, d levels above k, are at most the
    /// bound over the factor of regular nets. No polynomial is involved.
    Regular,
    /// Each of the four quarters is below the bound for its own reason, in the order of letters.
    Split(Box<[By; 4]>),
    /// The polynomial is concave, and its tangent plane at a point does at the corners.
    Concave(Rational, Rational),
}

/// The weight `Σ |x_l|` of a functional in a basis; `None` if it is not in the span of the rows.
///
/// Where the sign of x_l is not certain on the fine enclosures, a rational at least |x_l q| takes its
/// place.
pub fn exact_weight<T: Integer>(
    numbers: &Numbers,
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
        match numbers.sign(&x) {
            Some(sign) => {
                for (s, c) in sum.iter_mut().zip(&x) {
                    s.add_scaled(c, i64::from(sign));
                }
            }
            None => slack += numbers.magnitude(&x),
        }
    }
    let denominator = &t.denominator * basis.determinant().abs();
    let slack = slack / Rational::from_integer(denominator.clone());
    Some(value_of(&sum, &denominator) + &Value::new(vec![slack]))
}

/// [`exact_weight`] in `f64`: a proposal. `columns` are those of the basis' rows, divided by the
/// determinant.
pub fn float_weight(t: &FloatFunctional, columns: &[Vec<f64>]) -> f64 {
    columns.iter().map(|column| t.at(column).abs()).sum()
}

/// Whether the polynomial with the given coefficients is at most `bound` over its domain, for the
/// given reason; exact.
pub fn holds(numbers: &Numbers, shape: Shape, c: &[Value], by: &By, bound: &Value) -> bool {
    let below = |value: &Value| numbers.at_most(value, bound);
    match by {
        By::Hull => c.iter().all(below),
        By::Regular => false,
        By::Split(reasons) => {
            let quarters = shape.quarters::<Rational, Value>(c);
            let mut pairs = quarters.iter().zip(reasons.iter());
            pairs.all(|(c, by)| holds(numbers, shape, c, by, bound))
        }
        By::Edge(edge, at) => {
            let on = shape.edge(*edge);
            if !(0..c.len()).all(|i| on.contains(&i) || below(&c[i])) {
                return false;
            }
            let f: Vec<Value> = on.iter().map(|&i| c[i].clone()).collect();
            let concave = f.windows(3).all(|w| {
                let second = w[0].clone() + &w[2] - &(w[1].clone() * &integer(2));
                numbers.at_most(&second, &Value::zero())
            });
            let (value, slope) = evaluate_edge(&f, at);
            let start = value.clone() - &(slope.clone() * at);
            let end = value + &(slope * &(Rational::one() - at));
            let inside = !at.is_negative() && *at <= Rational::one();
            inside && concave && below(&start) && below(&end)
        }
        By::Concave(v, w) => {
            // Concavity is known on the domain only.
            let inside = shape.contains([v, w]);
            let [vv, vw, ww] = shape.second_derivatives::<Rational, Value>(c);
            let definite = |i: usize| negative_semidefinite(numbers, &vv[i], &vw[i], &ww[i]);
            let concave = (0..vv.len()).all(definite);
            let (value, [gv, gw]) = shape.evaluate(c, [v, w]);
            let origin = value - &(gv.clone() * v) - &(gw.clone() * w);
            let tangent = |&[x, y]: &[i64; 2]| {
                origin.clone() + &(gv.clone() * &integer(x)) + &(gw.clone() * &integer(y))
            };
            inside
                && concave
                && shape
                    .corners()
                    .iter()
                    .map(tangent)
                    .all(|value| below(&value))
        }
    }
}

fn integer(k: i64) -> Rational {
    Rational::from_integer(BigInt::from(k))
}

/// Value and slope of a polynomial in Bernstein form on [0, 1], by de Casteljau's algorithm.
fn evaluate_edge(f: &[Value], at: &Rational) -> (Value, Value) {
    let rest = Rational::one() - at;
    let mut level = f.to_vec();
    while level.len() > 2 {
        let mean = |pair: &[Value]| pair[0].clone() * &rest + &(pair[1].clone() * at);
        level = level.windows(2).map(mean).collect();
    }
    let degree = integer(f.len() as i64 - 1);
    let slope = (level[1].clone() - &level[0]) * &degree;
    (level[0].clone() * &rest + &(level[1].clone() * at), slope)
}

/// Whether [[a, b], [b, d]] has no positive eigenvalue: a <= 0, d <= 0, b^2 <= a d. The factor 1/q is
/// common to the three.
fn negative_semidefinite(numbers: &Numbers, a: &Value, b: &Value, d: &Value) -> bool {
    let zero = Value::zero();
    numbers.at_most(a, &zero)
        && numbers.at_most(d, &zero)
        && numbers.at_most(&numbers.product(b, b), &numbers.product(a, d))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Field;
    use crate::scheme::LoopWeights;

    const SHAPES: [Shape; 3] = [Shape::Triangle, Shape::Bicubic, Shape::Biquadratic];

    fn numbers() -> Numbers {
        Numbers::of_loop(LoopWeights::Original, 7)
    }

    /// The coefficients of `x + a v + b w + p v^2 + 2 h v w + r w^2`, by its blossom. With d the degree and
    /// (j, k) the node: v -> j/d, w -> k/d, v^2 -> j (j-1)/(d (d-1)), and v w -> j k/(d (d-1)) on the
    /// triangle, j k/d^2 on the square.
    fn quadratic(shape: Shape, [x, a, b, p, h, r]: [i64; 6]) -> Vec<Value> {
        let d = shape.degree() as i64;
        let mixed = match shape {
            Shape::Triangle => d * (d - 1),
            _ => d * d,
        };
        let at = |at: usize| {
            let [j, k] = shape.node(at);
            let squares = ratio(p * j * (j - 1) + r * k * (k - 1), d * (d - 1));
            let value = ratio(x * d + a * j + b * k, d) + squares + ratio(2 * h * j * k, mixed);
            numbers().constant(&value)
        };
        (0..shape.count()).map(at).collect()
    }

    fn shows(shape: Shape, c: &[Value], (p, q): (i64, i64), by: &By) -> bool {
        let numbers = numbers();
        holds(&numbers, shape, c, by, &numbers.constant(&ratio(p, q)))
    }

    fn ratio(p: i64, q: i64) -> Rational {
        <Rational as Field>::ratio(p, q)
    }

    /// 3v + 3w - 4v^2 - 4vw - 4w^2: its slopes 3 - 8v - 4w and 3 - 4v - 8w vanish at (1/4, 1/4), its
    /// maximum is 3/4.
    #[test]
    fn a_concave_quadratic_and_its_maximum() {
        for shape in SHAPES {
            let c = quadratic(shape, [0, 3, 3, -4, -2, -4]);
            let at = |p, q| By::Concave(ratio(p, q), ratio(p, q));
            assert!(shows(shape, &c, (3, 4), &at(1, 4)));
            assert!(!shows(shape, &c, (749_999, 1_000_000), &at(1, 4)));
            assert!(!shows(shape, &c, (3, 4), &at(1, 5)));
            assert!(!shows(shape, &c, (99, 1), &at(4, 3)));
            assert!(!shows(shape, &c, (3, 4), &By::Hull));
        }
    }

    #[test]
    fn what_is_not_concave_is_not_shown_to_be() {
        // A saddle, a valley, and a mixed derivative too large for its squares.
        for shape in SHAPES {
            for c in [
                [0, 0, 0, -1, 0, 1],
                [0, 0, 0, 1, 0, -1],
                [0, 0, 0, -1, 3, -1],
            ] {
                let by = By::Concave(ratio(1, 4), ratio(1, 4));
                assert!(!shows(shape, &quadratic(shape, c), (99, 1), &by));
            }
        }
    }

    /// On w = 0: 4v - 4v^2, at most 1; 9 w less away from it.
    #[test]
    fn an_edge_and_its_maximum() {
        for shape in SHAPES {
            let edge = if shape == Shape::Triangle { 2 } else { 0 };
            let by = |edge, p, q| By::Edge(edge, ratio(p, q));
            let c = quadratic(shape, [0, 4, -9, -4, 0, 0]);
            assert!(shows(shape, &c, (1, 1), &by(edge, 1, 2)));
            assert!(!shows(shape, &c, (999, 1000), &by(edge, 1, 2)));
            assert!(!shows(shape, &c, (1, 1), &by(edge, 1, 3)));
            assert!(!shows(shape, &c, (1, 1), &by(edge, 3, 2)));
            assert!(!shows(shape, &c, (1, 1), &by(1, 1, 2)));
            // Convex along the edge; and a bump off the edge.
            let convex = quadratic(shape, [0, -4, -9, 4, 0, 0]);
            assert!(!shows(shape, &convex, (1, 1), &by(edge, 1, 2)));
            let bump = quadratic(shape, [0, 4, 9, -4, 0, 0]);
            assert!(!shows(shape, &bump, (1, 1), &by(edge, 1, 2)));
        }
    }

    /// Every edge runs as it says: v, then w, then against v, then against w, on the square.
    #[test]
    fn edges_of_the_square() {
        for shape in [Shape::Bicubic, Shape::Biquadratic] {
            for edge in 0..4 {
                let nodes: Vec<[i64; 2]> =
                    shape.edge(edge).iter().map(|&i| shape.node(i)).collect();
                let d = shape.degree() as i64;
                let corner = |e: usize| shape.corners()[e % 4].map(|x| x * d);
                assert_eq!(nodes[0], corner(edge));
                assert_eq!(nodes[nodes.len() - 1], corner(edge + 1));
            }
        }
    }

    /// Each quarter's coefficients at its corners are the polynomial's values there.
    #[test]
    fn quarters_take_the_polynomial_with_them() {
        for shape in SHAPES {
            let c = quadratic(shape, [1, 2, 3, -4, 5, -6]);
            for (letter, quarter) in shape.quarters::<Rational, Value>(&c).iter().enumerate() {
                let corners = shape.quarter(letter as u8).iter();
                for (corner, at) in corners.zip(shape.corner_indices()) {
                    let [v, w] = corner.map(|x| ratio(x, 2));
                    assert_eq!(shape.evaluate(&c, [&v, &w]).0, quarter[at]);
                }
            }
            let hulls = By::Split(Box::new([By::Hull, By::Hull, By::Hull, By::Hull]));
            let plane = quadratic(shape, [0, 1, 1, 0, 0, 0]);
            let largest = if shape == Shape::Triangle { 1 } else { 2 };
            assert!(shows(shape, &plane, (largest, 1), &hulls));
            assert!(!shows(shape, &plane, (9 * largest, 10), &hulls));
        }
    }

    /// No polynomial is bounded by a reason that is not about polynomials.
    #[test]
    fn regular_is_no_reason_for_a_polynomial() {
        let flat = quadratic(Shape::Triangle, [0; 6]);
        assert!(!shows(Shape::Triangle, &flat, (1, 1), &By::Regular));
    }
}
