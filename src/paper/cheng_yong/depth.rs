//! The paper's subdivision depths, exactly as printed, decided by products of rationals.
//!
//! | formula | function | verdict of this program |
//! |---|---|---|
//! | (7), Theorem 4 | [`theorem_4`] | the distance is at most ε; "smaller" is false where the logarithm is an integer: [`theorem_4_strict`] |
//! | (23), Theorem 6 | [`n_epsilon`] | true, and larger than needed |
//! | (31), Lemma 8 | [`l_k`] | true, and larger than needed |
//! | (32) | [`d_k`] | true |
//! | (33), Theorem 9 | [`theorem_9`] | true, smaller than ε even where the logarithms are integers |
//!
//! `None` means that nothing is printed: at N = 4 ((23) and (27) leave out the regular valence, for which
//! there is Theorem 4), or for the logarithm of 0 (where 0 steps do). Printed depths may be negative, for
//! large ε: then 0 steps do, `depth.max(0)`. All functions panic unless ε > 0 and the norms are at least 0.
//! A float x is the rational `Rational::from_float(x)`, exactly.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::printed;
use crate::paper::Enclosure;
use crate::paper::huang_wang_2008::depth::ceil_log;
use crate::scalar::{Field, Rational, Ring};

fn ratio((p, q): (i64, i64)) -> Rational {
    Rational::ratio(p, q)
}

/// `⌈log_base x⌉` for base > 1: the least integer l with `x <= base^l`; `None` if and only if x = 0.
fn ceiling(x: &Rational, base: &Rational) -> Option<i64> {
    let exactly = |x: &Rational| Enclosure::exactly(x.clone());
    (!x.is_zero())
        .then(|| ceil_log(&exactly(x), &exactly(&base.recip())).expect("exact numbers are ordered"))
}

fn check(norm: &Rational, epsilon: &Rational) {
    assert!(
        epsilon.is_positive() && !norm.is_negative(),
        "a tolerance above 0 and a norm of at least 0"
    );
}

/// (7): `⌈log_4 (M^0 / (3 ε))⌉`; `None` if and only if M^0 = 0.
///
/// True as "at most ε"; at `M^0 = 3 ε 4^k` the distance can equal ε: see [`theorem_4_strict`].
///
/// ```
/// use subcert::paper::cheng_yong::depth::theorem_4;
/// use subcert::scalar::{Field, Rational};
/// let r = Rational::ratio;
/// // 12 / 3 = 4^1 exactly; a little more needs two steps.
/// assert_eq!(theorem_4(&r(12, 1), &r(1, 1)), Some(1));
/// assert_eq!(theorem_4(&r(1_200_001, 100_000), &r(1, 1)), Some(2));
/// ```
pub fn theorem_4(m0: &Rational, epsilon: &Rational) -> Option<i64> {
    check(m0, epsilon);
    let x = m0 * ratio(printed::THIRD) / epsilon;
    let base = ratio(printed::QUARTER).recip();
    if x.is_zero() {
        return None;
    }
    // (33) asks for many of these. The numbers' lengths tell l but for a step or two: x > 2^(bits - 1), and
    // (bits - 1) / 2 >= l here.
    let bits = |x: &BigInt| x.bits() as i32;
    let mut l = (bits(x.numer()) - bits(x.denom())).div_euclid(2) - 1;
    debug_assert!(x > base.pow(l), "a start below the logarithm to base 4");
    while x > base.pow(l) {
        l += 1;
    }
    Some(i64::from(l))
}

/// The least k >= 0 with `M^0 / (3 4^k) < ε`: the number of steps that makes Theorem 4 true as printed.
pub fn theorem_4_strict(m0: &Rational, epsilon: &Rational) -> u32 {
    check(m0, epsilon);
    let mut bound = m0 * ratio(printed::THIRD);
    let mut k = 0;
    while bound >= *epsilon {
        bound *= ratio(printed::QUARTER);
        k += 1;
    }
    k
}

