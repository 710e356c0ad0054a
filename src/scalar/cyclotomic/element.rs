//! An element: its coefficients, its enclosures, its sign.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::fmt;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::field::{RealField, common_conductor, conductor, dickson_to_powers, field_degree};
use crate::scalar::float::{power_of_two, round_down, round_up};
use crate::scalar::{Field, Interval, Rational, Ring};

/// Two fields are joined only if the common field has at most this degree over Q.
///
/// The valences 7, 9 and 11 have a common field of degree 180; 5, 7, 8, 9 and 11 one of degree 2880.
pub const MAX_COMMON_DEGREE: usize = 256;

/// An exact element of a field Q(2 cos 2π/n): `(a_0 + Σ a_k C_k) / denominator`, C_k =
/// 2 cos(2π k/n), 1 <= k < φ(n)/2, in lowest terms.
///
/// A rational value has only a_0 and belongs to every field. Every other value has one form in
/// each of its fields.
///
/// ```
/// use subcert::scalar::{Cyclotomic, Decide, Field, Ring};
/// use num_traits::{One, Zero};
/// // The golden ratio: g = 2 cos(2π/10), g^2 = g + 1.
/// let g = Cyclotomic::two_cos(1, 10).unwrap();
/// assert_eq!(g.clone() * &g, g.clone() + &Cyclotomic::one());
/// assert_eq!(g.decide(&Cyclotomic::ratio(1618, 1000)), Some(std::cmp::Ordering::Greater));
/// ```
///
/// # Panics
/// The operators panic on division by zero, as those of [`Rational`] do, and if the operands are
/// not [`Cyclotomic::compatible`].
#[derive(Clone)]
pub struct Cyclotomic {
    /// `None` if and only if there is one coefficient.
    pub(super) field: Option<&'static RealField>,
    /// No trailing zeros beyond the first entry.
    pub(super) coefficients: Vec<BigInt>,
    /// Positive; no factor in common with all coefficients.
    pub(super) denominator: BigInt,
}

impl Cyclotomic {
    /// Reduces to the normal form. `denominator != 0`.
    pub(super) fn normal(
        field: Option<&'static RealField>,
        mut coefficients: Vec<BigInt>,
        mut denominator: BigInt,
    ) -> Self {
        while coefficients.len() > 1 && coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        let mut common = if denominator.is_one() {
            BigInt::one()
        } else {
            coefficients.iter().fold(denominator.clone(), |common, a| {
                if common.is_one() {
                    common
                } else {
                    common.gcd(a)
                }
            })
        };
        if denominator.is_negative() {
            common = -common.abs();
        }
        if !common.is_one() {
            coefficients.iter_mut().for_each(|a| *a /= &common);
            denominator /= &common;
        }
        Cyclotomic {
            field: field.filter(|_| coefficients.len() > 1),
            coefficients,
            denominator,
        }
    }

    /// The rational number `x`.
    pub fn from_rational(x: &Rational) -> Self {
        Cyclotomic {
            field: None,
            coefficients: vec![x.numer().clone()],
            denominator: x.denom().clone(),
        }
    }

    /// The value as a rational; `None` if and only if it is irrational.
    pub fn to_rational(&self) -> Option<Rational> {
        match self.field {
            None => Some(Rational::new(
                self.coefficients[0].clone(),
                self.denominator.clone(),
            )),
            Some(_) => None,
        }
    }

    /// The n of the field Q(2 cos 2π/n) the value is written in, n odd or divisible by 4; 1 for a
    /// rational.
    pub fn conductor(&self) -> u32 {
        self.field.map_or(1, |field| field.n)
    }

    /// The degree of that field over Q.
    pub fn field_degree(&self) -> usize {
        self.field.map_or(1, |field| field.degree)
    }

    /// The coefficients of the value as a polynomial in 2 cos(2π/n), n = [`Cyclotomic::conductor`],
    /// constant term first, degree below [`Cyclotomic::field_degree`].
    pub fn power_coefficients(&self) -> Vec<Rational> {
        let powers = dickson_to_powers(&self.coefficients);
        let over = |a: BigInt| Rational::new(a, self.denominator.clone());
        powers.into_iter().map(over).collect()
    }

    /// Whether the operators accept `self` and `other`: one is rational, or the fields are the
    /// same, or one contains the other, or the common field has degree at most
    /// [`MAX_COMMON_DEGREE`].
    pub fn compatible(&self, other: &Self) -> bool {
        self.aligned(other, MAX_COMMON_DEGREE).is_ok()
    }

