//! The plots: rates by valence, and the growth of the ratio on regular tori.

use super::tori::Member;
use super::valences::{self, ValenceFindings};
use crate::paper::{Enclosure, Look, Plot, Series};

/// All plots.
pub fn plots(found: &[ValenceFindings], members: &[Member]) -> Vec<Plot> {
    let rates = valences::rates(found);
    let series = |name: &str, look, points: Vec<(f64, f64)>| Series {
        name: name.into(),
        look,
        points,
    };
    let member = |m: &Member| {
        (
            f64::from(m.size),
            Enclosure::exactly(m.ratio.clone()).float(),
        )
    };
    vec![
        Plot {
            id: "rates-by-valence",
            title: "The rate of M_k near a vertex of valence n".into(),
            x: "valence n",
            y: "rate (dimensionless)",
            logarithmic: false,
            series: vec![
                series(
                    "true: 3/8 + cos(2π/n)/4",
                    Look::Line,
                    rates.iter().map(|r| (r.0, r.2)).collect(),
                ),
                series(
                    "printed: 5/8 - nβ, 1/4 at least",
                    Look::Crosses,
                    rates.iter().map(|r| (r.0, r.1)).collect(),
                ),
            ],
        },
        Plot {
            id: "regular-tori",
            title: "|S - L| / M_0 on regular tori; Theorem 3 says at most 1".into(),
            x: "m, for m x m vertices",
            y: "ratio (dimensionless)",
            logarithmic: false,
            series: vec![
                series(
                    "nets found",
                    Look::Line,
                    members.iter().map(member).collect(),
                ),
                series(
                    "printed bound",
                    Look::Crosses,
                    members.iter().map(|m| (member(m).0, 1.0)).collect(),
                ),
            ],
        },
    ]
}
