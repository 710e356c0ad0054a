//! Exact numbers of a scheme at a valence: rational combinations of a few real numbers g_0 = 1, g_1, ..,
//! over a common denominator q.
//!
//! | scheme | g_d | q |
//! |---|---|---|
//! | Loop | b^d, b the ring weight | 3 + 8 n b |
//! | Catmull-Clark | g_0 only | 1 |
//! | Doo-Sabin | cos(2πd/n), 2 g_a g_b = g_(a+b) + g_(a-b) | 1 |

use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::functional::Integer;
use crate::scalar::{Cyclotomic, Field, Interval, Rational, Ring};
use crate::scheme::{LoopWeights, loop_scheme};

/// The number `(Σ c_d g_d) / q`: an identity of values holds whatever the g_d; its size is known by the
/// [`Numbers`]. No trailing zeros.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Value(Vec<Rational>);

impl Value {
    /// From the coefficients of g_0, g_1, ..
    pub fn new(mut coefficients: Vec<Rational>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Value(coefficients)
    }

    /// The coefficients of g_0, g_1, .. in the numerator.
    pub fn coefficients(&self) -> &[Rational] {
        &self.0
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

/// The numbers g_d of a scheme at a valence: enclosures, signs of combinations, exact values.
#[derive(Clone, Debug)]
pub struct Numbers {
    /// The valence, or the number of sides of Doo-Sabin's face.
    pub n: u32,
    /// q, by its coefficients.
    q: Value,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    /// g_d = b^d.
    Powers {
        exact: Cyclotomic,
        interval: Interval,
        fine: (Rational, Rational),
    },
    /// g_d = cos(2πd/n).
    Cosines {
        intervals: Vec<Interval>,
        fine: Vec<(Rational, Rational)>,
    },
}

/// Bits of the enclosure that decides where `f64` intervals do not.
const FINE_BITS: u32 = 220;

impl Numbers {
    /// For Loop's scheme at valence n >= 3.
    pub fn of_loop(weights: LoopWeights, n: u32) -> Self {
        let sum = loop_scheme::ring_weight_sum::<Cyclotomic>(weights, n)
            .expect("cyclotomic numbers have every cosine");
        let exact = sum / Cyclotomic::from_integer(i64::from(n));
        let q = [3, 8 * i64::from(n)].map(<Rational as Ring>::from_integer);
        Self::powers(n, exact, Value::new(q.to_vec()))
    }

    /// Rational numbers only: for Catmull-Clark at valence n.
    pub fn rationals(n: u32) -> Self {
        let one = Value::new(vec![Rational::one()]);
        Self::powers(n, Cyclotomic::from_integer(0), one)
    }

    fn powers(n: u32, exact: Cyclotomic, q: Value) -> Self {
        let kind = Kind::Powers {
            interval: exact.enclose(),
            fine: exact.enclose_rational(FINE_BITS),
            exact,
        };
        Numbers { n, q, kind }
    }

    /// The cosines cos(2πd/n): for Doo-Sabin's face of n sides.
    pub fn cosines(n: u32) -> Self {
        let exact: Vec<Cyclotomic> = (0..=n / 2).map(|d| cosine_of(d, n)).collect();
        Numbers {
            n,
            q: Value::new(vec![Rational::one()]),
            kind: Kind::Cosines {
                intervals: exact.iter().map(Cyclotomic::enclose).collect(),
                fine: (exact.iter())
                    .map(|c| c.enclose_rational(FINE_BITS))
                    .collect(),
            },
        }
    }

    /// Loop's ring weight b; 0 for the other schemes.
    pub fn ring_weight(&self) -> Cyclotomic {
        match &self.kind {
            Kind::Powers { exact, .. } => exact.clone(),
            Kind::Cosines { .. } => Cyclotomic::from_integer(0),
        }
    }

    /// The rational r as a value: r q / q.
    pub fn constant(&self, r: &Rational) -> Value {
        self.q.clone() * r
    }

    /// Whether all g_d are rational: then every question is decided.
    pub fn is_rational(&self) -> bool {
        match &self.kind {
            Kind::Powers { fine, .. } => fine.0 == fine.1,
            Kind::Cosines { fine, .. } => fine.iter().all(|(inf, sup)| inf == sup),
        }
    }

    /// The sign of `Σ p_d g_d` if it is certain; 0 only if it is identically zero or all g_d are
    /// rational.
    pub fn sign<T: Integer>(&self, p: &[T]) -> Option<i32> {
        if p.iter().all(Integer::is_zero) {
            return Some(0);
        }
        let rough = self.rough(p, T::enclose);
        if rough.inf() > 0.0 {
            return Some(1);
        } else if rough.sup() < 0.0 {
            return Some(-1);
        }
        sign_of(&self.fine(&big(p)))
    }

    /// The range of `Σ p_d g_d` by `f64` intervals.
    fn rough<T>(&self, p: &[T], enclose: impl Fn(&T) -> Interval) -> Interval {
        let zero = Interval::point(0.0);
        match &self.kind {
            Kind::Powers { interval, .. } => {
                (p.iter().rev()).fold(zero, |sum, c| sum * *interval + enclose(c))
            }
            Kind::Cosines { intervals, .. } => {
                (p.iter().zip(intervals)).fold(zero, |sum, (c, g)| sum + enclose(c) * *g)
            }
        }
    }

    /// The range of `Σ p_d g_d` by the fine enclosures.
    fn fine(&self, p: &[Rational]) -> (Rational, Rational) {
        let zero = (Rational::zero(), Rational::zero());
        match &self.kind {
            Kind::Powers { fine, .. } => {
                // Horner's rule; b >= 0.
                let (b_inf, b_sup) = fine;
                let step = |(inf, sup): (Rational, Rational), c: &Rational| {
                    let low = if inf.is_negative() { b_sup } else { b_inf };
                    let high = if sup.is_negative() { b_inf } else { b_sup };
                    (inf * low + c, sup * high + c)
                };
                p.iter().rev().fold(zero, step)
            }
            Kind::Cosines { fine, .. } => {
                let step = |(inf, sup): (Rational, Rational), (c, g): (&Rational, &_)| {
                    let (g_inf, g_sup): &(Rational, Rational) = g;
                    let (low, high) = match c.is_negative() {
                        true => (g_sup, g_inf),
                        false => (g_inf, g_sup),
                    };
                    (inf + low * c, sup + high * c)
                };
                p.iter().zip(fine).fold(zero, step)
            }
        }
    }

    /// A rational at least |Σ p_d g_d|.
    pub fn magnitude<T: Integer>(&self, p: &[T]) -> Rational {
        let (inf, sup) = self.fine(&big(p));
        inf.abs().max(sup.abs())
    }

    /// The order of two values: `Equal` only if they are identical or all g_d are rational; `None` if
    /// it takes more than the fine enclosures.
    pub fn compare(&self, a: &Value, b: &Value) -> Option<Ordering> {
        let difference = a.clone() - b;
        if difference.is_zero() {
            return Some(Ordering::Equal);
        }
        let coefficients = difference.coefficients();
        let rough = self.rough(coefficients, Interval::from_rational);
        if rough.inf() > 0.0 {
            return Some(Ordering::Greater);
        } else if rough.sup() < 0.0 {
            return Some(Ordering::Less);
        }
        sign_of(&self.fine(coefficients)).map(|sign| sign.cmp(&0))
    }

    /// Whether a <= b, certainly.
    pub fn at_most(&self, a: &Value, b: &Value) -> bool {
        matches!(self.compare(a, b), Some(Ordering::Less | Ordering::Equal))
    }

    /// q times the product of two values, as a value: the product of the numerators, over q.
    pub fn product(&self, a: &Value, b: &Value) -> Value {
        let (a, b) = (a.coefficients(), b.coefficients());
        match &self.kind {
            Kind::Powers { .. } => {
                let mut sums = vec![Rational::zero(); a.len() + b.len()];
                for (i, p) in a.iter().enumerate() {
                    for (j, q) in b.iter().enumerate() {
                        sums[i + j] += p * q;
                    }
                }
                Value::new(sums)
            }
            Kind::Cosines { fine, .. } => {
                let n = self.n as usize;
                let mut sums = vec![Rational::zero(); fine.len()];
                for (i, p) in a.iter().enumerate() {
                    for (j, q) in b.iter().enumerate() {
                        let half = p * q / <Rational as Ring>::from_integer(2);
                        for at in [(i + j) % n, (i + n - j) % n] {
                            sums[at.min(n - at)] += half.clone();
                        }
                    }
                }
                Value::new(sums)
            }
        }
    }

    /// An enclosure of a value by `f64`; the tightest one for rationals.
    pub fn enclose(&self, value: &Value) -> Interval {
        if let Some(r) = self.rational(value) {
            return Interval::from_rational(&r);
        }
        let (inf, sup) = self.fine(value.coefficients());
        let (q_inf, q_sup) = self.fine(self.q.coefficients());
        let over = |x: Rational, small: &Rational, large: &Rational| {
            let negative = x.is_negative();
            x / if negative { small } else { large }
        };
        let inf = Interval::from_rational(&over(inf, &q_inf, &q_sup)).inf();
        let sup = Interval::from_rational(&over(sup, &q_sup, &q_inf)).sup();
        Interval::new(inf, sup)
    }

    /// The value as a rational: if it is one identically, or if all g_d are rational.
    pub fn rational(&self, value: &Value) -> Option<Rational> {
        let constant = match value.0.first() {
            None => Rational::zero(),
            Some(constant) => constant / &self.q.0[0],
        };
        if self.constant(&constant) == *value {
            return Some(constant);
        }
        if !self.is_rational() {
            return None;
        }
        self.evaluate(value).to_rational()
    }

    /// The value as an exact number.
    pub fn evaluate(&self, value: &Value) -> Cyclotomic {
        self.numerator(value) / self.numerator(&self.q)
    }

    /// The numerator of a value as an exact number.
    pub fn numerator(&self, value: &Value) -> Cyclotomic {
        let zero = Cyclotomic::from_integer(0);
        let coefficients = value.coefficients();
        match &self.kind {
            Kind::Powers { exact, .. } => (coefficients.iter().rev())
                .fold(zero, |sum, c| sum * exact + Cyclotomic::from_rational(c)),
            Kind::Cosines { .. } => (0..).zip(coefficients).fold(zero, |sum, (d, c)| {
                sum + cosine_of(d, self.n) * &Cyclotomic::from_rational(c)
            }),
        }
    }
}

/// cos(2πd/n).
fn cosine_of(d: u32, n: u32) -> Cyclotomic {
    let twice = Cyclotomic::two_cos(d, n).expect("cyclotomic numbers have every cosine");
    twice / Cyclotomic::from_integer(2)
}

fn big<T: Integer>(p: &[T]) -> Vec<Rational> {
    p.iter()
        .map(|c| Rational::from_integer(c.to_big()))
        .collect()
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

/// `Σ_d p_d g_d / denominator` as a value.
pub(super) fn value_of<T: Integer>(p: &[T], denominator: &BigInt) -> Value {
    let over = |c: &T| Rational::new(c.to_big(), denominator.clone());
    Value::new(p.iter().map(over).collect())
}
