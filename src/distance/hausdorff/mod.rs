//! Certified Hausdorff distances: a limit surface and a mesh, or two meshes.
//!
//! With `h(A, B) = sup over a in A of inf over b in B of |a - b|`:
//!
//! | side | value |
//! |---|---|
//! | [`Side::SurfaceToMesh`] | h(S, M) |
//! | [`Side::MeshToSurface`] | h(M, S) |
//! | [`Side::Both`] | H = max(h(S, M), h(M, S)) |
//!
//! S is the limit surface of a mesh, or a mesh; M its own level-K control or limit mesh, or any other
//! mesh. M is the union of its facets ([`Facets`]); under Doo-Sabin the quarters of its own mesh at
//! boundary vertices have no surface over them and don't count as points of M that S should be near
//! to.
//!
//! | file | idea |
//! |---|---|
//! | `metric` | distances in `f64` to triangles, hulls, boxes, and what they are off by |
//! | `shape` | what the search must know of a set: pieces, their outlines and hulls |
//! | `facets`, `surface` | the two kinds of set |
//! | `bvh` | the tree of boxes |
//! | `probe` | how near is a set to a point, or to the hull of a few points |
//! | `own` | surface and own mesh over the same parameters, which settles nearly everything |
//! | `search` | the branch and bound for the rest |
//! | `sides` | one side or both, with matching or without |
//! | `measure` | from meshes to an enclosure in their own unit |
//!
//! *Why the bounds hold.* Upper bounds: the distance to a convex set is a convex function, so over a
//! piece it is largest at points whose hull holds the piece. Lower bounds: a point of A itself, and
//! for each piece of B a plane (or a box) between that point and all of the piece's hull.

mod bvh;
mod facets;
mod measure;
mod metric;
mod own;
mod probe;
mod search;
mod shape;
mod sides;
mod surface;

pub use measure::{measure, mesh_to_mesh};

use std::time::Duration;

use super::measure::MeasureError;
use super::model::Against;
use crate::scheme::{CornerRule, Scheme};

/// Which of the three distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// How far the surface (or first mesh) goes from the mesh.
    SurfaceToMesh,
    /// How far the mesh goes from the surface (or first mesh).
    MeshToSurface,
    /// The larger of both.
    Both,
}

impl Side {
    /// The name used on the command line and in every file.
    pub fn name(self) -> &'static str {
        match self {
            Side::SurfaceToMesh => "surface-to-mesh",
            Side::MeshToSurface => "mesh-to-surface",
            Side::Both => "hausdorff",
        }
    }
}

/// What a face with more than three corners is, as a set of points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Facets {
    /// A quad is the bilinear interpolant of its corners, another polygon the union of its bilinear
    /// quarters (corner, edge midpoint, centroid, edge midpoint): what the parametric distance compares
    /// with.
    #[default]
    Bilinear,
    /// A fan of triangles from the face's first corner.
    Triangles,
}

impl Facets {
    /// The name used on the command line and in every file.
    pub fn name(self) -> &'static str {
        match self {
            Facets::Bilinear => "bilinear",
            Facets::Triangles => "triangles",
        }
    }
}

/// How well, and for how long: the search ends when
/// `hi - lo <= diagonal_gap * diagonal + gap * hi`, the diagonal being that of the first mesh's
/// bounding box.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// Gap relative to the diagonal.
    pub diagonal_gap: f64,
    /// Gap relative to the distance.
    pub gap: f64,
    /// When to stop with the enclosure so far. It then still holds, but its ends depend on the machine.
    pub budget: Option<Duration>,
}

impl Default for Goal {
    fn default() -> Self {
        Goal {
            diagonal_gap: 1e-4,
            gap: 0.0,
            budget: None,
        }
    }
}

/// What is measured between a limit surface and a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// The scheme that defines the surface.
    pub scheme: Scheme,
    /// What one-face boundary vertices do.
    pub corner: CornerRule,
    /// The level of the surface's own mesh; unused with another mesh.
    pub level: u32,
    /// Own control or limit mesh; unused with another mesh.
    pub against: Against,
    /// Which side.
    pub side: Side,
    /// What a polygon is.
    pub facets: Facets,
    /// How well.
    pub goal: Goal,
}

/// Where the lower bound comes from; coordinates are the nearest `f64`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Witness {
    /// The side it is on: `SurfaceToMesh` or `MeshToSurface`.
    #[serde(serialize_with = "by_name")]
    pub side: Side,
    /// The point that is far.
    pub point: [f64; 3],
    /// A point of the other set near it (of a triangle within the gap of that set, if it is curved).
    pub foot: [f64; 3],
    /// Face of the point, from 0: of the surface's level-K mesh or of the mesh, by side.
    pub face: u32,
    /// Face of the foot, likewise.
    pub foot_face: u32,
}

fn by_name<S: serde::Serializer>(side: &Side, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(side.name())
}

/// A face that may be as far as `hi` says.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Holder {
    /// The side it is on.
    #[serde(serialize_with = "by_name")]
    pub side: Side,
    /// The face, from 0.
    pub face: u32,
    /// No point of the face is further than this from the other set.
    pub hi: f64,
}

/// A certified enclosure `lo <= distance <= hi`, in the meshes' own unit.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// The distance is at least this.
    pub lo: f64,
    /// The distance is at most this.
    pub hi: f64,
    /// Whether the gap was reached.
    pub met: bool,
    /// Whether `hi` is at the level of rounding errors, `noise`; the gap then counts as met.
    pub rounding_level: bool,
    /// Lengths up to this are at the level of rounding errors.
    pub noise: f64,
    /// The diagonal of the first mesh's bounding box, rounded.
    pub diagonal: f64,
    /// Where `lo` comes from; `None` if it is 0.
    pub witness: Option<Witness>,
    /// Faces with points that may be further than `lo`, the largest bounds first; [`HOLDERS`] at most.
    pub holders: Vec<Holder>,
    /// Number of faces of the surface's mesh at its level (or of the first mesh).
    pub faces: u32,
    /// Number of faces of the mesh that it is compared with.
    pub mesh_faces: u32,
    /// Pieces looked at.
    pub cells: u64,
    /// Searches for nearest points.
    pub probes: u64,
}

/// Number of faces that a measurement names.
pub const HOLDERS: usize = 8;

impl Measurement {
    /// `(hi - lo) / hi`, 0 if `hi` is 0.
    pub fn gap(&self) -> f64 {
        if self.hi > 0.0 {
            (self.hi - self.lo) / self.hi
        } else {
            0.0
        }
    }

    /// `(hi - lo) / diagonal`, 0 if `hi` is 0.
    pub fn diagonal_gap(&self) -> f64 {
        if self.hi > self.lo {
            (self.hi - self.lo) / self.diagonal
        } else {
            0.0
        }
    }
}

/// Why a distance to a mesh cannot be measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HausdorffError {
    /// The surface is refused.
    #[error(transparent)]
    Surface(#[from] MeasureError),
    /// Doo-Sabin's own mesh is a union of quarters.
    #[error(
        "under Doo-Sabin the surface lies over the quarters of its own mesh, which are bilinear: use --facets bilinear, or give the mesh as --other"
    )]
    Quarters,
    /// A mesh without faces is no set.
    #[error("the mesh has no face: there is nothing to measure a distance to")]
    NoFace,
}
