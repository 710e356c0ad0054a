//! Quartic Bézier triangles.
//!
//! Coefficient `(i, j, k)`, i + j + k = 4, has index `(j+k)(j+k+1)/2 + k`; corner 0 is (4,0,0),
//! corner 1 (0,4,0) at v = 1, corner 2 (0,0,4) at w = 1. Source: Huang & Wang 2008, section 2.

use super::{Patch, mid_parameter, midpoint};
use crate::scalar::{Field, Module};

/// The index of coefficient `(4-j-k, j, k)`.
#[inline]
pub const fn index(j: usize, k: usize) -> usize {
    (j + k) * (j + k + 1) / 2 + k
}

/// The corners (v, w) of the quarters of a triangle, in halves.
pub const QUARTER_CORNERS: [[[usize; 2]; 3]; 4] = [
    [[0, 0], [1, 0], [0, 1]],
    [[1, 0], [2, 0], [1, 1]],
    [[0, 1], [1, 1], [0, 2]],
    [[1, 1], [0, 1], [1, 0]],
];

/// A quartic Bézier triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct QuarticTriangle<V>(pub [V; 15]);

impl<V> QuarticTriangle<V> {
    /// The degree-4 form of the linear patch with the given corner values:
    /// coefficient (i, j, k) is `(i f0 + j f1 + k f2) / 4`. In `f64`: 6 roundings at most.
    pub fn from_linear<S: Field>(corners: &[V; 3]) -> Self
    where
        V: Module<S>,
    {
        let quarter = S::ratio(1, 4);
        let edge = |a: &V, b: &V| -> [V; 3] {
            let mid = midpoint::<S, V>(a, b);
            let near = midpoint::<S, V>(a, &mid);
            let far = midpoint::<S, V>(&mid, b);
            [near, mid, far]
        };
        let [f0, f1, f2] = corners;
        let [a1, a2, a3] = edge(f0, f1);
        let [b1, b2, b3] = edge(f0, f2);
        let [c1, c2, c3] = edge(f1, f2);
        let s = f0.clone() + f1 + f2;
        let inner = |f: &V| (s.clone() + f) * &quarter;
        QuarticTriangle([
            f0.clone(),
            a1,
            b1,
            a2,
            inner(f0),
            b2,
            a3,
            inner(f1),
            inner(f2),
            b3,
            f1.clone(),
            c1,
            c2,
            c3,
            f2.clone(),
        ])
    }

