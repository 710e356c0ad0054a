//! Loop: second differences of edges in flat arrays, now and after one step by formula.
//!
//! **Now.** M of a face is the largest α of the edges that meet its corners, and |δ| of irregular boundary
//! corners: one pass over edges leaves the largest at each vertex, one over faces the largest of three
//! vertices. Ghosts beyond the boundary add nothing: those of [`crate::predict::eigen::regular`]; a sharp
//! corner's ghosts make an affine star. A face whose corners are regular but for one is ready. Any other has
//! M(child) <= R M, R the largest of [`super::constants::beside`] at its corners
//! ([`crate::bound::face_rate`], [`super::star`]), and its children are ready.
//!
//! **After one step**, without refining ([`super::star`]): with t = a - a' at each vertex
//!
//! ```text
//! α'(a, x) = 3/8 α_x + 1/8 (α_y + α_z) - t_a,      τ = 1/8 α_xy - 1/8 (α_x + α_y) + t_a.
//! ```
//!
//! The edges at the middle of an edge (a, x) are α'(a, x), α'(x, a) and the τ at both ends in both faces.
//!
//! **Roundings.** Differences are taken as (P - R) + (Q - S), so their errors are relative to the mesh's
//! extent e, whatever its place: a coordinate of α is within 6u e; of Σ α within (2n γ(n) + 6n u) e, of t within
//! (1.25 γ(n) + 8u) e; of α' and τ within γ(2n + 64) e. The length adds √3.

use rayon::prelude::*;

use super::connectivity::Connectivity;
use super::constants::{beside, to_limit};
use super::levels::{Kinds, Visit};
use super::star::{Vertex, first_step};
use super::vector::{Vector, larger, second, square};
use crate::bound::Against;
use crate::mesh::{NONE, Point, Topology};
use crate::predict::parts::{FEW, by_parts, joined, parts_of};
use crate::scalar::Interval;
use crate::scheme::{LoopWeights, Scheme, loop_scheme};

/// The squares behind M of the faces of one level.
#[derive(Clone, Debug)]
pub struct Triangles<'a> {
    topology: Connectivity<'a>,
    kinds: Vec<u16>,
    /// The largest square at each vertex.
    vertex: Vec<f64>,
    /// The largest square at each edge's middle after one step; empty if the faces themselves are meant.
    edge: Vec<f64>,
    rates: Rates,
    level: usize,
}

/// What faces with several irregular corners need, by kind.
#[derive(Clone, Debug, Default)]
pub(super) struct Rates {
    /// R^2.
    rate: Vec<f64>,
    /// The square of how far a face moves in a step, over M.
    moved: Vec<f64>,
}

impl Rates {
    pub(super) fn of(scheme: Scheme, against: Against, kinds: &Kinds) -> Self {
        let beside: Vec<f64> = kinds.list.iter().map(|&v| beside(scheme, v)).collect();
        let fastest = beside.iter().copied().fold(0.0, f64::max);
        let moved = |&v: &Vertex| {
            let m = match against {
                Against::Control => first_step(scheme, v).max(0.125),
                // The middle of an edge: its own way to its limit, from the line, and those of the ends.
                Against::Limit => to_limit(scheme, v) + 0.5 * fastest + 0.125,
            };
            m * m * (1.0 + 1e-15)
        };
        Rates {
            rate: beside.iter().map(|r| r.powi(2) * (1.0 + 1e-15)).collect(),
            moved: kinds.list.iter().map(moved).collect(),
        }
    }

    /// A face whose corners have the kinds given, and M^2.
    #[inline(always)]
    pub(super) fn visit(&self, kinds: [u16; 3], square: f64, to: &mut impl Visit) {
        let irregular = kinds.iter().filter(|&&kind| kind != 0).count();
        let largest = |of: &[f64]| {
            let [a, b, c] = kinds.map(|kind| of[usize::from(kind)]);
            larger(a, larger(b, c))
        };
        let many = irregular > 1;
        let (level, factor) = match many {
            true => (1, largest(&self.rate)),
            false => (0, 1.0),
        };
        for kind in kinds {
            to.ready(level, kind, square * factor);
        }
        if many {
            to.moved(0, square * largest(&self.moved));
        }
    }
}

