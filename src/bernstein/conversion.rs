//! From the control net of a regular patch to its Bézier points.
//!
//! | patch | net | Bézier points | rows over | order of the net |
//! |---|---|---|---|---|
//! | Loop, quartic box spline | 12 | 15 | 24 | rows p1 p2 / p3 p4 p5 / p6 p7 p8 p9 / p10 p11 p12, face {p4, p7, p8} |
//! | Catmull-Clark, bicubic | 4x4 | 4x4 | 36 | `4 j + i`: i along u, j along v |
//! | Doo-Sabin, biquadratic | 3x3 | 3x3 | 4 | `3 j + i` |
//! | cubic curve | 4 | 4 | 6 | along t |
//! | quadratic curve | 3 | 3 | 2 | along t |
//!
//! Every row is a convex combination: its entries are nonnegative and sum to the denominator.
//! The tables are constants; `tests/bezier_conversion.rs` derives each from the subdivision rules
//! alone (refine exactly, push to the limit, interpolate) and compares entry by entry.

use super::from_net;
use crate::scalar::{Field, Module};

/// The common denominator of [`BOX_SPLINE_ROWS`].
pub const BOX_SPLINE_DENOMINATOR: i64 = 24;

/// Row b, column p: 24 times the weight of control point p in Bézier point b.
///
/// Bézier points in HW's order: the coefficient of `u^i v^j w^k`, u = 1 - v - w, i + j + k = 4, has
/// the 0-based index `(j+k)(j+k+1)/2 + k`. Index 0 lies at p4, index 10 at p7, index 14 at p8.
///
/// Source: HW Appendix 1; derived independently in the tests.
pub const BOX_SPLINE_ROWS: [[i64; 12]; 15] = [
    [2, 2, 2, 12, 2, 0, 2, 2, 0, 0, 0, 0],
    [1, 0, 3, 12, 1, 0, 4, 3, 0, 0, 0, 0],
    [0, 1, 1, 12, 3, 0, 3, 4, 0, 0, 0, 0],
    [0, 0, 4, 8, 0, 0, 8, 4, 0, 0, 0, 0],
    [0, 0, 1, 10, 1, 0, 6, 6, 0, 0, 0, 0],
    [0, 0, 0, 8, 4, 0, 4, 8, 0, 0, 0, 0],
    [0, 0, 3, 4, 0, 1, 12, 3, 0, 0, 1, 0],
    [0, 0, 1, 6, 0, 0, 10, 6, 0, 0, 1, 0],
    [0, 0, 0, 6, 1, 0, 6, 10, 0, 0, 1, 0],
    [0, 0, 0, 4, 3, 0, 3, 12, 1, 0, 1, 0],
    [0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2, 0],
    [0, 0, 1, 3, 0, 0, 12, 4, 0, 1, 3, 0],
    [0, 0, 0, 4, 0, 0, 8, 8, 0, 0, 4, 0],
    [0, 0, 0, 3, 1, 0, 4, 12, 0, 0, 3, 1],
    [0, 0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2],
];

/// The common denominator of [`CUBIC_ROWS`].
pub const CUBIC_DENOMINATOR: i64 = 6;

/// Six times the weights of a uniform cubic B-spline segment's control points in its Bézier points.
pub const CUBIC_ROWS: [[i64; 4]; 4] = [[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]];

/// The common denominator of [`QUADRATIC_ROWS`].
pub const QUADRATIC_DENOMINATOR: i64 = 2;

/// Twice the weights of a uniform quadratic B-spline segment's control points in its Bézier points.
pub const QUADRATIC_ROWS: [[i64; 3]; 3] = [[1, 1, 0], [0, 2, 0], [0, 1, 1]];

/// The common denominator of [`BICUBIC_ROWS`].
pub const BICUBIC_DENOMINATOR: i64 = CUBIC_DENOMINATOR * CUBIC_DENOMINATOR;

/// Entry `(4 j + i, 4 l + k)` is `CUBIC_ROWS[i][k] · CUBIC_ROWS[j][l]`.
pub const BICUBIC_ROWS: [[i64; 16]; 16] = tensor(CUBIC_ROWS);

/// The common denominator of [`BIQUADRATIC_ROWS`].
pub const BIQUADRATIC_DENOMINATOR: i64 = QUADRATIC_DENOMINATOR * QUADRATIC_DENOMINATOR;

/// Entry `(3 j + i, 3 l + k)` is `QUADRATIC_ROWS[i][k] · QUADRATIC_ROWS[j][l]`.
pub const BIQUADRATIC_ROWS: [[i64; 9]; 9] = tensor(QUADRATIC_ROWS);

