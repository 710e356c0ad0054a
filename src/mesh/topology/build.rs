//! From a list of faces to connectivity, in linear time without hashing.
//!
//! 1. One pass over the faces tests them and counts half-edges by the smaller of their ends.
//! 2. A counting sort puts the half-edges into one bucket per smaller end.
//! 3. Within a bucket, half-edges with the same larger end are one edge. Buckets are short (six
//!    half-edges on average when faces are triangles); the few long ones are sorted.
//! 4. A walk round each vertex counts its fan. If the fans hold all corners, each vertex has one.

use rayon::prelude::*;

use super::layout::{Layout, Polygons, Uniform, UniformOf};
use super::pairing::pair;
use super::{BOUNDARY, NONE, Topology, TopologyError};

/// Repeated corners are found by linear search in faces up to this size.
const SHORT: usize = 32;

/// Vertices of which one thread is faster.
const FEW: usize = 1 << 14;

/// Half-edges must leave a bit for their direction.
const MAX_CORNERS: usize = (1 << 31) - 1;

pub(super) fn uniform(
    vertex_count: usize,
    arity: u32,
    corners: Vec<u32>,
) -> Result<Topology, TopologyError> {
    check_sizes(vertex_count, corners.len())?;
    if arity < 3 {
        return Err(TopologyError::FewCorners {
            face: 0,
            corners: arity,
        });
    }
    if !corners.len().is_multiple_of(arity as usize) {
        return Err(TopologyError::PartialFace {
            corners: corners.len(),
            arity,
        });
    }
    let links = match arity {
        3 => link(Uniform::<3>, vertex_count, &corners),
        4 => link(Uniform::<4>, vertex_count, &corners),
        m => link(UniformOf(m), vertex_count, &corners),
    }?;
    Ok(links.with(Some(arity), Vec::new(), Vec::new(), corners))
}

pub(super) fn polygons(
    vertex_count: usize,
    face_start: Vec<u32>,
    corners: Vec<u32>,
) -> Result<Topology, TopologyError> {
    check_starts(&face_start, corners.len())?;
    check_sizes(vertex_count, corners.len())?;
    let size = |f: usize| face_start[f + 1] - face_start[f];
    let faces = face_start.len() - 1;
    if (1..faces).all(|f| size(f) == size(0)) {
        return uniform(vertex_count, size(0), corners);
    }
    let mut face_of = Vec::with_capacity(corners.len());
    for f in 0..faces {
        if size(f) < 3 {
            return Err(TopologyError::FewCorners {
                face: f as u32,
                corners: size(f),
            });
        }
        face_of.resize(face_start[f + 1] as usize, f as u32);
    }
    let layout = Polygons {
        start: &face_start,
        face_of: &face_of,
    };
    let links = link(layout, vertex_count, &corners)?;
    Ok(links.with(None, face_start, face_of, corners))
}

fn check_starts(start: &[u32], corners: usize) -> Result<(), TopologyError> {
    let wrong = |entry| Err(TopologyError::FaceStart { entry });
    if start.first() != Some(&0) {
        return wrong(0);
    }
    if let Some(i) = start.windows(2).position(|pair| pair[0] > pair[1]) {
        return wrong(i + 1);
    }
    if start[start.len() - 1] as usize != corners {
        return wrong(start.len() - 1);
    }
    if start.len() == 1 {
        return Err(TopologyError::NoFace);
    }
    Ok(())
}

fn check_sizes(vertices: usize, corners: usize) -> Result<(), TopologyError> {
    let limit = (u32::MAX - 1) as usize;
    if vertices > limit {
        return Err(TopologyError::TooLarge {
            what: "vertices",
            count: vertices,
            limit,
        });
    }
    if corners > MAX_CORNERS {
        let limit = MAX_CORNERS;
        return Err(TopologyError::TooLarge {
            what: "face corners",
            count: corners,
            limit,
        });
    }
    if corners == 0 {
        return Err(TopologyError::NoFace);
    }
    Ok(())
}

/// All of a topology that is found, not given.
struct Links {
    edge_of: Vec<u32>,
    edges: Vec<[u32; 2]>,
    first: Vec<u32>,
    valence: Vec<u32>,
}

impl Links {
    fn with(
        self,
        arity: Option<u32>,
        face_start: Vec<u32>,
        face_of: Vec<u32>,
        origin: Vec<u32>,
    ) -> Topology {
        let Self {
            edge_of,
            edges,
            first,
            valence,
        } = self;
        Topology {
            arity,
            face_start,
            face_of,
            origin,
            edge_of,
            edges,
            first,
            valence,
        }
    }
}

