//! Pieces of an eigenspline over facets in the plane of the characteristic map: section 9 of FORMAT.md.

use crate::complex::Complex;
use crate::embedding::{Quarters, WHOLE};
use crate::fixed::Fixed;
use crate::sector::Quartic;
use crate::tilt::tilt;

/// The most quarterings of a patch.
const SPLITS: usize = 20;
/// The weights of the coefficients at (1/3, 1/3), over 81.
const MIDDLE: [i64; 15] = [1, 4, 4, 6, 12, 6, 4, 12, 12, 4, 1, 4, 6, 4, 1];

/// What is on the other side of an edge of a facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Across {
    /// The ray of the sector.
    Ray,
    /// A facet of the list.
    Facet(usize),
    /// A facet that is not in the list.
    Other,
}

/// A facet in the plane.
pub struct Facet {
    corners: [Complex; 3],
    /// The edge opposite to each corner, counterclockwise.
    edges: [Complex; 3],
    /// Twice the area.
    area: Fixed,
    across: [Across; 3],
}

/// The values of an eigenspline at the corners of a facet: the first, and what the others differ by.
pub type Heights = [Complex; 3];

/// Twice the signed areas of a facet with a point in place of each of the corners.
type Areas = [Fixed; 3];

impl Facet {
    /// The facet with these corners.
    pub fn new(corners: [Complex; 3], across: [Across; 3]) -> Self {
        let [a, b, c] = corners;
        Self { corners, edges: [c - b, a - c, b - a], area: (b - a).cross(c - a), across }
    }

    /// The signed area with the point in place of one corner.
    fn area_at(&self, corner: usize, z: Complex) -> Fixed {
        self.edges[corner].cross(z - self.corners[(corner + 1) % 3])
    }

    fn areas(&self, z: Complex) -> Areas {
        let [second, third] = [1, 2].map(|corner| self.area_at(corner, z));
        [self.area - second - third, second, third]
    }

    /// All points are shown to be outside of one edge.
    fn is_off(&self, chi: &Quartic) -> bool {
        let outside = |corner| chi.iter().all(|z| self.area_at(corner, *z).is_at_most_zero());
        (0..3).any(outside)
    }

    /// The points are shown to be on the inner side of the edge opposite to the first corner, and that to be so too.
    pub fn holds_from_first(&self, chi: &Quartic) -> bool {
        let within = chi.iter().all(|z| self.area_at(0, *z).is_at_least_zero());
        within && self.area.is_positive()
    }

    /// The affine function with the heights at the corners.
    pub fn height(&self, heights: &Heights, z: Complex) -> Complex {
        let [_, second, third] = self.areas(z).map(|area| area.over(self.area));
        heights[0] + heights[1] * second + heights[2] * third
    }

    /// `T (e - E)` at a point, T twice the area.
    fn gap(&self, [first, second, third]: &Heights, areas: &Areas, e: Complex) -> Complex {
        (e - *first) * self.area - *second * areas[1] - *third * areas[2]
    }
}

/// The heights at the corners.
pub fn heights([a, b, c]: [Complex; 3]) -> Heights {
    [a, b - a, c - a]
}

/// The value of a patch at a point of the triangle.
pub fn value(patch: &Quartic, [v, w]: [Fixed; 2]) -> Complex {
    let index = |j: usize, k: usize| (j + k) * (j + k + 1) / 2 + k;
    let (u, mut values) = (Fixed::ONE - v - w, *patch);
    for degree in (0..4).rev() {
        for row in 0..=degree {
            for k in 0..=row {
                let at = |j, k| values[index(j, k)];
                let j = row - k;
                values[index(j, k)] = at(j, k) * u + at(j + 1, k) * v + at(j, k + 1) * w;
            }
        }
    }
    values[0]
}

/// An eigenspline's part in a patch: its number, and its coefficients there.
pub type Spline = (usize, Quartic);

/// The candidates of a patch, the splines over it, and the bounds that these are to keep.
pub struct Scene<'a> {
    pub facets: Vec<Facet>,
    /// The one facet is to hold all of the sector's part, where it has edges that are no rays.
    pub alone: bool,
    /// For each spline and facet.
    pub heights: Vec<Vec<Heights>>,
    /// For each spline.
    pub bounds: Vec<Fixed>,
    pub quarters: &'a Quarters,
    /// The splines that do not keep their bounds, as far as is shown.
    pub failed: Vec<usize>,
    /// How often a part of a spline was looked at.
    pub work: u64,
}

/// A facet that is not off a part, and the areas at its coefficients.
struct View {
    facet: usize,
    areas: [Areas; 15],
}

