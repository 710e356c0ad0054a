//! A mesh's own connectivity, or that of a refined mesh that several hold.

use std::ops::Deref;
use std::sync::Arc;

use crate::mesh::Topology;

/// Reads as a [`Topology`]; cheap to clone.
#[derive(Clone, Debug)]
pub enum Connectivity<'a> {
    /// The mesh's own.
    Given(&'a Topology),
    /// Of a step's.
    Refined(Arc<Topology>),
}

impl Deref for Connectivity<'_> {
    type Target = Topology;

    #[inline]
    fn deref(&self) -> &Topology {
        match self {
            Connectivity::Given(topology) => topology,
            Connectivity::Refined(topology) => topology,
        }
    }
}
