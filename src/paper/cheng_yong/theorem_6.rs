//! (21)..(23): the largest rate, δ, Theorem 6, and which valence is fastest.

use std::cmp::Ordering;

use num_traits::One;

use super::first_order::Facts;
use super::norm::number;
use super::setting::LEVELS;
use super::wording::{scope, valences};
use super::{depth, printed};
use crate::paper::words::{NOWHERE, all, claim, exceptions, gravest, list};
use crate::paper::{Claim, Verdict};
use crate::scalar::{Decide, Field, Rational, Ring};

/// G^0 / ε of the table of depths.
const RATIO: i64 = 100;

/// The claims.
pub fn claims(found: &[&Facts]) -> Vec<Claim> {
    vec![largest_rate(), delta(), theorem_6(found), fastest(found)]
}

/// n_ε of (23) for G^0 / ε = 100.
pub fn printed_depth(f: &Facts) -> Option<i64> {
    let ratio = <Rational as Ring>::from_integer(RATIO);
    depth::n_epsilon(f.n, &ratio, &Rational::one())
}

/// The same by the true rates.
pub fn rate_depth(f: &Facts) -> Option<i64> {
    let rates: Vec<Rational> = (1..=LEVELS).map(|k| f.rate(k)).collect::<Option<_>>()?;
    let factor = Rational::ratio(printed::EQ_23_FACTOR.0, printed::EQ_23_FACTOR.1);
    let ratio = <Rational as Ring>::from_integer(RATIO);
    Some(depth::with_rates(&factor, &rates, &ratio))
}

/// `196 N² (85/98 - r(N)) = (N - 7)(23 N - 182)`: a convex quadratic that is 0 at 7 and positive at 6 and 8.
fn largest_rate() -> Claim {
    let largest = printed::at(printed::RATE, printed::LARGEST_AT as u32);
    let quadratic = |n: i64| (n - 7) * (23 * n - 182);
    // Quadratics in N that agree at three places agree everywhere.
    let identity = [5u32, 6, 9].iter().all(|&n| {
        let m = i64::from(n);
        let left = (&largest - printed::at(printed::RATE, n)) * Rational::ratio(196 * m * m, 1);
        left == <Rational as Ring>::from_integer(quadratic(m))
    });
    let least_at = printed::LARGEST_AT;
    let only = quadratic(least_at) == 0
        && [least_at - 1, least_at + 1]
            .iter()
            .all(|&n| quadratic(n) > 0);
    claim(
        "largest-rate",
        "before (21)",
        "The maximum of 3/4 + 7/(4N) - 13/(2N²) occurs at N = 7.",
        Verdict::of(Some(identity && only)),
        format!(
            "over the integers: {largest} - r(N) = (N - 7)(23N - 182) / (196 N²), zero at N = 7 and positive at every \
             other integer"
        ),
        "all N",
    )
}

fn delta() -> Claim {
    let largest = printed::at(printed::RATE, printed::LARGEST_AT as u32);
    let [three, more] = printed::DELTA.map(|(p, q)| Rational::ratio(q, p));
    let right = more == largest && Some(three) == printed::rate(3);
    claim(
        "delta",
        "(21), (22)",
        "1/δ bounds the rate of (19): δ = 4/3 for N = 3, 98/85 for N >= 5.",
        Verdict::of(Some(right)),
        "98/85 is the reciprocal of the rate at N = 7, the largest (largest-rate)",
        "all N",
    )
}

fn theorem_6(found: &[&Facts]) -> Claim {
    let truths = found.iter().filter_map(|f| {
        let shorter = rate_depth(f)? < printed_depth(f)?;
        Some((
            f.n,
            match (f.theorem_6_holds(), shorter) {
                (true, true) => Verdict::Loose,
                (true, false) => Verdict::True,
                _ => Verdict::Undecided,
            },
        ))
    });
    let verdicts: Vec<_> = truths.collect();
    let depths = found
        .iter()
        .filter_map(|f| Some((f.n, format!("{} of {}", rate_depth(f)?, printed_depth(f)?))));
    Claim {
        method: Some(
            "as printed for N = 3 and N >= 5; at N = 4 use Theorem 4; a negative n_ε means 0 steps"
                .into(),
        ),
        ..claim(
            "theorem-6",
            "Theorem 6, (23)",
            "The distance of S_0^n from L_0^n is at most ε for n >= n_ε = ⌈log_δ (7G^0/(2ε))⌉.",
            gravest(&verdicts),
            format!(
                "{}. With the true rates of k <= {LEVELS} the same argument gives, for G^0/ε = {RATIO}, {} steps",
                match gravest(&verdicts) {
                    Verdict::Loose | Verdict::True => {
                        "the theorem survives: it needs (19) with k = n, (17) and (13), all true"
                    }
                    _ => "what it needs was not shown for all",
                },
                list(depths)
            ),
            scope(valences(&verdicts)),
        )
    }
}

fn fastest(found: &[&Facts]) -> Claim {
    let Some(three) = found.iter().find(|f| f.n == 3 && found.len() > 1) else {
        return claim("fastest", "", "", Verdict::Undecided, "", NOWHERE);
    };
    let truths: Vec<(u32, Option<bool>)> = found
        .iter()
        .filter(|f| f.n != 3)
        .map(|f| {
            let less =
                (1..=LEVELS).map(|k| Some(three.rate(k)?.decide(&f.rate(k)?)? == Ordering::Less));
            (f.n, all(less))
        })
        .collect();
    let values = found
        .iter()
        .filter_map(|f| Some((f.n, number(&f.rate(LEVELS)?))));
    claim(
        "fastest",
        "after Theorem 6",
        "Convergence near the extraordinary vertex is fastest when its valence is three.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "in the first-order norm: {}, the regular N = 4 included; G^{LEVELS}/G^0: {}. (For the second-order norm \
             see avoid-five.)",
            exceptions(&truths),
            list(values)
        ),
        scope(found.iter().map(|f| f.n)),
    )
}
