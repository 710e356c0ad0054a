//! The faces of a mesh under each scheme, as patches and nets of the vector field S - F.

use num_traits::Zero;

use crate::bernstein::Patch;
use crate::bernstein::tensor::{Bicubic, Biquadratic};
use crate::bernstein::triangle::QuarticTriangle;
use crate::mesh::{Point, Topology};
use crate::patch::quad_net::{self, CatmullClarkRules, PolygonNet, QuadNet};
use crate::patch::quarter_net::{self, DooSabinRules, QuarterNet};
use crate::patch::triangle_net::{self, LoopRules, TriangleNet};
use crate::patch::{Corners, Sink, Space};

/// Which mesh the surface is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Against {
    /// The control mesh.
    Control,
    /// The limit mesh: the same faces, with vertices at their limit positions.
    Limit,
}

impl Against {
    /// The name used on the command line and in every file.
    pub fn name(self) -> &'static str {
        match self {
            Against::Control => "control",
            Against::Limit => "limit",
        }
    }
}

/// What a gathered face tells the rounding bound: the largest coordinate, and n + m.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gathered {
    /// The largest coordinate relative to the face's first corner.
    pub size: f64,
    /// The largest fan plus the largest face of the net.
    pub arity: u32,
}

/// A mesh under one scheme, seen face by face.
pub trait Model<A: Space>: Sync {
    /// Polynomial pieces of S - F.
    type Patch: Patch<A::Scalar, A::Point> + Send;
    /// Pieces that need another step.
    type Net: Default + Clone + Send;
    /// Storage reused from face to face.
    type Scratch: Default + Send;

    /// Number of faces.
    fn face_count(&self) -> u32;

    /// Yields patches and nets that cover the face. Yields nothing where the face has no surface.
    fn open(
        &self,
        face: u32,
        scratch: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    ) -> Gathered;

    /// Splits a net by one step.
    fn split(
        &self,
        net: &Self::Net,
        scratch: &mut Self::Scratch,
        sink: &mut impl Sink<Self::Patch, Self::Net>,
    );

    /// Whether [`Model::split`] yields patches only, so that it pays to split at once, or whether
    /// the net has no useful bound yet.
    fn splits_at_once(&self, net: &Self::Net) -> bool;

    /// An upper bound of |S - F|^2 over the net's piece (hull argument).
    fn net_upper(&self, net: &Self::Net) -> A::Square;

    /// S - F at the irregular point of the net's piece, with its parameters.
    fn net_value(&self, net: &Self::Net) -> (A::Point, [f64; 2]);

    /// F at parameters of the face, relative to the face's first corner.
    fn mesh_point(&self, face: u32, at: [f64; 2]) -> A::Point;

    /// Splits the parameters of a witness into a quarter of the face, if it is measured by quarters,
    /// and local parameters.
    fn locate(&self, face: u32, at: [f64; 2]) -> (Option<u32>, [f64; 2]);
}

/// The mesh of a model.
#[derive(Debug)]
pub struct MeshView<'a, A: Space> {
    /// Connectivity.
    pub topology: &'a Topology,
    /// Positions in the mesh's own unit.
    pub positions: &'a [Point<A::Scalar>],
    /// Control or limit mesh.
    pub against: Against,
}

impl<A: Space> MeshView<'_, A> {
    fn limit(&self) -> bool {
        self.against == Against::Limit
    }
}

fn gathered<'a, A: Space>(points: impl Iterator<Item = &'a A::Point>, arity: u32) -> Gathered
where
    A::Point: 'a,
{
    Gathered {
        size: points.map(|p| A::magnitude(p)).fold(0.0, f64::max),
        arity,
    }
}

