//! Is the floating-point unit the one that the proofs assume?

use std::hint::black_box;

use super::{Field, Interval};

/// What the floating-point unit got wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("floating-point arithmetic is not IEEE 754 as the proofs assume: {0}")]
pub struct FloatingPointFault(
    /// The test that failed.
    pub &'static str,
);

/// Tests that this thread's arithmetic keeps subnormals and rounds to nearest, ties to even, and
/// that intervals round outward. Call it once when the program starts.
///
/// A library loaded into the process (one built with `-ffast-math`, say) may have switched the unit
/// to flush subnormals or to round otherwise; then neither a-priori bounds of `f64` code nor
/// interval endpoints mean anything.
///
/// # Errors
/// If and only if one of the tests fails: its name.
///
/// ```
/// assert_eq!(subcert::scalar::environment::verify_floating_point(), Ok(()));
/// ```
pub fn verify_floating_point() -> Result<(), FloatingPointFault> {
    let one = black_box(1.0_f64);
    let u = black_box(f64::EPSILON / 2.0);
    let eps = black_box(f64::EPSILON);
    let least = black_box(f64::from_bits(1));
    let third = black_box(Interval::point(1.0)) / Interval::point(3.0);
    let tests = [
        (
            "subnormal results are flushed to zero",
            black_box(black_box(f64::MIN_POSITIVE) * 0.5).to_bits() == 1 << 51,
        ),
        (
            "subnormal operands are read as zero",
            black_box(least * black_box(2f64.powi(1023))) == black_box(2f64.powi(-51)),
        ),
        (
            "a tie is not rounded to even (down)",
            black_box(one + u) == one,
        ),
        (
            "a tie is not rounded to even (up)",
            black_box((one + eps) + u) == 1.0 + 2.0 * f64::EPSILON,
        ),
        (
            "a tie is not rounded to even (negative)",
            black_box(-one - u) == -1.0,
        ),
        (
            "rounding is not to nearest",
            black_box(one + u * (1.0 + eps)) == 1.0 + f64::EPSILON
                && black_box(-one - u * (1.0 + eps)) == -1.0 - f64::EPSILON,
        ),
        (
            "a fused product-sum rounds twice",
            black_box((one + eps).mul_add(one - eps, -one)) == -f64::EPSILON * f64::EPSILON,
        ),
        (
            "interval division does not round outward",
            third.inf() < third.sup() && third.inf().next_up() == third.sup(),
        ),
        (
            "interval products lose subnormals",
            Interval::point(least) * Interval::ratio(1, 2) == Interval::new(0.0, least),
        ),
    ];
    match tests.iter().find(|(_, passed)| !passed) {
        Some((fault, _)) => Err(FloatingPointFault(fault)),
        None => Ok(()),
    }
}
