//! The faces of a mesh under each scheme, as patches and nets of the vector field S - F.

use crate::bernstein::Patch;
use crate::mesh::{Point, Topology};
use crate::patch::{Corners, Facet, Sink, Space};

mod catmull_clark;
mod doo_sabin;
mod loop_scheme;

pub use catmull_clark::{CatmullClarkModel, CatmullClarkScratch};
pub use doo_sabin::{DooSabinModel, DooSabinScratch};
pub use loop_scheme::{LoopModel, LoopScratch};

/// Which mesh the surface is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Against {
    /// The control mesh.
    Control,
    /// The limit mesh: the same faces, with vertices at their limit positions.
    Limit,
}

impl Against {
    /// The F of that mesh.
    pub fn facet(self) -> Facet {
        match self {
            Against::Control => Facet::Control,
            Against::Limit => Facet::Limit,
        }
    }

    /// The name used on the command line and in every file.
    pub fn name(self) -> &'static str {
        match self {
            Against::Control => "control",
            Against::Limit => "limit",
        }
    }
}

/// What a gathered face tells the rounding bound: the largest coordinate, and n + m.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gathered {
    /// The largest coordinate relative to the face's first corner.
    pub size: f64,
    /// The largest fan plus the largest face of the net.
    pub arity: u32,
}

/// A mesh under one scheme, seen face by face.
pub trait Model<A: Space>: Sync {
    /// Polynomial pieces of S - F.
    type Patch: Patch<A::Scalar, A::Point> + Send;
    /// Pieces that need another step.
    type Net: Default + Clone + Send;
    /// Storage reused from face to face.
    type Scratch: Default + Send;

    /// Number of faces.
    fn face_count(&self) -> u32;

    /// Yields patches and nets that cover the face. Yields nothing where the face has no surface.
    fn open(
        &self,
        face: u32,
        scratch: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    ) -> Gathered;

    /// Splits a net by one step.
    fn split(
        &self,
        net: &Self::Net,
        scratch: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    );

    /// Whether [`Model::split`] yields patches only, so that it pays to split at once, or whether
    /// the net has no useful bound yet.
    fn splits_at_once(&self, net: &Self::Net) -> bool;

    /// An upper bound of |S - F|^2 over the net's piece (hull argument).
    fn net_upper(&self, net: &Self::Net) -> A::Square;

    /// S - F at the irregular point of the net's piece, with its parameters.
    fn net_value(&self, net: &Self::Net) -> (A::Point, [f64; 2]);

    /// The points whose hull holds the surface over the net's piece (if F is the origin).
    fn net_points<'a>(&self, net: &'a Self::Net) -> impl Iterator<Item = &'a A::Point>
    where
        A::Point: 'a;

    /// S - F at the corners of the net's piece (the fourth is arbitrary on triangles). For nets that
    /// [`Model::splits_at_once`] leaves alone.
    fn net_corners(&self, net: &Self::Net) -> [A::Point; 4];

    /// Parameters of those corners, and the number of local steps behind the net.
    fn net_place(&self, net: &Self::Net) -> (Corners, u32);

    /// F at parameters of the face, relative to the face's first corner.
    fn mesh_point(&self, face: u32, at: [f64; 2]) -> A::Point;

    /// Splits the parameters of a witness into a quarter of the face, if it is measured by quarters,
    /// and local parameters.
    fn locate(&self, face: u32, at: [f64; 2]) -> (Option<u32>, [f64; 2]);
}

/// The mesh of a model.
#[derive(Debug)]
pub struct MeshView<'a, A: Space> {
    /// Connectivity.
    pub topology: &'a Topology,
    /// Positions in the mesh's own unit.
    pub positions: &'a [Point<A::Scalar>],
    /// What F is.
    pub compared: Facet,
}

fn gathered<'a, A: Space>(points: impl Iterator<Item = &'a A::Point>, arity: u32) -> Gathered
where
    A::Point: 'a,
{
    Gathered {
        size: points.map(|p| A::magnitude(p)).fold(0.0, f64::max),
        arity,
    }
}

fn largest_valence(topology: &Topology, face: u32) -> u32 {
    topology
        .halfedges(face)
        .map(|h| topology.valence(topology.origin(h)))
        .max()
        .unwrap_or(0)
}

/// Quarter i of a polygon has its unit square at u = 2 i .. 2 i + 1.
fn quarter_of(at: [f64; 2]) -> (Option<u32>, [f64; 2]) {
    let quarter = (at[0] / 2.0).floor();
    (Some(quarter as u32), [at[0] - 2.0 * quarter, at[1]])
}
