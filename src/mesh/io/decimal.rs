//! Decimal numbers, read exactly: as rationals, or as the nearest `f64`.
//!
//! The grammar is `[+-] digits [. digits] [(e|E) [+-] digits]`, with digits on at least one side of
//! the point. Words (`inf`, `nan`) and hexadecimal are no numbers.

use num_bigint::BigInt;
use num_traits::Zero;

use super::digits::digits;
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
pub(super) trait Coordinate: Clone + Send {
    /// The number that the token stands for.
    fn parse(token: &[u8]) -> Result<Self, DecimalError>;
    /// The number of the word at the start of `bytes`, and the word's length. There may be none for any reason:
    /// then [`Coordinate::parse`] decides.
    fn leading(bytes: &[u8]) -> Option<(Self, usize)>;
    /// A number stored in binary.
    fn from_stored(stored: f64) -> Result<Self, DecimalError>;
}

impl Coordinate for f64 {
    #[inline]
    fn parse(token: &[u8]) -> Result<Self, DecimalError> {
        let mut padded = [0; LONGEST + 8];
        if let Some(room) = padded[..LONGEST].get_mut(..token.len()) {
            room.copy_from_slice(token);
            if let Some((x, length)) = short(&padded)
                && length == token.len()
            {
                return Ok(x);
            }
        }
        nearest(token)
    }

    #[inline(always)]
    fn leading(bytes: &[u8]) -> Option<(Self, usize)> {
        let ends = |&c: &u8| matches!(c, b' ' | b'\r' | b'\n');
        if let Some((x, length)) = short(bytes)
            && bytes.get(length).is_some_and(ends)
        {
            return Some((x, length));
        }
        let length = bytes.iter().position(ends)?;
        Some((nearest(&bytes[..length]).ok()?, length))
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

/// The nearest number, by the standard library.
fn nearest(token: &[u8]) -> Result<f64, DecimalError> {
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

/// No short decimal is longer: a sign, 19 digits, a point and an exponent of two digits, with its sign.
const LONGEST: usize = 25;

/// Powers of ten that are `f64`: 5^22 < 2^53.
const TENS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// As integers.
const WHOLE_TENS: [u64; 9] = [
    1,
    10,
    100,
    1000,
    10_000,
    100_000,
    1_000_000,
    10_000_000,
    100_000_000,
];

/// The decimal `m 10^p` at the start of `bytes`, and its length, if m < 2^53 and |p| <= 22: then both are `f64`, and
/// one product or quotient of them is rounded once, so it is the nearest. A sign + is not short.
///
/// Whether a number ends there must be seen by the next byte: it is no digit, point or exponent.
#[inline(always)]
fn short(bytes: &[u8]) -> Option<(f64, usize)> {
    let negative = bytes.first() == Some(&b'-');
    let mut at = usize::from(negative);
    let (mut count, mut mantissa) = digits(&bytes[at..])?;
    at += count;
    let mut power = 0;
    if bytes.get(at) == Some(&b'.') {
        let start = at + 1;
        at = start;
        for _ in 0..2 {
            let (more, value) = digits(&bytes[at..])?;
            // Wraps only if there are more digits than are allowed below.
            mantissa = mantissa.wrapping_mul(WHOLE_TENS[more]).wrapping_add(value);
            at += more;
            if more < 8 {
                break;
            }
        }
        count += at - start;
        power = -((at - start) as i32);
    }
    // 10^19 < 2^64.
    if count == 0 || count > 19 || mantissa > 1 << 53 {
        return None;
    }
    if let Some(b'e' | b'E') = bytes.get(at) {
        let sign = bytes.get(at + 1);
        at += 1 + usize::from(matches!(sign, Some(b'-' | b'+')));
        let (more, value) = digits(&bytes[at..])?;
        if more == 0 || more > 2 {
            return None;
        }
        at += more;
        let value = value as i32;
        power += if sign == Some(&b'-') { -value } else { value };
    }
    let ten = *TENS.get(power.unsigned_abs() as usize)?;
    let mantissa = mantissa as f64;
    let x = if power < 0 {
        mantissa / ten
    } else {
        mantissa * ten
    };
    Some((if negative { -x } else { x }, at))
}

impl Coordinate for Rational {
    fn leading(_: &[u8]) -> Option<(Self, usize)> {
        None
    }

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
        Ok(e) if (-MAX_EXACT_EXPONENT..=MAX_EXACT_EXPONENT).contains(&e) => Ok(e),
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

        /// Bit for bit, -0 included: of few digits and of many, with any exponent.
        #[test]
        fn short_cuts_change_no_bit(
            token in "-?(0{0,3}[0-9]{0,10}\\.?0{0,3}[0-9]{0,20}|[0-9]{1,9}\\.[0-9]{1,9}|0|0\\.0|[0-9]{15,17})([eE][+-]?[0-9]{1,3})?",
            rest in "[ \\r\\n][0-9 ]{0,12}",
        ) {
            let expected = nearest(token.as_bytes()).map(f64::to_bits);
            prop_assert_eq!(f64::parse(token.as_bytes()).map(f64::to_bits), expected);
            let line = token.clone() + &rest;
            let found = f64::leading(line.as_bytes()).map(|(x, length)| (x.to_bits(), length));
            prop_assert_eq!(found, expected.ok().map(|x| (x, token.len())));
        }

        #[test]
        fn any_bytes_are_handled(token in prop::collection::vec(any::<u8>(), 0..12)) {
            let _ = (Rational::parse(&token), f64::parse(&token));
        }
    }
}
