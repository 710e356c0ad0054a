//! Appendix C: the proof of Lemma 5, (45)..(52).

use super::appendix_a::on_bound;
use super::first_order;
use super::functional::Functional;
use super::norm::{Sup, number};
use super::printed;
use super::setting::{LEVELS, Setting, difference, phi};
use super::violation::{Named, Violation, texts};
use super::wording::{grouped, of_paper};
use crate::paper::words::{by_verdict, claim, gravest, ranges};
use crate::paper::{Claim, Counterexample, Table, Verdict};
use crate::scalar::{Field, Rational};
use crate::scheme::IntegerRow;

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
struct Examined {
    first: bool,
    second: bool,
    corrected: Option<bool>,
    /// Over the norms that the estimate names.
    sup: Sup,
    /// A unit net at which the regrouping is not the difference: label, both values.
    witness: Option<(usize, Rational, Rational)>,
}

/// What is computed for a valence.
#[derive(Clone, Debug)]
pub struct Facts {
    /// The valence.
    pub n: u32,
    estimates: Vec<Examined>,
    /// `max |V_1' - V_j'| / G_0`.
    eq_45: Sup,
    /// `max |V_4' - V_j'| / max(G_0, G_3)`, and j.
    eq_49: (usize, Sup),
    /// `max |V_5' - V_j'| / max(G_1, G_2, G_3)`, and j.
    eq_52: (usize, Sup),
    /// `max |V_5' - V_j'| / G^0`, and j.
    eq_52_whole: (usize, Sup),
    /// Certificates of what is violated.
    pub certificates: Vec<Named>,
}

fn ratio((p, q): (i64, i64)) -> Rational {
    Rational::ratio(p, q)
}

impl Facts {
    /// Of a valence.
    pub fn of(setting: &Setting) -> Self {
        let n = setting.n;
        // The largest |centre' - V_j'| over some norms, and j.
        let about = |i: usize, norm: &super::norm::Norm| {
            let (centre, members) = phi(n, i);
            let others: Vec<usize> = members.into_iter().filter(|&j| j != centre).collect();
            let rows: Vec<IntegerRow> = others.iter().map(|&j| difference(centre, j)).collect();
            let (at, sup) = norm.largest(&setting.rows_of(&rows, 1));
            (others[at], sup)
        };
        let mut facts = Facts {
            n,
            estimates: printed::APPENDIX_C
                .iter()
                .map(|e| examine(setting, e))
                .collect(),
            eq_45: about(0, &setting.norm(&[0])).1,
            eq_49: about(3, &setting.norm(&[0, 3])),
            eq_52: about(2, &setting.norm(&[1, 2, 3])),
            eq_52_whole: about(2, &setting.g),
            certificates: Vec::new(),
        };
        let violated = [
            ("eq-49", 3, &facts.eq_49, printed::EQ_49, vec![0, 3]),
            ("eq-52", 2, &facts.eq_52, printed::EQ_52, vec![1, 2, 3]),
            (
                "eq-52-second",
                2,
                &facts.eq_52_whole,
                printed::EQ_52,
                vec![0, 1, 2, 3],
            ),
        ];
        let certificates =
            violated
                .into_iter()
                .filter_map(|(claim, i, (j, sup), factor, which)| {
                    let factor = ratio(factor);
                    if printed::rate(n).is_none() || sup.at_most(&factor) != Some(false) {
                        return None;
                    }
                    let left = Functional::of_row(&difference(phi(n, i).0, *j), setting.size());
                    let right: Vec<IntegerRow> = which
                        .iter()
                        .flat_map(|&j| setting.first[j].clone())
                        .collect();
                    let violation = Violation {
                        claim,
                        n,
                        left: ("0", &left),
                        factor: &factor,
                        right: &right,
                        net: sup.net()?,
                    };
                    Some(violation.certificate())
                });
        facts.certificates = certificates.collect();
        facts
    }

    fn file(&self, id: &str) -> Option<String> {
        let start = format!("cheng-yong-{id}-n");
        let found = self
            .certificates
            .iter()
            .find(|(file, _)| file.starts_with(&start));
        found.map(|(file, _)| file.clone())
    }
}

