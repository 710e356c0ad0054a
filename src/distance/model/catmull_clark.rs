//! The faces of a mesh under Catmull-Clark.

use num_traits::Zero;

use super::{Gathered, MeshView, Model, gathered, largest_valence, quarter_of};
use crate::bernstein::tensor::Bicubic;
use crate::patch::quad_net::{self, CatmullClarkRules, PolygonNet, QuadNet};
use crate::patch::{Corners, Sink, Space};

/// Parameters of a quad's corners.
const UNIT_SQUARE: Corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// Catmull-Clark. Parameters `(u, v)` on the unit square of a quad, u towards its second corner and
/// v towards its fourth; other polygons by quarters.
#[derive(Debug)]
pub struct CatmullClarkModel<'a, A: Space> {
    /// The mesh.
    pub mesh: MeshView<'a, A>,
    /// The masks.
    pub rules: CatmullClarkRules<A::Scalar>,
}

/// Storage of [`CatmullClarkModel`].
#[derive(Clone, Debug)]
pub struct CatmullClarkScratch<V> {
    net: QuadNet<V>,
    polygon: PolygonNet<V>,
    split: quad_net::Scratch<V>,
}

impl<V: Zero> Default for CatmullClarkScratch<V> {
    fn default() -> Self {
        CatmullClarkScratch {
            net: QuadNet::default(),
            polygon: PolygonNet::default(),
            split: quad_net::Scratch::default(),
        }
    }
}

impl<A: Space> Model<A> for CatmullClarkModel<'_, A> {
    type Patch = Bicubic<A::Point>;
    type Net = QuadNet<A::Point>;
    type Scratch = CatmullClarkScratch<A::Point>;

    fn face_count(&self) -> u32 {
        self.mesh.topology.face_count()
    }

    fn open(
        &self,
        face: u32,
        scratch: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    ) -> Gathered {
        let (topology, positions, compared) =
            (self.mesh.topology, self.mesh.positions, self.mesh.compared);
        if let Some((patch, size)) =
            quad_net::regular_face::<A, _>(topology, positions, face, compared)
        {
            sink.patch(&patch, UNIT_SQUARE, 0);
            return Gathered { size, arity: 4 + 4 };
        }
        let valence = largest_valence(topology, face);
        if QuadNet::<A::Point>::applies(topology, face) {
            scratch
                .net
                .gather::<A>(&self.rules, topology, positions, face, compared);
            quad_net::split::<A, _>(&self.rules, &scratch.net, &mut scratch.split, sink);
            gathered::<A>(scratch.net.points(), valence + 4)
        } else {
            scratch
                .polygon
                .gather::<A>(&self.rules, topology, positions, face, compared);
            quad_net::split_polygon::<A, _>(
                &self.rules,
                &scratch.polygon,
                &mut scratch.split,
                sink,
            );
            // Face points of the fan are means of points that may lie further out: take those too.
            let (mut size, mut sides) = (0.0_f64, topology.face_size(face));
            let base = &positions[topology.origin(topology.halfedges(face).start) as usize];
            for h in topology.halfedges(face) {
                topology.fan(topology.origin(h)).for_each(|out| {
                    let around = topology.face_of(out);
                    sides = sides.max(topology.face_size(around));
                    for g in topology.halfedges(around) {
                        let p = A::lift(&positions[topology.origin(g) as usize], base);
                        size = size.max(A::magnitude(&p));
                    }
                });
            }
            // The face's own size is the valence of its face point.
            Gathered {
                size,
                arity: valence.max(sides) + sides,
            }
        }
    }

    fn split(
        &self,
        net: &Self::Net,
        scratch: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    ) {
        quad_net::split::<A, _>(&self.rules, net, &mut scratch.split, sink);
    }

    fn splits_at_once(&self, net: &Self::Net) -> bool {
        net.irregular(&self.rules).0 != 1
    }

    fn net_upper(&self, net: &Self::Net) -> A::Square {
        net.hull_bound::<A>()
    }

    fn net_value(&self, net: &Self::Net) -> (A::Point, [f64; 2]) {
        let (_, corner) = net.irregular(&self.rules);
        (
            net.corner_difference::<A>(&self.rules, corner),
            net.corners[corner],
        )
    }

    fn net_points<'a>(&self, net: &'a Self::Net) -> impl Iterator<Item = &'a A::Point>
    where
        A::Point: 'a,
    {
        net.points()
    }

    fn net_corners(&self, net: &Self::Net) -> [A::Point; 4] {
        std::array::from_fn(|corner| net.corner_difference::<A>(&self.rules, corner))
    }

    fn net_place(&self, net: &Self::Net) -> (Corners, u32) {
        (net.corners, net.steps)
    }

    fn mesh_point(&self, face: u32, at: [f64; 2]) -> A::Point {
        let (topology, positions, compared) =
            (self.mesh.topology, self.mesh.positions, self.mesh.compared);
        let (quarter, [u, v]) = self.locate(face, at);
        let at = [&A::dyadic(u), &A::dyadic(v)];
        match quarter {
            None => {
                let mut net = QuadNet::default();
                net.gather::<A>(&self.rules, topology, positions, face, compared);
                net.facet_point(at)
            }
            Some(quarter) => {
                let mut net = PolygonNet::default();
                net.gather::<A>(&self.rules, topology, positions, face, compared);
                net.facet_point(quarter as usize, at)
            }
        }
    }

    fn locate(&self, face: u32, at: [f64; 2]) -> (Option<u32>, [f64; 2]) {
        if QuadNet::<A::Point>::applies(self.mesh.topology, face) {
            (None, at)
        } else {
            quarter_of(at)
        }
    }
}
