//! Where the theory of an isolated extraordinary vertex applies.
//!
//! The spline over the n faces at a vertex is that of its two-ring net if all ring neighbours are
//! interior and of valence 6. Then the two-ring's facets are facets of the mesh, and so are those of
//! all its refinements. One step of Loop's scheme isolates every interior vertex: its new neighbours
//! are edge points.

use crate::mesh::{Point, Topology};
use crate::refine::RefineError;
use crate::spectrum::two_ring::Rules;

/// Why an estimate does not apply to a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotApplicable {
    /// The scheme refuses the mesh.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// An extraordinary vertex has an irregular neighbour.
    #[error(
        "vertex {vertex} of valence {valence} is not isolated: its neighbour {neighbour} is irregular or on the boundary; use one local subdivision more"
    )]
    NotIsolated {
        /// The vertex, from 0.
        vertex: u32,
        /// Its valence.
        valence: u32,
        /// The neighbour, from 0.
        neighbour: u32,
    },
    /// A boundary vertex has no regular patches.
    #[error(
        "boundary vertex {vertex} has {edges} edges: estimates are known for boundary vertices with 4 edges only; measure the mesh instead"
    )]
    Boundary {
        /// The vertex, from 0.
        vertex: u32,
        /// Its number of edges.
        edges: u32,
    },
    /// The level is below the number of local steps.
    #[error("level {level} is below the {local_steps} local subdivisions: use fewer of them")]
    Level {
        /// m.
        level: u32,
        /// j.
        local_steps: u32,
    },
    /// No tabulated distance.
    #[error(
        "no distance is tabulated for valence {valence} at level {level} (valences up to {largest}, levels up to {deepest}): measure the mesh instead"
    )]
    NotTabulated {
        /// n.
        valence: u32,
        /// m - j.
        level: u32,
        /// The largest valence that is.
        largest: u32,
        /// The deepest level that is.
        deepest: u32,
    },
}

/// Whether a vertex is extraordinary for Loop's scheme: interior, and not of valence 6.
pub fn is_extraordinary(topology: &Topology, v: u32) -> bool {
    !topology.is_boundary_vertex(v) && !matches!(topology.valence(v), 0 | 6)
}

/// The first ring neighbour of a vertex that is not interior of valence 6.
pub fn obstacle(topology: &Topology, v: u32) -> Option<u32> {
    let irregular = |&w: &u32| topology.is_boundary_vertex(w) || topology.valence(w) != 6;
    topology.ring(v).find(irregular)
}

/// The extraordinary vertices, all of them isolated, of a mesh whose boundary is regular.
///
/// # Errors
/// If and only if an extraordinary vertex is not isolated or a boundary vertex has not 4 edges; the first
/// in the order of vertices is named.
pub fn isolated(topology: &Topology) -> Result<Vec<u32>, NotApplicable> {
    let mut found = Vec::new();
    for vertex in 0..topology.vertex_count() {
        let valence = topology.valence(vertex);
        if topology.is_boundary_vertex(vertex) {
            if valence != 4 {
                let edges = valence;
                return Err(NotApplicable::Boundary { vertex, edges });
            }
        } else if is_extraordinary(topology, vertex) {
            if let Some(neighbour) = obstacle(topology, vertex) {
                return Err(NotApplicable::NotIsolated {
                    vertex,
                    valence,
                    neighbour,
                });
            }
            found.push(vertex);
        }
    }
    Ok(found)
}

/// The number of points of the two-ring of a vertex of valence n.
pub fn two_ring_size(n: u32) -> usize {
    1 + Rules::Loop(crate::scheme::LoopWeights::Original).kinds() * n as usize
}

/// Writes the two-ring of an isolated vertex in the order of [`crate::spectrum::two_ring`]; sector j is
/// that of the j-th half-edge of the vertex's fan.
///
/// ```text
/// h_j: v -> a_j;  next(h_j): a_j -> a_(j+1), d_j across it;  b_j three steps round a_j from v
/// ```
pub fn gather(topology: &Topology, positions: &[Point<f64>], v: u32, net: &mut Vec<[f64; 3]>) {
    let n = topology.valence(v) as usize;
    let at = |w: u32| positions[w as usize].0;
    net.clear();
    net.resize(two_ring_size(n as u32), at(v));
    for (j, h) in topology.fan(v).enumerate() {
        let across = topology.twin(topology.next(h));
        let spoke = (0..3).fold(topology.twin(h), |g, _| topology.rotate(g));
        net[1 + j] = at(topology.target(h));
        net[1 + n + j] = at(topology.target(topology.next(across)));
        net[1 + 2 * n + j] = at(topology.target(spoke));
    }
}
