//! Observation (3): `tab-interp` against `tab-approx`.

use std::cmp::Ordering;

use super::{Maker, Name, entries, estimate, range_of, range_text, tabulated};
use crate::paper::peters_wu::experiment::{Experiment, Row};
use crate::paper::words::every;
use crate::paper::{Claim, Enclosure, Verdict};
use crate::predict::Estimator;
use crate::scalar::Rational;

/// The claims.
pub(super) fn claims(experiment: &Experiment, make: Maker<'_>) -> Vec<Claim> {
    let mut claims = Vec::new();
    // (3)
    let (mut less, mut truths) = (0, Vec::new());
    for (i, row, m) in entries(experiment, &tabulated(&[Estimator::TabInterp])) {
        let (model, Row::Estimate(_, j)) = (&experiment.models[i], row) else {
            continue;
        };
        let other = model.at(estimate(Estimator::TabApprox, j), m);
        if let Some((a, b)) = model.at(row, m).zip(other) {
            let truth = a.compare(b).map(|o| o == Ordering::Less);
            less += usize::from(truth == Some(true));
            truths.push(truth);
        }
    }
    let range = range_of(experiment, Estimator::TabInterp, Estimator::TabApprox);
    claims.push(make(
        Name { print: "observation-3-smaller-printed", redone: "observation-3-smaller-redone" },
        "section 5, (3)",
        "tab-interp is consistently smaller than tab-approx.".into(),
        Verdict::of(every(truths.iter().copied())),
        format!(
            "smaller in {less} of {} cases; tab-interp / tab-approx: {}. (The two bound different distances, to \
             the interpolating and to the control mesh; both are compared with the latter.)",
            truths.len(),
            range_text(range.clone())
        ),
    ));
    let slightly = Enclosure::exactly(Rational::new(9.into(), 10.into()));
    let constant = range.as_ref().and_then(|[lo, hi]| {
        // Within a tenth of each other.
        hi.times(&slightly).at_most(lo)
    });
    claims.push(make(
        Name {
            print: "observation-3-constant-printed",
            redone: "observation-3-constant-redone",
        },
        "section 5, (3)",
        "The factor between tab-interp and tab-approx is constant (within a tenth).".into(),
        Verdict::of(constant),
        format!("tab-interp / tab-approx: {}", range_text(range.clone())),
    ));
    claims.push(make(
        Name {
            print: "observation-3-slightly-printed",
            redone: "observation-3-slightly-redone",
        },
        "section 5, (3)",
        "tab-interp is slightly smaller than tab-approx: by a tenth at most.".into(),
        Verdict::of(range.as_ref().and_then(|[lo, _]| slightly.at_most(lo))),
        format!("tab-interp / tab-approx: {}", range_text(range)),
    ));

    claims
}
