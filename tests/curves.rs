//! Uniform B-spline curves: refinement against Bézier subdivision, and LN Theorems 1 and 4.

use num_traits::{One, Signed, Zero};
use subcert::scalar::{Field, Rational};
use subcert::scheme::curve::{Degree, Ends, bezier_segment, limit_points, refine, segment_count};

type R = Rational;

const CASES: [(Degree, Ends); 4] = [
    (Degree::Quadratic, Ends::Closed),
    (Degree::Quadratic, Ends::Open),
    (Degree::Cubic, Ends::Closed),
    (Degree::Cubic, Ends::Open),
];

const POLYGON: [i64; 9] = [3, -7, 12, 5, 0, -4, 9, 8, -1];

fn r(p: i64, q: i64) -> R {
    R::ratio(p, q)
}

fn polygon(points: &[i64]) -> Vec<R> {
    points.iter().map(|&x| r(x, 1)).collect()
}

/// The two halves of a Bézier curve, by de Casteljau.
fn halves(bezier: &[R]) -> (Vec<R>, Vec<R>) {
    let (mut left, mut right) = (Vec::new(), Vec::new());
    let mut row = bezier.to_vec();
    while !row.is_empty() {
        left.push(row[0].clone());
        right.push(row[row.len() - 1].clone());
        row = row
            .windows(2)
            .map(|pair| (&pair[0] + &pair[1]) / r(2, 1))
            .collect();
    }
    right.reverse();
    (left, right)
}

/// The largest |2 P_k - P_(k-1) - P_(k+1)|.
fn second_norm(ends: Ends, points: &[R]) -> R {
    let m = points.len();
    let range = if ends == Ends::Closed { 0..m } else { 1..m - 1 };
    let difference =
        |k: usize| (r(2, 1) * &points[k] - &points[(k + m - 1) % m] - &points[(k + 1) % m]).abs();
    range.map(difference).max().unwrap()
}

/// The segments of the refined polygon are the halves of the old ones: refinement and conversion
/// describe one curve, whose segments join end to end.
#[test]
fn refinement_halves_the_segments() {
    for (degree, ends) in CASES {
        for size in degree.get() + 1..=POLYGON.len() {
            let points = polygon(&POLYGON[..size]);
            let refined = refine::<R, R>(degree, ends, &points);
            let segments = segment_count(degree, ends, size);
            assert_eq!(segment_count(degree, ends, refined.len()), 2 * segments);
            for i in 0..segments {
                let bezier = bezier_segment::<R, R>(degree, ends, &points, i);
                let (left, right) = halves(&bezier);
                assert_eq!(bezier_segment::<R, R>(degree, ends, &refined, 2 * i), left);
                assert_eq!(
                    bezier_segment::<R, R>(degree, ends, &refined, 2 * i + 1),
                    right
                );
                if i + 1 < segments || ends == Ends::Closed {
                    let next = bezier_segment::<R, R>(degree, ends, &points, (i + 1) % segments);
                    assert_eq!(bezier.last(), next.first());
                }
            }
        }
    }
}

#[test]
fn limit_points_lie_on_the_curve() {
    for (degree, ends) in CASES {
        let points = polygon(&POLYGON);
        let limits = limit_points::<R, R>(degree, ends, &points);
        let first = if ends == Ends::Closed { 0 } else { 1 };
        for i in 0..segment_count(degree, ends, points.len()) {
            let bezier = bezier_segment::<R, R>(degree, ends, &points, i);
            // Segment i starts (cubic), or has its middle (quadratic), at the point i + 1.
            let expected = match degree {
                Degree::Quadratic => halves(&bezier).1[0].clone(),
                Degree::Cubic => bezier[0].clone(),
            };
            assert_eq!(limits[(i + 1 - first) % limits.len()], expected);
        }
    }
}

