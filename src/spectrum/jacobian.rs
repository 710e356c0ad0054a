//! Products of polynomials in Bernstein form: the Jacobian of a plane patch, areas swept by curves.
//!
//! With multi-indices and `C(d, α) = d! / α!`, the product of `Σ a_α B^d_α` and `Σ b_β B^e_β` has the
//! coefficients `Σ_(α+β=γ) C(d, α) C(e, β) / C(d+e, γ) a_α b_β` of degree d + e. Positive coefficients
//! prove a positive polynomial, for the B sum to 1 and are not negative.
//!
//! Plane points are [`Phase`]s x + y w, Im w > 0. The determinant `x v - y u` of x + y w and u + v w is
//! the true one over Im w, so it has the true sign.

use super::phase::Phase;
use crate::bernstein::Patch;
use crate::bernstein::tensor::Bicubic;
use crate::bernstein::triangle::{QuarticTriangle, index};
use crate::scalar::Field;

/// The determinant of two plane vectors in the basis 1, w.
pub fn determinant<S: Field>(a: &Phase<S>, b: &Phase<S>) -> S {
    a.x.clone() * &b.y - &(a.y.clone() * &b.x)
}

/// A plane patch with a Jacobian.
pub trait PlanePatch<S: Field>: Patch<S, Phase<S>> {
    /// Bernstein coefficients of `det(∂_1 p, ∂_2 p)`.
    fn jacobian(&self) -> Vec<S>;

    /// The indices among these of the values at the patch's corners; the last one may be given twice.
    fn jacobian_corners() -> [usize; 4];

    /// The coefficients along the edge from one corner to the next, from the first to the last.
    fn edge(&self, corner: usize) -> Vec<Phase<S>>;
}

impl<S: Field> PlanePatch<S> for QuarticTriangle<Phase<S>> {
    /// Two derivatives of degree 3: degree 6, 28 coefficients.
    fn jacobian(&self) -> Vec<S> {
        let [first, second] = self.first_derivatives();
        let mut sums = vec![S::zero(); 28];
        for (j, k) in triangle(3) {
            for (l, m) in triangle(3) {
                let weight = trinomial(3, j, k) * trinomial(3, l, m);
                let product = determinant(&first[index(j, k)], &second[index(l, m)]);
                sums[index(j + l, k + m)] += product * &S::from_integer(weight);
            }
        }
        for (j, k) in triangle(6) {
            let sum = &mut sums[index(j, k)];
            *sum *= S::ratio(1, trinomial(6, j, k));
        }
        sums
    }

    fn jacobian_corners() -> [usize; 4] {
        [index(0, 0), index(6, 0), index(0, 6), index(0, 6)]
    }

    fn edge(&self, corner: usize) -> Vec<Phase<S>> {
        let at = |t: usize| match corner {
            0 => index(t, 0),
            1 => index(4 - t, t),
            _ => index(0, 4 - t),
        };
        (0..=4).map(|t| self.0[at(t)].clone()).collect()
    }
}

impl<S: Field> PlanePatch<S> for Bicubic<Phase<S>> {
    /// Bidegrees (2, 3) and (3, 2): bidegree (5, 5), 36 coefficients.
    fn jacobian(&self) -> Vec<S> {
        let [first, second] = self.first_derivatives();
        let mut sums = vec![S::zero(); 36];
        for (a, p) in first.iter().enumerate() {
            for (b, q) in second.iter().enumerate() {
                let ([i, j], [k, l]) = ([a % 3, a / 3], [b % 4, b / 4]);
                let weight = binomial(2, i) * binomial(3, k) * binomial(3, j) * binomial(2, l);
                sums[6 * (j + l) + i + k] += determinant(p, q) * &S::from_integer(weight);
            }
        }
        for (at, sum) in sums.iter_mut().enumerate() {
            *sum *= S::ratio(1, binomial(5, at % 6) * binomial(5, at / 6));
        }
        sums
    }

    fn jacobian_corners() -> [usize; 4] {
        [0, 5, 30, 35]
    }

