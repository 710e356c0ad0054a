//! The plots: constants against valence, printed against sharp.

use super::control::Reading;
use super::valence::{LEVELS, Proved, Valence};
use super::{Findings, printed};
use crate::paper::{Enclosure, Look, Plot, Series};

const VALENCE: &str = "valence n";

fn line(found: &Findings, name: String, value: impl Fn(&Valence) -> Option<f64>) -> Series {
    let points = found.asked.iter();
    Series {
        name,
        look: Look::Line,
        points: points
            .filter_map(|v| Some((f64::from(v.n), value(v)?)))
            .collect(),
    }
}

fn crosses(found: &Findings, name: String, row: &printed::Row) -> Series {
    let points = found.asked.iter();
    let point = |v: &Valence| Some((f64::from(v.n), printed::at(row, v.n)?.range().float()));
    Series {
        name,
        look: Look::Crosses,
        points: points.filter_map(point).collect(),
    }
}

fn float(proved: &Option<Proved>) -> Option<f64> {
    proved.as_ref().map(|p| p.value.float())
}

/// All plots.
pub fn plots(found: &Findings) -> Vec<Plot> {
    let rates = (0..3).flat_map(|k| {
        let name = format!("r_{}", k + 1);
        [
            line(found, name.clone(), move |v| Some(v.rates[k].value.float())),
            crosses(found, format!("{name} printed"), &printed::TABLE_1[k]),
        ]
    });
    let control = (0..LEVELS).map(|k| line(found, format!("C_{k}"), move |v| float(&v.control[k])));
    let limit = (0..LEVELS).map(|k| line(found, format!("B_{k}"), move |v| float(&v.limit[k])));
    let lambda = printed::TABLE_2_LAMBDA;
    let corrected = move |v: &Valence| {
        let value = v.by_15(Reading::Displacement, lambda);
        value.as_ref().map(Enclosure::float)
    };
    vec![
        Plot {
            id: "rates",
            title: "Convergence rates of the second-order norm".into(),
            x: VALENCE,
            y: "rate (dimensionless)",
            logarithmic: false,
            series: rates.collect(),
        },
        Plot {
            id: "control",
            title: "Sharp constants C_k: surface to level-k control mesh".into(),
            x: VALENCE,
            y: "distance / M",
            logarithmic: true,
            series: control.collect(),
        },
        Plot {
            id: "limit",
            title: "Sharp constants B_k: surface to level-k limit mesh".into(),
            x: VALENCE,
            y: "distance / M",
            logarithmic: true,
            series: limit.collect(),
        },
        Plot {
            id: "beta",
            title: "Limit mesh: β(n) printed, redone, sharp".into(),
            x: VALENCE,
            y: "distance / M",
            logarithmic: false,
            series: vec![
                crosses(found, "β printed".into(), &printed::TABLE_2_LIMIT),
                line(found, "β redone".into(), |v| {
                    v.beta().map(Enclosure::float)
                }),
                line(found, "B_0 sharp".into(), |v| float(&v.limit[0])),
            ],
        },
        Plot {
            id: "control-printed",
            title: format!("Control mesh: C_{lambda}(n) printed, corrected, sharp"),
            x: VALENCE,
            y: "distance / M",
            logarithmic: false,
            series: vec![
                crosses(
                    found,
                    format!("C_{lambda} printed"),
                    &printed::TABLE_2_CONTROL,
                ),
                line(found, "(15) with max(n b, 3/8)".into(), corrected),
                line(found, "C_0 sharp".into(), |v| float(&v.control[0])),
            ],
        },
    ]
}