/// Bézier coefficients of C - L over a segment (cubic) or over its halves (quadratic: L bends at
/// the control point, over the middle of the segment).
fn differences(degree: Degree, ends: Ends, points: &[R], i: usize) -> Vec<R> {
    let bezier = bezier_segment::<R, R>(degree, ends, points, i);
    let p = |k: usize| &points[(i + k) % points.len()];
    let minus_line = |curve: &[R], from: &R, to: &R| -> Vec<R> {
        let d = curve.len() - 1;
        let line = |k: usize| from + (to - from) * r(k as i64, d as i64);
        curve.iter().enumerate().map(|(k, c)| c - line(k)).collect()
    };
    match degree {
        Degree::Cubic => minus_line(&bezier, p(1), p(2)),
        Degree::Quadratic => {
            let (left, right) = halves(&bezier);
            let (start, end) = ((p(0) + p(1)) / r(2, 1), (p(1) + p(2)) / r(2, 1));
            [
                minus_line(&left, &start, p(1)),
                minus_line(&right, p(1), &end),
            ]
            .concat()
        }
    }
}

/// LN Theorem 1 (cubic, 1/6) and Theorem 4 (quadratic, 1/8): the distance to the polygon is at most
/// M/6 (M/8), M shrinks at least by 4 in each step.
///
/// The difference has the Bézier coefficients (-D1/6, 0, 0, -D2/6), respectively 0, 0, -D/8 and
/// its mirror image, D the second differences `2 P_k - P_(k-1) - P_(k+1)`: so the bound is the hull
/// property, and it is attained, at the ends (in the middle) of the segment with the largest D.
#[test]
fn ln_theorems_1_and_4() {
    for (degree, ends) in CASES {
        let ratio = match degree {
            Degree::Quadratic => r(1, 8),
            Degree::Cubic => r(1, 6),
        };
        let start = polygon(&POLYGON);
        let first_norm = second_norm(ends, &start);
        let mut points = start;
        let mut scale = R::one();
        for _ in 0..4 {
            let norm = second_norm(ends, &points);
            assert!(norm <= &scale * &first_norm);
            let mut largest = R::zero();
            for i in 0..segment_count(degree, ends, points.len()) {
                let difference = differences(degree, ends, &points, i);
                let d = |k: usize| {
                    let m = points.len();
                    let p = |k: usize| &points[(i + k) % m];
                    &ratio * (p(k - 1) + p(k + 1) - r(2, 1) * p(k))
                };
                let zero = R::zero();
                let expected = match degree {
                    Degree::Cubic => vec![d(1), zero.clone(), zero, d(2)],
                    Degree::Quadratic => {
                        vec![zero.clone(), zero.clone(), d(1), d(1), zero.clone(), zero]
                    }
                };
                assert_eq!(difference, expected);
                largest = difference.iter().map(R::abs).max().unwrap().max(largest);
            }
            assert_eq!(largest, &ratio * &norm, "attained");
            points = refine::<R, R>(degree, ends, &points);
            scale /= r(4, 1);
        }
    }
}

/// On a parabola all second differences are equal, and both factors of 1/4 are attained.
#[test]
fn the_rate_of_one_quarter_is_attained() {
    let parabola = polygon(&[0, 1, 4, 9, 16, 25, 36]);
    for degree in [Degree::Quadratic, Degree::Cubic] {
        let mut points = parabola.clone();
        let mut norm = r(2, 1);
        for _ in 0..4 {
            assert_eq!(second_norm(Ends::Open, &points), norm);
            points = refine::<R, R>(degree, Ends::Open, &points);
            norm /= r(4, 1);
        }
    }
}

#[test]
fn short_polygons_have_no_segments() {
    for (degree, ends) in CASES {
        for size in 0..3 {
            let points = polygon(&POLYGON[..size]);
            assert_eq!(segment_count(degree, ends, size), 0);
            assert!(refine::<R, R>(degree, ends, &points).is_empty());
            assert!(limit_points::<R, R>(degree, ends, &points).is_empty());
        }
    }
}
