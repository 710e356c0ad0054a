//! How far surface and level-k mesh are apart, known before refining: the floating fast path.
//!
//! | room | what it bounds, from what |
//! |---|---|
//! | [`differences`] | the parametric distance of every scheme, from second differences and certified constants; flat arrays, safe in floats |
//! | [`eigen`] | the distance from a Loop surface to its mesh, from eigenvectors and tabulated distances: Peters & Wu's estimators |
//! | [`heuristic`] | nothing: the distances of vertices to their limits |

pub mod differences;
pub mod eigen;
pub mod heuristic;
mod parts;

pub use eigen::{Estimate, Estimator, NotApplicable, Prepared, Sum, estimate};
