//! Which facets lie under a part of the surface, in the plane of the characteristic map.
//!
//! A part is a piece of a patch with the Bernstein coefficients χ_i of the characteristic map. A
//! candidate facet is *off* if for one of its edges all χ_i are certainly on the outer side. The part is
//! *covered* by the others if
//! * there are some, each of certainly positive area;
//! * for each of their edges that is not on a ray, all χ_i are certainly on the inner side, or the
//!   triangle across is a candidate too, and of certainly positive area;
//! * one of the χ_i certainly lies inside one of them.
//!
//! Then E at χ(σ) is one of the affine functions of these facets, for every σ of the part: χ(part) lies
//! in the hull of the χ_i and in the sector's wedge. From a point near that χ_i walk on a segment inside
//! this convex set, past all vertices, to almost any other point: a triangle whose interior is met is not
//! off; it is left through an edge with a candidate across, which lies on the other side, having positive
//! area, so that its interior is met; and none is met twice. So the walk ends in a facet that is not off.

use std::sync::OnceLock;

use num_traits::Zero;

use super::complex::Complex;
use super::lattice::Triangle;
use crate::bernstein::triangle::QuarticTriangle;
use crate::scalar::{Interval, Ring};

type Point = Complex<Interval>;

/// A facet in the plane.
#[derive(Clone, Debug)]
pub struct Facet {
    /// Its name in the lattice.
    pub triangle: Triangle,
    /// By corner: a point of the opposite edge, and its direction, counterclockwise.
    edges: [(Point, Point); 3],
    /// Twice its signed area.
    area: Interval,
}

impl Facet {
    /// The facet with the given corners.
    pub fn new(triangle: Triangle, corners: [Point; 3]) -> Self {
        // Where a ray begins at the centre, that is the point: signs are certain near it too.
        let edges = [(1, 1, 2), (0, 2, 0), (0, 0, 1)]
            .map(|(base, a, b): (usize, usize, usize)| (corners[base], corners[b] - &corners[a]));
        let mut facet = Facet {
            triangle,
            edges,
            area: Interval::from_integer(0),
        };
        facet.area = facet.area_at(0, &corners[0]);
        facet
    }

    /// Twice the signed area with x in place of a corner.
    fn area_at(&self, corner: usize, x: &Point) -> Interval {
        let (a, direction) = &self.edges[corner];
        direction.cross(&(*x - a))
    }

    /// The barycentric coordinates of a point.
    pub fn weights(&self, x: &Point) -> [Interval; 3] {
        [0, 1, 2].map(|corner| self.area_at(corner, x) / self.area)
    }

    /// Whether a point may lie in the facet: on none of the edges' outer sides for certain.
    pub fn may_hold(&self, x: &Point) -> bool {
        (0..3).all(|corner| self.area_at(corner, x).sup() >= 0.0)
    }

    /// The areas with each point in place of each corner; `None` if the facet is off.
    fn areas(&self, points: &[Point]) -> Option<Vec<[Interval; 3]>> {
        let mut areas = vec![[Interval::from_integer(0); 3]; points.len()];
        for corner in 0..3 {
            for (row, x) in areas.iter_mut().zip(points) {
                row[corner] = self.area_at(corner, x);
            }
            if areas.iter().all(|row| row[corner].sup() <= 0.0) {
                return None;
            }
        }
        Some(areas)
    }
}

/// A facet under a part: its index among the candidates, and barycentric coordinates of the χ_i.
#[derive(Clone, Debug)]
pub struct Covering {
    /// Index among the candidates.
    pub candidate: usize,
    /// By coefficient.
    pub weights: Vec<[Interval; 3]>,
}

