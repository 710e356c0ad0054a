//! The papers' formulas on a mesh, exactly as printed, with this program's verdict on them.
//!
//! They are stated for a face with at most one extraordinary vertex and no boundary near it. [`norms`]
//! subdivides until all faces are like that, and takes the largest norm of each valence, rounded upwards;
//! the formulas grow with the norms. Depths are then decided in rationals.
//!
//! | file | formulas |
//! |---|---|
//! | [`lanquetin_neveu`] | Corollaries 2, 3, 5 |
//! | [`cheng_yong`] | Theorems 4 and 9 |
//! | [`huang_wang`] | (14) and (16) |
//! | [`verdict`] | the claims of [`crate::paper`] that a formula stands or falls with |

pub mod cheng_yong;
pub mod huang_wang;
pub mod lanquetin_neveu;
pub mod norms;
pub mod verdict;

use num_bigint::BigInt;
use num_traits::One;

use super::{Found, NoDepth};
use crate::scalar::Rational;
use crate::scalar::float::round_up;
use norms::{Norm, Norms};
use verdict::Basis;

/// What a formula says of the faces of one valence.
struct Needed<'a> {
    depth: u32,
    /// The bound that it rests on, at depths from `depth` on.
    bound: Box<dyn Fn(u32) -> Rational + 'a>,
}

/// Norms above 2^RANGE tolerances are refused: depths are hundreds of steps there.
const RANGE: u32 = 100;

/// The depth of the mesh: the largest over the valences of its faces, after the steps that separated them.
fn deepest<'a>(
    norms: &'a Norms,
    tolerance: &Rational,
    basis: &Basis,
    of: impl Fn(u32, &'a Norm) -> Result<Needed<'a>, NoDepth>,
) -> Result<Found, NoDepth> {
    let range = Rational::from_integer(BigInt::one() << RANGE) * tolerance;
    let mut all = Vec::new();
    for (&valence, norm) in &norms.by_valence {
        if norm.first > range || norm.second > range {
            return Err(NoDepth(format!(
                "differences of the mesh are more than 2^{RANGE} tolerances"
            )));
        }
        all.push(of(valence, norm)?);
    }
    let depth = all.iter().map(|needed| needed.depth).max().unwrap_or(0);
    let bounds = all.iter().map(|needed| round_up(&(needed.bound)(depth)));
    Ok(Found {
        depth: norms.steps + depth,
        bound: bounds.fold(0.0, f64::max),
        safe: basis.holds,
        why: match norms.steps {
            0 => basis.to_string(),
            1 => format!("{basis}; after 1 step that separates extraordinary vertices"),
            steps => format!("{basis}; after {steps} steps that separate extraordinary vertices"),
        },
    })
}

/// A printed number of steps, which may be negative: then no step is needed.
fn at_least_0(steps: Option<i64>) -> u32 {
    u32::try_from(steps.unwrap_or(0).max(0)).expect("depths of norms in range are hundreds")
}

/// The tolerance, exactly.
fn exactly(tolerance: f64) -> Rational {
    Rational::from_float(tolerance).expect("a finite tolerance")
}
