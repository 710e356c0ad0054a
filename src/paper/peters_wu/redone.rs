//! Table 1 redone: the nine tabulated estimates, the heuristic and the certified distance on meshes.

use super::experiment::{Experiment, LOCAL, Model, Row};
use super::meshes::StandIn;
use crate::bound::Against;
use crate::distance::hausdorff::{Facets, Goal, Request, Side, measure};
use crate::distance::model;
use crate::mesh::Mesh;
use crate::paper::Enclosure;
use crate::predict::heuristic::displacement;
use crate::predict::{Estimator, NotApplicable, Prepared, Sum};
use crate::scheme::{CornerRule, LoopWeights, Scheme};

/// Weights of Loop 1987, which the paper uses.
pub const WEIGHTS: LoopWeights = LoopWeights::Original;

/// Relative gap of measured distances.
const GAP: f64 = 1e-3;

/// A model redone.
#[derive(Clone, Debug)]
pub struct Redone {
    /// The numbers.
    pub model: Model,
    /// Rows that do not apply, with the reason.
    pub missing: Vec<(Row, String)>,
    /// Estimates that are not proved bounds: row, level, reason.
    pub unproved: Vec<(Row, usize, String)>,
    /// `tab-approx` as the paper sums it, over the sum by sectors, at the first level of each row.
    pub plain_over_sector: Vec<f64>,
    /// Certified distances to the limit meshes, by level.
    pub limit: Vec<Option<Enclosure>>,
}

/// The certified one-sided Hausdorff distance from the surface to its level-m control or limit mesh.
pub fn measured(mesh: &Mesh, against: Against, m: u32) -> Option<Enclosure> {
    let request = Request {
        scheme: Scheme::Loop(WEIGHTS),
        corner: CornerRule::Smooth,
        level: m,
        against: match against {
            Against::Control => model::Against::Control,
            Against::Limit => model::Against::Limit,
        },
        side: Side::SurfaceToMesh,
        facets: Facets::Bilinear,
        goal: Goal {
            diagonal_gap: 0.0,
            gap: GAP,
            budget: None,
        },
    };
    let found = measure(mesh, None, &request, &|_, _| ()).ok()?;
    Enclosure::floats(found.lo, found.hi)
}

/// A mesh at levels 0..last.
pub fn of_mesh(stand_in: &StandIn, last: u32) -> Redone {
    let mesh = &stand_in.mesh;
    let levels = last as usize + 1;
    let mut made = Redone {
        model: Model {
            name: stand_in.name.clone(),
            rows: vec![vec![None; levels]; Row::all().len()],
        },
        missing: Vec::new(),
        unproved: Vec::new(),
        plain_over_sector: Vec::new(),
        limit: Vec::new(),
    };
    let prepared = LOCAL.map(|j| Prepared::new(mesh, WEIGHTS, j));
    for (index, row) in Row::all().into_iter().enumerate() {
        match row {
            Row::Measured => {
                made.model.rows[index] = (0..=last)
                    .map(|m| measured(mesh, Against::Control, m))
                    .collect();
            }
            Row::Estimate(Estimator::Heuristic, _) => {
                made.model.rows[index] = (0..=last)
                    .map(|m| {
                        let [lo, hi] = displacement(mesh, WEIGHTS, m).ok()?;
                        Enclosure::floats(lo, hi)
                    })
                    .collect();
            }
            Row::Estimate(estimator, j) => {
                let result = prepared[j as usize]
                    .as_ref()
                    .map_err(NotApplicable::clone)
                    .and_then(|prepared| fill(prepared, estimator, row, index, last, &mut made));
                if let Err(why) = result {
                    made.missing.push((row, why.to_string()));
                }
            }
        }
    }
    made.limit = (0..=last)
        .map(|m| measured(mesh, Against::Limit, m))
        .collect();
    made
}

fn fill(
    prepared: &Prepared,
    estimator: Estimator,
    row: Row,
    index: usize,
    last: u32,
    made: &mut Redone,
) -> Result<(), NotApplicable> {
    for m in row.first_level() as u32..=last {
        let estimate = prepared.estimate(estimator, m, Sum::BySector)?;
        made.model.rows[index][m as usize] = Enclosure::floats(estimate.bound, estimate.bound);
        if !estimate.safe {
            made.unproved.push((row, m as usize, estimate.why));
        }
        if m as usize == row.first_level() && estimator == Estimator::TabApprox {
            let plain = prepared.estimate(estimator, m, Sum::Plain)?;
            made.plain_over_sector.push(plain.bound / estimate.bound);
        }
    }
    Ok(())
}

/// The numbers.
pub fn experiment(redone: &[Redone]) -> Experiment {
    Experiment {
        models: redone.iter().map(|r| r.model.clone()).collect(),
    }
}
