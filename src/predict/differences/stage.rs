//! The faces of a mesh after a number of local steps, and the largest squares of all.

use std::sync::Arc;

use rayon::prelude::*;

use super::levels::{Kinds, Largest, Lengths, Outward, Seen, Visit};
use super::quads::QuadLevels;
use super::quarters::QuarterLevels;
use super::triangles::Triangles;
use super::whole::StageBounds;

/// The faces after a number of local steps.
#[derive(Clone, Debug)]
pub(super) struct Stage<'a> {
    pub(super) kinds: Arc<Kinds>,
    pub(super) outward: Outward,
    /// Lengths in the mesh's unit are 2^exponent times those here.
    pub(super) exponent: i32,
    pub(super) faces: Faces<'a>,
    /// Where those below a face of the mesh are.
    pub(super) children: Children,
}

/// Where the visited faces below a face of the mesh are.
#[derive(Clone, Debug)]
pub(super) enum Children {
    /// Face f has the faces `f << shift ..`.
    Shift(u32),
    /// Face f has the faces `start[f]..start[f + 1]`.
    Start(Vec<u32>),
    /// Face f has the faces listed.
    List(Vec<Vec<u32>>),
}

#[derive(Clone, Debug)]
pub(super) enum Faces<'a> {
    Triangles(Box<Triangles<'a>>),
    Quads(QuadLevels<'a>),
    Quarters(QuarterLevels<'a>),
}

impl Faces<'_> {
    #[inline]
    fn visit(&self, face: u32, to: &mut impl Visit) {
        match self {
            Faces::Triangles(triangles) => triangles.visit(face, to),
            Faces::Quads(quads) => quads.visit(face, to),
            Faces::Quarters(quarters) => quarters.visit(face, to),
        }
    }

    /// Faces of the first level, and how many levels follow.
    fn extent(&self) -> (u32, usize) {
        match self {
            Faces::Triangles(t) => (t.face_count(), t.level() + 2),
            Faces::Quads(q) => (q.levels[0].0.face_count(), q.first + q.levels.len()),
            Faces::Quarters(q) => {
                let first = q.levels[0].topology.face_count();
                (first, q.first + q.levels.len())
            }
        }
    }
}

/// Faces below which one thread is faster.
pub(super) const BLOCK: u32 = 1 << 13;

impl Stage<'_> {
    /// The bounds of the whole mesh.
    pub(super) fn bounds(&self) -> StageBounds {
        let (count, levels) = self.faces.extent();
        let new = || Largest::new(levels, self.kinds.list.len());
        let blocks = (0..count.div_ceil(BLOCK)).into_par_iter();
        let seen = blocks
            .fold(new, |mut seen, block| {
                let end = count.min((block + 1) * BLOCK);
                match &self.faces {
                    // One match for many faces.
                    Faces::Triangles(t) => (block * BLOCK..end).for_each(|f| t.visit(f, &mut seen)),
                    faces => (block * BLOCK..end).for_each(|f| faces.visit(f, &mut seen)),
                }
                seen
            })
            .reduce(new, |a, b| a.join(&b));
        StageBounds {
            kinds: self.kinds.clone(),
            lengths: Lengths::of_mesh(&seen, &self.outward),
            exponent: self.exponent,
        }
    }

    /// What lies below a face of the mesh.
    pub(super) fn visit(&self, face: u32, seen: &mut Seen) {
        match &self.children {
            Children::Shift(shift) => {
                for child in face << shift..(face + 1) << shift {
                    self.faces.visit(child, seen);
                }
            }
            Children::Start(start) => {
                for child in start[face as usize]..start[face as usize + 1] {
                    self.faces.visit(child, seen);
                }
            }
            Children::List(list) => {
                for &child in &list[face as usize] {
                    self.faces.visit(child, seen);
                }
            }
        }
    }
}
