//! Closed intervals with outward rounding: a newtype over [`inari::Interval`] that fails safe.
//!
//! **Guarantee.** If every operand contains the number it stands for, so does the result. The
//! inclusion is kept by three rules where IEEE 1788 allows less:
//!
//! * no `Interval` is ever empty: what has no value (NaN bounds, a division by an interval that
//!   contains 0) is the whole line, which contains everything and decides nothing;
//! * operations that may have no result return an `Option` ([`Interval::sqrt`],
//!   [`Interval::intersection`]);
//! * [`Decide`] answers on bounded intervals only, `None` on overlap.
//!
//! The processor must round to nearest and keep subnormals:
//! [`super::environment::verify_floating_point`].

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use inari::Interval as Inner;
use num_traits::{One, Zero};

use super::float::{LARGEST_EXACT_INTEGER, round_down, round_up};
use super::{Decide, Field, Rational, Ring, cosine};

/// A nonempty closed interval of real numbers, possibly unbounded.
///
/// `==` is equality of sets: not of the numbers enclosed. For those there is [`Decide`].
///
/// ```
/// use subcert::scalar::{Decide, Field, Interval};
/// let third = Interval::ratio(1, 3);
/// assert!(third.inf() < third.sup() && third.wid() < 1e-16);
/// assert_eq!(third.decide(&Interval::ratio(1, 3)), None);
/// assert_eq!(third.decide(&Interval::ratio(1, 2)), Some(std::cmp::Ordering::Less));
/// ```
#[derive(Clone, Copy, PartialEq)]
pub struct Interval(Inner);

impl Interval {
    /// The whole line: contains every number, decides nothing.
    pub const ENTIRE: Interval = Interval(Inner::ENTIRE);

    /// `[inf, sup]`; [`Interval::ENTIRE`] unless inf <= sup, inf < +∞ and sup > -∞ (so for NaN).
    #[inline]
    pub fn new(inf: f64, sup: f64) -> Self {
        Interval(Inner::try_from((inf, sup)).unwrap_or(Inner::ENTIRE))
    }

    /// `[x, x]`; [`Interval::ENTIRE`] for an infinite or NaN `x`.
    #[inline]
    pub fn point(x: f64) -> Self {
        Self::new(x, x)
    }

    /// The tightest enclosure of a rational by `f64` bounds.
    pub fn from_rational(x: &Rational) -> Self {
        Self::new(round_down(x), round_up(x))
    }

    /// The lower end; -∞ if unbounded below; never -0.
    #[inline]
    pub fn inf(self) -> f64 {
        self.0.inf() + 0.0
    }

    /// The upper end; +∞ if unbounded above; never -0.
    #[inline]
    pub fn sup(self) -> f64 {
        self.0.sup() + 0.0
    }

    /// An `f64` in the interval, the nearest to its middle if bounded.
    #[inline]
    pub fn mid(self) -> f64 {
        self.0.mid()
    }

    /// An upper bound of `sup - inf`.
    #[inline]
    pub fn wid(self) -> f64 {
        self.0.wid()
    }

    /// The largest |x| in the interval, exactly.
    #[inline]
    pub fn mag(self) -> f64 {
        self.0.mag()
    }

    /// The smallest |x| in the interval, exactly.
    #[inline]
    pub fn mig(self) -> f64 {
        self.0.mig() + 0.0
    }

    /// Whether both ends are finite.
    #[inline]
    pub fn is_bounded(self) -> bool {
        self.0.is_common_interval()
    }

    /// Whether the number `x` lies in the interval; false for an infinite or NaN `x`.
    #[inline]
    pub fn contains(self, x: f64) -> bool {
        self.0.contains(x)
    }

    /// Whether `x` lies in the interval, decided exactly.
    pub fn contains_rational(self, x: &Rational) -> bool {
        // from_float is exact and None for an infinite end, which bounds nothing.
        let at_least = Rational::from_float(self.inf()).is_none_or(|inf| inf <= *x);
        let at_most = Rational::from_float(self.sup()).is_none_or(|sup| *x <= sup);
        at_least && at_most
    }

    /// Whether every number of `self` lies in `other`.
    #[inline]
    pub fn subset(self, other: Self) -> bool {
        self.0.subset(other.0)
    }

    /// The smallest interval that contains both.
    #[inline]
    pub fn hull(self, other: Self) -> Self {
        Interval(self.0.convex_hull(other.0))
    }

    /// The common part; `None` if and only if there is none: then no number was in both.
    #[inline]
    pub fn intersection(self, other: Self) -> Option<Self> {
        let common = self.0.intersection(other.0);
        (!common.is_empty()).then_some(Interval(common))
    }

    /// The range of x^2; nonnegative, unlike `self * self`.
    #[inline]
    pub fn sqr(self) -> Self {
        Interval(self.0.sqr())
    }

    /// The range of the square root; `None` if and only if the interval has a negative number.
    #[inline]
    pub fn sqrt(self) -> Option<Self> {
        (self.inf() >= 0.0).then(|| Interval(self.0.sqrt()))
    }

