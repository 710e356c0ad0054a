//! The vertex heuristic: the largest distance of a vertex of level m to its limit.
//!
//! It is a lower bound of the distance at the same parameter and no bound of the Hausdorff distance, from
//! either side.

use crate::mesh::Mesh;
use crate::refine::{RefineError, enclose_limits, enclose_refined};
use crate::scheme::{CornerRule, LoopWeights, Scheme};

/// An enclosure of the largest distance of a vertex of the level-m mesh to its limit, in the mesh's unit.
///
/// With positions and limits off by r and s per coordinate the difference is off by √3 (r + s), and the
/// computed length by a few units in the last place.
///
/// # Errors
/// If and only if the scheme refuses the mesh.
pub fn displacement(mesh: &Mesh, weights: LoopWeights, m: u32) -> Result<[f64; 2], RefineError> {
    const ROOT_3: f64 = 1.732_050_808;
    let scheme = Scheme::Loop(weights);
    let (topology, level) = enclose_refined(scheme, CornerRule::Smooth, mesh, m)?;
    let limits = enclose_limits(scheme, CornerRule::Smooth, &topology, &level)?;
    let mut largest = 0.0_f64;
    for (p, limit) in level.positions.iter().zip(&limits.positions) {
        // hypot neither overflows nor underflows.
        let [x, y, z] = [0, 1, 2].map(|i| p.0[i] - limit.0[i]);
        largest = largest.max(x.hypot(y).hypot(z));
    }
    let off = ROOT_3 * 1.000_001 * (level.radius + limits.radius);
    let (low, high) = (largest * (1.0 - 1e-14) - off, largest * (1.0 + 1e-14) + off);
    Ok([low.max(0.0), high.next_up()])
}
