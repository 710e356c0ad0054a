//! Connectivity of the refined mesh: every child index is a formula of its parent's.
//!
//! V, E, F, H count vertices, edges, faces and half-edges (corners) of the coarse mesh; `m_e` is the
//! edge vertex V + e, `c_f` the face vertex V + E + f; a half-edge h of face f at corner i runs from
//! v_i to v_(i+1) along e_i, so that `h = first(f) + i`. For edge e, `a = edge_halfedges(e)[0]` is its
//! first half-edge, b its second (or NONE); its halves are the fine edges 2e, at the origin of a, and
//! 2e + 1, at the target of a.
//!
//! | fine | Loop | Catmull-Clark |
//! |---|---|---|
//! | vertices | v, then V + e | v, V + e, then V + E + f |
//! | faces | 4f + i: (v_i, m_i, m_(i-1)); 4f + 3: (m_0, m_1, m_2) | h: (v_i, m_i, c_f, m_(i-1)) |
//! | half-edge v_i -> m_i | 12f + 3i | 4h |
//! | half-edge m_i -> v_(i+1) | 12f + 3((i+1) mod 3) + 2 | 4 next(h) + 3 |
//! | inner edges | 2E + 3f + i: m_i - m_(i-1), cuts corner i off | 2E + h: m_i - c_f |
//! | first half-edge of v | v -> m, on the edge of the old one | the same |
//! | first half-edge of m_e | m_e -> target of a | the same |
//! | valence of m_e | 6, on the boundary 4 | 4, on the boundary 3 |
//!
//! **Doo-Sabin.** Fine vertex h is the corner h of its face. Coarse edges of two faces ("interior")
//! count 0, 1, .. as r(e), coarse vertices off the boundary likewise; R is the number of interior
//! edges. Faces, in order:
//! - f: the shrunk face f, corners h in the order of f; half-edge h runs from vertex h to next(h);
//! - F + r(e): (a, next(b), b, next(a)), for interior edges; half-edges H + 4 r(e) + 0..4;
//! - F + R + r(v): (h, rotate(h), ..) from h = first_halfedge(v), for interior vertices; half-edges
//!   from H + 4R + the sum of the valences of the interior vertices before v.
//!
//! Edges: h for next to half-edge h, then H + 2 r(e) at the origin of a and H + 2 r(e) + 1 at its
//! target, across the edge. Coarse boundary vertices and edges get no face, but every corner of
//! every face gives a vertex; isolated vertices vanish.
//!
//! Nothing is searched and nothing is hashed; the only tables are the ranks r.

use super::corners::{BOUNDARY, Corners, Fixed, View, fill, resize, with_view};
use super::doo_sabin;
use super::error::RefineError;
use crate::mesh::{NONE, Topology};
use crate::scheme::Scheme;

/// The connectivity of the mesh after one step; see the [table](self).
///
/// # Errors
/// If and only if the scheme refuses the mesh ([`check`]).
pub fn refine_topology(scheme: Scheme, topology: &Topology) -> Result<Topology, RefineError> {
    let mut fine = empty();
    refine_topology_into(scheme, topology, &mut fine)?;
    Ok(fine)
}

/// [`refine_topology`] into the memory of `fine`, whose old contents are lost.
///
/// # Errors
/// As [`refine_topology`]; `fine` is then untouched.
pub fn refine_topology_into(
    scheme: Scheme,
    topology: &Topology,
    fine: &mut Topology,
) -> Result<(), RefineError> {
    check(scheme, topology)?;
    match scheme {
        Scheme::Loop(_) => loop_connectivity(View::new(topology, Fixed::<3>), fine),
        Scheme::CatmullClark => with_view!(topology, view => {
            catmull_clark_connectivity(view, topology.face_count(), fine)
        }),
        Scheme::DooSabin => with_view!(topology, view => {
            doo_sabin::connectivity(view, topology.face_count(), fine)
        }),
    }
    Ok(())
}

