//! Loop: a triangle with the full rings of its three corners.
//!
//! Orientation: corners A, B, C counterclockwise. The ring of a corner is counterclockwise; `at`
//! is the place of the NEXT corner in it (B for A), so that `at + 1` is the previous corner, and
//! `at + 2`, `at - 1` are the vertices opposite the face's edges.

use num_traits::Zero;

use super::{Corners, Facet, Space, farthest};
use crate::mesh::{NONE, Point, Topology};
use crate::scalar::{Field, Module};

mod regular;
mod rules;
mod step;

pub use regular::regular_face;
pub use rules::{LoopRules, Ring};
pub use step::{Scratch, split};

/// A triangle with the rings of its corners, and the linear map F to compare with.
#[derive(Clone, Debug)]
pub struct TriangleNet<V> {
    corner: [V; 3],
    ring: [Ring<V>; 3],
    /// F at the corners.
    facet: [V; 3],
    /// Parameters of the corners in the face.
    pub corners: Corners,
    /// Local steps taken since the mesh.
    pub steps: u32,
}

impl<V: Zero> Default for TriangleNet<V> {
    fn default() -> Self {
        TriangleNet {
            corner: std::array::from_fn(|_| V::zero()),
            ring: Default::default(),
            facet: std::array::from_fn(|_| V::zero()),
            corners: [[0.0; 2]; 4],
            steps: 0,
        }
    }
}

impl<V> TriangleNet<V> {
    /// Gathers a face of the mesh. F is what `compared` says.
    pub fn gather<A>(
        &mut self,
        rules: &LoopRules<A::Scalar>,
        topology: &Topology,
        positions: &[Point<A::Scalar>],
        face: u32,
        compared: Facet,
    ) where
        A: Space<Point = V>,
        V: Module<A::Scalar>,
    {
        let first = topology.halfedges(face).start;
        let base = &positions[topology.origin(first) as usize];
        let lift = |vertex: u32| A::lift(&positions[vertex as usize], base);
        for i in 0..3 {
            let h = first + i as u32;
            let vertex = topology.origin(h);
            self.corner[i] = lift(vertex);
            let ring = &mut self.ring[i];
            ring.closed = !topology.is_boundary_vertex(vertex);
            ring.points.clear();
            ring.at = 0;
            let start = if ring.closed {
                h
            } else {
                topology.first_halfedge(vertex)
            };
            let mut outgoing = start;
            loop {
                if outgoing == h {
                    ring.at = ring.points.len();
                }
                ring.points.push(lift(topology.target(outgoing)));
                let next = topology.rotate(outgoing);
                if next == NONE {
                    ring.points
                        .push(lift(topology.origin(topology.prev(outgoing))));
                    break;
                }
                if next == start {
                    break;
                }
                outgoing = next;
            }
        }
        for i in 0..3 {
            self.facet[i] = match compared {
                Facet::Limit => rules.limit(&self.corner[i], self.ring[i].view()),
                Facet::Control => self.corner[i].clone(),
                Facet::Nothing => V::zero(),
            };
        }
        self.corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
        self.steps = 0;
    }

    /// The largest squared distance of a point of the net to a corner of F: an upper bound for
    /// |S - F|^2 over the triangle, since S lies in the hull of the net and F in that of its corners.
    pub fn hull_bound<A>(&self) -> A::Square
    where
        A: Space<Point = V>,
        V: Module<A::Scalar>,
    {
        // Each point once: the rings of corners 1 and 2 begin with points of the rings before, and
        // that of corner 2 ends with one.
        let own = |corner: usize, last: usize| {
            let ring = &self.ring[corner];
            let n = ring.points.len();
            let range = if ring.closed && n > 4 {
                3..n - last
            } else {
                0..n
            };
            range.map(move |k| &ring.points[(ring.at + k) % n])
        };
        let points = std::iter::once(&self.corner[0]).chain(&self.ring[0].points);
        farthest::<A>(points.chain(own(1, 0)).chain(own(2, 1)), &self.facet)
    }

    /// F at parameters `(v, w)` of a gathered face.
    pub fn facet_point<S: Field>(&self, [v, w]: [&S; 2]) -> V
    where
        V: Module<S>,
    {
        let u = S::one() - v - w;
        let [a, b, c] = &self.facet;
        a.clone() * &u + &(b.clone() * v) + &(c.clone() * w)
    }

    /// The points of the net.
    pub fn points(&self) -> impl Iterator<Item = &V> {
        self.corner
            .iter()
            .chain(self.ring.iter().flat_map(|ring| &ring.points))
    }

    /// S - F at a corner; corner 0 is the irregular one of every net that a split yields.
    pub fn corner_difference<A>(&self, rules: &LoopRules<A::Scalar>, corner: usize) -> V
    where
        A: Space<Point = V>,
        V: Module<A::Scalar>,
    {
        rules.limit(&self.corner[corner], self.ring[corner].view()) - &self.facet[corner]
    }
}
