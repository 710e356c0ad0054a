//! Flat views of a topology for the hot loops, and the loops themselves.

use num_traits::Zero;
use rayon::prelude::*;

use crate::mesh::Topology;

/// Marks a boundary vertex in `Topology::valence`.
pub(crate) const BOUNDARY: u32 = 1 << 31;

/// Below this many outputs threads cost more than they save.
const PARALLEL_MINIMUM: usize = 1 << 14;

/// How half-edges are arranged in faces; a type per arity, so that no loop asks.
pub(crate) trait Corners: Copy + Send + Sync {
    fn next(self, h: u32) -> u32;
    fn prev(self, h: u32) -> u32;
    fn face(self, h: u32) -> u32;
    fn start(self, face: u32) -> u32;
    fn size(self, face: u32) -> u32;
}

/// Every face has M corners, M known when compiling.
#[derive(Clone, Copy)]
pub(crate) struct Fixed<const M: u32>;

impl<const M: u32> Corners for Fixed<M> {
    #[inline]
    fn next(self, h: u32) -> u32 {
        if h % M == M - 1 {
            h.wrapping_sub(M - 1)
        } else {
            h.wrapping_add(1)
        }
    }
    #[inline]
    fn prev(self, h: u32) -> u32 {
        if h.is_multiple_of(M) {
            h.wrapping_add(M - 1)
        } else {
            h.wrapping_sub(1)
        }
    }
    #[inline]
    fn face(self, h: u32) -> u32 {
        h / M
    }
    #[inline]
    fn start(self, face: u32) -> u32 {
        face * M
    }
    #[inline]
    fn size(self, _: u32) -> u32 {
        M
    }
}

/// Every face has the same number of corners.
#[derive(Clone, Copy)]
pub(crate) struct Same(pub u32);

impl Corners for Same {
    #[inline]
    fn next(self, h: u32) -> u32 {
        if h % self.0 == self.0 - 1 {
            h - (self.0 - 1)
        } else {
            h + 1
        }
    }
    #[inline]
    fn prev(self, h: u32) -> u32 {
        if h.is_multiple_of(self.0) {
            h + (self.0 - 1)
        } else {
            h - 1
        }
    }
    #[inline]
    fn face(self, h: u32) -> u32 {
        h / self.0
    }
    #[inline]
    fn start(self, face: u32) -> u32 {
        face * self.0
    }
    #[inline]
    fn size(self, _: u32) -> u32 {
        self.0
    }
}

/// Faces of several sizes.
#[derive(Clone, Copy)]
pub(crate) struct Mixed<'a> {
    pub face_start: &'a [u32],
    pub face_of: &'a [u32],
}

impl Corners for Mixed<'_> {
    #[inline]
    fn next(self, h: u32) -> u32 {
        let face = self.face_of[h as usize] as usize;
        if h + 1 == self.face_start[face + 1] {
            self.face_start[face]
        } else {
            h + 1
        }
    }
    #[inline]
    fn prev(self, h: u32) -> u32 {
        let face = self.face_of[h as usize] as usize;
        if h == self.face_start[face] {
            self.face_start[face + 1] - 1
        } else {
            h - 1
        }
    }
    #[inline]
    fn face(self, h: u32) -> u32 {
        self.face_of[h as usize]
    }
    #[inline]
    fn start(self, face: u32) -> u32 {
        self.face_start[face as usize]
    }
    #[inline]
    fn size(self, face: u32) -> u32 {
        self.face_start[face as usize + 1] - self.face_start[face as usize]
    }
}

/// The arrays of a topology with its arrangement of corners.
#[derive(Clone, Copy)]
pub(crate) struct View<'a, C> {
    pub corners: C,
    pub origin: &'a [u32],
    pub edge_of: &'a [u32],
    pub edges: &'a [[u32; 2]],
    pub first: &'a [u32],
    pub valence: &'a [u32],
}

impl<'a, C: Corners> View<'a, C> {
    pub(crate) fn new(topology: &'a Topology, corners: C) -> Self {
        View {
            corners,
            origin: &topology.origin,
            edge_of: &topology.edge_of,
            edges: &topology.edges,
            first: &topology.first,
            valence: &topology.valence,
        }
    }

    /// Where `h` starts.
    #[inline]
    pub(crate) fn origin(&self, h: u32) -> usize {
        self.origin[h as usize] as usize
    }

    /// The other half-edge of the edge of `h`; `NONE` on the boundary.
    #[inline]
    pub(crate) fn twin(&self, h: u32) -> u32 {
        // h is one of the two: the exclusive or leaves the other.
        let [a, b] = self.edges[self.edge_of[h as usize] as usize];
        a ^ b ^ h
    }

