//! Lengths, foot points and directions. Foot points and directions are choices, made in rounded arithmetic; what is
//! shown about them is shown in intervals.

use num_rational::BigRational;

use super::polygon_mesh::Vector;
use crate::fixed::Fixed;

/// The most steps of the search for the nearest point of a hull.
const STEPS: usize = 30;

pub fn plus(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i])
}

pub fn minus(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// `p / q` times the vector, `q > 0`.
pub fn times(a: &Vector, p: i64, q: i64) -> Vector {
    a.map(|x| x.times(p, q))
}

pub fn scaled(a: &Vector, factor: Fixed) -> Vector {
    a.map(|x| x * factor)
}

pub fn sum<'a>(all: impl IntoIterator<Item = &'a Vector>) -> Vector {
    all.into_iter().fold([Fixed::ZERO; 3], |sum, x| plus(&sum, x))
}

/// The middle of two points.
pub fn middle(a: &Vector, b: &Vector) -> Vector {
    times(&plus(a, b), 1, 2)
}

pub fn dot(a: &Vector, b: &Vector) -> Fixed {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn square(a: &Vector) -> Fixed {
    a[0].square() + a[1].square() + a[2].square()
}

/// The largest s, 62 at most, such that `2^s` times the vectors have coordinates below 1 in magnitude.
fn room<'a>(all: impl IntoIterator<Item = &'a Vector>) -> u32 {
    all.into_iter().flatten().map(|x| x.room()).min().unwrap_or(0)
}

fn raised(a: &Vector, room: u32) -> Vector {
    times(a, 1 << room, 1)
}

/// A bound of lengths. Lengths are compared after multiplication by a power of two that makes the bound about 1,
/// or small squares would be lost on the grid.
pub struct Bound {
    room: u32,
    square: Fixed,
}

impl Bound {
    pub fn new(bound: Fixed) -> Self {
        let room = bound.room();
        Self { room, square: bound.times(1 << room, 1).square() }
    }

    /// Shows that the points are at most the bound away from each other.
    pub fn holds(&self, a: &Vector, b: &Vector) -> bool {
        square(&raised(&minus(a, b), self.room)).at_most(self.square)
    }
}

/// A point of the triangle, as near to the point as can be found out.
pub fn foot(point: &Vector, corners: &[Vector; 3]) -> Vector {
    let [v, w] = parameters(point, corners);
    let [v_side, w_side] = [1, 2].map(|i| minus(&corners[i], &corners[0]));
    plus(&corners[0], &plus(&scaled(&v_side, v), &scaled(&w_side, w)))
}

/// The parameters of that point: numbers on the grid, `v, w >= 0`, `v + w <= 1`.
fn parameters(point: &Vector, corners: &[Vector; 3]) -> [Fixed; 2] {
    let sides = [1, 2].map(|i| minus(&corners[i], &corners[0]));
    let room = room(&sides);
    let [a, b] = sides.map(|side| raised(&side, room).map(Fixed::middle));
    let d = raised(&minus(point, &corners[0]), room).map(Fixed::middle);
    let (aa, ab, bb, da, db) = (dot(&a, &a), dot(&a, &b), dot(&b, &b), dot(&d, &a), dot(&d, &b));
    let area = aa * bb - ab * ab;
    if area.is_positive() {
        let [v, w] =
            [da * bb - db * ab, db * aa - da * ab].map(|x| x.middle().over(area.middle()).middle());
        let rest = Fixed::ONE - v - w;
        if [v, w, rest].iter().all(|x| x.is_positive()) && (v + w).at_most(Fixed::ONE) {
            return [v, w];
        }
    }
    // On an edge, from corner 0 to 1, from 0 to 2, from 1 to 2.
    let c = minus(&b, &a).map(Fixed::middle);
    let on =
        |way: &Vector, from: &Vector| dot(from, way).middle().over(square(way).middle()).fraction();
    let (on_a, on_b, on_c) = (on(&a, &d), on(&b, &d), on(&c, &minus(&d, &a)));
    let (zero, one) = (Fixed::ZERO, Fixed::ONE);
    let candidates = [[on_a, zero], [zero, on_b], [one - on_c, on_c]];
    let length = |[v, w]: &[Fixed; 2]| {
        square(&minus(&d, &plus(&scaled(&a, *v), &scaled(&b, *w))).map(Fixed::middle)).middle()
    };
    let mut best = candidates[0];
    for candidate in &candidates[1..] {
        if length(candidate).below(length(&best)) {
            best = *candidate;
        }
    }
    best
}

/// The enclosure of the point of the segment with a parameter between 0 and 1.
pub fn between(a: &Vector, b: &Vector, t: &BigRational) -> Vector {
    plus(a, &scaled(&minus(b, a), Fixed::of(t)))
}

