//! Enclosures of 2 cos(2π j/n) to any number of bits, by integer arithmetic and signs alone.
//!
//! No π and no library cosine enters the proof. Let `S_0 = 1, S_1 = x, S_(k+1) = x S_k - S_(k-1)`,
//! so `S_k(2 cos t) = sin((k+1) t) / sin t`, and let 0 < x < 2, x = 2 cos t, 0 < t < π/2.
//!
//! * If t < π/n then (k+1) t < π and S_k(x) > 0 for all k < n. So **S_k(x) < 0 for one k < n proves
//!   x <= 2 cos(π/n)**.
//! * If t >= π/n let m <= n be least with m t >= π; then m t < π + t < 2π and S_(m-1)(x) <= 0. So
//!   **S_k(x) > 0 for all k < n proves x > 2 cos(π/n)**.
//!
//! The S_k are evaluated in fixed point. If each product is rounded down with an error in (-1, 0]
//! units, the errors obey the same recurrence: `e_k = Σ_(i<=k) S_(k-i)(x) d_i`, and
//! |S_i(x)| <= i + 1 on [-2, 2], so **|e_k| <= k^2 units**.
//!
//! Then 2 cos(2π/n) = (2 cos(π/n))^2 - 2, and its multiples come by Dickson's recurrence
//! `D_0 = 2, D_1 = c, D_(k+1) = c D_k - D_(k-1)`, D_k(2 cos t) = 2 cos(k t). There the same bound of
//! the rounding holds, and an error e of c itself adds at most k^2 e, for D_k' = k S_(k-1).

use std::cmp::Ordering;
use std::collections::HashMap;
use std::sync::{LazyLock, RwLock};

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Float, Signed};

use super::float::{power_of_two, round_down, round_to_nearest, round_up};
use super::{Field, Rational};

/// A closed interval with ends `inf / 2^bits` and `sup / 2^bits`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DyadicEnclosure {
    /// Numerator of the lower end.
    pub inf: BigInt,
    /// Numerator of the upper end.
    pub sup: BigInt,
    /// Exponent of the common denominator `2^bits`.
    pub bits: u32,
}

impl DyadicEnclosure {
    /// The lower end.
    pub fn inf_rational(&self) -> Rational {
        Rational::new(self.inf.clone(), power_of_two(self.bits))
    }

    /// The upper end.
    pub fn sup_rational(&self) -> Rational {
        Rational::new(self.sup.clone(), power_of_two(self.bits))
    }
}

/// An enclosure of `2 cos(2π j/n)` with denominator `2^bits` and `sup - inf <= 2`; exact
/// (`sup = inf`) if the number is rational. `None` if and only if n = 0.
///
/// Guarantee: proved, see the head of this file. Time: O(n + j) products of numbers of about
/// `bits + 4 log2 n` bits; the part that depends on n alone is done once per (n, bits).
///
/// ```
/// use subcert::scalar::cosine::enclose_two_cos;
/// // 2 cos(2π/5) = (√5 - 1)/2: the positive root of x^2 + x - 1.
/// let e = enclose_two_cos(1, 5, 100).unwrap();
/// let at = |x: num_bigint::BigInt| &x * &x + (&x << 100u32) - (num_bigint::BigInt::from(1) << 200u32);
/// assert!(at(e.inf.clone()) < 0.into() && at(e.sup.clone()) > 0.into());
/// ```
pub fn enclose_two_cos(j: u32, n: u32, bits: u32) -> Option<DyadicEnclosure> {
    if n == 0 {
        return None;
    }
    let divisor = j.gcd(&n);
    let (j, n) = (j / divisor % (n / divisor), n / divisor);
    if let Some(value) = <Rational as Field>::two_cos(j, n) {
        let numerator = value.to_integer() << bits;
        return Some(DyadicEnclosure {
            inf: numerator.clone(),
            sup: numerator,
            bits,
        });
    }
    let j = j.min(n - j);
    let mut last = BigInt::ZERO;
    let fixed = visit_multiples(n, j, bits, |value| last = value);
    // |last / 2^b - D_j| <= error / 2^b < 2^-(bits+1): two units of 2^-bits hold the rest.
    let shift = fixed.bits - bits;
    Some(DyadicEnclosure {
        inf: (&last - &fixed.error) >> shift,
        sup: -((-(last + &fixed.error)) >> shift),
        bits,
    })
}