impl<'a> Triangles<'a> {
    /// Faces of a level as they are.
    pub fn now(
        topology: Connectivity<'a>,
        positions: &[Point<f64>],
        scheme: Scheme,
        against: Against,
        kinds: &Kinds,
        of_vertex: Vec<u16>,
    ) -> Self {
        let t: &Topology = &topology;
        let (origins, edges) = (t.origins(), &t.edges[..]);
        let of_edges = |range: std::ops::Range<usize>, top: &mut [f64]| {
            for &halves in &edges[range] {
                if let Some((alpha, ends)) = alpha(origins, positions, halves) {
                    let square = square(&alpha);
                    for v in ends {
                        let slot = &mut top[v as usize];
                        *slot = larger(*slot, square);
                    }
                }
            }
        };
        let mut vertex = by_parts(t, of_edges);
        boundary(t, positions, kinds, &of_vertex, 1.0, &mut vertex);
        Triangles {
            topology,
            vertex,
            edge: Vec::new(),
            rates: Rates::of(scheme, against, kinds),
            kinds: of_vertex,
            level: 0,
        }
    }

    /// The children of the faces of a level, by formula; `level` is theirs.
    pub fn after_a_step(
        topology: Connectivity<'a>,
        positions: &[Point<f64>],
        weights: LoopWeights,
        kinds: &Kinds,
        of_vertex: Vec<u16>,
        level: usize,
    ) -> Self {
        let t: &Topology = &topology;
        let alphas: Vec<Vector> = (0..t.edge_count() as usize)
            .into_par_iter()
            .with_min_len(FEW)
            .map(|e| alpha(t.origins(), positions, t.edges[e]).map_or([0.0; 3], |(alpha, _)| alpha))
            .collect();
        let ring: Vec<f64> = kinds
            .list
            .iter()
            .map(|&v| ring_weight(weights, v))
            .collect();
        let steps: Vec<Vector> = (0..t.vertex_count())
            .into_par_iter()
            .with_min_len(FEW)
            .map(|v| {
                let kind = usize::from(of_vertex[v as usize]);
                // A boundary vertex of one face is regular if it is sharp only: it stays.
                let stays = kind == 0 && t.is_boundary_vertex(v) && t.valence(v) == 2;
                let weight = if stays { 0.0 } else { ring[kind] };
                step(t, positions, &alphas, weight, v)
            })
            .collect();
        let (edge, mut vertex) = middles(t, &alphas, &steps);
        boundary(t, positions, kinds, &of_vertex, 0.25, &mut vertex);
        Triangles {
            topology,
            kinds: of_vertex,
            vertex,
            edge,
            rates: Rates::default(),
            level,
        }
    }

    /// The level of ready faces, the first if there are two.
    pub fn level(&self) -> usize {
        self.level
    }

    /// The number of faces that can be visited.
    pub fn face_count(&self) -> u32 {
        self.topology.face_count()
    }

    /// The ready faces of a face: itself, or its children.
    #[inline]
    pub fn visit(&self, face: u32, to: &mut impl Visit) {
        let first = 3 * face as usize;
        let corners: &[u32; 3] = self.topology.origins()[first..first + 3]
            .try_into()
            .expect("three corners");
        let top = corners.map(|v| self.vertex[v as usize]);
        let kinds = corners.map(|v| self.kinds[v as usize]);
        if self.edge.is_empty() {
            let square = larger(top[0], larger(top[1], top[2]));
            self.rates.visit(kinds, square, to);
        } else {
            let middle =
                [0, 1, 2].map(|i| self.edge[self.topology.edge_of((first + i) as u32) as usize]);
            for i in 0..3 {
                let square = larger(top[i], larger(middle[i], middle[(i + 2) % 3]));
                to.ready(self.level, kinds[i], square);
            }
            to.ready(
                self.level,
                0,
                larger(middle[0], larger(middle[1], middle[2])),
            );
        }
    }
}

/// The vertex of a triangle that its half-edge h does not meet, P and Q being those that it does.
#[inline(always)]
fn opposite(faces: &[[u32; 3]], h: u32, p: u32, q: u32) -> u32 {
    let [a, b, c] = faces[(h / 3) as usize];
    a ^ b ^ c ^ p ^ q
}

/// α and the ends of an edge with two faces.
#[inline(always)]
fn alpha(
    origins: &[u32],
    positions: &[Point<f64>],
    [h, twin]: [u32; 2],
) -> Option<(Vector, [u32; 2])> {
    if twin == NONE {
        return None;
    }
    let (faces, _) = origins.as_chunks::<3>();
    let [p, q] = [origins[h as usize], origins[twin as usize]];
    let [r, s] = [opposite(faces, h, p, q), opposite(faces, twin, p, q)];
    let [a, b, c, d] = [p, q, r, s].map(|v| &positions[v as usize].0);
    let difference = |i: usize| (a[i] - c[i]) + (b[i] - d[i]);
    Some(([difference(0), difference(1), difference(2)], [p, q]))
}

