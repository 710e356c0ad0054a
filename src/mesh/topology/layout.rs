//! How half-edges are grouped into faces, known at compile time where speed counts.

use super::{next_in, prev_in};

/// How half-edges are grouped into faces.
pub(super) trait Layout: Copy + Sync {
    fn next(self, h: u32) -> u32;
    fn prev(self, h: u32) -> u32;
    fn face_of(self, h: u32) -> u32;
    fn face_count(self, corners: usize) -> usize;
    fn corners(self, all: &[u32], face: usize) -> &[u32];
}

/// All faces have M corners, M known to the compiler.
#[derive(Clone, Copy)]
pub(super) struct Uniform<const M: u32>;

impl<const M: u32> Layout for Uniform<M> {
    #[inline(always)]
    fn next(self, h: u32) -> u32 {
        next_in::<M>(h)
    }
    #[inline(always)]
    fn prev(self, h: u32) -> u32 {
        prev_in::<M>(h)
    }
    #[inline(always)]
    fn face_of(self, h: u32) -> u32 {
        h / M
    }
    #[inline(always)]
    fn face_count(self, corners: usize) -> usize {
        corners / M as usize
    }
    #[inline(always)]
    fn corners(self, all: &[u32], face: usize) -> &[u32] {
        &all[face * M as usize..][..M as usize]
    }
}

/// All faces have so many corners.
#[derive(Clone, Copy)]
pub(super) struct UniformOf(pub u32);

impl Layout for UniformOf {
    fn next(self, h: u32) -> u32 {
        if h % self.0 == self.0 - 1 {
            h + 1 - self.0
        } else {
            h + 1
        }
    }
    fn prev(self, h: u32) -> u32 {
        if h.is_multiple_of(self.0) {
            h + self.0 - 1
        } else {
            h - 1
        }
    }
    fn face_of(self, h: u32) -> u32 {
        h / self.0
    }
    fn face_count(self, corners: usize) -> usize {
        corners / self.0 as usize
    }
    fn corners(self, all: &[u32], face: usize) -> &[u32] {
        &all[face * self.0 as usize..][..self.0 as usize]
    }
}

/// Faces of any sizes, by the fields of `Topology`.
#[derive(Clone, Copy)]
pub(super) struct Polygons<'a> {
    pub start: &'a [u32],
    pub face_of: &'a [u32],
}

impl Layout for Polygons<'_> {
    #[inline]
    fn next(self, h: u32) -> u32 {
        let face = self.face_of[h as usize] as usize;
        if h + 1 == self.start[face + 1] {
            self.start[face]
        } else {
            h + 1
        }
    }
    #[inline]
    fn prev(self, h: u32) -> u32 {
        let face = self.face_of[h as usize] as usize;
        if h == self.start[face] {
            self.start[face + 1] - 1
        } else {
            h - 1
        }
    }
    #[inline]
    fn face_of(self, h: u32) -> u32 {
        self.face_of[h as usize]
    }
    fn face_count(self, _: usize) -> usize {
        self.start.len() - 1
    }
    #[inline]
    fn corners(self, all: &[u32], face: usize) -> &[u32] {
        &all[self.start[face] as usize..self.start[face + 1] as usize]
    }
}
