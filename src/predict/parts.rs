//! Passes over edges by several threads, each with maxima of its own.

use rayon::prelude::*;

use crate::mesh::Topology;

/// Edges below which one thread is faster.
pub(crate) const FEW: usize = 1 << 14;

/// In how many parts so many edges are gone over.
pub(crate) fn parts_of(edges: usize) -> usize {
    match edges < FEW {
        true => 1,
        false => rayon::current_num_threads().clamp(1, 8),
    }
}

/// A pass over edges that leaves a maximum at each vertex: parts of the edges have arrays of their own.
pub(crate) fn by_parts(
    topology: &Topology,
    of_edges: impl Fn(std::ops::Range<usize>, &mut [f64]) + Sync,
) -> Vec<f64> {
    let (edges, vertices) = (
        topology.edge_count() as usize,
        topology.vertex_count() as usize,
    );
    let parts = parts_of(edges);
    let part = |i: usize| {
        let mut top = vec![0.0_f64; vertices];
        of_edges(edges * i / parts..edges * (i + 1) / parts, &mut top);
        top
    };
    if parts == 1 {
        return part(0);
    }
    let all: Vec<Vec<f64>> = (0..parts)
        .into_par_iter()
        .with_max_len(1)
        .map(part)
        .collect();
    joined(all)
}

/// The maximum, entry by entry.
pub(crate) fn joined(mut all: Vec<Vec<f64>>) -> Vec<f64> {
    let Some(mut first) = all.pop() else {
        return Vec::new();
    };
    for other in &all {
        let pairs = first.par_iter_mut().zip(other).with_min_len(FEW);
        pairs.for_each(|(a, b)| *a = if b > a { *b } else { *a });
    }
    first
}
