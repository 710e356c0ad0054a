//! Table 3: what the depth formulas give, and what is needed.

use std::cmp::Ordering;

use num_traits::Zero;

use super::control::Reading;
use super::depth::steps;
use super::needed::Depth;
use super::valence::Valence;
use super::{Findings, printed};
use crate::paper::words::{by_verdict, claim, failures, gravest, list, ranges};
use crate::paper::{Claim, Enclosure, Table, Verdict};
use crate::scalar::{Field, Rational, Ring};

/// The values of λ that are tried.
pub const LAMBDAS: std::ops::RangeInclusive<usize> = 1..=3;

/// A row of Table 3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mesh {
    /// S to the control mesh: (16).
    Control,
    /// S to the limit mesh: (14).
    Limit,
}

impl Mesh {
    const BOTH: [Mesh; 2] = [Mesh::Control, Mesh::Limit];

    fn name(self) -> &'static str {
        match self {
            Mesh::Control => "control",
            Mesh::Limit => "limit",
        }
    }

    fn printed(self, n: u32) -> Option<i64> {
        let place = printed::VALENCES.iter().position(|&valence| valence == n)?;
        Some(match self {
            Mesh::Control => printed::TABLE_3_CONTROL[place],
            Mesh::Limit => printed::TABLE_3_LIMIT[place],
        })
    }

    fn depth(self, v: &Valence) -> Option<&Depth> {
        match self {
            Mesh::Control => v.depths[0].as_ref(),
            Mesh::Limit => v.depths[1].as_ref(),
        }
    }
}

impl Valence {
    /// max(β(n), 1/3).
    pub fn factor(&self) -> Option<Enclosure> {
        Some(self.beta()?.max(&Enclosure::exactly(Field::ratio(1, 3))))
    }

    /// (16) or (14) for M / ε; (15) read with n b.
    pub fn by_formula(&self, mesh: Mesh, lambda: usize, ratio: &Enclosure) -> Option<i64> {
        let c = match mesh {
            Mesh::Control => self.by_15(Reading::RingWeight, lambda)?,
            Mesh::Limit => self.factor()?,
        };
        let rates: Vec<Enclosure> = (0..=lambda).map(|k| self.rate(k)).collect();
        steps(&rates, &c, ratio)
    }
}

/// M / ε of Table 3.
pub fn ratio() -> Enclosure {
    Enclosure::exactly(<Rational as Ring>::from_integer(printed::TABLE_3_RATIO))
}

/// The printed depth against the sharp one.
fn judge(v: &Valence, mesh: Mesh, printed: i64) -> Verdict {
    let Some(depth) = mesh.depth(v) else {
        return Verdict::Undecided;
    };
    match (depth.depth as i64).cmp(&printed) {
        Ordering::Equal => Verdict::Sharp,
        Ordering::Less => Verdict::Loose,
        Ordering::Greater => Verdict::Refuted,
    }
}

/// Table 3.
pub fn table(found: &Findings) -> Table {
    let mut rows = Vec::new();
    for mesh in Mesh::BOTH {
        for v in &found.asked {
            let Some(printed) = mesh.printed(v.n) else {
                continue;
            };
            let by = |lambda| {
                let depth = v.by_formula(mesh, lambda, &ratio());
                depth.map_or("?".into(), |k| k.to_string())
            };
            let depth = mesh.depth(v);
            rows.push(vec![
                mesh.name().into(),
                v.n.to_string(),
                printed.to_string(),
                by(1),
                by(2),
                by(3),
                depth.map_or("?".into(), |d| d.depth.to_string()),
                depth.map_or("?", |_| "impossible").into(),
                judge(v, mesh, printed).to_string(),
                depth.map_or("-".into(), |d| d.files.join(" ")),
            ]);
        }
    }
    Table {
        id: "table-3",
        title: format!("Table 3: subdivision depths for M / ε = {}", printed::TABLE_3_RATIO),
        heads: vec![
            "mesh", "n", "printed", "λ = 1", "λ = 2", "λ = 3", "sharp", "fewer steps", "verdict",
            "certificates",
        ],
        rows,
        notes: vec![
            "λ = 1, 2, 3: (16) with C_λ read with n b, and (14), redone exactly. Sharp: the least k with \
             C_k <= ε / M or B_k <= ε / M, fewer steps being proved impossible: a net that needs so many is \
             in the second certificate."
                .into(),
        ],
    }
}

/// The claims on Table 3.
pub fn claims(found: &Findings) -> Vec<Claim> {
    let mut claims = Mesh::BOTH.map(|mesh| table_3(found, mesh)).to_vec();
    claims.push(like_for_like(found));
    claims.push(improvement(found));
    claims
}

/// The λ for which a formula gives a printed row.
fn matching(found: &Findings, mesh: Mesh) -> Vec<usize> {
    let matches = |lambda: &usize| {
        let mut entries = found
            .asked
            .iter()
            .filter_map(|v| Some((v, mesh.printed(v.n)?)));
        entries.all(|(v, printed)| v.by_formula(mesh, *lambda, &ratio()) == Some(printed))
    };
    LAMBDAS.filter(matches).collect()
}

fn lambdas(list: &[usize]) -> String {
    match list {
        [] => "no λ".into(),
        _ => {
            let texts: Vec<String> = list.iter().map(usize::to_string).collect();
            format!("λ = {}", texts.join(", "))
        }
    }
}

