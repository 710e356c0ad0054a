//! Lanquetin & Neveu: Corollary 2 (Catmull-Clark), 3 (Loop), 5 (Doo-Sabin).
//!
//! | corollary | M_0 | bound at level k |
//! |---|---|---|
//! | 2 | the largest second difference Z of all faces | `4^-k M_0 / 3` |
//! | 3 | the largest distance of a vertex from its limit | `(5/8 - n β)^k M_0`, n the largest valence after all steps |
//! | 5 | the largest second difference along lines of the mesh | `4^-k M_0 / 4` |

use num_traits::One;

use super::norms::valences;
use super::verdict::{
    Basis, COROLLARY_2, COROLLARY_2_REGULAR, COROLLARY_3, COROLLARY_5, COROLLARY_5_REGULAR,
};
use super::{Needed, deepest, exactly};
use crate::depth::{Context, Found, NoDepth};
use crate::mesh::Topology;
use crate::paper::Enclosure;
use crate::paper::lanquetin_neveu_2004::depth::{corollary_2, corollary_3, corollary_5};
use crate::predict::heuristic::displacement;
use crate::scalar::float::round_up;
use crate::scalar::{Field, Interval, Rational};
use crate::scheme::{LoopWeights, Scheme, loop_scheme};

/// Whether the corollary of the scheme holds on such meshes: refuted ones do on regular meshes only, if at all.
pub(in crate::depth) fn may_be_safe(topology: &Topology, scheme: Scheme) -> bool {
    let [regular, irregular] = match scheme {
        Scheme::Loop(_) => [COROLLARY_3; 2],
        Scheme::CatmullClark => [COROLLARY_2_REGULAR, COROLLARY_2],
        Scheme::DooSabin => [COROLLARY_5_REGULAR, COROLLARY_5],
    };
    let is_regular = || topology.arity() == Some(4) && valences(topology).iter().all(|&n| n == 4);
    topology.is_closed() && (irregular.holds || regular.holds && is_regular())
}

pub(in crate::depth) fn depth(context: &Context<'_>) -> Result<Found, NoDepth> {
    match context.request.scheme {
        Scheme::Loop(weights) => triangles(context, weights),
        Scheme::CatmullClark => quads(context, corollary_2, 3, [COROLLARY_2_REGULAR, COROLLARY_2]),
        Scheme::DooSabin => quads(context, corollary_5, 4, [COROLLARY_5_REGULAR, COROLLARY_5]),
    }
}

/// Corollaries 2 and 5: `M_0 / (part 4^k)`; the basis on regular meshes, and elsewhere.
fn quads(
    context: &Context<'_>,
    corollary: fn(&Rational, &Rational) -> u32,
    part: i64,
    [regular, irregular]: [Basis; 2],
) -> Result<Found, NoDepth> {
    let norms = context.norms()?;
    let tolerance = exactly(context.request.tolerance);
    let only_regular = norms.steps == 0 && norms.by_valence.keys().all(|&n| n == 4);
    let basis = match only_regular {
        true => regular,
        false => irregular,
    };
    deepest(norms, &tolerance, &basis, |_, norm| {
        let m_0 = &norm.second;
        Ok(Needed {
            depth: corollary(m_0, &tolerance),
            bound: Box::new(move |k| {
                m_0 * Rational::ratio(1, part) * power(&Rational::ratio(1, 4), k)
            }),
        })
    })
}

/// Corollary 3.
fn triangles(context: &Context<'_>, weights: LoopWeights) -> Result<Found, NoDepth> {
    let topology = &context.mesh.topology;
    if !topology.is_closed() {
        return Err(NoDepth(
            "the paper has no boundary rule, and the mesh has a boundary".into(),
        ));
    }
    let [_, m_0] = displacement(context.mesh, weights, 0)?;
    let valences = (0..topology.vertex_count()).map(|v| topology.valence(v));
    let n = valences.fold(6, u32::max);
    let found = || {
        let exact = |x: f64| Some(Enclosure::exactly(Rational::from_float(x)?));
        let sum = loop_scheme::ring_weight_sum::<Interval>(weights, n)?;
        let rate = Interval::from_rational(&Rational::ratio(5, 8)) - sum;
        // Rounded upwards: never fewer steps than printed.
        let (m, rate) = (exact(m_0)?, exact(rate.sup())?);
        let tolerance = Enclosure::exactly(exactly(context.request.tolerance));
        let depth = corollary_3(&m, &tolerance, &rate)?;
        Some((depth, round_up(&(&m.hi * power(&rate.hi, depth)))))
    };
    let (depth, bound) = found()
        .ok_or_else(|| NoDepth(format!("the rate of valence {n} is not known well enough")))?;
    Ok(Found {
        depth,
        bound,
        safe: COROLLARY_3.holds,
        why: COROLLARY_3.to_string(),
    })
}

fn power(base: &Rational, k: u32) -> Rational {
    (0..k).fold(Rational::one(), |power, _| power * base)
}
