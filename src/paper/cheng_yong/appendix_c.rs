//! Appendix C: the proof of Lemma 5, (45), (49) and (52); the displayed estimates are in `estimates.rs`.

use super::appendix_a::on_bound;
use super::estimates::{self, name};
use super::first_order;
use super::functional::Functional;
use super::norm::{Norm, Sup, number};
use super::printed;
use super::setting::{LEVELS, Setting, difference, phi};
use super::violation::{Named, Violation, texts};
use super::wording::{grouped, scope};
use crate::paper::words::{by_verdict, claim, gravest, ranges};
use crate::paper::{Claim, Counterexample, Table, Verdict};
use crate::scalar::{Field, Rational};
use crate::scheme::IntegerRow;

/// An inequality on all differences about a centre, of which the paper shows some and calls the others similar.
struct Inequality {
    id: &'static str,
    place: &'static str,
    statement: &'static str,
    /// The set Φ_i whose centre it is.
    set: usize,
    /// The norms of the right side.
    norms: &'static [usize],
    factor: (i64, i64),
    /// Why it fails, where it does.
    why: &'static str,
}

const INEQUALITIES: [Inequality; 3] = [
    Inequality {
        id: "eq-49",
        place: "(49)",
        statement: "G_3^(i+1) <= 9/16 max(G_0^i, G_3^i), the other cases being similar to (46)..(48); N = 3 or N >= 5. \
                    (The second part, 9/16 r^i max(G_0^0, G_3^0), is the same at i = 0.)",
        set: 3,
        norms: &[0, 3],
        factor: printed::EQ_49,
        why: "V_4 - V_1 is not similar: the whole ring moves V_1, and (45) bounds it only by r G_0",
    },
    Inequality {
        id: "eq-52",
        place: "(52)",
        statement: "G_2^(i+1) <= 3/4 max(G_1^i, G_2^i, G_3^i), the other cases being similar to (50) and (51).",
        set: 2,
        norms: &[1, 2, 3],
        factor: printed::EQ_52,
        why: "V_5 - V_1 is not similar: G_1, G_2, G_3 do not see the far side of the ring, which moves V_1",
    },
    Inequality {
        id: "eq-52-second",
        place: "(52)",
        statement: "G_2^(i+1) <= (3/4)^(i+1) G^0 at N = 3, 3/4 r^i G^0 for N >= 5; here i = 0.",
        set: 2,
        norms: &[0, 1, 2, 3],
        factor: printed::EQ_52,
        why: "V_5 - V_1 again",
    },
];

impl Inequality {
    fn bound(&self) -> Rational {
        Rational::ratio(self.factor.0, self.factor.1)
    }

    /// The certificate that it is false, if it is.
    fn violation(&self, setting: &Setting, (j, sup): &(usize, Sup)) -> Option<Named> {
        let factor = self.bound();
        if printed::rate(setting.n).is_none() || sup.at_most(&factor) != Some(false) {
            return None;
        }
        let row = difference(phi(setting.n, self.set).0, *j);
        let right = self.norms.iter().flat_map(|&i| setting.first[i].clone());
        let violation = Violation {
            claim: self.id,
            n: setting.n,
            left: ("0", &Functional::of_row(&row, setting.size())),
            factor: &factor,
            right: &right.collect::<Vec<IntegerRow>>(),
            net: sup.net()?,
        };
        Some(violation.certificate())
    }
}

/// What is computed for a valence.
#[derive(Clone, Debug)]
pub struct Facts {
    /// The valence.
    pub n: u32,
    estimates: Vec<estimates::Examined>,
    /// `max |V_1' - V_j'| / G_0`.
    eq_45: Sup,
    /// For each of [`INEQUALITIES`] the largest difference over its norms: the label of the other point, the supremum.
    largest: Vec<(usize, Sup)>,
    /// For each the certificate that it is false.
    violations: Vec<Option<Named>>,
}

/// The largest of the level-1 differences about the centre of Φ_i, and its other point.
fn about(setting: &Setting, i: usize, norm: &Norm) -> (usize, Sup) {
    let (centre, members) = phi(setting.n, i);
    let others: Vec<usize> = members.into_iter().filter(|&j| j != centre).collect();
    let rows: Vec<IntegerRow> = others.iter().map(|&j| difference(centre, j)).collect();
    let (at, sup) = norm.largest(&setting.rows_of(&rows, 1));
    (others[at], sup)
}

impl Facts {
    /// Of a valence.
    pub fn of(setting: &Setting) -> Self {
        let inequalities = INEQUALITIES.iter();
        let largest: Vec<(usize, Sup)> = inequalities
            .map(|i| about(setting, i.set, &setting.norm(i.norms)))
            .collect();
        let violations = INEQUALITIES.iter().zip(&largest);
        let estimates = printed::APPENDIX_C.iter();
        Facts {
            n: setting.n,
            estimates: estimates.map(|e| estimates::examine(setting, e)).collect(),
            eq_45: about(setting, 0, &setting.norm(&[0])).1,
            violations: violations
                .map(|(i, sup)| i.violation(setting, sup))
                .collect(),
            largest,
        }
    }

    /// The certificates of what is violated.
    pub fn certificates(&self) -> impl Iterator<Item = &Named> {
        self.violations.iter().flatten()
    }
}

/// The valences about which the appendix says something: all but 4.
fn asserted<'a>(found: &'a [&Facts]) -> impl Iterator<Item = &'a Facts> {
    found.iter().copied().filter(|f| f.n != 4)
}

