//! The parametric distance of a whole mesh, from its file's coordinates to the printed enclosure.
//!
//! `f64` positions are scaled by a power of two so that the largest coordinate is in [1, 2), which is
//! exact but for underflow, and, if the mesh is to be refined first and lies far from the origin,
//! moved to it, which rounds once relative to the mesh's own size. Refinement to level K carries a
//! bound on its errors ([`crate::refine::Refiner::enclose_into`]); the rest is
//! [`super::parametric`]. Lengths are scaled back outward.

use std::cmp::Ordering;
use std::fmt;

use num_bigint::BigInt;

use super::model::{Against, CatmullClarkModel, DooSabinModel, LoopModel, MeshView, Model};
use super::parametric::{Goal, MeshEnclosure, enclose_mesh};
use crate::mesh::{Mesh, NONE, Point, Topology};
use crate::patch::quad_net::CatmullClarkRules;
use crate::patch::quarter_net::DooSabinRules;
use crate::patch::triangle_net::LoopRules;
use crate::patch::{Enclosing, Exact, Float, Space};
use crate::refine::enclosure::largest_coordinate;
use crate::refine::{RefineError, Refiner, refine, refine_topology, topology};
use crate::scalar::float::{UNIT_ROUNDOFF, round_to_nearest};
use crate::scalar::{Decide, Interval, Rational, Ring};
use crate::scheme::{CornerRule, Scheme};

/// What is measured.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// The scheme that defines the surface.
    pub scheme: Scheme,
    /// What one-face boundary vertices do.
    pub corner: CornerRule,
    /// The level of the mesh that the surface is compared with.
    pub level: u32,
    /// Control or limit mesh.
    pub against: Against,
    /// How well.
    pub goal: Goal,
}

/// Why a mesh cannot be measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeasureError {
    /// The scheme does not apply, or refinement fails.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// Doo-Sabin has no surface without interior vertices.
    #[error(
        "the mesh has no interior vertex, so its Doo-Sabin surface is empty: use a mesh with an interior vertex, or another scheme"
    )]
    EmptySurface,
    /// The arithmetic cannot represent the masks.
    #[error(
        "the masks for {what} {size} are irrational, so there is no exact mode for this mesh: use --arithmetic float or interval{cure}"
    )]
    Irrational {
        /// "valence" or "face size".
        what: &'static str,
        /// The valence or face size.
        size: u32,
        /// Another way out.
        cure: &'static str,
    },
}

/// The point where the lower bound is attained; coordinates are the nearest `f64`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Witness {
    /// Face of the level-K mesh, from 0.
    pub face: u32,
    /// Quarter of the face, if it is measured by quarters: the place of its vertex in the face.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quarter: Option<u32>,
    /// Parameters in the face or quarter.
    pub parameter: [f64; 2],
    /// S there.
    pub surface_point: [f64; 3],
    /// F there.
    pub mesh_point: [f64; 3],
}

/// A certified enclosure: `lo <= sup |S - F| <= hi`, in the mesh's own unit.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// The distance is at least this.
    pub lo: f64,
    /// The distance is at most this.
    pub hi: f64,
    /// Exact squares of bounds for the distance, in exact arithmetic.
    pub squares: Option<[Rational; 2]>,
    /// Whether the gaps asked for were met, or `hi` is at the level of the rounding bound.
    pub met: bool,
    /// Whether `hi` is at the level of the rounding bound ([`Measurement::noise`]): the distance may
    /// be 0, and the gap counts as met.
    pub rounding_level: bool,
    /// A length at the level of the rounding bound: 16 times the bound of the worst face; 0 in exact
    /// arithmetic.
    pub noise: f64,
    /// Number of faces of the level-K mesh.
    pub faces: u32,
    /// Number of those with surface.
    pub measured: u32,
    /// Where `lo` is attained.
    pub witness: Option<Witness>,
    /// Per-face enclosures, if asked for.
    pub face_enclosures: Option<Vec<Option<[f64; 2]>>>,
    /// Number of cells visited.
    pub cells: u64,
}

impl Measurement {
    /// `(hi - lo) / hi`, 0 if `hi` is 0.
    pub fn gap(&self) -> f64 {
        if self.hi > 0.0 {
            (self.hi - self.lo) / self.hi
        } else {
            0.0
        }
    }
}

/// Measures in `f64` with an a-priori rounding bound. The claim is about the `f64` coordinates.
///
/// # Errors
/// If and only if the scheme does not apply to the mesh or its surface is empty.
pub fn measure(
    mesh: &Mesh,
    request: &Request,
    progress: &(dyn Fn(u32, u32) + Sync),
) -> Result<Measurement, MeasureError> {
    check(request, mesh)?;
    let frame = Frame::of(mesh, request.level > 0);
    let (mut level, mut radius) = frame.enter(&mesh.positions);
    let mut refiner = Refiner::new(request.scheme, request.corner);
    let mut topology = None;
    let mut next = Vec::new();
    for _ in 0..request.level {
        let coarse = topology.as_ref().unwrap_or(&mesh.topology);
        radius = refiner.enclose_into(coarse, &level, radius, &mut next)?;
        std::mem::swap(&mut level, &mut next);
        topology = Some(refine_topology(request.scheme, coarse)?);
    }
    drop(next);
    let topology = topology.as_ref().unwrap_or(&mesh.topology);
    let found = enclose::<Float>(topology, &level, radius, request, progress)?;
    Ok(report(topology, &level, found, request, &frame))
}

