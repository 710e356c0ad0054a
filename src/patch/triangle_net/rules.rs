//! Loop's rules on rings, and the patch of a triangle with regular corners.

use num_traits::Zero;

use crate::bernstein::from_net;
use crate::bernstein::triangle::QuarticTriangle;
use crate::mesh::Topology;
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
pub(super) struct RingView<'a, V> {
    pub(super) points: &'a [V],
    pub(super) at: usize,
    pub(super) closed: bool,
}

impl<V> Clone for RingView<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for RingView<'_, V> {}

impl<V> Ring<V> {
    pub(super) fn view(&self) -> RingView<'_, V> {
        RingView {
            points: &self.points,
            at: self.at,
            closed: self.closed,
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

    pub(super) fn is_regular<V>(&self, ring: RingView<'_, V>) -> bool {
        match (ring.closed, ring.points.len()) {
            (true, n) => n == 6,
            (false, 4) => true,
            (false, n) => n == 2 && self.corner_rule == CornerRule::Sharp,
        }
    }

    fn is_pinned<V>(&self, ring: RingView<'_, V>) -> bool {
        !ring.closed && ring.points.len() == 2 && self.corner_rule == CornerRule::Sharp
    }

    pub(super) fn new_vertex<V: Module<S>>(&self, p: &V, ring: RingView<'_, V>) -> V {
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

    pub(super) fn limit<V: Module<S>>(&self, p: &V, ring: RingView<'_, V>) -> V {
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
pub(super) fn edge_points<S: Field, V: Module<S>>(p: &V, ring: RingView<'_, V>, out: &mut Vec<V>) {
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
pub(super) fn regular_patch<S: Field, V: Module<S>>(
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
