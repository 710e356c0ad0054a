//! Loop: a triangle with the full rings of its three corners.
//!
//! Orientation: corners A, B, C counterclockwise. The ring of a corner is counterclockwise; `at`
//! is the place of the NEXT corner in it (B for A), so that `at + 1` is the previous corner, and
//! `at + 2`, `at - 1` are the vertices opposite the face's edges.

use num_traits::Zero;

use super::{Corners, Sink, Space};
use crate::bernstein::triangle::QuarticTriangle;
use crate::bernstein::{from_net, mid_parameter, midpoint};
use crate::mesh::{NONE, Point, Topology};
use crate::scalar::{Field, Module};
use crate::scheme::{CornerRule, LoopWeights, StarMask, boundary, loop_scheme};

/// The neighbours of a vertex, counterclockwise; an open ring runs from boundary to boundary.
#[derive(Clone, Debug)]
pub struct Ring<V> {
    /// The neighbours.
    pub points: Vec<V>,
    /// Place of the next corner of the face.
    pub at: usize,
    /// Whether the vertex is interior.
    pub closed: bool,
}

impl<V> Default for Ring<V> {
    fn default() -> Self {
        Ring {
            points: Vec::new(),
            at: 0,
            closed: true,
        }
    }
}

/// A borrowed ring.
struct RingView<'a, V> {
    points: &'a [V],
    at: usize,
    closed: bool,
}

impl<V> Clone for RingView<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for RingView<'_, V> {}

impl<V> Ring<V> {
    fn view(&self) -> RingView<'_, V> {
        RingView {
            points: &self.points,
            at: self.at,
            closed: self.closed,
        }
    }
}

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

/// Loop's rules on one mesh: its masks, by valence.
#[derive(Clone, Debug)]
pub struct LoopRules<S> {
    corner_rule: CornerRule,
    /// Vertex and limit mask of each interior valence that occurs.
    masks: Vec<Option<(StarMask<S>, StarMask<S>)>>,
}

impl<S: Field> LoopRules<S> {
    /// The masks of all interior valences in the mesh, and of 6.
    ///
    /// # Errors
    /// The valence, if and only if the arithmetic cannot represent its masks.
    pub fn new(
        weights: LoopWeights,
        corner_rule: CornerRule,
        topology: &Topology,
    ) -> Result<Self, u32> {
        let mut masks: Vec<Option<(StarMask<S>, StarMask<S>)>> = vec![None; 7];
        for vertex in 0..=topology.vertex_count() {
            // One round more than there are vertices: the valence 6 of every new vertex.
            let n = if vertex == topology.vertex_count() {
                6
            } else {
                topology.valence(vertex)
            };
            let wanted = n >= 3
                && (vertex == topology.vertex_count() || !topology.is_boundary_vertex(vertex));
            if masks.len() <= n as usize {
                masks.resize(n as usize + 1, None);
            }
            if wanted && masks[n as usize].is_none() {
                let vertex_mask = loop_scheme::vertex_mask(weights, n).ok_or(n)?;
                let limit_mask = loop_scheme::limit_mask(weights, n).ok_or(n)?;
                masks[n as usize] = Some((vertex_mask, limit_mask));
            }
        }
        Ok(LoopRules { corner_rule, masks })
    }

    fn interior(&self, n: usize) -> &(StarMask<S>, StarMask<S>) {
        self.masks[n]
            .as_ref()
            .expect("a mask for each interior valence of the mesh")
    }

    fn is_regular<V>(&self, ring: RingView<'_, V>) -> bool {
        match (ring.closed, ring.points.len()) {
            (true, n) => n == 6,
            (false, 4) => true,
            (false, n) => n == 2 && self.corner_rule == CornerRule::Sharp,
        }
    }

    fn is_pinned<V>(&self, ring: RingView<'_, V>) -> bool {
        !ring.closed && ring.points.len() == 2 && self.corner_rule == CornerRule::Sharp
    }

    fn new_vertex<V: Module<S>>(&self, p: &V, ring: RingView<'_, V>) -> V {
        if ring.closed {
            self.interior(ring.points.len())
                .0
                .apply_ring(p, &sum(ring.points))
        } else if self.is_pinned(ring) {
            p.clone()
        } else {
            boundary::vertex_point(p, &ring.points[0], &ring.points[ring.points.len() - 1])
        }
    }

    fn limit<V: Module<S>>(&self, p: &V, ring: RingView<'_, V>) -> V {
        if ring.closed {
            self.interior(ring.points.len())
                .1
                .apply_ring(p, &sum(ring.points))
        } else if self.is_pinned(ring) {
            p.clone()
        } else {
            boundary::limit_point(p, &ring.points[0], &ring.points[ring.points.len() - 1])
        }
    }
}

