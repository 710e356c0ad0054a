//! Catmull-Clark: a quad with the full fans of its four corners, and the first step of any polygon.
//!
//! Orientation: corners counterclockwise. The fan of a corner holds its edge neighbours
//! counterclockwise and, between neighbours k and k + 1, the diagonal vertex of that quad (in a
//! polygon fan: the new face point). `at` is the place of the NEXT corner among the edge
//! neighbours, so that `at + 1` is the previous corner.

use num_traits::Zero;

use super::{Corners, Sink, Space};
use crate::bernstein::tensor::{Bicubic, Tensor};
use crate::bernstein::{from_net, mid_parameter, midpoint};
use crate::mesh::{NONE, Point, Topology};
use crate::scalar::{Field, Module};
use crate::scheme::{CornerRule, StarMask, boundary, catmull_clark};

/// The neighbours of a vertex; an open fan runs from boundary to boundary and has one `across`
/// less than `edges`.
#[derive(Clone, Debug)]
pub struct Fan<V> {
    /// Edge neighbours.
    pub edges: Vec<V>,
    /// Diagonal vertices, or new face points.
    pub across: Vec<V>,
    /// Place of the next corner of the face among `edges`.
    pub at: usize,
    /// Whether the vertex is interior.
    pub closed: bool,
}

impl<V> Default for Fan<V> {
    fn default() -> Self {
        Fan {
            edges: Vec::new(),
            across: Vec::new(),
            at: 0,
            closed: true,
        }
    }
}

struct FanView<'a, V> {
    edges: &'a [V],
    across: &'a [V],
    at: usize,
    closed: bool,
}

impl<V> Clone for FanView<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for FanView<'_, V> {}

impl<V> Fan<V> {
    fn view(&self) -> FanView<'_, V> {
        FanView {
            edges: &self.edges,
            across: &self.across,
            at: self.at,
            closed: self.closed,
        }
    }

    fn clear(&mut self) {
        self.edges.clear();
        self.across.clear();
    }
}

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

/// Vertex mask, limit mask over diagonals, and limit mask over face points, of one valence.
type Masks<S> = (StarMask<S>, StarMask<S>, StarMask<S>);

/// Catmull-Clark's rules on one mesh: its masks, by valence.
#[derive(Clone, Debug)]
pub struct CatmullClarkRules<S> {
    corner_rule: CornerRule,
    masks: Vec<Option<Masks<S>>>,
}

impl<S: Field> CatmullClarkRules<S> {
    /// The masks of all interior valences and face sizes (a face point has the face's size as its
    /// valence), and of 4.
    pub fn new(corner_rule: CornerRule, topology: &Topology) -> Self {
        let mut masks: Vec<Option<Masks<S>>> = Vec::new();
        let mut want = |n: u32| {
            if masks.len() <= n as usize {
                masks.resize(n as usize + 1, None);
            }
            if masks[n as usize].is_none() {
                masks[n as usize] = Some((
                    catmull_clark::vertex_mask(n),
                    catmull_clark::limit_mask(n),
                    catmull_clark::limit_mask_polygons(n),
                ));
            }
        };
        want(4);
        for vertex in 0..topology.vertex_count() {
            if !topology.is_boundary_vertex(vertex) && topology.valence(vertex) >= 2 {
                want(topology.valence(vertex));
            }
        }
        if topology.arity() != Some(4) {
            for face in 0..topology.face_count() {
                want(topology.face_size(face));
            }
        }
        CatmullClarkRules { corner_rule, masks }
    }

    fn interior(&self, n: usize) -> &Masks<S> {
        self.masks[n]
            .as_ref()
            .expect("a mask for each interior valence of the mesh")
    }

    fn is_pinned<V>(&self, fan: FanView<'_, V>) -> bool {
        !fan.closed && fan.edges.len() == 2 && self.corner_rule == CornerRule::Sharp
    }

    fn is_regular<V>(&self, fan: FanView<'_, V>) -> bool {
        match (fan.closed, fan.edges.len()) {
            (true, n) => n == 4,
            (false, 3) => true,
            _ => self.is_pinned(fan),
        }
    }

