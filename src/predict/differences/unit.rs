//! The unit in which a mesh's differences are taken.

use super::Request;
use crate::mesh::frame::Frame;
use crate::mesh::{Point, Topology};
use crate::refine::RefineError;
use crate::refine::enclosure::largest_coordinate;
use crate::scheme::Scheme;

/// A unit and an origin, or those of the mesh.
pub(super) struct Unit {
    /// `None`: those of the mesh.
    pub(super) frame: Option<Frame>,
    /// Lengths in the mesh's unit are 2^exponent times those here.
    pub(super) exponent: i32,
    /// Twice the largest extent, or coordinate, here.
    pub(super) extent: f64,
}

impl Unit {
    /// Tests the positions and finds a unit for them.
    ///
    /// # Errors
    /// If and only if a coordinate is not finite, or there is not one position for each vertex.
    pub(super) fn of(
        request: &Request,
        topology: &Topology,
        positions: &[Point<f64>],
    ) -> Result<Self, RefineError> {
        let (expected, found) = (topology.vertex_count() as usize, positions.len());
        if expected != found {
            return Err(RefineError::PositionCount { expected, found });
        }
        largest_coordinate(positions)?;
        Ok(Self::for_frame(
            request,
            Frame::of(topology, positions, true),
        ))
    }

    /// Takes a frame where it is needed.
    pub(super) fn for_frame(request: &Request, frame: Frame) -> Self {
        // Lengths far from the limits of f64 need no other unit where nothing is refined.
        let plain = matches!(request.scheme, Scheme::Loop(_))
            && request.local_steps < 2
            && frame.exponent.abs() <= 200;
        match plain {
            true => Unit {
                extent: 2.0 * 2f64.powi(frame.exponent) * frame.size,
                exponent: 0,
                frame: None,
            },
            false => Unit {
                extent: 2.0 * frame.size,
                exponent: frame.exponent,
                frame: Some(frame),
            },
        }
    }
}