/// δ of irregular boundary vertices, times a factor, joins their maxima.
fn boundary(
    topology: &Topology,
    positions: &[Point<f64>],
    kinds: &Kinds,
    of_vertex: &[u16],
    factor: f64,
    top: &mut [f64],
) {
    let irregular = |kind: u16| matches!(kinds.list[usize::from(kind)], Vertex::Boundary(_));
    if topology.is_closed() {
        return;
    }
    for (v, &kind) in (0..).zip(of_vertex) {
        if irregular(kind) {
            let delta = delta(topology, positions, v);
            let scaled = square(&delta) * (factor * factor);
            top[v as usize] = larger(top[v as usize], scaled);
        }
    }
}

/// δ = 2a - p - q at a boundary vertex.
pub(super) fn delta(topology: &Topology, positions: &[Point<f64>], v: u32) -> Vector {
    let first = topology.first_halfedge(v);
    let last = topology.fan(v).last().unwrap_or(first);
    let at = |v: u32| &positions[v as usize].0;
    let (a, p) = (at(v), at(topology.target(first)));
    second(a, p, at(topology.origin(topology.prev(last))))
}

/// b of an interior vertex; 1/8 at the boundary, where t = δ/8.
fn ring_weight(weights: LoopWeights, vertex: Vertex) -> f64 {
    let n = match vertex {
        Vertex::Regular => 6,
        Vertex::Interior(n) => n,
        Vertex::Boundary(_) => return 0.125,
    };
    let sum = loop_scheme::ring_weight_sum::<Interval>(weights, n);
    sum.map_or(f64::INFINITY, |sum| sum.mid() / f64::from(n))
}

/// t = a - a'.
fn step(
    topology: &Topology,
    positions: &[Point<f64>],
    alphas: &[Vector],
    weight: f64,
    v: u32,
) -> Vector {
    if topology.first_halfedge(v) == NONE {
        return [0.0; 3];
    }
    if topology.is_boundary_vertex(v) {
        let weight = if weight > 0.0 { 0.125 } else { 0.0 };
        return delta(topology, positions, v).map(|x| x * weight);
    }
    let mut sum = [0.0; 3];
    for h in topology.fan(v) {
        let alpha = &alphas[topology.edge_of(h) as usize];
        for i in 0..3 {
            sum[i] += alpha[i];
        }
    }
    sum.map(|x| x * weight)
}

/// The largest squares at the middle of each edge, and of the spokes at each vertex, after a step.
fn middles(topology: &Topology, alphas: &[Vector], steps: &[Vector]) -> (Vec<f64>, Vec<f64>) {
    let edges = topology.edge_count() as usize;
    let length = edges.div_ceil(parts_of(edges)).max(1);
    let mut middle = vec![0.0_f64; edges];
    let part = |(i, chunk): (usize, &mut [f64])| {
        let mut top = vec![0.0_f64; topology.vertex_count() as usize];
        for (e, out) in (i * length..).zip(chunk) {
            *out = one_middle(topology, alphas, steps, e as u32, &mut top);
        }
        top
    };
    let all = middle
        .par_chunks_mut(length)
        .enumerate()
        .map(part)
        .collect();
    (middle, joined(all))
}

#[inline]
fn one_middle(
    topology: &Topology,
    alphas: &[Vector],
    steps: &[Vector],
    e: u32,
    top: &mut [f64],
) -> f64 {
    let [h, twin] = topology.edge_halfedges(e);
    let own = &alphas[e as usize];
    let (p, q) = (topology.origin(h), topology.target(h));
    let (at_p, at_q) = (&steps[p as usize], &steps[q as usize]);
    let around = |h: u32| {
        let [next, prev] = [topology.next(h), topology.prev(h)];
        [next, prev].map(|h| &alphas[topology.edge_of(h) as usize])
    };
    // In the face of h: the edge at its end, and the one at its start.
    let across = |far: &Vector, beside: &Vector, t: &Vector| {
        let tau = [0, 1, 2].map(|i| 0.125 * (far[i] - (own[i] + beside[i])) + t[i]);
        square(&tau)
    };
    let [next, prev] = around(h);
    let mut largest = larger(across(next, prev, at_p), across(prev, next, at_q));
    if twin != NONE {
        let [next_twin, prev_twin] = around(twin);
        largest = larger(largest, across(next_twin, prev_twin, at_q));
        largest = larger(largest, across(prev_twin, next_twin, at_p));
        let spoke = |y: &Vector, z: &Vector, t: &Vector| {
            let alpha = [0, 1, 2].map(|i| 0.375 * own[i] + 0.125 * (y[i] + z[i]) - t[i]);
            square(&alpha)
        };
        let from_p = spoke(prev, next_twin, at_p);
        let from_q = spoke(next, prev_twin, at_q);
        let [p, q] = [p as usize, q as usize];
        top[p] = larger(top[p], from_p);
        top[q] = larger(top[q], from_q);
        largest = larger(largest, larger(from_p, from_q));
    }
    largest
}