    /// The point of a boundary vertex under `rule` (refinement or limit), `None` if interior.
    fn on_boundary<V: Module<S>>(
        &self,
        p: &V,
        fan: FanView<'_, V>,
        rule: fn(&V, &V, &V) -> V,
    ) -> Option<V> {
        if fan.closed {
            None
        } else if self.is_pinned(fan) {
            Some(p.clone())
        } else {
            Some(rule(p, &fan.edges[0], &fan.edges[fan.edges.len() - 1]))
        }
    }

    /// `faces` are new face points.
    fn new_vertex<V: Module<S>>(&self, p: &V, fan: FanView<'_, V>, faces: &[V]) -> V {
        self.on_boundary(p, fan, boundary::vertex_point::<S, V>)
            .unwrap_or_else(|| {
                self.interior(fan.edges.len())
                    .0
                    .apply(p, &sum(fan.edges), &sum(faces))
            })
    }

    fn limit_quads<V: Module<S>>(&self, p: &V, fan: FanView<'_, V>) -> V {
        self.on_boundary(p, fan, boundary::limit_point::<S, V>)
            .unwrap_or_else(|| {
                self.interior(fan.edges.len())
                    .1
                    .apply(p, &sum(fan.edges), &sum(fan.across))
            })
    }

    fn limit_polygons<V: Module<S>>(&self, p: &V, fan: FanView<'_, V>) -> V {
        self.on_boundary(p, fan, boundary::limit_point::<S, V>)
            .unwrap_or_else(|| {
                self.interior(fan.edges.len())
                    .2
                    .apply(p, &sum(fan.edges), &sum(fan.across))
            })
    }
}

#[inline]
fn sum<V: Zero + for<'a> std::ops::Add<&'a V, Output = V>>(points: &[V]) -> V {
    points.iter().fold(V::zero(), |total, p| total + p)
}

/// New edge points of all edges at a corner; `faces` are new face points.
fn edge_points<S: Field, V: Module<S>>(p: &V, fan: FanView<'_, V>, faces: &[V], out: &mut Vec<V>) {
    let n = fan.edges.len();
    out.clear();
    out.extend((0..n).map(|k| {
        if !fan.closed && (k == 0 || k == n - 1) {
            boundary::edge_point(p, &fan.edges[k])
        } else {
            let before = &faces[if k == 0 { n - 1 } else { k - 1 }];
            catmull_clark::edge_point(p, &fan.edges[k], before, &faces[k])
        }
    }));
}

/// The four edge neighbours from the next corner on and the four diagonals, with ghosts beyond a
/// boundary: `ghost(i, -1) = 2 (i, 0) - (i, 1)`, along both directions at a pinned corner.
fn full_fan<S: Field, V: Module<S>>(p: &V, fan: FanView<'_, V>) -> ([V; 4], [V; 4]) {
    let (e, d) = (fan.edges, fan.across);
    let mirror = |center: &V, inner: &V| center.clone() + center - inner;
    let (edges, across): ([V; 4], [V; 4]) = match e.len() {
        4 => (
            std::array::from_fn(|k| e[k].clone()),
            std::array::from_fn(|k| d[k].clone()),
        ),
        3 => (
            [e[0].clone(), e[1].clone(), e[2].clone(), mirror(p, &e[1])],
            [
                d[0].clone(),
                d[1].clone(),
                mirror(&e[2], &d[1]),
                mirror(&e[0], &d[0]),
            ],
        ),
        _ => {
            // One quad (p, e0, d0, e1): (1,0) = e0, (0,1) = e1, (1,1) = d0.
            let (west, south) = (mirror(p, &e[0]), mirror(p, &e[1]));
            let (north_west, south_east) = (mirror(&e[1], &d[0]), mirror(&e[0], &d[0]));
            let south_west = mirror(&west, &north_west);
            (
                [e[0].clone(), e[1].clone(), west, south],
                [d[0].clone(), north_west, south_west, south_east],
            )
        }
    };
    let at = fan.at;
    (
        std::array::from_fn(|k| edges[(at + k) % 4].clone()),
        std::array::from_fn(|k| across[(at + k) % 4].clone()),
    )
}