/// The scale and the error bound of a table of fixed-point numbers.
#[derive(Clone, Debug)]
pub(super) struct FixedPoint {
    /// Each entry is in units of `2^-bits`.
    pub bits: u32,
    /// Each entry is wrong by at most so many units.
    pub error: BigInt,
}

/// Hands `D_0, D_1, .., D_count`, fixed-point values of 2 cos(2π k/n), to `visit`; every one is in
/// error by less than `2^-(bits+1)`. n = 5 or n >= 7, 1 <= count <= n/2.
pub(super) fn visit_multiples(
    n: u32,
    count: u32,
    bits: u32,
    mut visit: impl FnMut(BigInt),
) -> FixedPoint {
    // k^2 + k^2 C_WIDTH <= 15 * 4^len units of 2^-(bits + 2 len + 6).
    let scale = bits + 2 * bit_length(count) + 6;
    let c = lower_two_cos(n, scale);
    let (mut previous, mut current) = (BigInt::from(2) << scale, c.clone());
    visit(previous.clone());
    for _ in 1..count {
        visit(current.clone());
        let next = ((&c * &current) >> scale) - &previous;
        previous = std::mem::replace(&mut current, next);
    }
    visit(current);
    FixedPoint {
        bits: scale,
        error: BigInt::from(u64::from(count).pow(2)) * (C_WIDTH + 1),
    }
}

/// Number of bits of k.
fn bit_length(k: u32) -> u32 {
    u32::BITS - k.leading_zeros()
}

/// `0 <= 2 cos(2π/n) - lower_two_cos / 2^bits <= C_WIDTH / 2^bits`.
const C_WIDTH: u32 = 14;

/// A lower end of an enclosure of 2 cos(2π/n) of width `C_WIDTH / 2^bits`; n = 5 or n >= 7.
fn lower_two_cos(n: u32, bits: u32) -> BigInt {
    static KNOWN: LazyLock<RwLock<HashMap<(u32, u32), BigInt>>> = LazyLock::new(RwLock::default);
    // A poisoned lock still guards a complete map: entries are inserted whole.
    if let Some(known) = KNOWN
        .read()
        .unwrap_or_else(|e| e.into_inner())
        .get(&(n, bits))
    {
        return known.clone();
    }
    // Fewer bits than this and 2 - 2 cos(π/n) = π^2/n^2 - .. would not be seen.
    let extra = (2 * bit_length(n) + 8).saturating_sub(bits);
    let fine = bits + extra;
    let root = lower_two_cos_half(n, fine);
    // x in [r, r + 3] / 2^b with r < 2^(b+1): x^2 is at most (6 r + 9) / 4^b < 13 / 2^b above
    // r^2 / 4^b; rounding down adds less than one unit.
    let square = (&root * &root) >> (fine + extra);
    let value = square - (BigInt::from(2) << bits);
    KNOWN
        .write()
        .unwrap_or_else(|e| e.into_inner())
        .insert((n, bits), value.clone());
    value
}

/// An r with r / 2^bits <= 2 cos(π/n) < (r + 3) / 2^bits, both proved by [`compare_with_root`].
///
/// The proposal is Newton's method for S_(n-1), whose slope at its largest root x is
/// 2n / (4 - x^2).
fn lower_two_cos_half(n: u32, bits: u32) -> BigInt {
    let scale = bits + guard_bits(n);
    let four = BigInt::from(4) << (2 * scale);
    // 2 - 2 cos t = t^2 (1 - t^2/12 (1 - t^2/30 (1 - ..))), by operations that every machine rounds
    // alike, so that the proposal is the same everywhere.
    let t2 = (std::f64::consts::PI / f64::from(n)).powi(2);
    let start = t2 * (1.0 - t2 / 12.0 * (1.0 - t2 / 30.0 * (1.0 - t2 / 56.0)));
    let mut x = (BigInt::from(2) << scale) - fixed_point(start, scale);
    let mut previous_step: Option<BigInt> = None;
    loop {
        let value = last_s(&x, scale, n);
        // value (4 - x^2) / (2n), in units: value and x at 2^-scale.
        let step = (value * (&four - &x * &x) / (2 * u64::from(n))) >> (2 * scale);
        let settled = previous_step.is_some_and(|p| step.magnitude() >= p.magnitude());
        if settled || step.magnitude().bits() <= 1 {
            break;
        }
        x -= &step;
        previous_step = Some(step);
    }
    let proposal: BigInt = (x >> (scale - bits)) - 1u32;
    // Here the proof starts: it would mend any proposal, by steps of one unit.
    let mut root = proposal;
    while compare_with_root(&root, bits, n) != Some(Ordering::Less) {
        root -= 1u32;
    }
    while compare_with_root(&(&root + 3u32), bits, n) != Some(Ordering::Greater) {
        root += 1u32;
        assert_eq!(
            compare_with_root(&root, bits, n),
            Some(Ordering::Less),
            "the enclosure of 2 cos(pi/{n}) needs more guard bits"
        );
    }
    root
}

