//! Connectivity in flat arrays: half-edges are the corners of the faces.
//!
//! Half-edge `h` is a corner of a face: it starts at vertex `origin(h)` and runs to the next corner
//! of the same face. Faces are counterclockwise. Each edge has one or two half-edges.
//!
//! Indices are 0-based and `u32`. Half-edges are numbered face by face, corner by corner. Edges
//! built here are numbered by their smaller vertex, then by first appearance; refinement numbers
//! its own. All functions are total on valid indices and panic on others.

use std::ops::Range;

mod build;
mod error;
mod layout;
mod pairing;
#[cfg(test)]
mod tests;
mod verify;
mod walk;

pub use error::TopologyError;
pub use walk::{Components, Fan};

/// "No half-edge".
pub const NONE: u32 = u32::MAX;

/// Marks a boundary vertex in `Topology::valence`.
const BOUNDARY: u32 = 1 << 31;

/// The connectivity of an oriented polygon mesh in which each edge has at most two faces and each
/// vertex one fan of faces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topology {
    /// `Some(m)` if every face is an m-gon; half-edges of face f are then m f .. m f + m.
    pub(crate) arity: Option<u32>,
    /// First half-edge of each face, and the total; empty if `arity` is `Some`.
    pub(crate) face_start: Vec<u32>,
    /// Face of each half-edge; empty if `arity` is `Some`.
    pub(crate) face_of: Vec<u32>,
    /// Origin of each half-edge.
    pub(crate) origin: Vec<u32>,
    /// Edge of each half-edge.
    pub(crate) edge_of: Vec<u32>,
    /// Half-edges of each edge; the second is `NONE` on the boundary.
    pub(crate) edges: Vec<[u32; 2]>,
    /// An outgoing half-edge of each vertex, on the boundary the clockwise-most one (its own edge
    /// is a boundary edge); `NONE` for an isolated vertex.
    pub(crate) first: Vec<u32>,
    /// Number of edges at each vertex, with the high bit set on the boundary.
    pub(crate) valence: Vec<u32>,
}

impl Topology {
    /// Builds the connectivity of faces of any sizes, in linear time.
    ///
    /// Face `f` has the corners `corners[face_start[f]..face_start[f + 1]]`, so `face_start` has
    /// one entry more than there are faces. Faces of one size are stored as `from_uniform` does.
    ///
    /// # Errors
    /// If and only if the faces are not an oriented 2-manifold with boundary, or too many; see
    /// [`TopologyError`]. The first fault by kind (faces, edges, vertices), then by index, is named.
    pub fn from_polygons(
        vertex_count: usize,
        face_start: Vec<u32>,
        corners: Vec<u32>,
    ) -> Result<Self, TopologyError> {
        build::polygons(vertex_count, face_start, corners)
    }

    /// Builds the connectivity of faces that all have `arity` corners, in linear time.
    ///
    /// # Errors
    /// As for [`Topology::from_polygons`]; also if `arity` does not divide the number of corners.
    pub fn from_uniform(
        vertex_count: usize,
        arity: u32,
        corners: Vec<u32>,
    ) -> Result<Self, TopologyError> {
        build::uniform(vertex_count, arity, corners)
    }

    /// Takes connectivity that is right by construction; the fields' meanings are those of
    /// [`Topology`], and `verify` tests them.
    #[allow(clippy::too_many_arguments, dead_code)]
    pub(crate) fn from_parts(
        arity: Option<u32>,
        face_start: Vec<u32>,
        face_of: Vec<u32>,
        origin: Vec<u32>,
        edge_of: Vec<u32>,
        edges: Vec<[u32; 2]>,
        first: Vec<u32>,
        valence: Vec<u32>,
    ) -> Self {
        Self {
            arity,
            face_start,
            face_of,
            origin,
            edge_of,
            edges,
            first,
            valence,
        }
    }

    /// Number of vertices, isolated ones included.
    #[inline]
    pub fn vertex_count(&self) -> u32 {
        self.first.len() as u32
    }

    /// Number of faces.
    #[inline]
    pub fn face_count(&self) -> u32 {
        match self.arity {
            Some(m) => self.halfedge_count() / m,
            None => self.face_start.len() as u32 - 1,
        }
    }

    /// Number of edges.
    #[inline]
    pub fn edge_count(&self) -> u32 {
        self.edges.len() as u32
    }

    /// Number of half-edges, which is the number of face corners.
    #[inline]
    pub fn halfedge_count(&self) -> u32 {
        self.origin.len() as u32
    }

    /// `Some(m)` if every face is an m-gon.
    #[inline]
    pub fn arity(&self) -> Option<u32> {
        self.arity
    }

    /// The half-edges of `face`, counterclockwise.
    #[inline]
    pub fn halfedges(&self, face: u32) -> Range<u32> {
        match self.arity {
            Some(3) => 3 * face..3 * face + 3,
            Some(4) => 4 * face..4 * face + 4,
            Some(m) => m * face..m * face + m,
            None => self.face_start[face as usize]..self.face_start[face as usize + 1],
        }
    }

