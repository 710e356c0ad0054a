//! Exact refinement on a dyadic grid: all coordinates are integers times one power of two.
//!
//! `f64` coordinates and regular masks are dyadic, so a step of refinement multiplies by integer
//! numerators over 2^s and moves the exponent by -s; nothing is rounded. The formulas are the generic
//! ones of this module, with numerators for weights: each output is one multiplication deep.
//!
//! | scheme | dyadic at | s |
//! |---|---|---|
//! | Loop, original | n = 3, 6 | 4 |
//! | Loop, Warren | n = 2^j, 3 2^j | 4 at 3 and 6, j + 3 |
//! | Catmull-Clark | n = 2^j, faces of 2^i sides | 2j + i: 6 at n = 4 on quads |
//! | Doo-Sabin | quads | 4 |
//!
//! **No overflow.** Let |numerators| < 2^b. Weights are >= 0 with sum 2^s, so an output and each partial
//! sum of it is below 2^(b+s) in magnitude; a face lifted to M is at most M 2^b, so is a neighbour taken M
//! times, and a ring of n of each 2 n M 2^b. So `b + max(s, ceil log2(2 n M))` <= 127 bits suffice,
//! tested once per step instead of once per operation.

use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;
use num_traits::{One, ToPrimitive, Zero};

use super::corners::parallel;
use super::error::RefineError;
use super::masks::{Masks, Present, RingMask, Target};
use super::{positions, topology::check};
use crate::mesh::{Point, Topology};
use crate::scalar::Rational;
use crate::scheme::{CornerRule, Scheme};
use rayon::prelude::*;

/// A weight times 2^s, or an integer lift.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Numerator(u64);

/// A point with integer coordinates, in units of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridPoint(pub [i128; 3]);

/// Points on a common grid: coordinate = numerator 2^exponent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grid {
    /// One point per vertex.
    pub points: Vec<GridPoint>,
    /// The exponent of the unit.
    pub exponent: i32,
}

/// Exact refinement into memory that the caller keeps; it needs none of its own.
#[derive(Clone, Debug)]
pub struct GridRefiner {
    scheme: Scheme,
    corner: CornerRule,
}

impl Grid {
    /// The points as they are, on the coarsest grid that holds them all.
    ///
    /// # Errors
    /// If and only if a coordinate is not finite ([`RefineError::NotFinite`]) or the coordinates
    /// span more than 127 binary places ([`RefineError::GridOverflow`]).
    pub fn from_points(points: &[Point<f64>]) -> Result<Self, RefineError> {
        let (mut low, mut high) = (i32::MAX, i32::MIN);
        for (vertex, point) in points.iter().enumerate() {
            for x in point.0 {
                if !x.is_finite() {
                    return Err(RefineError::NotFinite {
                        vertex: vertex as u32,
                    });
                }
                let (mantissa, exponent) = decode(x);
                if mantissa != 0 {
                    low = low.min(exponent + mantissa.trailing_zeros() as i32);
                    high = high.max(exponent + 64 - mantissa.leading_zeros() as i32);
                }
            }
        }
        if low > high {
            return Ok(Grid {
                points: vec![GridPoint::zero(); points.len()],
                exponent: 0,
            });
        }
        let bits = (high - low) as u32;
        if bits > 127 {
            return Err(RefineError::GridOverflow { bits });
        }
        let coordinate = |x: f64| {
            let (mantissa, exponent) = decode(x);
            if mantissa == 0 {
                return 0;
            }
            let shift = exponent - low;
            let size = i128::from(mantissa);
            let size = if shift >= 0 {
                size << shift
            } else {
                size >> -shift
            };
            if x < 0.0 { -size } else { size }
        };
        let points = points
            .iter()
            .map(|point| GridPoint(point.0.map(coordinate)))
            .collect();
        Ok(Grid {
            points,
            exponent: low,
        })
    }

    /// The points as rationals.
    pub fn to_rationals(&self) -> Vec<Point<Rational>> {
        let power = BigInt::one() << self.exponent.unsigned_abs();
        let coordinate = |x: i128| {
            if self.exponent >= 0 {
                Rational::from(BigInt::from(x) * &power)
            } else {
                Rational::new(BigInt::from(x), power.clone())
            }
        };
        self.points
            .iter()
            .map(|point| Point(point.0.map(coordinate)))
            .collect()
    }

    /// The least b for which all |numerators| are below 2^b.
    fn bits(&self) -> u32 {
        let fold =
            |bits: u128, p: &GridPoint| bits | p.0.iter().fold(0, |b, x| b | x.unsigned_abs());
        let bits = if parallel(self.points.len()) {
            let chunks = self.points.par_chunks(1 << 14);
            chunks
                .map(|chunk| chunk.iter().fold(0, fold))
                .reduce(|| 0, |a, b| a | b)
        } else {
            self.points.iter().fold(0, fold)
        };
        128 - bits.leading_zeros()
    }

    /// The exact positions after one step of refinement.
    ///
    /// # Errors
    /// If and only if the scheme refuses the mesh or the arguments ([`super::refine`]), a weight is
    /// irrational ([`RefineError::Unrepresentable`]) or not dyadic ([`RefineError::NotDyadic`]), or
    /// the numerators need too many bits ([`RefineError::GridOverflow`]). The caller then falls back
    /// on rationals or on enclosures.
    pub fn refine(
        &self,
        scheme: Scheme,
        corner: CornerRule,
        topology: &Topology,
    ) -> Result<Self, RefineError> {
        let mut out = Grid {
            points: Vec::new(),
            exponent: 0,
        };
        GridRefiner::new(scheme, corner).refine_into(topology, self, &mut out)?;
        Ok(out)
    }
}

