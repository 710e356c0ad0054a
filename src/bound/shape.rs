//! The parameter domains of patches with their Bernstein forms: the triangle of degree 4, the square of
//! degree 3 or 2.
//!
//! Coefficients are slices in the order of [`QuarticTriangle`], [`Bicubic`] or [`Biquadratic`], over
//! any module: functionals, values, floats.

use std::array::from_fn;

use crate::bernstein::Patch;
use crate::bernstein::tensor::{Bicubic, Biquadratic, Tensor};
use crate::bernstein::triangle::{QuarticTriangle, index};
use crate::scalar::{Field, Module};

/// A domain and a degree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// Quartics over `v, w >= 0, v + w <= 1`: Loop.
    Triangle,
    /// Bicubics over the unit square: Catmull-Clark.
    Bicubic,
    /// Biquadratics over the unit square: Doo-Sabin.
    Biquadratic,
}

/// The largest number of coefficients.
pub const MOST_COEFFICIENTS: usize = 16;

const FACTORIALS: [f64; 5] = [1.0, 1.0, 2.0, 6.0, 24.0];

/// x^0 .. x^4.
fn powers(x: f64) -> [f64; 5] {
    let square = x * x;
    [1.0, x, square, square * x, square * square]
}

use Shape::{Bicubic as ThreeByThree, Biquadratic as TwoByTwo, Triangle};

/// The corners of the four quarters of the triangle, in halves, by letter.
const QUARTERS_OF_TRIANGLE: [[[i64; 2]; 3]; 4] = [
    [[0, 0], [1, 0], [0, 1]],
    [[1, 0], [2, 0], [1, 1]],
    [[1, 1], [0, 1], [1, 0]],
    [[0, 1], [1, 1], [0, 2]],
];

/// The corners of the four quarters of the square, in halves, by letter.
const QUARTERS_OF_SQUARE: [[[i64; 2]; 4]; 4] = [
    [[0, 0], [1, 0], [1, 1], [0, 1]],
    [[1, 0], [2, 0], [2, 1], [1, 1]],
    [[1, 1], [2, 1], [2, 2], [1, 2]],
    [[0, 1], [1, 1], [1, 2], [0, 2]],
];

impl Shape {
    /// The number of Bernstein coefficients.
    pub const fn count(self) -> usize {
        match self {
            Triangle => 15,
            ThreeByThree => 16,
            TwoByTwo => 9,
        }
    }

    /// The degree along a line parallel to a side.
    pub const fn degree(self) -> usize {
        match self {
            Triangle => 4,
            ThreeByThree => 3,
            TwoByTwo => 2,
        }
    }

