//! Loop and Catmull-Clark: every vertex and edge point is a sum over faces.
//!
//! Faces next to each other in the list are near each other on the surface, vertices and edges are
//! less so. So on one core a single pass over the faces gives all sums, in the memory of the result
//! and without asking which of an edge's faces comes first: that question is a coin toss to the
//! processor. With several threads each passes over the faces and keeps what belongs to its own
//! vertices, and each edge looks up its two faces.
//!
//! Both add the same terms to 0, a vertex's in the order of the faces; an edge has two, whose order
//! makes no difference.

use num_traits::Zero;
use rayon::prelude::*;

use super::corners::{BOUNDARY, Corners, Fixed, View, parallel, update};
use super::masks::{RingMask, StarMasks};
use super::positions::Points;
use crate::mesh::NONE;
use crate::scheme::CornerRule;

/// One of the two schemes on one mesh.
pub(super) struct Star<'a, W, V, C> {
    pub view: View<'a, C>,
    pub masks: &'a StarMasks<W>,
    pub corner: CornerRule,
    pub positions: &'a [V],
}

#[inline(always)]
fn add<W, V: Points<W>>(sum: &mut V, term: &V) {
    *sum = std::mem::replace(sum, V::zero()) + term;
}

/// Gives `out` the length `total`, its first `zeros` elements being 0 and the others anything.
fn prepare<V: Clone + Zero>(out: &mut Vec<V>, zeros: usize, total: usize) {
    if out.len() < total {
        out.clear();
        out.reserve_exact(total);
    }
    out.truncate(total);
    let old = zeros.min(out.len());
    out[..old].fill(V::zero());
    out.resize(total, V::zero());
}

/// For edges that nobody asks for.
#[inline(always)]
fn ignore<V>(_: u32, _: [&V; 2], _: &V) {}

impl<W: Send + Sync, V: Points<W>> Star<'_, W, V, Fixed<3>> {
    /// The refined positions of a mesh of triangles.
    pub(super) fn refine_triangles(&self, out: &mut Vec<V>) {
        let (first_edge, total) = (
            self.positions.len(),
            self.positions.len() + self.view.edges.len(),
        );
        prepare(out, total, total);
        let (vertices, edges) = out.split_at_mut(first_edge);
        if parallel(total) {
            self.triangle_rings(vertices);
            self.each_edge(edges, |h| self.at(self.view.corners.prev(h)));
        } else {
            self.gather_triangles(0, vertices, |e, ends, inner| {
                add::<W, V>(&mut edges[e as usize], &self.edge_term(ends, inner));
            });
        }
        self.finish(vertices);
        self.open_edges(edges);
    }

    /// The limit positions of a mesh of triangles.
    pub(super) fn triangle_limits(&self, out: &mut Vec<V>) {
        prepare(out, self.positions.len(), self.positions.len());
        self.triangle_rings(out);
        self.finish(out);
    }

    fn triangle_rings(&self, vertices: &mut [V]) {
        self.divide(vertices, &|first, own| {
            self.gather_triangles(first, own, ignore);
        });
    }

    /// Adds to `own`, the vertices from `first` on, their neighbours; tells `edge` the ends and the
    /// opposite vertex of each edge of each face.
    #[inline(always)]
    fn gather_triangles(
        &self,
        first: usize,
        own: &mut [V],
        mut edge: impl FnMut(u32, [&V; 2], &V),
    ) {
        let (origins, _) = self.view.origin.as_chunks::<3>();
        let (face_edges, _) = self.view.edge_of.as_chunks::<3>();
        for (corners, edges) in origins.iter().zip(face_edges) {
            let points = corners.map(|v| &self.positions[v as usize]);
            for i in 0..3 {
                let [from, to, opposite] = [i, (i + 1) % 3, (i + 2) % 3].map(|i| points[i]);
                if let Some(sum) = own.get_mut((corners[i] as usize).wrapping_sub(first)) {
                    add::<W, V>(sum, to);
                }
                edge(edges[i], [from, to], opposite);
            }
        }
    }
}

