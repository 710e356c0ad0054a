//! Ends the search on a piece where |d|^2, d = S - F, is certified concave.
//!
//! Near a smooth maximum the convex hull of the coefficients exceeds the maximum by a fixed multiple
//! of the squared size of the piece, and every piece near the maximum must be halved. But if
//! g = |d|^2 is concave on the piece, then for any point x of it and every y in it
//!
//! `g(y) <= g(x) + grad g(x) . (y - x) <= g(x) + max over corners c of grad g(x) . (c - x)`,
//!
//! which is close to the maximum as soon as x is close to the maximiser, inside or on an edge.
//!
//! Concavity: `g_ab / 2 = d_a . d_b + d . d_ab`. Over the piece d, d_a and d_ab lie in the hulls of
//! their Bernstein coefficients, hence each term is at most (at least) the extreme over pairs of
//! coefficients. If the bounds give `g_vv < 0`, `g_ww < 0` and `g_vv g_ww > max |g_vw|^2`, the
//! Hessian is negative definite everywhere.
//!
//! Rounding (float arithmetic only; the polynomial is the one with the stored coefficients, of size
//! D): de Casteljau's algorithm has at most 4 levels of 4 roundings, so d(x) is off by 16 u D per
//! coordinate, the partial derivatives, four times a difference of size 2 D, by 120 u D and are at
//! most 8 D. So g(x) is off by less than 60 u D^2 and each slope times a distance of at most 1 by
//! less than 910 u D^2: with the final sums below 2000 u D^2, covered by `SLACK = 4096 u`. Second derivatives
//! are at most 48 D, the Hessian bounds are below 112 D^2 and off by less than 10^4 u D^2, covered by
//! 64 SLACK.

use crate::bernstein::Patch;
use crate::patch::Space;

/// What closing a piece found.
#[derive(Clone, Debug)]
pub struct Closed<A: Space> {
    /// An upper bound of |S - F|^2 over the piece.
    pub upper: A::Square,
    /// A lower bound, attained at `at`.
    pub lower: A::Square,
    /// Local parameters of the point that attains `lower`.
    pub at: [f64; 2],
    /// S - F there.
    pub value: A::Point,
}

/// Tries to bound |S - F|^2 over a patch by concavity; `None` if it isn't certified.
pub fn close<A, B>(patch: &B) -> Option<Closed<A>>
where
    A: Space,
    B: Patch<A::Scalar, A::Point>,
{
    let scale = patch
        .coefficients()
        .iter()
        .map(|p| A::estimate(&A::upper(p)))
        .fold(0.0, f64::max);
    if scale.is_nan() || scale <= 0.0 || !is_concave::<A, B>(patch, 64.0 * A::SLACK * 1.01 * scale)
    {
        return None;
    }
    let slack = A::dyadic(A::SLACK * 1.01 * scale);
    let mut best: Option<Closed<A>> = None;
    for at in candidates::<A, B>(patch) {
        let x = [A::dyadic(at[0]), A::dyadic(at[1])];
        let (value, [dv, dw]) = patch.evaluate([&x[0], &x[1]]);
        let two = A::dyadic(2.0);
        let slope = [A::dot(&value, &dv) * &two, A::dot(&value, &dw) * &two];
        let g = A::dot(&value, &value) + &slack;
        let mut upper = A::zero();
        for corner in 0..B::CORNERS {
            let c = B::local_corner(corner);
            let step = [A::dyadic(c[0]) - &x[0], A::dyadic(c[1]) - &x[1]];
            let [s0, s1] = &slope;
            let bound = g.clone() + &(s0.clone() * &step[0]) + &(s1.clone() * &step[1]);
            let bound = A::upper_scalar(&bound);
            if bound > upper {
                upper = bound;
            }
        }
        // In float arithmetic |d(x)|^2 is off by 60 u D^2; where it exceeds D^2 / 16 the 4096 u of it
        // that are taken off are more.
        let mut lower = A::relax(&A::lower(&value), -0.5 * A::SLACK);
        if A::estimate(&lower) < scale / 16.0 {
            lower = A::zero();
        }
        if best.as_ref().is_none_or(|b| upper < b.upper) {
            best = Some(Closed {
                upper,
                lower,
                at,
                value,
            });
        }
    }
    best
}