fn largest_valence(topology: &Topology, face: u32) -> u32 {
    topology
        .halfedges(face)
        .map(|h| topology.valence(topology.origin(h)))
        .max()
        .unwrap_or(0)
}

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
        let (topology, limit) = (self.mesh.topology, self.mesh.limit());
        let positions = self.mesh.positions;
        if let Some((patch, size)) =
            triangle_net::regular_face::<A, _>(topology, positions, face, limit)
        {
            sink.patch(&patch, UNIT_TRIANGLE, 0);
            return Gathered { size, arity: 6 + 3 };
        }
        scratch
            .net
            .gather::<A>(&self.rules, topology, self.mesh.positions, face, limit);
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
        (net.corner_difference::<A>(&self.rules), net.corners[0])
    }

    fn mesh_point(&self, face: u32, at: [f64; 2]) -> A::Point {
        let mut net = TriangleNet::default();
        net.gather::<A>(
            &self.rules,
            self.mesh.topology,
            self.mesh.positions,
            face,
            self.mesh.limit(),
        );
        net.facet_point([&A::dyadic(at[0]), &A::dyadic(at[1])])
    }

    fn locate(&self, _: u32, at: [f64; 2]) -> (Option<u32>, [f64; 2]) {
        (None, at)
    }
}

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
        let (topology, positions, limit) =
            (self.mesh.topology, self.mesh.positions, self.mesh.limit());
        let valence = largest_valence(topology, face);
        if QuadNet::<A::Point>::applies(topology, face) {
            scratch
                .net
                .gather::<A>(&self.rules, topology, positions, face, limit);
            quad_net::split::<A, _>(&self.rules, &scratch.net, &mut scratch.split, sink);
            gathered::<A>(scratch.net.points(), valence + 4)
        } else {
            scratch
                .polygon
                .gather::<A>(&self.rules, topology, positions, face, limit);
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

    fn mesh_point(&self, face: u32, at: [f64; 2]) -> A::Point {
        let (topology, positions, limit) =
            (self.mesh.topology, self.mesh.positions, self.mesh.limit());
        let (quarter, [u, v]) = self.locate(face, at);
        let at = [&A::dyadic(u), &A::dyadic(v)];
        match quarter {
            None => {
                let mut net = QuadNet::default();
                net.gather::<A>(&self.rules, topology, positions, face, limit);
                net.facet_point(at)
            }
            Some(quarter) => {
                let mut net = PolygonNet::default();
                net.gather::<A>(&self.rules, topology, positions, face, limit);
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

/// Quarter i of a polygon has its unit square at u = 2 i .. 2 i + 1.
fn quarter_of(at: [f64; 2]) -> (Option<u32>, [f64; 2]) {
    let quarter = (at[0] / 2.0).floor();
    (Some(quarter as u32), [at[0] - 2.0 * quarter, at[1]])
}

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
    net: QuarterNet<V>,
    facet: Vec<V>,
}

impl<V: Zero> Default for DooSabinScratch<V> {
    fn default() -> Self {
        DooSabinScratch {
            net: QuarterNet::default(),
            facet: Vec::new(),
        }
    }
}

impl<A: Space> DooSabinModel<'_, A> {
    /// F at the corners of the face.
    fn gather_facet(&self, face: u32, scratch: &mut DooSabinScratch<A::Point>) -> Gathered {
        let (topology, positions) = (self.mesh.topology, self.mesh.positions);
        let halfedges = topology.halfedges(face);
        let base = &positions[topology.origin(halfedges.start) as usize];
        let DooSabinScratch { net, facet } = scratch;
        let mut result = Gathered::default();
        facet.clear();
        for h in halfedges {
            net.gather::<A>(topology, positions, h, base);
            result.size = net
                .points()
                .map(|p| A::magnitude(p))
                .fold(result.size, f64::max);
            result.arity = result.arity.max(net.arity());
            facet.push(if self.mesh.limit() {
                net.limit(&self.rules)
            } else {
                A::lift(&positions[topology.origin(h) as usize], base)
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
        let (topology, positions) = (self.mesh.topology, self.mesh.positions);
        let halfedges = topology.halfedges(face);
        let base = &positions[topology.origin(halfedges.start) as usize];
        if halfedges
            .clone()
            .all(|h| topology.is_boundary_vertex(topology.origin(h)))
        {
            return Gathered::default();
        }
        let result = self.gather_facet(face, scratch);
        let DooSabinScratch { net, facet } = scratch;
        for (i, h) in halfedges.enumerate() {
            if topology.is_boundary_vertex(topology.origin(h)) {
                continue;
            }
            net.gather::<A>(topology, positions, h, base);
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
