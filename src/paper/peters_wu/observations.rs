//! Claims (ii) to (iv) and observations (1) to (4), judged by the numbers of an experiment: the printed
//! Table 1, or the one redone here.

use std::cmp::Ordering;

use num_traits::One;

use super::experiment::{Experiment, LOCAL, Model, Row, TABULATED, deviation, quotient};
use super::printed;
use crate::paper::words::{all, claim};
use crate::paper::{Claim, Enclosure, Verdict};
use crate::predict::Estimator;
use crate::scalar::{Rational, Ring};

/// Whose numbers are judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The printed table.
    Print,
    /// The table redone.
    Redone,
}

/// The names of the claims, printed and redone.
struct Name {
    print: &'static str,
    redone: &'static str,
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
            below.push(format!("{} of {} at m = {m}: {}", row.name(), model.name, ratio.decimal(4)));
        }
        truths.push(truth);
    }
    let count = truths.len();
    let found = match below.is_empty() {
        true => format!("none of {count} ratios to the measured distance is below 1"),
        false => format!("{} of {count} ratios are below 1: {}", below.len(), listed(&below)),
    };
    (all(truths), found)
}

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
                less.push(format!("{} < {} of {} at m = {m}", row.name(), other.name(), model.name));
            }
            truths.push(truth);
        }
    }
    let found = match less.is_empty() {
        true => format!("in none of {} comparisons is tab-eigen smaller", truths.len()),
        false => format!("smaller in {} of {}: {}", less.len(), truths.len(), listed(&less)),
    };
    (all(truths), found)
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
        false => format!("not so in {} of {}: {}", failed.len(), found.len(), listed(&failed)),
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
pub fn claims(experiment: &Experiment, source: Source) -> Vec<Claim> {
    let scope = source.scope(experiment);
    let make = |name: Name, place, statement: String, verdict, found: String| {
        claim(source.name(&name), place, statement, verdict, found, scope.clone())
    };
    let estimate = |e, j| Row::Estimate(e, j);
    let heuristic = estimate(Estimator::Heuristic, 0);
    let approx_2 = estimate(Estimator::TabApprox, 2);
    let mut claims = Vec::new();

    let (truth, found) = bounds(experiment, &[Estimator::TabApprox]);
    claims.push(make(
        Name { print: "safe-approx-printed", redone: "safe-approx-redone" },
        "abstract, (iii), (iv)",
        "The tabulated bounds yield always safe predictions (tab-approx).".into(),
        Verdict::of(truth),
        found,
    ));
    let (truth, found) = bounds(experiment, &[Estimator::TabEigen]);
    claims.push(make(
        Name { print: "safe-eigen-printed", redone: "safe-eigen-redone" },
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
        Name { print: "claim-iii-printed", redone: "claim-iii-redone" },
        "introduction, (iii)",
        "On input polyhedra the tabulated bounds overestimate the distance in the first few steps.".into(),
        Verdict::of(all(first.iter().map(|r| Some(!r.at_most(&one())?)))),
        format!("tab-approx 0 at m = 0 over the distance: {}", range_text(hull(&first))),
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
        Name { print: "claim-iv-printed", redone: "claim-iv-redone" },
        "introduction, (iv)",
        "tab-approx 1 and 2 are a small and decreasing multiple of the measured distance.".into(),
        Verdict::of(all(truths.iter().copied())),
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

    // (1)
    let (truth, found) = loosest(experiment);
    claims.push(make(
        Name { print: "observation-1-loosest-printed", redone: "observation-1-loosest-redone" },
        "section 5, (1)",
        "tab-eigen provides the loosest bounds.".into(),
        Verdict::of(truth),
        found,
    ));
    let mut fluctuation = Vec::new();
    for j in LOCAL {
        let others = [Estimator::TabApprox, Estimator::TabInterp].map(|e| estimate(e, j));
        fluctuation.extend(variances(experiment, estimate(Estimator::TabEigen, j), &others, true));
    }
    claims.push(make(
        Name { print: "observation-1-fluctuation-printed", redone: "observation-1-fluctuation-redone" },
        "section 5, (1)",
        "tab-eigen has the most fluctuation over different models: the largest variance.".into(),
        Verdict::of(all(fluctuation.iter().map(|f| f.1))),
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
        Verdict::of(all(away.iter().map(|(_, name)| is_star(name)))),
        match elsewhere.is_empty() {
            true => format!("at all {} levels and numbers of local steps", away.len()),
            false => format!("not so in {} of {}: {}", elsewhere.len(), away.len(), listed(&elsewhere)),
        },
    ));

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
        Name { print: "observation-2-close-printed", redone: "observation-2-close-redone" },
        "introduction, (ii); section 5, (2)",
        "The heuristic is close to measured: within a factor of 2.".into(),
        Verdict::of(all(close.iter().map(within_two))),
        format!("ratios {factors}"),
    ));
    claims.push(make(
        Name { print: "claim-ii-printed", redone: "claim-ii-redone" },
        "introduction, (ii)",
        "The heuristic is unsafe: it underestimates the distance.".into(),
        match (below, unclear) {
            (0, 0) => Verdict::Refuted,
            (0, _) => Verdict::Undecided,
            _ => Verdict::True,
        },
        format!("{below} of {of} are below the distance on these models"),
    ));

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
        Verdict::of(all(truths.iter().copied())),
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
        Name { print: "observation-3-constant-printed", redone: "observation-3-constant-redone" },
        "section 5, (3)",
        "The factor between tab-interp and tab-approx is constant (within a tenth).".into(),
        Verdict::of(constant),
        format!("tab-interp / tab-approx: {}", range_text(range.clone())),
    ));
    claims.push(make(
        Name { print: "observation-3-slightly-printed", redone: "observation-3-slightly-redone" },
        "section 5, (3)",
        "tab-interp is slightly smaller than tab-approx: by a tenth at most.".into(),
        Verdict::of(range.as_ref().and_then(|[lo, _]| slightly.at_most(lo))),
        format!("tab-interp / tab-approx: {}", range_text(range)),
    ));

    // (4)
    let others: Vec<Row> = tabulated(&TABULATED)
        .into_iter()
        .filter(|row| !matches!(row, Row::Estimate(Estimator::TabInterp, _)))
        .collect();
    let low = variances(experiment, approx_2, &others, false);
    claims.push(make(
        Name { print: "observation-4-variance-printed", redone: "observation-4-variance-redone" },
        "section 5, (4)",
        "The variance of tab-approx 2 is low: the lowest of tab-approx and tab-eigen.".into(),
        Verdict::of(all(low.iter().map(|f| f.1))),
        failing(&low),
    ));
    let (one_step, (_, star_steps)) = printed::UNNECESSARY;
    let mut truths = Vec::new();
    let mut texts = Vec::new();
    for model in &experiment.models {
        let allowed = match model.name.starts_with(star) {
            true => star_steps,
            false => one_step,
        };
        let steps = unnecessary(model, approx_2, experiment.levels());
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
        Name { print: "observation-4-steps-printed", redone: "observation-4-steps-redone" },
        "section 5, (4); introduction",
        format!(
            "tab-approx 2 predicts {one_step} unnecessary step only; for Star {star_steps}."
        ),
        match truths.is_empty() {
            true => Verdict::Undecided,
            false => Verdict::of(all(truths)),
        },
        format!(
            "unnecessary steps for the tolerance that is just met after k steps, k >= 2: {}",
            texts.join(", ")
        ),
    ));
    claims
}
