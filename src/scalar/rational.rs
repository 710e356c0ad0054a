//! Exact rationals: [`num_rational::BigRational`] as a [`Field`] that decides.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Zero;

use super::{Decide, Field, Ring};

/// A rational number in lowest terms.
///
/// Its `Ord` compares by continued fractions, one level of recursion per partial quotient: it is
/// slow, and overflows the stack on nearly equal numbers of some ten thousand bits. [`Decide`]
/// multiplies crosswise instead.
pub type Rational = num_rational::BigRational;

impl Ring for Rational {
    fn from_integer(k: i64) -> Self {
        Rational::from_integer(BigInt::from(k))
    }
}

impl Field for Rational {
    fn ratio(p: i64, q: i64) -> Self {
        Rational::new(BigInt::from(p), BigInt::from(q))
    }

    /// Niven's theorem: `2 cos(2 π j / n)` is rational only for denominators 1, 2, 3, 4 and 6.
    fn two_cos(j: u32, n: u32) -> Option<Self> {
        let divisor = j.gcd(&n).max(1);
        let value = match (n / divisor, j.is_zero()) {
            (_, true) | (1, _) => 2,
            (2, _) => -2,
            (3, _) => -1,
            (4, _) => 0,
            (6, _) => 1,
            _ => return None,
        };
        Some(<Self as Ring>::from_integer(value))
    }
}

impl Decide for Rational {
    fn decide(&self, other: &Self) -> Option<Ordering> {
        // Denominators are positive: p/q < r/s if and only if p s < r q.
        let left = self.numer() * other.denom();
        Some(left.cmp(&(other.numer() * self.denom())))
    }
}

/// A rational in machine integers, for the weights of masks; its operators panic on overflow in
/// tests, so it is kept to numbers of a few digits.
pub type ShortRational = num_rational::Rational64;

impl Ring for ShortRational {
    fn from_integer(k: i64) -> Self {
        ShortRational::from_integer(k)
    }
}

impl Field for ShortRational {
    fn ratio(p: i64, q: i64) -> Self {
        ShortRational::new(p, q)
    }

    fn two_cos(j: u32, n: u32) -> Option<Self> {
        let value = <Rational as Field>::two_cos(j, n)?;
        Some(ShortRational::from_integer(
            num_traits::ToPrimitive::to_i64(value.numer())?,
        ))
    }
}
