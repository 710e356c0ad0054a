//! Distances of points to facets, in intervals: upper bounds by a foot point, lower bounds by a
//! separating plane.
//!
//! Both take a choice from `f64` that need not be good to be safe: any convex combination of the
//! corners is a point of a triangle, and for any direction D, `min D·(P - x) / |D|` over the corners x
//! of a convex hull is at most its distance from P.

use super::part::quarters;
use crate::mesh::Point;
use crate::scalar::Interval;

type P = Point<Interval>;

/// How often a facet is quartered for a lower bound.
const FACET_SPLITS: u32 = 9;

/// The middles of the coordinates.
pub(super) fn middles(p: &P) -> [f64; 3] {
    p.0.map(Interval::mid)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Weights `(s, t)` of corners 1 and 2 in the point of a triangle nearest to p, nearly; s, t >= 0 and
/// s + t <= 1 but for one rounding.
///
/// The nearest point of each edge, and the foot on the plane if it is inside; the nearest of these.
fn foot(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> [f64; 2] {
    let (e, f, d) = (minus(b, a), minus(c, a), minus(p, a));
    let along = |o: [f64; 3], e: [f64; 3]| {
        let length = dot(e, e);
        let t = dot(minus(p, o), e) / length;
        if t > 0.0 { t.min(1.0) } else { 0.0 }
    };
    let (r, s, t) = (along(a, e), along(a, f), along(b, minus(c, b)));
    let (ee, ef, ff) = (dot(e, e), dot(e, f), dot(f, f));
    let (de, df) = (dot(d, e), dot(d, f));
    let det = ee * ff - ef * ef;
    let inner = [(de * ff - df * ef) / det, (df * ee - de * ef) / det];
    let inside = inner[0] >= 0.0 && inner[1] >= 0.0 && inner[0] + inner[1] <= 1.0;
    let last = if inside { inner } else { [r, 0.0] };
    let distance = |[s, t]: &[f64; 2]| {
        let q = [0, 1, 2].map(|i| d[i] - s * e[i] - t * f[i]);
        dot(q, q)
    };
    let nearer = |x: [f64; 2], y: [f64; 2]| if distance(&y) < distance(&x) { y } else { x };
    [[0.0, s], [1.0 - t, t], last]
        .into_iter()
        .fold([r, 0.0], nearer)
}

/// The point of a triangle nearest to p, in floats: no bound.
pub fn estimate_foot(p: [f64; 3], triangle: [[f64; 3]; 3]) -> [f64; 3] {
    let [s, t] = foot(p, triangle);
    let [a, b, c] = triangle;
    [0, 1, 2].map(|i| a[i] + s * (b[i] - a[i]) + t * (c[i] - a[i]))
}

/// The distance from p to a triangle, in floats: no bound.
pub fn estimate_distance(p: [f64; 3], triangle: [[f64; 3]; 3]) -> f64 {
    let away = minus(p, estimate_foot(p, triangle));
    dot(away, away).sqrt()
}

/// A lower bound of the distance from every point of the box p to every triangle with corners in these
/// boxes; 0 if a plane does not separate them.
pub fn lower_bound_of_distance(p: &P, triangle: &[P; 3]) -> f64 {
    hull_below(p, middles(&foot_point(p, triangle)), triangle)
}

/// A point of the triangle, nearly the nearest to p.
pub(super) fn foot_point(p: &P, [a, b, c]: &[P; 3]) -> P {
    let [s, t] = foot(middles(p), [a, b, c].map(middles));
    // In the triangle: s, t >= 0 and s + t <= 1. Where that is above, it is by one rounding, 2^-53, and
    // the products round by as much again: less than the 1e-15 that is taken off.
    let sum = Interval::point(s) + Interval::point(t);
    let (s, t) = if sum.sup() <= 1.0 {
        (s, t)
    } else {
        (s * (1.0 - 1e-15), t * (1.0 - 1e-15))
    };
    let [s, t] = [s, t].map(Interval::point);
    *a + (*b - a) * &s + (*c - a) * &t
}

/// An upper bound of the distance from every point of the box p to every triangle with corners in these
/// boxes.
pub fn upper_bound_of_distance(p: &P, triangle: &[P; 3]) -> f64 {
    to_triangle(&[*p], triangle)
}

/// The squared distance; its upper end bounds the squared distance of P to anything that contains Q.
pub(super) fn square(p: &P, q: &P) -> Interval {
    let [x, y, z] = (*p - q).0;
    x.sqr() + y.sqr() + z.sqr()
}

/// Not below the largest distance of the points to the triangle.
pub(super) fn to_triangle(points: &[P], triangle: &[P; 3]) -> f64 {
    let upper = |p: &P| square(p, &foot_point(p, triangle)).sup();
    root_above(points.iter().map(upper).fold(0.0, f64::max))
}

/// Not below the largest distance of the points to one point.
pub(super) fn to_point(points: &[P], q: &P) -> f64 {
    root_above(
        points
            .iter()
            .map(|p| square(p, q).sup())
            .fold(0.0, f64::max),
    )
}

/// Not below the root.
pub(super) fn root_above(square: f64) -> f64 {
    crate::scalar::float::upper_sqrt(square)
}

/// Not above the distance of P to the convex hull of the points, for the direction from Q to P.
pub(super) fn hull_below(p: &P, q: [f64; 3], hull: &[P]) -> f64 {
    let d = minus(middles(p), q);
    let size = d.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    if size == 0.0 || !size.is_finite() {
        return 0.0;
    }
    let d = Point(d.map(|x| Interval::point(x / size)));
    let least = hull
        .iter()
        .map(|x| d.dot(&(*p - x)).inf())
        .fold(f64::INFINITY, f64::min);
    let length = d.0[0].sqr() + d.0[1].sqr() + d.0[2].sqr();
    match length.sqrt() {
        Some(length) if least > 0.0 => (Interval::point(least) / length).inf().max(0.0),
        _ => 0.0,
    }
}

/// Whether the facet with these corners, a triangle or a bilinear quad, is shown to be at least as far
/// from P.
pub(super) fn is_far(p: &P, corners: &[P], length: f64) -> bool {
    parts_are_far(p, corners, length, FACET_SPLITS)
}

fn parts_are_far(p: &P, corners: &[P], length: f64, splits: u32) -> bool {
    let nearest = triangles(corners)
        .map(|t| foot_point(p, &t))
        .min_by(|x, y| square(p, x).mid().total_cmp(&square(p, y).mid()));
    if nearest.is_some_and(|q| hull_below(p, middles(&q), corners) >= length) {
        return true;
    }
    splits > 0
        && corners.len() > 3
        && quarters(corners)
            .iter()
            .all(|part| parts_are_far(p, part, length, splits - 1))
}

/// The triangles from the first corner.
pub(super) fn triangles(corners: &[P]) -> impl Iterator<Item = [P; 3]> + '_ {
    (2..corners.len()).map(|i| [corners[0], corners[i - 1], corners[i]])
}

/// Nearly the distance of P to a facet.
pub(super) fn estimate(p: &P, corners: &[P]) -> f64 {
    let nearest = match corners {
        [a, b, c] => foot_point(p, &[*a, *b, *c]),
        _ => bilinear(corners, bilinear_foot(p, corners)),
    };
    square(p, &nearest).mid().sqrt()
}

/// The point of a bilinear facet.
pub(super) fn bilinear(corners: &[P], [v, w]: [f64; 2]) -> P {
    let [v, w] = [v, w].map(Interval::point);
    let mix = |a: &P, b: &P, t: &Interval| *a * &(Interval::point(1.0) - t) + *b * t;
    mix(
        &mix(&corners[0], &corners[1], &v),
        &mix(&corners[3], &corners[2], &v),
        &w,
    )
}

/// Parameters of the point of a bilinear facet nearest to p, nearly: Newton's method on the grid's best.
pub(super) fn bilinear_foot(p: &P, corners: &[P]) -> [f64; 2] {
    let p = middles(p);
    let c: Vec<[f64; 3]> = corners.iter().map(middles).collect();
    let at = |[v, w]: [f64; 2]| {
        [0, 1, 2].map(|i| {
            (1.0 - w) * ((1.0 - v) * c[0][i] + v * c[1][i])
                + w * ((1.0 - v) * c[3][i] + v * c[2][i])
        })
    };
    let far = |x: [f64; 2]| {
        let d = minus(at(x), p);
        dot(d, d)
    };
    let grid = (0..=4).flat_map(|i| (0..=4).map(move |j| [f64::from(i) / 4.0, f64::from(j) / 4.0]));
    let mut best = grid
        .min_by(|x, y| far(*x).total_cmp(&far(*y)))
        .unwrap_or([0.5; 2]);
    let mut step = 0.125;
    // A compass search: the function is smooth and the dimension two.
    for _ in 0..60 {
        let moves = [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]];
        let tried = moves.map(|m| [0, 1].map(|i| (best[i] + m[i]).clamp(0.0, 1.0)));
        let better = tried.into_iter().min_by(|x, y| far(*x).total_cmp(&far(*y)));
        match better {
            Some(x) if far(x) < far(best) => best = x,
            _ => step /= 2.0,
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Field;

    fn point(p: [i64; 3]) -> P {
        Point(p.map(|x| Interval::ratio(x, 1)))
    }

    #[test]
    fn distances_to_a_triangle() {
        // In the plane z = 0: above the inside, beyond an edge, beyond each corner.
        let t = [[0, 0, 0], [4, 0, 0], [0, 4, 0]].map(point);
        for (p, square) in [
            ([1, 1, 3], 9),
            ([2, -3, 4], 25),
            ([-3, 0, 4], 25),
            ([-3, -4, 0], 25),
            ([0, 7, 4], 25),
            ([4, 4, 0], 8),
            ([5, 0, 0], 1),
        ] {
            let p = point(p);
            let exact = f64::from(square).sqrt();
            let above = to_triangle(&[p], &t);
            assert!(above >= exact && above < exact + 1e-12, "{p:?} {above}");
            assert!(
                is_far(&p, &t, exact - 1e-12) && !is_far(&p, &t, exact + 1e-12),
                "{p:?}"
            );
        }
    }

    #[test]
    fn distance_to_a_saddle() {
        // z = x y over the unit square; from (0, 0, -1) the corner at the origin is nearest.
        let c = [[0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 0]].map(point);
        let p = point([0, 0, -1]);
        let foot = bilinear_foot(&p, &c);
        assert!(foot[0] < 1e-9 && foot[1] < 1e-9);
        assert!(is_far(&p, &c, 0.999) && !is_far(&p, &c, 1.001));
        assert!(to_point(&[p], &bilinear(&c, foot)) >= 1.0);
    }
}
