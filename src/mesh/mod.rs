//! Meshes: topology without coordinates, points without topology, and files.

pub(crate) mod frame;
pub mod io;
pub mod point;
pub mod summary;
pub mod topology;

pub use io::MeshError;
pub use point::Point;
pub use summary::Summary;
pub use topology::{Components, Fan, NONE, Topology, TopologyError};

/// A mesh: who is next to whom, and where everyone is.
#[derive(Clone, Debug)]
pub struct Mesh<S = f64> {
    /// The connectivity.
    pub topology: Topology,
    /// One point per vertex, in the mesh's own unit.
    pub positions: Vec<Point<S>>,
}

impl Mesh {
    /// Smallest and largest coordinates of the vertices with faces.
    pub fn bounding_box(&self) -> [[f64; 3]; 2] {
        let (low, high) = frame::extremes(&self.topology, &self.positions);
        [low, high]
    }
}
