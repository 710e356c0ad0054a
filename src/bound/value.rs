//! Numbers of the form `(polynomial in b) / q`, b the ring weight of a valence, q = 3 + 8 n b.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::functional::Integer;
use crate::scalar::{Cyclotomic, Interval, Rational, Ring};
use crate::scheme::{LoopWeights, loop_scheme};

/// The number `(Σ c_d b^d) / q`: an identity of values holds for every b, its size only for the b of
/// a valence, [`RingWeight`]. No trailing zeros.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Value(Vec<Rational>);

impl Value {
    /// From the coefficients of b^0, b^1, ..
    pub fn new(mut coefficients: Vec<Rational>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Value(coefficients)
    }

    /// The coefficients of b^0, b^1, .. of the numerator.
    pub fn coefficients(&self) -> &[Rational] {
        &self.0
    }

    /// The rational r, that is r q / q.
    pub fn rational(n: u32, r: &Rational) -> Self {
        let over = |k: i64| r * <Rational as Ring>::from_integer(k);
        Self::new(vec![over(3), over(8 * i64::from(n))])
    }

    /// r, if the numerator is r q identically.
    fn to_rational(&self, n: u32) -> Option<Rational> {
        let r = match self.0.first() {
            None => Rational::zero(),
            Some(constant) => constant / <Rational as Ring>::from_integer(3),
        };
        (Self::rational(n, &r) == *self).then_some(r)
    }

    /// The coefficients in powers of β = n b.
    pub fn ring_sum_coefficients(&self, n: u32) -> Vec<Rational> {
        let n = <Rational as Ring>::from_integer(i64::from(n));
        let mut power = Rational::one();
        let scale = |c: &Rational| {
            let scaled = c / &power;
            power = &power * &n;
            scaled
        };
        self.0.iter().map(scale).collect()
    }

    /// From the coefficients in powers of β = n b.
    pub fn from_ring_sum_coefficients(n: u32, coefficients: &[Rational]) -> Self {
        let n = <Rational as Ring>::from_integer(i64::from(n));
        let mut power = Rational::one();
        let scale = |c: &Rational| {
            let scaled = c * &power;
            power = &power * &n;
            scaled
        };
        Self::new(coefficients.iter().map(scale).collect())
    }

    fn combine(&self, other: &Self, op: impl Fn(&Rational, &Rational) -> Rational) -> Self {
        let zero = Rational::zero();
        let at = |v: &Self, d: usize| v.0.get(d).unwrap_or(&zero).clone();
        let degrees = 0..self.0.len().max(other.0.len());
        Self::new(degrees.map(|d| op(&at(self, d), &at(other, d))).collect())
    }
}

impl Zero for Value {
    fn zero() -> Self {
        Value(Vec::new())
    }
    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }
}

impl Add for Value {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self + &other
    }
}

impl Add<&Value> for Value {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        self.combine(other, |a, b| a + b)
    }
}

impl Sub<&Value> for Value {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        self.combine(other, |a, b| a - b)
    }
}

impl Mul<&Rational> for Value {
    type Output = Self;
    fn mul(self, factor: &Rational) -> Self {
        Self::new(self.0.iter().map(|c| c * factor).collect())
    }
}

/// The ring weight b of a valence: an exact number, enclosures of it, and the signs of polynomials
/// in it.
#[derive(Clone, Debug)]
pub struct RingWeight {
    /// The valence.
    pub n: u32,
    /// The weights.
    pub weights: LoopWeights,
    /// b.
    pub exact: Cyclotomic,
    interval: Interval,
    fine: (Rational, Rational),
}

/// Bits of the enclosure that decides where `f64` intervals do not.
const FINE_BITS: u32 = 220;

impl RingWeight {
    /// The ring weight of a valence n >= 3.
    pub fn new(weights: LoopWeights, n: u32) -> Self {
        let sum = loop_scheme::ring_weight_sum::<Cyclotomic>(weights, n)
            .expect("cyclotomic numbers have every cosine");
        let exact = sum / Cyclotomic::from_integer(i64::from(n));
        RingWeight {
            n,
            weights,
            interval: exact.enclose(),
            fine: exact.enclose_rational(FINE_BITS),
            exact,
        }
    }

    /// b in `f64`: a proposal.
    pub fn float(&self) -> f64 {
        self.interval.mid()
    }

    /// Whether b is rational: then every question is decided.
    pub fn is_rational(&self) -> bool {
        self.fine.0 == self.fine.1
    }

