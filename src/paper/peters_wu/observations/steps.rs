//! Observation (4): unnecessary steps.

use super::{Maker, Name, estimate};
use crate::paper::peters_wu::experiment::{Experiment, Model, Row};
use crate::paper::peters_wu::printed;
use crate::paper::words::every;
use crate::paper::{Claim, Enclosure, Verdict};
use crate::predict::Estimator;

/// How many steps too many an estimate predicts: for the tolerance that the measured distance of level k
/// just meets, the first level whose estimate meets it, less k. This is the worst tolerance of those that
/// need k steps. Levels below the local steps are left out: there the row has no smaller prediction.
pub fn unnecessary(model: &Model, row: Row, levels: usize) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for k in row.first_level()..levels {
        let Some(measured) = model.at(Row::Measured, k) else {
            continue;
        };
        let tolerance = Enclosure::exactly(measured.hi.clone());
        // The first level that meets the tolerance with what is certain.
        let first = |row: Row| {
            (0..levels).find(|&m| {
                let entry = model.at(row, m);
                entry.is_some_and(|e| e.at_most(&tolerance) == Some(true))
            })
        };
        if let (Some(needed), Some(predicted)) = (first(Row::Measured), first(row)) {
            found.push((k, predicted.saturating_sub(needed)));
        }
    }
    found
}

/// The claims.
pub(super) fn claims(experiment: &Experiment, make: Maker<'_>) -> Vec<Claim> {
    let mut claims = Vec::new();
    let star = printed::UNNECESSARY.1.0;
    let (one_step, (_, star_steps)) = printed::UNNECESSARY;
    let mut truths = Vec::new();
    let mut texts = Vec::new();
    for model in &experiment.models {
        let allowed = match model.name.starts_with(star) {
            true => star_steps,
            false => one_step,
        };
        let steps = unnecessary(
            model,
            estimate(Estimator::TabApprox, 2),
            experiment.levels(),
        );
        let worst = steps.iter().map(|s| s.1).max();
        let least = steps.iter().map(|s| s.1).min();
        if let (Some(worst), Some(least)) = (worst, least) {
            truths.push(Some(worst <= allowed as usize));
            texts.push(match worst == least {
                true => format!("{}: {worst}", model.name),
                false => format!("{}: {least} to {worst}", model.name),
            });
        }
    }
    claims.push(make(
        Name {
            print: "observation-4-steps-printed",
            redone: "observation-4-steps-redone",
        },
        "section 5, (4); introduction",
        format!("tab-approx 2 predicts {one_step} unnecessary step only; for Star {star_steps}."),
        match truths.is_empty() {
            true => Verdict::Undecided,
            false => Verdict::of(every(truths)),
        },
        format!(
            "unnecessary steps for the tolerance that is just met after k steps, k >= 2: {}",
            texts.join(", ")
        ),
    ));
    claims
}