/// The tensor square of a table of side N, as a table of side N^2 = M.
const fn tensor<const N: usize, const M: usize>(rows: [[i64; N]; N]) -> [[i64; M]; M] {
    let mut product = [[0; M]; M];
    let mut row = 0;
    while row < M {
        let mut column = 0;
        while column < M {
            let along_u = rows[row % N][column % N];
            let along_v = rows[row / N][column / N];
            product[row][column] = along_u * along_v;
            column += 1;
        }
        row += 1;
    }
    product
}

/// The 15 Bézier points of the quartic patch of a regular 12-point Loop net ([`BOX_SPLINE_ROWS`]).
///
/// Guarantee: exact in exact types, an enclosure in intervals.
///
/// ```
/// use subcert::bernstein::conversion::box_spline_bezier_from_net;
/// use subcert::scalar::{Field, Rational};
/// let mut net = std::array::from_fn(|_| Rational::ratio(0, 1));
/// net[3] = Rational::ratio(1, 1);
/// let bezier = box_spline_bezier_from_net::<Rational, _>(&net);
/// assert_eq!(bezier[0], Rational::ratio(1, 2)); // the limit mask of valence 6
/// ```
pub fn box_spline_bezier_from_net<S: Field, V: Module<S>>(net: &[V; 12]) -> [V; 15] {
    from_net::box_spline::<S, V>(net).0
}

/// The 4x4 Bézier points of the bicubic patch of a regular 4x4 net ([`BICUBIC_ROWS`]).
pub fn bicubic_bezier_from_net<S: Field, V: Module<S>>(net: &[V; 16]) -> [V; 16] {
    from_net::bicubic::<S, V>(net).0
}

/// The 3x3 Bézier points of the biquadratic patch of a regular 3x3 net ([`BIQUADRATIC_ROWS`]).
pub fn biquadratic_bezier_from_net<S: Field, V: Module<S>>(net: &[V; 9]) -> [V; 9] {
    from_net::biquadratic::<S, V>(net).0
}

/// The four Bézier points of a uniform cubic B-spline segment ([`CUBIC_ROWS`]).
pub fn cubic_bezier_from_net<S: Field, V: Module<S>>(net: &[V; 4]) -> [V; 4] {
    convert(&CUBIC_ROWS, CUBIC_DENOMINATOR, net)
}

/// The three Bézier points of a uniform quadratic B-spline segment ([`QUADRATIC_ROWS`]).
pub fn quadratic_bezier_from_net<S: Field, V: Module<S>>(net: &[V; 3]) -> [V; 3] {
    convert(&QUADRATIC_ROWS, QUADRATIC_DENOMINATOR, net)
}

/// `rows · net / denominator`, summed in integers first: one division per point.
fn convert<S: Field, V: Module<S>, const N: usize, const B: usize>(
    rows: &[[i64; N]; B],
    denominator: i64,
    net: &[V; N],
) -> [V; B] {
    std::array::from_fn(|b| {
        let mut sum = V::zero();
        for (point, &weight) in net.iter().zip(&rows[b]) {
            if weight != 0 {
                sum = sum + &(point.clone() * &S::from_integer(weight));
            }
        }
        sum * &S::ratio(1, denominator)
    })
}

#[cfg(test)]
mod tests {
    use num_traits::{One, Zero};

    use super::*;
    use crate::scalar::Rational;

    /// A conversion applied to unit nets gives the columns of its table.
    fn check<const N: usize, const B: usize>(
        convert: fn(&[Rational; N]) -> [Rational; B],
        rows: &[[i64; N]; B],
        denominator: i64,
    ) {
        for column in 0..N {
            let mut net: [Rational; N] = std::array::from_fn(|_| Rational::zero());
            net[column] = Rational::one();
            for (row, value) in convert(&net).iter().enumerate() {
                assert_eq!(
                    *value,
                    <Rational as Field>::ratio(rows[row][column], denominator)
                );
            }
        }
    }

    #[test]
    fn the_factored_conversions_are_the_tables() {
        check(
            box_spline_bezier_from_net::<Rational, Rational>,
            &BOX_SPLINE_ROWS,
            BOX_SPLINE_DENOMINATOR,
        );
        check(
            bicubic_bezier_from_net::<Rational, Rational>,
            &BICUBIC_ROWS,
            BICUBIC_DENOMINATOR,
        );
        check(
            biquadratic_bezier_from_net::<Rational, Rational>,
            &BIQUADRATIC_ROWS,
            BIQUADRATIC_DENOMINATOR,
        );
    }
}