    /// The largest |p(b)| over the fine enclosure of b, and the sign of p(b) if that is certain there;
    /// 0 only if p is identically zero or b is rational.
    pub fn sign<T: Integer>(&self, p: &[T]) -> Option<i32> {
        if p.iter().all(Integer::is_zero) {
            return Some(0);
        }
        let zero = Interval::point(0.0);
        let horner = |sum: Interval, c: &T| sum * self.interval + c.enclose();
        let rough = p.iter().rev().fold(zero, horner);
        if rough.inf() > 0.0 {
            return Some(1);
        } else if rough.sup() < 0.0 {
            return Some(-1);
        }
        let big: Vec<Rational> = p
            .iter()
            .map(|c| Rational::from_integer(c.to_big()))
            .collect();
        sign_of(&self.fine_range(&big))
    }

    /// The range of a polynomial over the fine enclosure of b > 0.
    fn fine_range(&self, p: &[Rational]) -> (Rational, Rational) {
        let (b_inf, b_sup) = &self.fine;
        let step = |(inf, sup): (Rational, Rational), c: &Rational| {
            let low = if inf.is_negative() { b_sup } else { b_inf };
            let high = if sup.is_negative() { b_inf } else { b_sup };
            (inf * low + c, sup * high + c)
        };
        p.iter()
            .rev()
            .fold((Rational::zero(), Rational::zero()), step)
    }

    /// A rational at least |p(b)|.
    pub fn magnitude<T: Integer>(&self, p: &[T]) -> Rational {
        let big: Vec<Rational> = p
            .iter()
            .map(|c| Rational::from_integer(c.to_big()))
            .collect();
        let (inf, sup) = self.fine_range(&big);
        inf.abs().max(sup.abs())
    }

    /// The order of two values: `Equal` only if they are identical or b is rational; `None` if it
    /// takes more than the fine enclosure.
    pub fn compare(&self, a: &Value, b: &Value) -> Option<Ordering> {
        let difference = a.clone() - b;
        if difference.is_zero() {
            return Some(Ordering::Equal);
        }
        let zero = Interval::point(0.0);
        let coefficients = difference.coefficients();
        let horner = |sum: Interval, c: &Rational| sum * self.interval + Interval::from_rational(c);
        let rough = coefficients.iter().rev().fold(zero, horner);
        if rough.inf() > 0.0 {
            return Some(Ordering::Greater);
        } else if rough.sup() < 0.0 {
            return Some(Ordering::Less);
        }
        sign_of(&self.fine_range(coefficients)).map(|sign| sign.cmp(&0))
    }

    /// Whether a <= b, certainly.
    pub fn at_most(&self, a: &Value, b: &Value) -> bool {
        matches!(self.compare(a, b), Some(Ordering::Less | Ordering::Equal))
    }

    /// An enclosure of a value by `f64`; the tightest one for rationals.
    pub fn enclose(&self, value: &Value) -> Interval {
        if let Some(r) = self.rational(value) {
            return Interval::from_rational(&r);
        }
        let (inf, sup) = self.fine_range(value.coefficients());
        let (q_inf, q_sup) = self.fine_range(&[
            <Rational as Ring>::from_integer(3),
            <Rational as Ring>::from_integer(8 * i64::from(self.n)),
        ]);
        let over = |x: Rational, small: &Rational, large: &Rational| {
            let negative = x.is_negative();
            x / if negative { small } else { large }
        };
        let inf = Interval::from_rational(&over(inf, &q_inf, &q_sup)).inf();
        let sup = Interval::from_rational(&over(sup, &q_sup, &q_inf)).sup();
        Interval::new(inf, sup)
    }

    /// The value as a rational: if it is one for every b, or if b is rational.
    pub fn rational(&self, value: &Value) -> Option<Rational> {
        let identically = value.to_rational(self.n);
        identically.or_else(|| {
            self.is_rational()
                .then(|| self.evaluate(value).to_rational())?
        })
    }

    /// The value as an exact number.
    pub fn evaluate(&self, value: &Value) -> Cyclotomic {
        let horner =
            |sum: Cyclotomic, c: &Rational| sum * &self.exact + Cyclotomic::from_rational(c);
        let numerator =
            (value.coefficients().iter().rev()).fold(Cyclotomic::from_integer(0), horner);
        let q = Cyclotomic::from_integer(8 * i64::from(self.n)) * &self.exact
            + Cyclotomic::from_integer(3);
        numerator / q
    }
}

fn sign_of((inf, sup): &(Rational, Rational)) -> Option<i32> {
    if inf.is_positive() {
        Some(1)
    } else if sup.is_negative() {
        Some(-1)
    } else {
        (inf.is_zero() && sup.is_zero()).then_some(0)
    }
}

/// `Σ_d p_d b^d / denominator` as a value.
pub(super) fn value_of<T: Integer>(p: &[T], denominator: &BigInt) -> Value {
    let over = |c: &T| Rational::new(c.to_big(), denominator.clone());
    Value::new(p.iter().map(over).collect())
}