/// S over a quad whose four corners are regular; u towards corner 1, v towards corner 3.
fn regular_patch<S: Field, V: Module<S>>(corner: [&V; 4], fan: [FanView<'_, V>; 4]) -> Bicubic<V> {
    // Places of a corner and of its edge neighbours 2, 3 and diagonal 2 in the 4 x 4 grid 4 j + i.
    const PLACE: [[usize; 4]; 4] = [[5, 4, 1, 0], [6, 2, 7, 3], [10, 11, 14, 15], [9, 13, 8, 12]];
    let mut grid: [V; 16] = std::array::from_fn(|_| V::zero());
    for i in 0..4 {
        let ([_, _, e2, e3], [_, _, d2, _]) = full_fan::<S, V>(corner[i], fan[i]);
        let [at, at_e2, at_e3, at_d2] = PLACE[i];
        grid[at] = corner[i].clone();
        grid[at_e2] = e2;
        grid[at_e3] = e3;
        grid[at_d2] = d2;
    }
    from_net::bicubic::<S, V>(&grid)
}

/// Scratch storage of [`split`] and [`split_polygon`].
#[derive(Clone, Debug)]
pub struct Scratch<V> {
    faces: Vec<Vec<V>>,
    edges: Vec<Vec<V>>,
    vertex: Vec<V>,
    edge: Vec<V>,
    facet_edge: Vec<V>,
}

impl<V> Default for Scratch<V> {
    fn default() -> Self {
        Scratch {
            faces: Vec::new(),
            edges: Vec::new(),
            vertex: Vec::new(),
            edge: Vec::new(),
            facet_edge: Vec::new(),
        }
    }
}

impl<V> Scratch<V> {
    fn reserve(&mut self, corners: usize) {
        self.faces
            .resize_with(corners.max(self.faces.len()), Vec::new);
        self.edges
            .resize_with(corners.max(self.edges.len()), Vec::new);
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

    /// Gathers a quad of the mesh among quads. With `limit`, F takes the limit positions.
    pub fn gather<A>(
        &mut self,
        rules: &CatmullClarkRules<A::Scalar>,
        topology: &Topology,
        positions: &[Point<A::Scalar>],
        face: u32,
        limit: bool,
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
            self.facet[i] = if limit {
                rules.limit_quads(&self.corner[i], self.fan[i].view())
            } else {
                self.corner[i].clone()
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
        let mut largest = A::zero();
        for point in self.points() {
            for f in &self.facet {
                let square = A::upper(&(point.clone() - f));
                if square > largest {
                    largest = square;
                }
            }
        }
        largest
    }

    /// S - F at the irregular corner (`irregular` of a net that a split yields).
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

    /// Gathers any polygon of the mesh. With `limit`, F takes the limit positions.
    pub fn gather<A>(
        &mut self,
        rules: &CatmullClarkRules<A::Scalar>,
        topology: &Topology,
        positions: &[Point<A::Scalar>],
        face: u32,
        limit: bool,
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
            self.facet.push(if limit {
                rules.limit_polygons(&self.corner[i], self.fan[i].view())
            } else {
                self.corner[i].clone()
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

/// One patch if all corners are regular, otherwise one Catmull-Clark step: a patch or a net for each
/// corner.
pub fn split<A, V>(
    rules: &CatmullClarkRules<A::Scalar>,
    net: &QuadNet<V>,
    scratch: &mut Scratch<V>,
    sink: &mut impl Sink<Bicubic<V>, QuadNet<V>>,
) where
    A: Space<Point = V>,
    V: Module<A::Scalar>,
{
    let view: [FanView<'_, V>; 4] = std::array::from_fn(|i| net.fan[i].view());
    if view.iter().all(|fan| rules.is_regular(*fan)) {
        let [a, b, c, d] = &net.corner;
        let mut patch = regular_patch::<A::Scalar, V>([a, b, c, d], view);
        let facet = Tensor::from_bilinear::<A::Scalar>(&net.facet);
        patch.subtract::<A::Scalar>(&facet);
        sink.patch(&patch, net.corners, net.steps);
        return;
    }
    scratch.reserve(4);
    for ((p, fan), out) in net.corner.iter().zip(view).zip(&mut scratch.faces) {
        let n = fan.edges.len();
        out.clear();
        out.extend(fan.across.iter().enumerate().map(|(k, diagonal)| {
            catmull_clark::quad_point(
                p,
                &fan.edges[k],
                diagonal,
                &fan.edges[if k + 1 == n { 0 } else { k + 1 }],
            )
        }));
    }
    let [a, b, c, d] = &net.corner;
    let center = catmull_clark::quad_point(a, b, c, d);
    let [a, b, c, d] = &net.facet;
    let facet_center = catmull_clark::quad_point(a, b, c, d);
    let p = &net.corners;
    let middle = |i: usize| mid_parameter(p[i], p[(i + 1) % 4]);
    let center_parameter = mid_parameter(p[0], p[2]);
    let corners = |i: usize| [p[i], middle(i), center_parameter, middle((i + 3) % 4)];
    let faces = std::mem::take(&mut scratch.faces);
    step::<A, V>(
        rules,
        Stage {
            corner: &net.corner,
            fan: &net.fan,
            faces: &faces,
            center,
            facet: &net.facet,
            facet_center,
        },
        scratch,
        corners,
        net.steps + 1,
        sink,
    );
    scratch.faces = faces;
}

/// The first step of any polygon: a patch or a net for each corner, its quarter.
pub fn split_polygon<A, V>(
    rules: &CatmullClarkRules<A::Scalar>,
    net: &PolygonNet<V>,
    scratch: &mut Scratch<V>,
    sink: &mut impl Sink<Bicubic<V>, QuadNet<V>>,
) where
    A: Space<Point = V>,
    V: Module<A::Scalar>,
{
    scratch.reserve(net.corner.len());
    let mut faces = std::mem::take(&mut scratch.faces);
    for (out, fan) in faces.iter_mut().zip(&net.fan) {
        out.clear();
        out.extend_from_slice(&fan.across);
    }
    // Each quarter has the unit square of its own; its number is told by an offset of 2 in u.
    let corners = |i: usize| {
        let u = 2.0 * i as f64;
        [[u, 0.0], [u + 1.0, 0.0], [u + 1.0, 1.0], [u, 1.0]]
    };
    let m = net.corner.len();
    step::<A, V>(
        rules,
        Stage {
            corner: &net.corner,
            fan: &net.fan[..m],
            faces: &faces,
            center: net.center.clone(),
            facet: &net.facet,
            facet_center: net.facet_center.clone(),
        },
        scratch,
        corners,
        1,
        sink,
    );
    scratch.faces = faces;
}

/// A polygon with everything that its children need.
struct Stage<'a, V> {
    corner: &'a [V],
    fan: &'a [Fan<V>],
    /// New face points of the faces round each corner.
    faces: &'a [Vec<V>],
    /// The polygon's own new face point.
    center: V,
    facet: &'a [V],
    facet_center: V,
}

fn step<A, V>(
    rules: &CatmullClarkRules<A::Scalar>,
    stage: Stage<'_, V>,
    scratch: &mut Scratch<V>,
    corners: impl Fn(usize) -> Corners,
    steps: u32,
    sink: &mut impl Sink<Bicubic<V>, QuadNet<V>>,
) where
    A: Space<Point = V>,
    V: Module<A::Scalar>,
{
    let m = stage.corner.len();
    let Scratch {
        edges,
        vertex,
        edge,
        facet_edge,
        ..
    } = scratch;
    vertex.clear();
    edge.clear();
    facet_edge.clear();
    for (i, own_edges) in edges.iter_mut().enumerate().take(m) {
        let (p, fan, faces) = (&stage.corner[i], stage.fan[i].view(), &stage.faces[i]);
        edge_points::<A::Scalar, V>(p, fan, faces, own_edges);
        vertex.push(rules.new_vertex(p, fan, faces));
        edge.push(own_edges[fan.at].clone());
        facet_edge.push(midpoint::<A::Scalar, V>(
            &stage.facet[i],
            &stage.facet[(i + 1) % m],
        ));
    }
    // Fan of edge point i (from corner i to i + 1): interior edges [center, V_i, g, V_(i+1)] with
    // diagonals [e_(i-1), e(i, at - 1), e(i+1, at + 2), e_(i+1)], g the face point beyond the edge;
    // boundary [V_(i+1), center, V_i] with [e_(i+1), e_(i-1)].
    let around_edge = |i: usize| -> ([V; 4], [V; 4], bool) {
        let (next, prev) = ((i + 1) % m, (i + m - 1) % m);
        let (a, b, center) = (
            vertex[i].clone(),
            vertex[next].clone(),
            stage.center.clone(),
        );
        let (e_prev, e_next) = (edge[prev].clone(), edge[next].clone());
        let (fan, at, at_next) = (&stage.fan[i], stage.fan[i].at, stage.fan[next].at);
        if !fan.closed && at == 0 {
            (
                [b, center, a, V::zero()],
                [e_next, e_prev, V::zero(), V::zero()],
                false,
            )
        } else {
            let (n, n_next, faces) = (edges[i].len(), edges[next].len(), &stage.faces[i]);
            let beyond = faces[if at == 0 { faces.len() - 1 } else { at - 1 }].clone();
            let near = edges[i][(at + n - 1) % n].clone();
            let far = edges[next][(at_next + 2) % n_next].clone();
            ([center, a, beyond, b], [e_prev, near, far, e_next], true)
        }
    };
    fn view<V>(fan: &([V; 4], [V; 4], bool), closed_at: usize, open_at: usize) -> FanView<'_, V> {
        if fan.2 {
            FanView {
                edges: &fan.0,
                across: &fan.1,
                at: closed_at,
                closed: true,
            }
        } else {
            FanView {
                edges: &fan.0[..3],
                across: &fan.1[..2],
                at: open_at,
                closed: false,
            }
        }
    }
    // Fan of the centre: edge points 0..m with V_(k+1) between k and k + 1.
    let mut center_across = sink.spare();
    center_across.fan[0].clear();
    center_across.fan[0]
        .across
        .extend((0..m).map(|k| vertex[(k + 1) % m].clone()));
    let mut before = around_edge(m - 1);
    for i in 0..m {
        let prev = (i + m - 1) % m;
        let after = around_edge(i);
        let own = FanView {
            edges: &edges[i],
            across: &stage.faces[i],
            at: stage.fan[i].at,
            closed: stage.fan[i].closed,
        };
        let center_fan = FanView {
            edges: edge,
            across: &center_across.fan[0].across,
            at: prev,
            closed: true,
        };
        let fans = [own, view(&after, 0, 1), center_fan, view(&before, 3, 0)];
        let points = [&vertex[i], &edge[i], &stage.center, &edge[prev]];
        let facet = [
            stage.facet[i].clone(),
            facet_edge[i].clone(),
            stage.facet_center.clone(),
            facet_edge[prev].clone(),
        ];
        if fans.iter().all(|fan| rules.is_regular(*fan)) {
            let mut patch = regular_patch::<A::Scalar, V>(points, fans);
            let facet = Tensor::from_bilinear::<A::Scalar>(&facet);
            patch.subtract::<A::Scalar>(&facet);
            sink.patch(&patch, corners(i), steps);
        } else {
            let mut child = sink.spare();
            child.corner = points.map(Clone::clone);
            for (fan, view) in child.fan.iter_mut().zip(fans) {
                fan.clear();
                fan.edges.extend_from_slice(view.edges);
                fan.across.extend_from_slice(view.across);
                (fan.at, fan.closed) = (view.at, view.closed);
            }
            child.facet = facet;
            child.corners = corners(i);
            child.steps = steps;
            sink.net(child);
        }
        before = after;
    }
    sink.discard(center_across);
}