    /// The range of max(x, y).
    #[inline]
    pub fn max(self, other: Self) -> Self {
        Interval(self.0.max(other.0))
    }

    /// The range of min(x, y).
    #[inline]
    pub fn min(self, other: Self) -> Self {
        Interval(self.0.min(other.0))
    }

    /// The range of |x|.
    #[inline]
    pub fn abs(self) -> Self {
        Interval(self.0.abs())
    }

    #[inline]
    fn quotient(self, divisor: Self) -> Self {
        if divisor.contains(0.0) {
            return Self::ENTIRE;
        }
        Interval(self.0 / divisor.0)
    }
}

impl fmt::Display for Interval {
    /// `[inf, sup]`, each end in the shortest decimals that read back as the same `f64`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{:?}, {:?}]", self.inf(), self.sup())
    }
}

impl fmt::Debug for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

macro_rules! operator {
    ($Op:ident, $op:ident, $OpAssign:ident, $op_assign:ident, |$a:ident, $b:ident| $value:expr) => {
        impl $Op for Interval {
            type Output = Interval;
            #[inline]
            fn $op(self, other: Interval) -> Interval {
                let ($a, $b) = (self, other);
                $value
            }
        }
        impl $Op<&Interval> for Interval {
            type Output = Interval;
            #[inline]
            fn $op(self, other: &Interval) -> Interval {
                $Op::$op(self, *other)
            }
        }
        impl $Op<Interval> for &Interval {
            type Output = Interval;
            #[inline]
            fn $op(self, other: Interval) -> Interval {
                $Op::$op(*self, other)
            }
        }
        impl $Op<&Interval> for &Interval {
            type Output = Interval;
            #[inline]
            fn $op(self, other: &Interval) -> Interval {
                $Op::$op(*self, *other)
            }
        }
        impl $OpAssign for Interval {
            #[inline]
            fn $op_assign(&mut self, other: Interval) {
                *self = $Op::$op(*self, other);
            }
        }
        impl $OpAssign<&Interval> for Interval {
            #[inline]
            fn $op_assign(&mut self, other: &Interval) {
                *self = $Op::$op(*self, *other);
            }
        }
    };
}

operator!(Add, add, AddAssign, add_assign, |a, b| Interval(a.0 + b.0));
operator!(Sub, sub, SubAssign, sub_assign, |a, b| Interval(a.0 - b.0));
operator!(Mul, mul, MulAssign, mul_assign, |a, b| Interval(a.0 * b.0));
operator!(Div, div, DivAssign, div_assign, |a, b| a.quotient(b));

impl Neg for Interval {
    type Output = Interval;
    #[inline]
    fn neg(self) -> Interval {
        Interval(-self.0)
    }
}

impl Neg for &Interval {
    type Output = Interval;
    #[inline]
    fn neg(self) -> Interval {
        Interval(-self.0)
    }
}

impl Zero for Interval {
    #[inline]
    fn zero() -> Self {
        Self::point(0.0)
    }
    /// Whether the interval is exactly {0}.
    #[inline]
    fn is_zero(&self) -> bool {
        self.inf() == 0.0 && self.sup() == 0.0
    }
}

impl One for Interval {
    #[inline]
    fn one() -> Self {
        Self::point(1.0)
    }
}

impl Ring for Interval {
    /// `[k, k]` if k is an `f64`, else its two neighbours.
    #[inline]
    fn from_integer(k: i64) -> Self {
        let near = k as f64;
        if k.unsigned_abs() <= LARGEST_EXACT_INTEGER {
            return Self::point(near);
        }
        // |near| <= 2^63, so it is an integer that i128 holds.
        match (near as i128).cmp(&i128::from(k)) {
            Ordering::Equal => Self::point(near),
            Ordering::Less => Self::new(near, near.next_up()),
            Ordering::Greater => Self::new(near.next_down(), near),
        }
    }
}

impl Field for Interval {
    /// The tightest enclosure if both integers are at most 2^53 in magnitude.
    #[inline]
    fn ratio(p: i64, q: i64) -> Self {
        Self::from_integer(p).quotient(Self::from_integer(q))
    }

    /// Encloses by the signs of integers ([`cosine::enclose_two_cos`]): two neighbouring `f64`, at
    /// worst three; a point if the number is an integer.
    fn two_cos(j: u32, n: u32) -> Option<Self> {
        let rounded = cosine::rounded_two_cos(j, n)?;
        Some(Self::new(rounded.inf, rounded.sup))
    }
}

impl Decide for Interval {
    /// `Less` or `Greater` if the intervals are apart, `Equal` if they are the same single number,
    /// both bounded; else undecided.
    fn decide(&self, other: &Self) -> Option<Ordering> {
        if !self.is_bounded() || !other.is_bounded() {
            None
        } else if self.sup() < other.inf() {
            Some(Ordering::Less)
        } else if self.inf() > other.sup() {
            Some(Ordering::Greater)
        } else if self.inf() == other.sup() && self.sup() == other.inf() {
            Some(Ordering::Equal)
        } else {
            None
        }
    }
}