/// Whether the scheme applies and the coordinates are finite.
fn check(request: &Request, mesh: &Mesh) -> Result<(), MeasureError> {
    topology::check(request.scheme, &mesh.topology)?;
    largest_coordinate(&mesh.positions)?;
    let (expected, found) = (mesh.topology.vertex_count() as usize, mesh.positions.len());
    if expected != found {
        return Err(RefineError::PositionCount { expected, found }.into());
    }
    Ok(())
}

/// Measures in exact rational arithmetic. The claim is about the decimals in the file.
///
/// # Errors
/// As [`measure`], and if a mask of the mesh is irrational.
pub fn measure_exact(
    mesh: &Mesh<Rational>,
    request: &Request,
    progress: &(dyn Fn(u32, u32) + Sync),
) -> Result<Measurement, MeasureError> {
    topology::check(request.scheme, &mesh.topology)?;
    let nearest = mesh
        .positions
        .iter()
        .map(|p| Point([0, 1, 2].map(|i| round_to_nearest(&p.0[i]))));
    let nearest = Mesh {
        topology: mesh.topology.clone(),
        positions: nearest.collect(),
    };
    let frame = Frame::of(&nearest, false);
    let factor = power_of_two(-frame.exponent);
    let scaled = mesh.positions.iter().map(|p| p.clone() * &factor).collect();
    let scaled = Mesh {
        topology: nearest.topology,
        positions: scaled,
    };
    let level = refine(request.scheme, request.corner, &scaled, request.level)?;
    let found = enclose::<Exact>(&level.topology, &level.positions, 0.0, request, progress)?;
    let unit = power_of_two(2 * frame.exponent);
    let squares = found.squares.clone().map(|square| square * &unit);
    let faces_met = found.faces_met;
    let mut result = report(&level.topology, &level.positions, found, request, &frame);
    // Decided on the exact squares: lo and hi may be two numbers where the distance is one.
    let [lower, upper] = &squares;
    let closeness = <Rational as Ring>::from_integer(1) - &Exact::dyadic(request.goal.gap);
    let met = upper.clone() * &(closeness.clone() * &closeness);
    result.met = faces_met && met.decide(lower).is_some_and(Ordering::is_le);
    result.squares = Some(squares);
    Ok(result)
}

/// `2^k`, exactly.
fn power_of_two(k: i32) -> Rational {
    let power = BigInt::from(1) << k.unsigned_abs();
    if k >= 0 {
        Rational::from_integer(power)
    } else {
        Rational::new(1.into(), power)
    }
}

/// Measures in interval arithmetic throughout. The claim is about the `f64` coordinates.
///
/// # Errors
/// As [`measure`].
pub fn measure_enclosing(
    mesh: &Mesh,
    request: &Request,
    progress: &(dyn Fn(u32, u32) + Sync),
) -> Result<Measurement, MeasureError> {
    check(request, mesh)?;
    let frame = Frame::of(mesh, request.level > 0);
    let place = |p: &Point<f64>| {
        let scaled = p.0.map(|x| enclose_scaled(x, -frame.exponent));
        Point(std::array::from_fn(|i| {
            scaled[i] - Interval::point(frame.origin[i])
        }))
    };
    let positions = mesh.positions.iter().map(place).collect();
    let start = Mesh {
        topology: mesh.topology.clone(),
        positions,
    };
    let level = refine(request.scheme, request.corner, &start, request.level)?;
    let found = enclose::<Enclosing>(&level.topology, &level.positions, 0.0, request, progress)?;
    Ok(report(
        &level.topology,
        &level.positions,
        found,
        request,
        &frame,
    ))
}

/// An enclosure of `x 2^k`: a point unless it underflows.
fn enclose_scaled(x: f64, k: i32) -> Interval {
    let scaled = scale(x, k);
    if scale(scaled, -k) == x {
        Interval::point(scaled)
    } else {
        Interval::new(scaled.next_down(), scaled.next_up())
    }
}