/// Whether `scheme` can refine the mesh.
///
/// # Errors
/// If and only if, for Loop, a face is no triangle or an interior vertex has valence below 3; for
/// Doo-Sabin, an interior vertex has valence 2 (a 2-gon would persist); for all, the refined mesh
/// has 2^31 half-edges or more.
pub fn check(scheme: Scheme, topology: &Topology) -> Result<(), RefineError> {
    if let Scheme::Loop(_) = scheme
        && topology.arity() != Some(3)
    {
        let odd = (0..topology.face_count()).find(|&f| topology.face_size(f) != 3);
        let face = odd.expect("a mesh of triangles has arity 3");
        return Err(RefineError::NotATriangle {
            face,
            size: topology.face_size(face),
        });
    }
    if scheme != Scheme::CatmullClark {
        // Boundary words have the high bit set; an isolated vertex has the word 0.
        let few = |word: u32| word == 1 || word == 2;
        if topology
            .valence
            .iter()
            .fold(false, |any, &word| any | few(word))
        {
            let vertex = topology
                .valence
                .iter()
                .position(|&word| few(word))
                .unwrap_or(0);
            return Err(RefineError::ValenceTooLow {
                vertex: vertex as u32,
                valence: topology.valence[vertex],
                scheme: scheme.name(),
            });
        }
    }
    // At most 4 H half-edges for each scheme (Doo-Sabin: H + 4 E + H, E <= H / 2 interior).
    let halfedges = 4 * u64::from(topology.halfedge_count());
    if halfedges >= 1 << 31 {
        return Err(RefineError::TooLarge { halfedges });
    }
    Ok(())
}

/// Connectivity without memory, to be refined into.
pub(crate) fn empty() -> Topology {
    Topology::from_parts(
        None,
        Vec::new(),
        Vec::new(),
        Vec::new(),
        Vec::new(),
        Vec::new(),
        Vec::new(),
        Vec::new(),
    )
}

/// Sizes the arrays of a refined topology, reusing their memory.
pub(super) fn allocate(fine: &mut Topology, halfedges: usize, edges: usize, vertices: usize) {
    resize(&mut fine.origin, halfedges, 0, |n| vec![0; n]);
    resize(&mut fine.edge_of, halfedges, 0, |n| vec![0; n]);
    resize(&mut fine.edges, edges, [0; 2], |n| vec![[0; 2]; n]);
    resize(&mut fine.first, vertices, 0, |n| vec![0; n]);
    resize(&mut fine.valence, vertices, 0, |n| vec![0; n]);
}

fn uniform(fine: &mut Topology, arity: u32) {
    fine.arity = Some(arity);
    fine.face_start.clear();
    fine.face_of.clear();
}

fn loop_connectivity(view: View<'_, Fixed<3>>, fine: &mut Topology) {
    let (vertices, edges, halfedges) = (view.first.len(), view.edges.len(), view.origin.len());
    let base = vertices as u32;
    let inner = 2 * edges as u32;
    uniform(fine, 3);
    allocate(fine, 4 * halfedges, 2 * edges + halfedges, vertices + edges);
    let (origins, _) = view.origin.as_chunks::<3>();
    let (face_edges, _) = view.edge_of.as_chunks::<3>();

    fill(&mut fine.origin, |f| {
        let [v0, v1, v2] = origins[f as usize];
        let [m0, m1, m2] = face_edges[f as usize].map(|e| base + e);
        [v0, m0, m2, v1, m1, m0, v2, m2, m1, m0, m1, m2]
    });
    fill(&mut fine.edge_of, |f| {
        let [e0, e1, e2] = face_edges[f as usize];
        let side = |e: u32, h: u32| 2 * e + u32::from(view.edges[e as usize][0] != h);
        let [a0, a1, a2] = [side(e0, 3 * f), side(e1, 3 * f + 1), side(e2, 3 * f + 2)];
        let [i0, i1, i2] = [inner + 3 * f, inner + 3 * f + 1, inner + 3 * f + 2];
        // a ^ 1 is the other half of the same edge.
        [a0, i0, a2 ^ 1, a1, i1, a0 ^ 1, a2, i2, a1 ^ 1, i1, i2, i0]
    });
    let starts = |h: u32| 3 * (h + h / 3);
    let ends = |h: u32| starts(view.corners.next(h)) + 2;
    let (halves, inner) = fine.edges.split_at_mut(2 * edges);
    fill(halves, |e| halve(view.edges[e as usize], starts, ends));
    fill(inner, |f| {
        [
            [12 * f + 1, 12 * f + 11],
            [12 * f + 4, 12 * f + 9],
            [12 * f + 7, 12 * f + 10],
        ]
    });

    let (old, new) = fine.first.split_at_mut(vertices);
    fill(old, |v| [old_first(view.first[v as usize], starts)]);
    fill(new, |e| [ends(view.edges[e as usize][0])]);
    let (old, new) = fine.valence.split_at_mut(vertices);
    old.copy_from_slice(view.valence);
    fill(new, |e| {
        [if view.edges[e as usize][1] == NONE {
            4 | BOUNDARY
        } else {
            6
        }]
    });
}

