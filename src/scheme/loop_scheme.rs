//! Loop's scheme: masks and local nets.

mod local_net;

pub use local_net::*;

use super::{LoopWeights, StarMask};
use crate::scalar::{Field, Module};

/// The product `n b(n)`, b the weight of a ring vertex in the vertex mask.
///
/// `original`: `5/8 - (3/8 + c/4)^2`, c = cos 2π/n, n >= 3; `warren`: 3/8 for n > 3, 9/16 for n = 3.
/// `None` if and only if the type cannot represent 2 cos 2π/n.
///
/// Source: Loop 1987; Warren 1995.
pub fn ring_weight_sum<S: Field>(weights: LoopWeights, n: u32) -> Option<S> {
    match weights {
        LoopWeights::Original => {
            let t = S::ratio(3, 8) + &(S::two_cos(1, n)? * &S::ratio(1, 8));
            Some(S::ratio(5, 8) - &(t.clone() * &t))
        }
        LoopWeights::Warren if n == 3 => Some(S::ratio(9, 16)),
        LoopWeights::Warren => Some(S::ratio(3, 8)),
    }
}

/// The vertex mask `(1 - n b) P + b Σ P_i` of an interior vertex of valence `n >= 3`.
pub fn vertex_mask<S: Field>(weights: LoopWeights, n: u32) -> Option<StarMask<S>> {
    let nb = ring_weight_sum::<S>(weights, n)?;
    Some(StarMask {
        center: S::one() - &nb,
        edge: nb * &S::ratio(1, i64::from(n)),
        face: S::zero(),
    })
}

/// The limit mask `(1 - n w) P + w Σ P_i`, `w = 8 b / (3 + 8 n b)`.
pub fn limit_mask<S: Field>(weights: LoopWeights, n: u32) -> Option<StarMask<S>> {
    let nb = ring_weight_sum::<S>(weights, n)?;
    let eight_nb = nb * &S::from_integer(8);
    let nw = eight_nb.clone() / &(S::from_integer(3) + &eight_nb);
    Some(StarMask {
        center: S::one() - &nw,
        edge: nw * &S::ratio(1, i64::from(n)),
        face: S::zero(),
    })
}

/// The edge point `3/8 (a + b) + 1/8 (c + d)`: a, b the ends, c, d the opposite vertices.
#[inline]
pub fn edge_point<S: Field, V: Module<S>>(a: &V, b: &V, c: &V, d: &V) -> V {
    (a.clone() + b) * &S::ratio(3, 8) + &((c.clone() + d) * &S::ratio(1, 8))
}
