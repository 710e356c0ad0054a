//! Claims about the Hausdorff distance for one mesh: section 10 of `proofs/FORMAT.md`.

use serde::{Deserialize, Serialize};

/// A mesh as it is written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshData {
    /// Rational coordinates.
    pub vertices: Vec<[String; 3]>,
    /// Vertices from 1.
    pub faces: Vec<Vec<u32>>,
}

/// `lo <= h <= hi`, h the distance of a surface and a mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HausdorffClaim {
    /// "loop" or "catmull-clark".
    pub scheme: String,
    /// Loop: "original" or "warren".
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub weights: Option<String>,
    /// "hausdorff".
    pub kind: String,
    /// "smooth", "sharp" or "none".
    pub boundary: String,
    /// The mesh that defines the surface: rational coordinates.
    pub vertices: Vec<[String; 3]>,
    /// Its faces, vertices from 1.
    pub faces: Vec<Vec<u32>>,
    /// The level K.
    pub level: u32,
    /// "control", "limit" or "other".
    pub against: String,
    /// "triangles" or "bilinear".
    pub facets: String,
    /// The other mesh.
    pub other: Option<MeshData>,
    /// "surface-to-mesh", "mesh-to-surface" or "both".
    pub side: String,
    /// Lower bound.
    pub lo: String,
    /// Upper bound.
    pub hi: String,
    /// A bound of the distances of vertices to their limits.
    pub vertex: Option<String>,
    /// The eigenspline that the mesh stands for.
    pub eigen: Option<EigenLink>,
}

/// The mesh is the net of an eigenspline, rounded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EigenLink {
    /// The valence.
    pub valence: u32,
    /// The frequency of the third coordinate.
    pub frequency: u32,
    /// Its factor.
    pub amplitude: String,
    /// A bound of the rounding of each coordinate.
    pub within: String,
}

/// Where a distance is large.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum FarAt {
    /// The limit of a corner of a part of the surface.
    Surface {
        /// The face of the level-K mesh, from 0.
        face: usize,
        /// The part.
        word: String,
        /// Its corner.
        corner: usize,
    },
    /// A point of the mesh.
    Mesh {
        /// The facet, from 0.
        facet: usize,
        /// Parameters.
        at: [String; 2],
    },
}

/// A face or facet, a word, and why that part is near.
pub type NearCell = (usize, String, NearBy);

/// Why a part is near.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum NearBy {
    /// `"match"`.
    Plain(String),
    /// A triangular facet.
    Facet(usize),
    /// A segment in a bilinear facet.
    Segment(usize, [String; 2], [String; 2]),
    /// The limit of a corner: face, word, corner.
    Point(usize, String, usize),
}