fn table_3(found: &Findings, mesh: Mesh) -> Claim {
    let entries = found
        .asked
        .iter()
        .filter_map(|v| Some((v, mesh.printed(v.n)?)));
    let entries: Vec<(&Valence, i64)> = entries.collect();
    let verdicts: Vec<_> = entries
        .iter()
        .map(|(v, p)| (v.n, judge(v, mesh, *p)))
        .collect();
    let best = entries.iter().map(|(v, _)| {
        let depth = mesh.depth(v);
        (v.n, depth.map_or("?".into(), |d| d.depth.to_string()))
    });
    let (id, formula) = match mesh {
        Mesh::Control => ("table-3-control", "(16)"),
        Mesh::Limit => ("table-3-limit", "(14)"),
    };
    let files = entries.iter().filter_map(|(v, _)| mesh.depth(v));
    Claim {
        method: Some(format!(
            "the row is {formula} with {}",
            lambdas(&matching(found, mesh))
        )),
        certificates: files.flat_map(|depth| depth.files.clone()).collect(),
        ..claim(
            id,
            "Table 3",
            format!(
                "For the {} mesh the depths are those of Table 3.",
                mesh.name()
            ),
            gravest(&verdicts),
            format!("{}; depths needed: {}", by_verdict(&verdicts), list(best)),
            found.scope_of(verdicts.iter().map(|(n, _)| *n)),
        )
    }
}

fn like_for_like(found: &Findings) -> Claim {
    let [control, limit] = Mesh::BOTH.map(|mesh| matching(found, mesh));
    let common = control.iter().any(|lambda| limit.contains(lambda));
    let verdict = match (common, control.is_empty() || limit.is_empty()) {
        (true, _) => Verdict::True,
        (false, false) => Verdict::Misprint,
        (false, true) => Verdict::Undecided,
    };
    let row = |mesh, lambda| {
        let values = found
            .asked
            .iter()
            .filter(|v| Mesh::Control.printed(v.n).is_some());
        let values: Vec<String> = values
            .map(|v| {
                let depth = v.by_formula(mesh, lambda, &ratio());
                depth.map_or("?".into(), |k| k.to_string())
            })
            .collect();
        values.join(" ")
    };
    let methods = LAMBDAS.map(|lambda| {
        let (control, limit) = (row(Mesh::Control, lambda), row(Mesh::Limit, lambda));
        format!("λ = {lambda}: control {control}, limit {limit}")
    });
    Claim {
        method: Some(methods.collect::<Vec<_>>().join("; ")),
        ..claim(
            "table-3-like-for-like",
            "Table 3",
            "The two rows of Table 3 compare the two meshes (by the same formula, one λ).",
            verdict,
            format!(
                "the control row is that of {}, the limit row that of {}",
                lambdas(&control),
                lambdas(&limit)
            ),
            found.scope_of(
                found
                    .asked
                    .iter()
                    .filter_map(|v| Mesh::Limit.printed(v.n).map(|_| v.n)),
            ),
        )
    }
}

/// The saving (a - b) / a as a fraction.
fn saving(control: i64, limit: i64) -> Rational {
    match control {
        0 => Rational::zero(),
        _ => Rational::ratio(control - limit, control),
    }
}

fn improvement(found: &Findings) -> Claim {
    let needed = <Rational as Field>::ratio(printed::IMPROVEMENT_PERCENT, 100);
    let entries = found
        .asked
        .iter()
        .filter_map(|v| Some((v, Mesh::Control.printed(v.n)?, Mesh::Limit.printed(v.n)?)));
    let entries: Vec<(&Valence, i64, i64)> = entries.collect();
    let as_printed = entries
        .iter()
        .map(|&(v, c, l)| (v.n, Some(saving(c, l) >= needed)));
    let as_printed: Vec<(u32, Option<bool>)> = as_printed.collect();
    let reached = as_printed.iter().filter(|(_, t)| *t == Some(true)).count();
    let percent = |s: Rational| {
        let hundred = <Rational as Ring>::from_integer(100);
        format!(
            "{} %",
            Enclosure::exactly(s.max(Rational::zero()) * hundred).decimal(1)
        )
    };
    let printed = entries
        .iter()
        .map(|&(v, c, l)| (v.n, percent(saving(c, l))));
    let like = entries.iter().filter_map(|(v, ..)| {
        let by = |mesh| v.by_formula(mesh, printed::TABLE_2_LAMBDA, &ratio());
        Some((v.n, percent(saving(by(Mesh::Control)?, by(Mesh::Limit)?))))
    });
    let sharp = entries.iter().map(|(v, ..)| {
        let saved = match &v.depths {
            [Some(control), Some(limit)] => (control.depth as i64 - limit.depth as i64).to_string(),
            _ => "?".into(),
        };
        (v.n, saved)
    });
    claim(
        "improvement",
        "section 6",
        format!(
            "The limit mesh has a {} % improvement over the control mesh in most of the cases.",
            printed::IMPROVEMENT_PERCENT
        ),
        match entries.is_empty() {
            true => Verdict::Undecided,
            false => Verdict::of(Some(2 * reached > entries.len())),
        },
        format!(
            "reached in {reached} of {} cases as printed (not at n = {}): {}; like for like, λ = {}: {}; \
             steps saved with the sharp constants: {}",
            entries.len(),
            ranges(failures(&as_printed)),
            list(printed),
            printed::TABLE_2_LAMBDA,
            list(like),
            list(sharp)
        ),
        found.scope_of(entries.iter().map(|(v, ..)| v.n)),
    )
}
