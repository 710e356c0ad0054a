//! Linear functionals of a local net: in `f64`, and exact with the ring weight b as a variable.
//!
//! A functional is what a point of a refined net, a Bernstein coefficient or a second difference is
//! of the first net `y`. As modules over the weights of masks both kinds go through the same generic
//! refinement as points do.

use std::ops::{Add, Mul, Sub};

use ethnum::I256;
use num_bigint::BigInt;
use num_traits::Zero;

use crate::scalar::{Interval, Rational, Ring, ShortRational};

/// A functional with `f64` coefficients; a proposal. The empty one is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct FloatFunctional(pub Vec<f64>);

impl FloatFunctional {
    /// The value at a net.
    pub fn at(&self, net: &[f64]) -> f64 {
        self.0.iter().zip(net).map(|(a, y)| a * y).sum()
    }

    /// `self + factor · other`.
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        self.clone() + &(other.clone() * &factor)
    }
}

impl Zero for FloatFunctional {
    fn zero() -> Self {
        FloatFunctional(Vec::new())
    }
    fn is_zero(&self) -> bool {
        self.0.iter().all(|a| *a == 0.0)
    }
}

impl Add for FloatFunctional {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self + &other
    }
}

fn zip_longer(mut a: Vec<f64>, b: &[f64], op: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    a.resize(a.len().max(b.len()), 0.0);
    for (x, y) in a.iter_mut().zip(b) {
        *x = op(*x, *y);
    }
    a
}

impl Add<&FloatFunctional> for FloatFunctional {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        FloatFunctional(zip_longer(self.0, &other.0, |x, y| x + y))
    }
}

impl Sub<&FloatFunctional> for FloatFunctional {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        FloatFunctional(zip_longer(self.0, &other.0, |x, y| x - y))
    }
}

impl Mul<&f64> for FloatFunctional {
    type Output = Self;
    fn mul(mut self, factor: &f64) -> Self {
        self.0.iter_mut().for_each(|a| *a *= factor);
        self
    }
}

/// Integers for exact functionals: machine words where they are known to suffice.
///
/// Every operation is exact or panics: the caller chooses a type that is large enough.
pub trait Integer: Clone + PartialEq + Send + Sync + 'static {
    /// Zero.
    fn zero() -> Self;
    /// One.
    fn one() -> Self;
    /// Whether it is zero.
    fn is_zero(&self) -> bool;
    /// `self += a k`.
    fn add_scaled(&mut self, a: &Self, k: i64);
    /// `self k`.
    fn scaled(&self, k: i64) -> Self;
    /// The tightest enclosure by `f64`.
    fn enclose(&self) -> Interval;
    /// As a big integer.
    fn to_big(&self) -> BigInt;
}

const TOO_LARGE: &str = "an exact functional beyond its bits";

impl Integer for I256 {
    fn zero() -> Self {
        I256::ZERO
    }
    fn one() -> Self {
        I256::ONE
    }
    fn is_zero(&self) -> bool {
        *self == I256::ZERO
    }
    #[inline]
    fn add_scaled(&mut self, a: &Self, k: i64) {
        let sum = match k {
            1 => self.checked_add(*a),
            -1 => self.checked_sub(*a),
            _ => self.checked_add(a.scaled(k)),
        };
        *self = sum.expect(TOO_LARGE);
    }
    #[inline]
    fn scaled(&self, k: i64) -> Self {
        // |self| < 2^190 and |k| <= 2^63: the product is below 2^253. (The crate's checked product
        // divides, which takes five times as long.)
        let high = *self.high();
        assert!((-(1 << 62)..1 << 62).contains(&high), "{TOO_LARGE}");
        self.wrapping_mul(I256::from(k))
    }
    fn enclose(&self) -> Interval {
        if let Ok(small) = i64::try_from(*self) {
            return Interval::from_integer(small);
        }
        // The conversion is off by less than one unit in the last place.
        let near = self.as_f64();
        Interval::new(near.next_down(), near.next_up())
    }
    fn to_big(&self) -> BigInt {
        BigInt::from_signed_bytes_le(&self.to_le_bytes())
    }
}

