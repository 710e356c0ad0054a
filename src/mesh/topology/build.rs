//! From a list of faces to connectivity, in linear time without hashing.
//!
//! 1. One pass over the faces tests them and counts half-edges by the smaller of their ends.
//! 2. A counting sort puts the half-edges into one bucket per smaller end.
//! 3. Within a bucket, half-edges with the same larger end are one edge. Buckets are short (six
//!    half-edges on average when faces are triangles); the few long ones are sorted.
//! 4. A walk round each vertex counts its fan. If the fans hold all corners, each vertex has one.

use super::layout::{Layout, Polygons, Uniform, UniformOf};
use super::{BOUNDARY, NONE, Topology, TopologyError};

/// Half-edges of an edge are recognised by linear search in buckets up to this size.
const SHORT: usize = 32;

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
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
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

/// A half-edge in its bucket: larger end, half-edge, and whether it starts at the larger end; so
/// the order of numbers is the order by larger end, then by half-edge.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
struct Entry(u64);

impl Entry {
    #[inline(always)]
    fn new(from: u32, to: u32, h: u32) -> Self {
        Self(u64::from(from.max(to)) << 32 | u64::from(h << 1 | u32::from(from > to)))
    }
    #[inline(always)]
    fn larger(self) -> u32 {
        (self.0 >> 32) as u32
    }
    #[inline(always)]
    fn halfedge(self) -> u32 {
        self.0 as u32 >> 1
    }
    #[inline(always)]
    fn is_down(self) -> u32 {
        self.0 as u32 & 1
    }
}

/// Finds the edges: `edge_of` and `edges`.
fn pair<L: Layout>(
    layout: L,
    origin: &[u32],
    mut ends: Vec<u32>,
) -> Result<(Vec<u32>, Vec<[u32; 2]>), TopologyError> {
    let mut entries = vec![Entry::default(); origin.len()];
    let mut h = 0;
    for f in 0..layout.face_count(origin.len()) {
        let corners = layout.corners(origin, f);
        let mut from = corners[0];
        for i in 0..corners.len() {
            let to = corners[if i + 1 == corners.len() { 0 } else { i + 1 }];
            let end = &mut ends[from.min(to) as usize];
            entries[*end as usize] = Entry::new(from, to, h);
            *end += 1;
            h += 1;
            from = to;
        }
    }

    let mut edge_of = vec![0; origin.len()];
    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(origin.len() / 2 + 1);
    let mut seen = [Entry::default(); SHORT];
    let mut long = Vec::new();
    let mut begin = 0;
    for (v, &end) in ends.iter().enumerate() {
        let bucket = &entries[begin..end as usize];
        begin = end as usize;
        let base = edges.len();
        let fault = |other| Err(edge_fault(layout, origin, bucket, [v as u32, other]));
        if bucket.len() > SHORT {
            if let Some(other) = pair_long(bucket, &mut long, &mut edge_of, &mut edges) {
                return fault(other);
            }
            continue;
        }
        for &entry in bucket {
            let open = edges.len() - base;
            let found = seen[..open]
                .iter()
                .position(|e| e.larger() == entry.larger());
            let h = entry.halfedge();
            let Some(i) = found else {
                edge_of[h as usize] = edges.len() as u32;
                seen[open] = entry;
                edges.push([h, NONE]);
                continue;
            };
            let second = &mut edges[base + i][1];
            if *second != NONE || seen[i].is_down() == entry.is_down() {
                return fault(entry.larger());
            }
            *second = h;
            edge_of[h as usize] = (base + i) as u32;
        }
    }
    Ok((edge_of, edges))
}

/// Pairs a long bucket by sorting it; returns the larger end of an edge that can't be.
#[cold]
fn pair_long(
    bucket: &[Entry],
    found: &mut Vec<[Entry; 2]>,
    edge_of: &mut [u32],
    edges: &mut Vec<[u32; 2]>,
) -> Option<u32> {
    let mut sorted = bucket.to_vec();
    sorted.sort_unstable();
    found.clear();
    for run in sorted.chunk_by(|a, b| a.larger() == b.larger()) {
        match *run {
            [a] => found.push([a, a]),
            [a, b] if a.is_down() != b.is_down() => found.push([a, b]),
            _ => return Some(run[0].larger()),
        }
    }
    found.sort_unstable_by_key(|halves| halves[0].halfedge());
    for &[a, b] in &*found {
        edge_of[a.halfedge() as usize] = edges.len() as u32;
        edge_of[b.halfedge() as usize] = edges.len() as u32;
        edges.push([a.halfedge(), if a == b { NONE } else { b.halfedge() }]);
    }
    None
}

/// Says what is wrong with the edge of these ends.
#[cold]
fn edge_fault<L: Layout>(
    layout: L,
    origin: &[u32],
    bucket: &[Entry],
    vertices: [u32; 2],
) -> TopologyError {
    let halves: Vec<u32> = bucket
        .iter()
        .filter(|e| e.larger() == vertices[1])
        .map(|e| e.halfedge())
        .collect();
    let cycle = |h: u32| {
        let walk = std::iter::successors(Some(layout.next(h)), |&i| Some(layout.next(i)));
        walk.take_while(move |&i| i != h)
            .map(|i| origin[i as usize])
    };
    let face = |h: u32| layout.face_of(h);
    let mut clash = None;
    for (i, &a) in halves.iter().enumerate().take(3) {
        for &b in &halves[i + 1..halves.len().min(3)] {
            if origin[a as usize] != origin[b as usize] {
                continue;
            }
            if cycle(a).eq(cycle(b)) {
                return TopologyError::DuplicateFace {
                    faces: [face(a), face(b)],
                };
            }
            clash = Some([a, b]);
        }
    }
    match (&halves[..], clash) {
        (&[a, b, c, ..], _) => TopologyError::NonManifoldEdge {
            vertices,
            faces: [face(a), face(b), face(c)],
        },
        (_, Some([a, b])) => TopologyError::ClashingOrientation {
            vertices: [a, layout.next(a)].map(|h| origin[h as usize]),
            faces: [face(a), face(b)],
        },
        _ => unreachable!("two opposite half-edges make an edge"),
    }
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
    let mut walked = 0;
    for (&start, valence) in first.iter().zip(&mut valence) {
        if start == NONE {
            continue;
        }
        let (mut h, mut faces) = (start, 0);
        while h != NONE && (faces == 0 || h != start) {
            faces += 1;
            h = rotate(h);
        }
        walked += faces;
        *valence |= faces + (*valence >> 31);
    }
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
