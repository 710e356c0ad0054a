//! Connectivity of Doo-Sabin refinement; the formulas are in [`super::topology`].

use super::corners::{BOUNDARY, Corners, View, fill, resize};
use super::topology::allocate;
use crate::mesh::{NONE, Topology};

/// Ranks of the coarse elements that become faces.
struct Ranks {
    /// r(e) for edges of two faces, NONE for the others; empty if the mesh is closed: r(e) = e.
    edge: Vec<u32>,
    /// Number of edges of two faces.
    edges: u32,
    /// First half-edge of the face of each interior vertex, NONE for the others.
    start: Vec<u32>,
    /// Number of interior vertices.
    vertices: u32,
    /// Number of half-edges of the fine mesh.
    halfedges: u32,
}

impl Ranks {
    fn new<C: Corners>(view: &View<'_, C>) -> Self {
        let boundary = view.edges.iter().filter(|halves| halves[1] == NONE).count();
        let edges = (view.edges.len() - boundary) as u32;
        let mut edge = Vec::new();
        if boundary > 0 {
            let mut rank = 0;
            edge.extend(view.edges.iter().map(|halves| {
                let own = if halves[1] == NONE { NONE } else { rank };
                rank += u32::from(own != NONE);
                own
            }));
        }
        let mut next = view.origin.len() as u32 + 4 * edges;
        let mut vertices = 0;
        let interior = |word: u32| word & BOUNDARY == 0 && word > 0;
        let start = view
            .valence
            .iter()
            .map(|&word| {
                let own = if interior(word) { next } else { NONE };
                if interior(word) {
                    next += word;
                    vertices += 1;
                }
                own
            })
            .collect();
        Ranks {
            edge,
            edges,
            start,
            vertices,
            halfedges: next,
        }
    }

    #[inline]
    fn edge(&self, e: u32) -> u32 {
        if self.edge.is_empty() {
            e
        } else {
            self.edge[e as usize]
        }
    }
}

pub(super) fn connectivity<C: Corners>(view: View<'_, C>, faces: u32, fine: &mut Topology) {
    let ranks = Ranks::new(&view);
    let h_count = view.origin.len() as u32;
    let quads_end = h_count + 4 * ranks.edges;
    let edge_total = h_count + 2 * ranks.edges;
    allocate(
        fine,
        ranks.halfedges as usize,
        edge_total as usize,
        view.origin.len(),
    );

    face_lists(&view, &ranks, faces, fine);
    vertex_arrays(&view, &ranks, fine);

    // Face faces: half-edge h from vertex h, on edge h. The twin, if any, is in the edge quad.
    let quad = |e: u32| h_count + 4 * ranks.edge(e);
    let across = |h: u32| h_count + 2 * ranks.edge(view.edge_of[h as usize]) + view.side(h);
    let h_usize = h_count as usize;
    fill(&mut fine.origin[..h_usize], |h| [h]);
    fill(&mut fine.edge_of[..h_usize], |h| [h]);
    fill(&mut fine.edges[..h_usize], |h| {
        let e = view.edge_of[h as usize];
        // quad corners (a, next(b), b, next(a)): next(b) -> b is its half-edge 1, next(a) -> a is 3
        let twin = if view.edges[e as usize][1] == NONE {
            NONE
        } else {
            quad(e) + 3 - 2 * view.side(h)
        };
        [[h, twin]]
    });

    // Edge quads; a boundary vertex leaves its crossing edge open.
    for (e, &[a, b]) in view.edges.iter().enumerate() {
        if b == NONE {
            continue;
        }
        let q = quad(e as u32) as usize;
        let crossing = h_count + 2 * ranks.edge(e as u32);
        let corners = [a, view.corners.next(b), b, view.corners.next(a)];
        fine.origin[q..q + 4].copy_from_slice(&corners);
        fine.edge_of[q..q + 4].copy_from_slice(&[crossing, b, crossing + 1, a]);
        fine.edges[crossing as usize] = [q as u32, NONE];
        fine.edges[crossing as usize + 1] = [q as u32 + 2, NONE];
    }

    // Vertex faces: from h to rotate(h), across the edge whose half-edge at v is rotate(h).
    for (v, &start) in ranks.start.iter().enumerate() {
        if start == NONE {
            continue;
        }
        let mut h = view.first[v];
        for slot in start..start + view.valence[v] {
            let next = view.twin(view.corners.prev(h));
            let edge = across(next);
            fine.origin[slot as usize] = h;
            fine.edge_of[slot as usize] = edge;
            fine.edges[edge as usize][1] = slot;
            h = next;
        }
    }
    debug_assert!(quads_end <= ranks.halfedges);
}

/// Arity, or first half-edges and faces of half-edges.
fn face_lists<C: Corners>(view: &View<'_, C>, ranks: &Ranks, faces: u32, fine: &mut Topology) {
    let h_count = view.origin.len() as u32;
    let sizes = (0..faces)
        .map(|f| view.corners.size(f))
        .chain((0..ranks.edges).map(|_| 4))
        .chain(
            (0..view.first.len())
                .filter(|&v| ranks.start[v] != NONE)
                .map(|v| view.valence[v]),
        );
    let size = view.corners.size(0);
    let uniform = sizes.clone().all(|other| other == size);
    fine.arity = uniform.then_some(size);
    fine.face_start.clear();
    fine.face_of.clear();
    if uniform {
        return;
    }
    let count = (faces + ranks.edges + ranks.vertices) as usize;
    fine.face_start.reserve_exact(count + 1);
    resize(&mut fine.face_of, ranks.halfedges as usize, 0, |n| {
        vec![0; n]
    });
    let mut start = 0;
    for (f, size) in sizes.enumerate() {
        fine.face_start.push(start);
        fine.face_of[start as usize..(start + size) as usize].fill(f as u32);
        start += size;
    }
    fine.face_start.push(start);
    debug_assert!(start == ranks.halfedges && h_count <= start);
}

/// First half-edge and valence of each fine vertex, the corner h of a face at the coarse vertex v.
///
/// Its edges: h and prev(h), always; one across each of those that is interior. At an interior v
/// these are four. At a boundary v its fan starts with the quad of the edge of h if there is one
/// (that quad's crossing edge is then open), else with h itself, whose edge is open.
fn vertex_arrays<C: Corners>(view: &View<'_, C>, ranks: &Ranks, fine: &mut Topology) {
    let h_count = view.origin.len() as u32;
    let open = |h: u32| view.edges[view.edge_of[h as usize] as usize][1] == NONE;
    let at_boundary = |h: u32| view.valence[view.origin(h)] & BOUNDARY != 0;
    fill(&mut fine.first, |h| {
        [if !at_boundary(h) || open(h) {
            h
        } else {
            h_count + 4 * ranks.edge(view.edge_of[h as usize]) + 2 * view.side(h)
        }]
    });
    fill(&mut fine.valence, |h| {
        [if at_boundary(h) {
            (4 - u32::from(open(h)) - u32::from(open(view.corners.prev(h)))) | BOUNDARY
        } else {
            4
        }]
    });
}
