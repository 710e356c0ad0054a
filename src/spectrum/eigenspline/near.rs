//! The rings towards the centre, against the facets of level 0.
//!
//! All of them lie over the facet (O, a_0, a_1) of their sector, where E is affine. Rings 1..Q are looked
//! at one by one. Over ring r > Q, |λ| < 1, e is at most `|λ|^(Q+1) max |e_i|`, and E lies in the hull of
//! E(0) and what it is over ring Q + 1, since the rings shrink towards the centre; so the sum of
//! `|λ|^(Q+1) max |e_i|` and the largest of |E(0)| and |E(λ_1^(Q+1) χ_i)| bounds the rest. A generalised
//! mode has `λ^r e + r λ^(r-1) κ f` over ring r; `r λ^(r-1)` falls too, for λ = 1/16.

use super::complex::Complex;
use super::lattice::Levels;
use super::maximum::{Start, Value, enclose, magnitude};
use super::mode::Net;
use super::plane::{CENTRE, MOST_RINGS, Plane, spline, vertices};
use super::scaling::{above, below};
use super::{Against, Enclosed};
use crate::bernstein::triangle::QuarticTriangle;
use crate::scalar::{Interval, Ring};

/// Relative gap that is aimed at.
const GAP: f64 = 1e-4;
/// How much of the bound the rings beyond Q may add.
const TAIL: f64 = 2e-7;

/// λ^r, and `r λ^(r-1) κ` where there is a chain.
fn powers(net: &Net<Interval>, r: u32) -> (Interval, Interval) {
    let power =
        |count: u32| (0..count).fold(Interval::from_integer(1), |power, _| power * net.eigenvalue);
    let kappa = net.kappa.unwrap_or(Interval::from_integer(0));
    let slope = power(r.saturating_sub(1)) * Interval::from_integer(i64::from(r)) * kappa;
    (power(r), slope)
}

/// N, with the number Q of rings that show it.
pub fn enclose_near(
    plane: &Plane,
    net: &Net<Interval>,
    nets: &Levels<Interval>,
    chain: Option<(&Levels<Interval>, &Interval)>,
    against: Against,
) -> Option<(Enclosed, u32)> {
    let symmetric = net.label.is_mirror_symmetric();
    let mut starts = Vec::new();
    let mut largest = [0.0f64; 2];
    for sector in 0..net.label.sectors() {
        let facet = vertices(nets, 0, sector, CENTRE, against);
        for (r, patches) in (1..).zip(&plane.near) {
            let (scale, slope) = powers(net, r);
            for patch in patches {
                let e = spline(nets, 1, sector, patch.triangle);
                let f = chain.map(|(f, _)| spline(f, 1, sector, patch.triangle));
                let over_ring = |i: usize| -> Complex<Interval> {
                    let value = e.0[i] * &scale;
                    f.as_ref().map_or(value, |f| value + f.0[i] * &slope)
                };
                let most = |e: &QuarticTriangle<Value>| {
                    let all = e.0.iter().map(|z| magnitude(z).sup());
                    all.fold(0.0, f64::max)
                };
                largest[0] = largest[0].max(most(&e));
                largest[1] = largest[1].max(f.as_ref().map_or(0.0, most));
                if symmetric && patch.triangle.p < patch.triangle.q {
                    continue;
                }
                starts.push(Start {
                    patch,
                    sector,
                    ring: r,
                    spline: QuarticTriangle(std::array::from_fn(over_ring)),
                    facets: vec![facet],
                });
            }
        }
    }
    let centre = magnitude(&vertices(nets, 0, 0, CENTRE, against)[0]);
    let found = enclose(&starts, centre.sup(), GAP)?;
    let (depth, tail) = (1..=MOST_RINGS - 1)
        .map(|depth| (depth, tail(plane, net, nets, depth, largest, against)))
        .find(|(depth, tail)| *tail <= found.hi * (1.0 + TAIL) || *depth == MOST_RINGS - 1)?;
    let reached = found.reached.filter(|reached| reached.value > centre.inf());
    let value = reached.map_or(0.0, |reached| reached.value);
    let enclosed = Enclosed {
        lo: below(value.max(centre.inf())),
        hi: above(found.hi.max(tail).max(value * (1.0 + GAP))),
        place: reached.map(|reached| reached.place(&starts)),
    };
    Some((enclosed, depth))
}

/// The bound over the rings beyond a number of them.
fn tail(
    plane: &Plane,
    net: &Net<Interval>,
    nets: &Levels<Interval>,
    depth: u32,
    largest: [f64; 2],
    against: Against,
) -> f64 {
    let (scale, slope) = powers(net, depth + 1);
    let [e, f] = largest.map(Interval::point);
    let spline = scale.abs() * e + slope.abs() * f;
    let over = |sector: usize| {
        let facet = vertices(nets, 0, sector, CENTRE, against);
        let patches = plane.near[depth as usize].iter();
        let values = patches.flat_map(|patch| patch.chi_values(&facet));
        values.fold(magnitude(&facet[0]).sup(), |most, z| {
            most.max(magnitude(&z).sup())
        })
    };
    let affine = (0..net.label.sectors()).map(over).fold(0.0, f64::max);
    (spline + Interval::point(affine)).sup()
}
