//! The tabulated predictions of Peters & Wu (2009), as bounds: a-priori estimates of the distance between
//! a Loop surface and its level-m mesh, from the level-0 mesh alone.
//!
//! | estimator | of the distance after m steps | [`Estimate::safe`] |
//! |---|---|---|
//! | [`Estimator::TabApprox`] | `Σ \|p_i\| μ_i(m)`, to the control mesh | yes |
//! | [`Estimator::TabInterp`] | the same with the distances to limit meshes | where chi stays on the facets |
//! | [`Estimator::TabEigen`] | `Σ \|p_i\| max(λ_i, 1/4)^m μ_i(0)` | where it is at least `TabApprox` |
//! | [`Estimator::Heuristic`] | the largest distance of a vertex of level m to its limit ([`super::heuristic`]) | no |
//!
//! The two-ring net of an extraordinary vertex is `Q = Σ p_i v_i` in the eigenvectors of
//! [`crate::spectrum`]; `μ_i(m)` is the largest distance of the spline of v_i to its level-m mesh over
//! S_n, both parametrised by the characteristic map. The constant and the characteristic map itself have
//! none, so the sum runs over the rest (PW (15), (18)). Faces without an extraordinary vertex have
//! `C_0(6) 4^-m M`, M the largest second difference ([`regular`]).
//!
//! **What is bounded.** At each point of the surface the distance to one point of the level-m mesh: so
//! the one-sided Hausdorff distance from surface to mesh.
//!
//! **Sharper than the sum.** Frequencies come in pairs cos, sin with coefficients p_c, p_s in space:
//! `|p_c e_c + p_s e_s| <= σ sqrt(e_c^2 + e_s^2)`, σ the largest singular value of the matrix (p_c p_s), at
//! most `sqrt(|p_c|^2 + |p_s|^2)`. Local eigenvectors count in the sectors that they reach only, and
//! what is taken is the largest sum of a sector. [`Sum::Plain`] is the paper's own.
//!
//! | file | idea |
//! |---|---|
//! | [`estimators`] | the story: an estimator, a mesh, a bound |
//! | [`isolation`] | which vertices have a two-ring that the theory applies to |
//! | [`kernel`] | `\|p_i\|` and the sums over a two-ring, in `f64` with a rounding bound |
//! | [`regular`] | faces without an extraordinary vertex |
//! | [`inside`] | whether chi stays over known facets between limit points |
//! | [`table`] | the distances μ |
//! | [`beyond`] | those at levels beyond the table, by a recurrence |

pub mod beyond;
pub mod estimators;
pub mod inside;
pub mod isolation;
pub mod kernel;
pub mod regular;
pub mod table;

pub use estimators::{Estimate, Estimator, Prepared, estimate};
pub use isolation::NotApplicable;
pub use kernel::Sum;
