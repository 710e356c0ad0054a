//! Distances from a point to a triangle, a hull and a box, in `f64` with one error bound for all.
//!
//! Let L bound every |coordinate| and u = 2^-53. Differences of coordinates are at most 2 L, lengths
//! at most 2 sqrt(3) L < 3.5 L.
//!
//! - *Foot.* `q = a + (ab s + ac t)` with `s, t >= 0` and `s + t <= 1` up to one rounding. The exact
//!   point with the same s, t is within 3 u (2 L) (the two differences, the two products, their sum)
//!   plus u L (the last sum) plus 2 u L (`1 - s` rounds) of q per coordinate: 9 u L, 16 u L as a
//!   vector. So whatever s and t are, there is a point of the triangle within 16 u L of q.
//! - *Length of a difference.* Differences round by u relatively, three squares, two sums and a root
//!   by less than 4 u: 5 u (3.5 L) < 18 u L.
//! - *Support.* For every n != 0 the hull of points x_i is at least `min n . (p - x_i) / |n|` from
//!   p. A product n . d is off by less than 4 u |n| |d|, the quotient by less than 5 u more of it:
//!   9 u (3.5 L) < 32 u L. Nothing is assumed of n, so slivers and bad feet only make it less tight.
//! - *Box.* The vector of what lies beyond the faces has coordinates of relative error u: 18 u L.
//!
//! Hence a computed distance is off by less than 34 u L, and [`error_bound`] has 64 u L; underflow
//! (below 1e-150, the frame being of size 1) disappears in it.

use crate::patch::Lane;
use crate::scalar::float::UNIT_ROUNDOFF;

/// What a distance computed here can be off by, when no |coordinate| exceeds `largest`.
pub fn error_bound(largest: f64) -> f64 {
    64.0 * UNIT_ROUNDOFF * largest + 1e-150
}

/// The scalar product of the first three lanes.
#[inline(always)]
pub fn dot(a: &Lane, b: &Lane) -> f64 {
    a.0[0] * b.0[0] + a.0[1] * b.0[1] + a.0[2] * b.0[2]
}

/// The length of `a - b`.
#[inline(always)]
pub fn length(a: &Lane, b: &Lane) -> f64 {
    (*a - b).norm_squared().sqrt()
}

/// A number in [0, 1]; 0 in place of what a degenerate triangle yields (0 / 0).
#[inline(always)]
#[allow(clippy::manual_clamp)] // NaN becomes 0
fn fraction(x: f64) -> f64 {
    x.max(0.0).min(1.0)
}

/// A point of the triangle, the nearest to `p` but for rounding. Source: Ericson, *Real-Time
/// Collision Detection*, 5.1.5. Only that it lies in the triangle is certain.
#[inline]
pub fn foot(p: &Lane, [a, b, c]: &[Lane; 3]) -> Lane {
    let (ab, ac, ap) = (*b - a, *c - a, *p - a);
    let (d1, d2) = (dot(&ab, &ap), dot(&ac, &ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = *p - b;
    let (d3, d4) = (dot(&ab, &bp), dot(&ac, &bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return *a + ab * &fraction(d1 / (d1 - d3));
    }
    let cp = *p - c;
    let (d5, d6) = (dot(&ab, &cp), dot(&ac, &cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return *a + ac * &fraction(d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return *b + (*c - b) * &fraction(t);
    }
    let scale = 1.0 / (va + vb + vc);
    let s = fraction(vb * scale);
    let t = fraction(vc * scale).min(1.0 - s);
    *a + (ab * &s + ac * &t)
}

/// The least of `n . (p - x)` over points x met one by one: with a direction n, a lower bound of the
/// distance from p to their hull.
#[derive(Clone, Copy, Debug)]
pub struct Support {
    p: Lane,
    n: Lane,
    least: f64,
}

impl Support {
    /// Towards p from `q`.
    #[inline]
    pub fn new(p: &Lane, q: &Lane) -> Self {
        Support {
            p: *p,
            n: *p - q,
            least: f64::INFINITY,
        }
    }

    /// Takes one more point of the hull.
    #[inline]
    pub fn include(&mut self, x: &Lane) {
        self.least = self.least.min(dot(&self.n, &(self.p - x)));
    }

    /// The distance to the hull is at least this, but for [`error_bound`]; 0 if n is.
    #[inline]
    pub fn distance(&self) -> f64 {
        let norm = self.n.norm_squared().sqrt();
        if self.least > 0.0 && norm > 0.0 && self.least.is_finite() {
            self.least / norm
        } else {
            0.0
        }
    }
}

/// An axis-parallel box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least coordinates.
    pub low: Lane,
    /// Largest coordinates.
    pub high: Lane,
}

impl Aabb {
    /// The box of no point.
    pub const EMPTY: Aabb = Aabb {
        low: Lane([f64::INFINITY, f64::INFINITY, f64::INFINITY, 0.0]),
        high: Lane([f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY, 0.0]),
    };

    /// Grows to hold a point.
    #[inline]
    pub fn include(&mut self, p: &Lane) {
        for i in 0..4 {
            self.low.0[i] = self.low.0[i].min(p.0[i]);
            self.high.0[i] = self.high.0[i].max(p.0[i]);
        }
    }

    /// The box of both.
    #[inline]
    pub fn join(mut self, other: &Aabb) -> Self {
        self.include(&other.low);
        self.include(&other.high);
        self
    }

    /// Grows by `margin` on every side, and one rounding more.
    pub fn widen(&mut self, margin: f64) {
        for i in 0..3 {
            self.low.0[i] = (self.low.0[i] - margin).next_down();
            self.high.0[i] = (self.high.0[i] + margin).next_up();
        }
    }

    /// The squared distance from a point to the box; infinite for the empty box.
    #[inline]
    pub fn distance_squared(&self, p: &Lane) -> f64 {
        let mut total = 0.0;
        for i in 0..3 {
            let beyond = (self.low.0[i] - p.0[i])
                .max(p.0[i] - self.high.0[i])
                .max(0.0);
            total += beyond * beyond;
        }
        total
    }
}
