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

#[cfg(test)]
mod tests {
    use super::super::complex::Complex;
    use super::super::facets::{Facet, Patch};
    use super::super::plane::CENTRE;
    use super::*;
    use crate::bernstein::Patch as _;

    fn number(x: f64) -> Complex<Interval> {
        Complex::real(Interval::point(x))
    }

    /// Whatever e is, the bound holds at the points of the part that lie in the facet, here about a half
    /// of it; and it makes use of their being no more: for some e it is below the value elsewhere.
    #[test]
    fn the_bound_holds_where_the_part_is_in_the_facet() {
        let corner = |re: f64, im: f64| Complex {
            re: Interval::point(re),
            im: Interval::point(im),
        };
        let facet = Facet::new(CENTRE, [corner(0., 0.), corner(1., 0.), corner(0., 1.)]);
        // The triangle moved along, beyond the edge from corner 1 to corner 2.
        let moved = [corner(0.25, 0.25), corner(1.25, 0.25), corner(0.25, 1.25)];
        let chi = QuarticTriangle::from_linear::<Interval>(&moved);
        let values = [number(0.5), number(-1.0), number(2.0)];
        let weights = chi.0.iter().map(|x| facet.weights(x)).collect();
        let covering = Covering {
            candidate: 0,
            weights,
        };
        let mut tight = 0;
        for seed in 0..200u64 {
            let value = |i: usize| {
                let mixed = (seed * 15 + i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                number((mixed >> 40) as f64 / (1u64 << 23) as f64 - 1.0)
            };
            let spline = QuarticTriangle(from_fn(value));
            let bound = bound_over(&covering, &spline, &values, 0.0);
            let (mut inside, mut outside) = (0.0f64, 0.0f64);
            for (v, w) in (0..=16).flat_map(|v| (0..=16 - v).map(move |w| (v, w))) {
                let at = [v, w].map(|x| Interval::point(f64::from(x) / 16.0));
                let (x, _) = chi.evaluate([&at[0], &at[1]]);
                let (e, _) = spline.evaluate([&at[0], &at[1]]);
                let weights = facet.weights(&x);
                let size = magnitude(&difference(&e, &weights, &values)).inf();
                if weights.iter().all(|b| b.inf() >= 0.0) {
                    inside = inside.max(size);
                } else {
                    outside = outside.max(size);
                }
            }
            assert!(inside <= bound, "{seed}: {inside} > {bound}");
            tight += usize::from(bound < outside);
        }
        assert!(tight > 20, "{tight} of 200");
    }

    #[test]
    fn a_part_is_covered_only_by_facets_that_hold_it() {
        let corner = |re: f64, im: f64| Complex {
            re: Interval::point(re),
            im: Interval::point(im),
        };
        let lattice = |[p, q]: [i32; 2]| corner(p.into(), q.into());
        let facet = |triangle: super::super::lattice::Triangle| {
            Facet::new(triangle, triangle.corners().map(lattice))
        };
        let across = CENTRE.across(0);
        let covered = |shift: f64, facets: Vec<Facet>| {
            let part = [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5)];
            let corners = part.map(|(x, y)| corner(x + shift, y + shift));
            let chi = QuarticTriangle::from_linear::<Interval>(&corners);
            let patch = Patch::new(CENTRE, chi, facets);
            patch.root.covering.map(|list| list.len())
        };
        let both = || vec![facet(CENTRE), facet(across)];
        assert_eq!(covered(0.125, vec![facet(CENTRE)]), Some(1));
        // The edges on the rays need nothing across.
        assert_eq!(covered(0.0, vec![facet(CENTRE)]), Some(1));
        // Beyond the edge between them: both, or not at all.
        assert_eq!(covered(0.375, vec![facet(CENTRE)]), None);
        assert_eq!(covered(0.375, both()), Some(2));
        assert_eq!(covered(0.5, both()), Some(1));
        // Beyond both.
        assert_eq!(covered(0.625, both()), None);
        assert_eq!(covered(3.0, both()), None);
        // Past the centre: each side of the facet has a point within, the facet has none.
        let past = [(-0.125, 0.0625), (0.0625, -0.125), (-0.125, -0.125)];
        let past = past.map(|(x, y)| corner(x, y));
        let chi = QuarticTriangle::from_linear::<Interval>(&past);
        let patch = Patch::new(CENTRE, chi, vec![facet(CENTRE)]);
        assert!(patch.root.covering.is_none());
        // A triangle that is folded over does not continue another.
        let folded = Facet::new(across, [[0, 0], [0, 1], [1, 0]].map(lattice));
        assert_eq!(covered(0.375, vec![facet(CENTRE), folded]), None);
    }
}