    /// The corners of the domain, in order.
    pub const fn corners(self) -> &'static [[i64; 2]] {
        match self {
            Triangle => &[[0, 0], [1, 0], [0, 1]],
            ThreeByThree | TwoByTwo => &[[0, 0], [1, 0], [1, 1], [0, 1]],
        }
    }

    /// The corners of the quarter `letter`, in halves.
    pub fn quarter(self, letter: u8) -> &'static [[i64; 2]] {
        match self {
            Triangle => &QUARTERS_OF_TRIANGLE[usize::from(letter)],
            ThreeByThree | TwoByTwo => &QUARTERS_OF_SQUARE[usize::from(letter)],
        }
    }

    /// The middle.
    pub const fn middle(self) -> [f64; 2] {
        match self {
            Triangle => [1.0 / 3.0; 2],
            ThreeByThree | TwoByTwo => [0.5; 2],
        }
    }

    /// Whether a point lies in the domain.
    pub fn contains<T: Field + PartialOrd>(self, [v, w]: [&T; 2]) -> bool {
        let (zero, one) = (T::zero(), T::one());
        *v >= zero
            && *w >= zero
            && match self {
                Triangle => v.clone() + w <= one,
                ThreeByThree | TwoByTwo => *v <= one && *w <= one,
            }
    }

    /// Where the coefficient `at` has its node, times the degree.
    pub fn node(self, at: usize) -> [i64; 2] {
        match self {
            Triangle => {
                let (i, j) = multi_index(at);
                [j as i64, (4 - i - j) as i64]
            }
            ThreeByThree | TwoByTwo => {
                let row = self.degree() + 1;
                [(at % row) as i64, (at / row) as i64]
            }
        }
    }

    /// The indices of the coefficients at the corners.
    pub fn corner_indices(self) -> Vec<usize> {
        match self {
            Triangle => vec![0, 10, 14],
            ThreeByThree => vec![0, 3, 15, 12],
            TwoByTwo => vec![0, 2, 8, 6],
        }
    }

    /// The number of edges.
    pub const fn edges(self) -> usize {
        self.corners().len()
    }

    /// The indices of the coefficients on an edge, in the edge's direction.
    ///
    /// Triangle: edge e is opposite to corner e, from the lower to the higher corner. Square: from
    /// corner e to corner e + 1.
    pub fn edge(self, edge: usize) -> Vec<usize> {
        let d = self.degree();
        let row = d + 1;
        let at = |i: usize| match (self, edge) {
            (Triangle, 0) => index(4 - i, i),
            (Triangle, 1) => index(0, i),
            (Triangle, _) => index(i, 0),
            (_, 0) => i,
            (_, 1) => i * row + d,
            (_, 2) => d * row + (d - i),
            (_, _) => (d - i) * row,
        };
        (0..=d).map(at).collect()
    }

    /// The weights of the corners' values at the point `[v, w] / side` of the affine or bilinear
    /// function through them: numerators, and their common denominator.
    pub fn interpolation(self, [v, w]: [i64; 2], side: i64) -> (Vec<i64>, i64) {
        match self {
            Triangle => (vec![side - v - w, v, w], side),
            ThreeByThree | TwoByTwo => (
                vec![
                    (side - v) * (side - w),
                    v * (side - w),
                    v * w,
                    (side - v) * w,
                ],
                side * side,
            ),
        }
    }

    /// The value at `[v, w] / side` of the affine or bilinear function with the given corner values.
    pub fn interpolate<S: Field, V: Module<S>>(
        self,
        corners: &[V],
        point: [i64; 2],
        side: i64,
    ) -> V {
        let (weights, whole) = self.interpolation(point, side);
        let mut sum = V::zero();
        for (corner, &weight) in corners.iter().zip(&weights) {
            if weight != 0 {
                sum = sum + &(corner.clone() * &S::ratio(weight, whole));
            }
        }
        sum
    }

    /// The Bernstein coefficients of the affine or bilinear function with the given corner values.
    pub fn raise<S: Field, V: Module<S>>(self, corners: &[V]) -> Vec<V> {
        let degree = self.degree() as i64;
        let at = |i: usize| self.interpolate::<S, V>(corners, self.node(i), degree);
        (0..self.count()).map(at).collect()
    }

    /// The values of the Bernstein polynomials; zeros beyond their number.
    pub fn basis(self, [v, w]: [f64; 2]) -> [f64; MOST_COEFFICIENTS] {
        let mut values = [0.0; MOST_COEFFICIENTS];
        match self {
            Triangle => {
                let [u, v, w] = [1.0 - v - w, v, w].map(powers);
                for r in 0..=4usize {
                    for k in 0..=r {
                        let j = r - k;
                        let count = 24.0 / (FACTORIALS[4 - r] * FACTORIALS[j] * FACTORIALS[k]);
                        values[r * (r + 1) / 2 + k] = count * u[4 - r] * v[j] * w[k];
                    }
                }
            }
            ThreeByThree | TwoByTwo => {
                let d = self.degree();
                let curve = |x: f64| {
                    let (x, y) = (powers(x), powers(1.0 - x));
                    let count = |i: usize| FACTORIALS[d] / (FACTORIALS[i] * FACTORIALS[d - i]);
                    from_fn::<f64, 4, _>(|i| {
                        if i <= d {
                            count(i) * x[i] * y[d - i]
                        } else {
                            0.0
                        }
                    })
                };
                let (along, across) = (curve(v), curve(w));
                for (at, value) in values[..self.count()].iter_mut().enumerate() {
                    *value = along[at % (d + 1)] * across[at / (d + 1)];
                }
            }
        }
        values
    }

    /// The value and the two partial derivatives at a point.
    pub fn evaluate<S: Field, V: Module<S>>(self, c: &[V], at: [&S; 2]) -> (V, [V; 2]) {
        match self {
            Triangle => triangle(c).evaluate(at),
            ThreeByThree => bicubic(c).evaluate(at),
            TwoByTwo => biquadratic(c).evaluate(at),
        }
    }

    /// The Bernstein coefficients of the second derivatives vv, vw, ww, all of one degree: that of the
    /// derivatives for triangles, that of the patch for squares (where the three differ by
    /// themselves and are raised).
    pub fn second_derivatives<S: Field, V: Module<S>>(self, c: &[V]) -> [Vec<V>; 3] {
        let raise = |[uu, uv, vv]: [Vec<V>; 3], d: usize| {
            // Coefficients per row of uu: d - 1; of uv: d; of vv: d + 1.
            let twice = |c, width, along| {
                let once = raise_along::<S, V>(c, width, along);
                raise_along::<S, V>(&once, width + usize::from(along), along)
            };
            let mixed = raise_along::<S, V>(&uv, d, true);
            [
                twice(&uu, d - 1, true),
                raise_along::<S, V>(&mixed, d + 1, false),
                twice(&vv, d + 1, false),
            ]
        };
        match self {
            Triangle => triangle(c).second_derivatives(),
            ThreeByThree => raise(bicubic(c).second_derivatives(), 3),
            TwoByTwo => raise(biquadratic(c).second_derivatives(), 2),
        }
    }

    /// The Bernstein coefficients over the four quarters, in the order of letters.
    pub fn quarters<S: Field, V: Module<S>>(self, c: &[V]) -> [Vec<V>; 4] {
        match self {
            Triangle => from_fn(|letter| triangle_quarter::<S, V>(c, letter)),
            ThreeByThree | TwoByTwo => {
                let row = self.degree() + 1;
                let [left, right] = halves::<S, V>(c, row, true);
                let [lower_left, upper_left] = halves::<S, V>(&left, row, false);
                let [lower_right, upper_right] = halves::<S, V>(&right, row, false);
                [lower_left, lower_right, upper_right, upper_left]
            }
        }
    }

    /// The linear function mu with mu = 0 at corner 0, 1 at the corners of the triangle opposite to it
    /// or at the opposite corner of the square, at `[v, w] / side`: numerator and denominator.
    pub fn ramp(self, [v, w]: [i64; 2], side: i64) -> (i64, i64) {
        match self {
            Triangle => (v + w, side),
            ThreeByThree | TwoByTwo => (v + w, 2 * side),
        }
    }

    /// Directions of a search.
    pub const fn directions(self) -> &'static [[f64; 2]] {
        match self {
            Triangle => &[[1.0, 0.0], [0.0, 1.0], [1.0, -1.0]],
            ThreeByThree | TwoByTwo => &[[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, -1.0]],
        }
    }
}

