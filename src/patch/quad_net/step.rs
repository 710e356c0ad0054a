//! One Catmull-Clark step on a net.

use super::rules::{CatmullClarkRules, Fan, FanView, edge_points, regular_patch};
use super::{PolygonNet, QuadNet};
use crate::bernstein::tensor::{Bicubic, Tensor};
use crate::bernstein::{mid_parameter, midpoint};
use crate::patch::{Corners, Sink, Space};
use crate::scalar::Module;
use crate::scheme::catmull_clark;

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
