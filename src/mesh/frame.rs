//! A unit and an origin in which `f64` does its best, and the way back, outward.

use std::cmp::Ordering;

use num_bigint::BigInt;

use super::{Mesh, NONE, Point, Topology};
use crate::scalar::float::UNIT_ROUNDOFF;
use crate::scalar::{Interval, Rational};

/// A change of unit and origin that `f64` can undo.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// Coordinates are divided by 2^exponent.
    pub(crate) exponent: i32,
    /// Subtracted after that.
    pub(crate) origin: [f64; 3],
    /// Largest coordinate in the frame.
    pub(crate) size: f64,
}

impl Frame {
    /// The frame of the vertices that have a face.
    pub(crate) fn of(topology: &Topology, positions: &[Point<f64>], moves: bool) -> Self {
        Self::between(extremes(topology, positions), moves)
    }

    /// The least and largest coordinates of the vertices that have a face.
    pub(crate) fn corners(meshes: &[&Mesh]) -> ([f64; 3], [f64; 3]) {
        let none = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let all = meshes.iter().map(|m| extremes(&m.topology, &m.positions));
        all.fold(none, |a, b| {
            let low = [0, 1, 2].map(|i| a.0[i].min(b.0[i]));
            (low, [0, 1, 2].map(|i| a.1[i].max(b.1[i])))
        })
    }

    /// One frame for several meshes.
    pub(crate) fn covering(meshes: &[&Mesh], moves: bool) -> Self {
        Self::between(Self::corners(meshes), moves)
    }

    /// Of points between the corners given.
    pub(crate) fn between((low, high): ([f64; 3], [f64; 3]), moves: bool) -> Self {
        let largest = (0..3)
            .map(|i| low[i].abs().max(high[i].abs()))
            .fold(0.0, f64::max);
        let exponent = if largest > 0.0 { exponent(largest) } else { 0 };
        let (low, high) = (
            low.map(|x| scale(x, -exponent)),
            high.map(|x| scale(x, -exponent)),
        );
        let extent = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
        let far = extent < 0.5;
        let origin = if moves && far {
            [0, 1, 2].map(|i| 0.5 * (low[i] + high[i]))
        } else {
            [0.0; 3]
        };
        Frame {
            exponent,
            origin,
            size: if moves && far { extent } else { 2.0 },
        }
    }

    /// The positions in the frame, and the bound on their error per coordinate: one rounding of the
    /// difference. Underflow of the scaling is covered by [`crate::patch::rounding::TINY`].
    pub(crate) fn enter(&self, positions: &[Point<f64>]) -> (Vec<Point<f64>>, f64) {
        let moved = self.origin != [0.0; 3];
        let place = |p: &Point<f64>| {
            let scaled = p.0.map(|x| scale(x, -self.exponent));
            Point(std::array::from_fn(|i| scaled[i] - self.origin[i]))
        };
        let radius = if moved {
            UNIT_ROUNDOFF * self.size * 1.01
        } else {
            0.0
        };
        (positions.iter().map(place).collect(), radius)
    }

    /// A coordinate in the frame's unit, where it is not moved.
    pub(crate) fn shrink(&self, x: f64) -> f64 {
        scale(x, -self.exponent)
    }

    pub(crate) fn leave(&self, p: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| scale(p[i] + self.origin[i], self.exponent))
    }

    /// Lengths in the mesh's unit, outward where scaling back underflows.
    pub(crate) fn lengths(&self, [lo, hi]: [f64; 2]) -> [f64; 2] {
        let (low, high) = (scale(lo, self.exponent), scale(hi, self.exponent));
        let exact = |length: f64, scaled: f64| scale(scaled, -self.exponent) == length;
        [
            if exact(lo, low) {
                low
            } else {
                low.next_down().max(0.0)
            },
            if exact(hi, high) {
                high
            } else {
                high.next_up()
            },
        ]
    }
}