#[inline]
fn sum<V: Zero + Clone + for<'a> std::ops::Add<&'a V, Output = V>>(points: &[V]) -> V {
    points.iter().fold(V::zero(), |total, p| total + p)
}

/// The edge points from a corner to each of its neighbours.
fn edge_points<S: Field, V: Module<S>>(p: &V, ring: RingView<'_, V>, out: &mut Vec<V>) {
    let (r, n) = (ring.points, ring.points.len());
    out.clear();
    out.extend((0..n).map(|k| {
        if !ring.closed && (k == 0 || k == n - 1) {
            boundary::edge_point(p, &r[k])
        } else {
            let before = &r[if k == 0 { n - 1 } else { k - 1 }];
            let after = &r[if k + 1 == n { 0 } else { k + 1 }];
            loop_scheme::edge_point(p, &r[k], before, after)
        }
    }));
}

/// Neighbours of a regular corner, counted from the next corner on, with ghosts beyond a boundary.
#[inline]
fn neighbours<S: Field, V: Module<S>, const N: usize>(
    p: &V,
    ring: RingView<'_, V>,
    wanted: [usize; N],
) -> [V; N] {
    let pick = |points: &[V; 6]| {
        wanted.map(|k| {
            let at = ring.at + k;
            points[if at < 6 { at } else { at - 6 }].clone()
        })
    };
    match ring.points.try_into() {
        Ok(points) => pick(points),
        Err(_) => pick(&with_ghosts::<S, V>(p, ring.points)),
    }
}

/// The six neighbours of a regular boundary vertex.
///
/// Ghosts: `p + r_0 - r_1` across a boundary edge (p, r_0) whose triangle has third vertex r_1; at a
/// pinned corner also `2 p - r`. The regular masks on them give the boundary rules: at a vertex with
/// ring r_0..r_3 the six neighbours sum to `2 (p + r_0 + r_3)`, so the limit is
/// `(6 p + 2 p + 2 r_0 + 2 r_3) / 12 = (4 p + r_0 + r_3) / 6`.
#[cold]
fn with_ghosts<S: Field, V: Module<S>>(p: &V, r: &[V]) -> [V; 6] {
    let ghost = |end: &V, inner: &V| p.clone() + end - inner;
    let [first, second] = [&r[0], &r[1]].map(Clone::clone);
    match r.len() {
        4 => {
            let (beyond_last, beyond_first) = (ghost(&r[3], &r[2]), ghost(&r[0], &r[1]));
            [
                first,
                second,
                r[2].clone(),
                r[3].clone(),
                beyond_last,
                beyond_first,
            ]
        }
        _ => {
            let (opposite_first, opposite_second) = (p.clone() + p - &r[0], p.clone() + p - &r[1]);
            let (beyond_second, beyond_first) = (ghost(&r[1], &r[0]), ghost(&r[0], &r[1]));
            [
                first,
                second,
                beyond_second,
                opposite_first,
                opposite_second,
                beyond_first,
            ]
        }
    }
}

