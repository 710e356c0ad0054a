//! The lattice of a sector of the two-ring, and its refinement: section 9 of FORMAT.md.

use crate::complex::Complex;
use crate::eigen::Mode;
use crate::fixed::Fixed;
use crate::loop_scheme::T;

/// A point (p, q): on the rays if p or q is 0, in the halo if one is -1.
pub type Place = [i64; 2];

/// A triangle [p, q, 0] (up) or [p, q, 1] (down) of the lattice.
pub type Triangle = [i64; 3];

/// The Bernstein coefficients of a patch.
pub type Quartic = [Complex; 15];

/// The points up to a radius, and the halo.
#[derive(Clone)]
pub struct Lattice {
    radius: i64,
    points: Vec<Complex>,
}

/// The corners of a triangle.
pub fn corners([p, q, t]: Triangle) -> [Place; 3] {
    match t {
        0 => [[p, q], [p + 1, q], [p, q + 1]],
        _ => [[p + 1, q + 1], [p, q + 1], [p + 1, q]],
    }
}

/// The triangle across the edge opposite to a corner; none if the edge is on a ray.
pub fn across([p, q, t]: Triangle, corner: usize) -> Option<Triangle> {
    let next = match (t, corner) {
        (0, 0) => [p, q, 1],
        (0, 1) => [p - 1, q, 1],
        (0, _) => [p, q - 1, 1],
        (_, 0) => [p, q, 0],
        (_, 1) => [p + 1, q, 0],
        _ => [p, q + 1, 0],
    };
    is_in_sector(next).then_some(next)
}

fn is_in_sector([p, q, _]: Triangle) -> bool {
    p >= 0 && q >= 0
}

/// The triangles of the sector that have a corner in common with one of them, itself first.
pub fn around(triangle: Triangle) -> Vec<Triangle> {
    let mut list = vec![triangle];
    for [p, q] in corners(triangle) {
        let up = [[p, q, 0], [p - 1, q, 0], [p, q - 1, 0]];
        let down = [[p - 1, q - 1, 1], [p, q - 1, 1], [p - 1, q, 1]];
        for next in up.into_iter().chain(down).filter(|next| is_in_sector(*next)) {
            if !list.contains(&next) {
                list.push(next);
            }
        }
    }
    list
}

/// The triangles whose corners have a radius from `least` to `most`.
pub fn ring(least: i64, most: i64) -> Vec<Triangle> {
    let mut list = Vec::new();
    for p in 0..most {
        for q in 0..most - p {
            list.extend([[p, q, 0], [p, q, 1]].into_iter().filter(|t| {
                let radii = corners(*t).map(|[p, q]| p + q);
                radii.iter().all(|r| (least..=most).contains(r))
            }));
        }
    }
    list
}

/// Ring 0 of level t >= 1.
pub fn ring_zero(level: usize) -> Vec<Triangle> {
    ring(1 << (level - 1), 1 << level)
}

impl Lattice {
    /// Points of which nothing is known, up to a radius.
    fn unknown(radius: i64) -> Self {
        let width = (radius + 2) as usize;
        Self { radius, points: vec![Complex::WHOLE; width * width] }
    }

    /// The index of a point; none beyond the radius, which in the halo is that in the sector beside.
    fn index(&self, [p, q]: Place) -> Option<usize> {
        let radius = match (p, q) {
            (-1, q) => (q >= 1).then_some(q),
            (p, -1) => (p >= 1).then_some(p),
            (p, q) => (p >= 0 && q >= 0).then_some(p + q),
        };
        let width = self.radius + 2;
        radius.is_some_and(|r| r <= self.radius).then(|| ((p + 1) * width + q + 1) as usize)
    }

    /// The point, of which nothing is known beyond the radius.
    pub fn at(&self, place: Place) -> Complex {
        self.index(place).map_or(Complex::WHOLE, |index| self.points[index])
    }

    fn put(&mut self, place: Place, point: Complex) {
        if let Some(index) = self.index(place) {
            self.points[index] = point;
        }
    }

    /// The places up to the radius, the halo among them.
    fn places(&self) -> impl Iterator<Item = Place> + use<> {
        let radius = self.radius;
        let inside = (0..=radius).flat_map(move |p| (0..=radius - p).map(move |q| [p, q]));
        inside.chain((1..=radius).flat_map(|r| [[r, -1], [-1, r]]))
    }

    /// The three-ring of a mode in a sector: the two-ring, and what is an eigenvector with it.
    pub fn first(mode: &Mode, sector: usize) -> Self {
        let n = mode.a.len();
        let beside = [sector + n - 1, sector, sector + 1].map(|j| Self::three(mode, j % n));
        let [before, mut three, behind] = beside;
        three.put([3, -1], before.at([1, 2]));
        three.put([-1, 3], behind.at([2, 1]));
        three
    }

