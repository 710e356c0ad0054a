//! The faces of a mesh under Loop's scheme.

use num_traits::Zero;

use super::{Gathered, MeshView, Model, gathered, largest_valence};
use crate::bernstein::triangle::QuarticTriangle;
use crate::patch::triangle_net::{self, LoopRules, TriangleNet};
use crate::patch::{Corners, Sink, Space};

/// Parameters of a triangle's corners.
const UNIT_TRIANGLE: Corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];

/// Loop's scheme. Parameters `(v, w)` on the unit triangle, v towards the face's second corner and w
/// towards its third.
#[derive(Debug)]
pub struct LoopModel<'a, A: Space> {
    /// The mesh.
    pub mesh: MeshView<'a, A>,
    /// The masks.
    pub rules: LoopRules<A::Scalar>,
}

/// Storage of [`LoopModel`].
#[derive(Clone, Debug)]
pub struct LoopScratch<V> {
    net: TriangleNet<V>,
    split: triangle_net::Scratch<V>,
}

impl<V: Zero> Default for LoopScratch<V> {
    fn default() -> Self {
        LoopScratch {
            net: TriangleNet::default(),
            split: triangle_net::Scratch::default(),
        }
    }
}

impl<A: Space> Model<A> for LoopModel<'_, A> {
    type Patch = QuarticTriangle<A::Point>;
    type Net = TriangleNet<A::Point>;
    type Scratch = LoopScratch<A::Point>;

    fn face_count(&self) -> u32 {
        self.mesh.topology.face_count()
    }

    fn open(
        &self,
        face: u32,
        scratch: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    ) -> Gathered {
        let (topology, compared) = (self.mesh.topology, self.mesh.compared);
        let positions = self.mesh.positions;
        if let Some((patch, size)) =
            triangle_net::regular_face::<A, _>(topology, positions, face, compared)
        {
            sink.patch(&patch, UNIT_TRIANGLE, 0);
            return Gathered { size, arity: 6 + 3 };
        }
        scratch
            .net
            .gather::<A>(&self.rules, topology, self.mesh.positions, face, compared);
        triangle_net::split::<A, _>(&self.rules, &scratch.net, &mut scratch.split, sink);
        gathered::<A>(scratch.net.points(), largest_valence(topology, face) + 3)
    }

    fn split(
        &self,
        net: &Self::Net,
        scratch: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    ) {
        triangle_net::split::<A, _>(&self.rules, net, &mut scratch.split, sink);
    }

    fn splits_at_once(&self, _: &Self::Net) -> bool {
        false
    }

    fn net_upper(&self, net: &Self::Net) -> A::Square {
        net.hull_bound::<A>()
    }

    fn net_value(&self, net: &Self::Net) -> (A::Point, [f64; 2]) {
        (net.corner_difference::<A>(&self.rules, 0), net.corners[0])
    }

    fn net_points<'a>(&self, net: &'a Self::Net) -> impl Iterator<Item = &'a A::Point>
    where
        A::Point: 'a,
    {
        net.points()
    }

    fn net_corners(&self, net: &Self::Net) -> [A::Point; 4] {
        let at = |corner| net.corner_difference::<A>(&self.rules, corner);
        [at(0), at(1), at(2), A::Point::zero()]
    }

    fn net_place(&self, net: &Self::Net) -> (Corners, u32) {
        (net.corners, net.steps)
    }

    fn mesh_point(&self, face: u32, at: [f64; 2]) -> A::Point {
        let mut net = TriangleNet::default();
        net.gather::<A>(
            &self.rules,
            self.mesh.topology,
            self.mesh.positions,
            face,
            self.mesh.compared,
        );
        net.facet_point([&A::dyadic(at[0]), &A::dyadic(at[1])])
    }

    fn locate(&self, _: u32, at: [f64; 2]) -> (Option<u32>, [f64; 2]) {
        (None, at)
    }
}
