//! Whether estimates are bounds, and how they compare with the distance: the abstract, (iii), (iv).

use std::cmp::Ordering;

use super::{DIGITS, Maker, Name, entries, estimate, hull, listed, one, range_text, tabulated};
use crate::paper::peters_wu::experiment::Experiment;
use crate::paper::words::every;
use crate::paper::{Claim, Enclosure, Verdict};
use crate::predict::Estimator;

/// Estimates are bounds: none is below the measured distance.
fn bounds(experiment: &Experiment, estimators: &[Estimator]) -> (Option<bool>, String) {
    let mut below = Vec::new();
    let mut truths = Vec::new();
    for (i, row, m) in entries(experiment, &tabulated(estimators)) {
        let model = &experiment.models[i];
        let Some(ratio) = model.ratio(row, m) else {
            continue;
        };
        let truth = one().at_most(&ratio);
        if truth == Some(false) {
            below.push(format!(
                "{} of {} at m = {m}: {}",
                row.name(),
                model.name,
                ratio.decimal(4)
            ));
        }
        truths.push(truth);
    }
    let count = truths.len();
    let found = match below.is_empty() {
        true => format!("none of {count} ratios to the measured distance is below 1"),
        false => format!(
            "{} of {count} ratios are below 1: {}",
            below.len(),
            listed(&below)
        ),
    };
    (every(truths), found)
}

/// The claims.
pub(super) fn claims(experiment: &Experiment, make: Maker<'_>) -> Vec<Claim> {
    let mut claims = Vec::new();
    let (truth, found) = bounds(experiment, &[Estimator::TabApprox]);
    claims.push(make(
        Name {
            print: "safe-approx-printed",
            redone: "safe-approx-redone",
        },
        "abstract, (iii), (iv)",
        "The tabulated bounds yield always safe predictions (tab-approx).".into(),
        Verdict::of(truth),
        found,
    ));
    let (truth, found) = bounds(experiment, &[Estimator::TabEigen]);
    claims.push(make(
        Name {
            print: "safe-eigen-printed",
            redone: "safe-eigen-redone",
        },
        "section 5",
        "The same for tab-eigen, where it has been tried.".into(),
        Verdict::of(truth),
        found,
    ));

    // (iii), second sentence.
    let first: Vec<Enclosure> = (experiment.models.iter())
        .filter_map(|m| m.ratio(estimate(Estimator::TabApprox, 0), 0))
        .collect();
    claims.push(make(
        Name {
            print: "claim-iii-printed",
            redone: "claim-iii-redone",
        },
        "introduction, (iii)",
        "On input polyhedra the tabulated bounds overestimate the distance in the first few steps."
            .into(),
        Verdict::of(every(first.iter().map(|r| Some(!r.at_most(&one())?)))),
        format!(
            "tab-approx 0 at m = 0 over the distance: {}",
            range_text(hull(&first))
        ),
    ));

    // (iv): small and decreasing multiples.
    let (mut truths, mut rising) = (Vec::new(), Vec::new());
    let mut multiples = Vec::new();
    for j in [1, 2] {
        let row = estimate(Estimator::TabApprox, j);
        for model in &experiment.models {
            for m in row.first_level()..experiment.levels() {
                let Some(ratio) = model.ratio(row, m) else {
                    continue;
                };
                if let Some(next) = model.ratio(row, m + 1) {
                    let truth = ratio.compare(&next).map(|o| o == Ordering::Greater);
                    if truth == Some(false) {
                        rising.push(format!(
                            "{} of {}: {} at m = {m}, {} at m = {}",
                            row.name(),
                            model.name,
                            ratio.decimal(DIGITS),
                            next.decimal(DIGITS),
                            m + 1
                        ));
                    }
                    truths.push(truth);
                }
                multiples.push(ratio);
            }
        }
    }
    claims.push(make(
        Name {
            print: "claim-iv-printed",
            redone: "claim-iv-redone",
        },
        "introduction, (iv)",
        "tab-approx 1 and 2 are a small and decreasing multiple of the measured distance.".into(),
        Verdict::of(every(truths.iter().copied())),
        format!(
            "multiples {}; they grow from one level to the next in {} of {} cases{}",
            range_text(hull(&multiples)),
            rising.len(),
            truths.len(),
            match rising.is_empty() {
                true => String::new(),
                false => format!(": {}", listed(&rising)),
            }
        ),
    ));

    claims
}
