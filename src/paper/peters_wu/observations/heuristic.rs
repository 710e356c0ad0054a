//! Observation (2) and (ii): the heuristic.

use super::{Maker, Name, entries, estimate, hull, one, range_text};
use crate::paper::peters_wu::experiment::Experiment;
use crate::paper::words::every;
use crate::paper::{Claim, Enclosure, Verdict};
use crate::predict::Estimator;
use crate::scalar::{Rational, Ring};

/// The claims.
pub(super) fn claims(experiment: &Experiment, make: Maker<'_>) -> Vec<Claim> {
    let mut claims = Vec::new();
    let heuristic = estimate(Estimator::Heuristic, 0);
    // (2)
    let mut below = 0;
    let mut of = 0;
    let mut unclear = 0;
    let mut close = Vec::new();
    for (i, row, m) in entries(experiment, &[heuristic]) {
        let Some(ratio) = experiment.models[i].ratio(row, m) else {
            continue;
        };
        of += 1;
        match one().at_most(&ratio) {
            Some(true) => (),
            Some(false) => below += 1,
            None => unclear += 1,
        }
        close.push(ratio);
    }
    let nearly_half = match unclear {
        // Less than a half, and not below two fifths.
        0 => Some(2 * below < of && 5 * below >= 2 * of),
        _ => None,
    };
    claims.push(make(
        Name { print: "observation-2-half-printed", redone: "observation-2-half-redone" },
        "section 5, (2)",
        "The heuristic has nearly half of the ratios below 1 (two fifths at least, less than a half).".into(),
        Verdict::of(nearly_half),
        format!("{below} of {of} are below 1{}", match unclear {
            0 => String::new(),
            _ => format!(", {unclear} are not decided"),
        }),
    ));
    let two = Enclosure::exactly(<Rational as Ring>::from_integer(2));
    let within_two = |r: &Enclosure| {
        let twice = r.times(&two);
        Some(r.at_most(&two)? && one().at_most(&twice)?)
    };
    let factors = range_text(hull(&close));
    claims.push(make(
        Name {
            print: "observation-2-close-printed",
            redone: "observation-2-close-redone",
        },
        "introduction, (ii); section 5, (2)",
        "The heuristic is close to measured: within a factor of 2.".into(),
        Verdict::of(every(close.iter().map(within_two))),
        format!("ratios {factors}"),
    ));
    // That some mesh has it below is a statement about all meshes: see also figure-5.
    claims.push(make(
        Name {
            print: "claim-ii-printed",
            redone: "claim-ii-redone",
        },
        "introduction, (ii)",
        "The heuristic is unsafe: on some mesh it underestimates the distance.".into(),
        match below {
            0 => Verdict::Undecided,
            _ => Verdict::True,
        },
        format!("{below} of {of} are below the distance on these models; for a certified case see figure-5"),
    ));
    claims
}
