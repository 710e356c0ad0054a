//! Subdivision depths by (14) and (16), as printed, decided exactly.
//!
//! ```text
//! k = min_(0 <= j < λ) λ l_j + j,    l_j = ⌈ log_(1/r_λ) (r_j C M / ε) ⌉.
//! ```
//!
//! For 0 < r < 1 and x > 0, `⌈log_(1/r) x⌉` is the least integer l with `x r^l <= 1`: products of
//! rationals, no logarithm.

use num_traits::One;

use crate::paper::Enclosure;
use crate::scalar::Rational;

/// `⌈log_(1/r) x⌉` for 0 < r < 1, x > 0; `None` if the enclosures don't tell.
///
/// # Panics
/// Unless 0 < r < 1 and x > 0, certainly.
///
/// ```
/// use subcert::paper::Enclosure;
/// use subcert::paper::huang_wang_2008::depth::ceil_log;
/// use subcert::scalar::{Field, Rational};
/// let at = |p, q| Enclosure::exactly(Rational::ratio(p, q));
/// // log_4 16 = 2 exactly, and a little more needs 3.
/// assert_eq!(ceil_log(&at(16, 1), &at(1, 4)), Some(2));
/// assert_eq!(ceil_log(&at(1_600_001, 100_000), &at(1, 4)), Some(3));
/// assert_eq!(ceil_log(&at(1, 16), &at(1, 4)), Some(-2));
/// ```
pub fn ceil_log(x: &Enclosure, r: &Enclosure) -> Option<i64> {
    let one = Enclosure::exactly(Rational::one());
    let zero = Enclosure::exactly(Rational::from_integer(0.into()));
    let inside = zero.compare(r).is_some_and(|o| o.is_lt())
        && r.compare(&one).is_some_and(|o| o.is_lt())
        && zero.compare(x).is_some_and(|o| o.is_lt());
    assert!(inside, "a logarithm to a base 1/r > 1 of a positive number");
    let mut l = 0;
    if x.at_most(&one)? {
        // l <= 0: the least with x <= r^-l.
        let mut power = r.clone();
        while x.at_most(&power)? {
            power = power.times(r);
            l -= 1;
        }
    } else {
        let mut product = x.clone();
        while !product.at_most(&one)? {
            product = product.times(r);
            l += 1;
        }
    }
    Some(l)
}

/// (14) with C = max(β(n), 1/3), (16) with C = C_λ(n): the depth k for `rates` = r_0 .. r_λ and
/// `ratio` = M / ε; `None` if the enclosures don't tell.
///
/// As printed: nothing keeps l_j from being negative when ε is large.
///
/// ```
/// use subcert::paper::Enclosure;
/// use subcert::paper::huang_wang_2008::depth::steps;
/// use subcert::scalar::{Field, Rational};
/// let at = |p, q| Enclosure::exactly(Rational::ratio(p, q));
/// // Regular patches: r_1 = 1/4, C = 1/3, M / ε = 10000: ⌈log_4 (10000 / 3)⌉ = 6.
/// assert_eq!(steps(&[at(1, 1), at(1, 4)], &at(1, 3), &at(10_000, 1)), Some(6));
/// ```
pub fn steps(rates: &[Enclosure], c: &Enclosure, ratio: &Enclosure) -> Option<i64> {
    let (last, first) = rates.split_last()?;
    let lambda = first.len() as i64;
    let scaled = c.times(ratio);
    let mut least: Option<i64> = None;
    for (j, rate) in (0..).zip(first) {
        let k = lambda * ceil_log(&rate.times(&scaled), last)? + j;
        least = Some(least.map_or(k, |known| known.min(k)));
    }
    least
}
