//! Peters & Wu's estimators ([`crate::predict::eigen`]): the least level whose estimate is within the tolerance.

use super::{Context, Found, NoDepth};
use crate::predict::differences::Bounds;
use crate::predict::{Estimator, NotApplicable, Prepared, Sum};
use crate::scheme::Scheme;

pub(super) fn depth(
    context: &Context<'_>,
    estimator: Estimator,
    local_steps: u32,
) -> Result<Found, NoDepth> {
    let request = context.request;
    let Scheme::Loop(weights) = request.scheme else {
        return Err(NoDepth("it is about loop".into()));
    };
    let not_applicable = |error: NotApplicable| NoDepth(error.to_string());
    let prepared = Prepared::new(context.mesh, weights, local_steps).map_err(not_applicable)?;
    let mut least = f64::INFINITY;
    for m in local_steps..=Bounds::DEEPEST {
        let estimate = match prepared.estimate(estimator, m, Sum::BySector) {
            Ok(estimate) => estimate,
            // Levels are tabulated up to some depth; there the search ends.
            Err(NotApplicable::NotTabulated { .. }) if least.is_finite() => {
                return Err(NoDepth(format!(
                    "distances are tabulated up to level {}, and the estimate is still {least:.3e}",
                    m - 1
                )));
            }
            Err(other) => return Err(not_applicable(other)),
        };
        if estimate.bound <= request.tolerance {
            return Ok(Found {
                depth: m,
                bound: estimate.bound,
                safe: estimate.safe,
                why: format!("peters-wu: {}", estimate.why),
            });
        }
        least = least.min(estimate.bound);
    }
    Err(NoDepth(format!("none up to {} is proved", Bounds::DEEPEST)))
}
