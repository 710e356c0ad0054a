//! From the distances over one ring to those over all (Peters & Wu, Lemma 3), and short numbers.

use super::Enclosed;
use crate::scalar::float::{round_down, round_up};
use crate::scalar::{Interval, Rational, Ring};

/// Binary digits of the numbers in certificates.
const DIGITS: i32 = 22;
/// What is given away before a number is shortened, so that whoever repeats the computation in other
/// roundings finds room: a relative amount, and an absolute one for numbers near 0.
const SLACK: f64 = 1.0 / (1u64 << 34) as f64;
const LEAST_SLACK: f64 = 1.0 / (1u64 << 54) as f64;

/// `lo <= μ_m <= hi` from the enclosures of D_s, s = 0.., and N.
///
/// With the chain's κ and its own D_s and N, `|λ|^r hi + r |λ|^(r-1) |κ| hi_f` bounds what it is over
/// ring r from above, and `|λ|^r lo - r |λ|^(r-1) |κ| hi_f` from below.
pub fn distances(
    eigenvalue: Interval,
    rings: &[Enclosed],
    near: &Enclosed,
    chain: Option<(Interval, (&[Enclosed], &Enclosed))>,
) -> Vec<[Rational; 2]> {
    let enclose = |x: &Rational| Interval::new(round_down(x), round_up(x));
    let power = |r: usize| {
        (0..r).fold(Interval::from_integer(1), |power, _| {
            power * eigenvalue.abs()
        })
    };
    let at_level = |m: usize| {
        let over_rings = (0..=m).map(|r| (r, &rings[m - r], chain.map(|(_, f)| &f.0[m - r])));
        let over_rest = (m, near, chain.map(|(_, f)| f.1));
        let (mut lo, mut hi) = (0.0f64, 0.0f64);
        for (r, own, other) in over_rings.chain([over_rest]) {
            let kappa = chain.map_or(Interval::from_integer(0), |(kappa, _)| kappa.abs());
            let of_chain = other.map_or(Interval::from_integer(0), |other| enclose(&other.hi));
            let count = Interval::from_integer(r as i64);
            let more = count * power(r.saturating_sub(1)) * kappa * of_chain;
            lo = lo.max((power(r) * enclose(&own.lo) - more).inf());
            hi = hi.max((power(r) * enclose(&own.hi) + more).sup());
        }
        [below(lo), above(hi)]
    };
    (0..rings.len()).map(at_level).collect()
}

/// A short number below x, 0 if there is no positive one.
pub fn below(x: f64) -> Rational {
    let x = (x - LEAST_SLACK) * (1.0 - SLACK);
    if x <= 0.0 {
        return Ring::from_integer(0);
    }
    short(x, f64::floor)
}

/// A short number above x >= 0.
pub fn above(x: f64) -> Rational {
    short((x + LEAST_SLACK) * (1.0 + SLACK), f64::ceil)
}

/// x > 0 with few digits; scaling by powers of two is exact.
fn short(x: f64, round: fn(f64) -> f64) -> Rational {
    let exponent = x.log2().floor() as i32 + 1 - DIGITS;
    let unit = 2.0f64.powi(exponent);
    Rational::from_float(round(x / unit) * unit).expect("a finite number")
}
