//! Enclosures of positive numbers by rationals, and printed decimals.

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::scalar::{Cyclotomic, Decide, Rational};

/// Bits of the enclosures of algebraic numbers.
const BITS: u32 = 256;

/// A number `lo <= x <= hi`, 0 <= lo.
///
/// All comparisons multiply crosswise (see [`Rational`]): numbers have thousands of bits here.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosure {
    /// Lower bound.
    pub lo: Rational,
    /// Upper bound.
    pub hi: Rational,
}

/// The order of two rationals.
pub(super) fn order(a: &Rational, b: &Rational) -> Ordering {
    a.decide(b).expect("rationals are ordered")
}

impl Enclosure {
    /// A number between two bounds.
    ///
    /// # Panics
    /// Unless 0 <= lo <= hi.
    pub fn new(lo: Rational, hi: Rational) -> Self {
        assert!(!lo.is_negative() && order(&lo, &hi).is_le());
        Enclosure { lo, hi }
    }

    /// A rational number.
    pub fn exactly(x: Rational) -> Self {
        Self::new(x.clone(), x)
    }

    /// An algebraic number, to some 256 bits.
    pub fn algebraic(x: &Cyclotomic) -> Self {
        let (lo, hi) = x.enclose_rational(BITS);
        Self::new(lo.max(Rational::zero()), hi)
    }

    /// What two floats enclose; `None` if one is not finite.
    pub fn floats(lo: f64, hi: f64) -> Option<Self> {
        Some(Self::new(
            Rational::from_float(lo.max(0.0))?,
            Rational::from_float(hi)?,
        ))
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Self {
        Self::new(&self.lo * &other.lo, &self.hi * &other.hi)
    }

    /// The larger of two numbers.
    pub fn max(&self, other: &Self) -> Self {
        let larger = |a: &Rational, b: &Rational| if order(a, b).is_ge() { a } else { b }.clone();
        Self::new(larger(&self.lo, &other.lo), larger(&self.hi, &other.hi))
    }

    /// The order of the two numbers, if it is certain.
    pub fn compare(&self, other: &Self) -> Option<Ordering> {
        if order(&self.hi, &other.lo).is_lt() {
            Some(Ordering::Less)
        } else if order(&self.lo, &other.hi).is_gt() {
            Some(Ordering::Greater)
        } else {
            let points = self.lo == self.hi && other.lo == other.hi;
            points.then_some(Ordering::Equal)
        }
    }

    /// Whether `self <= other` (`Some(true)`) or `self > other` (`Some(false)`), if certain.
    pub fn at_most(&self, other: &Self) -> Option<bool> {
        if order(&self.hi, &other.lo).is_le() {
            Some(true)
        } else {
            order(&self.lo, &other.hi).is_gt().then_some(false)
        }
    }

    /// A float near the number, for plots.
    pub fn float(&self) -> f64 {
        let middle = (&self.lo + &self.hi) / Rational::from_integer(2.into());
        crate::scalar::float::round_to_nearest(&middle)
    }

    /// The decimal of so many digits nearest to the number, or the two ends rounded outward.
    pub fn decimal(&self, digits: u32) -> String {
        let (lo, hi) = (nearest(&self.lo, digits), nearest(&self.hi, digits));
        if lo == hi {
            return decimal_text(&lo, digits);
        }
        let scale = Rational::from_integer(ten_to(digits));
        let down = (&self.lo * &scale).floor().to_integer();
        let up = (&self.hi * &scale).ceil().to_integer();
        format!(
            "[{}, {}]",
            decimal_text(&down, digits),
            decimal_text(&up, digits)
        )
    }
}

fn ten_to(digits: u32) -> BigInt {
    BigInt::from(10).pow(digits)
}

/// `x 10^digits` to the nearest integer, halves upwards.
fn nearest(x: &Rational, digits: u32) -> BigInt {
    let twice = x * Rational::from_integer(ten_to(digits) * 2) + Rational::one();
    twice.floor().to_integer().div_floor(&BigInt::from(2))
}

fn decimal_text(scaled: &BigInt, digits: u32) -> String {
    let (whole, part) = scaled.div_rem(&ten_to(digits));
    if digits == 0 {
        return whole.to_string();
    }
    format!(
        "{whole}.{:0>width$}",
        part.to_string(),
        width = digits as usize
    )
}

/// A nonnegative decimal as printed: with p digits after the point it stands for every number within
/// `10^-p / 2` of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Printed(&'static str);

impl Printed {
    /// The decimal as it is printed.
    pub const fn new(text: &'static str) -> Self {
        Printed(text)
    }

    /// Digits after the point.
    pub fn digits(self) -> u32 {
        self.0
            .split_once('.')
            .map_or(0, |(_, part)| part.len() as u32)
    }

    /// The decimal as an exact number.
    ///
    /// # Panics
    /// If it is none: the printed decimals are constants.
    pub fn exact(self) -> Rational {
        let digits: String = self.0.chars().filter(|c| *c != '.').collect();
        let scaled = BigInt::from_str(&digits).expect("a printed decimal");
        Rational::new(scaled, ten_to(self.digits()))
    }

    /// The numbers that the print stands for.
    pub fn range(self) -> Enclosure {
        let half = Rational::new(BigInt::one(), ten_to(self.digits()) * 2);
        let value = self.exact();
        let lo = if order(&value, &half).is_lt() {
            Rational::zero()
        } else {
            &value - &half
        };
        Enclosure::new(lo, value + half)
    }

    /// How the print compares with a number: `Equal` if it stands for it, `Less` if it is too small,
    /// `Greater` if it is too large; `None` if the enclosure does not tell.
    pub fn compare(self, value: &Enclosure) -> Option<Ordering> {
        let range = self.range();
        if order(&range.hi, &value.lo).is_lt() {
            Some(Ordering::Less)
        } else if order(&range.lo, &value.hi).is_gt() {
            Some(Ordering::Greater)
        } else {
            let inside = order(&range.lo, &value.lo).is_le() && order(&value.hi, &range.hi).is_le();
            inside.then_some(Ordering::Equal)
        }
    }
}

impl fmt::Display for Printed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Field;

    #[test]
    fn prints_stand_for_half_a_unit_in_the_last_place() {
        let printed = Printed::new("0.25");
        let at = |p, q| Enclosure::exactly(Rational::ratio(p, q));
        assert_eq!(printed.compare(&at(255, 1000)), Some(Ordering::Equal));
        assert_eq!(printed.compare(&at(2551, 10000)), Some(Ordering::Less));
        assert_eq!(printed.compare(&at(2449, 10000)), Some(Ordering::Greater));
        let wide = Enclosure::new(Rational::ratio(1, 4), Rational::ratio(1, 2));
        assert_eq!(printed.compare(&wide), None);
        assert_eq!(Printed::new("14").range().lo, Rational::ratio(27, 2));
    }

    #[test]
    fn decimals_show_what_is_certain() {
        let third = Enclosure::exactly(Rational::ratio(1, 3));
        assert_eq!(third.decimal(4), "0.3333");
        assert_eq!(
            Enclosure::exactly(Rational::ratio(1, 200)).decimal(2),
            "0.01"
        );
        let wide = Enclosure::new(Rational::ratio(1, 3), Rational::ratio(5, 3));
        assert_eq!(wide.decimal(2), "[0.33, 1.67]");
    }
}
