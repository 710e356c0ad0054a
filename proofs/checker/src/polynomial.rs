//! Polynomials in beta with rational coefficients, and what the enclosure of beta decides about them.

use std::ops::{Add, Mul, Sub};

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// The ends of an enclosure of beta are multiples of `2^-BITS`.
pub const BITS: usize = 192;

/// `Σ num_k beta^k / den`, `den > 0`, the last `num_k` not zero. Not reduced: compare by differences.
#[derive(Clone, Debug)]
pub struct Polynomial {
    /// Integer coefficients, the constant first; empty for the zero polynomial.
    pub num: Vec<BigInt>,
    /// The common denominator.
    pub den: BigInt,
}

impl Polynomial {
    /// `Σ num_k beta^k / den`.
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

    /// True if this is the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.num.is_empty()
    }

    /// The elementary operations of finding its sign, roughly.
    pub fn cost(&self) -> u64 {
        let limbs = self.num.iter().map(BigInt::bits).fold(self.den.bits(), u64::max) / 64;
        self.num.len() as u64 * (limbs + 1 + (BITS / 64 * self.num.len()) as u64)
    }

    /// This polynomial times a rational.
    pub fn scale(&self, x: &BigRational) -> Self {
        self * &Self::constant(x)
    }

    /// The lower and the upper end of the enclosure, over `den 2^(BITS degree)`: Horner's rule on intervals.
    fn ends(&self, beta: &Beta) -> (BigInt, BigInt) {
        let mut coefficients = self.num.iter().rev();
        let first = coefficients.next().cloned().unwrap_or_default();
        let (mut low, mut high) = (first.clone(), first);
        for (k, c) in coefficients.enumerate() {
            // [low, high] beta + c, with beta > 0 and everything scaled by 2^(BITS (k + 1)).
            let c = c << (BITS * (k + 1));
            low = low.clone() * if low.is_negative() { &beta.high } else { &beta.low } + &c;
            high = high.clone() * if high.is_negative() { &beta.low } else { &beta.high } + &c;
        }
        (low, high)
    }

    /// The sign on the whole enclosure of beta (a zero at an end allowed), if it is certain.
    pub fn sign(&self, beta: &Beta) -> Option<Sign> {
        let (low, high) = self.ends(beta);
        match (low.sign(), high.sign()) {
            (Sign::NoSign, Sign::NoSign) => Some(Sign::NoSign),
            (Sign::Plus | Sign::NoSign, _) => Some(Sign::Plus),
            (_, Sign::Minus | Sign::NoSign) => Some(Sign::Minus),
            _ => None,
        }
    }

    /// True if the value is certainly at most 0.
    pub fn is_at_most_zero(&self, beta: &Beta) -> bool {
        matches!(self.sign(beta), Some(Sign::NoSign | Sign::Minus))
    }

    /// True if the value is certainly at most that of `other`.
    pub fn is_at_most(&self, other: &Self, beta: &Beta) -> bool {
        (self - other).is_at_most_zero(beta)
    }

    /// An upper bound of the magnitude: that of the enclosure.
    pub fn magnitude(&self, beta: &Beta) -> BigRational {
        let (low, high) = self.ends(beta);
        let degree = self.num.len().saturating_sub(1);
        BigRational::new(low.abs().max(high.abs()), &self.den << (BITS * degree))
    }

    /// The polynomial in another one.
    pub fn compose(&self, inner: &Self) -> Self {
        let zero = Self::integer(0);
        let horner = self
            .num
            .iter()
            .rev()
            .fold(zero, |sum, c| &(&sum * inner) + &Self::new(vec![c.clone()], BigInt::one()));
        Self::new(horner.num, horner.den * &self.den)
    }

    /// The value at a rational.
    pub fn at(&self, x: &BigRational) -> BigRational {
        let value = self.compose(&Self::constant(x));
        BigRational::new(value.num.first().cloned().unwrap_or_default(), value.den)
    }

    fn combine(&self, other: &Self, sign: i64) -> Self {
        let den = self.den.lcm(&other.den);
        let (a, b) = (&den / &self.den, &den / &other.den * sign);
        let mut num = vec![BigInt::zero(); self.num.len().max(other.num.len())];
        for (sum, c) in num.iter_mut().zip(&self.num) {
            *sum += c * &a;
        }
        for (sum, c) in num.iter_mut().zip(&other.num) {
            *sum += c * &b;
        }
        Self::new(num, den)
    }
}

