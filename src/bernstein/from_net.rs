//! From the control net of a regular patch to its Bernstein coefficients.

use super::tensor::{Bicubic, Biquadratic};
use super::triangle::QuarticTriangle;
use crate::scalar::{Field, Module};

/// The 15 Bernstein coefficients of the quartic box-spline patch with control points `p[0..12]`
/// (p1..p12 of the rows p1 p2 / p3 p4 p5 / p6 p7 p8 p9 / p10 p11 p12, face p4 p7 p8, v towards p7).
///
/// `b = (1/24) T p` with the 15 x 12 matrix T. Source: Huang & Wang 2008, Appendix 1; re-derived
/// from the subdivision itself in `tests/printed_matrices.rs`.
///
/// In `f64`, with |p| <= L: each coefficient is off by at most 9 u L (one product, six sums and a
/// division by 24 of two roundings, on weights that sum to 24).
pub fn box_spline<S: Field, V: Module<S>>(p: &[V; 12]) -> QuarticTriangle<V> {
    let [p1, p2, p3, p4, p5, p6, p7, p8, p9, p10, p11, p12] = p;
    let scale = S::ratio(1, 24);
    let times = |k: i64, v: &V| v.clone() * &S::from_integer(k);
    let sum = |a: &V, b: &V| a.clone() + b;
    let (q4, q7, q8) = (times(12, p4), times(12, p7), times(12, p8));
    // Sums shared by coefficients on both sides of an edge of the face.
    let (s47, s48, s78) = (sum(p4, p7), sum(p4, p8), sum(p7, p8));
    let (s35, s3b, s5b) = (sum(p3, p5), sum(p3, p11), sum(p5, p11));
    let three = |v: &V| times(3, v);
    let b1 = q4.clone() + &times(2, &(sum(p1, p2) + &s35 + &s78));
    let b2 = q4.clone() + p1 + p5 + &times(4, p7) + &three(&sum(p3, p8));
    let b3 = q4.clone() + p2 + p3 + &times(4, p8) + &three(&sum(p5, p7));
    let b4 = times(8, &s47) + &times(4, &sum(p3, p8));
    let b5 = times(10, p4) + &s35 + &times(6, &s78);
    let b6 = times(8, &s48) + &times(4, &sum(p5, p7));
    let b7 = q7.clone() + p6 + p11 + &times(4, p4) + &three(&sum(p3, p8));
    let b8 = times(10, p7) + &s3b + &times(6, &s48);
    let b9 = times(10, p8) + &s5b + &times(6, &s47);
    let b10 = q8.clone() + p9 + p11 + &times(4, p4) + &three(&sum(p5, p7));
    let b11 = q7.clone() + &times(2, &(s3b.clone() + &s48 + p6 + p10));
    let b12 = q7.clone() + p3 + p10 + &times(4, p8) + &three(&sum(p4, p11));
    let b13 = times(8, &s78) + &times(4, &sum(p4, p11));
    let b14 = q8.clone() + p5 + p12 + &times(4, p7) + &three(&sum(p4, p11));
    let b15 = q8.clone() + &times(2, &(s5b.clone() + &s47 + p9 + p12));
    QuarticTriangle([
        b1 * &scale,
        b2 * &scale,
        b3 * &scale,
        b4 * &scale,
        b5 * &scale,
        b6 * &scale,
        b7 * &scale,
        b8 * &scale,
        b9 * &scale,
        b10 * &scale,
        b11 * &scale,
        b12 * &scale,
        b13 * &scale,
        b14 * &scale,
        b15 * &scale,
    ])
}

/// The Bernstein coefficients of the bicubic B-spline patch over the middle square of a 4 x 4 net,
/// `p[4 j + i]`, i along u.
///
/// Along each direction `(p0 + 4 p1 + p2)/6, (4 p1 + 2 p2)/6, (2 p1 + 4 p2)/6, (p1 + 4 p2 + p3)/6`.
/// In `f64`, with |p| <= L: off by at most 6 u L.
pub fn bicubic<S: Field, V: Module<S>>(p: &[V; 16]) -> Bicubic<V> {
    let (two, four) = (S::from_integer(2), S::from_integer(4));
    let curve = |a: &V, b: &V, c: &V, d: &V| -> [V; 4] {
        let (b4, c4) = (b.clone() * &four, c.clone() * &four);
        [
            b4.clone() + &(a.clone() + c),
            b4 + &(c.clone() * &two),
            c4.clone() + &(b.clone() * &two),
            c4 + &(b.clone() + d),
        ]
    };
    let rows: [[V; 4]; 4] =
        std::array::from_fn(|j| curve(&p[4 * j], &p[4 * j + 1], &p[4 * j + 2], &p[4 * j + 3]));
    let columns: [[V; 4]; 4] =
        std::array::from_fn(|i| curve(&rows[0][i], &rows[1][i], &rows[2][i], &rows[3][i]));
    let scale = S::ratio(1, 36);
    super::tensor::Tensor(std::array::from_fn(|index| {
        columns[index % 4][index / 4].clone() * &scale
    }))
}

/// The Bernstein coefficients of the biquadratic B-spline patch over the middle square of a 3 x 3
/// net, `p[3 j + i]`, i along u.
///
/// Along each direction `(p0 + p1)/2, p1, (p1 + p2)/2`. In `f64`, with |p| <= L: off by at most 2 u L.
pub fn biquadratic<S: Field, V: Module<S>>(p: &[V; 9]) -> Biquadratic<V> {
    let curve = |a: &V, b: &V, c: &V| -> [V; 3] {
        [
            super::midpoint::<S, V>(a, b),
            b.clone(),
            super::midpoint::<S, V>(b, c),
        ]
    };
    let rows: [[V; 3]; 3] = std::array::from_fn(|j| curve(&p[3 * j], &p[3 * j + 1], &p[3 * j + 2]));
    let columns: [[V; 3]; 3] =
        std::array::from_fn(|i| curve(&rows[0][i], &rows[1][i], &rows[2][i]));
    super::tensor::Tensor(std::array::from_fn(|index| {
        columns[index % 3][index / 3].clone()
    }))
}
