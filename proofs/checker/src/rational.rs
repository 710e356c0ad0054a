//! Rationals: their one written form, and decimals for the reader's eye.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

/// The most digits that a numerator or a denominator may have.
pub const DIGITS: usize = 400;

/// The rational `p / q` of two small integers, `q > 0`.
pub fn ratio(p: i64, q: i64) -> BigRational {
    BigRational::new(p.into(), q.into())
}

/// Reads "p/q" in lowest terms with q > 1, or "p".
///
/// # Errors
///
/// If and only if the text is anything else, or has more than [`DIGITS`] digits in a row.
pub fn parse(text: &str) -> Result<BigRational, String> {
    let wrong = |why: &str| {
        format!("{:?} is no rational: {why}", text.chars().take(40).collect::<String>())
    };
    let (top, bottom) = text.split_once('/').unwrap_or((text, "1"));
    let (sign, digits) = top.strip_prefix('-').map_or((1, top), |rest| (-1, rest));
    let p: BigInt = natural(digits).ok_or_else(|| wrong("its numerator"))? * sign;
    let q = natural(bottom).ok_or_else(|| wrong("its denominator"))?;
    if sign < 0 && p.is_zero() {
        return Err(wrong("a negative zero"));
    }
    if q.is_zero() || (text.contains('/') && q == BigInt::from(1)) {
        return Err(wrong("a denominator is at least 2"));
    }
    if p.gcd(&q) != BigInt::from(1) {
        return Err(wrong("not in lowest terms"));
    }
    Ok(BigRational::new_raw(p, q))
}

fn natural(digits: &str) -> Option<BigInt> {
    let canonical = digits == "0" || !digits.starts_with('0');
    let plain = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    (canonical && plain && digits.len() <= DIGITS).then(|| digits.parse().ok())?
}

/// The decimals of `x`, cut off (not rounded) after `places`; ".." says that there are more.
pub fn decimal(x: &BigRational, places: u32) -> String {
    let scale = BigInt::from(10).pow(places);
    let (scaled, rest) = (x.numer().abs() * &scale).div_rem(x.denom());
    let (whole, part) = scaled.div_rem(&scale);
    let digits = format!("{part:0>width$}", width = places as usize);
    let sign = if x.is_negative() { "-" } else { "" };
    if rest.is_zero() {
        let digits = digits.trim_end_matches('0');
        let point = if digits.is_empty() { "" } else { "." };
        format!("{sign}{whole}{point}{digits}")
    } else {
        format!("{sign}{whole}.{digits}..")
    }
}

/// Decimals of two numbers, with as many places as it takes to tell them apart (at most 60).
pub fn contrast(x: &BigRational, y: &BigRational) -> (String, String) {
    let written = |places| (decimal(x, places), decimal(y, places));
    (10..60).map(written).find(|(a, b)| a != b).unwrap_or_else(|| written(60))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_written_form() {
        assert_eq!(parse("-3/4"), Ok(ratio(-3, 4)));
        assert_eq!(parse("0"), Ok(ratio(0, 1)));
        for text in [
            "", "-", "-0", "+1", "01", "1/", "/2", "2/4", "3/1", "1/0", "1/-2", "0/2", "1.5", " 1",
            "1e3", "1/2/3",
        ] {
            assert!(parse(text).is_err(), "{text:?}");
        }
        assert!(parse(&"9".repeat(DIGITS)).is_ok());
        assert!(parse(&"9".repeat(DIGITS + 1)).is_err());
    }

    #[test]
    fn decimals_are_cut_off() {
        assert_eq!(decimal(&ratio(-2, 3), 4), "-0.6666..");
        assert_eq!(decimal(&ratio(5, 4), 4), "1.25");
        assert_eq!(decimal(&ratio(-7, 1), 4), "-7");
        let near = ratio(1, 3) + parse(&format!("1/1{}", "0".repeat(20))).unwrap();
        let (a, b) = contrast(&ratio(1, 3), &near);
        assert!(a != b && a.len() < 26);
    }
}
