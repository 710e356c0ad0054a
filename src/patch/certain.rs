//! The two arithmetics that need no rounding bound: intervals and exact rationals.

use num_traits::{Signed, ToPrimitive, Zero};

use super::Space;
use crate::mesh::Point;
use crate::scalar::float::{lower_sqrt, round_down, round_to_nearest, round_up, upper_sqrt};
use crate::scalar::{Interval, Rational, Ring};

/// Interval arithmetic: every squared length is an upper or lower end of an enclosure.
#[derive(Clone, Copy, Debug)]
pub enum Enclosing {}

impl Space for Enclosing {
    type Scalar = Interval;
    type Point = Point<Interval>;
    type Square = f64;

    const SLACK: f64 = 0.0;

    fn lift(p: &Point<Interval>, base: &Point<Interval>) -> Point<Interval> {
        *p - base
    }
    fn zero() -> f64 {
        0.0
    }
    fn upper(p: &Point<Interval>) -> f64 {
        let [x, y, z] = p.0;
        (x.sqr() + y.sqr() + z.sqr()).sup()
    }
    fn lower(p: &Point<Interval>) -> f64 {
        let [x, y, z] = p.0;
        (x.sqr() + y.sqr() + z.sqr()).inf()
    }
    fn dot(a: &Point<Interval>, b: &Point<Interval>) -> Interval {
        a.dot(b)
    }
    fn upper_scalar(x: &Interval) -> f64 {
        x.sup().max(0.0)
    }
    fn dyadic(x: f64) -> Interval {
        Interval::point(x)
    }
    fn upper_f64(x: &Interval) -> f64 {
        x.sup()
    }
    fn square(length: f64) -> f64 {
        (length * length).next_down().max(0.0)
    }
    fn lengths(lower: &f64, upper: &f64, _: f64) -> [f64; 2] {
        [lower_sqrt(*lower), upper_sqrt(*upper)]
    }
    fn magnitude(p: &Point<Interval>) -> f64 {
        p.0.iter().fold(0.0, |largest: f64, x| largest.max(x.mag()))
    }
    fn relax(x: &f64, gap: f64) -> f64 {
        x * ((1.0 + gap) * (1.0 + gap))
    }
    fn coordinates(p: &Point<Interval>) -> [f64; 3] {
        p.0.map(Interval::mid)
    }
    fn estimate(x: &f64) -> f64 {
        *x
    }
}

/// Exact rational arithmetic; squared lengths are exact.
#[derive(Clone, Copy, Debug)]
pub enum Exact {}

impl Space for Exact {
    type Scalar = Rational;
    type Point = Point<Rational>;
    type Square = Rational;

    const SLACK: f64 = 0.0;

    fn lift(p: &Point<Rational>, base: &Point<Rational>) -> Point<Rational> {
        p.clone() - base
    }
    fn zero() -> Rational {
        Rational::zero()
    }
    fn upper(p: &Point<Rational>) -> Rational {
        p.norm_squared()
    }
    fn lower(p: &Point<Rational>) -> Rational {
        p.norm_squared()
    }
    fn dot(a: &Point<Rational>, b: &Point<Rational>) -> Rational {
        a.dot(b)
    }
    fn upper_scalar(x: &Rational) -> Rational {
        if x.is_positive() {
            x.clone()
        } else {
            Rational::zero()
        }
    }
    /// # Panics
    /// If `x` is not finite.
    fn dyadic(x: f64) -> Rational {
        Rational::from_float(x).expect("a finite number")
    }
    fn upper_f64(x: &Rational) -> f64 {
        round_up(x)
    }
    fn square(length: f64) -> Rational {
        let length = Self::dyadic(length);
        length.clone() * &length
    }
    fn lengths(lower: &Rational, upper: &Rational, _: f64) -> [f64; 2] {
        [
            exact_root(lower, |x| lower_sqrt(round_down(x)), f64::next_down),
            exact_root(upper, |x| upper_sqrt(round_up(x)), f64::next_up),
        ]
    }
    fn magnitude(_: &Point<Rational>) -> f64 {
        0.0
    }
    fn relax(x: &Rational, gap: f64) -> Rational {
        let factor = <Rational as Ring>::from_integer(1) + &Self::dyadic(gap);
        x.clone() * &(factor.clone() * &factor)
    }
    fn coordinates(p: &Point<Rational>) -> [f64; 3] {
        [0, 1, 2].map(|i| round_to_nearest(&p.0[i]))
    }
    fn estimate(x: &Rational) -> f64 {
        x.to_f64().unwrap_or(f64::INFINITY)
    }
}

/// A bound of the root of a rational of any size: the root of `x 4^-k`, near 1, times `2^k`.
fn exact_root(x: &Rational, root: impl Fn(&Rational) -> f64, outward: impl Fn(f64) -> f64) -> f64 {
    if x.is_zero() {
        return 0.0;
    }
    let k = (x.numer().bits() as i64 - x.denom().bits() as i64) / 2;
    let k = k.clamp(-1000, 1000) as i32; // a result beyond the range of f64 is rounded there
    let power = Rational::from_integer(num_bigint::BigInt::from(1) << (2 * k.unsigned_abs()));
    let near_one = if k >= 0 {
        x.clone() / &power
    } else {
        x.clone() * &power
    };
    let near_one = root(&near_one);
    let scaled = near_one * 2f64.powi(k);
    if scaled / 2f64.powi(k) == near_one {
        scaled
    } else {
        outward(scaled).max(0.0)
    }
}