    /// The corners of `face`, counterclockwise, as vertices.
    #[inline]
    pub fn corners(&self, face: u32) -> &[u32] {
        let Range { start, end } = self.halfedges(face);
        &self.origin[start as usize..end as usize]
    }

    /// Number of corners of `face`.
    #[inline]
    pub fn face_size(&self, face: u32) -> u32 {
        match self.arity {
            Some(m) => m,
            None => self.face_start[face as usize + 1] - self.face_start[face as usize],
        }
    }

    /// The face of half-edge `h`, on its left.
    #[inline]
    pub fn face_of(&self, h: u32) -> u32 {
        match self.arity {
            Some(3) => h / 3,
            Some(4) => h / 4,
            Some(m) => h / m,
            None => self.face_of[h as usize],
        }
    }

    /// The next half-edge of the same face, counterclockwise.
    #[inline]
    pub fn next(&self, h: u32) -> u32 {
        match self.arity {
            Some(3) => next_in::<3>(h),
            Some(4) => next_in::<4>(h),
            Some(m) => {
                if h % m == m - 1 {
                    h + 1 - m
                } else {
                    h + 1
                }
            }
            None => {
                let face = self.face_of[h as usize] as usize;
                if h + 1 == self.face_start[face + 1] {
                    self.face_start[face]
                } else {
                    h + 1
                }
            }
        }
    }

    /// The half-edge of the same face that ends where `h` starts.
    #[inline]
    pub fn prev(&self, h: u32) -> u32 {
        match self.arity {
            Some(3) => prev_in::<3>(h),
            Some(4) => prev_in::<4>(h),
            Some(m) => {
                if h.is_multiple_of(m) {
                    h + m - 1
                } else {
                    h - 1
                }
            }
            None => {
                let face = self.face_of[h as usize] as usize;
                if h == self.face_start[face] {
                    self.face_start[face + 1] - 1
                } else {
                    h - 1
                }
            }
        }
    }

    /// The vertex where `h` starts.
    #[inline]
    pub fn origin(&self, h: u32) -> u32 {
        self.origin[h as usize]
    }

    /// The vertex where `h` ends.
    #[inline]
    pub fn target(&self, h: u32) -> u32 {
        self.origin(self.next(h))
    }

    /// The edge of half-edge `h`.
    #[inline]
    pub fn edge_of(&self, h: u32) -> u32 {
        self.edge_of[h as usize]
    }

    /// The half-edges of edge `e`; the second is [`NONE`] on the boundary.
    #[inline]
    pub fn edge_halfedges(&self, e: u32) -> [u32; 2] {
        self.edges[e as usize]
    }

    /// The other half-edge of the same edge; [`NONE`] on the boundary.
    #[inline]
    pub fn twin(&self, h: u32) -> u32 {
        // h is one of the two, so the exclusive or leaves the other (NONE included).
        let [a, b] = self.edges[self.edge_of[h as usize] as usize];
        a ^ b ^ h
    }

    /// An outgoing half-edge of `v`: on the boundary the one whose own edge is a boundary edge, so
    /// that [`Topology::rotate`] reaches all others; [`NONE`] for an isolated vertex.
    #[inline]
    pub fn first_halfedge(&self, v: u32) -> u32 {
        self.first[v as usize]
    }

    /// Number of edges at `v`; 0 for an isolated vertex.
    #[inline]
    pub fn valence(&self, v: u32) -> u32 {
        self.valence[v as usize] & !BOUNDARY
    }

    /// Whether `v` lies on a boundary edge. Isolated vertices don't.
    #[inline]
    pub fn is_boundary_vertex(&self, v: u32) -> bool {
        self.valence[v as usize] & BOUNDARY != 0
    }

    /// Whether `e` has one face only.
    #[inline]
    pub fn is_boundary_edge(&self, e: u32) -> bool {
        self.edges[e as usize][1] == NONE
    }

    /// Whether a vertex has no face.
    pub fn has_isolated_vertices(&self) -> bool {
        // Without an early end: vector instructions.
        self.first.iter().fold(false, |any, &h| any | (h == NONE))
    }

    /// Whether no edge is a boundary edge.
    pub fn is_closed(&self) -> bool {
        self.edges.iter().all(|halves| halves[1] != NONE)
    }

    /// The next outgoing half-edge counterclockwise round the origin of `h`, which is
    /// `twin(prev(h))`; [`NONE`] past the end of an open fan.
    #[inline]
    pub fn rotate(&self, h: u32) -> u32 {
        self.twin(self.prev(h))
    }

    /// The origin of every half-edge: all faces' corners, one after the other.
    #[inline]
    pub fn origins(&self) -> &[u32] {
        &self.origin
    }
}

/// The next half-edge when all faces are M-gons.
#[inline(always)]
const fn next_in<const M: u32>(h: u32) -> u32 {
    if h % M == M - 1 { h + 1 - M } else { h + 1 }
}

/// The previous half-edge when all faces are M-gons.
#[inline(always)]
const fn prev_in<const M: u32>(h: u32) -> u32 {
    if h.is_multiple_of(M) {
        h + M - 1
    } else {
        h - 1
    }
}
