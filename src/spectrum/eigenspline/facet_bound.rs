//! A bound of |e - E| where a part lies over one facet, though the part may reach beyond the facet.
//!
//! Let g_i be the coefficients of e - E, E affine as on the facet, and b_v(i) the barycentric coordinate
//! of χ_i that belongs to the corner v. For ν_v >= 0 with `|g_i| + Σ_v ν_v b_v(i) <= H` for all i,
//!
//! ```text
//! |g(σ)| <= Σ B_i |g_i| <= H - Σ_v ν_v b_v(χ(σ)) <= H   wherever χ(σ) lies in the facet,
//! ```
//!
//! for there all b_v >= 0, and b_v(χ(σ)) = Σ B_i b_v(i). With ν = 0 this is the hull. With the others a
//! part that barely overlaps a facet, or that has its maximum on an edge, where E has a kink, need not be
//! cut into small pieces. Floats choose the ν; any choice is sound.

use std::array::from_fn;

use super::facets::Covering;
use super::maximum::{Value, difference, magnitude};
use crate::bernstein::triangle::QuarticTriangle;
use crate::scalar::Interval;

/// How many edges are tried, one after the other.
const ROUNDS: usize = 2;

/// The number of coefficients.
const COUNT: usize = 15;

/// An upper bound of |e - E| over what of a part lies over the facet, E having the given values at its
/// corners; no effort is made to bring it below `enough`.
pub fn bound_over(
    covering: &Covering,
    spline: &QuarticTriangle<Value>,
    facet: &[Value; 3],
    enough: f64,
) -> f64 {
    let weights = &covering.weights;
    let mut bounds: [f64; COUNT] =
        from_fn(|i| magnitude(&difference(&spline.0[i], &weights[i], facet)).sup());
    let mut most = largest(&bounds);
    for _ in 0..ROUNDS {
        if most <= enough {
            break;
        }
        let proposals = [0, 1, 2].map(|corner| {
            let slopes: [f64; COUNT] = from_fn(|i| weights[i][corner].sup());
            let (nu, least) = lowest(&bounds, &slopes);
            (least, nu, slopes)
        });
        let best = proposals.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, nu, slopes)) = best.filter(|(_, nu, _)| *nu > 0.0) else {
            break;
        };
        // ν times the upper end of b: an upper bound, as ν >= 0.
        let tilted: [f64; COUNT] = from_fn(|i| {
            let tilt = Interval::point(nu) * Interval::point(slopes[i]);
            (Interval::point(bounds[i]) + tilt).sup()
        });
        let lower = largest(&tilted);
        if lower >= most {
            break;
        }
        (bounds, most) = (tilted, lower);
    }
    most.max(0.0)
}

fn largest(list: &[f64]) -> f64 {
    list.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// The ν >= 0 where the largest of the `a_i + ν b_i` is least, and that value, about: along the upper
/// envelope of the lines from ν = 0, as long as it falls.
fn lowest(a: &[f64], b: &[f64]) -> (f64, f64) {
    let highest = |nu: f64| {
        let value = |i: &usize| (a[*i] + nu * b[*i], b[*i]);
        let all = (0..a.len()).map(|i| (value(&i), i));
        all.max_by(|x, y| x.0.0.total_cmp(&y.0.0).then(x.0.1.total_cmp(&y.0.1)))
    };
    let mut nu = 0.0;
    for _ in 0..a.len() {
        let Some(((_, slope), i)) = highest(nu) else {
            break;
        };
        if slope >= 0.0 {
            break;
        }
        // The next line that this one meets.
        let meets = (0..a.len()).filter(|&j| b[j] > slope);
        let next = meets
            .map(|j| (a[i] - a[j]) / (b[j] - slope))
            .fold(f64::INFINITY, f64::min);
        if !next.is_finite() || next <= nu {
            break;
        }
        nu = next;
    }
    (nu, highest(nu).map_or(0.0, |((value, _), _)| value))
}