    /// 0 if `h` is the first half-edge of its edge, 1 if the second.
    #[inline]
    pub(crate) fn side(&self, h: u32) -> u32 {
        u32::from(self.edges[self.edge_of[h as usize] as usize][0] != h)
    }

    /// The neighbours of a boundary vertex along the boundary.
    #[inline]
    pub(crate) fn boundary_neighbours(&self, v: u32) -> [usize; 2] {
        let first = self.first[v as usize];
        let faces = (self.valence[v as usize] & !BOUNDARY) - 1;
        let mut h = first;
        for _ in 1..faces {
            h = self.twin(self.corners.prev(h));
        }
        [
            self.origin(self.corners.next(first)),
            self.origin(self.corners.prev(h)),
        ]
    }
}

/// Evaluates an expression over the view that fits the topology's faces.
macro_rules! with_view {
    ($topology:expr, $view:ident => $body:expr) => {
        match $topology.arity {
            Some(3) => {
                let $view = $crate::refine::corners::View::new(
                    $topology,
                    $crate::refine::corners::Fixed::<3>,
                );
                $body
            }
            Some(4) => {
                let $view = $crate::refine::corners::View::new(
                    $topology,
                    $crate::refine::corners::Fixed::<4>,
                );
                $body
            }
            Some(m) => {
                let $view =
                    $crate::refine::corners::View::new($topology, $crate::refine::corners::Same(m));
                $body
            }
            None => {
                let $view = $crate::refine::corners::View::new(
                    $topology,
                    $crate::refine::corners::Mixed {
                        face_start: &$topology.face_start,
                        face_of: &$topology.face_of,
                    },
                );
                $body
            }
        }
    };
}
pub(crate) use with_view;

/// Whether `outputs` results are worth several threads here.
pub(crate) fn parallel(outputs: usize) -> bool {
    outputs >= PARALLEL_MINIMUM && rayon::current_num_threads() > 1
}

/// Hands `out` in chunks of `size`, with the index of each chunk's first element, to several threads.
///
/// The work comes as a trait object so that the machinery of the thread pool is compiled once per
/// element type, not once per formula.
fn in_chunks<T: Send>(out: &mut [T], size: usize, work: &(dyn Fn(usize, &mut [T]) + Sync)) {
    out.par_chunks_mut(size)
        .enumerate()
        .for_each(|(i, chunk)| work(i * size, chunk));
}

/// Elements per chunk, roughly.
const CHUNK: usize = 1 << 13;

/// `out[N i .. N i + N] = f(i)`: the same values for any number of threads.
#[inline]
pub(crate) fn fill<T: Send, const N: usize>(out: &mut [T], f: impl Fn(u32) -> [T; N] + Sync) {
    let run = |first: usize, out: &mut [T]| {
        let (chunks, rest) = out.as_chunks_mut::<N>();
        debug_assert!(rest.is_empty());
        for (i, chunk) in (first / N..).zip(chunks) {
            *chunk = f(i as u32);
        }
    };
    if parallel(out.len() / N) {
        in_chunks(out, CHUNK * N, &run);
    } else {
        run(0, out);
    }
}

/// Gives `buffer` the length `len`, reusing its memory; old contents may remain.
pub(crate) fn resize<T: Copy>(
    buffer: &mut Vec<T>,
    len: usize,
    zero: T,
    fresh: fn(usize) -> Vec<T>,
) {
    if buffer.capacity() < len {
        *buffer = fresh(len); // zeroed pages of the system, touched once
    } else {
        buffer.resize(len, zero);
    }
}

/// `out = f(0), .., f(n - 1)`: the same values for any number of threads.
#[inline]
pub(crate) fn tabulate<V: Clone + Zero + Send>(
    out: &mut Vec<V>,
    n: u32,
    f: impl Fn(u32) -> V + Sync,
) {
    if !parallel(n as usize) {
        out.clear();
        out.reserve_exact(n as usize);
        out.extend((0..n).map(f));
        return;
    }
    out.resize(n as usize, V::zero());
    update(out, |i, value| *value = f(i));
}

/// Calls `f(i, &mut out[i])` for each i, in any order.
#[inline]
pub(crate) fn update<V: Send>(out: &mut [V], f: impl Fn(u32, &mut V) + Sync) {
    let run = |start: usize, out: &mut [V]| {
        for (i, value) in (start as u32..).zip(out) {
            f(i, value);
        }
    };
    if parallel(out.len()) {
        in_chunks(out, CHUNK, &run);
    } else {
        run(0, out);
    }
}
