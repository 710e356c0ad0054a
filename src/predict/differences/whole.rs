//! Bounds of a whole mesh at every level.

use std::sync::Arc;

use super::constants;
use super::levels::{Kinds, Lengths};

/// Upper bounds of the parametric distances between surface and level-k meshes, for all k.
#[derive(Clone, Debug)]
pub struct MeshBounds {
    /// By 0, 1, .., j local steps.
    pub(super) stages: Vec<StageBounds>,
}

/// Bounds after a number of local steps.
#[derive(Clone, Debug)]
pub(super) struct StageBounds {
    pub(super) kinds: Arc<Kinds>,
    pub(super) lengths: Lengths,
    /// Lengths in the mesh's unit are 2^exponent times those here.
    pub(super) exponent: i32,
}

impl MeshBounds {
    /// The deepest level that is looked at.
    pub const DEEPEST: u32 = constants::DEEPEST as u32;

    /// An upper bound of the distance at level k, in the mesh's own unit; infinite where nothing is proved.
    /// Levels beyond [`MeshBounds::DEEPEST`] have the bound of that.
    pub fn at(&self, k: u32) -> f64 {
        let stages = self.stages.iter().take(k as usize + 1);
        let bounds = stages.map(|s| in_unit(s.exponent, s.lengths.bound(&s.kinds, k as usize)));
        bounds.fold(f64::INFINITY, f64::min)
    }

    /// The least k with [`MeshBounds::at`] at most the tolerance; `None` if there is none up to
    /// [`MeshBounds::DEEPEST`].
    pub fn depth(&self, tolerance: f64) -> Option<u32> {
        (0..=Self::DEEPEST).find(|&k| self.at(k) <= tolerance)
    }
}

/// A length in the mesh's own unit, rounded upward.
pub(super) fn in_unit(exponent: i32, x: f64) -> f64 {
    if exponent == 0 {
        return x;
    }
    let half = exponent / 2;
    let length = x * 2f64.powi(half) * 2f64.powi(exponent - half);
    // Exact but for underflow.
    if length < f64::MIN_POSITIVE && x > 0.0 {
        length.next_up()
    } else {
        length
    }
}
