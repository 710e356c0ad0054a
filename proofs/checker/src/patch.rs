//! Patches: polynomials over a triangle or the unit square, in Bernstein form.
//!
//! What is asked of a patch is linear in its coefficients; each answer is a row of their weights.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::rational::ratio;
use crate::scalar::Scalar;

/// A point (v, w) of the parameters; (u, v) over the square.
pub type Point = [BigRational; 2];

/// The weights of a patch's coefficients.
pub type Weights = Vec<BigRational>;

/// The domain and the degree of a polynomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Patch {
    /// Total degree 4 over the triangle v, w >= 0, v + w <= 1.
    Triangle,
    /// This degree, 2 or 3, in either parameter over the unit square.
    Square(usize),
}

/// A part of the parameters: the images of (0, 0), (1, 0) and (0, 1) under an affine map.
#[derive(Clone, Debug)]
pub struct Part(pub [Point; 3]);

impl Part {
    /// The point with the parameters (v, w) of this part.
    pub fn point(&self, [v, w]: &Point) -> Point {
        let [o, a, b] = &self.0;
        [0, 1].map(|i| &o[i] + v * (&a[i] - &o[i]) + w * (&b[i] - &o[i]))
    }
}

/// The degree over the triangle.
const QUARTIC: usize = 4;

/// The directions of the two parameters, in barycentric coordinates.
const DIRECTIONS: [[i64; 3]; 2] = [[-1, 1, 0], [-1, 0, 1]];

fn pair(v: i64, w: i64) -> Point {
    [ratio(v, 1), ratio(w, 1)]
}

/// The exponents (i, j, k) of the Bernstein polynomials over the triangle, by index.
fn exponents(degree: usize) -> Vec<[usize; 3]> {
    let rows = (0..=degree).flat_map(|row| (0..=row).map(move |k| (row, k)));
    rows.map(|(row, k)| [degree - row, row - k, k]).collect()
}

/// The index of (i, j, k) over the triangle.
fn index(j: usize, k: usize) -> usize {
    (j + k) * (j + k + 1) / 2 + k
}

/// The value of the blossom of a polynomial over the triangle at points (or directions) in barycentric
/// coordinates: coefficient (i, j, k) has the weight that `X^i Y^j Z^k` has in the product of `p_0 X + p_1 Y + p_2 Z`.
fn blossom(points: &[[BigRational; 3]]) -> Weights {
    let mut weights = vec![BigRational::one()];
    for (degree, point) in points.iter().enumerate() {
        let mut product = vec![BigRational::zero(); weights.len() + degree + 2];
        for ([_, j, k], weight) in exponents(degree).into_iter().zip(&weights) {
            let places = [index(j, k), index(j + 1, k), index(j, k + 1)].into_iter().zip(point);
            for (at, x) in places.filter(|(_, x)| !x.is_zero() && !weight.is_zero()) {
                product[at] += weight * x;
            }
        }
        weights = product;
    }
    weights
}

/// The same for a polynomial on [0, 1], at points (1 - t, t) or directions (-1, 1).
fn blossom_on_line(points: &[[BigRational; 2]]) -> Weights {
    points.iter().fold(vec![BigRational::one()], |weights, [a, b]| {
        let mut product = vec![BigRational::zero(); weights.len() + 1];
        for (i, weight) in weights.iter().enumerate() {
            product[i] += weight * a;
            product[i + 1] += weight * b;
        }
        product
    })
}

/// The value at t of the derivative, of order 0 or 1, of a polynomial on [0, 1].
pub fn on_line(degree: usize, t: &BigRational, order: usize) -> Weights {
    let mut points = vec![[BigRational::one() - t, t.clone()]; degree - order];
    points.extend(vec![[ratio(-1, 1), ratio(1, 1)]; order]);
    let factor = if order == 0 { BigRational::one() } else { ratio(degree as i64, 1) };
    blossom_on_line(&points).into_iter().map(|x| x * &factor).collect()
}

/// The coefficients, raised to the degree of the polynomial itself, of its derivative of an order.
fn raised(degree: usize, order: usize) -> Vec<Weights> {
    let [zero, one] = [0, 1].map(|t| [ratio(1 - t, 1), ratio(t, 1)]);
    let factor: usize = (0..order).map(|i| degree - i).product();
    let coefficient = |i: usize| {
        let mut points = vec![zero.clone(); degree - order - i];
        points.extend(vec![one.clone(); i]);
        points.extend(vec![[ratio(-1, 1), ratio(1, 1)]; order]);
        let weights = blossom_on_line(&points).into_iter();
        weights.map(|x| x * ratio(factor as i64, 1)).collect::<Weights>()
    };
    let lowest = (0..=degree - order).map(coefficient).collect();
    // Coefficient i of degree d is i/d of the former i - 1 and 1 - i/d of the former i.
    (degree - order + 1..=degree).fold(lowest, |rows: Vec<Weights>, d| {
        let row = |i: usize| {
            let [a, b] = [ratio(i as i64, d as i64), ratio((d - i) as i64, d as i64)];
            let (before, now) = (&rows[i.max(1) - 1], &rows[i.min(d - 1)]);
            before.iter().zip(now).map(|(x, y)| &a * x + &b * y).collect()
        };
        (0..=d).map(row).collect()
    })
}