    /// The four quarters: at the corners 0, 1, 2 and in the middle.
    ///
    /// Their corners in this triangle: (0,0), (1/2,0), (0,1/2); (1/2,0), (1,0), (1/2,1/2); (0,1/2),
    /// (1/2,1/2), (0,1); (1/2,1/2), (0,1/2), (1/2,0) ([`QUARTER_CORNERS`]). Coefficient (i, j, k) of a
    /// quarter with the corners A, B, C is the blossom at A i times, B j times, C k times: midpoints only.
    pub fn quarters<S: Field>(&self) -> [Self; 4]
    where
        V: Module<S>,
    {
        QUARTER_CORNERS.map(|corners| {
            let [a, b, c] = corners.map(|[v, w]| ends([v, w]));
            let mut quarter = self.clone();
            let mut after_a = self.0.clone();
            for i in 0..=4 {
                let mut after_b = after_a.clone();
                for j in 0..=4 - i {
                    let mut after_c = after_b.clone();
                    for k in 0..4 - i - j {
                        blossom::<S, V>(&mut after_c, 4 - i - j - k, c);
                    }
                    quarter.0[index(j, 4 - i - j)] = after_c[0].clone();
                    blossom::<S, V>(&mut after_b, 4 - i - j, b);
                }
                blossom::<S, V>(&mut after_a, 4 - i, a);
            }
            quarter
        })
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

impl<S: Field, V: Module<S>> Patch<S, V> for QuarticTriangle<V> {
    const CORNERS: usize = 3;
    const DEGREE: usize = 4;

    fn interpolant(corners: &[V; 4]) -> Self {
        let [a, b, c, _] = corners.clone();
        Self::from_linear::<S>(&[a, b, c])
    }

    #[inline]
    fn coefficients(&self) -> &[V] {
        &self.0
    }

    #[inline]
    fn corner_index(corner: usize) -> usize {
        [0, 10, 14][corner]
    }

    fn local_corner(corner: usize) -> [f64; 2] {
        [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]][corner]
    }

    /// Bisects at the middle m of the edge from corner 1 to corner 2, into (m, 0, 1) and (m, 2, 0):
    /// the newest vertex comes first and the next edge split is opposite it, so the pieces stay
    /// well shaped.
    ///
    /// The coefficients of fixed i form a curve of degree 4 - i along that edge; each is halved by
    /// de Casteljau's algorithm.
    fn halve(&self, corners: &[[f64; 2]; 4]) -> [(Self, [[f64; 2]; 4]); 2] {
        let b = &self.0;
        let mut one = self.clone(); // (m, 0, 1)
        let mut two = self.clone(); // (m, 2, 0)
        // Row r = j + k has r + 1 coefficients, index r(r+1)/2 + k, from corner 1's side (k = 0).
        // After t averagings the first entry belongs to the half at corner 1 and the last to the
        // half at corner 2. In the half with corner 1 the coefficient has (i, r - t, t) in
        // (0, 1, m) = new (t, i, r - t) with i = 4 - r, hence new (j, k) = (4 - r, r - t).
        macro_rules! row {
            ($r:literal) => {{
                let base = $r * ($r + 1) / 2;
                let mut row: [V; $r + 1] = std::array::from_fn(|k| b[base + k].clone());
                one.0[index(4 - $r, $r)] = row[0].clone();
                two.0[index($r, 4 - $r)] = row[$r].clone();
                for t in 1..=$r {
                    for k in 0..=($r - t) {
                        row[k] = midpoint::<S, V>(&row[k], &row[k + 1]);
                    }
                    one.0[index(4 - $r, $r - t)] = row[0].clone();
                    two.0[index($r - t, 4 - $r)] = row[$r - t].clone();
                }
            }};
        }
        one.0[index(4, 0)] = b[0].clone();
        two.0[index(0, 4)] = b[0].clone();
        row!(1);
        row!(2);
        row!(3);
        row!(4);
        let [p0, p1, p2, _] = *corners;
        let m = mid_parameter(p1, p2);
        [(one, [m, p0, p1, m]), (two, [m, p2, p0, m])]
    }

    fn first_derivatives(&self) -> [Vec<V>; 2] {
        [
            difference(&self.0, 4, (1, 0), 4),
            difference(&self.0, 4, (0, 1), 4),
        ]
    }

    fn second_derivatives(&self) -> [Vec<V>; 3] {
        let [dv, dw] = self.first_derivatives();
        [
            difference(&dv, 3, (1, 0), 3),
            difference(&dv, 3, (0, 1), 3),
            difference(&dw, 3, (0, 1), 3),
        ]
    }

    fn evaluate(&self, at: [&S; 2]) -> (V, [V; 2]) {
        let [v, w] = at;
        let u = S::one() - v - w;
        let mut level: Vec<V> = self.0.to_vec();
        let mut degree = 4;
        while degree > 1 {
            degree -= 1;
            let mut next = Vec::with_capacity(10);
            for r in 0..=degree {
                for k in 0..=r {
                    let j = r - k;
                    next.push(
                        level[index(j, k)].clone() * &u
                            + &(level[index(j + 1, k)].clone() * v)
                            + &(level[index(j, k + 1)].clone() * w),
                    );
                }
            }
            level = next;
        }
        let four = S::from_integer(4);
        let gradient = [
            (level[1].clone() - &level[0]) * &four,
            (level[2].clone() - &level[0]) * &four,
        ];
        let value = level[0].clone() * &u + &(level[1].clone() * v) + &(level[2].clone() * w);
        (value, gradient)
    }
}

/// The two corners that a corner or the middle of an edge, in halves, is the midpoint of, as steps of
/// (j, k).
fn ends([v, w]: [usize; 2]) -> [(usize, usize); 2] {
    const CORNERS: [(usize, usize); 3] = [(0, 0), (1, 0), (0, 1)];
    match (v, w) {
        (0, 0) => [CORNERS[0]; 2],
        (2, 0) => [CORNERS[1]; 2],
        (0, 2) => [CORNERS[2]; 2],
        (1, 0) => [CORNERS[0], CORNERS[1]],
        (0, 1) => [CORNERS[0], CORNERS[2]],
        _ => [CORNERS[1], CORNERS[2]],
    }
}

/// One argument of the blossom of a form of the given degree: from the coefficients of that degree to
/// those of one degree less, in place. Entry (j, k) is read last when it is written.
fn blossom<S: Field, V: Module<S>>(
    c: &mut [V; 15],
    degree: usize,
    [one, two]: [(usize, usize); 2],
) {
    for r in 0..degree {
        for k in 0..=r {
            let j = r - k;
            let at = |(dj, dk): (usize, usize)| &c[index(j + dj, k + dk)];
            let value = if one == two {
                at(one).clone()
            } else {
                midpoint::<S, V>(at(one), at(two))
            };
            c[index(j, k)] = value;
        }
    }
}

/// Coefficients of the derivative of a degree-`degree` patch towards (j, k) += `step`.
fn difference<S: Field, V: Module<S>>(
    coefficients: &[V],
    degree: usize,
    step: (usize, usize),
    factor: i64,
) -> Vec<V> {
    let factor = S::from_integer(factor);
    let mut result = Vec::with_capacity(degree * (degree + 1) / 2);
    for r in 0..degree {
        for k in 0..=r {
            let j = r - k;
            let forward = coefficients[index(j + step.0, k + step.1)].clone();
            result.push((forward - &coefficients[index(j, k)]) * &factor);
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Rational;

    /// A quarter at (v, w) is the whole at the image of (v, w), exactly; and so is its corner's value.
    #[test]
    fn quarters_are_the_form_over_parts() {
        let value = |i: usize| <Rational as Field>::ratio((i * i * 7 % 23) as i64 - 9, 5);
        let whole = QuarticTriangle(std::array::from_fn(value));
        let at = [(1, 7), (2, 5)].map(|(p, q)| <Rational as Field>::ratio(p, q));
        let half = |x: usize| <Rational as Field>::ratio(x as i64, 2);
        for (quarter, corners) in whole.quarters::<Rational>().iter().zip(QUARTER_CORNERS) {
            let [o, a, b] = corners.map(|corner| corner.map(half));
            let place =
                [0, 1].map(|c| o[c].clone() + (&a[c] - &o[c]) * &at[0] + (&b[c] - &o[c]) * &at[1]);
            let (found, _) = quarter.evaluate([&at[0], &at[1]]);
            assert_eq!(found, whole.evaluate([&place[0], &place[1]]).0);
            for (corner, index) in [o, a, b].iter().zip([0, 10, 14]) {
                assert_eq!(quarter.0[index], whole.evaluate([&corner[0], &corner[1]]).0);
            }
        }
    }
}
