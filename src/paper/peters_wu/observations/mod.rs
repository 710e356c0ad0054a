//! Claims (ii) to (iv) and observations (1) to (4), judged by the numbers of an experiment: the printed
//! Table 1, or the one redone here.

mod fluctuation;
mod heuristic;
mod offsets;
mod predictions;
mod steps;

use super::experiment::{Experiment, LOCAL, Row, quotient};
use crate::paper::words::claim;
use crate::paper::{Claim, Enclosure, Verdict};
use crate::predict::Estimator;
use crate::scalar::Rational;
use num_traits::One;

/// Whose numbers are judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The printed table.
    Print,
    /// The table redone.
    Redone,
}

/// The names of the claims, printed and redone.
pub(super) struct Name {
    pub print: &'static str,
    pub redone: &'static str,
}

impl Source {
    fn name(self, name: &Name) -> &'static str {
        match self {
            Source::Print => name.print,
            Source::Redone => name.redone,
        }
    }
    fn scope(self, experiment: &Experiment) -> String {
        match self {
            Source::Print => "the printed numbers, each taken at its word".into(),
            Source::Redone => {
                let names: Vec<&str> = experiment.models.iter().map(|m| m.name.as_str()).collect();
                let last = experiment.levels().saturating_sub(1);
                format!("ours: {}; levels 0..{last}", names.join(", "))
            }
        }
    }
}

/// Digits of ratios.
const DIGITS: u32 = 2;

fn one() -> Enclosure {
    Enclosure::exactly(Rational::one())
}

/// All (model, row, level) with an entry of a row.
fn entries(experiment: &Experiment, rows: &[Row]) -> Vec<(usize, Row, usize)> {
    let mut found = Vec::new();
    for (i, model) in experiment.models.iter().enumerate() {
        for &row in rows {
            found.extend(
                (0..experiment.levels())
                    .filter(|&m| model.at(row, m).is_some())
                    .map(|m| (i, row, m)),
            );
        }
    }
    found
}

fn tabulated(estimators: &[Estimator]) -> Vec<Row> {
    let rows = |&e: &Estimator| LOCAL.map(|j| Row::Estimate(e, j));
    estimators.iter().flat_map(rows).collect()
}

/// `what of model at m = 2, ..`: at most so many.
fn listed(found: &[String]) -> String {
    const SHOWN: usize = 4;
    let shown = found[..found.len().min(SHOWN)].join(", ");
    match found.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// The range of the ratios `a / b` over all models and levels with both, local steps alike.
fn range_of(experiment: &Experiment, a: Estimator, b: Estimator) -> Option<[Enclosure; 2]> {
    let mut found: Vec<Enclosure> = Vec::new();
    for (i, row, m) in entries(experiment, &tabulated(&[a])) {
        let (model, Row::Estimate(_, j)) = (&experiment.models[i], row) else {
            continue;
        };
        let pair = model.at(row, m).zip(model.at(Row::Estimate(b, j), m));
        found.extend(pair.and_then(|(x, y)| quotient(x, y)));
    }
    hull(&found)
}

/// The least and the largest of some numbers.
fn hull(values: &[Enclosure]) -> Option<[Enclosure; 2]> {
    let least = |a: Enclosure, b: &Enclosure| {
        Enclosure::new(a.lo.min(b.lo.clone()), a.hi.min(b.hi.clone()))
    };
    let first = values.first()?.clone();
    let low = values.iter().fold(first.clone(), least);
    let high = values.iter().fold(first, |a, b| a.max(b));
    Some([low, high])
}

fn range_text(range: Option<[Enclosure; 2]>) -> String {
    range.map_or("none".into(), |[lo, hi]| {
        format!("{} to {}", lo.decimal(DIGITS), hi.decimal(DIGITS))
    })
}

fn estimate(estimator: Estimator, local: u32) -> Row {
    Row::Estimate(estimator, local)
}

/// Makes a claim: its names, its place, what is printed, the verdict, what was found.
type Maker<'a> = &'a dyn Fn(Name, &'static str, String, Verdict, String) -> Claim;

/// The claims.
pub fn claims(experiment: &Experiment, source: Source) -> Vec<Claim> {
    let scope = source.scope(experiment);
    let make = |name: Name, place, statement: String, verdict, found: String| {
        claim(
            source.name(&name),
            place,
            statement,
            verdict,
            found,
            scope.clone(),
        )
    };
    let parts = [
        predictions::claims,
        fluctuation::claims,
        heuristic::claims,
        offsets::claims,
        steps::claims,
    ];
    parts
        .iter()
        .flat_map(|part| part(experiment, &make))
        .collect()
}
