//! Decimal digits, eight bytes at a time.
//!
//! With the first byte lowest, eight digits are added up in pairs, the pairs in pairs, and those:
//!
//! ```text
//! (10 d_0 + d_1), ..    100 (..) + (..), ..    10^4 (..) + (..)
//! ```
//!
//! each by one product, whose upper part holds the sums.

/// The same byte eight times.
const fn eight(byte: u8) -> u64 {
    u64::from_le_bytes([byte; 8])
}

/// The number of digits at the start of `bytes`, and what they stand for. Only the first eight bytes are looked at,
/// and there must be as many.
#[inline(always)]
pub(super) fn digits(bytes: &[u8]) -> Option<(usize, u64)> {
    let word = u64::from_le_bytes(*bytes.first_chunk()?) ^ eight(b'0');
    // Now digits are at most 9: any other byte has its highest bit set, or reaches it with 0x76 more.
    let others = (((word & eight(0x7f)) + eight(0x76)) | word) & eight(0x80);
    let count = others.trailing_zeros() / 8;
    // The others go, and zeros come in front.
    let digits = word.unbounded_shl(64 - 8 * count);
    let pairs = (digits.wrapping_mul(10 << 8 | 1) >> 8) & 0x00ff_00ff_00ff_00ff;
    let fours = (pairs.wrapping_mul(100 << 16 | 1) >> 16) & 0x0000_ffff_0000_ffff;
    let value = fours.wrapping_mul(10_000 << 32 | 1) >> 32;
    Some((count as usize, value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn digits_end_at_any_other_byte() {
        for length in 0..=8 {
            for byte in (0..=255_u8).filter(|c| !c.is_ascii_digit()) {
                let mut bytes = *b"98765432";
                bytes[length..].fill(byte);
                let value = (0..length as u64).fold(0, |x, i| 10 * x + 9 - i);
                assert_eq!(digits(&bytes), Some((length, value)), "{bytes:?}");
            }
        }
        assert_eq!(digits(b"1234567"), None);
    }

    proptest! {
        #[test]
        fn values_are_those_of_the_text(text in "[0-9]{0,12}[^0-9].{8}") {
            let (length, value) = digits(text.as_bytes()).unwrap();
            let expected = text.bytes().take(8).take_while(u8::is_ascii_digit).count();
            prop_assert_eq!(length, expected);
            prop_assert_eq!(value, text[..length].parse().unwrap_or(0));
        }
    }
}