/// Whether the Hessian of |d|^2 / 2 is negative definite on the patch, with `margin` to spare.
fn is_concave<A, B>(patch: &B, margin: f64) -> bool
where
    A: Space,
    B: Patch<A::Scalar, A::Point>,
{
    let first = patch.first_derivatives();
    let second = patch.second_derivatives();
    // Largest value, and largest absolute value, of a scalar product over the hulls.
    let extremes = |a: &[A::Point], b: &[A::Point]| -> (f64, f64) {
        let (mut largest, mut absolute) = (f64::NEG_INFINITY, 0.0_f64);
        for p in a {
            for q in b {
                let product = A::dot(p, q);
                let (up, down) = (A::upper_f64(&product), A::upper_f64(&-product));
                largest = largest.max(up);
                absolute = absolute.max(up).max(down);
            }
        }
        (largest, absolute)
    };
    let d = patch.coefficients();
    let (vv, ww) = (extremes(d, &second[0]).0, extremes(d, &second[2]).0);
    if !(vv + margin < 0.0 && ww + margin < 0.0) {
        return false;
    }
    // |d_v|^2 is convex in d_v: its maximum over the hull is at a coefficient.
    let length = |a: &[A::Point]| {
        a.iter()
            .map(|p| A::upper_f64(&A::dot(p, p)))
            .fold(0.0, f64::max)
    };
    let outward = 1.0 + 1e-12;
    let vv = vv + length(&first[0]) * outward + margin;
    let ww = ww + length(&first[1]) * outward + margin;
    let vw = (extremes(d, &second[1]).1 + extremes(&first[0], &first[1]).1 + margin) * outward;
    vv < 0.0 && ww < 0.0 && vv * ww > vw * vw * outward
}

/// Approximate maximisers of |d|^2 on the patch: Newton steps inside and along each edge. Proposals
/// only, rounded to 2^-20.
fn candidates<A, B>(patch: &B) -> Vec<[f64; 2]>
where
    A: Space,
    B: Patch<A::Scalar, A::Point>,
{
    let mean = |points: &[A::Point]| {
        let mut total = [0.0; 3];
        for p in points {
            let p = A::coordinates(p);
            for (t, x) in total.iter_mut().zip(p) {
                *t += x / points.len() as f64;
            }
        }
        total
    };
    let second = patch.second_derivatives().map(|s| mean(&s));
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    // Half the gradient and half the Hessian (second derivatives taken as constant).
    let model = |at: [f64; 2]| {
        let (value, [dv, dw]) = patch.evaluate([&A::dyadic(at[0]), &A::dyadic(at[1])]);
        let (value, dv, dw) = (
            A::coordinates(&value),
            A::coordinates(&dv),
            A::coordinates(&dw),
        );
        let gradient = [dot(value, dv), dot(value, dw)];
        let hessian = [
            dot(dv, dv) + dot(value, second[0]),
            dot(dv, dw) + dot(value, second[1]),
            dot(dw, dw) + dot(value, second[2]),
        ];
        (gradient, hessian)
    };
    let round = |x: f64| (x.clamp(0.0, 1.0) * 1048576.0).round() / 1048576.0;
    let inside = |at: [f64; 2]| -> bool {
        let [v, w] = at;
        v >= 0.0
            && w >= 0.0
            && if B::CORNERS == 3 {
                v + w <= 1.0
            } else {
                v <= 1.0 && w <= 1.0
            }
    };
    let mut found = Vec::with_capacity(5);
    let mut at = if B::CORNERS == 3 {
        [0.25, 0.25]
    } else {
        [0.5, 0.5]
    };
    for _ in 0..4 {
        let (g, [a, b, c]) = model(at);
        let determinant = a * c - b * b;
        if determinant.is_nan() || determinant <= 0.0 {
            break;
        }
        let next = [
            at[0] - (c * g[0] - b * g[1]) / determinant,
            at[1] - (a * g[1] - b * g[0]) / determinant,
        ];
        if !(next[0].is_finite() && next[1].is_finite()) {
            break;
        }
        let next = [round(next[0]), round(next[1])];
        if !inside(next) {
            break;
        }
        at = next;
    }
    found.push(at);
    for corner in 0..B::CORNERS {
        let (p, q) = (
            B::local_corner(corner),
            B::local_corner((corner + 1) % B::CORNERS),
        );
        let direction = [q[0] - p[0], q[1] - p[1]];
        let mut t = 0.5;
        for _ in 0..4 {
            let (g, [a, b, c]) = model([p[0] + t * direction[0], p[1] + t * direction[1]]);
            let slope = g[0] * direction[0] + g[1] * direction[1];
            let bend = a * direction[0] * direction[0]
                + 2.0 * b * direction[0] * direction[1]
                + c * direction[1] * direction[1];
            if bend.is_nan() || bend >= 0.0 {
                break;
            }
            let next = t - slope / bend;
            if !next.is_finite() {
                break;
            }
            t = round(next);
        }
        found.push([p[0] + t * direction[0], p[1] + t * direction[1]]);
    }
    found
}