/// Shows that a point is at least `lo >= 0` away from the hull of others: `D·(P - x) >= lo |D|` for a direction D.
pub fn is_far(point: &Vector, others: &[Vector], lo: Fixed) -> bool {
    let ways: Vec<Vector> = others.iter().map(|other| minus(point, other)).collect();
    let shown = |direction: &Vector| {
        let direction = raised(direction, room([direction])).map(Fixed::middle);
        let length = square(&direction);
        let least = lo * length.root();
        length.is_positive() && ways.iter().all(|way| least.at_most(dot(&direction, way)))
    };
    // The direction from the mean is good enough, as a rule.
    shown(&times(&sum(&ways), 1, ways.len().max(1) as i64)) || shown(&shortest(&ways))
}

/// Near to the shortest vector of the hull: a simplex of three is improved by one vector after the other.
fn shortest(ways: &[Vector]) -> Vector {
    let ways: Vec<Vector> = ways.iter().map(|way| way.map(Fixed::middle)).collect();
    let origin = [Fixed::ZERO; 3];
    let Some(first) = ways.first() else { return origin };
    let (mut simplex, mut best) = ([*first; 3], *first);
    for _ in 0..STEPS {
        let direction = raised(&best, room([&best]));
        let along = |way: &Vector| dot(&direction, way).middle();
        let mut next = &ways[0];
        for way in &ways {
            if along(way).below(along(next)) {
                next = way;
            }
        }
        if !along(next).below(along(&best)) {
            break;
        }
        let mut improved = None;
        for out in 0..3 {
            let mut trial = simplex;
            trial[out] = *next;
            let candidate = foot(&origin, &trial).map(Fixed::middle);
            let raised = |way: &Vector| square(&raised(way, room([&best]))).middle();
            let (_, least) = improved.unwrap_or((simplex, best));
            if raised(&candidate).below(raised(&least)) {
                improved = Some((trial, candidate));
            }
        }
        let Some(better) = improved else { break };
        (simplex, best) = better;
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vector(x: [i64; 3], q: i64) -> Vector {
        x.map(|x| Fixed::ratio(x, q))
    }

    fn triangle(corners: [[i64; 3]; 3], q: i64) -> [Vector; 3] {
        corners.map(|corner| vector(corner, q))
    }

    /// Points whose distance from the triangle (0,0,0), (4,0,0), (0,3,0) is known: above the inside, beyond an edge,
    /// beyond the long edge (the foot (4, 0) + 1/2 (-4, 3), the way (3, 4)), beyond a corner.
    const KNOWN: [([i64; 3], i64); 5] =
        [([1, 1, 5], 5), ([2, -12, 5], 13), ([8, 12, 0], 0), ([-3, -4, 12], 13), ([7, -4, 0], 5)];

    #[test]
    fn feet_and_directions_meet_known_distances() {
        // At two sizes, one of them small: nothing is lost on the grid.
        for q in [16, 1 << 40] {
            let corners = triangle([[0, 0, 0], [4, 0, 0], [0, 3, 0]], q);
            for (point, distance) in KNOWN {
                // (2 + 6, 3/2 + 8) would not be an integer: the third is on a line through the edge's middle, twice.
                let (point, distance, corners) = if distance == 0 {
                    ([16, 19, 0], 20, corners.map(|corner| times(&corner, 2, 1)))
                } else {
                    (point, distance, corners)
                };
                let point = vector(point, q);
                let at = |p: i64| Fixed::ratio(distance * 1000 + p, q * 1000);
                let q = foot(&point, &corners);
                assert!(Bound::new(at(1)).holds(&point, &q), "{distance}");
                assert!(!Bound::new(at(-1)).holds(&point, &q), "{distance}");
                assert!(is_far(&point, &corners, at(-1)), "{distance}");
                assert!(!is_far(&point, &corners, at(1)), "{distance}");
            }
        }
    }

    #[test]
    fn hulls_of_many_points() {
        // The cube of side 2 about (0, 0, 0), from points off its corners, its edges and its sides.
        let corner = |i: i64| vector([i & 1, i >> 1 & 1, i >> 2 & 1].map(|x| 2 * x - 1), 64);
        let cube: Vec<_> = (0..8).map(corner).collect();
        for (point, distance) in [([0, 0, 5], 4), ([4, 5, 0], 5), ([3, 3, 2], 3), ([-9, 0, 0], 8)] {
            let at = |p: i64| Fixed::ratio(distance * 1000 + p, 64_000);
            assert!(is_far(&vector(point, 64), &cube, at(-1)), "{point:?}");
            assert!(!is_far(&vector(point, 64), &cube, at(1)), "{point:?}");
        }
        // Inside nothing is far, and no direction is none.
        assert!(!is_far(&vector([0, 0, 0], 1), &cube, Fixed::ratio(1, 1 << 20)));
        assert!(!is_far(&cube[0], &cube[..1], Fixed::ratio(1, 1 << 20)));
    }

    #[test]
    fn degenerate_triangles() {
        let (a, b) = (vector([0, 0, 0], 4), vector([1, 0, 0], 4));
        for corners in [[a, b, b], [b, a, b], [a, a, b]] {
            let found = foot(&vector([1, 3, 0], 8), &corners);
            assert!(Bound::new(Fixed::ratio(376, 1000)).holds(&vector([1, 3, 0], 8), &found));
        }
        assert!(Bound::new(Fixed::ZERO).holds(&a, &foot(&b, &[a; 3])));
    }
}
