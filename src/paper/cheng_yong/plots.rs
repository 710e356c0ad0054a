//! The plots: rates and W against valence, printed and true.

use super::setting::LEVELS;
use super::{Valence, depth, printed};
use crate::paper::{Look, Plot, Series};
use crate::scalar::Rational;
use crate::scalar::float::round_to_nearest;

const VALENCE: &str = "valence N";

fn series(
    found: &[Valence],
    name: &str,
    look: Look,
    value: impl Fn(&Valence) -> Option<Rational>,
) -> Series {
    let point = |v: &Valence| Some((f64::from(v.n), round_to_nearest(&value(v)?)));
    Series {
        name: name.into(),
        look,
        points: found.iter().filter_map(point).collect(),
    }
}

/// All plots.
pub fn plots(found: &[Valence]) -> Vec<Plot> {
    let rate = |k: usize| {
        series(found, &format!("G^{k}/G^0 true"), Look::Line, move |v| {
            v.first.rate(k)
        })
    };
    let power = |k: usize| {
        series(found, &format!("(19), k = {k}"), Look::Crosses, move |v| {
            let rate = printed::rate(v.n)?;
            Some((1..k).fold(rate.clone(), |power, _| power * &rate))
        })
    };
    vec![
        Plot {
            id: "cheng-yong-first-order",
            title: "First-order norm: (19) and the true rates".into(),
            x: VALENCE,
            y: "G^k / G^0 (dimensionless)",
            logarithmic: false,
            series: (1..=LEVELS).flat_map(|k| [rate(k), power(k)]).collect(),
        },
        Plot {
            id: "cheng-yong-second-order",
            title: "Second-order norm: W of (27), Appendix D, and the truth".into(),
            x: VALENCE,
            y: "Z_3^1 / Z_0^0 (dimensionless)",
            logarithmic: false,
            series: vec![
                series(found, "W (27)", Look::Crosses, |v| depth::w(v.n)),
                series(found, "Appendix D", Look::Crosses, |v| {
                    printed::by_case(printed::APPENDIX_D, v.n)
                }),
                series(found, "true", Look::Line, |v| {
                    v.second.third[0].value().cloned()
                }),
            ],
        },
    ]
}
