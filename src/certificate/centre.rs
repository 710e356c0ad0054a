//! The claim of PW's Example 1: how far the centres of all levels are from the surface.

use serde::{Deserialize, Serialize};

/// For every m the centre of level m is at distance `h λ^m` from the spline of the characteristic net and the
/// mode of frequency 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CentreDistance {
    /// "loop".
    pub scheme: String,
    /// "original" or "warren".
    pub weights: String,
    /// The valence n.
    pub valence: u32,
    /// "centre-distance".
    pub kind: String,
}

impl CentreDistance {
    /// The name of the claim's file.
    pub fn file_name(&self) -> String {
        let CentreDistance {
            scheme,
            weights,
            valence,
            kind,
        } = self;
        format!("{scheme}-{weights}-{kind}-n{valence:02}.json")
    }
}
