//! The faces of a mesh under Doo-Sabin.

use num_traits::Zero;

use super::{Gathered, MeshView, Model, quarter_of};
use crate::bernstein::tensor::Biquadratic;
use crate::patch::quad_net;
use crate::patch::quarter_net::{self, DooSabinRules, QuarterNet};
use crate::patch::{Corners, Facet, Sink, Space};

/// Doo-Sabin. Every face by quarters, one at each interior vertex; parameters `(u, v)` with (0,0) at
/// the vertex, u towards the middle of the next edge, (1,1) at the centroid.
#[derive(Debug)]
pub struct DooSabinModel<'a, A: Space> {
    /// The mesh.
    pub mesh: MeshView<'a, A>,
    /// The masks.
    pub rules: DooSabinRules<A::Scalar>,
}

/// Storage of [`DooSabinModel`].
#[derive(Clone, Debug)]
pub struct DooSabinScratch<V> {
    /// The faces round each corner.
    nets: Vec<QuarterNet<V>>,
    facet: Vec<V>,
}

impl<V: Zero> Default for DooSabinScratch<V> {
    fn default() -> Self {
        DooSabinScratch {
            nets: Vec::new(),
            facet: Vec::new(),
        }
    }
}

impl<A: Space> DooSabinModel<'_, A> {
    /// The faces round each corner, and F at the corners.
    fn gather_facet(&self, face: u32, scratch: &mut DooSabinScratch<A::Point>) -> Gathered {
        let (topology, positions) = (self.mesh.topology, self.mesh.positions);
        let halfedges = topology.halfedges(face);
        let base = &positions[topology.origin(halfedges.start) as usize];
        let DooSabinScratch { nets, facet } = scratch;
        let mut result = Gathered::default();
        facet.clear();
        nets.resize_with(halfedges.len().max(nets.len()), QuarterNet::default);
        for (h, net) in halfedges.zip(nets) {
            net.gather::<A>(topology, positions, h, base);
            result.size = net
                .points()
                .map(|p| A::magnitude(p))
                .fold(result.size, f64::max);
            result.arity = result.arity.max(net.arity());
            facet.push(match self.mesh.compared {
                Facet::Limit => net.limit(&self.rules),
                Facet::Control => A::lift(&positions[topology.origin(h) as usize], base),
                Facet::Nothing => A::Point::zero(),
            });
        }
        result
    }
}

/// F at the corners of quarter `i` of a face with corner values `facet`.
fn quarter_facet<A: Space>(facet: &[A::Point], i: usize) -> [A::Point; 4] {
    let m = facet.len();
    let total = facet.iter().fold(A::Point::zero(), |total, p| total + p);
    let center = crate::scheme::catmull_clark::face_point(&total, m as u32);
    let (own, next, prev) = (&facet[i], &facet[(i + 1) % m], &facet[(i + m - 1) % m]);
    [
        own.clone(),
        crate::bernstein::midpoint::<A::Scalar, A::Point>(own, next),
        center,
        crate::bernstein::midpoint::<A::Scalar, A::Point>(own, prev),
    ]
}

impl<A: Space> Model<A> for DooSabinModel<'_, A> {
    type Patch = Biquadratic<A::Point>;
    type Net = QuarterNet<A::Point>;
    type Scratch = DooSabinScratch<A::Point>;

    fn face_count(&self) -> u32 {
        self.mesh.topology.face_count()
    }

    fn open(
        &self,
        face: u32,
        scratch: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    ) -> Gathered {
        let topology = self.mesh.topology;
        let halfedges = topology.halfedges(face);
        if halfedges
            .clone()
            .all(|h| topology.is_boundary_vertex(topology.origin(h)))
        {
            return Gathered::default();
        }
        let result = self.gather_facet(face, scratch);
        let DooSabinScratch { nets, facet } = scratch;
        for ((i, h), net) in halfedges.enumerate().zip(nets) {
            if topology.is_boundary_vertex(topology.origin(h)) {
                continue;
            }
            let u = 2.0 * i as f64;
            net.place(
                quarter_facet::<A>(facet, i),
                [[u, 0.0], [u + 1.0, 0.0], [u + 1.0, 1.0], [u, 1.0]],
            );
            quarter_net::split::<A, _>(&self.rules, net, sink);
        }
        result
    }

    fn split(
        &self,
        net: &Self::Net,
        _: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    ) {
        quarter_net::split::<A, _>(&self.rules, net, sink);
    }

    fn splits_at_once(&self, net: &Self::Net) -> bool {
        net.is_regular()
    }

    fn net_upper(&self, net: &Self::Net) -> A::Square {
        net.hull_bound::<A>()
    }

    fn net_value(&self, net: &Self::Net) -> (A::Point, [f64; 2]) {
        (net.corner_difference::<A::Scalar>(), net.corners[2])
    }

    fn net_points<'a>(&self, net: &'a Self::Net) -> impl Iterator<Item = &'a A::Point>
    where
        A::Point: 'a,
    {
        net.points()
    }

    fn net_corners(&self, net: &Self::Net) -> [A::Point; 4] {
        net.corner_differences::<A::Scalar>(&self.rules)
    }

    fn net_place(&self, net: &Self::Net) -> (Corners, u32) {
        (net.corners, net.steps)
    }

    fn mesh_point(&self, face: u32, at: [f64; 2]) -> A::Point {
        let mut scratch = DooSabinScratch::default();
        self.gather_facet(face, &mut scratch);
        let (Some(quarter), [u, v]) = quarter_of(at) else {
            unreachable!("a quarter")
        };
        let corners = quarter_facet::<A>(&scratch.facet, quarter as usize);
        quad_net::bilinear(&corners, [&A::dyadic(u), &A::dyadic(v)])
    }

    fn locate(&self, _: u32, at: [f64; 2]) -> (Option<u32>, [f64; 2]) {
        quarter_of(at)
    }
}
