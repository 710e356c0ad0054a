//! Appendix C: the displayed estimates (46), (47), (48), (50), (51), each an identity and an inequality.

use super::appendix_a::on_bound;
use super::functional::Functional;
use super::norm::Sup;
use super::printed;
use super::setting::Setting;
use super::violation::texts;
use super::wording::{grouped, scope};
use crate::paper::words::{claim, gravest, ranges};
use crate::paper::{Claim, Counterexample, Verdict};
use crate::scalar::{Field, Rational};
use crate::scheme::catmull_clark::local_net_size;

/// The regroupings put right: identities whose factors add up to the printed bound.
const CORRECTED: [(&str, &str, &str); 3] = [
    (
        "eq-47",
        "3/16 ( V2 - V1 ) + 3/16 ( V3 - V4 ) + 1/16 ( V1 - V6 ) + 1/16 ( V4 - V5 )",
        "3/16 in place of 1/16 before V3 - V4",
    ),
    (
        "eq-48",
        "1/64 ( V2N+8 - V4 ) + 3/32 ( V2N+7 - V4 ) + 1/64 ( V2N+6 - V4 ) + 9/32 ( V4 - V1 ) \
         + 1/64 ( V1 - V6 ) + 1/32 ( V4 - V6 ) + 3/64 ( V1 - V2 ) + 1/32 ( V3 - V1 ) + 1/32 ( V5 - V1 )",
        "1/64 (V1 - V6) + 1/32 (V4 - V6) in place of 3/64 (V1 - V6)",
    ),
    (
        "eq-51",
        "3/32 ( V2N+6 - V5 ) + 1/64 ( V2N+2 - V5 ) + 3/32 ( V2N+3 - V5 ) + 1/64 ( V2N+4 - V6 ) \
         + 1/64 ( V2N+7 - V4 ) + 9/64 ( V5 - V6 ) + 9/64 ( V5 - V4 ) + 15/64 ( V5 - V1 )",
        "+ 1/64 (V2N+2 - V5) + 3/32 (V2N+3 - V5) in place of - 1/64 (V2N+2 - V5) - 3/32 (V2N+3 + V5)",
    ),
];

/// A displayed estimate, examined.
#[derive(Clone, Debug)]
pub struct Examined {
    /// Whether the first rewriting is an identity.
    first: bool,
    /// Whether the regrouping is.
    second: bool,
    /// Whether the corrected one is.
    corrected: Option<bool>,
    /// Over the norms that the estimate names.
    pub sup: Sup,
    /// A unit net at which the regrouping is not the difference: label, both values.
    witness: Option<(usize, Rational, Rational)>,
}

/// Examines an estimate.
pub fn examine(setting: &Setting, estimate: &printed::Estimate) -> Examined {
    let left = setting.parse(estimate.left).of(&setting.levels[1]);
    let minus = Functional::zero_minus(&left);
    let is_left = |t: &Functional| t.same(&left) || t.same(&minus);
    let second = setting.parse(estimate.second);
    let corrected = CORRECTED.iter().find(|(id, ..)| *id == estimate.id);
    // Signs: the regrouping is compared with the side it is nearer to.
    let sided = match estimate.first.map(|t| setting.parse(t)) {
        Some(first) if first.same(&minus) => &minus,
        _ => &left,
    };
    let places = second
        .coefficients()
        .iter()
        .zip(sided.coefficients())
        .enumerate();
    let witness = places.into_iter().find(|(_, (a, b))| a != b);
    Examined {
        first: estimate.first.is_none_or(|t| is_left(&setting.parse(t))),
        second: is_left(&second),
        corrected: corrected.map(|(_, text, _)| is_left(&setting.parse(text))),
        sup: setting.norm(estimate.norms).sup(&left),
        witness: witness.map(|(i, (a, b))| (i + 1, b.clone(), a.clone())),
    }
}

/// The name of a norm in sentences.
pub fn name(norms: &[usize]) -> String {
    let names: Vec<String> = norms.iter().map(|j| format!("G_{j}")).collect();
    match names.len() {
        1 => names.concat(),
        _ => format!("max({})", names.join(", ")),
    }
}

/// The claim on an estimate, by valence.
pub fn claim_on(found: &[(u32, &Examined)], estimate: &printed::Estimate) -> Claim {
    let bound = Rational::ratio(estimate.factor.0, estimate.factor.1);
    let verdict = |e: &Examined| {
        let on_bound = on_bound(&e.sup, &bound);
        match e.first && e.second {
            true => on_bound,
            false => on_bound.max(Verdict::Misprint),
        }
    };
    let verdicts: Vec<(u32, Verdict)> = found.iter().map(|(n, e)| (*n, verdict(e))).collect();
    let firsts = found.iter().all(|(_, e)| e.first);
    let broken = ranges(found.iter().filter(|(_, e)| !e.second).map(|(n, _)| *n));
    let first = match (estimate.first, firsts) {
        (None, _) => "",
        (Some(_), true) => "The first rewriting is an identity. ",
        (Some(_), false) => "The first rewriting is no identity. ",
    };
    let second = match &*broken {
        "none" => "The regrouping is an identity".to_string(),
        _ => format!("The regrouping, as scanned, is no identity (N = {broken})"),
    };
    let bounded = found
        .iter()
        .all(|(_, e)| e.sup.at_most(&bound) == Some(true));
    let witness = found.iter().find_map(|&(n, e)| {
        let (label, left, right) = e.witness.as_ref()?;
        let net = Functional::point(local_net_size(n), *label);
        Some(Counterexample {
            valence: n,
            net: texts(net.coefficients()),
            what: format!(
                "{} (level i + 1, up to its sign) is {left}, the regrouping {right}",
                estimate.left
            ),
        })
    });
    let corrected = CORRECTED.iter().find(|(id, ..)| *id == estimate.id);
    let method = corrected.map(|(_, _, change)| {
        let right = found.iter().all(|(_, e)| e.corrected == Some(true));
        format!(
            "{change}: {}",
            if right {
                "then it is one, with the printed bound"
            } else {
                "still none"
            }
        )
    });
    Claim {
        counterexample: witness,
        method,
        ..claim(
            estimate.id,
            estimate.place,
            format!(
                "{} (level i + 1) = ± {}, of norm at most {bound} {}.",
                estimate.left,
                estimate.second,
                name(estimate.norms)
            ),
            gravest(&verdicts),
            format!(
                "{first}{second}. The inequality {}: the supremum is {}",
                match bounded {
                    true => "holds whatever the regrouping",
                    false => "fails",
                },
                grouped(found.iter().map(|(n, e)| (*n, e.sup.to_string())))
            ),
            scope(found.iter().map(|(n, _)| *n)),
        )
    }
}
