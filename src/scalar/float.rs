//! `f64` as a [`Field`]: fast, and never a claim.

use super::{Field, Ring};

/// Half an ulp of 1: the largest relative error of one operation.
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

impl Ring for f64 {
    #[inline(always)]
    fn from_integer(k: i64) -> Self {
        k as f64
    }
}

impl Field for f64 {
    #[inline(always)]
    fn ratio(p: i64, q: i64) -> Self {
        p as f64 / q as f64
    }

    fn two_cos(j: u32, n: u32) -> Option<Self> {
        // TODO(scalar): midpoint of the interval enclosure
        Some(2.0 * (2.0 * std::f64::consts::PI * f64::from(j) / f64::from(n)).cos())
    }
}