impl Integer for BigInt {
    fn zero() -> Self {
        BigInt::ZERO
    }
    fn one() -> Self {
        BigInt::from(1)
    }
    fn is_zero(&self) -> bool {
        Zero::is_zero(self)
    }
    fn add_scaled(&mut self, a: &Self, k: i64) {
        match k {
            0 => (),
            1 => *self += a,
            -1 => *self -= a,
            _ => *self += a * k,
        }
    }
    fn scaled(&self, k: i64) -> Self {
        self * k
    }
    fn enclose(&self) -> Interval {
        Interval::from_rational(&Rational::from_integer(self.clone()))
    }
    fn to_big(&self) -> BigInt {
        self.clone()
    }
}

/// An exact functional: its coefficient at point i is `Σ_d numerators[d][i] b^d / denominator`.
///
/// The empty one is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactFunctional<T> {
    /// Coefficients by the power of b; all of one length.
    pub(super) numerators: Vec<Vec<T>>,
    /// Positive.
    pub(super) denominator: i128,
}

impl<T: Integer> ExactFunctional<T> {
    /// The coordinate `point` of a net of `size` points.
    pub fn unit(size: usize, point: usize) -> Self {
        let mut row = vec![T::zero(); size];
        row[point] = T::one();
        ExactFunctional {
            numerators: vec![row],
            denominator: 1,
        }
    }

    /// b times the functional.
    pub fn times_weight(&self) -> Self {
        let mut numerators = self.numerators.clone();
        if let Some(first) = numerators.first() {
            let zeros = vec![T::zero(); first.len()];
            numerators.insert(0, zeros);
        }
        ExactFunctional {
            numerators,
            denominator: self.denominator,
        }
    }

    /// The product with the polynomial `Σ c_d b^d`.
    pub fn times_polynomial(&self, polynomial: &[ShortRational]) -> Self {
        let mut power = self.clone();
        let mut sum = Self::zero();
        for (d, c) in polynomial.iter().enumerate() {
            if d > 0 {
                power = power.times_weight();
            }
            sum = sum + &(power.clone() * c);
        }
        sum
    }

    fn combine(mut self, other: &Self, sign: i64) -> Self {
        if other.numerators.is_empty() {
            return self;
        }
        if self.numerators.is_empty() {
            self.denominator = other.denominator;
        }
        let common = if self.denominator == other.denominator {
            self.denominator
        } else {
            num_integer::lcm(self.denominator, other.denominator)
        };
        let factor = |own: i128| i64::try_from(common / own).expect(TOO_LARGE);
        let (mine, theirs) = (factor(self.denominator), factor(other.denominator));
        if mine != 1 {
            let entries = self.numerators.iter_mut().flatten();
            entries.for_each(|a| *a = a.scaled(mine));
        }
        let size = other.numerators[0].len();
        let degree = self.numerators.len().max(other.numerators.len());
        self.numerators.resize(degree, vec![T::zero(); size]);
        for (row, added) in self.numerators.iter_mut().zip(&other.numerators) {
            for (a, b) in row.iter_mut().zip(added) {
                a.add_scaled(b, sign * theirs);
            }
        }
        self.denominator = common;
        self
    }
}

impl<T: Integer> Zero for ExactFunctional<T> {
    fn zero() -> Self {
        ExactFunctional {
            numerators: Vec::new(),
            denominator: 1,
        }
    }
    fn is_zero(&self) -> bool {
        self.numerators.iter().flatten().all(Integer::is_zero)
    }
}

impl<T: Integer> Add for ExactFunctional<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(&other, 1)
    }
}

impl<T: Integer> Add<&ExactFunctional<T>> for ExactFunctional<T> {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        self.combine(other, 1)
    }
}

impl<T: Integer> Sub<&ExactFunctional<T>> for ExactFunctional<T> {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        self.combine(other, -1)
    }
}

impl<T: Integer> Mul<&ShortRational> for ExactFunctional<T> {
    type Output = Self;
    fn mul(mut self, factor: &ShortRational) -> Self {
        let (p, q) = (*factor.numer(), *factor.denom());
        if p != 1 {
            let entries = self.numerators.iter_mut().flatten();
            entries.for_each(|a| *a = a.scaled(p));
        }
        self.denominator = self
            .denominator
            .checked_mul(i128::from(q))
            .expect(TOO_LARGE);
        debug_assert!(self.denominator > 0);
        self
    }
}
