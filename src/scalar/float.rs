//! `f64` as a [`Field`]: fast, and never a claim; and the directed conversions to `f64`.
//!
//! **Standard model.** With rounding to nearest (checked by
//! [`super::environment::verify_floating_point`]) and no overflow, each of +, -, *, / and sqrt
//! returns
//!
//! ```text
//! fl(x op y) = (x op y)(1 + d) + e,   |d| <= u = 2^-53,   |e| <= 2^-1075,   d e = 0,
//! ```
//!
//! e = 0 for +, - and sqrt, and for * and / unless the result is subnormal. A product of k factors
//! (1 + d_i)^(+-1) is 1 + t with |t| <= [`gamma`]`(k)`, k u < 1 (Higham, *Accuracy and Stability of
//! Numerical Algorithms*, Lemma 3.1). Bounds in hot loops are derived from these two lines, in the
//! comment of the loop; whatever they give is rounded outward with [`f64::next_up`] and
//! [`f64::next_down`].

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::{Field, Rational, Ring, cosine};

/// The unit roundoff u = 2^-53: half the distance from 1 to the next larger `f64`.
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// Every integer of at most this magnitude is an `f64`.
pub(super) const LARGEST_EXACT_INTEGER: u64 = 1 << 53;

/// An upper bound of `k u / (1 - k u)`, [`UNIT_ROUNDOFF`] being u.
///
/// ```
/// use subcert::scalar::float::gamma;
/// assert_eq!(gamma(0), 0.0);
/// assert!(gamma(3) > 3.0 * 2f64.powi(-53) && gamma(3) < 3.1 * 2f64.powi(-53));
/// ```
pub fn gamma(k: u32) -> f64 {
    if k == 0 {
        return 0.0;
    }
    // k u and 1 - k u are multiples of 2^-53 of magnitude at most 1: both exact. The division
    // rounds once, by less than one step.
    let ku = f64::from(k) * UNIT_ROUNDOFF;
    (ku / (1.0 - ku)).next_up()
}

/// An `f64` at least `sqrt(x)`, at most one step above it (two below 2^-960).
///
/// For a negative or NaN `x` the answer is +∞: no bound is claimed.
pub fn upper_sqrt(x: f64) -> f64 {
    if x.is_nan() || x < 0.0 {
        return f64::INFINITY;
    }
    if x == 0.0 {
        return 0.0;
    }
    let root = x.sqrt();
    if root_is_certainly(root, x, |residual| residual >= 0.0) {
        root
    } else {
        root.next_up()
    }
}

/// An `f64` at most `sqrt(x)`, at most one step below it (two below 2^-960), never negative.
///
/// For a negative or NaN `x` the answer is 0.
pub fn lower_sqrt(x: f64) -> f64 {
    if x.is_nan() || x <= 0.0 {
        return 0.0;
    }
    let root = x.sqrt();
    if root_is_certainly(root, x, |residual| residual <= 0.0) {
        root
    } else {
        root.next_down()
    }
}

/// Whether root^2 - x certainly passes the test. The fused product-sum rounds once, so its sign is
/// right unless it underflows; root^2 - x is a multiple of ulp(root)^2 >= (2^-53 root)^2, which is
/// at least 2^-1074 as soon as x >= 2^-960.
fn root_is_certainly(root: f64, x: f64, test: impl Fn(f64) -> bool) -> bool {
    const SAFE: f64 = f64::from_bits((1023 - 960) << 52);
    root == f64::INFINITY || (x >= SAFE && test(root.mul_add(root, -x)))
}

/// The largest `f64` (or -∞) that is at most `x`; 0 is returned as +0.
///
/// ```
/// use subcert::scalar::{Field, Rational, float};
/// let third = Rational::ratio(1, 3);
/// assert_eq!(float::round_down(&third).next_up(), float::round_up(&third));
/// ```
pub fn round_down(x: &Rational) -> f64 {
    let (down, up) = magnitude_bounds(x);
    if x.is_negative() { -up } else { down }
}

/// The smallest `f64` (or +∞) that is at least `x`; 0 is returned as +0.
pub fn round_up(x: &Rational) -> f64 {
    let (down, up) = magnitude_bounds(x);
    // 0 - down, not -down: no negative zero.
    if x.is_negative() { 0.0 - down } else { up }
}

