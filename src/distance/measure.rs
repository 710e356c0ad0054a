//! The parametric distance of a whole mesh, from its file's coordinates to the printed enclosure.
//!
//! `f64` positions are scaled by a power of two so that the largest coordinate is in [1, 2), which is
//! exact but for underflow, and, if the mesh is to be refined first and lies far from the origin,
//! moved to it, which rounds once relative to the mesh's own size. Refinement to level K carries a
//! bound on its errors ([`crate::refine::Refiner::enclose_into`]); the rest is
//! [`super::parametric`]. Lengths are scaled back outward.

use std::cmp::Ordering;
use std::fmt;

use super::model::{Against, CatmullClarkModel, DooSabinModel, LoopModel, MeshView, Model};
use super::parametric::{Goal, MeshEnclosure, enclose_mesh};
use crate::mesh::frame::{Frame, enclose_scaled, power_of_two, printed_above, printed_below};
use crate::mesh::{Mesh, Point, Topology};
use crate::patch::quad_net::CatmullClarkRules;
use crate::patch::quarter_net::DooSabinRules;
use crate::patch::triangle_net::LoopRules;
use crate::patch::{Enclosing, Exact, Float, Space};
use crate::refine::enclosure::largest_coordinate;
use crate::refine::{RefineError, Refiner, refine, refine_topology, topology};
use crate::scalar::float::round_to_nearest;
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
    let frame = Frame::of(&mesh.topology, &mesh.positions, request.level > 0);
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
    check_mesh(mesh)
}

/// Whether there is one finite position for each vertex.
pub(super) fn check_mesh(mesh: &Mesh) -> Result<(), MeasureError> {
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
    let frame = Frame::of(&nearest.topology, &nearest.positions, false);
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
    let frame = Frame::of(&mesh.topology, &mesh.positions, request.level > 0);
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
        compared: request.against.facet(),
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
