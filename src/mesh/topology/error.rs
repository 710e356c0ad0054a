//! What a list of faces can have wrong. Fields count from 0, messages from 1 as OBJ files do.

/// Why a list of faces is not an oriented 2-manifold with boundary.
///
/// No variant is needed for a vertex of valence 1: its two neighbours in a face would be the same
/// vertex, which is [`TopologyError::RepeatedVertex`] already.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TopologyError {
    /// The list is empty.
    #[error("the mesh has no face: give at least one")]
    NoFace,
    /// More vertices or corners than indices.
    #[error("the mesh has {count} {what}, more than the {limit} that fit: split it into parts")]
    TooLarge {
        /// "vertices" or "face corners".
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many there may be.
        limit: usize,
    },
    /// The list that says where faces start is no such list.
    #[error(
        "the list of face starts is wrong at entry {entry}: it must begin with 0, never decrease and end with the number of corners"
    )]
    FaceStart {
        /// The entry of the list, from 0.
        entry: usize,
    },
    /// Corners of faces of equal size that don't make whole faces.
    #[error("{corners} corners don't make whole faces of {arity} corners each")]
    PartialFace {
        /// How many corners there are.
        corners: usize,
        /// How many each face has.
        arity: u32,
    },
    /// A face with fewer than three corners.
    #[error("face {} has {corners} corners: give it at least 3, or remove it", face + 1)]
    FewCorners {
        /// The face.
        face: u32,
        /// How many corners it has.
        corners: u32,
    },
    /// A face that names a vertex that isn't there.
    #[error("face {} names vertex {}, but there are {vertex_count} vertices: correct the index", face + 1, u64::from(*vertex) + 1)]
    IndexOutOfRange {
        /// The face.
        face: u32,
        /// The vertex it names.
        vertex: u32,
        /// How many there are.
        vertex_count: u32,
    },
    /// A face that names a vertex twice.
    #[error("face {} names vertex {} more than once: remove the repeated corner, or the face", face + 1, vertex + 1)]
    RepeatedVertex {
        /// The face.
        face: u32,
        /// The vertex it repeats.
        vertex: u32,
    },
    /// Two faces with the same corners in the same order.
    #[error("face {} repeats face {}: remove one of them", faces[1] + 1, faces[0] + 1)]
    DuplicateFace {
        /// The two faces.
        faces: [u32; 2],
    },
    /// An edge with more than two faces.
    #[error("edge {}-{} has more than two faces ({}, {} and {}): duplicate its vertices or remove faces, so that at most two are left",
        vertices[0] + 1, vertices[1] + 1, faces[0] + 1, faces[1] + 1, faces[2] + 1)]
    NonManifoldEdge {
        /// The edge's ends, the smaller first.
        vertices: [u32; 2],
        /// The first three of its faces.
        faces: [u32; 3],
    },
    /// Two faces that run along an edge in the same direction.
    #[error("faces {} and {} both run from vertex {} to vertex {}: reverse one of them, or cut the surface there if it is one-sided",
        faces[0] + 1, faces[1] + 1, vertices[0] + 1, vertices[1] + 1)]
    ClashingOrientation {
        /// Where the two faces run, from and to.
        vertices: [u32; 2],
        /// The two faces.
        faces: [u32; 2],
    },
    /// A vertex whose faces form more than one fan.
    #[error("the faces at vertex {} form more than one fan (faces {} and {} are in different ones): give each fan a vertex of its own",
        vertex + 1, faces[0] + 1, faces[1] + 1)]
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
        /// One face each of two fans.
        faces: [u32; 2],
    },
}

impl TopologyError {
    /// The face at fault, if it is a single face's.
    pub fn face(&self) -> Option<u32> {
        match *self {
            Self::FewCorners { face, .. }
            | Self::IndexOutOfRange { face, .. }
            | Self::RepeatedVertex { face, .. } => Some(face),
            Self::DuplicateFace { faces: [_, face] } => Some(face),
            _ => None,
        }
    }
}
