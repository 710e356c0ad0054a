//! The arithmetic of a measurement: points, and what is certain about their lengths.

use std::fmt::Debug;

use super::rounding;
use crate::mesh::Point;
use crate::scalar::{Field, Module, float};

/// Points, coefficients and squared lengths of one arithmetic.
///
/// `upper` and `lower` are squared lengths that enclose the true one: exactly in the exact and
/// interval arithmetics. In [`Float`] they are the plain computed value, and the whole measurement
/// adds one a-priori bound for all roundings at its end ([`super::rounding`]).
pub trait Space: Sync + 'static {
    /// Mask coefficients.
    type Scalar: Field;
    /// Control points.
    type Point: Module<Self::Scalar> + Debug + Send + Sync;
    /// Squared lengths; the order of the values that occur is total (no NaN).
    type Square: Clone + PartialOrd + Debug + Send + Sync;

    /// The vector from `base` to `p`. In `f64` it rounds once, relative to itself: lengths far from
    /// the origin keep their digits.
    fn lift(p: &Point<Self::Scalar>, base: &Point<Self::Scalar>) -> Self::Point;
    /// The squared length 0.
    fn zero() -> Self::Square;
    /// A squared length not below that of `p`.
    fn upper(p: &Self::Point) -> Self::Square;
    /// A squared length not above that of `p`.
    fn lower(p: &Self::Point) -> Self::Square;
    /// The scalar product.
    fn dot(a: &Self::Point, b: &Self::Point) -> Self::Scalar;
    /// An upper bound of a number, as a squared length; negative numbers give 0.
    fn upper_scalar(x: &Self::Scalar) -> Self::Square;
    /// A dyadic number, exactly.
    fn dyadic(x: f64) -> Self::Scalar;
    /// The number as an f64 not below it; in [`Float`] itself, with [`Space::SLACK`] to spare.
    fn upper_f64(x: &Self::Scalar) -> f64;
    /// What a certificate of concavity must add for the roundings in it, in units of the squared
    /// length scale: 0 unless the arithmetic rounds silently.
    const SLACK: f64;
    /// The square of a length given as f64, not above it; for pruning.
    fn square(length: f64) -> Self::Square;
    /// Lengths `lo <= sqrt(lower)` and `hi >= sqrt(upper)`, where each coordinate of the vectors
    /// behind them is off by at most `radius`.
    fn lengths(lower: &Self::Square, upper: &Self::Square, radius: f64) -> [f64; 2];
    /// The largest coordinate, for rounding bounds and to tell what is at their level; 0 where nothing
    /// is rounded.
    fn magnitude(p: &Self::Point) -> f64;
    /// The largest upper square of the coefficients.
    #[inline]
    fn largest(points: &[Self::Point]) -> Self::Square {
        let mut largest = Self::zero();
        for p in points {
            let square = Self::upper(p);
            if square > largest {
                largest = square;
            }
        }
        largest
    }
    /// `(1 + gap)^2 x`, to decide when to stop; never part of a claim.
    fn relax(x: &Self::Square, gap: f64) -> Self::Square;
    /// Nearest coordinates, for reports only.
    fn coordinates(p: &Self::Point) -> [f64; 3];
    /// Nearest f64 of a squared length, for ordering and reports only.
    fn estimate(x: &Self::Square) -> f64;
}

/// Four `f64` lanes; the fourth is 0. Coordinates that the compiler can keep in one register.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Lane(pub [f64; 4]);

impl num_traits::Zero for Lane {
    #[inline(always)]
    fn zero() -> Self {
        Lane([0.0; 4])
    }
    fn is_zero(&self) -> bool {
        self.0 == [0.0; 4]
    }
}

impl std::ops::Add for Lane {
    type Output = Lane;
    #[inline(always)]
    fn add(self, other: Lane) -> Lane {
        let (a, b) = (self.0, other.0);
        Lane([a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]])
    }
}

impl std::ops::Add<&Lane> for Lane {
    type Output = Lane;
    #[inline(always)]
    fn add(self, o: &Lane) -> Lane {
        let a = self.0;
        Lane([a[0] + o.0[0], a[1] + o.0[1], a[2] + o.0[2], a[3] + o.0[3]])
    }
}

impl std::ops::Sub<&Lane> for Lane {
    type Output = Lane;
    #[inline(always)]
    fn sub(self, o: &Lane) -> Lane {
        let a = self.0;
        Lane([a[0] - o.0[0], a[1] - o.0[1], a[2] - o.0[2], a[3] - o.0[3]])
    }
}

impl std::ops::Mul<&f64> for Lane {
    type Output = Lane;
    #[inline(always)]
    fn mul(self, k: &f64) -> Lane {
        let a = self.0;
        Lane([a[0] * k, a[1] * k, a[2] * k, a[3] * k])
    }
}

impl Lane {
    /// The squared length of the first three lanes.
    #[inline(always)]
    pub fn norm_squared(&self) -> f64 {
        let [x, y, z, _] = self.0;
        x * x + y * y + z * z
    }
}

/// Rounded arithmetic whose error is bounded a priori.
#[derive(Clone, Copy, Debug)]
pub enum Float {}

impl Space for Float {
    type Scalar = f64;
    type Point = Lane;
    type Square = f64;

    #[inline(always)]
    fn lift(p: &Point<f64>, base: &Point<f64>) -> Lane {
        let ([x, y, z], [a, b, c]) = (&p.0, &base.0);
        Lane([x - a, y - b, z - c, 0.0])
    }
    #[inline(always)]
    fn zero() -> f64 {
        0.0
    }
    #[inline(always)]
    fn upper(p: &Lane) -> f64 {
        p.norm_squared()
    }
    #[inline(always)]
    fn lower(p: &Lane) -> f64 {
        p.norm_squared()
    }
    #[inline(always)]
    fn dot(a: &Lane, b: &Lane) -> f64 {
        a.0[0] * b.0[0] + a.0[1] * b.0[1] + a.0[2] * b.0[2]
    }
    #[inline(always)]
    fn upper_scalar(x: &f64) -> f64 {
        x.max(0.0)
    }
    #[inline(always)]
    fn dyadic(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn upper_f64(x: &f64) -> f64 {
        *x
    }
    /// Derived at [`crate::distance::close`].
    const SLACK: f64 = 4096.0 * float::UNIT_ROUNDOFF;
    fn square(length: f64) -> f64 {
        length * length
    }
    fn lengths(lower: &f64, upper: &f64, radius: f64) -> [f64; 2] {
        rounding::lengths(*lower, *upper, radius)
    }
    #[inline(always)]
    fn magnitude(p: &Lane) -> f64 {
        let [x, y, z, _] = p.0;
        x.abs().max(y.abs()).max(z.abs())
    }
    #[inline(always)]
    fn relax(x: &f64, gap: f64) -> f64 {
        x * ((1.0 + gap) * (1.0 + gap))
    }
    fn coordinates(p: &Lane) -> [f64; 3] {
        [p.0[0], p.0[1], p.0[2]]
    }
    #[inline(always)]
    fn estimate(x: &f64) -> f64 {
        *x
    }
}
