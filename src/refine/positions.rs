//! New positions and limit positions, one formula each for all arithmetics.
//!
//! Every output is one fixed expression of the inputs, its neighbours taken in the order of the
//! faces: so results don't depend on the number of threads, and in an exact type they are the
//! scheme's points, in [`Interval`](crate::scalar::Interval)s they contain them.

use rayon::prelude::*;

use super::corners::{BOUNDARY, Corners, Fixed, View, parallel, sections, with_view};
use super::error::RefineError;
use super::masks::{CornerMasks, Masks, StarMasks};
use crate::mesh::{NONE, Topology};
use crate::scalar::Module;
use crate::scheme::{CornerRule, Scheme, StarMask};

/// What the functions here apply weights of type W to.
pub(crate) trait Points<W>: Module<W> + Send + Sync {}
impl<W, V: Module<W> + Send + Sync> Points<W> for V {}

/// Arguments that make sense together: one point per vertex, a corner rule where there is one.
pub(crate) fn check_arguments<V>(
    scheme: Scheme,
    corner: CornerRule,
    topology: &Topology,
    positions: &[V],
) -> Result<(), RefineError> {
    let expected = topology.vertex_count() as usize;
    if positions.len() != expected {
        return Err(RefineError::PositionCount {
            expected,
            found: positions.len(),
        });
    }
    if scheme == Scheme::DooSabin && corner == CornerRule::Sharp {
        return Err(RefineError::CornerRule);
    }
    Ok(())
}

/// Working memory.
#[derive(Clone, Debug)]
pub(crate) struct Scratch<V> {
    /// Lifted face sums.
    faces: Vec<V>,
    /// Loop: the sum over each vertex's neighbours.
    rings: Vec<[V; 1]>,
    /// Catmull-Clark: the sums over each vertex's neighbours, and over its lifted face sums.
    stars: Vec<[V; 2]>,
}

impl<V> Scratch<V> {
    pub(crate) const fn new() -> Self {
        Scratch {
            faces: Vec::new(),
            rings: Vec::new(),
            stars: Vec::new(),
        }
    }
}

/// The refined positions into `out`.
pub(crate) fn refined<W: Send + Sync, V: Points<W>>(
    masks: &Masks<W>,
    corner: CornerRule,
    topology: &Topology,
    positions: &[V],
    scratch: &mut Scratch<V>,
    out: &mut Vec<V>,
) {
    let (vertices, edges) = (topology.vertex_count(), topology.edge_count());
    let faces = topology.face_count();
    match masks {
        Masks::Star(masks) if masks.lift.is_empty() => {
            let view = View::new(topology, Fixed::<3>);
            gather_sums(&view, faces, positions, &[], &mut scratch.rings);
            let sums = &scratch.rings;
            let star = Star {
                view,
                masks,
                corner,
                positions,
                sums,
                faces: &[],
            };
            sections(
                out,
                [vertices, edges, 0],
                |v| star.vertex(v),
                |e| star.triangle_edge(e),
                |_| unreachable!(),
            );
        }
        Masks::Star(masks) => with_view!(topology, view => {
            lift(&view, masks, faces, positions, &mut scratch.faces);
            gather_sums(&view, faces, positions, &scratch.faces, &mut scratch.stars);
            let (sums, lifted) = (&scratch.stars, &scratch.faces);
            let star = Star { view, masks, corner, positions, sums, faces: lifted };
            sections(
                out,
                [vertices, edges, faces],
                |v| star.vertex(v),
                |e| star.polygon_edge(e),
                |f| star.faces[f as usize].clone() * &masks.face,
            );
        }),
        Masks::Corner(masks) => with_view!(topology, view => {
            sections(
                out,
                [topology.halfedge_count(), 0, 0],
                |h| corner_point(&view, masks, positions, h),
                |_| unreachable!(),
                |_| unreachable!(),
            );
        }),
    }
}

