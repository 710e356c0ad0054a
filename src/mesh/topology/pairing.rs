//! Half-edges with the same ends become edges: buckets by smaller end, without hashing.
//!
//! Entries carry the larger end with them, and become the edges in place. A variant without search, by a table from the larger end
//! to its newest edge, and with entries that look both ends up, took 1.3 times (lattice order) and
//! 1.7 times (no order) the processor time; which of its two changes costs, was not separated.

use super::layout::Layout;
use super::{NONE, TopologyError};

/// Half-edges of an edge are recognised by linear search in buckets up to this size.
const SHORT: usize = 32;

/// A half-edge in its bucket: larger end, then twice the half-edge, plus one if it starts at the
/// larger end; so the order is that by larger end, then by half-edge.
type Entry = [u32; 2];

#[inline(always)]
fn entry(from: u32, to: u32, h: u32) -> Entry {
    [from.max(to), h << 1 | u32::from(from > to)]
}

#[inline(always)]
fn halfedge([_, word]: Entry) -> u32 {
    word >> 1
}

#[inline(always)]
fn is_down([_, word]: Entry) -> u32 {
    word & 1
}

/// Finds the edges: `edge_of` and `edges`.
pub(super) fn pair<L: Layout>(
    layout: L,
    origin: &[u32],
    mut ends: Vec<u32>,
) -> Result<(Vec<u32>, Vec<[u32; 2]>), TopologyError> {
    let mut entries: Vec<Entry> = vec![[0; 2]; origin.len()];
    let mut h = 0;
    for f in 0..layout.face_count(origin.len()) {
        let corners = layout.corners(origin, f);
        let mut from = corners[0];
        for i in 0..corners.len() {
            let to = corners[if i + 1 == corners.len() { 0 } else { i + 1 }];
            let end = &mut ends[from.min(to) as usize];
            entries[*end as usize] = entry(from, to, h);
            *end += 1;
            h += 1;
            from = to;
        }
    }

    // There are no more edges than half-edges, so edges go where entries have been read: fresh
    // memory costs more than all that is done with it.
    let mut edge_of = vec![0; origin.len()];
    let mut edges = 0;
    let mut seen = [Entry::default(); SHORT];
    let mut long = Vec::new();
    let mut begin = 0;
    for (v, &end) in ends.iter().enumerate() {
        let bucket = begin..end as usize;
        begin = bucket.end;
        let base = edges;
        let fault = |other| Err(edge_fault(layout, origin, [v as u32, other]));
        if bucket.len() > SHORT {
            if let Some(other) = pair_long(&entries[bucket], &mut long) {
                return fault(other);
            }
            for &halves in &long {
                for h in halves.into_iter().filter(|&h| h != NONE) {
                    edge_of[h as usize] = edges as u32;
                }
                entries[edges] = halves;
                edges += 1;
            }
            continue;
        }
        for i in bucket {
            let entry = entries[i];
            let open = edges - base;
            let found = seen[..open].iter().position(|e| e[0] == entry[0]);
            let h = halfedge(entry);
            let Some(i) = found else {
                edge_of[h as usize] = edges as u32;
                seen[open] = entry;
                entries[edges] = [h, NONE];
                edges += 1;
                continue;
            };
            let second = &mut entries[base + i][1];
            if *second != NONE || is_down(seen[i]) == is_down(entry) {
                return fault(entry[0]);
            }
            *second = h;
            edge_of[h as usize] = (base + i) as u32;
        }
    }
    entries.truncate(edges);
    entries.shrink_to_fit();
    Ok((edge_of, entries))
}

/// Pairs a long bucket by sorting it; returns the larger end of an edge that can't be.
#[cold]
fn pair_long(bucket: &[Entry], edges: &mut Vec<[u32; 2]>) -> Option<u32> {
    let mut sorted = bucket.to_vec();
    sorted.sort_unstable();
    edges.clear();
    for run in sorted.chunk_by(|a, b| a[0] == b[0]) {
        match *run {
            [a] => edges.push([halfedge(a), NONE]),
            [a, b] if is_down(a) != is_down(b) => {
                let (a, b) = (halfedge(a), halfedge(b));
                edges.push([a.min(b), a.max(b)]);
            }
            _ => return Some(run[0][0]),
        }
    }
    edges.sort_unstable();
    None
}

/// Says what is wrong with the edge of these ends.
#[cold]
fn edge_fault<L: Layout>(layout: L, origin: &[u32], vertices: [u32; 2]) -> TopologyError {
    let [low, high] = vertices;
    let joins = |&h: &u32| {
        let [a, b] = [h, layout.next(h)].map(|h| origin[h as usize]);
        [a.min(b), a.max(b)] == [low, high]
    };
    let halves: Vec<u32> = (0..origin.len() as u32).filter(joins).collect();
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
