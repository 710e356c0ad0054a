//! The tables: Table 1 redone, the ratios of Figure 6, λ_3.

use super::experiment::{Experiment, Row};
use super::redone::Redone;
use super::spectral::Spectra;
use crate::paper::{Enclosure, Table};

/// Digits of distances, as in Table 1.
const DIGITS: u32 = 6;

/// Digits of ratios.
const RATIO_DIGITS: u32 = 3;

/// All tables.
pub fn tables(
    printed: &Experiment,
    ours: &Experiment,
    redone: &[Redone],
    spectra: &Spectra,
) -> Vec<Table> {
    vec![
        table_1(redone),
        figure_6(
            "figure-6-printed",
            "Figure 6 from the printed Table 1",
            printed,
        ),
        figure_6("figure-6-redone", "Figure 6 redone", ours),
        spectra.table(),
    ]
}

fn cell(value: Option<&Enclosure>, digits: u32) -> String {
    value.map_or("-".into(), |x| x.decimal(digits))
}

fn table_1(redone: &[Redone]) -> Table {
    const HEADS: [&str; 6] = ["m = 0", "1", "2", "3", "4", "5"];
    let mut rows = Vec::new();
    let mut notes = vec![
        "Estimates that are not proved bounds of their distance are marked *: the heuristic, tab-eigen below \
         tab-approx, and tab-interp where the characteristic map leaves known facets. tab-interp bounds the distance \
         to the limit mesh, in the last row."
            .to_string(),
    ];
    for made in redone {
        for (row, entries) in Row::all().into_iter().zip(&made.model.rows) {
            let open = |m: usize| {
                let unproved = made.unproved.iter().any(|u| u.0 == row && u.1 == m);
                matches!(row, Row::Estimate(crate::predict::Estimator::Heuristic, _)) || unproved
            };
            let mut cells = vec![made.model.name.clone(), row.name()];
            cells.extend((0..HEADS.len()).map(|m| {
                let value = entries.get(m).and_then(Option::as_ref);
                let mark = if value.is_some() && open(m) { "*" } else { "" };
                format!("{}{mark}", cell(value, DIGITS))
            }));
            rows.push(cells);
        }
        let mut cells = vec![made.model.name.clone(), "to limit mesh".into()];
        cells.extend(
            (0..HEADS.len()).map(|m| cell(made.limit.get(m).and_then(Option::as_ref), DIGITS)),
        );
        rows.push(cells);
        if let Some((row, why)) = made.missing.first() {
            let names: Vec<String> = made.missing.iter().map(|(row, _)| row.name()).collect();
            notes.push(format!(
                "{}: no {}, as {} says: {why}.",
                made.model.name,
                names.join(", "),
                row.name()
            ));
        }
        if !made.plain_over_sector.is_empty() {
            let list: Vec<String> = made
                .plain_over_sector
                .iter()
                .map(|x| format!("{x:.2}"))
                .collect();
            notes.push(format!(
                "{}: the paper's plain sum is {} times tab-approx.",
                made.model.name,
                list.join(", ")
            ));
        }
    }
    Table {
        id: "table-1",
        title: "Table 1 redone: distances for m steps of Loop subdivision".into(),
        heads: ["mesh", "estimate"].into_iter().chain(HEADS).collect(),
        rows,
        notes,
    }
}

fn figure_6(id: &'static str, title: &str, experiment: &Experiment) -> Table {
    let mut rows = Vec::new();
    for row in Row::all().into_iter().filter(|row| *row != Row::Measured) {
        for m in row.first_level()..experiment.levels() {
            let (Some(median), Some(variance), Some([low, high])) = (
                experiment.median(row, m),
                experiment.variance(row, m),
                experiment.spread(row, m),
            ) else {
                continue;
            };
            rows.push(vec![
                row.name(),
                m.to_string(),
                experiment.ratios(row, m).len().to_string(),
                median.decimal(RATIO_DIGITS),
                variance.decimal(RATIO_DIGITS),
                low.decimal(RATIO_DIGITS),
                high.decimal(RATIO_DIGITS),
            ]);
        }
    }
    Table {
        id,
        title: title.into(),
        heads: vec![
            "estimate", "m", "models", "median", "variance", "least", "largest",
        ],
        rows,
        notes: vec!["Ratios of the estimate to the measured distance (dimensionless).".into()],
    }
}