/// Runs the search with the scheme's model.
fn enclose<A: Space>(
    topology: &Topology,
    positions: &[Point<A::Scalar>],
    radius: f64,
    request: &Request,
    progress: &(dyn Fn(u32, u32) + Sync),
) -> Result<MeshEnclosure<A>, MeasureError> {
    let mesh = MeshView::<A> {
        topology,
        positions,
        against: request.against,
    };
    let found = match request.scheme {
        Scheme::Loop(weights) => {
            let rules = LoopRules::new(weights, request.corner, topology).map_err(|size| {
                MeasureError::Irrational {
                    what: "valence",
                    size,
                    cure: ", or --weights warren",
                }
            })?;
            search(&LoopModel { mesh, rules }, radius, request, progress)
        }
        Scheme::CatmullClark => {
            let rules = CatmullClarkRules::new(request.corner, topology);
            search(
                &CatmullClarkModel { mesh, rules },
                radius,
                request,
                progress,
            )
        }
        Scheme::DooSabin => {
            let rules = DooSabinRules::new(topology).map_err(|size| MeasureError::Irrational {
                what: "face size",
                size,
                cure: "",
            })?;
            search(&DooSabinModel { mesh, rules }, radius, request, progress)
        }
    };
    found.ok_or(MeasureError::EmptySurface)
}

fn search<A: Space, M: Model<A>>(
    model: &M,
    radius: f64,
    request: &Request,
    progress: &(dyn Fn(u32, u32) + Sync),
) -> Option<MeshEnclosure<A>> {
    let count = model.face_count();
    enclose_mesh(model, radius, request.goal, &|done| progress(done, count))
}

/// The result in the mesh's own unit.
fn report<A: Space>(
    topology: &Topology,
    positions: &[Point<A::Scalar>],
    found: MeshEnclosure<A>,
    request: &Request,
    frame: &Frame,
) -> Measurement {
    let witness = found.witness.map(|w| {
        let base = &positions[topology.origin(topology.halfedges(w.face).start) as usize];
        let zero = Point(std::array::from_fn(|_| num_traits::Zero::zero()));
        let base = A::lift(base, &zero);
        Witness {
            face: w.face,
            quarter: w.quarter,
            parameter: w.at,
            surface_point: frame.leave(A::coordinates(&(w.surface_point + &base))),
            mesh_point: frame.leave(A::coordinates(&(w.mesh_point + &base))),
        }
    });
    let [lo, hi] = frame.lengths([found.lo, found.hi]);
    let [lo, hi] = [printed_below(lo), printed_above(hi)];
    let [_, noise] = frame.lengths([0.0, found.noise]);
    let gap = if hi > 0.0 { (hi - lo) / hi } else { 0.0 };
    let rounding_level = hi <= noise;
    let mut face_enclosures = found.faces;
    for face in face_enclosures.iter_mut().flatten().flatten() {
        let [lo, hi] = frame.lengths(*face);
        // One step outward, so that the shortest decimals lie outward too.
        *face = [
            lo.next_down().max(0.0),
            if hi > 0.0 { hi.next_up() } else { hi },
        ];
    }
    Measurement {
        lo,
        hi,
        squares: None,
        met: found.faces_met && (gap <= request.goal.gap || rounding_level),
        rounding_level,
        noise,
        faces: topology.face_count(),
        measured: found.measured,
        witness,
        face_enclosures,
        cells: found.cells,
    }
}

/// The largest `f64` up to `x` that prints (shortest decimal that reads back) as a decimal not above
/// `x`: what people read is a bound too. The shortest decimal is within half a step of its number, so
/// one step down is enough.
fn printed_below(x: f64) -> f64 {
    if printed_side(x).is_gt() {
        x.next_down().max(0.0)
    } else {
        x
    }
}

/// As [`printed_below`], upward.
fn printed_above(x: f64) -> f64 {
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

/// A change of unit and origin that `f64` can undo.
#[derive(Clone, Copy, Debug)]
struct Frame {
    /// Coordinates are divided by 2^exponent.
    exponent: i32,
    /// Subtracted after that.
    origin: [f64; 3],
    /// Largest coordinate in the frame.
    size: f64,
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

impl Frame {
    /// The frame of the vertices that have a face.
    fn of(mesh: &Mesh, moves: bool) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (vertex, p) in (0..).zip(&mesh.positions) {
            if mesh.topology.first_halfedge(vertex) == NONE {
                continue;
            }
            for i in 0..3 {
                low[i] = low[i].min(p.0[i]);
                high[i] = high[i].max(p.0[i]);
            }
        }
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
    fn enter(&self, positions: &[Point<f64>]) -> (Vec<Point<f64>>, f64) {
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

    fn leave(&self, p: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| scale(p[i] + self.origin[i], self.exponent))
    }

    /// Lengths in the mesh's unit, outward where scaling back underflows.
    fn lengths(&self, [lo, hi]: [f64; 2]) -> [f64; 2] {
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

/// The exponent e with `2^e <= x < 2^(e+1)`, x > 0 finite.
fn exponent(x: f64) -> i32 {
    let raw = (x.to_bits() >> 52 & 0x7ff) as i32;
    if raw > 0 {
        raw - 1023
    } else {
        exponent(x * 2f64.powi(64)) - 64
    }
}

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "face {} (from 1)", self.face + 1)?;
        if let Some(quarter) = self.quarter {
            write!(f, ", quarter {}", quarter + 1)?;
        }
        let ([u, v], [x, y, z]) = (self.parameter, self.surface_point);
        write!(f, ", parameter ({u}, {v}), surface point ({x}, {y}, {z})")
    }
}