/// (23): `n_ε = ⌈log_δ (7 G^0 / (2 ε))⌉`; `None` if and only if N = 4 or G^0 = 0.
///
/// ```
/// use subcert::paper::cheng_yong::depth::n_epsilon;
/// use subcert::scalar::{Field, Rational};
/// let r = Rational::ratio;
/// // N = 3: (4/3)^2 = 16/9 >= 7/2 / 2 > 4/3.
/// assert_eq!(n_epsilon(3, &r(1, 1), &r(2, 1)), Some(2));
/// assert_eq!(n_epsilon(4, &r(1, 1), &r(2, 1)), None);
/// ```
pub fn n_epsilon(n: u32, g0: &Rational, epsilon: &Rational) -> Option<i64> {
    check(g0, epsilon);
    let x = g0 * ratio(printed::EQ_23_FACTOR) / epsilon;
    ceiling(&x, &printed::delta(n)?)
}

/// (27): W; `None` if and only if N = 4.
pub fn w(n: u32) -> Option<Rational> {
    printed::by_case(printed::EQ_27, n)
}

/// (31): `l_k = ⌈log_4 (W^k Z^0 / (3 ε))⌉`; `None` if and only if N = 4 or Z^0 = 0.
pub fn l_k(n: u32, k: u32, z0: &Rational, epsilon: &Rational) -> Option<i64> {
    check(z0, epsilon);
    let w = w(n)?;
    let power = (0..k).fold(Rational::one(), |power, _| power * &w);
    theorem_4(&(power * z0), epsilon)
}

/// (32): `D_k = max(n_ε, k + l_k)`; `None` if and only if N = 4. With Z^0 = 0 it is n_ε.
pub fn d_k(n: u32, k: u32, n_epsilon: i64, z0: &Rational, epsilon: &Rational) -> Option<i64> {
    w(n)?;
    let added = l_k(n, k, z0, epsilon).map(|l| i64::from(k) + l);
    Some(added.map_or(n_epsilon, |depth| depth.max(n_epsilon)))
}

/// (33): `D = max D_k`, 1 <= k <= n_ε; `None` if and only if N = 4.
///
/// Where n_ε < 1 (or G^0 = 0) the maximum is over nothing and the paper defines no D; it is 0 here: the
/// level-0 net is then in the ball of radius ε/2 of Theorem 6 and no step is needed.
pub fn theorem_9(n: u32, g0: &Rational, z0: &Rational, epsilon: &Rational) -> Option<i64> {
    check(z0, epsilon);
    let w = w(n)?;
    let last = n_epsilon(n, g0, epsilon).unwrap_or(0).max(0);
    let mut largest = last;
    let mut norm = z0.clone();
    for k in 1..=last {
        norm *= &w;
        // W > 1/4, so k + log_4 W^k rises with k, but the ceilings need not: all k are looked at.
        largest = theorem_4(&norm, epsilon).map_or(largest, |l| largest.max(k + l));
    }
    Some(largest)
}