fn triangle<V: Clone>(c: &[V]) -> QuarticTriangle<V> {
    QuarticTriangle(from_fn(|i| c[i].clone()))
}

fn bicubic<V: Clone>(c: &[V]) -> Bicubic<V> {
    Tensor(from_fn(|i| c[i].clone()))
}

fn biquadratic<V: Clone>(c: &[V]) -> Biquadratic<V> {
    Tensor(from_fn(|i| c[i].clone()))
}

/// (i, j) of the coefficient of a triangle with an index.
fn multi_index(at: usize) -> (usize, usize) {
    let r = (0..=4).rfind(|r| r * (r + 1) / 2 <= at).unwrap_or(0);
    let k = at - r * (r + 1) / 2;
    (4 - r, r - k)
}

/// Degree elevation of a tensor form with `width` coefficients in a row, along rows or across:
/// `c_i = (i/m) b_(i-1) + (1 - i/m) b_i`, m the new degree.
fn raise_along<S: Field, V: Module<S>>(c: &[V], width: usize, along: bool) -> Vec<V> {
    let height = c.len() / width;
    let (m, new_width, new_height) = match along {
        true => (width, width + 1, height),
        false => (height, width, height + 1),
    };
    let mut raised = Vec::with_capacity(new_width * new_height);
    for j in 0..new_height {
        for i in 0..new_width {
            let (at, step) = match along {
                true => (i, 1),
                false => (j, width),
            };
            let here = j * width + i;
            let mut sum = V::zero();
            if at > 0 {
                sum = sum + &(c[here - step].clone() * &S::ratio(at as i64, m as i64));
            }
            if at < m {
                sum = sum + &(c[here].clone() * &S::ratio((m - at) as i64, m as i64));
            }
            raised.push(sum);
        }
    }
    raised
}

