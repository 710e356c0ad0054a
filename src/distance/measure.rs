//! The parametric distance of a whole mesh, from its file's coordinates to the printed enclosure.
//!
//! `f64` positions are scaled by a power of two so that the largest coordinate is in [1, 2), which is
//! exact but for underflow, and, if the mesh is to be refined first and lies far from the origin,
//! moved to it, which rounds once relative to the mesh's own size. Refinement to level K carries a
//! bound on its errors ([`crate::refine::Refiner::enclose_into`]); the rest is
//! [`super::parametric`]. Lengths are scaled back outward.

use std::fmt;

use super::model::{Against, CatmullClarkModel, DooSabinModel, LoopModel, MeshView, Model};
use super::parametric::{Goal, MeshEnclosure, enclose_mesh, is_rounding_level};
use crate::mesh::{Mesh, Point, Topology};
use crate::patch::quad_net::CatmullClarkRules;
use crate::patch::quarter_net::DooSabinRules;
use crate::patch::triangle_net::LoopRules;
use crate::patch::{Enclosing, Exact, Float, Space};
use crate::refine::{RefineError, Refiner, refine, refine_topology, topology};
use crate::scalar::float::UNIT_ROUNDOFF;
use crate::scalar::{Interval, Rational};
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
    /// Whether the gap was met, or `hi` is at the level of the rounding bound.
    pub met: bool,
    /// Whether `hi` is at the level of the rounding bound: at most 10^6 u (1.1e-10) times the mesh's
    /// largest coordinate.
    pub rounding_level: bool,
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
    /// Settles whether the gap was met: no search stopped early, and the gap is as asked or `hi` is
    /// at the level of the rounding bound of a mesh of the given size.
    fn decide(&mut self, gap: f64, size: f64) {
        self.rounding_level = is_rounding_level(self.hi, size);
        self.met &= self.gap() <= gap || self.rounding_level;
    }

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
    topology::check(request.scheme, &mesh.topology)?;
    let frame = Frame::of(&mesh.positions, request.level > 0);
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
    let mut result = report(topology, &level, found, |p| frame.leave(p));
    result.decide(request.goal.gap, frame.size);
    let [lo, hi] = frame.lengths([result.lo, result.hi]);
    (result.lo, result.hi) = (lo, hi);
    for face in result.face_enclosures.iter_mut().flatten().flatten() {
        *face = frame.lengths(*face);
    }
    Ok(result)
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
    let level = refine(request.scheme, request.corner, mesh, request.level)?;
    let found = enclose::<Exact>(&level.topology, &level.positions, 0.0, request, progress)?;
    let squares = found.squares.clone();
    let mut result = report(&level.topology, &level.positions, found, |p| p);
    result.squares = Some(squares);
    result.decide(request.goal.gap, 0.0);
    Ok(result)
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
    topology::check(request.scheme, &mesh.topology)?;
    let positions = mesh
        .positions
        .iter()
        .map(|p| Point(p.0.map(Interval::point)))
        .collect();
    let start = Mesh {
        topology: mesh.topology.clone(),
        positions,
    };
    let level = refine(request.scheme, request.corner, &start, request.level)?;
    let found = enclose::<Enclosing>(&level.topology, &level.positions, 0.0, request, progress)?;
    let size = mesh
        .positions
        .iter()
        .flat_map(|p| p.0)
        .fold(0.0, |size: f64, x| size.max(x.abs()));
    let mut result = report(&level.topology, &level.positions, found, |p| p);
    result.decide(request.goal.gap, size);
    Ok(result)
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

fn report<A: Space>(
    topology: &Topology,
    positions: &[Point<A::Scalar>],
    found: MeshEnclosure<A>,
    leave: impl Fn([f64; 3]) -> [f64; 3],
) -> Measurement {
    let witness = found.witness.map(|w| {
        let base = &positions[topology.origin(topology.halfedges(w.face).start) as usize];
        let zero = Point(std::array::from_fn(|_| num_traits::Zero::zero()));
        let base = A::lift(base, &zero);
        Witness {
            face: w.face,
            quarter: w.quarter,
            parameter: w.at,
            surface_point: leave(A::coordinates(&(w.surface_point + &base))),
            mesh_point: leave(A::coordinates(&(w.mesh_point + &base))),
        }
    });
    Measurement {
        lo: found.lo,
        hi: found.hi,
        squares: None,
        met: found.met,
        rounding_level: false,
        faces: topology.face_count(),
        measured: found.measured,
        witness,
        face_enclosures: found.faces,
        cells: found.cells,
    }
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
    fn of(positions: &[Point<f64>], moves: bool) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in positions {
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
    /// difference, underflow of the scaling.
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
        write!(f, "face {}", self.face + 1)?;
        if let Some(quarter) = self.quarter {
            write!(f, ", quarter {}", quarter + 1)?;
        }
        let ([u, v], [x, y, z]) = (self.parameter, self.surface_point);
        write!(f, ", parameter ({u}, {v}), surface point ({x}, {y}, {z})")
    }
}
