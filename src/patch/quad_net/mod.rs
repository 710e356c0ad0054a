//! Catmull-Clark: a quad with the full fans of its four corners, and the first step of any polygon.
//!
//! Orientation: corners counterclockwise. The fan of a corner holds its edge neighbours
//! counterclockwise and, between neighbours k and k + 1, the diagonal vertex of that quad (in a
//! polygon fan: the new face point). `at` is the place of the NEXT corner among the edge
//! neighbours, so that `at + 1` is the previous corner.

use num_traits::Zero;

use super::{Corners, Facet, Space, farthest};
use crate::bernstein::midpoint;
use crate::mesh::{NONE, Point, Topology};
use crate::scalar::{Field, Module};
use crate::scheme::catmull_clark;

mod regular;
mod rules;
mod step;

pub use regular::regular_face;
use rules::sum;
pub use rules::{CatmullClarkRules, Fan};
pub use step::{Scratch, split, split_polygon};

/// A quad with the fans of its corners, and the bilinear map F to compare with.
#[derive(Clone, Debug)]
pub struct QuadNet<V> {
    corner: [V; 4],
    fan: [Fan<V>; 4],
    /// F at the corners.
    facet: [V; 4],
    /// Parameters of the corners in the face (or its quarter).
    pub corners: Corners,
    /// Local steps taken since the mesh.
    pub steps: u32,
}

impl<V: Zero> Default for QuadNet<V> {
    fn default() -> Self {
        QuadNet {
            corner: std::array::from_fn(|_| V::zero()),
            fan: Default::default(),
            facet: std::array::from_fn(|_| V::zero()),
            corners: [[0.0; 2]; 4],
            steps: 0,
        }
    }
}

/// A polygon of the mesh with the fans of its corners, their `across` being new face points.
#[derive(Clone, Debug)]
pub struct PolygonNet<V> {
    corner: Vec<V>,
    fan: Vec<Fan<V>>,
    center: V,
    facet: Vec<V>,
    facet_center: V,
}

impl<V: Zero> Default for PolygonNet<V> {
    fn default() -> Self {
        PolygonNet {
            corner: Vec::new(),
            fan: Vec::new(),
            center: V::zero(),
            facet: Vec::new(),
            facet_center: V::zero(),
        }
    }
}

/// Walks the fan of the vertex at the origin of `h`: `edge(vertex)` for each neighbour,
/// `across(half-edge)` for each face, counterclockwise. Returns the place of `h`'s target.
fn walk_fan(
    topology: &Topology,
    h: u32,
    mut edge: impl FnMut(u32),
    mut across: impl FnMut(u32),
) -> usize {
    let vertex = topology.origin(h);
    let start = if topology.is_boundary_vertex(vertex) {
        topology.first_halfedge(vertex)
    } else {
        h
    };
    let (mut outgoing, mut count, mut at) = (start, 0, 0);
    loop {
        if outgoing == h {
            at = count;
        }
        edge(topology.target(outgoing));
        across(outgoing);
        count += 1;
        let next = topology.rotate(outgoing);
        if next == NONE {
            edge(topology.origin(topology.prev(outgoing)));
            return at;
        }
        if next == start {
            return at;
        }
        outgoing = next;
    }
}

impl<V> QuadNet<V> {
    /// Whether [`QuadNet::gather`] applies: the face and all faces round its corners are quads.
    pub fn applies(topology: &Topology, face: u32) -> bool {
        if topology.arity() == Some(4) {
            return true;
        }
        let mut quads = topology.face_size(face) == 4;
        for h in topology.halfedges(face) {
            walk_fan(
                topology,
                h,
                |_| (),
                |out| quads &= topology.face_size(topology.face_of(out)) == 4,
            );
        }
        quads
    }

    /// Gathers a quad of the mesh among quads. F is what `compared` says.
    pub fn gather<A>(
        &mut self,
        rules: &CatmullClarkRules<A::Scalar>,
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
        for i in 0..4 {
            let h = first + i as u32;
            let vertex = topology.origin(h);
            self.corner[i] = lift(vertex);
            let fan = &mut self.fan[i];
            fan.clear();
            fan.closed = !topology.is_boundary_vertex(vertex);
            let Fan { edges, across, .. } = fan;
            fan.at = walk_fan(
                topology,
                h,
                |v| edges.push(lift(v)),
                |out| across.push(lift(topology.target(topology.next(out)))),
            );
        }
        for i in 0..4 {
            self.facet[i] = match compared {
                Facet::Limit => rules.limit_quads(&self.corner[i], self.fan[i].view()),
                Facet::Control => self.corner[i].clone(),
                Facet::Nothing => V::zero(),
            };
        }
        self.corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        self.steps = 0;
    }

