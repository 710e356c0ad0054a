//! Why a mesh cannot be refined.

/// Why a mesh cannot be refined, or not in this arithmetic. Indices are 0-based; messages count
/// from 1, as mesh files do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RefineError {
    /// Loop's scheme met a polygon; it is never cut silently.
    #[error("face {} has {size} corners, and Loop's scheme needs triangles: triangulate the mesh, or use catmull-clark or doo-sabin", face + 1)]
    NotATriangle {
        /// The first such face.
        face: u32,
        /// Its number of corners.
        size: u32,
    },
    /// An interior vertex has too few edges for the scheme.
    #[error("interior vertex {} has valence {valence}, and {scheme} needs at least 3: remove the vertex, or use catmull-clark", vertex + 1)]
    ValenceTooLow {
        /// The first such vertex.
        vertex: u32,
        /// Its number of edges.
        valence: u32,
        /// The scheme's name.
        scheme: &'static str,
    },
    /// The arithmetic has no exact value for a mask weight, a cosine.
    #[error(
        "the masks for {what} {size} are irrational, so there is no exact mode for this mesh: use --arithmetic float or interval, or for Loop --weights warren"
    )]
    Unrepresentable {
        /// "valence" or "face size".
        what: &'static str,
        /// The valence or face size.
        size: u32,
    },
    /// Doo-Sabin has no boundary rule, hence no corner rule.
    #[error("Doo-Sabin has no boundary rule, so a corner rule has no meaning: leave it out")]
    CornerRule,
    /// There must be one point per vertex.
    #[error("{found} positions for {expected} vertices: give one position per vertex")]
    PositionCount {
        /// Number of vertices.
        expected: usize,
        /// Number of points.
        found: usize,
    },
    /// The refined mesh would not fit 32-bit indices.
    #[error(
        "the refined mesh would have {halfedges} corners of faces, more than 2^31: ask for fewer levels"
    )]
    TooLarge {
        /// Number of half-edges of the refined mesh.
        halfedges: u64,
    },
    /// A coordinate is infinite, not a number, or so large that a sum could overflow.
    #[error("vertex {} has a coordinate that is not finite, or too large to refine: correct it, or scale the mesh down", vertex + 1)]
    NotFinite {
        /// The first such vertex.
        vertex: u32,
    },
    /// A mask weight is not a multiple of a power of two, so no dyadic grid is closed under it.
    #[error("the weights for {what} {size} are not dyadic: the exact grid cannot hold them")]
    NotDyadic {
        /// "valence", "face size" or "limit".
        what: &'static str,
        /// The valence or face size.
        size: u32,
    },
    /// The dyadic grid would need more bits than its integers have.
    #[error("the exact grid would need {bits} bits; it has 127")]
    GridOverflow {
        /// Bits needed, the sign not counted.
        bits: u32,
    },
}
