//! One Loop step on a net.

use super::TriangleNet;
use super::rules::{LoopRules, RingView, edge_points, regular_patch};
use crate::bernstein::triangle::QuarticTriangle;
use crate::bernstein::{mid_parameter, midpoint};
use crate::patch::{Sink, Space};
use crate::scalar::Module;

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
