//! New positions and limit positions, one formula each for all arithmetics.
//!
//! Every output is one fixed expression of the inputs, its neighbours taken in the order of the
//! faces: so results don't depend on the number of threads, and in an exact type they are the
//! scheme's points, in [`Interval`](crate::scalar::Interval)s they contain them.

use super::corners::{BOUNDARY, Corners, Fixed, View, tabulate, with_view};
use super::error::RefineError;
use super::masks::{CornerMasks, Masks};
use super::star::Star;
use crate::mesh::Topology;
use crate::scalar::Module;
use crate::scheme::{CornerRule, Scheme};

/// What the functions here apply weights of type W to.
pub(crate) trait Points<W>: Module<W> + Send + Sync {}
impl<W, V: Module<W> + Send + Sync> Points<W> for V {}

/// Arguments that make sense together: one point per vertex, a corner rule where there is one.
pub(crate) fn check_arguments<V>(
    scheme: Scheme,
    corner: CornerRule,
    topology: &Topology,
    positions: &[V],
) -> Result<(), RefineError> {
    let expected = topology.vertex_count() as usize;
    if positions.len() != expected {
        return Err(RefineError::PositionCount {
            expected,
            found: positions.len(),
        });
    }
    if scheme == Scheme::DooSabin && corner == CornerRule::Sharp {
        return Err(RefineError::CornerRule);
    }
    Ok(())
}

/// The refined positions into `out`.
pub(crate) fn refined<W: Send + Sync, V: Points<W>>(
    masks: &Masks<W>,
    corner: CornerRule,
    topology: &Topology,
    positions: &[V],
    out: &mut Vec<V>,
) {
    match masks {
        Masks::Star(masks) if masks.lift.is_empty() => {
            let view = View::new(topology, Fixed::<3>);
            Star {
                view,
                masks,
                corner,
                positions,
            }
            .refine_triangles(out);
        }
        Masks::Star(masks) => with_view!(topology, view => {
            Star { view, masks, corner, positions }.refine_polygons(topology.face_count(), out);
        }),
        Masks::Corner(masks) => with_view!(topology, view => {
            let point = |h| corner_point(&view, masks, positions, h);
            tabulate(out, topology.halfedge_count(), point);
        }),
    }
}

/// The limit positions into `out`, one per vertex.
pub(crate) fn limits<W: Send + Sync, V: Points<W>>(
    masks: &Masks<W>,
    corner: CornerRule,
    topology: &Topology,
    positions: &[V],
    out: &mut Vec<V>,
) {
    match masks {
        Masks::Star(masks) if masks.lift.is_empty() => {
            let view = View::new(topology, Fixed::<3>);
            Star {
                view,
                masks,
                corner,
                positions,
            }
            .triangle_limits(out);
        }
        Masks::Star(masks) => with_view!(topology, view => {
            Star { view, masks, corner, positions }.polygon_limits(topology.face_count(), out);
        }),
        Masks::Corner(masks) => with_view!(topology, view => {
            let limit = |v| corner_limit(&view, masks, positions, v);
            tabulate(out, topology.vertex_count(), limit);
        }),
    }
}

/// The new corner of half-edge h: `Σ a_j P_j` over the corners of its face, h being corner 0.
#[inline(always)]
fn corner_point<W, V: Points<W>, C: Corners>(
    view: &View<'_, C>,
    masks: &CornerMasks<W>,
    positions: &[V],
    h: u32,
) -> V {
    let face = view.corners.face(h);
    let (start, size) = (view.corners.start(face), view.corners.size(face));
    let mask = &masks.corner[size as usize];
    let mut sum = positions[view.origin(h)].clone() * &mask[0];
    let mut corner = h;
    for weight in &mask[1..] {
        corner = if corner + 1 == start + size {
            start
        } else {
            corner + 1
        };
        sum = sum + &(positions[view.origin(corner)].clone() * weight);
    }
    sum
}

/// The mean of the new corners at v, over its faces counterclockwise.
fn corner_limit<W, V: Points<W>, C: Corners>(
    view: &View<'_, C>,
    masks: &CornerMasks<W>,
    positions: &[V],
    v: u32,
) -> V {
    let word = view.valence[v as usize];
    if word == 0 {
        return positions[v as usize].clone() * &masks.keep;
    }
    let faces = (word & !BOUNDARY) - u32::from(word & BOUNDARY != 0);
    let mut h = view.first[v as usize];
    let mut sum = corner_point(view, masks, positions, h);
    for _ in 1..faces {
        h = view.twin(view.corners.prev(h));
        sum = sum + &corner_point(view, masks, positions, h);
    }
    sum * &masks.mean[faces as usize]
}
