//! Decimal numbers, read exactly: as rationals, or as the nearest `f64`.
//!
//! The grammar is `[+-] digits [. digits] [(e|E) [+-] digits]`, with digits on at least one side of
//! the point. Words (`inf`, `nan`) and hexadecimal are no numbers.

use num_bigint::BigInt;
use num_traits::Zero;

use crate::scalar::Rational;

/// Coordinates beyond this are refused, so that sums and products of a few can't overflow.
const LIMIT_EXPONENT: u32 = 1000;

/// 2^1000.
const LIMIT: f64 = f64::from_bits((1023 + LIMIT_EXPONENT as u64) << 52);

/// Exact reading refuses exponents beyond this, and as many digits: short input, huge numbers.
const MAX_EXACT_EXPONENT: i64 = 4000;

/// Why a token is no coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DecimalError {
    /// It isn't a decimal number.
    Syntax,
    /// Its magnitude is above 2^1000.
    TooLarge,
    /// It needs more digits than exact reading allows.
    TooLong,
}

/// A type of coordinates that files can be read into.
pub(super) trait Coordinate: Clone {
    /// The number that the token stands for.
    fn parse(token: &[u8]) -> Result<Self, DecimalError>;
    /// A number stored in binary.
    fn from_stored(stored: f64) -> Result<Self, DecimalError>;
}

impl Coordinate for f64 {
    #[inline]
    fn parse(token: &[u8]) -> Result<Self, DecimalError> {
        let text = std::str::from_utf8(token).map_err(|_| DecimalError::Syntax)?;
        let x: f64 = text.parse().map_err(|_| DecimalError::Syntax)?;
        if x.abs() <= LIMIT {
            return Ok(x);
        }
        // Words are the only tokens without a digit that `parse` takes.
        let word = !token.iter().any(u8::is_ascii_digit);
        Err(if word {
            DecimalError::Syntax
        } else {
            DecimalError::TooLarge
        })
    }

    fn from_stored(stored: f64) -> Result<Self, DecimalError> {
        if stored.abs() <= LIMIT {
            return Ok(stored);
        }
        Err(if stored.is_nan() {
            DecimalError::Syntax
        } else {
            DecimalError::TooLarge
        })
    }
}

impl Coordinate for Rational {
    fn parse(token: &[u8]) -> Result<Self, DecimalError> {
        let x = rational(token)?;
        let limit = BigInt::from(1) << LIMIT_EXPONENT;
        // |p / q| <= limit without division.
        if x.numer().magnitude() <= (limit * x.denom()).magnitude() {
            Ok(x)
        } else {
            Err(DecimalError::TooLarge)
        }
    }

    fn from_stored(stored: f64) -> Result<Self, DecimalError> {
        f64::from_stored(stored)?;
        Rational::from_float(stored).ok_or(DecimalError::Syntax)
    }
}

/// The rational number that a decimal stands for.
fn rational(token: &[u8]) -> Result<Rational, DecimalError> {
    if token.len() as i64 > MAX_EXACT_EXPONENT {
        return Err(DecimalError::TooLong);
    }
    let (negative, unsigned) = match token {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    };
    let mark = unsigned.iter().position(|c| matches!(c, b'e' | b'E'));
    let (mantissa, exponent) = match mark {
        Some(i) => (&unsigned[..i], exponent(&unsigned[i + 1..])?),
        None => (unsigned, 0),
    };
    let point = mantissa
        .iter()
        .position(|&c| c == b'.')
        .unwrap_or(mantissa.len());
    let whole = &mantissa[..point];
    let fraction = mantissa.get(point + 1..).unwrap_or_default();
    let digits = [whole, fraction].concat();
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Err(DecimalError::Syntax);
    }
    let magnitude = BigInt::parse_bytes(&digits, 10).ok_or(DecimalError::Syntax)?;
    if magnitude.is_zero() {
        return Ok(Rational::zero());
    }
    let numerator = if negative { -magnitude } else { magnitude };
    let power = exponent - fraction.len() as i64;
    if power.abs() > 2 * MAX_EXACT_EXPONENT {
        return Err(DecimalError::TooLong);
    }
    let scale = BigInt::from(10).pow(power.unsigned_abs() as u32);
    Ok(if power >= 0 {
        Rational::from_integer(numerator * scale)
    } else {
        Rational::new(numerator, scale)
    })
}

