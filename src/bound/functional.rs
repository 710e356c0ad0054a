//! Linear functionals of a local net: in `f64`, and exact with the irrational numbers of a scheme as
//! variables.
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
    /// `self k`, of any size.
    fn scaled_by(&self, k: &BigInt) -> Self;
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
    fn scaled_by(&self, k: &BigInt) -> Self {
        let bytes = k.to_signed_bytes_le();
        let negative = bytes.last().is_some_and(|byte| byte & 0x80 != 0);
        let mut wide = [if negative { 0xff } else { 0 }; 32];
        assert!(bytes.len() <= wide.len(), "{TOO_LARGE}");
        wide[..bytes.len()].copy_from_slice(&bytes);
        let product = self.checked_mul(I256::from_le_bytes(wide));
        product.expect(TOO_LARGE)
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
    fn scaled_by(&self, k: &BigInt) -> Self {
        self * k
    }
    fn enclose(&self) -> Interval {
        Interval::from_rational(&Rational::from_integer(self.clone()))
    }
    fn to_big(&self) -> BigInt {
        self.clone()
    }
}

/// An exact functional: its coefficient at point i is `Σ_d numerators[d][i] g_d / denominator`.
///
/// The g_d are the numbers of a scheme ([`super::value::Numbers`]): the powers b^d of Loop's ring weight,
/// the cosines cos(2πd/n) for Doo-Sabin, only g_0 = 1 for Catmull-Clark. The empty one is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactFunctional<T> {
    /// Coefficients by d; all of one length.
    pub(super) numerators: Vec<Vec<T>>,
    /// Positive.
    pub(super) denominator: BigInt,
}

impl<T: Integer> ExactFunctional<T> {
    /// The coordinate `point` of a net of `size` points.
    pub fn unit(size: usize, point: usize) -> Self {
        let mut row = vec![T::zero(); size];
        row[point] = T::one();
        ExactFunctional {
            numerators: vec![row],
            denominator: BigInt::from(1),
        }
    }

    /// b times the functional, where g_d = b^d.
    pub fn times_weight(&self) -> Self {
        let mut numerators = self.numerators.clone();
        if let Some(first) = numerators.first() {
            let zeros = vec![T::zero(); first.len()];
            numerators.insert(0, zeros);
        }
        ExactFunctional {
            numerators,
            denominator: self.denominator.clone(),
        }
    }

    /// The product with `Σ c_d b^d`, where g_d = b^d; with a rational, whatever the g_d.
    pub fn times_polynomial(&self, polynomial: &[Rational]) -> Self {
        let mut power = self.clone();
        let mut sum = Self::zero();
        for (d, c) in polynomial.iter().enumerate() {
            if d > 0 {
                power = power.times_weight();
            }
            let mut term = power.clone();
            for a in term.numerators.iter_mut().flatten() {
                *a = times(a, c.numer());
            }
            term.denominator *= c.denom();
            sum = sum + &term;
        }
        sum
    }

    /// 2 cos(2πm/n) times the functional, where g_d = cos(2πd/n): `2 g_m g_d = g_(m+d) + g_(m-d)`,
    /// indices modulo n and up to their sign.
    pub fn times_two_cos(&self, m: u32, n: u32) -> Self {
        let Some(first) = self.numerators.first() else {
            return self.clone();
        };
        let mut numerators = vec![vec![T::zero(); first.len()]; n as usize / 2 + 1];
        for (d, row) in self.numerators.iter().enumerate() {
            let d = d as u32;
            for at in [(m + d) % n, (m + n - d) % n] {
                let sum = &mut numerators[at.min(n - at) as usize];
                for (s, a) in sum.iter_mut().zip(row) {
                    s.add_scaled(a, 1);
                }
            }
        }
        while numerators
            .last()
            .is_some_and(|row| row.iter().all(T::is_zero))
        {
            numerators.pop();
        }
        ExactFunctional {
            numerators,
            denominator: self.denominator.clone(),
        }
    }

    fn combine(mut self, other: &Self, sign: i64) -> Self {
        if other.numerators.is_empty() {
            return self;
        }
        if self.numerators.is_empty() {
            self.denominator = other.denominator.clone();
        }
        let size = other.numerators[0].len();
        let degree = self.numerators.len().max(other.numerators.len());
        let mut factor = None;
        if self.denominator != other.denominator {
            let common = num_integer::lcm(self.denominator.clone(), other.denominator.clone());
            let mine = &common / &self.denominator;
            if mine != BigInt::from(1) {
                for a in self.numerators.iter_mut().flatten() {
                    *a = times(a, &mine);
                }
            }
            factor = Some(&common / &other.denominator);
            self.denominator = common;
        }
        self.numerators.resize(degree, vec![T::zero(); size]);
        let small = match &factor {
            None => Some(1),
            Some(factor) => i64::try_from(factor).ok(),
        };
        for (row, added) in self.numerators.iter_mut().zip(&other.numerators) {
            for (a, b) in row.iter_mut().zip(added).filter(|(_, b)| !b.is_zero()) {
                match (small, &factor) {
                    (None, Some(factor)) => a.add_scaled(&b.scaled_by(factor), sign),
                    (small, _) => a.add_scaled(b, sign * small.unwrap_or(1)),
                }
            }
        }
        self
    }
}

fn times<T: Integer>(a: &T, k: &BigInt) -> T {
    match i64::try_from(k) {
        Ok(small) => a.scaled(small),
        Err(_) => a.scaled_by(k),
    }
}

impl<T: Integer> Zero for ExactFunctional<T> {
    fn zero() -> Self {
        ExactFunctional {
            numerators: Vec::new(),
            denominator: BigInt::from(1),
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
        if q != 1 {
            self.denominator *= q;
        }
        self
    }
}
