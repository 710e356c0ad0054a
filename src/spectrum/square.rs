//! Proof that an element of Q(2 cos 2π/n) has no square root there.
//!
//! Let p be a prime with p = 1 mod n. The n-th roots of unity exist in F_p, so sending e^(2πi/n) to one
//! of order n maps the algebraic integers of Q(e^(2πi/n)) to F_p, and with them every D whose
//! denominator p doesn't divide. A square D would go to a square. By Euler's criterion, D is no square
//! if its image d has `d^((p-1)/2) = -1`. For an element that is none, half of the primes show it.
//!
//! D is written with roots of unity of an order that divides n (or 2n); any root of that order will
//! do, for it is a power of some root of order n.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use crate::scalar::{Cyclotomic, Rational};

/// How many primes are tried.
const PRIMES: usize = 64;

/// A prime that proves `x` not to be a square in Q(2 cos 2π/n), an x of that field.
///
/// `None` if none of the first 64 fitting primes does: then x may be a square.
pub fn prime_against_square(x: &Cyclotomic, n: u32) -> Option<u64> {
    let order = u64::from(n).lcm(&u64::from(x.conductor()));
    let primes = (1..)
        .map(|m| m * order + 1)
        .filter(|&p| p > 2 && is_prime(p));
    primes.take(PRIMES).find(|&p| {
        let Some(image) = image(x, p) else {
            return false;
        };
        power(image, (p - 1) / 2, p) == p - 1
    })
}

/// The image in F_p; `None` if p divides a denominator.
fn image(x: &Cyclotomic, p: u64) -> Option<u64> {
    let root = root_of_unity(u64::from(x.conductor()), p);
    let two_cos = (root + power(root, p - 2, p)) % p;
    let terms = x.power_coefficients().into_iter().rev();
    terms.into_iter().try_fold(0, |sum, a| {
        let a = residue(&a, p)?;
        Some((product(sum, two_cos, p) + a) % p)
    })
}

fn residue(x: &Rational, p: u64) -> Option<u64> {
    let modulo = |a: &BigInt| a.mod_floor(&BigInt::from(p)).to_u64();
    let denominator = modulo(x.denom()).filter(|&d| d != 0)?;
    Some(product(modulo(x.numer())?, power(denominator, p - 2, p), p))
}

/// An element of exactly this order; `order` divides p - 1.
fn root_of_unity(order: u64, p: u64) -> u64 {
    let primitive = |&a: &u64| {
        let smaller = (1..order).filter(|d| order.is_multiple_of(*d));
        smaller.into_iter().all(|d| power(a, d, p) != 1)
    };
    let candidates = (1..p).map(|a| power(a, (p - 1) / order, p));
    candidates
        .into_iter()
        .find(primitive)
        .expect("F_p has a cyclic group of units")
}

fn product(a: u64, b: u64, p: u64) -> u64 {
    ((u128::from(a) * u128::from(b)) % u128::from(p)) as u64
}

fn power(mut base: u64, mut exponent: u64, p: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = product(result, base, p);
        }
        base = product(base, base, p);
        exponent >>= 1;
    }
    result
}

fn is_prime(p: u64) -> bool {
    (2..)
        .take_while(|d| d * d <= p)
        .all(|d| !p.is_multiple_of(d))
}

#[cfg(test)]
mod tests {
    use num_traits::One;

    use super::*;
    use crate::scalar::Field;

    /// Squares are never refuted; √5 lies in Q(2 cos 2π/5), √2 and √3 don't, but in those of 8 and 12.
    #[test]
    fn squares_are_told_from_others() {
        for n in [5, 7, 12, 15, 16] {
            let c = Cyclotomic::two_cos(1, n).unwrap();
            let a = c.clone() * &c - &(c * &Cyclotomic::ratio(2, 3)) + &Cyclotomic::one();
            assert_eq!(prime_against_square(&(a.clone() * &a), n), None);
            // A square times 3 is one if and only if 3 is.
            let three = a.clone() * &a * &Cyclotomic::ratio(3, 1);
            assert_eq!(prime_against_square(&three, n).is_none(), n == 12);
        }
        let is_square = |x: i64, n| prime_against_square(&Cyclotomic::ratio(x, 1), n).is_none();
        assert!(is_square(5, 5) && is_square(2, 8) && is_square(4, 3) && is_square(2, 16));
        assert!(!is_square(2, 5) && !is_square(5, 8) && !is_square(-1, 7) && !is_square(3, 3));
    }
}
