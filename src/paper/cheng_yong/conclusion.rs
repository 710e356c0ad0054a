//! Section 5: what the paper concludes from its rates.

use std::cmp::Ordering;

use super::norm::number;
use super::setting::Setting;
use super::violation::{Named, Violation, texts};
use super::{Valence, printed};
use crate::bound::{Constant, Prover};
use crate::paper::words::{NOWHERE, all, claim, exceptions, list, ranges};
use crate::paper::{Claim, Counterexample, Enclosure, Verdict};
use crate::scalar::{Decide, Field, Rational};
use crate::scheme::LoopWeights;

/// Relative gap of the enclosures of Loop's rates; most are exact.
const GAP: f64 = 1e-8;

/// Digits of Loop's rates in sentences.
const DIGITS: u32 = 4;

/// One step of Loop's scheme: the rate of its second-order norm.
#[derive(Clone, Debug)]
pub struct Facts {
    triangles: Option<Enclosure>,
    exact: Option<Rational>,
    /// Certificate that quadrilaterals are slower, at a rational rate of triangles.
    pub certificate: Option<Named>,
    net: Option<Vec<Rational>>,
}

impl Facts {
    /// Of a valence.
    pub fn of(setting: &Setting) -> Self {
        let n = setting.n;
        // Triangles are regular at valence 6, quadrilaterals at 4: both have 1/4 there.
        let mut prover = Prover::new(LoopWeights::Original, n);
        let proof = prover.prove(Constant::Rate(1), GAP);
        let exact = proof.as_ref().and_then(|proof| prover.closed_form(proof));
        let triangles = match (&exact, &proof) {
            (Some(exact), _) => Some(Enclosure::algebraic(exact)),
            (None, Some(proof)) => Enclosure::floats(proof.lo, proof.hi),
            _ => None,
        };
        let exact = exact.and_then(|x| x.to_rational());
        let differences = setting.rows_of(setting.z.rows(), 1);
        let (at, sup) = setting.z.largest(&differences);
        let violated = exact
            .as_ref()
            .filter(|rate| sup.at_most(rate) == Some(false));
        let certificate = violated.and_then(|factor| {
            let left = super::functional::Functional::of_row(&setting.z.rows()[at], setting.size());
            let violation = Violation {
                claim: "quads-faster",
                n,
                left: ("0", &left),
                factor,
                right: setting.z.rows(),
                net: sup.net()?,
            };
            Some(violation.certificate())
        });
        let net = certificate
            .as_ref()
            .and(sup.net())
            .map(<[Rational]>::to_vec);
        Facts {
            triangles,
            exact,
            certificate,
            net,
        }
    }
}

/// The claims.
pub fn claims(found: &[Valence], scope: &str) -> Vec<Claim> {
    vec![avoid_five(found, scope), quadrilaterals(found, scope)]
}

fn avoid_five(found: &[Valence], scope: &str) -> Claim {
    let three = found.iter().find(|v| v.n == 3);
    let (Some(three), true) = (three, found.iter().any(|v| v.n >= 5)) else {
        return claim("avoid-five", "", "", Verdict::Undecided, "", NOWHERE);
    };
    let less = |a: Option<Rational>, b: Option<Rational>| Some(a?.decide(&b?)? == Ordering::Less);
    let truths: Vec<(u32, Option<bool>)> = found
        .iter()
        .filter(|v| v.n >= 5)
        .map(|v| {
            let first = less(three.first.rate(1), v.first.rate(1));
            let second = less(
                three.second.zero[0].value().cloned(),
                v.second.zero[0].value().cloned(),
            );
            let printed = less(printed::rate(3), printed::rate(v.n));
            (v.n, all([first, second, printed]))
        })
        .collect();
    let values = found.iter().filter_map(|v| {
        Some((
            v.n,
            format!("{}, {}", number(&v.first.rate(1)?), v.second.zero[0]),
        ))
    });
    claim(
        "avoid-five",
        "section 5",
        "Extraordinary vertices of valence five or higher should be avoided where valence three does as well.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "as a statement on the rates of one step it holds in both norms ({}); G^1/G^0 and Z_0^1/Z_0^0: {}",
            exceptions(&truths),
            list(values)
        ),
        scope,
    )
}

fn quadrilaterals(found: &[Valence], scope: &str) -> Claim {
    let truth = |v: &Valence| {
        let quads = Enclosure::exactly(v.second.zero[0].value()?.clone());
        Some(quads.compare(v.triangles.triangles.as_ref()?)? == Ordering::Less)
    };
    let truths: Vec<(u32, Option<bool>)> = found.iter().map(|v| (v.n, truth(v))).collect();
    let faster = ranges(truths.iter().filter(|t| t.1 == Some(true)).map(|t| t.0));
    let quarter = Rational::ratio(printed::QUARTER.0, printed::QUARTER.1);
    let regular = |n: u32, quads: bool| {
        let v = found.iter().find(|v| v.n == n)?;
        Some(match quads {
            true => v.second.zero[0].value()? == &quarter,
            false => v.triangles.exact.as_ref()? == &quarter,
        })
    };
    let equal = regular(4, true) == Some(true) && regular(6, false) == Some(true);
    let values = found.iter().filter_map(|v| {
        let triangles = v.triangles.triangles.as_ref()?.decimal(DIGITS);
        Some((v.n, format!("{} against {triangles}", v.second.zero[0])))
    });
    let witness = found.iter().find_map(|v| {
        Some(Counterexample {
            valence: v.n,
            net: texts(v.triangles.net.as_ref()?),
            what: format!(
                "Z_0^0 = 1 and Z_0^1 = {}; Loop's scheme has at most {} at this valence",
                v.second.zero[0],
                v.triangles.exact.as_ref()?
            ),
        })
    });
    let files = found
        .iter()
        .filter_map(|v| Some(v.triangles.certificate.as_ref()?.0.clone()));
    Claim {
        counterexample: witness,
        certificates: files.collect(),
        ..claim(
            "quads-faster",
            "section 5",
            "The second-order norm converges faster for quadrilateral than for triangular elements.",
            Verdict::of(all(truths.iter().map(|t| t.1))),
            format!(
                "{}one step, Catmull-Clark against Loop (mixed second differences): {}. Faster at N = {faster} only",
                match equal {
                    true => "regular elements (N = 4 against n = 6) have the same rate 1/4; ",
                    false => "",
                },
                list(values)
            ),
            scope,
        )
    }
}