/// The two halves of a tensor form, along rows or across, by de Casteljau's algorithm at 1/2.
fn halves<S: Field, V: Module<S>>(c: &[V], row: usize, along: bool) -> [Vec<V>; 2] {
    let (mut low, mut high) = (c.to_vec(), c.to_vec());
    let at = |line: usize, i: usize| match along {
        true => line * row + i,
        false => i * row + line,
    };
    for line in 0..row {
        let mut level: Vec<V> = (0..row).map(|i| c[at(line, i)].clone()).collect();
        for step in 0..row {
            low[at(line, step)] = level[0].clone();
            high[at(line, row - 1 - step)] = level[level.len() - 1].clone();
            level = (level.windows(2))
                .map(|pair| crate::bernstein::midpoint::<S, V>(&pair[0], &pair[1]))
                .collect();
        }
    }
    [low, high]
}

/// The coefficients of a quartic over a quarter of the triangle.
///
/// Coefficient (i, j, k) of a quarter with corners p, q, r is the blossom at i times p, j times q, k
/// times r: four de Casteljau steps, one for each argument.
fn triangle_quarter<S: Field, V: Module<S>>(c: &[V], letter: usize) -> Vec<V> {
    let half = |[v, w]: [i64; 2]| [2 - v - w, v, w].map(|p| S::ratio(p, 2));
    let corners = QUARTERS_OF_TRIANGLE[letter].map(half);
    let blossom = |at: usize| {
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
    };
    (0..15).map(blossom).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Rational;

    /// u^d v^d, whose only coefficient is the last: its second derivatives, raised to the degree (d, d), at
    /// (1/2, 1/3), by hand.
    #[test]
    fn raised_derivatives_are_the_derivatives() {
        let r = |p: i64, q: i64| <Rational as Field>::ratio(p, q);
        for (shape, expected) in [
            // 6 u v^3, 9 u^2 v^2, 6 u^3 v
            (Shape::Bicubic, [r(1, 9), r(1, 4), r(1, 4)]),
            // 2 v^2, 4 u v, 2 u^2
            (Shape::Biquadratic, [r(2, 9), r(2, 3), r(1, 2)]),
        ] {
            let mut c = vec![r(0, 1); shape.count()];
            c[shape.count() - 1] = r(1, 1);
            let raised = shape.second_derivatives::<Rational, Rational>(&c);
            for (form, value) in raised.iter().zip(expected) {
                assert_eq!(form.len(), shape.count());
                let (found, _) = shape.evaluate(form, [&r(1, 2), &r(1, 3)]);
                assert_eq!(found, value, "{shape:?}");
            }
        }
    }
}
