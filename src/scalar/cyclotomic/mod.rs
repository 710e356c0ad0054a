//! Exact real numbers of the fields Q(2 cos 2π/n): zero is decided by algebra, signs by refinement.
//!
//! | question | answer |
//! |---|---|
//! | is it zero? | are its coefficients zero (they are unique) |
//! | its sign? | the basis enclosed to 64, 128, 256, .. bits until 0 is outside; ends, for it isn't zero |
//! | its inverse? | the product of its other conjugates over its norm |
//! | with another valence? | both go to the field of the least common multiple, up to [`MAX_COMMON_DEGREE`] |
//!
//! Beyond that degree [`Cyclotomic::checked_add`] and its kind return `None` and the operators
//! panic; [`Cyclotomic::compatible`] tells beforehand. Comparisons never fail.

mod arithmetic;
mod element;
mod field;
mod inverse;
mod order;

pub use element::{Cyclotomic, MAX_COMMON_DEGREE};
pub use field::{field_degree, minimal_polynomial};