impl GridRefiner {
    /// A refiner by these rules.
    pub fn new(scheme: Scheme, corner: CornerRule) -> Self {
        GridRefiner { scheme, corner }
    }

    /// [`Grid::refine`] into the memory of `out`, whose old contents are lost.
    ///
    /// # Errors
    /// As [`Grid::refine`].
    pub fn refine_into(
        &mut self,
        topology: &Topology,
        grid: &Grid,
        out: &mut Grid,
    ) -> Result<(), RefineError> {
        positions::check_arguments(self.scheme, self.corner, topology, &grid.points)?;
        check(self.scheme, topology)?;
        let present = Present::new(self.scheme, Target::Refined, topology);
        let unit = present.largest_size().max(1);
        let (masks, shift) = dyadic_masks(self.scheme, &present, unit)?;
        let ring = present.valences.last().copied().unwrap_or(1).max(1);
        let sum = (2 * u64::from(ring) * u64::from(unit))
            .next_power_of_two()
            .ilog2();
        let bits = grid.bits() + shift.max(sum);
        let exponent = grid.exponent.checked_sub(shift as i32);
        let (true, Some(exponent)) = (bits <= 127, exponent) else {
            return Err(RefineError::GridOverflow { bits });
        };
        positions::refined(&masks, self.corner, topology, &grid.points, &mut out.points);
        out.exponent = exponent;
        Ok(())
    }
}

/// The binary mantissa and exponent of |x|.
fn decode(x: f64) -> (u64, i32) {
    let bits = x.to_bits();
    let fraction = bits & ((1 << 52) - 1);
    match (bits >> 52 & 0x7ff) as i32 {
        0 => (fraction, -1074),
        exponent => (fraction | 1 << 52, exponent - 1075),
    }
}

/// j if the denominator of `weight` is 2^j.
fn binary_places(weight: &Rational) -> Option<u32> {
    let places = weight.denom().trailing_zeros().unwrap_or(0);
    (weight.denom() >> places).is_one().then_some(places as u32)
}

/// The weights over 2^s, and s: the least that serves for all of them.
fn dyadic_masks(
    scheme: Scheme,
    present: &Present,
    unit: u32,
) -> Result<(Masks<Numerator>, u32), RefineError> {
    let masks = Masks::<Rational>::new(scheme, Target::Refined, present, i64::from(unit))?;
    name_the_odd(&masks, present)?;
    let mut shift = 0;
    let odd = RefineError::NotDyadic {
        what: "face size",
        size: unit,
    };
    masks.try_map(
        |weight| {
            shift = shift.max(binary_places(weight).ok_or(odd.clone())?);
            Ok(())
        },
        |_| Ok::<_, RefineError>(()),
    )?;
    if shift > 62 {
        return Err(RefineError::GridOverflow { bits: shift });
    }
    let integer = |x: Rational| {
        let value = if x.is_integer() {
            x.numer().to_u64()
        } else {
            None
        };
        value.map(Numerator).ok_or(odd.clone())
    };
    let power = Rational::from(BigInt::one() << shift);
    let masks = masks.try_map(
        |weight| integer(weight * &power),
        |lift| integer(lift.clone()),
    )?;
    Ok((masks, shift))
}

/// The first valence or face size whose weights are not dyadic, as an error.
fn name_the_odd(masks: &Masks<Rational>, present: &Present) -> Result<(), RefineError> {
    let dyadic = |weight: &Rational| binary_places(weight).is_some();
    match masks {
        Masks::Star(masks) => {
            for &size in &present.valences {
                let RingMask { center, ring } = &masks.vertex[size as usize];
                if ![center, ring].into_iter().all(dyadic) {
                    return Err(RefineError::NotDyadic {
                        what: "valence",
                        size,
                    });
                }
            }
            let odd = present.sizes.iter().find(|size| !size.is_power_of_two());
            odd.map_or(Ok(()), |&size| {
                Err(RefineError::NotDyadic {
                    what: "face size",
                    size,
                })
            })
        }
        Masks::Corner(masks) => {
            let odd = present
                .sizes
                .iter()
                .find(|&&size| !masks.corner[size as usize].iter().all(dyadic));
            odd.map_or(Ok(()), |&size| {
                Err(RefineError::NotDyadic {
                    what: "face size",
                    size,
                })
            })
        }
    }
}

impl Zero for GridPoint {
    fn zero() -> Self {
        GridPoint([0; 3])
    }
    fn is_zero(&self) -> bool {
        self.0 == [0; 3]
    }
}

impl Add for GridPoint {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        GridPoint([a + x, b + y, c + z])
    }
}

impl Add<&GridPoint> for GridPoint {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: &Self) -> Self {
        self + *other
    }
}

impl Sub<&GridPoint> for GridPoint {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        GridPoint([a - x, b - y, c - z])
    }
}

impl Mul<&Numerator> for GridPoint {
    type Output = Self;
    #[inline(always)]
    fn mul(self, weight: &Numerator) -> Self {
        let weight = i128::from(weight.0);
        GridPoint(self.0.map(|x| x * weight))
    }
}
