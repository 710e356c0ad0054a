//! Catmull-Clark: masks and local nets.

mod local_net;

pub use local_net::*;

use super::StarMask;
use crate::scalar::{Field, Module};

/// The vertex mask `((n-2)/n) P + (1/n^2) Σ e_i + (1/n^2) Σ f'_i`: e_i the edge neighbours, f'_i
/// the NEW face points.
pub fn vertex_mask<S: Field>(n: u32) -> StarMask<S> {
    let n = i64::from(n);
    StarMask {
        center: S::ratio(n - 2, n),
        edge: S::ratio(1, n * n),
        face: S::ratio(1, n * n),
    }
}

/// The limit mask `(n^2 P + 4 Σ e_i + Σ f_i) / (n (n+5))` on an all-quad ring: e_i edge
/// neighbours, f_i diagonal vertices, all of one level.
pub fn limit_mask<S: Field>(n: u32) -> StarMask<S> {
    let n = i64::from(n);
    StarMask {
        center: S::ratio(n, n + 5),
        edge: S::ratio(4, n * (n + 5)),
        face: S::ratio(1, n * (n + 5)),
    }
}

/// The limit mask `(n(n-1) P + 2 Σ e_i + 4 Σ f'_i) / (n (n+5))` on any polygons: e_i old edge
/// neighbours, f'_i the NEXT level's face points.
pub fn limit_mask_polygons<S: Field>(n: u32) -> StarMask<S> {
    let n = i64::from(n);
    StarMask {
        center: S::ratio(n - 1, n + 5),
        edge: S::ratio(2, n * (n + 5)),
        face: S::ratio(4, n * (n + 5)),
    }
}

/// The edge point `(a + b + f + g) / 4`: a, b the ends, f, g the two adjacent new face points.
#[inline]
pub fn edge_point<S: Field, V: Module<S>>(a: &V, b: &V, f: &V, g: &V) -> V {
    ((a.clone() + b) + &(f.clone() + g)) * &S::ratio(1, 4)
}

/// The centroid of the four corners of a quad.
#[inline]
pub fn quad_point<S: Field, V: Module<S>>(a: &V, b: &V, c: &V, d: &V) -> V {
    ((a.clone() + b) + &(c.clone() + d)) * &S::ratio(1, 4)
}

/// The centroid of an m-gon from the sum of its corners.
#[inline]
pub fn face_point<S: Field, V: Module<S>>(sum: &V, m: u32) -> V {
    sum.clone() * &S::ratio(1, i64::from(m))
}