/// The facets that points may lie in, of the candidates named; `None` unless they cover the hull of
/// the points as the head of this file wants it.
fn cover(
    candidates: &[Facet],
    named: impl Iterator<Item = usize>,
    points: &[Point],
) -> (Vec<usize>, Option<Vec<Covering>>) {
    let (mut near, mut list, mut inside, mut sound) = (Vec::new(), Vec::new(), false, true);
    for candidate in named {
        let facet = &candidates[candidate];
        let Some(areas) = facet.areas(points) else {
            continue;
        };
        near.push(candidate);
        let continues = |t: Triangle| {
            let across = candidates.iter().find(|other| other.triangle == t);
            across.is_some_and(|other| other.area.inf() > 0.0)
        };
        for corner in 0..3 {
            sound &= facet.triangle.edge_on_ray(corner)
                || areas.iter().all(|row| row[corner].inf() >= 0.0)
                || continues(facet.triangle.across(corner));
        }
        sound &= facet.area.inf() > 0.0;
        inside |= areas.iter().any(|row| row.iter().all(|a| a.inf() > 0.0));
        let over = |row: &[Interval; 3]| row.map(|a| a / facet.area);
        list.push(Covering {
            candidate,
            weights: areas.iter().map(over).collect(),
        });
    }
    (near, (sound && inside).then_some(list))
}

/// A part of a patch, with its quarters when they have been asked for.
#[derive(Debug)]
pub struct Part {
    /// χ.
    pub chi: QuarticTriangle<Point>,
    /// The candidates that are not off.
    near: Vec<usize>,
    /// Whether it is known to lie over its only candidate.
    known: bool,
    /// What covers it, if that is certain.
    pub covering: Option<Vec<Covering>>,
    quarters: OnceLock<Box<[Part; 4]>>,
}

impl Part {
    fn new(
        chi: QuarticTriangle<Point>,
        candidates: &[Facet],
        named: &[usize],
        known: bool,
    ) -> Self {
        let (near, covering) = if known {
            let weights = chi.0.iter().map(|x| candidates[0].weights(x)).collect();
            let candidate = 0;
            (vec![0], Some(vec![Covering { candidate, weights }]))
        } else {
            cover(candidates, named.iter().copied(), &chi.0)
        };
        Part {
            chi,
            near,
            known,
            covering,
            quarters: OnceLock::new(),
        }
    }

    /// The four quarters; made once, for all modes.
    pub fn quarters(&self, candidates: &[Facet]) -> &[Part; 4] {
        self.quarters.get_or_init(|| {
            let quarters = self.chi.quarters::<Interval>();
            Box::new(quarters.map(|chi| Part::new(chi, candidates, &self.near, self.known)))
        })
    }
}

/// A patch of the characteristic map over the facets that may lie under it.
#[derive(Debug)]
pub struct Patch {
    /// The triangle of the lattice that it belongs to.
    pub triangle: Triangle,
    /// The candidates.
    pub candidates: Vec<Facet>,
    /// The whole.
    pub root: Part,
}

impl Patch {
    /// A patch that is known to lie over its only candidate.
    pub fn over_its_own(
        triangle: Triangle,
        chi: QuarticTriangle<Point>,
        candidates: Vec<Facet>,
    ) -> Self {
        let root = Part::new(chi, &candidates, &[0], true);
        Patch {
            triangle,
            candidates,
            root,
        }
    }

    /// At the χ_i, the affine function with the given values at the corners of the first candidate.
    pub fn chi_values(&self, values: &[Point; 3]) -> Vec<Point> {
        let facet = &self.candidates[0];
        let at = |x: &Point| {
            let terms = facet.weights(x).into_iter().zip(values);
            terms.fold(Point::zero(), |sum, (b, value)| sum + *value * &b)
        };
        self.root.chi.0.iter().map(at).collect()
    }

    /// The patch with the Bernstein coefficients χ_i.
    pub fn new(triangle: Triangle, chi: QuarticTriangle<Point>, candidates: Vec<Facet>) -> Self {
        let all: Vec<usize> = (0..candidates.len()).collect();
        let root = Part::new(chi, &candidates, &all, false);
        Patch {
            triangle,
            candidates,
            root,
        }
    }
}
