//! The patches of the characteristic map of one valence over the facets of each level.

use rayon::prelude::*;

use super::Against;
use super::complex::Complex;
use super::facets::{Facet, Patch};
use super::lattice::{Levels, Triangle};
use crate::bernstein::from_net::box_spline;
use crate::bernstein::triangle::QuarticTriangle;
use crate::scalar::{Interval, Ring};

/// Rings of [`Plane::near`].
pub const MOST_RINGS: u32 = 40;

/// Ring 0 over the facets of each level, and the further rings over those of level 0.
#[derive(Debug)]
pub struct Plane {
    /// By level.
    pub rings: Vec<Vec<Patch>>,
    /// The patches of ring r = 1, 2, .. over the facet [0, 0, 0], for r up to [`MOST_RINGS`].
    pub near: Vec<Vec<Patch>>,
}

/// The level of the patches that are held against the facets of level s.
pub fn patch_level(s: usize) -> usize {
    s.max(1)
}

/// The triangles of ring 0 at a level >= 1.
pub fn ring(level: usize) -> Vec<Triangle> {
    Triangle::between(1 << (level - 1), 1 << level)
}

/// The patch of a mode over a triangle of a level.
pub fn spline(
    levels: &Levels<Interval>,
    level: usize,
    sector: usize,
    triangle: Triangle,
) -> QuarticTriangle<Complex<Interval>> {
    let net = levels.level(level, sector).patch_net(triangle);
    box_spline::<Interval, Complex<Interval>>(&net)
}

/// The vertices of a facet of level s.
pub fn vertices(
    levels: &Levels<Interval>,
    s: usize,
    sector: usize,
    triangle: Triangle,
    against: Against,
) -> [Complex<Interval>; 3] {
    let limit = against == Against::Limit;
    triangle
        .corners()
        .map(|place| levels.vertex(s, sector, place, limit))
}

impl Plane {
    /// The plane of the characteristic map of valence n with eigenvalue λ_1, up to a level.
    pub fn new(
        n: u32,
        chi: &Levels<Interval>,
        eigenvalue: Interval,
        against: Against,
        last: usize,
    ) -> Self {
        let facet = |s: usize, triangle: Triangle| {
            Facet::new(triangle, vertices(chi, s, 0, triangle, against))
        };
        let rings = (0..=last).map(|s| {
            let level = patch_level(s);
            let patch = |triangle: Triangle| {
                let candidates = match s {
                    _ if n == REGULAR => vec![own(s, triangle)],
                    0 => Triangle::between(0, against.radius()),
                    _ => triangle.touching(),
                };
                let candidates = candidates.into_iter().map(|t| facet(s, t)).collect();
                let chi = spline(chi, level, 0, triangle);
                match n {
                    REGULAR => Patch::over_its_own(triangle, chi, candidates),
                    _ => Patch::new(triangle, chi, candidates),
                }
            };
            ring(level).into_par_iter().map(patch).collect()
        });
        let rings = rings.collect();
        let centre = facet(0, CENTRE);
        let mut scale = Interval::from_integer(1);
        let near = (1..=MOST_RINGS).map(|_| {
            scale *= eigenvalue;
            let patch = |triangle: Triangle| {
                let chi = spline(chi, 1, 0, triangle).0.map(|x| x * &scale);
                Patch::new(triangle, QuarticTriangle(chi), vec![centre.clone()])
            };
            ring(1).into_iter().map(patch).collect()
        });
        Plane {
            near: near.collect(),
            rings,
        }
    }
}

/// The valence with χ(p, q) = p + q e^(2πi/6), a linear map: it reproduces linear functions, so that the
/// patch of a triangle lies over the facet of the same name, and at level 0 ring 0 over (O, a_0, a_1).
/// Limit points are the same. Nothing has to be shown of signs, which are 0 along all edges.
const REGULAR: u32 = 6;

/// The facet of level s under a triangle at valence 6.
fn own(s: usize, triangle: Triangle) -> Triangle {
    if s == 0 { CENTRE } else { triangle }
}

/// The facet (O, a_0, a_1).
pub const CENTRE: Triangle = Triangle {
    p: 0,
    q: 0,
    down: false,
};
