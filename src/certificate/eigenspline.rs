//! Claims about eigensplines and characteristic maps: section 9 of `proofs/FORMAT.md`.

use serde::{Deserialize, Serialize};

/// The distances of eigensplines from their polyhedra.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EigensplineClaim {
    /// "loop".
    pub scheme: String,
    /// "original" or "warren".
    pub weights: String,
    /// The valence n.
    pub valence: u32,
    /// "eigensplines".
    pub kind: String,
    /// "control" or "limit".
    pub against: String,
    /// The modes.
    pub modes: Vec<ModeClaim>,
}

/// The distances of one mode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModeClaim {
    /// "ring", "ray" or "between".
    pub family: String,
    /// The frequency; null for a mode of one sector.
    pub frequency: Option<u32>,
    /// Lower and upper bounds, for m = 0, 1, ..
    pub distances: Vec<[String; 2]>,
}

/// The characteristic map is regular and injective.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CharacteristicMapClaim {
    /// "loop" or "catmull-clark".
    pub scheme: String,
    /// The valence n.
    pub valence: u32,
    /// "characteristic-map".
    pub kind: String,
}

/// The centre of every level has an exact distance from the surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CentreDistanceClaim {
    /// "loop".
    pub scheme: String,
    /// "original" or "warren".
    pub weights: String,
    /// The valence n.
    pub valence: u32,
    /// "centre-distance".
    pub kind: String,
}

/// The supremum over ring 0 against the facets of one level.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RingStep {
    /// Lower bound.
    pub lo: String,
    /// Upper bound.
    pub hi: String,
    /// Where the lower bound is reached.
    pub at: SplineAt,
}

/// The supremum over the other rings against the facets of level 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NearStep {
    /// Lower bound.
    pub lo: String,
    /// Upper bound.
    pub hi: String,
    /// Where the lower bound is reached; null for the centre.
    pub at: Option<SplineAt>,
    /// The number of rings looked at one by one.
    pub depth: u32,
}

/// A point of a patch of ring 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplineAt {
    /// For `near`: the ring that the patch is scaled to.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub ring: Option<u32>,
    /// The sector.
    pub sector: usize,
    /// p, q, and 0 or 1 for up and down.
    pub triangle: [i32; 3],
    /// The parameters.
    pub point: [String; 2],
}

impl EigensplineClaim {
    /// `loop-original-eigensplines-control-n07.json`.
    pub fn file_name(&self) -> String {
        let (weights, against) = (&self.weights, &self.against);
        format!(
            "loop-{weights}-eigensplines-{against}-n{:02}.json",
            self.valence
        )
    }
}

impl CharacteristicMapClaim {
    /// `loop-characteristic-map-n07.json`.
    pub fn file_name(&self) -> String {
        format!(
            "{}-characteristic-map-n{:02}.json",
            self.scheme, self.valence
        )
    }
}

impl CentreDistanceClaim {
    /// `loop-warren-centre-distance-n04.json`.
    pub fn file_name(&self) -> String {
        format!(
            "loop-{}-centre-distance-n{:02}.json",
            self.weights, self.valence
        )
    }
}
