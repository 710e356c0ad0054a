//! Claims that an inequality holds, or that it fails: the net, or the mesh, that violates it.

use serde::{Deserialize, Serialize};

/// "|left| <= factor · max |right| for all nets" is false: a net of one valence violates it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetViolation {
    /// "loop", "catmull-clark" or "doo-sabin".
    pub scheme: String,
    /// Loop: "original" or "warren".
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub weights: Option<String>,
    /// The valence.
    pub valence: u32,
    /// "violation".
    pub kind: String,
    /// The left side.
    pub left: Form,
    /// The factor, a rational.
    pub factor: String,
    /// The right side: the largest magnitude of these.
    pub right: Vec<Form>,
}

/// "|left_j| <= factor · max |right| for all nets and all j" is true.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetInequality {
    /// "loop", "catmull-clark" or "doo-sabin".
    pub scheme: String,
    /// Loop: "original" or "warren".
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub weights: Option<String>,
    /// The valence.
    pub valence: u32,
    /// "inequality".
    pub kind: String,
    /// The left sides.
    pub left: Vec<Form>,
    /// The factor, a rational.
    pub factor: String,
    /// The right side: the largest magnitude of these.
    pub right: Vec<Form>,
}

/// A linear functional of the first net.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum Form {
    /// `Σ coefficient · point`, points of the net of a word.
    Points {
        /// The word.
        word: String,
        /// (label from 1, coefficient), labels increasing.
        terms: Vec<(usize, String)>,
    },
    /// S - F_k at a point of a word.
    Distance {
        /// The word, of at least k letters.
        word: String,
        /// "control" or "limit".
        against: String,
        /// k.
        level: usize,
        /// Parameters in the word.
        at: [String; 2],
    },
}

/// A statement on all closed meshes is false: a mesh violates it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshViolation {
    /// "loop".
    pub scheme: String,
    /// "original" or "warren".
    pub weights: String,
    /// "mesh-violation".
    pub kind: String,
    /// "recurrence", "rate" or "distance".
    pub inequality: String,
    /// The level k.
    pub level: usize,
    /// Coordinates, rationals.
    pub vertices: Vec<[String; 3]>,
    /// Triangles, vertices from 1.
    pub faces: Vec<[usize; 3]>,
}