/// The products of weights along u and along v: index (i, j) is `j (degree + 1) + i`.
fn tensor(u: &[BigRational], v: &[BigRational]) -> Weights {
    v.iter().flat_map(|y| u.iter().map(move |x| x * y)).collect()
}

/// `Σ weights_i c_i`.
pub fn combine(weights: &[BigRational], c: &[Scalar]) -> Scalar {
    let terms = weights.iter().zip(c).filter(|(x, _)| !x.is_zero()).map(|(x, c)| c.scale(x));
    terms.fold(Scalar::integer(0), |sum, term| &sum + &term)
}

impl Patch {
    /// The degree, in each parameter over the square.
    pub fn degree(self) -> usize {
        match self {
            Self::Triangle => QUARTIC,
            Self::Square(degree) => degree,
        }
    }

    /// The corners of the domain; the mirror exchanges the last with number 1.
    pub fn corners(self) -> Vec<Point> {
        match self {
            Self::Triangle => vec![pair(0, 0), pair(1, 0), pair(0, 1)],
            Self::Square(_) => vec![pair(0, 0), pair(1, 0), pair(1, 1), pair(0, 1)],
        }
    }

    /// True for a point of the domain.
    pub fn contains(self, [v, w]: &Point) -> bool {
        let (least, one) = (v.min(w), BigRational::one());
        let most = if self == Self::Triangle { v + w } else { v.max(w).clone() };
        !least.is_negative() && most <= one
    }

    /// The nodes of the coefficients, by index.
    pub fn nodes(self) -> Vec<Point> {
        let d = self.degree();
        let node = |i: usize, j: usize| [i, j].map(|x| ratio(x as i64, d as i64));
        match self {
            Self::Triangle => exponents(d).into_iter().map(|[_, j, k]| node(j, k)).collect(),
            Self::Square(_) => (0..=d).flat_map(|j| (0..=d).map(move |i| node(i, j))).collect(),
        }
    }

    /// The values at the corners have these weights in the affine or bilinear function at a point.
    pub fn blend(self, [v, w]: &Point) -> Weights {
        let (one, rest) = (BigRational::one(), |x: &BigRational| BigRational::one() - x);
        match self {
            Self::Triangle => vec![one - v - w, v.clone(), w.clone()],
            Self::Square(_) => vec![rest(v) * rest(w), v * rest(w), v * w, rest(v) * w],
        }
    }

    /// The distance from corner 0: affine, 0 there and 1 at the farthest corner.
    pub fn distance(self, [v, w]: &Point) -> BigRational {
        (v + w) / ratio(if self == Self::Triangle { 1 } else { 2 }, 1)
    }

    /// The indices of the coefficients on an edge, in order, if there is such an edge.
    pub fn edge(self, edge: usize) -> Option<Vec<usize>> {
        let d = self.degree();
        let on = |m: usize| match (self, edge) {
            (Self::Triangle, 0) => Some(index(d - m, m)), // from corner 1 to 2
            (Self::Triangle, 1) => Some(index(0, m)),     // from corner 0 to 2
            (Self::Triangle, 2) => Some(index(m, 0)),     // from corner 0 to 1
            (Self::Square(_), 0) => Some(m),              // from corner 0 to 1
            (Self::Square(_), 1) => Some(m * (d + 1) + d), // from corner 1 to 2
            (Self::Square(_), 2) => Some(d * (d + 1) + d - m), // from corner 2 to 3
            (Self::Square(_), 3) => Some((d - m) * (d + 1)), // from corner 3 to 0
            _ => None,
        };
        (0..=d).map(on).collect()
    }

    /// The value at a point: the Bernstein polynomials there.
    pub fn value(self, [v, w]: &Point) -> Weights {
        match self {
            Self::Triangle => blossom(&vec![barycentric(v, w); QUARTIC]),
            Self::Square(d) => tensor(&on_line(d, v, 0), &on_line(d, w, 0)),
        }
    }