/// A positive `f64` times 2^scale, rounded down.
fn fixed_point(x: f64, scale: u32) -> BigInt {
    let (mantissa, exponent, _) = x.integer_decode();
    let shift = i64::from(exponent) + i64::from(scale);
    if shift >= 0 {
        BigInt::from(mantissa) << shift
    } else {
        BigInt::from(mantissa) >> -shift
    }
}

/// Bits beyond the wanted ones in the evaluation of S_k: at 2^-b from the root |S_(n-1)| is about
/// (n/2) 2^-b or more, its error at most n^2 units.
fn guard_bits(n: u32) -> u32 {
    2 * bit_length(n) + 8
}

/// S_(n-1)(x) in fixed point.
fn last_s(x: &BigInt, scale: u32, n: u32) -> BigInt {
    let (mut previous, mut current) = (power_of_two(scale), x.clone());
    for _ in 2..n {
        let next = ((x * &current) >> scale) - &previous;
        previous = std::mem::replace(&mut current, next);
    }
    current
}

/// `Less`: x = m / 2^bits is proved to be at most 2 cos(π/n). `Greater`: proved to be greater.
/// `None`: too close. n >= 4.
fn compare_with_root(m: &BigInt, bits: u32, n: u32) -> Option<Ordering> {
    if !m.is_positive() {
        return Some(Ordering::Less);
    }
    if *m >= power_of_two(bits + 1) {
        return Some(Ordering::Greater);
    }
    let scale = bits + guard_bits(n);
    let x = m << (scale - bits);
    let (mut previous, mut current) = (power_of_two(scale), x.clone());
    let mut all_positive = true;
    for k in 1..u64::from(n) {
        let error = BigInt::from(k) * k;
        if &current + &error < BigInt::ZERO {
            return Some(Ordering::Less);
        }
        all_positive &= current > error;
        let next = ((&x * &current) >> scale) - &previous;
        previous = std::mem::replace(&mut current, next);
    }
    all_positive.then_some(Ordering::Greater)
}

/// `2 cos(2π j/n)` in `f64`: neighbours and nearest.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoundedCosine {
    pub inf: f64,
    pub nearest: f64,
    pub sup: f64,
}

/// Rounds an enclosure of `2 cos(2π j/n)`; `None` if and only if n = 0. Each pair is computed once.
pub(super) fn rounded_two_cos(j: u32, n: u32) -> Option<RoundedCosine> {
    /// |2 cos| > 2^-32 wherever it isn't 0: at least 2^-95 of relative accuracy.
    const BITS: u32 = 127;
    static KNOWN: LazyLock<RwLock<HashMap<(u32, u32), RoundedCosine>>> =
        LazyLock::new(RwLock::default);
    if let Some(known) = KNOWN.read().unwrap_or_else(|e| e.into_inner()).get(&(j, n)) {
        return Some(*known);
    }
    let enclosure = enclose_two_cos(j, n, BITS)?;
    let middle = Rational::new(&enclosure.inf + &enclosure.sup, power_of_two(BITS + 1));
    let rounded = RoundedCosine {
        inf: round_down(&enclosure.inf_rational()),
        nearest: round_to_nearest(&middle),
        sup: round_up(&enclosure.sup_rational()),
    };
    KNOWN
        .write()
        .unwrap_or_else(|e| e.into_inner())
        .insert((j, n), rounded);
    Some(rounded)
}
