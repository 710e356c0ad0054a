//! Observation (1): the loosest bounds, the most fluctuation; and the variance of (4).

use super::{DIGITS, Maker, Name, entries, estimate, listed, tabulated};
use crate::paper::peters_wu::experiment::{Experiment, LOCAL, Row, TABULATED, deviation};
use crate::paper::peters_wu::printed;
use crate::paper::words::every;
use crate::paper::{Claim, Verdict};
use crate::predict::Estimator;

/// Models that a variance is taken over, at least.
const FEWEST: usize = 3;

/// Observation (1), first half: `tab-eigen` is never below the others.
fn loosest(experiment: &Experiment) -> (Option<bool>, String) {
    let (mut truths, mut less) = (Vec::new(), Vec::new());
    for (i, row, m) in entries(experiment, &tabulated(&[Estimator::TabEigen])) {
        let (model, Row::Estimate(_, j)) = (&experiment.models[i], row) else {
            continue;
        };
        for other in [Estimator::TabApprox, Estimator::TabInterp] {
            let other = Row::Estimate(other, j);
            let Some((a, b)) = model.at(row, m).zip(model.at(other, m)) else {
                continue;
            };
            let truth = b.at_most(a);
            if truth == Some(false) {
                less.push(format!(
                    "{} < {} of {} at m = {m}",
                    row.name(),
                    other.name(),
                    model.name
                ));
            }
            truths.push(truth);
        }
    }
    let found = match less.is_empty() {
        true => format!(
            "in none of {} comparisons is tab-eigen smaller",
            truths.len()
        ),
        false => format!(
            "smaller in {} of {}: {}",
            less.len(),
            truths.len(),
            listed(&less)
        ),
    };
    (every(truths), found)
}

/// Whether the variance of a row is at least (or, with `largest` false, at most) that of others, levels
/// and local steps alike if `alike`.
fn variances(
    experiment: &Experiment,
    row: Row,
    others: &[Row],
    largest: bool,
) -> Vec<(String, Option<bool>)> {
    let mut found = Vec::new();
    for m in 0..experiment.levels() {
        let Some(own) = experiment.variance(row, m) else {
            continue;
        };
        for &other in others.iter().filter(|&&other| other != row) {
            let Some(its) = experiment.variance(other, m) else {
                continue;
            };
            // Of one or two models a variance says nothing.
            let models = |row| experiment.ratios(row, m).len();
            if models(row).min(models(other)) < FEWEST {
                continue;
            }
            let truth = match largest {
                true => its.at_most(&own),
                false => own.at_most(&its),
            };
            let text = format!(
                "m = {m}: {} {}, {} {}",
                row.name(),
                own.decimal(DIGITS),
                other.name(),
                its.decimal(DIGITS)
            );
            found.push((text, truth));
        }
    }
    found
}

fn failing(found: &[(String, Option<bool>)]) -> String {
    let failed: Vec<String> = (found.iter())
        .filter(|(_, truth)| *truth == Some(false))
        .map(|(text, _)| text.clone())
        .collect();
    match failed.is_empty() {
        true => format!("so in all {} comparisons", found.len()),
        false => format!(
            "not so in {} of {}: {}",
            failed.len(),
            found.len(),
            listed(&failed)
        ),
    }
}

/// The model whose ratio of a row is farthest from the median, at each level; `None` where unclear.
fn farthest(experiment: &Experiment, row: Row) -> Vec<(usize, Option<String>)> {
    let mut found = Vec::new();
    for m in row.first_level()..experiment.levels() {
        let Some(middle) = experiment.median(row, m) else {
            continue;
        };
        let ratios = experiment.ratios(row, m);
        let away: Vec<_> = (ratios.iter())
            .map(|(name, ratio)| (name, deviation(ratio, &middle)))
            .collect();
        let top = away.iter().find(|(name, d)| {
            let others = away.iter().filter(|(other, _)| other != name);
            others.fold(true, |top, (_, o)| top && o.at_most(d) == Some(true))
        });
        found.push((m, top.map(|(name, _)| (**name).to_string())));
    }
    found
}

/// The claims.
pub(super) fn claims(experiment: &Experiment, make: Maker<'_>) -> Vec<Claim> {
    let mut claims = Vec::new();
    // (1)
    let (truth, found) = loosest(experiment);
    claims.push(make(
        Name {
            print: "observation-1-loosest-printed",
            redone: "observation-1-loosest-redone",
        },
        "section 5, (1)",
        "tab-eigen provides the loosest bounds.".into(),
        Verdict::of(truth),
        found,
    ));
    let mut fluctuation = Vec::new();
    for j in LOCAL {
        let others = [Estimator::TabApprox, Estimator::TabInterp].map(|e| estimate(e, j));
        fluctuation.extend(variances(
            experiment,
            estimate(Estimator::TabEigen, j),
            &others,
            true,
        ));
    }
    claims.push(make(
        Name {
            print: "observation-1-fluctuation-printed",
            redone: "observation-1-fluctuation-redone",
        },
        "section 5, (1)",
        "tab-eigen has the most fluctuation over different models: the largest variance.".into(),
        Verdict::of(every(fluctuation.iter().map(|f| f.1))),
        failing(&fluctuation),
    ));
    let star = printed::UNNECESSARY.1.0;
    let away: Vec<(usize, Option<String>)> = LOCAL
        .iter()
        .flat_map(|&j| farthest(experiment, estimate(Estimator::TabEigen, j)))
        .collect();
    let is_star = |name: &Option<String>| name.as_ref().map(|n| n.starts_with(star));
    let elsewhere: Vec<String> = (away.iter())
        .filter(|(_, name)| is_star(name) == Some(false))
        .filter_map(|(m, name)| Some(format!("{} at m = {m}", name.as_ref()?)))
        .collect();
    claims.push(make(
        Name { print: "observation-1-star-printed", redone: "observation-1-star-redone" },
        "section 5, (1)",
        "The valence-3 spikes of Star result in high deviation: its ratio is the one farthest from the median \
         (tab-eigen)."
            .into(),
        Verdict::of(every(away.iter().map(|(_, name)| is_star(name)))),
        match elsewhere.is_empty() {
            true => format!("at all {} levels and numbers of local steps", away.len()),
            false => format!("not so in {} of {}: {}", elsewhere.len(), away.len(), listed(&elsewhere)),
        },
    ));

    // (4)
    let others: Vec<Row> = tabulated(&TABULATED)
        .into_iter()
        .filter(|row| !matches!(row, Row::Estimate(Estimator::TabInterp, _)))
        .collect();
    let low = variances(
        experiment,
        estimate(Estimator::TabApprox, 2),
        &others,
        false,
    );
    claims.push(make(
        Name {
            print: "observation-4-variance-printed",
            redone: "observation-4-variance-redone",
        },
        "section 5, (4)",
        "The variance of tab-approx 2 is low: the lowest of tab-approx and tab-eigen.".into(),
        Verdict::of(every(low.iter().map(|f| f.1))),
        failing(&low),
    ));
    claims
}
