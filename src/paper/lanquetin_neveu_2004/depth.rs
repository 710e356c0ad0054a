//! Subdivision depths by Corollaries 1 to 5, exactly as printed, decided without logarithms.
//!
//! For 0 < r < 1 and x > 0, `i >= log_(1/r) x` says `x r^i <= 1`, and `k > log_(1/r) x` says
//! `x r^k < 1`. A number of steps is not negative: each function returns the least i >= 0 that
//! satisfies the printed inequality, strict where the print is strict.
//!
//! | function | printed | safe? |
//! |---|---|---|
//! | [`corollary_1`] | `i >= log_4(M_0 / 6ε)` | yes, and no smaller depth serves all curves |
//! | [`corollary_2`] | `i >= log_4(M_0 / 3ε)` | on regular patches only, where it is best possible |
//! | [`corollary_3`] | `k > ln(M_0/ε) / ln(1 / (5/8 - nβ))` | **no**: `lanquetin-neveu-torus.obj` |
//! | [`regular_loop`] | `k > log_4(M_0/ε)`, all valences 6 | **no**: `lanquetin-neveu-torus.obj` |
//! | [`corollary_4`] | `i >= log_4(M_0 / 8ε)` | yes, and no smaller depth serves all curves |
//! | [`corollary_5`] | `i >= log_4(M_0 / 4ε)` | if every face has four sides; best possible there |
//!
//! All of them depend on M_0/ε only. Lengths are often known by their squares: with M_0, ε and the
//! rate all squared, [`least`] and [`corollary_3`] give the same depth.

use num_traits::{One, Zero};

use crate::paper::Enclosure;
use crate::scalar::{Field, Rational, Ring};

/// The largest depth that is looked for.
const DEEPEST: u32 = 10_000;

/// The least i >= 0 with `x rate^i <= bound`, or `<` if strict.
///
/// `None` if the enclosures don't tell.
///
/// # Panics
/// Unless x and bound are positive, and 0 < rate < 1, certainly.
///
/// ```
/// use subcert::paper::Enclosure;
/// use subcert::paper::lanquetin_neveu_2004::depth::least;
/// use subcert::scalar::{Field, Rational};
/// let at = |p, q| Enclosure::exactly(Rational::ratio(p, q));
/// assert_eq!(least(&at(16, 1), &at(1, 4), &at(1, 1), false), Some(2));
/// assert_eq!(least(&at(16, 1), &at(1, 4), &at(1, 1), true), Some(3));
/// ```
pub fn least(x: &Enclosure, rate: &Enclosure, bound: &Enclosure, strict: bool) -> Option<u32> {
    let zero = Enclosure::exactly(Rational::zero());
    let one = Enclosure::exactly(Rational::one());
    let below = |a: &Enclosure, b: &Enclosure| a.compare(b).is_some_and(|o| o.is_lt());
    assert!(
        below(&zero, x) && below(&zero, bound) && below(&zero, rate) && below(rate, &one),
        "positive lengths and a rate between 0 and 1"
    );
    let mut value = x.clone();
    for i in 0..DEEPEST {
        let enough = match strict {
            true => !bound.at_most(&value)?,
            false => value.at_most(bound)?,
        };
        if enough {
            return Some(i);
        }
        value = value.times(rate);
    }
    None
}

fn log_4(m_0: &Rational, epsilon: &Rational, factor: i64, strict: bool) -> u32 {
    let bound = epsilon * <Rational as Ring>::from_integer(factor);
    let quarter = Enclosure::exactly(Rational::ratio(1, 4));
    let [m_0, bound] = [m_0.clone(), bound].map(Enclosure::exactly);
    least(&m_0, &quarter, &bound, strict).expect("rationals decide; depths are logarithms")
}