impl Add for &Polynomial {
    type Output = Polynomial;
    fn add(self, other: &Polynomial) -> Polynomial {
        self.combine(other, 1)
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;
    fn sub(self, other: &Polynomial) -> Polynomial {
        self.combine(other, -1)
    }
}

impl Mul for &Polynomial {
    type Output = Polynomial;
    fn mul(self, other: &Polynomial) -> Polynomial {
        let mut num = vec![BigInt::zero(); (self.num.len() + other.num.len()).saturating_sub(1)];
        for (j, a) in self.num.iter().enumerate() {
            for (k, b) in other.num.iter().enumerate() {
                if let Some(sum) = num.get_mut(j + k) {
                    *sum += a * b;
                }
            }
        }
        Polynomial::new(num, &self.den * &other.den)
    }
}

/// What is known of beta: a polynomial that stands for it (itself, or the constant that it is) and an enclosure.
#[derive(Clone, Debug)]
pub struct Beta {
    /// The variable, or the constant where beta is exact.
    pub value: Polynomial,
    low: BigInt,
    high: BigInt,
}

impl Beta {
    /// An exact rational, > 0.
    pub fn exact(x: &BigRational) -> Self {
        Self { value: Polynomial::constant(x), ..Self::between(x, x) }
    }

    /// The variable, enclosed by `0 < low <= high`, rounded outward to multiples of `2^-BITS`.
    pub fn between(low: &BigRational, high: &BigRational) -> Self {
        Self {
            value: Polynomial::new(vec![BigInt::zero(), BigInt::one()], BigInt::one()),
            low: (low.numer() << BITS).div_floor(low.denom()),
            high: (high.numer() << BITS).div_ceil(high.denom()),
        }
    }

    /// The middle of the enclosure: for decimals only.
    pub fn middle(&self) -> BigRational {
        BigRational::new(&self.low + &self.high, BigInt::one() << (BITS + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    fn polynomial(list: &[i64]) -> Polynomial {
        Polynomial::new(list.iter().map(|&c| c.into()).collect(), BigInt::one())
    }

    #[test]
    fn enclosures_decide_or_abstain() {
        let beta = Beta::between(&ratio(1, 3), &ratio(1, 2));
        assert_eq!(polynomial(&[-1, 3]).sign(&beta), None); // 1/3 is rounded outward
        assert_eq!(polynomial(&[-1, 2]).sign(&beta), Some(Sign::Minus)); // 1/2 is not
        assert_eq!(polynomial(&[-1, 4]).sign(&beta), Some(Sign::Plus));
        assert_eq!(polynomial(&[-2, 5]).sign(&beta), None);
        assert_eq!(polynomial(&[0, 0]).sign(&beta), Some(Sign::NoSign));
        // -1 + beta (2 + beta): Horner's upper end 1/4, lower end about -2/9.
        assert_eq!(polynomial(&[-1, 2, 1]).sign(&beta), None);
        assert_eq!(polynomial(&[-1, 2, 1]).magnitude(&beta), ratio(1, 4));
        // A negative inner value meets the other end: beta (beta - 1) >= 1/2 (1/3 - 1) = -1/3 for Horner.
        assert!(polynomial(&[0, -1, 1]).magnitude(&beta) > ratio(1, 3));
        assert!(polynomial(&[0, -1, 1]).magnitude(&beta) < ratio(1, 3) + ratio(1, i64::MAX));
    }

    #[test]
    fn arithmetic_agrees_with_values() {
        let (p, q, x) = (
            polynomial(&[1, -2, 5]).scale(&ratio(1, 6)),
            polynomial(&[0, 7]).scale(&ratio(-3, 4)),
            ratio(2, 7),
        );
        assert_eq!((&p + &q).at(&x), p.at(&x) + q.at(&x));
        assert_eq!((&p - &q).at(&x), p.at(&x) - q.at(&x));
        assert_eq!((&p * &q).at(&x), p.at(&x) * q.at(&x));
        assert_eq!(p.compose(&q).at(&x), p.at(&q.at(&x)));
        assert!((&(&p - &q) - &(&p - &q)).is_zero());
        assert!((&p * &Polynomial::integer(0)).is_zero());
    }
}
