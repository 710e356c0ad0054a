//! Bounds that take local steps when they are asked for.

use super::maker::Maker;
use super::{Bounds, MeshBounds, Request};
use crate::mesh::{Mesh, Point, Topology};
use crate::refine::RefineError;

/// Bounds of a whole mesh by 0, 1, .. local steps; nothing is computed twice.
pub struct LocalSteps<'a> {
    maker: Maker<'a>,
    known: MeshBounds,
}

impl<'a> LocalSteps<'a> {
    /// For a mesh. How many steps the request asks for does not count.
    ///
    /// # Errors
    /// If and only if the scheme refuses the mesh, a coordinate is not finite, or there is not one position for
    /// each vertex.
    pub fn new(mesh: &'a Mesh, request: &Request) -> Result<Self, RefineError> {
        request.check(&mesh.topology)?;
        Self::of(request, &mesh.topology, &mesh.positions)
    }

    /// For a mesh that the scheme takes.
    pub(super) fn of(
        request: &Request,
        topology: &'a Topology,
        positions: &'a [Point<f64>],
    ) -> Result<Self, RefineError> {
        Ok(LocalSteps {
            maker: Maker::new(request, topology, positions)?,
            known: MeshBounds { stages: Vec::new() },
        })
    }

    /// The bounds by up to so many local steps.
    ///
    /// # Errors
    /// If and only if a step would be too large for 32-bit indices or for `f64`.
    ///
    /// # Panics
    /// If there are more than [`Bounds::MOST_STEPS`].
    pub fn bounds(&mut self, local_steps: u32) -> Result<MeshBounds, RefineError> {
        assert!(local_steps <= Bounds::MOST_STEPS, "at most two local steps");
        let stages = &mut self.known.stages;
        while stages.len() <= local_steps as usize {
            stages.push(self.maker.stage(stages.len())?.bounds());
        }
        Ok(MeshBounds {
            stages: stages[..=local_steps as usize].to_vec(),
        })
    }
}
