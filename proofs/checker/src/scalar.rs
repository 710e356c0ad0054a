//! Coefficients: sums of a ring's generators with rational coefficients. Products are in `ring`.

use std::ops::{Add, Sub};

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// `Σ num_k g_k / den`, `den > 0`, `g_0 = 1`, the last `num_k` not zero. Not reduced: compare by differences.
#[derive(Clone, Debug)]
pub struct Scalar {
    /// Integer coefficients, the constant first; empty for zero.
    pub num: Vec<BigInt>,
    /// The common denominator.
    pub den: BigInt,
}

impl Scalar {
    /// `Σ num_k g_k / den`.
    pub fn new(mut num: Vec<BigInt>, den: BigInt) -> Self {
        while num.last().is_some_and(Zero::is_zero) {
            num.pop();
        }
        Self { num, den }
    }

    /// The constant x.
    pub fn constant(x: &BigRational) -> Self {
        Self::new(vec![x.numer().clone()], x.denom().clone())
    }

    /// The constant x.
    pub fn integer(x: i64) -> Self {
        Self::new(vec![x.into()], BigInt::one())
    }

    /// The generator `g_k`.
    pub fn generator(k: usize) -> Self {
        Self::new((0..=k).map(|i| u8::from(i == k).into()).collect(), BigInt::one())
    }

    /// True if all coefficients are zero.
    pub fn is_zero(&self) -> bool {
        self.num.is_empty()
    }

    /// This scalar times a rational.
    pub fn scale(&self, x: &BigRational) -> Self {
        Self::new(self.num.iter().map(|c| c * x.numer()).collect(), &self.den * x.denom())
    }

    fn combine(&self, other: &Self, sign: i64) -> Self {
        let den = self.den.lcm(&other.den);
        let (a, b) = (&den / &self.den, &den / &other.den * sign);
        let mut num = vec![BigInt::zero(); self.num.len().max(other.num.len())];
        num.iter_mut().zip(&self.num).for_each(|(sum, c)| add_product(sum, &a, c));
        num.iter_mut().zip(&other.num).for_each(|(sum, c)| add_product(sum, &b, c));
        Self::new(num, den)
    }
}

impl Add for &Scalar {
    type Output = Scalar;
    fn add(self, other: &Scalar) -> Scalar {
        self.combine(other, 1)
    }
}

impl Sub for &Scalar {
    type Output = Scalar;
    fn sub(self, other: &Scalar) -> Scalar {
        self.combine(other, -1)
    }
}

/// `sum += factor x`, without a product where the factor is 1 or -1.
pub fn add_product(sum: &mut BigInt, factor: &BigInt, x: &BigInt) {
    match (x.is_zero(), factor.magnitude().is_one(), factor.sign()) {
        (true, ..) => (),
        (_, true, Sign::Minus) => *sum -= x,
        (_, true, _) => *sum += x,
        _ => *sum += factor * x,
    }
}