fn examine(setting: &Setting, estimate: &printed::Estimate) -> Examined {
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
fn name(norms: &[usize]) -> String {
    let names: Vec<String> = norms.iter().map(|j| format!("G_{j}")).collect();
    match names.len() {
        1 => names.concat(),
        _ => format!("max({})", names.join(", ")),
    }
}

/// The claims.
pub fn claims(found: &[&Facts], rates: &[&first_order::Facts], scope: &str) -> Vec<Claim> {
    let mut claims = vec![eq_45(found, scope)];
    let estimates = printed::APPENDIX_C.iter().enumerate();
    claims.extend(estimates.map(|(at, e)| estimate(found, at, e, scope)));
    claims.extend([
        eq_49(found, scope),
        eq_52(found, scope),
        eq_52_second(found, rates, scope),
    ]);
    claims
}

fn eq_45(found: &[&Facts], scope: &str) -> Claim {
    let verdicts: Vec<(u32, Verdict)> = of_paper(found.iter().map(|f| f.n))
        .filter_map(|n| found.iter().find(|f| f.n == n))
        .map(|f| (f.n, on_bound(&f.eq_45, &printed::at(printed::RATE, f.n))))
        .collect();
    claim(
        "eq-45",
        "(45)",
        "G_0^(i+1) <= (3/4 + 7/(4N) - 13/(2N²)) G_0^i, N = 3 or N >= 5. ((43) and (44), for the face and the edge \
         points, are missing in the text at hand.)",
        gravest(&verdicts),
        format!(
            "{}; the suprema over G_0: {}",
            by_verdict(&verdicts),
            grouped(found.iter().map(|f| (f.n, f.eq_45.to_string())))
        ),
        scope,
    )
}

fn estimate(found: &[&Facts], at: usize, estimate: &printed::Estimate, scope: &str) -> Claim {
    let bound = ratio(estimate.factor);
    let asserted: Vec<&&Facts> = found.iter().filter(|f| f.n != 4).collect();
    let of = |f: &Facts| f.estimates[at].clone();
    let verdict = |f: &Facts| {
        let e = of(f);
        let on_bound = on_bound(&e.sup, &bound);
        match e.first && e.second {
            true => on_bound,
            false => on_bound.max(Verdict::Misprint),
        }
    };
    let verdicts: Vec<(u32, Verdict)> = asserted.iter().map(|f| (f.n, verdict(f))).collect();
    let firsts = asserted.iter().all(|f| of(f).first);
    let broken = ranges(asserted.iter().filter(|f| !of(f).second).map(|f| f.n));
    let first = match (estimate.first, firsts) {
        (None, _) => "",
        (Some(_), true) => "The first rewriting is an identity. ",
        (Some(_), false) => "The first rewriting is no identity. ",
    };
    let second = match &*broken {
        "none" => "The regrouping is an identity".to_string(),
        _ => format!("The regrouping, as scanned, is no identity (N = {broken})"),
    };
    let bounded = asserted
        .iter()
        .all(|f| of(f).sup.at_most(&bound) == Some(true));
    let witness = asserted.iter().find_map(|f| {
        let (label, left, right) = of(f).witness?;
        let size = 2 * f.n as usize + 8;
        let net = Functional::point(size, label);
        Some(Counterexample {
            valence: f.n,
            net: texts(net.coefficients()),
            what: format!(
                "{} (level i + 1, up to its sign) is {left}, the regrouping {right}",
                estimate.left
            ),
        })
    });
    let corrected = CORRECTED.iter().find(|(id, ..)| *id == estimate.id);
    let method = corrected.map(|(_, _, change)| {
        let right = asserted.iter().all(|f| of(f).corrected == Some(true));
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
                grouped(asserted.iter().map(|f| (f.n, of(f).sup.to_string())))
            ),
            scope,
        )
    }
}

/// A bound on all differences about a centre, of which some are "similar".
struct About<'a> {
    id: &'static str,
    place: &'static str,
    statement: &'a str,
    factor: (i64, i64),
    centre: usize,
    sup: fn(&Facts) -> &(usize, Sup),
    remark: String,
}

fn about(found: &[&Facts], about: &About<'_>, scope: &str) -> Claim {
    let bound = ratio(about.factor);
    let asserted: Vec<&&Facts> = found.iter().filter(|f| f.n != 4).collect();
    let verdicts: Vec<(u32, Verdict)> = asserted
        .iter()
        .map(|f| (f.n, on_bound(&(about.sup)(f).1, &bound)))
        .collect();
    let witness = asserted.iter().find_map(|f| {
        let (label, sup) = (about.sup)(f);
        if sup.at_most(&bound) != Some(false) {
            return None;
        }
        let what = format!(
            "|V_{}^1 - V_{label}^1| is {}, the right side {}",
            about.centre,
            match sup.value() {
                Some(value) => number(value),
                None => "not 0".into(),
            },
            match sup.value() {
                Some(_) => number(&bound),
                None => "0".into(),
            }
        );
        Some(Counterexample {
            valence: f.n,
            net: texts(sup.net()?),
            what,
        })
    });
    let suprema = asserted.iter().map(|f| {
        let (label, sup) = (about.sup)(f);
        (f.n, format!("{sup} (j = {label})"))
    });
    Claim {
        counterexample: witness,
        certificates: asserted.iter().filter_map(|f| f.file(about.id)).collect(),
        ..claim(
            about.id,
            about.place,
            about.statement,
            gravest(&verdicts),
            format!(
                "{}; suprema of |V_{}^(i+1) - V_j^(i+1)|: {}. {}",
                by_verdict(&verdicts),
                about.centre,
                grouped(suprema),
                about.remark
            ),
            scope,
        )
    }
}

