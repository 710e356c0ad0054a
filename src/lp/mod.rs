//! Least sums of absolute values: `min Σ |x_l|` subject to `Σ x_l α_l = t`, for integer rows α_l.
//!
//! **Duality.** With y ranging over the nets with `|α_l(y)| <= 1` for all l,
//!
//! ```text
//! min { Σ |x_l| : Σ x_l α_l = t }  =  max { t(y) }  =  sup { |t(P)| / max_l |α_l(P)| },
//! ```
//!
//! the last over nets P in any normed space. x is a proof of an upper bound (an identity and a sum
//! of absolute values), y of a lower one (a net that attains it).
//!
//! **Bases.** A vertex of either program is a [`Basis`]: a maximal independent set of rows, whose
//! inverse is kept in integers (a common denominator and an integer matrix, both small for second
//! differences). Every number of the basis is exact; only the right-hand side t has an arithmetic of
//! its own. So the one pivot loop serves twice: with t in `f64` it proposes bases
//! (fast, proves nothing), with t exact it decides.
//!
//! | question | answered by |
//! |---|---|
//! | are the rows of a set independent, and is t in their span? | [`Basis`], exactly |
//! | a good basis for a float t | [`Rows::propose`] |
//! | the optimum for an exact t, with x and y | [`Rows::minimise`] |
//!
//! Optima of symmetric nets are degenerate. The proposal perturbs t inside the span of the rows; the
//! exact loop uses Bland's rule, which ends on degenerate programs too.

mod basis;
mod rows;
mod simplex;

pub use basis::Basis;
pub use rows::{Rows, Solution};
pub use simplex::Number;
