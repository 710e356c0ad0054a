//! A point where |e - E| is large, and a lower bound of the value there.

use super::SplinePoint;
use super::complex::Complex;
use super::maximum::{Start, difference, magnitude};
use crate::bernstein::Patch as _;
use crate::scalar::{Interval, Rational};

/// A point of a patch where e - E is large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// Index of the start.
    pub start: usize,
    /// The parameters, multiples of 2^-16.
    pub at: [f64; 2],
    /// |e - E| is at least this.
    pub value: f64,
}

impl Reached {
    /// Its place on the surface.
    pub fn place(&self, starts: &[Start]) -> SplinePoint {
        let start = &starts[self.start];
        SplinePoint {
            ring: start.ring,
            sector: start.sector,
            triangle: start.patch.triangle,
            at: (self.at).map(|x| Rational::from_float(x).expect("a dyadic number")),
        }
    }
}

/// The parameters of points are multiples of this.
const STEP: f64 = 1.0 / 65536.0;
/// The first step of the ascent: parts of a full depth have sides of 2^-8.
const FIRST_STEP: f64 = 1.0 / 64.0;
const DIRECTIONS: [[f64; 2]; 8] = [
    [1.0, 0.0],
    [0.0, 1.0],
    [-1.0, 1.0],
    [-1.0, 0.0],
    [0.0, -1.0],
    [1.0, -1.0],
    [1.0, 1.0],
    [-1.0, -1.0],
];

/// Climbs from a point in floats and encloses the value at the end; `None` if no facet is certain
/// there.
pub fn reach(starts: &[Start], start: usize, from: [f64; 2]) -> Option<Reached> {
    let here = starts.get(start)?;
    let (mut at, mut value) = (from, estimate(here, from));
    let mut step = FIRST_STEP;
    while step >= STEP {
        let tried = DIRECTIONS.map(|[v, w]| [at[0] + step * v, at[1] + step * w]);
        let better = (tried.into_iter())
            .filter(|[v, w]| *v >= 0.0 && *w >= 0.0 && v + w <= 1.0)
            .map(|point| (estimate(here, point), point))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(other, _)| *other > value);
        match better {
            Some((other, point)) => (value, at) = (other, point),
            None => step /= 2.0,
        }
    }
    // A point on a border may be no better inside, and then the first one was as good.
    let found = lower_bound(here, at)?;
    Some(Reached {
        start,
        at,
        value: found,
    })
}

/// |e - E|, about: over the facet that the point lies in, or is nearest to lying in.
fn estimate(start: &Start, at: [f64; 2]) -> f64 {
    let [v, w] = at.map(Interval::point);
    let (chi, _) = start.patch.root.chi.evaluate([&v, &w]);
    let (e, _) = start.spline.evaluate([&v, &w]);
    let depth = |weights: &[Interval; 3]| weights.iter().map(|b| b.mid()).fold(1.0, f64::min);
    let all = start.patch.candidates.iter().zip(&start.facets);
    let facets = all.map(|(facet, values)| (facet.weights(&chi), values));
    let best = facets.max_by(|a, b| depth(&a.0).total_cmp(&depth(&b.0)));
    best.map_or(0.0, |(weights, values)| {
        magnitude(&difference(&e, &weights, values)).mid()
    })
}

/// A lower bound of |e - E| at a point: over each facet that it may lie in.
pub fn lower_bound(start: &Start, at: [f64; 2]) -> Option<f64> {
    let [v, w] = at.map(Interval::point);
    let (chi, _) = start.patch.root.chi.evaluate([&v, &w]);
    let (e, _): (Complex<Interval>, _) = start.spline.evaluate([&v, &w]);
    let candidates = start.patch.candidates.iter().zip(&start.facets);
    let near = candidates.filter(|(facet, _)| facet.may_hold(&chi));
    let values =
        near.map(|(facet, values)| magnitude(&difference(&e, &facet.weights(&chi), values)).inf());
    values.reduce(f64::min)
}

#[cfg(test)]
mod tests {
    use super::super::facets::{Facet, Patch};
    use super::super::plane::CENTRE;
    use super::*;
    use crate::bernstein::triangle::QuarticTriangle;

    /// The point (1/2, 1/2) lies in both facets at the edge from (1, 0) to (0, 1). With e = 0 and E = 3 on one of
    /// them, E = 1 on the other, |e - E| is at least 1 there, whichever of them is the right one.
    #[test]
    fn a_point_on_an_edge_has_the_smaller_value_of_both_facets() {
        let number = |re: f64, im: f64| Complex {
            re: Interval::point(re),
            im: Interval::point(im),
        };
        let facet = |triangle: super::super::lattice::Triangle| {
            let corner = |[p, q]: [i32; 2]| number(p.into(), q.into());
            Facet::new(triangle, triangle.corners().map(corner))
        };
        let chi = [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| number(x, y));
        let chi = QuarticTriangle::from_linear::<Interval>(&chi);
        let both = vec![facet(CENTRE), facet(CENTRE.across(0))];
        for values in [[3.0, 1.0], [1.0, 3.0]] {
            let start = Start {
                patch: &Patch::new(CENTRE, chi.clone(), both.clone()),
                sector: 0,
                ring: 0,
                spline: QuarticTriangle::from_linear::<Interval>(&[number(0.0, 0.0); 3]),
                facets: values.map(|e| [number(e, 0.0); 3]).to_vec(),
            };
            let found = lower_bound(&start, [0.5, 0.0]).expect("a facet");
            assert!(found <= 1.0 && found > 1.0 - 1e-12, "{found}");
        }
    }
}
