//! Uniform quadratic (Chaikin) and cubic B-spline curves: masks, refinement, limits, segments.
//!
//! A closed polygon of m points gives m segments. An open one has no end rule: it gives the m - d
//! segments that its points determine (d the degree), and each refinement keeps exactly those.
//!
//! | degree | new points | limit at P | segment i, closed: indices mod m |
//! |---|---|---|---|
//! | quadratic | (3 P_i + P_(i+1))/4, (P_i + 3 P_(i+1))/4 | (P_- + 6 P + P_+)/8, middle of a segment | P_i, P_(i+1), P_(i+2) |
//! | cubic | (P_- + 6 P + P_+)/8, (P_i + P_(i+1))/2 | (P_- + 4 P + P_+)/6, end of a segment | P_i, ..., P_(i+3) |
//!
//! Source: Chaikin 1974; Lane and Riesenfeld 1980; LN section 3 and (9).

use super::boundary;
use crate::bernstein::conversion::{cubic_bezier_from_net, quadratic_bezier_from_net};
use crate::scalar::{Field, Module};

/// The degree of a uniform B-spline curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Degree {
    /// Chaikin's corner cutting.
    Quadratic,
    /// The curve rule that Loop and Catmull-Clark use along boundaries.
    Cubic,
}

impl Degree {
    /// The polynomial degree d; a segment has d + 1 control points.
    pub const fn get(self) -> usize {
        match self {
            Degree::Quadratic => 2,
            Degree::Cubic => 3,
        }
    }
}

/// Whether the last point of a control polygon is joined to the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ends {
    /// Indices are cyclic.
    Closed,
    /// No end rule: only what the points determine.
    Open,
}

/// The limit position of a control point from its two neighbours.
///
/// Quadratic: `1/8, 6/8, 1/8`, at the middle of a segment. Cubic: `1/6, 4/6, 1/6`, at an end.
#[inline]
pub fn limit_point<S: Field, V: Module<S>>(degree: Degree, p: &V, before: &V, after: &V) -> V {
    match degree {
        // The cubic vertex mask and the quadratic limit mask are the same numbers.
        Degree::Quadratic => boundary::vertex_point::<S, V>(p, before, after),
        Degree::Cubic => boundary::limit_point::<S, V>(p, before, after),
    }
}

/// The number of segments of a control polygon: m if closed, m - d (or none) if open.
///
/// A closed polygon of fewer than three points has none.
pub fn segment_count(degree: Degree, ends: Ends, points: usize) -> usize {
    match ends {
        Ends::Closed if points < 3 => 0,
        Ends::Closed => points,
        Ends::Open => points.saturating_sub(degree.get()),
    }
}

/// One step of refinement; empty if and only if the polygon has no segment.
///
/// Segment i becomes the segments 2i and 2i + 1. Sizes: closed m -> 2m; open m -> 2m - 2
/// (quadratic), 2m - 3 (cubic).
///
/// ```
/// use subcert::scalar::{Field, Rational};
/// use subcert::scheme::curve::{Degree, Ends, refine};
/// let polygon: Vec<Rational> = [0, 4, 0].map(|x| Rational::ratio(x, 1)).to_vec();
/// let refined = refine::<Rational, _>(Degree::Quadratic, Ends::Open, &polygon);
/// assert_eq!(refined, [1, 3, 3, 1].map(|x| Rational::ratio(x, 1)));
/// ```
pub fn refine<S: Field, V: Module<S>>(degree: Degree, ends: Ends, points: &[V]) -> Vec<V> {
    let m = points.len();
    let segments = segment_count(degree, ends, m);
    if segments == 0 {
        return Vec::new();
    }
    let p = |i: usize| &points[i % m];
    let mut refined = Vec::with_capacity(2 * m);
    match (degree, ends) {
        (Degree::Quadratic, _) => {
            let (near, far) = (S::ratio(3, 4), S::ratio(1, 4));
            let edges = if ends == Ends::Closed { m } else { m - 1 };
            for i in 0..edges {
                refined.push(p(i).clone() * &near + &(p(i + 1).clone() * &far));
                refined.push(p(i).clone() * &far + &(p(i + 1).clone() * &near));
            }
        }
        // Both start with the edge point of (P0, P1), so that the first segment of the result is
        // the first half of the first segment of the polygon.
        (Degree::Cubic, Ends::Closed) => {
            for i in 0..m {
                refined.push(boundary::edge_point::<S, V>(p(i), p(i + 1)));
                refined.push(boundary::vertex_point::<S, V>(p(i + 1), p(i), p(i + 2)));
            }
        }
        (Degree::Cubic, Ends::Open) => {
            refined.push(boundary::edge_point::<S, V>(p(0), p(1)));
            for i in 1..m - 1 {
                refined.push(boundary::vertex_point::<S, V>(p(i), p(i - 1), p(i + 1)));
                refined.push(boundary::edge_point::<S, V>(p(i), p(i + 1)));
            }
        }
    }
    refined
}

/// The limit positions of the control points that have two neighbours.
///
/// Closed: of all points in order; open: of the points 1..m-1 (exclusive).
pub fn limit_points<S: Field, V: Module<S>>(degree: Degree, ends: Ends, points: &[V]) -> Vec<V> {
    let m = points.len();
    let limit = |i: usize| {
        let (before, after) = (&points[(i + m - 1) % m], &points[(i + 1) % m]);
        limit_point::<S, V>(degree, &points[i], before, after)
    };
    match ends {
        _ if m < 3 => Vec::new(),
        Ends::Closed => (0..m).map(limit).collect(),
        Ends::Open => (1..m - 1).map(limit).collect(),
    }
}

/// The d + 1 Bézier points of a segment.
///
/// # Panics
/// If `segment` is not below [`segment_count`].
pub fn bezier_segment<S: Field, V: Module<S>>(
    degree: Degree,
    ends: Ends,
    points: &[V],
    segment: usize,
) -> Vec<V> {
    assert!(segment < segment_count(degree, ends, points.len()));
    let p = |k: usize| points[(segment + k) % points.len()].clone();
    match degree {
        Degree::Quadratic => quadratic_bezier_from_net::<S, V>(&std::array::from_fn(p)).to_vec(),
        Degree::Cubic => cubic_bezier_from_net::<S, V>(&std::array::from_fn(p)).to_vec(),
    }
}