/// S over a triangle whose three corners are regular.
fn regular_patch<S: Field, V: Module<S>>(
    corner: [&V; 3],
    ring: [RingView<'_, V>; 3],
) -> QuarticTriangle<V> {
    let [a, b, c] = corner;
    // From A: B, C, opposite AC, x1, x2, opposite AB; from B: C, A, opposite AB, y1, y2, opposite BC;
    // from C: A, B, opposite BC, z1, z2, opposite AC.
    let [ac, x1, x2, ab] = neighbours::<S, V, 4>(a, ring[0], [2, 3, 4, 5]);
    let [y1, y2, bc] = neighbours::<S, V, 3>(b, ring[1], [3, 4, 5]);
    let [z1, z2] = neighbours::<S, V, 2>(c, ring[2], [3, 4]);
    from_net::box_spline::<S, V>(&[
        x2,
        x1,
        ab,
        a.clone(),
        ac,
        y1,
        b.clone(),
        c.clone(),
        z2,
        y2,
        bc,
        z1,
    ])
}

/// S - F over a face whose corners are interior and of valence 6, without rings; `None` for other
/// faces. Also tells the largest coordinate.
///
/// The twelve points are found by crossing nine edges: the three of the face, then twice round each
/// corner.
pub fn regular_face<A, V>(
    topology: &Topology,
    positions: &[Point<A::Scalar>],
    face: u32,
    limit: bool,
) -> Option<(QuarticTriangle<V>, f64)>
where
    A: Space<Point = V>,
    V: Module<A::Scalar>,
{
    let mut halfedges = topology.halfedges(face);
    let first = halfedges.start;
    let regular = |h: u32| {
        let v = topology.origin(h);
        topology.valence(v) == 6 && !topology.is_boundary_vertex(v)
    };
    if !halfedges.all(regular) {
        return None;
    }
    let (next, prev) = (|h| topology.next(h), |h| topology.prev(h));
    let (twin, origin) = (|h| topology.twin(h), |h| topology.origin(h));
    let [a, b, c] = [first, first + 1, first + 2];
    // Across AB, BC, CA: half-edges from B to A, C to B, A to C.
    let [ba, cb, ac] = [twin(a), twin(b), twin(c)];
    let a_ab = twin(next(ba)); // from the vertex opposite AB to A
    let a_x2 = twin(next(a_ab)); // from x2 to A
    let b_ab = twin(prev(ba)); // from B to the vertex opposite AB
    let b_y1 = twin(prev(b_ab)); // from B to y1
    let c_bc = twin(prev(cb)); // from C to the vertex opposite BC
    let c_z1 = twin(prev(c_bc)); // from C to z1
    let vertices = [
        origin(prev(a_ab)), // x2, in the notation of `regular_patch`
        origin(prev(a_x2)),
        origin(prev(ba)),
        origin(a),
        origin(prev(ac)),
        origin(prev(b_ab)),
        origin(b),
        origin(c),
        origin(prev(c_z1)),
        origin(prev(b_y1)),
        origin(prev(cb)),
        origin(prev(c_bc)),
    ];
    let base = &positions[origin(a) as usize];
    let net: [V; 12] = vertices.map(|v| A::lift(&positions[v as usize], base));
    let size = net.iter().map(|p| A::magnitude(p)).fold(0.0, f64::max);
    let mut surface = from_net::box_spline::<A::Scalar, V>(&net);
    let facet = if limit {
        [0, 10, 14].map(|corner| surface.0[corner].clone())
    } else {
        [3, 6, 7].map(|corner| net[corner].clone())
    };
    let facet = QuarticTriangle::from_linear::<A::Scalar>(&facet);
    surface.subtract::<A::Scalar>(&facet);
    Some((surface, size))
}

/// Scratch storage of [`split`].
#[derive(Clone, Debug)]
pub struct Scratch<V> {
    edges: [Vec<V>; 3],
}

impl<V> Default for Scratch<V> {
    fn default() -> Self {
        Scratch {
            edges: Default::default(),
        }
    }
}

impl<V> TriangleNet<V> {
    /// Gathers a face of the mesh. With `limit`, F takes the limit positions of the corners.
    pub fn gather<A>(
        &mut self,
        rules: &LoopRules<A::Scalar>,
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
            self.facet[i] = if limit {
                rules.limit(&self.corner[i], self.ring[i].view())
            } else {
                self.corner[i].clone()
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
        let mut largest = A::zero();
        let mut include = |point: &V| {
            for f in &self.facet {
                let square = A::upper(&(point.clone() - f));
                if square > largest {
                    largest = square;
                }
            }
        };
        // Each point once: the rings of corners 1 and 2 begin with points of the rings before, and
        // that of corner 2 ends with one.
        include(&self.corner[0]);
        self.ring[0].points.iter().for_each(&mut include);
        for (ring, last) in [(&self.ring[1], 0), (&self.ring[2], 1)] {
            let n = ring.points.len();
            if ring.closed && n > 4 {
                (3..n - last).for_each(|k| include(&ring.points[(ring.at + k) % n]));
            } else {
                ring.points.iter().for_each(&mut include);
            }
        }
        largest
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

    /// S - F at the irregular corner (corner 0 of every net that a split yields).
    pub fn corner_difference<A>(&self, rules: &LoopRules<A::Scalar>) -> V
    where
        A: Space<Point = V>,
        V: Module<A::Scalar>,
    {
        rules.limit(&self.corner[0], self.ring[0].view()) - &self.facet[0]
    }
}

/// One patch if all corners are regular, otherwise one Loop step: up to three patches and a net for
/// each irregular corner, with that corner first.
pub fn split<A, V>(
    rules: &LoopRules<A::Scalar>,
    net: &TriangleNet<V>,
    scratch: &mut Scratch<V>,
    sink: &mut impl Sink<QuarticTriangle<V>, TriangleNet<V>>,
) where
    A: Space<Point = V>,
    V: Module<A::Scalar>,
{
    let view = [net.ring[0].view(), net.ring[1].view(), net.ring[2].view()];
    let regular: [bool; 3] = std::array::from_fn(|i| rules.is_regular(view[i]));
    let difference = |corner: [&V; 3], ring: [RingView<'_, V>; 3], facet: &[V; 3]| {
        let mut patch = regular_patch::<A::Scalar, V>(corner, ring);
        patch.subtract::<A::Scalar>(&QuarticTriangle::from_linear::<A::Scalar>(facet));
        patch
    };
    if regular == [true; 3] {
        let [a, b, c] = &net.corner;
        let patch = difference([a, b, c], view, &net.facet);
        sink.patch(&patch, net.corners, net.steps);
        return;
    }
    for ((corner, ring), edges) in net.corner.iter().zip(view).zip(&mut scratch.edges) {
        edge_points::<A::Scalar, V>(corner, ring, edges);
    }
    let vertex: [V; 3] = std::array::from_fn(|i| rules.new_vertex(&net.corner[i], view[i]));
    // Edge point of edge i, from corner i to corner i + 1.
    let edge: [&V; 3] = std::array::from_fn(|i| &scratch.edges[i][net.ring[i].at]);
    // Its ring: interior [e_(i-1), V_i, e(i, d), e(i+1, d), V_(i+1), e_(i+1)], d opposite the edge;
    // boundary [V_(i+1), e_(i+1), e_(i-1), V_i].
    let edge_ring: [([V; 6], bool); 3] = std::array::from_fn(|i| {
        let (next, prev) = ((i + 1) % 3, (i + 2) % 3);
        let (e_prev, e_next) = (edge[prev].clone(), edge[next].clone());
        let (ends, at, at_next) = (&net.ring[i], net.ring[i].at, net.ring[next].at);
        if !ends.closed && at == 0 {
            let (a, b) = (vertex[i].clone(), vertex[next].clone());
            ([b, e_next, e_prev, a, V::zero(), V::zero()], false)
        } else {
            let (m, n) = (scratch.edges[i].len(), scratch.edges[next].len());
            let near = scratch.edges[i][if at == 0 { m - 1 } else { at - 1 }].clone();
            let far = scratch.edges[next][if at_next + 2 < n {
                at_next + 2
            } else {
                at_next + 2 - n
            }]
            .clone();
            (
                [
                    e_prev,
                    vertex[i].clone(),
                    near,
                    far,
                    vertex[next].clone(),
                    e_next,
                ],
                true,
            )
        }
    });
    // `at` of an edge point's ring as corner 1 of child i, as corner 2 of child i + 1, and in the
    // middle child.
    let around = |i: usize, closed_at: usize, open_at: usize| {
        let (points, closed) = &edge_ring[i];
        if *closed {
            RingView {
                points: &points[..],
                at: closed_at,
                closed: true,
            }
        } else {
            RingView {
                points: &points[..4],
                at: open_at,
                closed: false,
            }
        }
    };
    let p = &net.corners;
    let middle: [[f64; 2]; 3] = std::array::from_fn(|i| mid_parameter(p[i], p[(i + 1) % 3]));
    let facet_middle: [V; 3] =
        std::array::from_fn(|i| midpoint::<A::Scalar, V>(&net.facet[i], &net.facet[(i + 1) % 3]));
    for i in 0..3 {
        let prev = (i + 2) % 3;
        let corners = [p[i], middle[i], middle[prev], p[i]];
        let facet = [
            net.facet[i].clone(),
            facet_middle[i].clone(),
            facet_middle[prev].clone(),
        ];
        let ring_v = RingView {
            points: &scratch.edges[i],
            at: net.ring[i].at,
            closed: net.ring[i].closed,
        };
        let (ring_1, ring_2) = (around(i, 0, 2), around(prev, 4, 0));
        if regular[i] {
            let corner = [&vertex[i], edge[i], edge[prev]];
            let patch = difference(corner, [ring_v, ring_1, ring_2], &facet);
            sink.patch(&patch, corners, net.steps + 1);
        } else {
            let mut child = sink.spare();
            child.corner = [vertex[i].clone(), edge[i].clone(), edge[prev].clone()];
            for (ring, view) in child.ring.iter_mut().zip([ring_v, ring_1, ring_2]) {
                ring.points.clear();
                ring.points.extend_from_slice(view.points);
                (ring.at, ring.closed) = (view.at, view.closed);
            }
            child.facet = facet;
            child.corners = corners;
            child.steps = net.steps + 1;
            sink.net(child);
        }
    }
    let ring = [around(0, 5, 1), around(1, 5, 1), around(2, 5, 1)];
    let patch = difference(edge, ring, &facet_middle);
    let corners = [middle[0], middle[1], middle[2], middle[0]];
    sink.patch(&patch, corners, net.steps + 1);
}