/// The limit positions into `out`, one per vertex.
pub(crate) fn limits<W: Send + Sync, V: Points<W>>(
    masks: &Masks<W>,
    corner: CornerRule,
    topology: &Topology,
    positions: &[V],
    scratch: &mut Scratch<V>,
    out: &mut Vec<V>,
) {
    let (n, faces) = ([topology.vertex_count(), 0, 0], topology.face_count());
    match masks {
        Masks::Star(masks) if masks.lift.is_empty() => {
            let view = View::new(topology, Fixed::<3>);
            gather_sums(&view, faces, positions, &[], &mut scratch.rings);
            let sums = &scratch.rings;
            let star = Star {
                view,
                masks,
                corner,
                positions,
                sums,
                faces: &[],
            };
            sections(
                out,
                n,
                |v| star.vertex(v),
                |_| unreachable!(),
                |_| unreachable!(),
            );
        }
        Masks::Star(masks) => with_view!(topology, view => {
            lift(&view, masks, faces, positions, &mut scratch.faces);
            gather_sums(&view, faces, positions, &scratch.faces, &mut scratch.stars);
            let (sums, lifted) = (&scratch.stars, &scratch.faces);
            let star = Star { view, masks, corner, positions, sums, faces: lifted };
            sections(out, n, |v| star.vertex(v), |_| unreachable!(), |_| unreachable!());
        }),
        Masks::Corner(masks) => with_view!(topology, view => {
            let limit = |v| corner_limit(&view, masks, positions, v);
            sections(out, n, limit, |_| unreachable!(), |_| unreachable!());
        }),
    }
}

/// The sum over each vertex's neighbours (the targets of its half-edges), and with K = 2 over its
/// lifted face sums; each in the order of the faces, whatever the number of threads.
///
/// Faces next to each other in the list are near each other on the surface, vertices and edges are
/// less so: one pass over faces is several times faster than a walk round each vertex. With threads,
/// each passes over all faces and keeps what belongs to its own range of vertices.
fn gather_sums<W, V: Points<W>, C: Corners, const K: usize>(
    view: &View<'_, C>,
    count: u32,
    positions: &[V],
    faces: &[V],
    sums: &mut Vec<[V; K]>,
) {
    sums.clear();
    sums.resize(positions.len(), std::array::from_fn(|_| V::zero()));
    let add = |sum: &mut V, term: &V| *sum = std::mem::replace(sum, V::zero()) + term;
    let pass = |first: usize, own: &mut [[V; K]]| {
        for f in 0..count {
            let (start, size) = (
                view.corners.start(f) as usize,
                view.corners.size(f) as usize,
            );
            let corners = &view.origin[start..start + size];
            let mut v = corners[size - 1] as usize;
            for &next in corners {
                let next = next as usize;
                if let Some(sum) = own.get_mut(v.wrapping_sub(first)) {
                    add(&mut sum[0], &positions[next]);
                    if K == 2 {
                        add(&mut sum[1], &faces[f as usize]);
                    }
                }
                v = next;
            }
        }
    };
    if parallel(positions.len()) {
        let own = positions.len().div_ceil(rayon::current_num_threads());
        sums.par_chunks_mut(own)
            .enumerate()
            .for_each(|(i, chunk)| pass(i * own, chunk));
    } else {
        pass(0, sums);
    }
}

/// Lifted face sums `(P_0 + .. + P_(m-1)) lift[m]`.
fn lift<W: Send + Sync, V: Points<W>, C: Corners>(
    view: &View<'_, C>,
    masks: &StarMasks<W>,
    count: u32,
    positions: &[V],
    faces: &mut Vec<V>,
) {
    let face = |f: u32| {
        let (start, size) = (
            view.corners.start(f) as usize,
            view.corners.size(f) as usize,
        );
        let corners = &view.origin[start..start + size];
        let mut sum = positions[corners[0] as usize].clone();
        for &v in &corners[1..] {
            sum = sum + &positions[v as usize];
        }
        sum * &masks.lift[size]
    };
    sections(
        faces,
        [count, 0, 0],
        face,
        |_| unreachable!(),
        |_| unreachable!(),
    );
}