    fn edge(&self, corner: usize) -> Vec<Phase<S>> {
        let at = |t: usize| match corner {
            0 => t,
            1 => 4 * t + 3,
            2 => 15 - t,
            _ => 12 - 4 * t,
        };
        (0..4).map(|t| self.0[at(t)].clone()).collect()
    }
}

/// Bernstein coefficients of `det(p, p')` along a curve of degree d, of degree 2d - 1: positive if it
/// goes round the origin counterclockwise.
pub fn swept<S: Field>(curve: &[Phase<S>]) -> Vec<S> {
    let degree = curve.len() - 1;
    let mut sums = vec![S::zero(); 2 * degree];
    for (i, p) in curve.iter().enumerate() {
        for (j, ends) in curve.windows(2).enumerate() {
            let slope = (ends[1].clone() - &ends[0]) * &S::from_integer(degree as i64);
            let weight = S::from_integer(binomial(degree, i) * binomial(degree - 1, j));
            sums[i + j] += determinant(p, &slope) * &weight;
        }
    }
    for (at, sum) in sums.iter_mut().enumerate() {
        *sum *= S::ratio(1, binomial(2 * degree - 1, at));
    }
    sums
}

/// The (j, k) with j + k <= degree.
fn triangle(degree: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=degree).flat_map(move |j| (0..=degree - j).map(move |k| (j, k)))
}

fn binomial(n: usize, k: usize) -> i64 {
    (1..=k).fold(1, |product, i| product * (n - k + i) as i64 / i as i64)
}

fn trinomial(n: usize, j: usize, k: usize) -> i64 {
    binomial(n, j) * binomial(n - j, k)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bernstein::tensor::Tensor;
    use crate::scalar::Rational;

    fn r(p: i64, q: i64) -> Rational {
        <Rational as Field>::ratio(p, q)
    }

    fn points(count: usize) -> Vec<Phase<Rational>> {
        let value = |i: usize, a: usize| r((a * i * i + 3 * i + a) as i64 % 13 - 6, 4);
        let point = |i| Phase {
            x: value(i, 5),
            y: value(i, 7),
        };
        (0..count).map(point).collect()
    }

    /// The product's value at a point is the determinant of the two derivatives there, which
    /// [`Patch::evaluate`] finds by de Casteljau's algorithm.
    #[test]
    fn jacobians_are_determinants_of_derivatives() {
        let (u, v) = (r(2, 7), r(1, 5));
        let triangle_patch = QuarticTriangle(points(15).try_into().unwrap());
        let (_, [a, b]) = triangle_patch.evaluate([&u, &v]);
        let coefficients = triangle_patch.jacobian();
        let s = r(1, 1) - &u - &v;
        let power = |x: &Rational, k: usize| (0..k).fold(r(1, 1), |p, _| p * x);
        let value = triangle(6).fold(r(0, 1), |sum, (j, k)| {
            let basis = power(&s, 6 - j - k) * power(&u, j) * power(&v, k);
            sum + basis * r(trinomial(6, j, k), 1) * &coefficients[index(j, k)]
        });
        assert_eq!(value, determinant(&a, &b));

        let square: Bicubic<_> = Tensor(points(16).try_into().unwrap());
        let (_, [a, b]) = square.evaluate([&u, &v]);
        let basis = |t: &Rational, k: usize| {
            power(t, k) * power(&(r(1, 1) - t), 5 - k) * r(binomial(5, k), 1)
        };
        let value = (square.jacobian().iter().enumerate()).fold(r(0, 1), |sum, (at, c)| {
            sum + basis(&u, at % 6) * basis(&v, at / 6) * c
        });
        assert_eq!(value, determinant(&a, &b));
    }

    /// On a circle's tangent frame: the line from 1 to w sweeps det(1, w) = 1 at every parameter.
    #[test]
    fn a_straight_line_sweeps_evenly() {
        let point = |i: i64| Phase {
            x: r(4 - i, 4),
            y: r(i, 4),
        };
        let line: Vec<_> = (0..=4).map(point).collect();
        assert!(swept(&line).iter().all(|c| *c == r(1, 1)));
    }
}
