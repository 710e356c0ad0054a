//! Tensor-product Bézier patches over the unit square: bicubic and biquadratic.
//!
//! Coefficient `(i, j)` (i along u, j along v) of a patch of degree D has index `j (D+1) + i`.
//! Corners are counterclockwise: (0,0), (1,0), (1,1), (0,1).

use super::{Patch, mid_parameter, midpoint};
use crate::scalar::{Field, Module};

/// A tensor-product patch with `N = (D+1)^2` coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Tensor<V, const D: usize, const N: usize>(pub [V; N]);

/// A bicubic patch.
pub type Bicubic<V> = Tensor<V, 3, 16>;
/// A biquadratic patch.
pub type Biquadratic<V> = Tensor<V, 2, 9>;

impl<V, const D: usize, const N: usize> Tensor<V, D, N> {
    const ROW: usize = D + 1;

    /// The bilinear patch with the given corner values (counterclockwise), raised to degree D:
    /// coefficient (i, j) is the bilinear interpolant at (i/D, j/D).
    ///
    /// In `f64`: 4 roundings on any path, with weights of relative error u each.
    pub fn from_bilinear<S: Field>(corners: &[V; 4]) -> Self
    where
        V: Module<S>,
    {
        let [c00, c10, c11, c01] = corners;
        let d = D as i64;
        let lerp = |a: &V, b: &V, i: usize| -> V {
            if i == 0 {
                a.clone()
            } else if i == D {
                b.clone()
            } else {
                a.clone() * &S::ratio(d - i as i64, d) + &(b.clone() * &S::ratio(i as i64, d))
            }
        };
        let left: [V; 4] = std::array::from_fn(|j| lerp(c00, c01, j.min(D)));
        let right: [V; 4] = std::array::from_fn(|j| lerp(c10, c11, j.min(D)));
        Tensor(std::array::from_fn(|index| {
            let (j, i) = (index / Self::ROW, index % Self::ROW);
            lerp(&left[j], &right[j], i)
        }))
    }

    /// Subtracts another patch, coefficient by coefficient.
    #[inline]
    pub fn subtract<S: Field>(&mut self, other: &Self)
    where
        V: Module<S>,
    {
        for (a, b) in self.0.iter_mut().zip(&other.0) {
            *a = a.clone() - b;
        }
    }
}

impl<S: Field, V: Module<S>, const D: usize, const N: usize> Patch<S, V> for Tensor<V, D, N> {
    const CORNERS: usize = 4;
    const DEGREE: usize = D;

    fn interpolant(corners: &[V; 4]) -> Self {
        Self::from_bilinear::<S>(corners)
    }

    #[inline]
    fn coefficients(&self) -> &[V] {
        &self.0
    }

    #[inline]
    fn corner_index(corner: usize) -> usize {
        [0, D, N - 1, N - 1 - D][corner]
    }

    fn local_corner(corner: usize) -> [f64; 2] {
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][corner]
    }

    /// Halves at u = 1/2 and turns both halves by a quarter, so that the next split is across.
    ///
    /// The left half with corners (c0, m, m', c3) becomes (m, m', c3, c0), the right one
    /// (m, c1, c2, m') becomes (c1, c2, m', m): a split along the local u always cuts the longer
    /// side.
    fn halve(&self, corners: &[[f64; 2]; 4]) -> [(Self, [[f64; 2]; 4]); 2] {
        let mut left = self.clone();
        let mut right = self.clone();
        let row = D + 1;
        // A turn by a quarter: the new u runs along the old v and the new v against the old u, so
        // old (i, j) becomes new (j, D - i).
        let turned = |i: usize, j: usize| (D - i) * row + j;
        for j in 0..row {
            let mut line: [V; 4] = std::array::from_fn(|i| self.0[j * row + i.min(D)].clone());
            left.0[turned(0, j)] = line[0].clone();
            right.0[turned(D, j)] = line[D].clone();
            for t in 1..=D {
                for i in 0..=(D - t) {
                    line[i] = midpoint::<S, V>(&line[i], &line[i + 1]);
                }
                left.0[turned(t, j)] = line[0].clone();
                right.0[turned(D - t, j)] = line[D - t].clone();
            }
        }
        let [p0, p1, p2, p3] = *corners;
        let (m, n) = (mid_parameter(p0, p1), mid_parameter(p2, p3));
        [(left, [m, n, p3, p0]), (right, [p1, p2, n, m])]
    }

    fn first_derivatives(&self) -> [Vec<V>; 2] {
        let row = D + 1;
        [
            difference(&self.0, row, row, true, D),
            difference(&self.0, row, row, false, D),
        ]
    }

    fn second_derivatives(&self) -> [Vec<V>; 3] {
        let row = D + 1;
        let [du, dv] = <Self as Patch<S, V>>::first_derivatives(self);
        [
            difference(&du, row - 1, row, true, D - 1),
            difference(&du, row - 1, row, false, D),
            difference(&dv, row, row - 1, false, D - 1),
        ]
    }

    fn evaluate(&self, at: [&S; 2]) -> (V, [V; 2]) {
        let [u, v] = at;
        let (row, degree) = (D + 1, S::from_integer(D as i64));
        // Each row of constant j: value and derivative along u; then the same along v.
        let mut values = Vec::with_capacity(row);
        let mut slopes = Vec::with_capacity(row);
        for j in 0..row {
            let (value, slope) = curve(&self.0[j * row..(j + 1) * row], u);
            values.push(value);
            slopes.push(slope);
        }
        let (value, dv) = curve(&values, v);
        let (du, _) = curve(&slopes, v);
        (value, [du * &degree, dv * &degree])
    }
}

/// Value and derivative / degree of a Bézier curve at `t`, by de Casteljau's algorithm.
fn curve<S: Field, V: Module<S>>(coefficients: &[V], t: &S) -> (V, V) {
    let s = S::one() - t;
    let mut line = coefficients.to_vec();
    let mut count = line.len();
    while count > 2 {
        count -= 1;
        for i in 0..count {
            line[i] = line[i].clone() * &s + &(line[i + 1].clone() * t);
        }
    }
    let slope = line[1].clone() - &line[0];
    (line[0].clone() * &s + &(line[1].clone() * t), slope)
}

/// Coefficients of a partial derivative of a patch with `width` x `height` coefficients.
fn difference<S: Field, V: Module<S>>(
    coefficients: &[V],
    width: usize,
    height: usize,
    along_u: bool,
    degree: usize,
) -> Vec<V> {
    let factor = S::from_integer(degree as i64);
    let (w, h) = if along_u {
        (width - 1, height)
    } else {
        (width, height - 1)
    };
    let step = if along_u { 1 } else { width };
    let mut result = Vec::with_capacity(w * h);
    for j in 0..h {
        for i in 0..w {
            let at = j * width + i;
            result.push((coefficients[at + step].clone() - &coefficients[at]) * &factor);
        }
    }
    result
}
