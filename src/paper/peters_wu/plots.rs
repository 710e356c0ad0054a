//! Figure 6: medians of the ratios by level, and variances, printed and redone.

use super::experiment::{Experiment, LOCAL, Row};
use crate::paper::{Enclosure, Look, Plot, Series};
use crate::predict::Estimator;

/// A value of a row at a level.
type Value = fn(&Experiment, Row, usize) -> Option<Enclosure>;

fn series(experiment: &Experiment, rows: &[Row], value: Value) -> Vec<Series> {
    let points = |row: Row| {
        let at = |m: usize| Some((m as f64, value(experiment, row, m)?.float()));
        // Nothing can be drawn at 0 on a logarithmic axis.
        let all = (0..experiment.levels()).filter_map(at);
        all.filter(|p| p.1 > 0.0).collect::<Vec<_>>()
    };
    let of = |&row: &Row| Series {
        name: row.name(),
        look: Look::Line,
        points: points(row),
    };
    rows.iter()
        .map(of)
        .filter(|s| !s.points.is_empty())
        .collect()
}

/// All plots.
pub fn plots(printed: &Experiment, redone: &Experiment) -> Vec<Plot> {
    let of = |e| LOCAL.map(|j| Row::Estimate(e, j));
    let tight: Vec<Row> = [of(Estimator::TabApprox), of(Estimator::TabInterp)]
        .concat()
        .into_iter()
        .chain([Row::Estimate(Estimator::Heuristic, 0)])
        .collect();
    let wide = [of(Estimator::TabEigen), of(Estimator::TabApprox)].concat();
    let median: Value = Experiment::median;
    let variance: Value = Experiment::variance;
    let plot = |id, title: &str, y, experiment, rows: &[Row], value| Plot {
        id,
        title: title.into(),
        x: "m",
        y,
        logarithmic: true,
        series: series(experiment, rows, value),
    };
    let (ratio, spread) = (
        "median of estimate / measured",
        "variance of estimate / measured",
    );
    vec![
        plot(
            "figure-6-median-printed",
            "Figure 6, top, from the printed table",
            ratio,
            printed,
            &tight,
            median,
        ),
        plot(
            "figure-6-median-redone",
            "Figure 6, top, redone",
            ratio,
            redone,
            &tight,
            median,
        ),
        plot(
            "figure-6-variance-printed",
            "Figure 6, bottom, from the printed table",
            spread,
            printed,
            &wide,
            variance,
        ),
        plot(
            "figure-6-variance-redone",
            "Figure 6, bottom, redone",
            spread,
            redone,
            &wide,
            variance,
        ),
    ]
}
