//! Lemma 8 and Theorem 9: the depth of the whole patch.

use std::cmp::Ordering;

use num_traits::One;

use super::appendix_a::on_bound;
use super::second_order::on_lemma_7;
use super::setting::LEVELS;
use super::wording::{scope, valences};
use super::{Valence, depth, printed};
use crate::paper::words::{by_verdict, claim, gravest, list};
use crate::paper::{Claim, Verdict};
use crate::scalar::{Decide, Field, Rational, Ring};

/// Z^0 / ε and G^0 / ε of the example.
const RATIO: i64 = 100;

/// The claims.
pub fn claims(found: &[Valence]) -> Vec<Claim> {
    vec![lemma_8(found), theorem_9(found)]
}

/// The part of Theorem 9 that [`depth::theorem_9`] prints, with the true rates instead.
pub fn depth_by_rates(v: &Valence) -> Option<i64> {
    let ratio = <Rational as Ring>::from_integer(RATIO);
    let epsilon = Rational::one();
    let rates: Vec<Rational> = (1..=LEVELS)
        .map(|k| v.first.rate(k))
        .collect::<Option<_>>()?;
    let factor = Rational::ratio(printed::EQ_23_FACTOR.0, printed::EQ_23_FACTOR.1);
    let n = depth::with_rates(&factor, &rates, &ratio);
    let mut largest = n;
    for k in 1..=n {
        let norm = v.second.third_bound(k as usize)? * &ratio;
        largest = largest.max(k + depth::theorem_4(&norm, &epsilon)?);
    }
    Some(largest)
}

/// D of (33) for G^0 / ε = Z^0 / ε = 100.
pub fn printed_depth(n: u32) -> Option<i64> {
    let ratio = <Rational as Ring>::from_integer(RATIO);
    depth::theorem_9(n, &ratio, &ratio, &Rational::one())
}

/// Why "smaller" holds though (31) may be an integer: at l = 0 the distance is below W Z/3 (lemma-7); for l >= 1 each
/// second difference at the level-l faces is 4^-l times an average of those of Π_3, never of a single one, and only
/// one of them (across V_1) can reach W: the largest other one is below W.
fn strict(v: &Valence) -> Option<bool> {
    let w = depth::w(v.n)?;
    let others = v.d.largest_other()?;
    let below = others.decide(&w)? == Ordering::Less;
    Some(below && on_lemma_7(&v.second)? == Verdict::Loose)
}

fn lemma_8(found: &[Valence]) -> Claim {
    let truths: Vec<(u32, Option<bool>)> = found
        .iter()
        .filter(|v| v.n != 4)
        .map(|v| (v.n, strict(v)))
        .collect();
    let verdicts: Vec<(u32, Verdict)> = truths
        .iter()
        .map(|&(n, truth)| {
            (
                n,
                match truth {
                    Some(true) => Verdict::Loose,
                    _ => Verdict::Undecided,
                },
            )
        })
        .collect();
    claim(
        "lemma-8",
        "Lemma 8, (29)-(31)",
        "l_k = ⌈log_4 (W^k Z_0^0 / (3ε))⌉ more steps on Π_3^k bring S_3^k and its mesh to a distance smaller than ε.",
        gravest(&verdicts),
        match gravest(&verdicts) {
            Verdict::Loose => {
                "\"smaller\" holds even where the ceiling is taken of an integer, unlike in Theorem 4: only one second \
                 difference of Π_3 can reach W Z, the one across V_1, and no level-l face has it alone. Not the best \
                 possible, as (28) is not"
            }
            _ => "what it needs was not shown for all",
        },
        scope(valences(&verdicts)),
    )
}

fn theorem_9(found: &[Valence]) -> Claim {
    let verdict = |v: &Valence| {
        let printed = printed_depth(v.n)?;
        let holds = |verdict: Verdict| matches!(verdict, Verdict::Sharp | Verdict::Loose);
        let w = depth::w(v.n)?;
        let bounds = [&v.second.third[0], &v.second.zero[0]];
        let proved = bounds.iter().all(|sup| holds(on_bound(sup, &w)))
            && strict(v)?
            && v.first.theorem_6_holds();
        Some((
            v.n,
            match (proved, depth_by_rates(v)? < printed) {
                (true, true) => Verdict::Loose,
                (true, false) => Verdict::True,
                _ => Verdict::Undecided,
            },
        ))
    };
    let verdicts: Vec<_> = found.iter().filter_map(verdict).collect();
    let depths = found.iter().filter_map(|v| {
        Some((
            v.n,
            format!("{} of {}", depth_by_rates(v)?, printed_depth(v.n)?),
        ))
    });
    Claim {
        method: Some(
            "for n_ε < 1 the maximum in (33) is over nothing: 0 steps do; at N = 4, for which nothing is printed, use \
             Theorem 4"
                .into(),
        ),
        ..claim(
            "theorem-9",
            "Theorem 9, (32), (33)",
            "After D = max D_k steps, D_k = max(n_ε, k + l_k), 1 <= k <= n_ε, the distance between S and the level-D mesh \
             is smaller than ε.",
            gravest(&verdicts),
            format!(
                "{}: {}. With the true rates the same argument gives, for G^0/ε = Z^0/ε = {RATIO}, {} steps",
                by_verdict(&verdicts),
                match gravest(&verdicts) {
                    Verdict::Loose | Verdict::True => {
                        "the theorem survives; it needs (13), (19) and (26), all true, and no step of Appendix C or D \
                         that is not"
                    }
                    _ => "what it needs was not shown for all",
                },
                list(depths)
            ),
            scope(valences(&verdicts)),
        )
    }
}
