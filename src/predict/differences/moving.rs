//! One connectivity, many positions.

use std::sync::Arc;

use super::clusters::Clusters;
use super::levels::{Kinds, Lengths, Outward};
use super::local_steps::LocalSteps;
use super::maker::{largest_valence, short_of};
use super::triangles::Rates;
use super::unit::Unit;
use super::whole::StageBounds;
use super::{MeshBounds, Request};
use crate::mesh::frame::Frame;
use crate::mesh::{Point, Topology};
use crate::refine::RefineError;
use crate::scheme::Scheme;

/// Bounds of whole meshes of one connectivity: a mesh that moves, or is fitted.
///
/// Where constants alone are used (Loop, no local step) all that the connectivity says is prepared here, and a
/// set of positions costs a pass over clusters of faces that fit a core's cache; otherwise this is [`super::Bounds`].
///
/// ```
/// use subcert::bound::Against;
/// use subcert::mesh::{Point, Topology};
/// use subcert::predict::differences::{MovingMesh, Request};
/// use subcert::scheme::{CornerRule, LoopWeights, Scheme};
///
/// let faces = vec![0, 1, 2, 0, 2, 3, 0, 3, 1, 3, 2, 1];
/// let tetrahedron = Topology::from_uniform(4, 3, faces)?;
/// let request = Request {
///     scheme: Scheme::Loop(LoopWeights::Original),
///     corner: CornerRule::Smooth,
///     against: Against::Control,
///     local_steps: 0,
/// };
/// let prepared = MovingMesh::new(&tetrahedron, &request)?;
/// let place = |size: f64| [[0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, size]].map(Point);
/// let (small, large) = (prepared.bounds(&place(1.0))?, prepared.bounds(&place(4.0))?);
/// assert_eq!(large.at(3), 4.0 * small.at(3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct MovingMesh<'a> {
    topology: &'a Topology,
    request: Request,
    ready: Option<Ready>,
}

#[derive(Clone, Debug)]
struct Ready {
    clusters: Clusters,
    kinds: Arc<Kinds>,
    rates: Rates,
    /// The largest.
    valence: u32,
    vertices: usize,
    without_a_face: Vec<u32>,
}

impl<'a> MovingMesh<'a> {
    /// Prepares what the connectivity says.
    ///
    /// # Errors
    /// If and only if the scheme refuses the mesh.
    ///
    /// # Panics
    /// If there are more local steps than [`super::Bounds::MOST_STEPS`].
    pub fn new(topology: &'a Topology, request: &Request) -> Result<Self, RefineError> {
        request.check(topology)?;
        let &Request {
            scheme,
            corner,
            against,
            local_steps,
        } = request;
        let ready = || {
            let (kinds, of_vertex) = Kinds::of_vertices(scheme, corner, against, topology);
            Some(Ready {
                clusters: Clusters::of(topology, &kinds, &of_vertex)?,
                rates: Rates::of(scheme, against, &kinds),
                kinds: kinds.into(),
                valence: largest_valence(topology),
                vertices: topology.vertex_count() as usize,
                without_a_face: topology.isolated_vertices().collect(),
            })
        };
        let by_constants = matches!(scheme, Scheme::Loop(_)) && local_steps == 0;
        Ok(MovingMesh {
            topology,
            request: *request,
            ready: if by_constants { ready() } else { None },
        })
    }

    /// Bounds of the mesh with these positions.
    ///
    /// # Errors
    /// If and only if a coordinate is not finite, or there is not one position for each vertex; or if a local
    /// step would be too large for 32-bit indices.
    pub fn bounds(&self, positions: &[Point<f64>]) -> Result<MeshBounds, RefineError> {
        if let Some(ready) = &self.ready
            && let Some(stage) = ready.stage(self.request.scheme, positions)
        {
            return Ok(MeshBounds {
                stages: vec![stage],
            });
        }
        let mut steps = LocalSteps::of(&self.request, self.topology, positions)?;
        steps.bounds(self.request.local_steps)
    }

    /// Bytes that the preparation holds beside the mesh.
    pub fn bytes(&self) -> usize {
        self.ready.as_ref().map_or(0, |r| r.clusters.bytes())
    }
}

impl Ready {
    /// `None` where positions are wrong or need another unit.
    fn stage(&self, scheme: Scheme, positions: &[Point<f64>]) -> Option<StageBounds> {
        if positions.len() != self.vertices {
            return None;
        }
        let finite = |&v: &u32| positions[v as usize].0.iter().all(|x| x.is_finite());
        if !self.without_a_face.iter().all(finite) {
            return None;
        }
        let (seen, place) = self.clusters.largest(positions, &self.kinds, &self.rates);
        // What was computed counts if coordinates are far from the limits of f64.
        let unit = Unit::by(scheme, Frame::between(place.corners()?, true));
        if !unit.plain {
            return None;
        }
        let outward = Outward {
            off: [short_of(self.valence, unit.plain_extent(), 0.0); 5],
        };
        Some(StageBounds {
            kinds: self.kinds.clone(),
            lengths: Lengths::of_mesh(&seen, &outward),
            exponent: 0,
        })
    }
}
