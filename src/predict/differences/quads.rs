//! Catmull-Clark: second differences across edges in flat arrays.
//!
//! For an edge (a, x) of two quads (a, x, d, y) and (x, a, y', d') the differences across it are 2x - d - d' and
//! 2a - y - y'. Those of the edges that meet a corner of a quad, in quads, are the second differences of its
//! local net (CY's second-order norm): M is the largest at its four corners.
//!
//! *Boundary.* The ghosts 2b - a continue a star at a regular boundary vertex b (two quads); its only new
//! differences are those of the ghost row, 2ρ - σ for the differences ρ = 2b - b_- - b_+ and σ = 2a - a_- - a_+ across
//! its inner edge (b, a). Irregular boundary vertices add δ = 2b - b_- - b_+.
//!
//! *Ready* is a quad all of whose corners see quads only, with one irregular corner at most. Other faces
//! wait for their children: a step makes quads, another one parts extraordinary vertices.
//!
//! **Roundings.** As in [`super::triangles`].

use super::connectivity::Connectivity;
use super::levels::{Kinds, Visit};
use super::star::Vertex;
use super::triangles::delta;
use super::vector::{Vector, larger, middle, minus, second, square};
use crate::mesh::{NONE, Point, Topology};
use crate::predict::parts::by_parts;

/// The squares behind M of the quads of one level, and how far faces that wait move in the next step.
#[derive(Clone, Debug)]
pub struct Quads {
    /// The largest square at each vertex.
    vertex: Vec<f64>,
    /// The kind of each vertex; [`MIXED`] where a face is no quad.
    kinds: Vec<u16>,
}

/// Not every face at the vertex is a quad.
const MIXED: u16 = u16::MAX;

impl Quads {
    /// The squares of a level.
    pub fn new(
        topology: &Topology,
        positions: &[Point<f64>],
        kinds: &Kinds,
        mut of_vertex: Vec<u16>,
    ) -> Self {
        let of_edges = |edges: std::ops::Range<usize>, top: &mut [f64]| {
            for e in edges {
                of_edge(topology, positions, &of_vertex, e as u32, top);
            }
        };
        let mut vertex = by_parts(topology, of_edges);
        if !topology.is_closed() {
            for (v, &kind) in (0..).zip(&of_vertex) {
                if matches!(kinds.list[usize::from(kind)], Vertex::Boundary(_)) {
                    put(&mut vertex, v, square(&delta(topology, positions, v)));
                }
            }
        }
        if topology.arity() != Some(4) {
            for f in (0..topology.face_count()).filter(|&f| topology.face_size(f) != 4) {
                for &v in topology.corners(f) {
                    of_vertex[v as usize] = MIXED;
                }
            }
        }
        Quads {
            vertex,
            kinds: of_vertex,
        }
    }

    /// The kind of the irregular corner and M^2 of a ready face; `None` if it has to wait.
    #[inline]
    fn ready(&self, corners: &[u32]) -> Option<(u16, f64)> {
        if corners.len() != 4 {
            return None;
        }
        let (mut kind, mut square) = (0, 0.0_f64);
        for &v in corners {
            let own = self.kinds[v as usize];
            if own == MIXED || own != 0 && kind != 0 {
                return None;
            }
            kind = kind.max(own);
            square = square.max(self.vertex[v as usize]);
        }
        Some((kind, square))
    }

    /// The children of those of some faces that have to wait.
    pub fn children_of_waiting(&self, topology: &Topology, faces: &[u32]) -> Vec<u32> {
        let waits = |&&f: &&u32| self.ready(topology.corners(f)).is_none();
        // The children of a face are numbered by its corners.
        faces
            .iter()
            .filter(waits)
            .flat_map(|&f| topology.halfedges(f))
            .collect()
    }
}

/// The levels from the first on, until all faces are ready.
#[derive(Clone, Debug)]
pub struct QuadLevels<'a> {
    /// The number of the first level.
    pub first: usize,
    /// Connectivity and squares.
    pub levels: Vec<(Connectivity<'a>, Quads)>,
    /// Squares of how far each face of a level moves, for all but the last.
    pub moved: Vec<Vec<f64>>,
}