fn link<L: Layout>(layout: L, vertices: usize, origin: &[u32]) -> Result<Links, TopologyError> {
    let (ends, mut first) = check_and_count(layout, vertices, origin)?;
    let (edge_of, edges) = pair(layout, origin, ends)?;
    let valence = count_fans(layout, origin, &edge_of, &edges, &mut first)?;
    Ok(Links {
        edge_of,
        edges,
        first,
        valence,
    })
}

/// Tests each face alone. Returns the start of each vertex's bucket, and each vertex's smallest
/// outgoing half-edge.
fn check_and_count<L: Layout>(
    layout: L,
    vertices: usize,
    origin: &[u32],
) -> Result<(Vec<u32>, Vec<u32>), TopologyError> {
    let mut starts = vec![0u32; vertices];
    let mut first = vec![NONE; vertices];
    let mut sorted = Vec::new();
    let mut h = 0;
    for f in 0..layout.face_count(origin.len()) {
        let corners = layout.corners(origin, f);
        let largest = corners.iter().fold(0, |top, &v| top.max(v));
        if largest as usize >= vertices {
            let vertex = *corners
                .iter()
                .find(|&&v| v as usize >= vertices)
                .expect("one is");
            let (face, vertex_count) = (f as u32, vertices as u32);
            return Err(TopologyError::IndexOutOfRange {
                face,
                vertex,
                vertex_count,
            });
        }
        if let Some(vertex) = repeated(corners, &mut sorted) {
            return Err(TopologyError::RepeatedVertex {
                face: f as u32,
                vertex,
            });
        }
        let mut from = corners[corners.len() - 1];
        for &to in corners {
            starts[from.min(to) as usize] += 1;
            first[to as usize] = first[to as usize].min(h);
            h += 1;
            from = to;
        }
    }
    let mut total = 0;
    for start in &mut starts {
        total += std::mem::replace(start, total);
    }
    Ok((starts, first))
}

/// The first corner that occurs again.
#[inline(always)]
fn repeated(corners: &[u32], sorted: &mut Vec<u32>) -> Option<u32> {
    if let &[a, b, c] = corners
        && (a != b) & (b != c) & (c != a)
    {
        return None;
    }
    if let &[a, b, c, d] = corners
        && (a != b) & (a != c) & (a != d) & (b != c) & (b != d) & (c != d)
    {
        return None;
    }
    if corners.len() <= SHORT {
        let again = |i: usize| corners[i + 1..].contains(&corners[i]);
        return (0..corners.len()).find(|&i| again(i)).map(|i| corners[i]);
    }
    sorted.clear();
    sorted.extend_from_slice(corners);
    sorted.sort_unstable();
    sorted
        .windows(2)
        .find(|pair| pair[0] == pair[1])
        .map(|pair| pair[0])
}

/// Walks round each vertex: its valence with the boundary bit, and on the boundary its first
/// half-edge.
fn count_fans<L: Layout>(
    layout: L,
    origin: &[u32],
    edge_of: &[u32],
    edges: &[[u32; 2]],
    first: &mut [u32],
) -> Result<Vec<u32>, TopologyError> {
    let mut valence = vec![0; first.len()];
    for &[h, twin] in edges {
        if twin == NONE {
            let v = origin[h as usize] as usize;
            first[v] = h;
            valence[v] = BOUNDARY;
        }
    }
    let rotate = |h: u32| {
        let prev = layout.prev(h);
        let [a, b] = edges[edge_of[prev as usize] as usize];
        a ^ b ^ prev
    };
    let walk = |(&start, valence): (&u32, &mut u32)| {
        if start == NONE {
            return 0;
        }
        let (mut h, mut faces) = (start, 0);
        while h != NONE && (faces == 0 || h != start) {
            faces += 1;
            h = rotate(h);
        }
        *valence |= faces + (*valence >> 31);
        faces
    };
    let walked: u32 = if first.len() < FEW {
        first.iter().zip(&mut valence).map(walk).sum()
    } else {
        let vertices = first.par_iter().zip(&mut valence);
        vertices.with_min_len(FEW / 4).map(walk).sum()
    };
    if walked as usize == origin.len() {
        return Ok(valence);
    }
    // Some corners are in no fan: the vertex of one of them has another fan.
    let mut in_fan = vec![false; origin.len()];
    for &start in first.iter().filter(|&&start| start != NONE) {
        let mut h = start;
        while h != NONE && !in_fan[h as usize] {
            in_fan[h as usize] = true;
            h = rotate(h);
        }
    }
    let others = (0..origin.len() as u32).filter(|&h| !in_fan[h as usize]);
    let other = others
        .min_by_key(|&h| (origin[h as usize], h))
        .expect("a corner in no fan");
    let vertex = origin[other as usize];
    let faces = [first[vertex as usize], other].map(|h| layout.face_of(h));
    Err(TopologyError::NonManifoldVertex { vertex, faces })
}
