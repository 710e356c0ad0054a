//! Half-edges with the same ends become edges: buckets by smaller end, without hashing.
//!
//! Entries carry the larger end with them. A variant without search, by a table from the larger end
//! to its newest edge, and with entries that look both ends up, took 1.3 times (lattice order) and
//! 1.7 times (no order) the processor time; which of its two changes costs, was not separated.

use super::layout::Layout;
use super::{NONE, TopologyError};

/// Half-edges of an edge are recognised by linear search in buckets up to this size.
const SHORT: usize = 32;

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
pub(super) fn pair<L: Layout>(
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
