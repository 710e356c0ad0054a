//! The a-priori rounding bound of a measurement in `f64`.
//!
//! Notation: u = 2^-53, `fl(a op b) = (a op b)(1 + d)`, |d| <= u, no overflow (coordinates are scaled
//! below 2 in size before). L is the largest coordinate of the gathered net, which is taken
//! relative to a corner of the face. Masks are convex combinations and do not increase L; ghost
//! points are at most 9 L (a pinned Catmull-Clark corner reflected twice). Errors of the real points are
//! not multiplied by 9: after substituting the ghosts, the rows of the conversion are convex
//! combinations of real points again (they are the limit rules of the boundary).
//!
//! | what | at most, per coordinate | why |
//! |---|---|---|
//! | gathering | u L | one subtraction, relative to its result |
//! | one local step | (n + m + 20) u L | sums over a fan of n edges and faces of m corners, three products, mask weights of relative error 16 u, convex weights |
//! | limit positions of corners (F) | (n + m + 20) u L | likewise |
//! | halving of F, per step | 2 u L | means |
//! | conversion to Bernstein form | 9 u (9 L) <= 81 u L | integer weights of sum 1 after scaling, ghosts up to 9 L and their roundings 3 u (9 L) |
//! | F in Bernstein form | 6 u L | two linear interpolations |
//! | the difference S - F | 2 u L | |S|, |F| <= L |
//!
//! With `c = n + m + 128` each row but the second is below c u L in sum, so after s local steps
//! S - F is off by at most `c (2 s + 4) u L` (F's own steps included). The factor 1.01 swallows the
//! products of errors as long as `c (2 s + 4) u < 0.001`, which [`Extent::radius`] asserts.
//!
//! Each halving of a patch replaces coefficients by means, at most four in a row, of numbers of size
//! at most D, the largest |S - F| of any coefficient met: 4 u D per halving.
//!
//! Underflow: every operation may add 2^-1075 in absolute value, and a squared length that
//! underflows loses up to 2^-536 of a length; [`TINY`] is above the sum of all such terms.

use crate::scalar::float::UNIT_ROUNDOFF;

/// Above the sum of everything that underflow can hide in one face, in lengths.
pub const TINY: f64 = 1e-150;

/// What the rounding bound of a face depends on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extent {
    /// L, the largest coordinate of the gathered net.
    pub size: f64,
    /// n + m: the largest fan plus the largest face of the net.
    pub arity: u32,
    /// Bound on the error of the mesh points themselves, per coordinate.
    pub mesh_radius: f64,
}

impl Extent {
    /// The bound on the error of S - F, per coordinate, after `steps` local steps and `halvings`
    /// halvings of patches with coefficients of length at most `largest`.
    ///
    /// An error r of every mesh point moves S and F by at most r each.
    pub fn radius(&self, steps: u32, halvings: u32, largest: f64) -> f64 {
        let c = f64::from(self.arity) + 128.0;
        let steps = c * (2.0 * f64::from(steps) + 4.0) * UNIT_ROUNDOFF;
        assert!(steps < 1e-3, "valence too large for the rounding bound");
        let halvings = 4.0 * f64::from(halvings) * UNIT_ROUNDOFF;
        1.01 * (steps * self.size + halvings * largest) + 2.01 * self.mesh_radius
    }
}

/// Lengths that enclose, from squared lengths `x*x + y*y + z*z` computed in `f64` of vectors whose
/// coordinates are off by at most `radius`.
///
/// The computed square has relative error below 4 u, its root below 3 u with the rounding of the
/// root; a coordinate error r is a vector error of at most sqrt(3) r < 1.7321 r; the products and
/// sums here add less than 4 u.
pub fn lengths(lower: f64, upper: f64, radius: f64) -> [f64; 2] {
    let margin = 1.7321 * radius + TINY;
    let lo = lower.sqrt() * (1.0 - 8.0 * UNIT_ROUNDOFF) - margin * (1.0 + 8.0 * UNIT_ROUNDOFF);
    let hi = upper.sqrt() * (1.0 + 8.0 * UNIT_ROUNDOFF) + margin * (1.0 + 8.0 * UNIT_ROUNDOFF);
    [if lo > 0.0 { lo } else { 0.0 }, hi]
}