    /// The same without the halo's points of radius 3.
    fn three(mode: &Mode, sector: usize) -> Self {
        let n = mode.a.len();
        let (before, behind, two) = ((sector + n - 1) % n, (sector + 1) % n, (sector + 2) % n);
        let mut lattice = Self::unknown(3);
        for (place, point) in [
            ([0, 0], mode.centre),
            ([1, 0], mode.a[sector]),
            ([0, 1], mode.a[behind]),
            ([2, 0], mode.b[sector]),
            ([1, 1], mode.d[sector]),
            ([0, 2], mode.b[behind]),
            ([1, -1], mode.a[before]),
            ([2, -1], mode.d[before]),
            ([-1, 1], mode.a[two]),
            ([-1, 2], mode.d[behind]),
        ] {
            lattice.put(place, point);
        }
        let chain = mode.chain.as_ref();
        let chain = chain.map(|(kappa, mode)| (*kappa, Self::three(mode, sector)));
        let share = Fixed::ONE.over(mode.lambda);
        for place in [[3, 0], [2, 1], [1, 2], [0, 3]] {
            let next = lattice.refined(place);
            let rest = chain.as_ref().map_or(next, |(kappa, f)| next - f.at(place) * *kappa);
            lattice.put(place, rest * share);
        }
        lattice
    }

    /// The point of the next level, by the rules for regular vertices.
    fn refined(&self, [p, q]: Place) -> Complex {
        let [i, j] = [p.div_euclid(2), q.div_euclid(2)];
        let at = |[di, dj]: [i64; 2]| self.at([i + di, j + dj]);
        let edge = |ends: [Place; 2], sides: [Place; 2]| {
            let terms = ends.into_iter().map(|e| (3, at(e))).chain(sides.map(|s| (1, at(s))));
            Complex::mean(terms, 8)
        };
        match [p.rem_euclid(2), q.rem_euclid(2)] {
            [0, 0] => self.around([i, j], 10, 16),
            [1, 0] => edge([[0, 0], [1, 0]], [[0, 1], [1, -1]]),
            [0, _] => edge([[0, 0], [0, 1]], [[1, 0], [-1, 1]]),
            _ => edge([[1, 0], [0, 1]], [[0, 0], [1, 1]]),
        }
    }

    /// `(c P + Σ of the six neighbours) / d`.
    fn around(&self, [p, q]: Place, c: i64, d: i64) -> Complex {
        let six = [[1, 0], [0, 1], [-1, 1], [-1, 0], [0, -1], [1, -1]];
        let six = six.into_iter().map(|[i, j]| (1, self.at([p + i, q + j])));
        Complex::mean(six.chain([(c, self.at([p, q]))]), d)
    }

    /// The next level, up to a radius of at most 2R - 1.
    pub fn next(&self, lambda: Fixed, radius: i64) -> Self {
        let mut next = Self::unknown(radius.min(2 * self.radius - 1));
        for place in next.places() {
            // The vertex rule of the centre, and the edge rule of its edges, are those of the eigenvector.
            let point = match place {
                [0, 0] | [1, 0] | [0, 1] | [1, -1] | [-1, 1] => self.at(place) * lambda,
                _ => self.refined(place),
            };
            next.put(place, point);
        }
        next
    }

    /// The limits of the points, up to a radius less by 1 and without the halo.
    pub fn limits(&self) -> Self {
        let mut limits = Self::unknown(self.radius - 1);
        for [p, q] in limits.places().filter(|[p, q]| *p >= 0 && *q >= 0) {
            let limit = if p + q == 0 { Complex::ZERO } else { self.around([p, q], 6, 12) };
            limits.put([p, q], limit);
        }
        limits
    }

    /// The surface over a triangle that does not touch the centre.
    pub fn patch(&self, triangle: Triangle) -> Quartic {
        let [x, a, b] = corners(triangle);
        let step = |corner: Place| [corner[0] - x[0], corner[1] - x[1]];
        let (e, f) = (step(a), step(b));
        let p = |i: i64, j: i64| self.at([0, 1].map(|k| x[k] + i * e[k] + j * f[k]));
        let points = [
            p(0, -1),
            p(-1, 0),
            p(1, -1),
            p(0, 0),
            p(-1, 1),
            p(2, -1),
            p(1, 0),
            p(0, 1),
            p(-1, 2),
            p(2, 0),
            p(1, 1),
            p(0, 2),
        ];
        T.map(|row| {
            let terms = row.into_iter().zip(points).filter(|(c, _)| *c != 0);
            Complex::mean(terms, 24)
        })
    }
}

#[cfg(test)]
mod tests;