impl QuadLevels<'_> {
    /// The ready faces of a face of the first level.
    pub fn visit(&self, face: u32, to: &mut impl Visit) {
        self.descend(0, face, to);
    }

    fn descend(&self, index: usize, face: u32, to: &mut impl Visit) {
        let (topology, quads) = &self.levels[index];
        let level = self.first + index;
        match quads.ready(topology.corners(face)) {
            Some((kind, square)) => to.ready(level, kind, square),
            None => {
                // The children of a face are numbered by its corners.
                to.moved(level, self.moved[index][face as usize]);
                for h in topology.halfedges(face) {
                    self.descend(index + 1, h, to);
                }
            }
        }
    }
}

/// For each face the square of the largest distance between a level's mesh and the next one's over it: at
/// vertices, at the middles of edges and at centroids, both bilinear between.
pub fn moves(topology: &Topology, coarse: &[Point<f64>], fine: &[Point<f64>]) -> Vec<f64> {
    let (vertices, edges) = (topology.vertex_count(), topology.edge_count());
    let distance = |a: &Vector, b: &Vector| square(&minus(a, b));
    let of_face = |f: u32| {
        let corners = topology.corners(f);
        let size = corners.len() as f64;
        let mut centroid = [0.0; 3];
        let mut largest = 0.0_f64;
        for h in topology.halfedges(f) {
            let [v, x] = [topology.origin(h), topology.target(h)];
            let [p, q] = [v, x].map(|v| &coarse[v as usize].0);
            let edge = (vertices + topology.edge_of(h)) as usize;
            largest = largest.max(distance(p, &fine[v as usize].0));
            largest = largest.max(distance(&middle(p, q), &fine[edge].0));
            for i in 0..3 {
                centroid[i] += p[i] / size;
            }
        }
        largest.max(distance(
            &centroid,
            &fine[(vertices + edges + f) as usize].0,
        ))
    };
    (0..topology.face_count()).map(of_face).collect()
}

#[inline]
fn put(top: &mut [f64], v: u32, square: f64) {
    let slot = &mut top[v as usize];
    *slot = larger(*slot, square);
}

/// What an edge of two quads means for its ends.
#[inline]
fn of_edge(
    topology: &Topology,
    positions: &[Point<f64>],
    of_vertex: &[u16],
    e: u32,
    top: &mut [f64],
) {
    let [h, twin] = topology.edge_halfedges(e);
    let is_quad = |h| topology.face_size(topology.face_of(h)) == 4;
    if twin == NONE || !is_quad(h) || !is_quad(twin) {
        return;
    }
    let [at_a, at_x] = across(topology, positions, h, twin);
    let largest = larger(square(&at_a), square(&at_x));
    let [a, x] = [topology.origin(h), topology.target(h)];
    put(top, a, largest);
    put(top, x, largest);
    // The ghost row of a regular boundary vertex: 2ρ - σ.
    for (v, rho, sigma) in [(a, at_a, at_x), (x, at_x, at_a)] {
        if topology.is_boundary_vertex(v) && of_vertex[v as usize] == 0 {
            let ghost = [0, 1, 2].map(|i| 2.0 * rho[i] - sigma[i]);
            put(top, v, square(&ghost));
        }
    }
}

/// The differences across an edge (a, x) of two quads: at a and at x.
#[inline]
fn across(topology: &Topology, positions: &[Point<f64>], h: u32, twin: u32) -> [Vector; 2] {
    let at = |v: u32| &positions[v as usize].0;
    let beyond = |h: u32| {
        let next = topology.next(h);
        [topology.target(next), topology.target(topology.next(next))].map(at)
    };
    let [a, x] = [topology.origin(h), topology.target(h)].map(at);
    let ([d, y], [y_twin, d_twin]) = (beyond(h), beyond(twin));
    [second(a, y, y_twin), second(x, d, d_twin)]
}