    /// The derivatives at a point, in the two parameters.
    pub fn slopes(self, [v, w]: &Point) -> [Weights; 2] {
        match self {
            Self::Triangle => DIRECTIONS.map(|direction| {
                let points = vec![barycentric(v, w); QUARTIC - 1];
                let direction = direction.map(|x| ratio(x * QUARTIC as i64, 1));
                blossom(&[points, vec![direction]].concat())
            }),
            Self::Square(d) => [
                tensor(&on_line(d, v, 1), &on_line(d, w, 0)),
                tensor(&on_line(d, v, 0), &on_line(d, w, 1)),
            ],
        }
    }

    /// The Bernstein coefficients of the second derivatives, the square of the first parameter, the product, the
    /// square of the second: for each index the three, all of one degree.
    pub fn bends(self) -> Vec<[Weights; 3]> {
        match self {
            Self::Triangle => {
                let corner = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
                let whole = |x: [i64; 3], factor: i64| x.map(|x| ratio(x * factor, 1));
                let factor = (QUARTIC * (QUARTIC - 1)) as i64;
                let bend = |times: [usize; 3]| {
                    let places = corner.iter().zip(times).flat_map(|(&x, i)| vec![whole(x, 1); i]);
                    let places: Vec<_> = places.collect();
                    [(0, 0), (0, 1), (1, 1)].map(|(a, b)| {
                        let two = vec![whole(DIRECTIONS[a], factor), whole(DIRECTIONS[b], 1)];
                        blossom(&[two, places.clone()].concat())
                    })
                };
                exponents(QUARTIC - 2).into_iter().map(bend).collect()
            }
            Self::Square(d) => {
                let [value, slope, bend] = [0, 1, 2].map(|order| raised(d, order));
                let three = |(i, j): (usize, usize)| {
                    let (uu, vv) = (tensor(&bend[i], &value[j]), tensor(&value[i], &bend[j]));
                    [uu, tensor(&slope[i], &slope[j]), vv]
                };
                (0..=d).flat_map(|j| (0..=d).map(move |i| (i, j))).map(three).collect()
            }
        }
    }

    /// The quarters of the domain, in the order of the letters.
    pub fn quarters(self) -> [Part; 4] {
        let half = |corners: [[i64; 2]; 3]| Part(corners.map(|p| p.map(|x| ratio(x, 2))));
        match self {
            Self::Triangle => [
                half([[0, 0], [1, 0], [0, 1]]),
                half([[1, 0], [2, 0], [1, 1]]),
                half([[1, 1], [0, 1], [1, 0]]),
                half([[0, 1], [1, 1], [0, 2]]),
            ],
            Self::Square(_) => [
                half([[0, 0], [1, 0], [0, 1]]),
                half([[1, 0], [2, 0], [1, 1]]),
                half([[1, 1], [2, 1], [1, 2]]),
                half([[0, 1], [1, 1], [0, 2]]),
            ],
        }
    }

    /// The part that a word names.
    pub fn part(self, word: &[u8]) -> Part {
        let quarters = self.quarters();
        let whole = Part([pair(0, 0), pair(1, 0), pair(0, 1)]);
        word.iter().fold(whole, |part, &letter| {
            Part(quarters[usize::from(letter)].0.each_ref().map(|point| part.point(point)))
        })
    }

    /// The coefficients on a quarter: the blossom with i, j, k arguments at its corners 0, 1, 2; over the square with
    /// i and j at its upper ends, the others at the lower ones.
    pub fn restricted(self, letter: usize) -> Vec<Weights> {
        let Part(corners) = &self.quarters()[letter];
        match self {
            Self::Triangle => {
                let corners = corners.each_ref().map(|[v, w]| barycentric(v, w));
                let at = |times: [usize; 3]| {
                    let points = corners.iter().zip(times);
                    blossom(&points.flat_map(|(p, i)| vec![p.clone(); i]).collect::<Vec<_>>())
                };
                exponents(QUARTIC).into_iter().map(at).collect()
            }
            Self::Square(d) => {
                let [o, a, b] = corners;
                let along = |low: &BigRational, high: &BigRational, i: usize| {
                    let ends = [low, high].map(|t| [BigRational::one() - t, t.clone()]);
                    let points = (0..d).map(|m| ends[usize::from(m < i)].clone());
                    blossom_on_line(&points.collect::<Vec<_>>())
                };
                let at = |(i, j): (usize, usize)| {
                    tensor(&along(&o[0], &a[0], i), &along(&o[1], &b[1], j))
                };
                (0..=d).flat_map(|j| (0..=d).map(move |i| (i, j))).map(at).collect()
            }
        }
    }
}

fn barycentric(v: &BigRational, w: &BigRational) -> [BigRational; 3] {
    [BigRational::one() - v - w, v.clone(), w.clone()]
}