fn eq_49(found: &[&Facts], scope: &str) -> Claim {
    let statement = "G_3^(i+1) <= 9/16 max(G_0^i, G_3^i), the other cases being similar to (46)..(48); N = 3 or N >= 5. \
                     (The second part, 9/16 r^i max(G_0^0, G_3^0), is the same at i = 0.)";
    about(
        found,
        &About {
            id: "eq-49",
            place: "(49)",
            statement,
            factor: printed::EQ_49,
            centre: 4,
            sup: |f| &f.eq_49,
            remark: "V_4 - V_1 is not similar: all of the ring moves V_1, and (45) bounds it only by r G_0. Lemma 5 \
                     survives, as its rate r is above these suprema"
                .into(),
        },
        scope,
    )
}

fn eq_52(found: &[&Facts], scope: &str) -> Claim {
    let statement = "G_2^(i+1) <= 3/4 max(G_1^i, G_2^i, G_3^i), the other cases being similar to (50) and (51).";
    about(
        found,
        &About {
            id: "eq-52",
            place: "(52)",
            statement,
            factor: printed::EQ_52,
            centre: 5,
            sup: |f| &f.eq_52,
            remark: "V_5 - V_1 is not similar: G_1, G_2 and G_3 do not see the far side of the ring, which moves V_1. \
                     Lemma 5 survives: see eq-52-second"
                .into(),
        },
        scope,
    )
}

fn eq_52_second(found: &[&Facts], rates: &[&first_order::Facts], scope: &str) -> Claim {
    let statement =
        "G_2^(i+1) <= (3/4)^(i+1) G^0 at N = 3, 3/4 r^i G^0 for N >= 5 (i = 0 stands for all).";
    // The levels above the first: 3/4 r^(k-1).
    let later = rates.iter().filter_map(|f| {
        let rate = printed::rate(f.n)?;
        let mut bound = ratio(printed::EQ_52);
        let held = (2..=LEVELS).all(|k| {
            bound *= &rate;
            f.rates[k - 1][2].at_most(&bound) == Some(true)
        });
        Some((f.n, held))
    });
    let later: Vec<u32> = later.filter(|(_, held)| *held).map(|(n, _)| n).collect();
    about(
        found,
        &About {
            id: "eq-52-second",
            place: "(52)",
            statement,
            factor: printed::EQ_52,
            centre: 5,
            sup: |f| &f.eq_52_whole,
            remark: format!(
                "At i = 1 .. {} it holds for N = {}. Lemma 5 survives: G_2^1 <= r G^0 is true of all",
                LEVELS - 1,
                ranges(later)
            ),
        },
        scope,
    )
}

/// The displayed inequalities, one by one.
pub fn table(found: &[&Facts], claims: &[Claim]) -> Table {
    let verdict = |id: &str| {
        let claim = claims.iter().find(|claim| claim.id == id);
        claim.map_or("?".into(), |claim| claim.verdict.to_string())
    };
    let files = |id: &str| {
        let files: Vec<String> = found.iter().filter_map(|f| f.file(id)).collect();
        match files.is_empty() {
            true => "-".into(),
            false => files.join(" "),
        }
    };
    let asserted = || found.iter().filter(|f| f.n != 4);
    let mut rows: Vec<Vec<String>> = printed::APPENDIX_C
        .iter()
        .enumerate()
        .map(|(at, e)| {
            vec![
                e.place.into(),
                e.left.into(),
                name(e.norms),
                ratio(e.factor).to_string(),
                grouped(asserted().map(|f| (f.n, f.estimates[at].sup.to_string()))),
                verdict(e.id),
                files(e.id),
            ]
        })
        .collect();
    let about: [(&str, &str, &str, &[usize], (i64, i64), fn(&Facts) -> &Sup); 3] = [
        ("eq-49", "(49)", "V4 - Vj", &[0, 3], printed::EQ_49, |f| {
            &f.eq_49.1
        }),
        (
            "eq-52",
            "(52)",
            "V5 - Vj",
            &[1, 2, 3],
            printed::EQ_52,
            |f| &f.eq_52.1,
        ),
        (
            "eq-52-second",
            "(52)",
            "V5 - Vj",
            &[0, 1, 2, 3],
            printed::EQ_52,
            |f| &f.eq_52_whole.1,
        ),
    ];
    rows.extend(about.map(|(id, place, what, norms, factor, sup)| {
        vec![
            place.into(),
            what.into(),
            name(norms),
            ratio(factor).to_string(),
            grouped(asserted().map(|f| (f.n, sup(f).to_string()))),
            verdict(id),
            files(id),
        ]
    }));
    Table {
        id: "appendix-c",
        title: "Appendix C: differences of level i + 1 over norms of level i".into(),
        heads: vec![
            "equation",
            "difference",
            "over",
            "printed",
            "supremum",
            "verdict",
            "certificates",
        ],
        rows,
        notes: Vec::new(),
    }
}