/// A decimal of so many digits (or one unit more) whose nearest `f64` is at least x > 0.
///
/// ```
/// use subcert::scalar::float::decimal_above;
/// use subcert::scalar::{Field, Rational};
/// assert_eq!(decimal_above(&Rational::ratio(1, 3), 4), "3334e-4");
/// ```
pub fn decimal_above(x: &Rational, digits: u32) -> String {
    let near = round_up(x);
    let exponent = near.log10().floor() as i32 + 1 - digits as i32;
    let mut mantissa = (near / 10.0f64.powi(exponent)).floor() as u64;
    loop {
        let text = format!("{mantissa}e{exponent}");
        let value: f64 = text.parse().expect("a number");
        if Rational::from_float(value).is_some_and(|value| value >= *x) {
            return text;
        }
        mantissa += 1;
    }
}

/// The `f64` nearest to `x`, ties to even, overflow to infinity as IEEE 754 has it.
pub fn round_to_nearest(x: &Rational) -> f64 {
    let magnitude = truncate(x.numer().magnitude().clone().into(), x.denom());
    let above_half = (&magnitude.remainder << 1u32).cmp(&magnitude.divisor);
    let up = above_half.is_gt() || (above_half.is_eq() && magnitude.mantissa & 1 == 1);
    let value = magnitude.scaled(magnitude.mantissa + u64::from(up));
    if x.is_negative() { 0.0 - value } else { value }
}

/// The neighbours of |x| in `f64`, below and above, equal if |x| is an `f64`.
fn magnitude_bounds(x: &Rational) -> (f64, f64) {
    let magnitude = truncate(x.numer().magnitude().clone().into(), x.denom());
    let down = magnitude.scaled(magnitude.mantissa);
    let up = if magnitude.remainder.is_zero() {
        down
    } else {
        magnitude.scaled(magnitude.mantissa + 1)
    };
    (down.min(f64::MAX), up)
}

/// `(mantissa + remainder / divisor) 2^exponent`, 0 <= remainder < divisor, with a mantissa of 53
/// bits, or fewer if the exponent is the least one, -1074.
struct Truncated {
    mantissa: u64,
    exponent: i64,
    remainder: BigInt,
    divisor: BigInt,
}

/// Divides p >= 0 by q > 0.
fn truncate(p: BigInt, q: &BigInt) -> Truncated {
    let bits = |k: &BigInt| i64::try_from(k.bits()).unwrap_or(i64::MAX / 4);
    // With B = bits(p) - bits(q): 2^(B-1) < p/q < 2^(B+1). So exponent B - 53 makes the quotient
    // less than 2^54 and at least 2^52: of 53 bits, or of 54 and then one more step is due.
    let mut exponent = (bits(&p) - bits(q) - 53).max(-1074);
    loop {
        let (dividend, divisor) = if exponent >= 0 {
            (p.clone(), q << exponent)
        } else {
            (&p << -exponent, q.clone())
        };
        let (quotient, remainder) = dividend.div_rem(&divisor);
        match quotient.to_u64() {
            Some(mantissa) if mantissa < LARGEST_EXACT_INTEGER => {
                return Truncated {
                    mantissa,
                    exponent,
                    remainder,
                    divisor,
                };
            }
            _ => exponent += 1,
        }
    }
}

impl Truncated {
    /// `mantissa 2^exponent`, exactly; +∞ on overflow. `mantissa <= 2^53`.
    ///
    /// With 52 stored bits and bias 1023 the word of a number of 53 bits m is
    /// `(e + 1075) 2^52 + (m - 2^52) = (e + 1074) 2^52 + m`; the last form also serves subnormals
    /// (e = -1074) and, by the carry, m = 2^53.
    fn scaled(&self, mantissa: u64) -> f64 {
        if mantissa == 0 {
            return 0.0;
        }
        match u64::try_from(self.exponent + 1074) {
            Ok(field) if field < 2046 => f64::from_bits((field << 52) + mantissa),
            _ => f64::INFINITY,
        }
    }
}

impl Ring for f64 {
    /// Rounds to nearest: exact up to 2^53.
    #[inline(always)]
    fn from_integer(k: i64) -> Self {
        k as f64
    }
}

impl Field for f64 {
    /// Rounds once.
    #[inline(always)]
    fn ratio(p: i64, q: i64) -> Self {
        if p.unsigned_abs() <= LARGEST_EXACT_INTEGER && q.unsigned_abs() <= LARGEST_EXACT_INTEGER {
            p as f64 / q as f64
        } else {
            round_to_nearest(&<Rational as Field>::ratio(p, q))
        }
    }

    /// The nearest `f64` to the midpoint of an enclosure of width 2^-126: in error by at most half
    /// a unit in the last place plus 2^-126, hence by less than one unit.
    fn two_cos(j: u32, n: u32) -> Option<Self> {
        Some(cosine::rounded_two_cos(j, n)?.nearest)
    }
}

/// `2^bits` as an integer.
pub(super) fn power_of_two(bits: u32) -> BigInt {
    BigInt::one() << bits
}