impl<W: Send + Sync, V: Points<W>, C: Corners> Star<'_, W, V, C> {
    /// The refined positions of a mesh of `faces` polygons.
    pub(super) fn refine_polygons(&self, faces: u32, out: &mut Vec<V>) {
        let (vertices, edges) = (self.positions.len(), self.view.edges.len());
        let total = vertices + edges + faces as usize;
        prepare(out, vertices + edges, total);
        let (vertices, rest) = out.split_at_mut(vertices);
        let (edges, centres) = rest.split_at_mut(edges);
        if parallel(total) {
            update(centres, |f, sum| *sum = self.lifted(self.face(f)));
            let lifted = &*centres;
            self.divide(vertices, &|first, own| {
                let known = |f: u32, _: &[u32]| lifted[f as usize].clone();
                self.gather_polygons(faces, first, own, known, ignore);
            });
            self.each_edge(edges, |h| &lifted[self.view.corners.face(h) as usize]);
            update(centres, |_, sum| {
                *sum = std::mem::replace(sum, V::zero()) * &self.masks.face;
            });
        } else {
            let compute = |f: u32, corners: &[u32]| {
                let sum = self.lifted(corners);
                centres[f as usize] = sum.clone() * &self.masks.face;
                sum
            };
            self.gather_polygons(faces, 0, vertices, compute, |e, ends, inner| {
                add::<W, V>(&mut edges[e as usize], &self.edge_term(ends, inner));
            });
        }
        self.finish(vertices);
        self.open_edges(edges);
    }

    /// The limit positions of a mesh of `faces` polygons.
    pub(super) fn polygon_limits(&self, faces: u32, out: &mut Vec<V>) {
        prepare(out, self.positions.len(), self.positions.len());
        self.divide(out, &|first, own| {
            let compute = |_: u32, corners: &[u32]| self.lifted(corners);
            self.gather_polygons(faces, first, own, compute, ignore);
        });
        self.finish(out);
    }

    /// Adds to `own`, the vertices from `first` on, their neighbours and lifted face sums; tells
    /// `edge` the ends and the lifted face sum of each edge of each face.
    #[inline(always)]
    fn gather_polygons(
        &self,
        faces: u32,
        first: usize,
        own: &mut [V],
        mut lifted: impl FnMut(u32, &[u32]) -> V,
        mut edge: impl FnMut(u32, [&V; 2], &V),
    ) {
        let [neighbour, centre] = &self.masks.around;
        for f in 0..faces {
            let corners = self.face(f);
            let start = self.view.corners.start(f) as usize;
            let edges = &self.view.edge_of[start..start + corners.len()];
            let inner = lifted(f, corners);
            let around = inner.clone() * centre;
            let last = corners.len() - 1;
            let mut v = corners[last] as usize;
            for i in 0..corners.len() {
                let next = corners[i] as usize;
                let ends = [&self.positions[v], &self.positions[next]];
                if let Some(sum) = own.get_mut(v.wrapping_sub(first)) {
                    add::<W, V>(sum, &(ends[1].clone() * neighbour + &around));
                }
                edge(edges[if i == 0 { last } else { i - 1 }], ends, &inner);
                v = next;
            }
        }
    }

    /// `(P_0 + .. + P_(m-1)) lift[m]`.
    #[inline(always)]
    fn lifted(&self, corners: &[u32]) -> V {
        let mut sum = self.positions[corners[0] as usize].clone();
        for &v in &corners[1..] {
            sum = sum + &self.positions[v as usize];
        }
        sum * &self.masks.lift[corners.len()]
    }

    #[inline(always)]
    fn face(&self, f: u32) -> &[u32] {
        let start = self.view.corners.start(f) as usize;
        &self.view.origin[start..start + self.view.corners.size(f) as usize]
    }

    #[inline(always)]
    fn at(&self, h: u32) -> &V {
        &self.positions[self.view.origin(h)]
    }

    /// What a face adds to the point of one of its edges.
    #[inline(always)]
    fn edge_term(&self, [from, to]: [&V; 2], inner: &V) -> V {
        let [end, face] = &self.masks.edge;
        (from.clone() + to) * end + &(inner.clone() * face)
    }

    /// Ranges of the vertices, with the index of the first, to several threads if there are.
    fn divide(&self, vertices: &mut [V], gather: &(dyn Fn(usize, &mut [V]) + Sync)) {
        if parallel(vertices.len()) {
            let own = vertices.len().div_ceil(rayon::current_num_threads());
            let chunks = vertices.par_chunks_mut(own).enumerate();
            chunks.for_each(|(i, chunk)| gather(i * own, chunk));
        } else {
            gather(0, vertices);
        }
    }

    /// Adds to each interior edge's sum what its two faces add, `inner` of a half-edge being the
    /// point inside its face.
    fn each_edge<'a>(&'a self, edges: &mut [V], inner: impl Fn(u32) -> &'a V + Sync) {
        update(edges, |e, sum| {
            let [a, b] = self.view.edges[e as usize];
            if b != NONE {
                for h in [a, b] {
                    let ends = [self.at(h), self.at(self.view.corners.next(h))];
                    add::<W, V>(sum, &self.edge_term(ends, inner(h)));
                }
            }
        });
    }

    /// From the sums over faces to the vertices' points, refined or limit, as the masks are.
    fn finish(&self, vertices: &mut [V]) {
        update(vertices, |v, sum| {
            let n = self.view.valence[v as usize];
            let p = &self.positions[v as usize];
            *sum = if n.wrapping_sub(1) >= BOUNDARY - 1 {
                self.open_vertex(v, n, p)
            } else {
                let RingMask { center, ring } = &self.masks.vertex[n as usize];
                p.clone() * center + &(std::mem::replace(sum, V::zero()) * ring)
            };
        });
    }

    /// A boundary vertex or an isolated one.
    fn open_vertex(&self, v: u32, n: u32, p: &V) -> V {
        let pinned = self.corner == CornerRule::Sharp && n == BOUNDARY | 2;
        if n == 0 || pinned {
            return p.clone() * &self.masks.keep;
        }
        let [a, b] = self.view.boundary_neighbours(v);
        let [center, side] = &self.masks.boundary;
        p.clone() * center + &((self.positions[a].clone() + &self.positions[b]) * side)
    }

    /// The points of boundary edges.
    fn open_edges(&self, edges: &mut [V]) {
        if self.view.valence.iter().fold(0, |any, word| any | word) < BOUNDARY {
            return;
        }
        update(edges, |e, point| {
            let [a, b] = self.view.edges[e as usize];
            if b == NONE {
                let ends = self.at(a).clone() + self.at(self.view.corners.next(a));
                *point = ends * &self.masks.boundary_edge;
            }
        });
    }
}