impl Scene<'_> {
    /// Shows that the splines stay below their bounds over the part; `failed` gets those of which it is not shown.
    pub fn show(&mut self, chi: &Quartic, splines: &[Spline], splits: usize) {
        self.work += 1 + splines.len() as u64;
        let views = self.views(chi);
        let below = |(i, e): &Spline| {
            views.as_ref().is_some_and(|views| views.iter().all(|view| self.is_below(view, *i, e)))
        };
        let mut rest: Vec<_> = splines.iter().filter(|spline| !below(spline)).copied().collect();
        if splits == SPLITS {
            self.failed.extend(rest.iter().map(|(i, _)| *i));
            return;
        }
        for letter in 0..4 {
            rest.retain(|(i, _)| !self.failed.contains(i));
            if rest.is_empty() {
                return;
            }
            let part = |net: &Quartic| quarter(&self.quarters[letter], net);
            let parts: Vec<_> = rest.iter().map(|(i, e)| (*i, part(e))).collect();
            let chi = part(chi);
            self.show(&chi, &parts, splits + 1);
        }
    }

    /// The facets that are not off the part, if they are shown to hold what of chi is in the sector.
    fn views(&self, chi: &Quartic) -> Option<Vec<View>> {
        let middle = {
            let terms = MIDDLE.into_iter().zip(*chi);
            // In two sums, as the weights of one are limited.
            let [some, others] = [false, true].map(|even| {
                Complex::mean(
                    terms.clone().enumerate().filter(|(i, _)| (i % 2 == 0) == even).map(|(_, t)| t),
                    81,
                )
            });
            some + others
        };
        let mut views = Vec::new();
        let mut start = self.alone;
        for (facet, face) in self.facets.iter().enumerate() {
            if !self.alone && face.is_off(chi) {
                continue;
            }
            let areas = chi.map(|z| face.areas(z));
            let kept = (0..3).all(|corner| match face.across[corner] {
                Across::Ray => true,
                Across::Facet(next) if self.facets[next].area.is_positive() => true,
                _ => areas.iter().all(|at| at[corner].is_at_least_zero()),
            });
            if !kept || !face.area.is_positive() {
                return None;
            }
            start = start || face.areas(middle).into_iter().all(Fixed::is_positive);
            views.push(View { facet, areas });
        }
        start.then_some(views)
    }

    fn is_below(&self, view: &View, spline: usize, e: &Quartic) -> bool {
        let (face, heights) = (&self.facets[view.facet], &self.heights[spline][view.facet]);
        let bound = (self.bounds[spline] * face.area).square();
        let gaps = |heights: &Heights| -> [Complex; 15] {
            std::array::from_fn(|i| face.gap(heights, &view.areas[i], e[i]))
        };
        let plain = gaps(heights);
        if are_small(&plain, bound) {
            return true;
        }
        let (u, factors) = tilt(&plain, &view.areas);
        outweighs(&plain, u, factors) && are_small(&gaps(&tilted(heights, u, factors)), bound)
    }

    /// The magnitude of e - E at a point is shown to be at least the bound, on each facet where the point may be.
    pub fn reaches(&self, spline: usize, z: Complex, e: Complex) -> bool {
        let mut found = false;
        for (face, heights) in self.facets.iter().zip(&self.heights[spline]) {
            let areas = face.areas(z);
            if areas.iter().any(|area| area.below(Fixed::ZERO)) {
                continue;
            }
            let bound = (self.bounds[spline] * face.area).square();
            let large = bound.at_most(face.gap(heights, &areas, e).norm());
            if !large || !face.area.is_positive() {
                return false;
            }
            found = true;
        }
        found
    }
}

fn are_small(gaps: &[Complex; 15], bound: Fixed) -> bool {
    gaps.iter().all(|gap| gap.norm().at_most(bound))
}

/// `t_v >= 0` and `Re(conj(u) g_i) >= 0` are shown: then `|g + u Σ t_v T_v| >= |g|` where no `T_v` is negative.
fn outweighs(gaps: &[Complex; 15], u: Complex, factors: [Fixed; 3]) -> bool {
    let along = |gap: &Complex| (gap.re * u.re + gap.im * u.im).is_at_least_zero();
    factors.into_iter().all(Fixed::is_at_least_zero) && gaps.iter().all(along)
}

/// The heights `E_v - t_v u`, with which `g + u Σ t_v T_v` takes the place of g.
fn tilted([first, second, third]: &Heights, u: Complex, [a, b, c]: [Fixed; 3]) -> Heights {
    [*first - u * a, *second + u * (a - b), *third + u * (a - c)]
}

/// The coefficients over a quarter.
fn quarter(rows: &[Vec<(i64, usize)>], net: &Quartic) -> Quartic {
    let row = |i: usize| rows[i].iter().map(|(c, at)| (*c, net[*at]));
    std::array::from_fn(|i| Complex::mean(row(i), WHOLE))
}

#[cfg(test)]
mod tests;