    /// Both values' coefficients in one field; the degree that would be needed if it is beyond
    /// `cap`.
    pub(super) fn aligned<'a>(
        &'a self,
        other: &'a Self,
        cap: usize,
    ) -> Result<Aligned<'a>, FieldMismatch> {
        let borrowed = |field| Aligned {
            field,
            left: Cow::Borrowed(&self.coefficients[..]),
            right: Cow::Borrowed(&other.coefficients[..]),
        };
        let (a, b) = match (self.field, other.field) {
            (None, field) | (field, None) => return Ok(borrowed(field)),
            (Some(a), Some(b)) if a.n == b.n => return Ok(borrowed(Some(a))),
            (Some(a), Some(b)) => (a, b),
        };
        let mismatch = |degree| FieldMismatch {
            valences: (a.n, b.n),
            degree,
        };
        let n = common_conductor(a.n, b.n).ok_or(mismatch(None))?;
        if n != a.n && n != b.n && field_degree(n) > cap {
            return Err(mismatch(Some(field_degree(n))));
        }
        let field = RealField::get(n);
        Ok(Aligned {
            field: Some(field),
            left: embed(&self.coefficients, a, field),
            right: embed(&other.coefficients, b, field),
        })
    }

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
    ///
    /// Equal numbers of fields beyond [`MAX_COMMON_DEGREE`] are slow to compare.
    pub fn compare(&self, other: &Self) -> Ordering {
        if !self.compatible(other) {
            for bits in [64, 256, 1024] {
                let ((a_inf, a_sup), (b_inf, b_sup)) =
                    (self.enclose_rational(bits), other.enclose_rational(bits));
                if a_sup < b_inf {
                    return Ordering::Less;
                } else if b_sup < a_inf {
                    return Ordering::Greater;
                }
            }
        }
        let difference = self.sum(&-other, usize::MAX);
        difference
            .unwrap_or_else(|mismatch| panic!("{mismatch}"))
            .signum()
            .cmp(&0)
    }

    /// The number 2 cos(2π j/n), n >= 1; see [`Field::two_cos`].
    pub(super) fn cosine(j: u32, n: u32) -> Option<Self> {
        if n == 0 {
            return None;
        }
        let divisor = j.gcd(&n);
        let (j, n) = (u64::from(j / divisor), n / divisor);
        if let Some(value) = <Rational as Field>::two_cos((j % u64::from(n)) as u32, n) {
            return Some(Self::from_rational(&value));
        }
        let field = RealField::get(conductor(n));
        // For n = 2m, m odd, j is odd: cos(π j/m) = -cos(π (j + m)/m), and (j + m)/2 is an integer.
        let (j, sign) = if field.n == n {
            (j, 1)
        } else {
            ((j + u64::from(field.n)) / 2, -1)
        };
        let mut sums = field.empty_sums();
        sums[field.fold(j)] = BigInt::from(sign);
        let coefficients = field.reduce(BigInt::ZERO, sums);
        Some(Self::normal(Some(field), coefficients, BigInt::one()))
    }
}

/// Two coefficient vectors over one basis.
pub(super) struct Aligned<'a> {
    pub field: Option<&'static RealField>,
    pub left: Cow<'a, [BigInt]>,
    pub right: Cow<'a, [BigInt]>,
}

/// Why two values can't meet in one field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FieldMismatch {
    valences: (u32, u32),
    degree: Option<usize>,
}

impl fmt::Display for FieldMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (m, n) = self.valences;
        write!(
            f,
            "exact arithmetic cannot mix the valences {m} and {n}: their common field has "
        )?;
        match self.degree {
            Some(degree) => write!(f, "degree {degree}, more than {MAX_COMMON_DEGREE}")?,
            None => write!(f, "an index beyond 2^32")?,
        }
        write!(f, " (`compatible` tells beforehand)")
    }
}

/// The coefficients in a larger field: 2 cos(2π k/n) = 2 cos(2π k (N/n) / N).
fn embed<'a>(coefficients: &'a [BigInt], from: &RealField, to: &RealField) -> Cow<'a, [BigInt]> {
    if from.n == to.n {
        return Cow::Borrowed(coefficients);
    }
    let factor = u64::from(to.n / from.n);
    let mut sums = to.empty_sums();
    for (k, a) in (0u64..).zip(coefficients).skip(1) {
        sums[to.fold(k * factor)] += a;
    }
    Cow::Owned(to.reduce(coefficients[0].clone(), sums))
}

impl fmt::Display for Cyclotomic {
    /// For example `(3 - 2 c1 + c4)/8, ck = 2 cos(2πk/11)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(field) = self.field else {
            let value = Rational::new(self.coefficients[0].clone(), self.denominator.clone());
            return write!(f, "{value}");
        };
        let mut sum = String::new();
        let terms = self.coefficients.iter().enumerate();
        for (k, a) in terms.filter(|(_, a)| !a.is_zero()) {
            let sign = match (sum.is_empty(), a.is_negative()) {
                (true, false) => "",
                (true, true) => "-",
                (false, false) => " + ",
                (false, true) => " - ",
            };
            let size = a.abs();
            sum += sign;
            sum += &match (k, size.is_one()) {
                (0, _) => size.to_string(),
                (_, true) => format!("c{k}"),
                _ => format!("{size} c{k}"),
            };
        }
        write!(
            f,
            "({sum})/{}, ck = 2 cos(2πk/{})",
            self.denominator, field.n
        )
    }
}

impl fmt::Debug for Cyclotomic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl PartialEq for Cyclotomic {
    /// Equality of the numbers, whatever their fields.
    fn eq(&self, other: &Self) -> bool {
        match (self.field, other.field) {
            (Some(a), Some(b)) if a.n != b.n => self.compare(other).is_eq(),
            (a, b) => {
                a.is_some() == b.is_some()
                    && self.coefficients == other.coefficients
                    && self.denominator == other.denominator
            }
        }
    }
}

impl Eq for Cyclotomic {}

impl Ring for Cyclotomic {
    fn from_integer(k: i64) -> Self {
        Cyclotomic {
            field: None,
            coefficients: vec![BigInt::from(k)],
            denominator: BigInt::one(),
        }
    }
}