/// Corollary 1, cubic curves: the least i with `i >= log_4(M_0 / 6ε)`. Safe, and best possible.
///
/// ```
/// use subcert::paper::lanquetin_neveu_2004::depth::corollary_1;
/// use subcert::scalar::{Field, Rational};
/// // 96 / 6 = 16 = 4^2: exactly two steps.
/// assert_eq!(corollary_1(&Rational::ratio(96, 1), &Rational::ratio(1, 1)), 2);
/// ```
///
/// # Panics
/// Unless M_0 and ε are positive; so for all of these.
pub fn corollary_1(m_0: &Rational, epsilon: &Rational) -> u32 {
    log_4(m_0, epsilon, 6, false)
}

/// Corollary 2, Catmull-Clark: the least i with `i >= log_4(M_0 / 3ε)`. Safe on regular patches only:
/// near an extraordinary vertex neither the 1/3 nor the 1/4 of Theorem 2 holds.
pub fn corollary_2(m_0: &Rational, epsilon: &Rational) -> u32 {
    log_4(m_0, epsilon, 3, false)
}

/// Corollary 3, Loop: the least k with `k > ln(M_0/ε) / ln(1/rate)`, rate the enclosure of
/// `5/8 - nβ` (read with the parentheses that the print leaves out), n the largest valence after all
/// steps. **Not safe**: the distance exceeds M_k, and M_k exceeds `rate^k M_0`.
///
/// `None` if the enclosures don't tell.
pub fn corollary_3(m_0: &Enclosure, epsilon: &Enclosure, rate: &Enclosure) -> Option<u32> {
    least(m_0, rate, epsilon, true)
}

/// The remark after Corollary 3, regular Loop meshes: the least k with `k > log_4(M_0/ε)`.
/// **Not safe**, for the same reasons.
pub fn regular_loop(m_0: &Rational, epsilon: &Rational) -> u32 {
    log_4(m_0, epsilon, 1, true)
}

/// Corollary 4, quadratic curves: the least i with `i >= log_4(M_0 / 8ε)`. Safe, and best possible.
pub fn corollary_4(m_0: &Rational, epsilon: &Rational) -> u32 {
    log_4(m_0, epsilon, 8, false)
}

/// Corollary 5, Doo-Sabin: the least i with `i >= log_4(M_0 / 4ε)`. Safe if every face has four sides
/// and every vertex valence 4, and best possible there; not near other faces, which stay for ever.
pub fn corollary_5(m_0: &Rational, epsilon: &Rational) -> u32 {
    log_4(m_0, epsilon, 4, false)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn r(p: i64, q: i64) -> Rational {
        Rational::ratio(p, q)
    }

    #[test]
    fn at_exact_powers_strict_and_not() {
        // M_0 = 64, ε = 1: log_4 64 = 3; / 6, 3, 8, 4: 10.7, 21.3, 8, 16.
        assert_eq!(regular_loop(&r(64, 1), &r(1, 1)), 4);
        assert_eq!(corollary_1(&r(64, 1), &r(1, 1)), 2);
        assert_eq!(corollary_2(&r(64, 1), &r(1, 1)), 3);
        assert_eq!(corollary_4(&r(64, 1), &r(1, 1)), 2);
        assert_eq!(corollary_5(&r(64, 1), &r(1, 1)), 2);
        assert_eq!(corollary_5(&r(64_001, 1000), &r(1, 1)), 3);
        assert_eq!(corollary_4(&r(1, 1), &r(1, 1)), 0);
    }

    #[test]
    fn squares_give_the_same_depth() {
        let at = |p, q| Enclosure::exactly(r(p, q));
        // n = 4: rate 9/64. 7 (9/64)^2 = 0.138.. < 1/5 < 7 (9/64) = 0.98.
        assert_eq!(corollary_3(&at(7, 1), &at(1, 5), &at(9, 64)), Some(2));
        assert_eq!(corollary_3(&at(49, 1), &at(1, 25), &at(81, 4096)), Some(2));
        let wide = Enclosure::new(r(9, 64) - r(1, 1000), r(9, 64));
        assert_eq!(corollary_3(&at(64, 9), &at(1, 1), &wide), None);
    }
}