/// The least and largest coordinates of the vertices that have a face; none of them is NaN.
pub(super) fn extremes(topology: &Topology, positions: &[Point<f64>]) -> ([f64; 3], [f64; 3]) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    // Plain comparisons become vector instructions; those of `f64::min` look for NaN.
    let mut meet = |p: &[f64; 3]| {
        for i in 0..3 {
            low[i] = if p[i] < low[i] { p[i] } else { low[i] };
            high[i] = if p[i] > high[i] { p[i] } else { high[i] };
        }
    };
    if topology.has_isolated_vertices() {
        for (vertex, p) in (0..).zip(positions) {
            if topology.first_halfedge(vertex) != NONE {
                meet(&p.0);
            }
        }
        return (low, high);
    }
    // Four points at once.
    let (fours, rest) = positions.as_chunks::<4>();
    let (mut lows, mut highs) = ([[f64::INFINITY; 3]; 4], [[f64::NEG_INFINITY; 3]; 4]);
    for four in fours {
        for (i, p) in four.iter().enumerate() {
            for j in 0..3 {
                let x = p.0[j];
                lows[i][j] = if x < lows[i][j] { x } else { lows[i][j] };
                highs[i][j] = if x > highs[i][j] { x } else { highs[i][j] };
            }
        }
    }
    if !fours.is_empty() {
        lows.iter().chain(&highs).for_each(&mut meet);
    }
    rest.iter().for_each(|p| meet(&p.0));
    (low, high)
}

/// `x 2^k` for any k; exact unless it under- or overflows.
fn scale(x: f64, k: i32) -> f64 {
    let half = k / 2;
    let step = |x: f64, k: i32| {
        let (a, b) = (k / 2, k - k / 2);
        x * 2f64.powi(a) * 2f64.powi(b)
    };
    step(step(x, half), k - half)
}

/// The exponent e with `2^e <= x < 2^(e+1)`, x > 0 finite.
fn exponent(x: f64) -> i32 {
    let raw = (x.to_bits() >> 52 & 0x7ff) as i32;
    if raw > 0 {
        raw - 1023
    } else {
        exponent(x * 2f64.powi(64)) - 64
    }
}

/// `2^k`, exactly.
pub(crate) fn power_of_two(k: i32) -> Rational {
    let power = BigInt::from(1) << k.unsigned_abs();
    if k >= 0 {
        Rational::from_integer(power)
    } else {
        Rational::new(1.into(), power)
    }
}

/// An enclosure of `x 2^k`: a point unless it underflows.
pub(crate) fn enclose_scaled(x: f64, k: i32) -> Interval {
    let scaled = scale(x, k);
    if scale(scaled, -k) == x {
        Interval::point(scaled)
    } else {
        Interval::new(scaled.next_down(), scaled.next_up())
    }
}

/// The largest `f64` up to `x` that prints (shortest decimal that reads back) as a decimal not above
/// `x`: what people read is a bound too. The shortest decimal is within half a step of its number, so
/// one step down is enough.
pub(crate) fn printed_below(x: f64) -> f64 {
    if printed_side(x).is_gt() {
        x.next_down().max(0.0)
    } else {
        x
    }
}

/// As [`printed_below`], upward.
pub(crate) fn printed_above(x: f64) -> f64 {
    if printed_side(x).is_lt() {
        x.next_up()
    } else {
        x
    }
}

/// How the shortest decimal of a finite number compares with the number.
fn printed_side(x: f64) -> Ordering {
    let text = format!("{x:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let places = digits
        .split_once('.')
        .map_or(0, |(_, fraction)| fraction.len() as i32);
    let digits: BigInt = digits.replace('.', "").parse().unwrap_or_default();
    let shift = exponent - places;
    let ten = BigInt::from(10).pow(shift.unsigned_abs());
    let decimal = if shift >= 0 {
        Rational::from_integer(digits * ten)
    } else {
        Rational::new(digits, ten)
    };
    Rational::from_float(x).map_or(Ordering::Equal, |exact| decimal.cmp(&exact))
}