fn exponent(token: &[u8]) -> Result<i64, DecimalError> {
    let digits = token
        .strip_prefix(b"-")
        .or(token.strip_prefix(b"+"))
        .unwrap_or(token);
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Err(DecimalError::Syntax);
    }
    let text = std::str::from_utf8(token).map_err(|_| DecimalError::Syntax)?;
    match text.parse() {
        Ok(e) if -MAX_EXACT_EXPONENT <= e && e <= MAX_EXACT_EXPONENT => Ok(e),
        _ => Err(DecimalError::TooLong),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Field;
    use num_traits::ToPrimitive;
    use proptest::prelude::*;

    #[test]
    fn decimals_are_read_exactly() {
        let read = |token: &str| Rational::parse(token.as_bytes());
        assert_eq!(read("0.1"), Ok(Rational::ratio(1, 10)));
        assert_eq!(read("-12.50e-1"), Ok(Rational::ratio(-5, 4)));
        assert_eq!(read("+.5E+1"), Ok(Rational::ratio(5, 1)));
        assert_eq!(read("3."), Ok(Rational::ratio(3, 1)));
        assert_eq!(read("-0e4000"), Ok(Rational::ratio(0, 1)));
    }

    #[test]
    fn what_is_no_number_is_refused_by_both() {
        for token in [
            "", "+", ".", "e5", "1e", "1e+", "1_0", "0x10", "--1", "1.2.3", "1,5", "½",
        ] {
            assert_eq!(
                Rational::parse(token.as_bytes()),
                Err(DecimalError::Syntax),
                "{token}"
            );
            assert_eq!(
                f64::parse(token.as_bytes()),
                Err(DecimalError::Syntax),
                "{token}"
            );
        }
        for token in ["nan", "NaN", "inf", "-Infinity"] {
            assert_eq!(
                f64::parse(token.as_bytes()),
                Err(DecimalError::Syntax),
                "{token}"
            );
            assert_eq!(
                Rational::parse(token.as_bytes()),
                Err(DecimalError::Syntax),
                "{token}"
            );
        }
        for token in ["1e400", "-1e308", "2e301"] {
            assert_eq!(
                f64::parse(token.as_bytes()),
                Err(DecimalError::TooLarge),
                "{token}"
            );
            assert_eq!(
                Rational::parse(token.as_bytes()),
                Err(DecimalError::TooLarge),
                "{token}"
            );
        }
        assert_eq!(Rational::parse(b"1e-4001"), Err(DecimalError::TooLong));
        assert_eq!(
            Rational::parse(b"1e99999999999999999999"),
            Err(DecimalError::TooLong)
        );
        assert!(f64::parse(b"1e301").is_ok() && Rational::parse(b"1e301").is_ok());
    }

    proptest! {
        #[test]
        fn both_readings_agree(token in "[+-]?[0-9]{0,20}\\.?[0-9]{0,20}(e[+-]?[0-9]{1,2})?") {
            let exact = Rational::parse(token.as_bytes());
            let nearest = f64::parse(token.as_bytes());
            prop_assert_eq!(exact.as_ref().err(), nearest.as_ref().err());
            if let (Ok(exact), Ok(nearest)) = (exact, nearest) {
                // Within half a unit in the last place of either neighbour.
                let error = &exact - Rational::from_float(nearest).unwrap();
                for neighbour in [nearest.next_down(), nearest.next_up()] {
                    let other = &exact - Rational::from_float(neighbour).unwrap();
                    prop_assert!(error.numer().magnitude() * other.denom().magnitude()
                        <= other.numer().magnitude() * error.denom().magnitude());
                }
                prop_assert!(error.to_f64().is_some());
            }
        }

        #[test]
        fn any_bytes_are_handled(token in prop::collection::vec(any::<u8>(), 0..12)) {
            let _ = (Rational::parse(&token), f64::parse(&token));
        }
    }
}
