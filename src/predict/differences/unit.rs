//! The unit in which a mesh's differences are taken.

use crate::mesh::frame::Frame;
use crate::mesh::{Point, Topology};
use crate::refine::RefineError;
use crate::refine::enclosure::largest_coordinate;
use crate::scheme::Scheme;

/// A unit and an origin for refined meshes, and whether those of the mesh will do where nothing is refined.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    pub(super) frame: Frame,
    /// Loop, and lengths far from the limits of f64.
    pub(super) plain: bool,
}

impl Unit {
    /// Tests the positions and finds a unit for them.
    ///
    /// # Errors
    /// If and only if a coordinate is not finite, or there is not one position for each vertex.
    pub(super) fn of(
        scheme: Scheme,
        topology: &Topology,
        positions: &[Point<f64>],
    ) -> Result<Self, RefineError> {
        let (expected, found) = (topology.vertex_count() as usize, positions.len());
        if expected != found {
            return Err(RefineError::PositionCount { expected, found });
        }
        largest_coordinate(positions)?;
        Ok(Self::by(scheme, Frame::of(topology, positions, true)))
    }

    pub(super) fn by(scheme: Scheme, frame: Frame) -> Self {
        let plain = matches!(scheme, Scheme::Loop(_)) && frame.exponent.abs() <= 200;
        Unit { frame, plain }
    }

    /// Twice the largest extent, or coordinate, in the mesh's own unit.
    pub(super) fn plain_extent(&self) -> f64 {
        2f64.powi(self.frame.exponent) * self.extent()
    }

    /// Twice the largest extent, or coordinate, in the frame.
    pub(super) fn extent(&self) -> f64 {
        2.0 * self.frame.size
    }
}
