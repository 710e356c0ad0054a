//! Bernstein–Bézier patches: conversion from control nets, splitting, range.

pub mod conversion;
pub mod from_net;
pub mod tensor;
pub mod triangle;

use crate::scalar::{Field, Module};

/// The midpoint `(a + b) / 2`, the only operation of a de Casteljau split at 1/2.
///
/// In `f64` it rounds once: `a + b` rounds, halving is exact (above the subnormals).
#[inline]
pub fn midpoint<S: Field, V: Module<S>>(a: &V, b: &V) -> V {
    (a.clone() + b) * &S::ratio(1, 2)
}

/// A polynomial patch in Bernstein form that can be halved.
///
/// The range of the patch lies in the convex hull of its coefficients, and each coefficient at a
/// corner is the value there.
pub trait Patch<S: Field, V: Module<S>>: Clone + Sized {
    /// Number of corners of the parameter domain: 3 or 4.
    const CORNERS: usize;

    /// The patch that interpolates corner values: linear on triangles (the fourth value is unused),
    /// bilinear on squares.
    fn interpolant(corners: &[V; 4]) -> Self;

    /// The Bernstein coefficients.
    fn coefficients(&self) -> &[V];

    /// Index of the coefficient at each corner.
    fn corner_index(corner: usize) -> usize;

    /// Halves the patch; `corners` are the parameters of its corners and are halved with it.
    ///
    /// In `f64` each coefficient of a half carries at most [`Patch::DEGREE`] roundings of
    /// [`midpoint`].
    fn halve(&self, corners: &[[f64; 2]; 4]) -> [(Self, [[f64; 2]; 4]); 2];

    /// Number of successive midpoints in a split.
    const DEGREE: usize;

    /// Bernstein coefficients of the partial derivatives with respect to the two local parameters:
    /// for triangles `v` (towards corner 1) and `w` (towards corner 2); for squares `u` (towards
    /// corner 1) and `v` (towards corner 3).
    fn first_derivatives(&self) -> [Vec<V>; 2];

    /// Bernstein coefficients of the second derivatives, in the order vv, vw, ww.
    fn second_derivatives(&self) -> [Vec<V>; 3];

    /// The value and the two partial derivatives at local parameters `(v, w)` given in the
    /// arithmetic `S`.
    fn evaluate(&self, at: [&S; 2]) -> (V, [V; 2]);

    /// Local parameters of the corners.
    fn local_corner(corner: usize) -> [f64; 2];
}

/// The mean of two parameters; exact for the dyadic parameters of a subdivision.
pub(crate) fn mid_parameter(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}