/// The claims.
pub fn claims(found: &[&Facts], rates: &[&first_order::Facts]) -> Vec<Claim> {
    let mut claims = vec![eq_45(found)];
    claims.extend(printed::APPENDIX_C.iter().enumerate().map(|(at, e)| {
        let asserted = asserted(found).map(|f| (f.n, &f.estimates[at]));
        estimates::claim_on(&asserted.collect::<Vec<_>>(), e)
    }));
    let survival = first_order::survival(rates);
    let inequalities = INEQUALITIES.iter().enumerate();
    claims.extend(inequalities.map(|(at, i)| {
        let later = match i.id {
            "eq-52-second" => later_levels(rates),
            _ => String::new(),
        };
        inequality(found, at, i, &format!("{later}{survival}"))
    }));
    claims
}

fn eq_45(found: &[&Facts]) -> Claim {
    let verdicts: Vec<(u32, Verdict)> = asserted(found)
        .map(|f| (f.n, on_bound(&f.eq_45, &printed::at(printed::RATE, f.n))))
        .collect();
    claim(
        "eq-45",
        "(45)",
        "G_0^(i+1) <= (3/4 + 7/(4N) - 13/(2N²)) G_0^i, N = 3 or N >= 5. ((43) and (44), of which the other cases are said \
         to be copies, are missing in the text at hand.)",
        gravest(&verdicts),
        format!(
            "{}; the suprema over G_0: {}",
            by_verdict(&verdicts),
            grouped(asserted(found).map(|f| (f.n, f.eq_45.to_string())))
        ),
        scope(asserted(found).map(|f| f.n)),
    )
}

/// At which valences the second part of (52) holds for the levels above the first: 3/4 r^(k-1).
fn later_levels(rates: &[&first_order::Facts]) -> String {
    let held = |f: &&&first_order::Facts| {
        let Some(rate) = printed::rate(f.n) else {
            return false;
        };
        let mut bound = Rational::ratio(printed::EQ_52.0, printed::EQ_52.1);
        (2..=LEVELS).all(|k| {
            bound *= &rate;
            f.rates[k - 1][2].at_most(&bound) == Some(true)
        })
    };
    let held = ranges(rates.iter().filter(held).map(|f| f.n));
    format!("For i = 1 .. {} it holds at N = {held}. ", LEVELS - 1)
}

fn inequality(found: &[&Facts], at: usize, inequality: &Inequality, remark: &str) -> Claim {
    let bound = inequality.bound();
    let verdicts: Vec<(u32, Verdict)> = asserted(found)
        .map(|f| (f.n, on_bound(&f.largest[at].1, &bound)))
        .collect();
    let centre = phi(REPRESENTATIVE, inequality.set).0;
    let witness = asserted(found).find_map(|f| {
        let (label, sup) = &f.largest[at];
        f.violations[at].as_ref()?;
        let (left, right) = match sup.value() {
            Some(value) => (number(value), number(&bound)),
            None => ("not 0".into(), "0".into()),
        };
        Some(Counterexample {
            valence: f.n,
            net: texts(sup.net()?),
            what: format!("|V_{centre}^1 - V_{label}^1| is {left}, the right side {right}"),
        })
    });
    let suprema = asserted(found).map(|f| {
        let (label, sup) = &f.largest[at];
        (f.n, format!("{sup} (j = {label})"))
    });
    let why = match witness {
        Some(_) => format!("{}. ", inequality.why),
        None => String::new(),
    };
    Claim {
        counterexample: witness,
        certificates: asserted(found).filter_map(|f| file(f, at)).collect(),
        ..claim(
            inequality.id,
            inequality.place,
            inequality.statement,
            gravest(&verdicts),
            format!(
                "{}; suprema of |V_{centre}^(i+1) - V_j^(i+1)|: {}. {why}{remark}",
                by_verdict(&verdicts),
                grouped(suprema),
            ),
            scope(asserted(found).map(|f| f.n)),
        )
    }
}

/// Centres have the same labels at every valence.
const REPRESENTATIVE: u32 = 5;

fn file(f: &Facts, at: usize) -> Option<String> {
    Some(f.violations[at].as_ref()?.0.clone())
}

/// The displayed inequalities, one by one.
pub fn table(found: &[&Facts], claims: &[Claim]) -> Table {
    let verdict = |id: &str| {
        let claim = claims.iter().find(|claim| claim.id == id);
        claim.map_or("?".into(), |claim| claim.verdict.to_string())
    };
    let row = |id,
               place: &str,
               what: String,
               norms,
               factor: (i64, i64),
               suprema,
               file: Option<String>| {
        let [p, q] = [factor.0, factor.1];
        let bound = Rational::ratio(p, q).to_string();
        let file = file.unwrap_or_else(|| "-".into());
        vec![
            place.into(),
            what,
            name(norms),
            bound,
            suprema,
            verdict(id),
            file,
        ]
    };
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (at, e) in printed::APPENDIX_C.iter().enumerate() {
        let suprema = asserted(found).map(|f| (f.n, f.estimates[at].sup.to_string()));
        rows.push(row(
            e.id,
            e.place,
            e.left.into(),
            e.norms,
            e.factor,
            grouped(suprema),
            None,
        ));
    }
    for (at, i) in INEQUALITIES.iter().enumerate() {
        let suprema = asserted(found).map(|f| (f.n, f.largest[at].1.to_string()));
        let what = format!("V{} - Vj", phi(REPRESENTATIVE, i.set).0);
        let file = asserted(found).find_map(|f| file(f, at));
        rows.push(row(
            i.id,
            i.place,
            what,
            i.norms,
            i.factor,
            grouped(suprema),
            file,
        ));
    }
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
            "certificate",
        ],
        rows,
        notes: vec!["The first certificate; the claims name all.".into()],
    }
}