    /// The points of the net.
    pub fn points(&self) -> impl Iterator<Item = &V> {
        self.corner.iter().chain(
            self.fan
                .iter()
                .flat_map(|fan| fan.edges.iter().chain(&fan.across)),
        )
    }

    /// The largest squared distance of a point of the net to a corner of F: an upper bound for
    /// |S - F|^2 over the quad, since S lies in the hull of the net and the bilinear F in that of
    /// its corners.
    pub fn hull_bound<A>(&self) -> A::Square
    where
        A: Space<Point = V>,
        V: Module<A::Scalar>,
    {
        farthest::<A>(self.points(), &self.facet)
    }

    /// S - F at a corner of an all-quad net (as the nets are that a split yields).
    pub fn corner_difference<A>(&self, rules: &CatmullClarkRules<A::Scalar>, corner: usize) -> V
    where
        A: Space<Point = V>,
        V: Module<A::Scalar>,
    {
        rules.limit_quads(&self.corner[corner], self.fan[corner].view()) - &self.facet[corner]
    }

    /// F at parameters `(u, v)` of a gathered face.
    pub fn facet_point<S: Field>(&self, at: [&S; 2]) -> V
    where
        V: Module<S>,
    {
        bilinear(&self.facet, at)
    }

    /// Number of irregular corners, and one of them.
    pub fn irregular<S: Field>(&self, rules: &CatmullClarkRules<S>) -> (usize, usize) {
        let mut found = (0, 0);
        for (i, fan) in self.fan.iter().enumerate() {
            if !rules.is_regular(fan.view()) {
                found = (found.0 + 1, i);
            }
        }
        found
    }
}

/// The bilinear interpolant of four corner values at `(u, v)`.
pub(crate) fn bilinear<S: Field, V: Module<S>>(corners: &[V; 4], [u, v]: [&S; 2]) -> V {
    let [a, b, c, d] = corners;
    let (ub, vb) = (S::one() - u, S::one() - v);
    let low = a.clone() * &ub + &(b.clone() * u);
    let high = d.clone() * &ub + &(c.clone() * u);
    low * &vb + &(high * v)
}

impl<V> PolygonNet<V> {
    /// F at parameters of a quarter of a gathered face.
    pub fn facet_point<S: Field>(&self, quarter: usize, at: [&S; 2]) -> V
    where
        V: Module<S>,
    {
        let m = self.facet.len();
        let (own, next, prev) = (
            &self.facet[quarter],
            &self.facet[(quarter + 1) % m],
            &self.facet[(quarter + m - 1) % m],
        );
        let corners = [
            own.clone(),
            midpoint::<S, V>(own, next),
            self.facet_center.clone(),
            midpoint::<S, V>(own, prev),
        ];
        bilinear(&corners, at)
    }

    /// Gathers any polygon of the mesh. F is what `compared` says.
    pub fn gather<A>(
        &mut self,
        rules: &CatmullClarkRules<A::Scalar>,
        topology: &Topology,
        positions: &[Point<A::Scalar>],
        face: u32,
        compared: Facet,
    ) where
        A: Space<Point = V>,
        V: Module<A::Scalar>,
    {
        let halfedges = topology.halfedges(face);
        let base = &positions[topology.origin(halfedges.start) as usize];
        let lift = |vertex: u32| A::lift(&positions[vertex as usize], base);
        let centroid = |face: u32| {
            let total = topology
                .halfedges(face)
                .fold(V::zero(), |total, h| total + &lift(topology.origin(h)));
            catmull_clark::face_point(&total, topology.face_size(face))
        };
        let m = halfedges.len();
        self.corner.clear();
        self.fan.resize_with(m, Fan::default);
        for (fan, h) in self.fan.iter_mut().zip(halfedges) {
            let vertex = topology.origin(h);
            self.corner.push(lift(vertex));
            fan.clear();
            fan.closed = !topology.is_boundary_vertex(vertex);
            let Fan { edges, across, .. } = fan;
            fan.at = walk_fan(
                topology,
                h,
                |v| edges.push(lift(v)),
                |out| across.push(centroid(topology.face_of(out))),
            );
        }
        self.center = centroid(face);
        self.facet.clear();
        for i in 0..m {
            self.facet.push(match compared {
                Facet::Limit => rules.limit_polygons(&self.corner[i], self.fan[i].view()),
                Facet::Control => self.corner[i].clone(),
                Facet::Nothing => V::zero(),
            });
        }
        self.facet_center = catmull_clark::face_point(&sum(&self.facet), m as u32);
    }

    /// The points of the net.
    pub fn points(&self) -> impl Iterator<Item = &V> {
        self.corner.iter().chain(
            self.fan
                .iter()
                .flat_map(|fan| fan.edges.iter().chain(&fan.across)),
        )
    }
}
