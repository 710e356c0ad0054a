//! Differences of points, and squares of lengths.

pub(super) type Vector = [f64; 3];

/// `if a > b`: one instruction, no branch; neither is NaN.
#[inline]
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline]
pub(super) fn square(x: &Vector) -> f64 {
    x[0] * x[0] + x[1] * x[1] + x[2] * x[2]
}

#[inline]
pub(super) fn minus(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

#[inline]
pub(super) fn middle(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| 0.5 * a[i] + 0.5 * b[i])
}

/// `2p - q - r`, as (p - q) + (p - r).
#[inline]
pub(super) fn second(p: &Vector, q: &Vector, r: &Vector) -> Vector {
    [0, 1, 2].map(|i| (p[i] - q[i]) + (p[i] - r[i]))
}