fn catmull_clark_connectivity<C: Corners>(view: View<'_, C>, faces: u32, fine: &mut Topology) {
    let (vertices, edges, halfedges) = (view.first.len(), view.edges.len(), view.origin.len());
    let (base, centres) = (vertices as u32, (vertices + edges) as u32);
    let inner = 2 * edges as u32;
    uniform(fine, 4);
    allocate(
        fine,
        4 * halfedges,
        2 * edges + halfedges,
        vertices + edges + faces as usize,
    );

    fill(&mut fine.origin, |h| {
        let before = view.edge_of[view.corners.prev(h) as usize];
        let along = view.edge_of[h as usize];
        [
            view.origin[h as usize],
            base + along,
            centres + view.corners.face(h),
            base + before,
        ]
    });
    fill(&mut fine.edge_of, |h| {
        let prev = view.corners.prev(h);
        let half = |h: u32| 2 * view.edge_of[h as usize] + view.side(h);
        [half(h), inner + h, inner + prev, half(prev) ^ 1]
    });
    let starts = |h: u32| 4 * h;
    let ends = |h: u32| 4 * view.corners.next(h) + 3;
    let (halves, inner) = fine.edges.split_at_mut(2 * edges);
    fill(halves, |e| halve(view.edges[e as usize], starts, ends));
    fill(inner, |h| [[4 * h + 1, 4 * view.corners.next(h) + 2]]);

    let (old, new) = fine.first.split_at_mut(vertices);
    let (new, centre) = new.split_at_mut(edges);
    fill(old, |v| [old_first(view.first[v as usize], starts)]);
    fill(new, |e| [ends(view.edges[e as usize][0])]);
    fill(centre, |f| [4 * view.corners.start(f) + 2]);
    let (old, new) = fine.valence.split_at_mut(vertices);
    let (new, centre) = new.split_at_mut(edges);
    old.copy_from_slice(view.valence);
    fill(new, |e| {
        [if view.edges[e as usize][1] == NONE {
            3 | BOUNDARY
        } else {
            4
        }]
    });
    fill(centre, |f| [view.corners.size(f)]);
}

/// The half-edges of the two halves of an edge; `starts(h)` is the first half of h, `ends(h)` the second.
#[inline]
fn halve(
    [a, b]: [u32; 2],
    starts: impl Fn(u32) -> u32,
    ends: impl Fn(u32) -> u32,
) -> [[u32; 2]; 2] {
    if b == NONE {
        [[starts(a), NONE], [ends(a), NONE]]
    } else {
        [[starts(a), ends(b)], [ends(a), starts(b)]]
    }
}

#[inline]
fn old_first(h: u32, starts: impl Fn(u32) -> u32) -> u32 {
    if h == NONE { NONE } else { starts(h) }
}