/// The least k >= 0 with `factor · rates.. <= ε / G^0`, where `rates[j]` bounds level j + 1 over level 0 and
/// rates multiply: how many steps the same argument needs with better rates.
pub fn with_rates(factor: &Rational, rates: &[Rational], ratio: &Rational) -> i64 {
    let all = rates.len();
    let last = &rates[all - 1];
    let mut power = factor.clone();
    let mut k = 0;
    loop {
        let within = std::iter::once(<Rational as Ring>::from_integer(1));
        for (j, rate) in within.chain(rates[..all - 1].iter().cloned()).enumerate() {
            if &power * rate * ratio <= Rational::one() {
                return k + j as i64;
            }
        }
        power *= last;
        k += all as i64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn r(p: i64, q: i64) -> Rational {
        Rational::ratio(p, q)
    }

    /// By hand: 3 · 4^2 = 48 and its neighbours; log_4 of 1/16.
    #[test]
    fn theorem_4_at_powers_of_four() {
        assert_eq!(theorem_4(&r(48, 1), &r(1, 1)), Some(2));
        assert_eq!(theorem_4_strict(&r(48, 1), &r(1, 1)), 3);
        assert_eq!(theorem_4(&r(49, 1), &r(1, 1)), Some(3));
        assert_eq!(theorem_4_strict(&r(47, 1), &r(1, 1)), 2);
        assert_eq!(theorem_4(&r(3, 16), &r(1, 1)), Some(-2));
        assert_eq!(theorem_4(&r(0, 1), &r(1, 1)), None);
        assert_eq!(theorem_4_strict(&r(0, 1), &r(1, 1)), 0);
    }

    /// By hand: (98/85)^4 = 92236816/52200625 = 1.7670 < 1.8 < (98/85)^5 = 2.037.
    #[test]
    fn equation_23_in_exact_powers() {
        let g0 = r(36, 70); // 7/2 · 36/70 = 9/5
        assert_eq!(n_epsilon(5, &g0, &r(1, 1)), Some(5));
        assert_eq!(n_epsilon(17, &g0, &r(1, 1)), Some(5));
        // Exactly δ^2.
        let g0 = r(98 * 98 * 2, 85 * 85 * 7);
        assert_eq!(n_epsilon(6, &g0, &r(1, 1)), Some(2));
        assert_eq!(n_epsilon(3, &r(0, 1), &r(1, 1)), None);
    }

    /// By hand, N = 3: W = 2/3; Z^0 = 27: W^2 Z^0 / 3 = 4 = 4^1.
    #[test]
    fn equations_31_to_33() {
        assert_eq!(l_k(3, 2, &r(27, 1), &r(1, 1)), Some(1));
        assert_eq!(l_k(3, 1, &r(27, 1), &r(1, 1)), Some(2)); // 6 <= 16
        assert_eq!(d_k(3, 2, 2, &r(27, 1), &r(1, 1)), Some(3));
        assert_eq!(d_k(3, 1, 5, &r(27, 1), &r(1, 1)), Some(5));
        assert_eq!(d_k(3, 1, 5, &r(0, 1), &r(1, 1)), Some(5));
        // 7/2 G^0 = (4/3)^2: n_ε = 2, D = max(2, 1 + 2, 2 + 1) = 3.
        assert_eq!(theorem_9(3, &r(32, 63), &r(27, 1), &r(1, 1)), Some(3));
        // Z^0 = 28: 1 + ⌈log_4 (56/9)⌉ = 3, 2 + ⌈log_4 (112/27)⌉ = 4.
        assert_eq!(theorem_9(3, &r(32, 63), &r(28, 1), &r(1, 1)), Some(4));
        assert_eq!(theorem_9(4, &r(1, 1), &r(1, 1), &r(1, 1)), None);
        assert_eq!(theorem_9(8, &r(0, 1), &r(1, 1), &r(1, 1)), Some(0));
        assert_eq!(theorem_9(8, &r(1, 100), &r(100, 1), &r(1, 1)), Some(0));
    }

    #[test]
    fn floats_are_taken_exactly() {
        let tenth = Rational::from_float(0.1).expect("finite");
        // 0.1 as a float is above 1/10: 3 · 4 · 0.1 / (3 · 1/10) > 4.
        assert_eq!(theorem_4(&(tenth * r(12, 1)), &r(1, 10)), Some(2));
    }

    /// 7/2 · (1/2)^3 · 2 = 7/8: three steps with a rate of 1/2 each, or 1/8 in three.
    #[test]
    fn steps_with_rates() {
        let factor = r(7, 2);
        assert_eq!(with_rates(&factor, &[r(1, 2)], &r(2, 1)), 3);
        assert_eq!(
            with_rates(&factor, &[r(1, 2), r(1, 4), r(1, 8)], &r(2, 1)),
            3
        );
        assert_eq!(
            with_rates(&factor, &[r(1, 2), r(1, 8), r(1, 8)], &r(2, 1)),
            2
        );
    }
}
