//! Connectivity in flat arrays: half-edges are the corners of the faces.
//!
//! Half-edge `h` is a corner of a face: it starts at vertex `origin(h)` and runs to the next corner
//! of the same face. Faces are counterclockwise. Each edge has one or two half-edges.

use std::ops::Range;

/// "No half-edge".
pub const NONE: u32 = u32::MAX;

/// Why a list of faces is not an oriented 2-manifold with boundary.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TopologyError {
    /// placeholder
    #[error("the mesh has no face")]
    NoFace,
}

/// The connectivity of an oriented polygon mesh in which each edge has at most two faces and each
/// vertex one fan of faces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topology {
    /// `Some(m)` if every face is an m-gon; half-edges of face f are then m f .. m f + m.
    arity: Option<u32>,
    /// First half-edge of each face, and the total; empty if `arity` is `Some`.
    face_start: Vec<u32>,
    /// Face of each half-edge; empty if `arity` is `Some`.
    face_of: Vec<u32>,
    /// Origin of each half-edge.
    origin: Vec<u32>,
    /// Edge of each half-edge.
    edge_of: Vec<u32>,
    /// Half-edges of each edge; the second is `NONE` on the boundary.
    edges: Vec<[u32; 2]>,
    /// An outgoing half-edge of each vertex, on the boundary the clockwise-most one (its own edge
    /// is a boundary edge); `NONE` for an isolated vertex.
    first: Vec<u32>,
    /// Number of edges at each vertex, with the high bit set on the boundary.
    valence: Vec<u32>,
}

#[allow(missing_docs, unused_variables)] // signatures fixed first
impl Topology {
    pub fn from_polygons(
        vertex_count: usize,
        face_start: Vec<u32>,
        corners: Vec<u32>,
    ) -> Result<Self, TopologyError> {
        todo!()
    }
    pub fn from_uniform(
        vertex_count: usize,
        arity: u32,
        corners: Vec<u32>,
    ) -> Result<Self, TopologyError> {
        todo!()
    }
    pub fn vertex_count(&self) -> u32 {
        self.first.len() as u32
    }
    pub fn face_count(&self) -> u32 {
        todo!()
    }
    pub fn edge_count(&self) -> u32 {
        self.edges.len() as u32
    }
    pub fn halfedge_count(&self) -> u32 {
        self.origin.len() as u32
    }
    pub fn arity(&self) -> Option<u32> {
        self.arity
    }
    pub fn halfedges(&self, face: u32) -> Range<u32> {
        todo!()
    }
    pub fn face_size(&self, face: u32) -> u32 {
        todo!()
    }
    pub fn face_of(&self, h: u32) -> u32 {
        todo!()
    }
    pub fn next(&self, h: u32) -> u32 {
        todo!()
    }
    pub fn prev(&self, h: u32) -> u32 {
        todo!()
    }
    pub fn origin(&self, h: u32) -> u32 {
        self.origin[h as usize]
    }
    pub fn target(&self, h: u32) -> u32 {
        self.origin(self.next(h))
    }
    pub fn edge_of(&self, h: u32) -> u32 {
        self.edge_of[h as usize]
    }
    pub fn edge_halfedges(&self, e: u32) -> [u32; 2] {
        self.edges[e as usize]
    }
    pub fn twin(&self, h: u32) -> u32 {
        todo!()
    }
    pub fn first_halfedge(&self, v: u32) -> u32 {
        self.first[v as usize]
    }
    /// Number of edges at v.
    pub fn valence(&self, v: u32) -> u32 {
        self.valence[v as usize] & 0x7fff_ffff
    }
    pub fn is_boundary_vertex(&self, v: u32) -> bool {
        self.valence[v as usize] >> 31 != 0
    }
    pub fn is_closed(&self) -> bool {
        todo!()
    }
    /// The next outgoing half-edge counterclockwise round the origin of h: twin(prev(h)), NONE past the end of an open fan.
    pub fn rotate(&self, h: u32) -> u32 {
        todo!()
    }
    pub fn origins(&self) -> &[u32] {
        &self.origin
    }
}