/// Loop (K = 1) and Catmull-Clark (K = 2) on one mesh.
struct Star<'a, W, V, C, const K: usize> {
    view: View<'a, C>,
    masks: &'a StarMasks<W>,
    corner: CornerRule,
    positions: &'a [V],
    sums: &'a [[V; K]],
    faces: &'a [V],
}

impl<W, V: Points<W>, C: Corners, const K: usize> Star<'_, W, V, C, K> {
    #[inline(always)]
    fn at(&self, h: u32) -> &V {
        &self.positions[self.view.origin(h)]
    }

    /// `center P + edge Σ e_i (+ face Σ f_i)`: the refined or the limit point, as the masks are.
    #[inline(always)]
    fn vertex(&self, v: u32) -> V {
        let n = self.view.valence[v as usize];
        let p = &self.positions[v as usize];
        if n.wrapping_sub(1) >= BOUNDARY - 1 {
            return self.open_vertex(v, n, p);
        }
        let sums = &self.sums[v as usize];
        let StarMask { center, edge, face } = &self.masks.vertex[n as usize];
        let point = p.clone() * center + &(sums[0].clone() * edge);
        if K == 2 {
            point + &(sums[1].clone() * face)
        } else {
            point
        }
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

    /// `edge[0] (P_a + P_b) + edge[1] (P_c + P_d)`: ends, opposite vertices.
    #[inline(always)]
    fn triangle_edge(&self, e: u32) -> V {
        let [a, b] = self.view.edges[e as usize];
        if b == NONE {
            return self.open_edge(a);
        }
        let ends = self.at(a).clone() + self.at(b);
        let opposite =
            self.at(self.view.corners.prev(a)).clone() + self.at(self.view.corners.prev(b));
        ends * &self.masks.edge[0] + &(opposite * &self.masks.edge[1])
    }

    /// `edge[0] (P_a + P_b) + edge[1] (f + g)`: ends, lifted sums of the two faces.
    #[inline(always)]
    fn polygon_edge(&self, e: u32) -> V {
        let [a, b] = self.view.edges[e as usize];
        if b == NONE {
            return self.open_edge(a);
        }
        let ends = self.at(a).clone() + self.at(b);
        let left = &self.faces[self.view.corners.face(a) as usize];
        let right = &self.faces[self.view.corners.face(b) as usize];
        ends * &self.masks.edge[0] + &((left.clone() + right) * &self.masks.edge[1])
    }

    fn open_edge(&self, a: u32) -> V {
        let ends = self.at(a).clone() + self.at(self.view.corners.next(a));
        ends * &self.masks.boundary_edge
    }
}

/// The new corner of half-edge h: `Σ a_j P_j` over the corners of its face, h being corner 0.
#[inline(always)]
fn corner_point<W, V: Points<W>, C: Corners>(
    view: &View<'_, C>,
    masks: &CornerMasks<W>,
    positions: &[V],
    h: u32,
) -> V {
    let face = view.corners.face(h);
    let (start, size) = (view.corners.start(face), view.corners.size(face));
    let mask = &masks.corner[size as usize];
    let mut sum = positions[view.origin(h)].clone() * &mask[0];
    let mut corner = h;
    for weight in &mask[1..] {
        corner = if corner + 1 == start + size {
            start
        } else {
            corner + 1
        };
        sum = sum + &(positions[view.origin(corner)].clone() * weight);
    }
    sum
}

/// The mean of the new corners at v, over its faces counterclockwise.
fn corner_limit<W, V: Points<W>, C: Corners>(
    view: &View<'_, C>,
    masks: &CornerMasks<W>,
    positions: &[V],
    v: u32,
) -> V {
    let word = view.valence[v as usize];
    if word == 0 {
        return positions[v as usize].clone() * &masks.keep;
    }
    let faces = (word & !BOUNDARY) - u32::from(word & BOUNDARY != 0);
    let mut h = view.first[v as usize];
    let mut sum = corner_point(view, masks, positions, h);
    for _ in 1..faces {
        h = view.twin(view.corners.prev(h));
        sum = sum + &corner_point(view, masks, positions, h);
    }
    sum * &masks.mean[faces as usize]
}
