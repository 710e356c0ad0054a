//! Enclosures, signs and comparisons.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::{Signed, Zero};

use super::element::Cyclotomic;
use super::field::RealField;
use crate::scalar::float::{power_of_two, round_down, round_up};
use crate::scalar::{Decide, Interval, Rational};

impl Cyclotomic {
    /// Rational bounds `lo <= value <= hi` with `hi - lo <= 2^-bits`.
    pub fn enclose_rational(&self, bits: u32) -> (Rational, Rational) {
        let Some(field) = self.field else {
            let value = Rational::new(self.coefficients[0].clone(), self.denominator.clone());
            return (value.clone(), value);
        };
        // Each C_k is within 2^-(b+1): the sum within Σ|a_k| 2^-(b+1), divided by the denominator.
        let weight: BigInt = self.coefficients[1..].iter().map(Signed::abs).sum();
        let extra = weight.bits().saturating_sub(self.denominator.bits()) + 1;
        let fine = bits + u32::try_from(extra).expect("coefficients of 2^32 bits");
        let (middle, radius, scale) = self.fixed_point(field, fine.next_multiple_of(64));
        let over = |a: BigInt| Rational::new(a, &self.denominator << scale);
        (over(&middle - &radius), over(middle + radius))
    }

    /// `|denominator * value - middle / 2^scale| <= radius / 2^scale`.
    fn fixed_point(&self, field: &RealField, bits: u32) -> (BigInt, BigInt, u32) {
        let basis = field.enclose_basis(bits);
        let mut middle = &self.coefficients[0] << basis.scale.bits;
        let mut weight = BigInt::ZERO;
        for (a, c) in self.coefficients.iter().zip(&basis.values).skip(1) {
            if !a.is_zero() {
                middle += a * c;
                weight += a.abs();
            }
        }
        (middle, weight * &basis.scale.error, basis.scale.bits)
    }

    /// -1, 0 or 1 by the sign of the value, exactly.
    pub fn signum(&self) -> i32 {
        let sign = |x: &BigInt| match x.sign() {
            num_bigint::Sign::Minus => -1,
            num_bigint::Sign::NoSign => 0,
            num_bigint::Sign::Plus => 1,
        };
        let Some(field) = self.field else {
            return sign(&self.coefficients[0]);
        };
        // Two coefficients in a basis: the value is irrational, hence not 0, and this ends.
        let mut bits = 64;
        loop {
            let (middle, radius, _) = self.fixed_point(field, bits);
            if middle.magnitude() > radius.magnitude() {
                return sign(&middle);
            }
            bits *= 2;
        }
    }

    /// An enclosure by `f64`: neighbours, at worst one more; the tightest for a rational.
    pub fn enclose(&self) -> Interval {
        let Some(field) = self.field else {
            let value = Rational::new(self.coefficients[0].clone(), self.denominator.clone());
            return Interval::from_rational(&value);
        };
        let mut bits = 128;
        loop {
            let (middle, radius, scale) = self.fixed_point(field, bits);
            // Relative accuracy 2^-64: a thousandth of a unit in the last place.
            if middle.magnitude() > (&radius << 64u32).magnitude() {
                let denominator = &self.denominator * power_of_two(scale);
                let inf = Rational::new(&middle - &radius, denominator.clone());
                let sup = Rational::new(middle + radius, denominator);
                return Interval::new(round_down(&inf), round_up(&sup));
            }
            bits *= 2;
        }
    }

    /// Whether the value lies in the interval, decided exactly.
    pub fn lies_in(&self, interval: Interval) -> bool {
        let end = |x: f64| Rational::from_float(x).map(|x| Cyclotomic::from_rational(&x));
        let at_least = end(interval.inf()).is_none_or(|inf| self.compare(&inf).is_ge());
        let at_most = end(interval.sup()).is_none_or(|sup| self.compare(&sup).is_le());
        at_least && at_most
    }

    /// The order of the two numbers, whatever their fields.
    pub fn compare(&self, other: &Self) -> Ordering {
        match self.sum(&-other) {
            Ok(difference) => difference.signum().cmp(&0),
            Err(_) => self.compare_apart(other),
        }
    }

    /// The order without a common field. Let x = a/p - b/q, of degree at most D, the product of
    /// the fields' degrees. Every conjugate of the algebraic integer p q x is at most B = q |a| +
    /// p |b| in magnitude, |a| = |a_0| + 2 Σ|a_k|, and their product is an integer. So either x = 0
    /// or |x| >= 1 / (p q B^(D-1)): enclosures this narrow that overlap prove equality.
    fn compare_apart(&self, other: &Self) -> Ordering {
        let size = |x: &Self| -> BigInt {
            let tail: BigInt = x.coefficients[1..].iter().map(Signed::abs).sum();
            x.coefficients[0].abs() + tail * 2
        };
        let (p, q) = (&self.denominator, &other.denominator);
        let conjugate = q * size(self) + p * size(other);
        let degree = (self.field_degree() * other.field_degree()) as u64;
        let separation = (p * q).bits() + (degree - 1) * conjugate.bits();
        let mut bits: u32 = 64;
        loop {
            let (a_inf, a_sup) = self.enclose_rational(bits);
            let (b_inf, b_sup) = other.enclose_rational(bits);
            // Not `<`: it would recurse once per partial quotient.
            if a_sup.decide(&b_inf) == Some(Ordering::Less) {
                return Ordering::Less;
            } else if b_sup.decide(&a_inf) == Some(Ordering::Less) {
                return Ordering::Greater;
            } else if u64::from(bits) > separation + 1 {
                // |x| <= 2^-bits + 2^-bits < 2^-separation.
                return Ordering::Equal;
            }
            bits *= 2;
        }
    }
}
