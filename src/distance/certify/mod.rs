//! Proofs of Hausdorff distances of small meshes, for `subcert-check`: the claim `hausdorff` of
//! `proofs/FORMAT.md`, section 10.
//!
//! Everything is computed in intervals, so what is written holds; the checker repeats it in its own
//! arithmetic. Ends of the enclosure are widened by one part in 10^9 so that both agree.
//!
//! | file | idea |
//! |---|---|
//! | `part` | parts of faces and their nets |
//! | `facet` | distances of points to facets, from above and below |
//! | `setting` | surface, facets, and where both have the same parameters |
//! | `surface` | the surface as a tree: the nearest point, and a proof that none is nearer |
//! | `near` | covers by parts that are near, best first |
//! | `export` | the certificate |

mod export;
mod facet;
mod near;
mod part;
mod setting;
mod surface;

use super::hausdorff::{Facets, Side};
use crate::mesh::Mesh;
use crate::refine::RefineError;
use crate::scalar::Rational;
use crate::scheme::Scheme;

pub use export::{Eigen, certify};
pub use facet::{
    estimate_distance, estimate_foot, lower_bound_of_distance, upper_bound_of_distance,
};

/// How the surface ends at a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// By the cubic B-spline rules of the boundary.
    Smooth,
    /// The same, with vertices of a single face pinned.
    Sharp,
    /// The surface is that over the faces whose corners are all interior; no boundary rule is used.
    None,
}

/// The mesh that the surface is compared with.
#[derive(Clone, Copy, Debug)]
pub enum Flat<'a> {
    /// The control mesh of the level.
    Control,
    /// The same with vertices at their limits.
    Limit,
    /// Another mesh.
    Other(&'a Mesh<Rational>),
}

/// What is to be proved.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// Loop or Catmull-Clark.
    pub scheme: Scheme,
    /// The boundary rule.
    pub boundary: Boundary,
    /// The level of the mesh.
    pub level: u32,
    /// The mesh.
    pub flat: Flat<'a>,
    /// What its polygons are.
    pub facets: Facets,
    /// The side.
    pub side: Side,
    /// The relative gap `(hi - lo) / lo`.
    pub gap: f64,
    /// Whether the largest distance of a vertex to its limit is bounded too.
    pub vertices: bool,
}

/// Why there is no certificate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CertifyError {
    /// The scheme does not apply.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// Not in the format.
    #[error(
        "there are certificates for Loop and Catmull-Clark surfaces only: use --scheme loop or catmull-clark"
    )]
    DooSabin,
    /// No masks on the boundary.
    #[error("without a boundary rule there is only the control mesh of level 0")]
    NoBoundaryRule,
    /// All faces touch the boundary.
    #[error("no face has only interior corners: without a boundary rule there is no surface")]
    NoSurface,
    /// The gap is too small for the mesh.
    #[error(
        "the proof would have more than 200000 parts (so far the distance is between {lo} and {hi}): ask for a larger --gap, or a smaller mesh"
    )]
    TooManyParts {
        /// Lower bound.
        lo: f64,
        /// Upper bound.
        hi: f64,
    },
    /// Not a small mesh.
    #[error(
        "certificates are for meshes of up to {LARGEST} faces, and this one has {faces} at the level compared: leave out --certificate, or take a part of the mesh"
    )]
    TooManyFaces {
        /// Faces of the level-K mesh, or of the other mesh.
        faces: u64,
    },
    /// Nothing to show.
    #[error(
        "the distance is 0 or at the level of rounding errors: there is no relative enclosure to prove"
    )]
    NoDistance,
}

/// The most faces of a mesh in a certificate.
const LARGEST: u64 = 2000;

/// Why a part is near.
#[derive(Clone, Debug, PartialEq)]
enum With {
    /// To this triangular facet.
    Facet(usize),
    /// To a segment in this bilinear facet, parameters times 4096.
    Segment(usize, [[i64; 2]; 2]),
    /// To its own parameters.
    Match,
    /// To a point of the surface: face, word, corner.
    Point(u32, String, usize),
}

/// Where the distance is large.
#[derive(Clone, Debug, PartialEq)]
enum Far {
    /// The limit of a corner of a part.
    Surface {
        face: usize,
        word: String,
        corner: usize,
    },
    /// A point of a facet: numerators and the denominator of its parameters.
    Mesh { facet: usize, at: ([i64; 2], i64) },
}
