//! An estimator, a mesh, a number of local subdivisions, a level: a bound.

use std::collections::BTreeMap;
use std::fmt;

use super::inside::stays_inside;
use super::isolation::{NotApplicable, gather, is_extraordinary, isolated, obstacle};
use super::kernel::{Kernel, ModeWeights, Norms, Sum, decayed};
use super::regular;
use super::table;
use crate::bound::Against;
use crate::mesh::{Mesh, Point, Topology};
use crate::predict::heuristic::displacement;
use crate::refine::enclosure::largest_coordinate;
use crate::refine::{RefineError, Refiner, refine_topology};
use crate::scheme::{CornerRule, LoopWeights, Scheme};

/// An estimate of the distance between surface and level-m mesh, known before refining.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Estimator {
    /// `Σ |p_i| μ_i(m)` against control meshes: PW (15), (18).
    TabApprox,
    /// The same against limit meshes.
    TabInterp,
    /// `Σ |p_i| max(λ_i, 1/4)^m μ_i(0)`, against control meshes.
    TabEigen,
    /// The largest distance of a vertex of level m to its limit.
    Heuristic,
}

impl Estimator {
    /// All of them.
    pub const ALL: [Estimator; 4] = [
        Estimator::TabApprox,
        Estimator::TabInterp,
        Estimator::TabEigen,
        Estimator::Heuristic,
    ];

    /// The paper's name.
    pub fn name(self) -> &'static str {
        match self {
            Estimator::TabApprox => "tab-approx",
            Estimator::TabInterp => "tab-interp",
            Estimator::TabEigen => "tab-eigen",
            Estimator::Heuristic => "heuristic",
        }
    }

    /// The mesh whose distance from the surface is estimated.
    pub fn against(self) -> Against {
        match self {
            Estimator::TabInterp => Against::Limit,
            _ => Against::Control,
        }
    }
}

impl fmt::Display for Estimator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// An estimate of one mesh at one level.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The estimate, rounded upwards, in the mesh's own unit.
    pub bound: f64,
    /// Whether it is a proved upper bound of the one-sided Hausdorff distance from the surface to the level-m
    /// mesh ([`Estimator::against`]).
    pub safe: bool,
    /// Why, or why not.
    pub why: String,
}

/// The estimate for the level-m mesh after `local_steps` local subdivisions.
///
/// The claim is about the `f64` coordinates; see [`Prepared`] for many estimates of one mesh.
///
/// # Errors
/// If and only if the scheme refuses the mesh, or the estimate does not apply to it ([`NotApplicable`]); the
/// heuristic applies to every mesh, without local steps.
pub fn estimate(
    mesh: &Mesh,
    weights: LoopWeights,
    estimator: Estimator,
    local_steps: u32,
    m: u32,
) -> Result<Estimate, NotApplicable> {
    if estimator == Estimator::Heuristic {
        return Ok(Estimate {
            bound: displacement(mesh, weights, m)?[1],
            safe: false,
            why: "vertices need not be the points farthest from the mesh".into(),
        });
    }
    Prepared::new(mesh, weights, local_steps)?.estimate(estimator, m, Sum::BySector)
}

/// An extraordinary vertex, decomposed.
#[derive(Clone, Debug)]
struct Decomposed {
    vertex: u32,
    valence: u32,
    norms: Norms,
    /// Whether the eigenvectors' extension to the third ring is the mesh's own: its parent was isolated too.
    extended: bool,
}

/// A level's factor of second differences and weights of modes by valence.
struct Level {
    factor: f64,
    weights: BTreeMap<u32, ModeWeights>,
}

/// A mesh, locally subdivided and decomposed once for all levels and estimators.
#[derive(Clone, Debug)]
pub struct Prepared {
    weights: LoopWeights,
    local_steps: u32,
    /// Lengths in the mesh's unit are 2^exponent times those here.
    exponent: i32,
    topology: Topology,
    kernels: BTreeMap<u32, Kernel>,
    vertices: Vec<Decomposed>,
    second_differences: Vec<f64>,
    /// The largest second difference of the faces without an extraordinary vertex.
    regular: f64,
}

impl Prepared {
    /// Subdivides j times and decomposes the two-rings of all extraordinary vertices.
    ///
    /// Coordinates are scaled by a power of two to a size of 1 and refined with a bound on their errors
    /// ([`crate::refine::enclosure`]). The subdivisions are local: the estimate needs the two-rings only,
    /// and the whole mesh has them.
    ///
    /// # Errors
    /// As [`estimate`].
    pub fn new(mesh: &Mesh, weights: LoopWeights, local_steps: u32) -> Result<Self, NotApplicable> {
        let scheme = Scheme::Loop(weights);
        crate::refine::topology::check(scheme, &mesh.topology)?;
        let (exponent, mut positions, mut radius) = scaled(mesh)?;
        let mut topology = mesh.topology.clone();
        let mut refiner = Refiner::new(scheme, CornerRule::Smooth);
        let mut parent = None;
        let mut next = Vec::new();
        for _ in 0..local_steps {
            radius = refiner.enclose_into(&topology, &positions, radius, &mut next)?;
            std::mem::swap(&mut positions, &mut next);
            let finer = refine_topology(scheme, &topology)?;
            parent = Some(std::mem::replace(&mut topology, finer));
        }
        let (mut kernels, mut vertices, mut net) = (BTreeMap::new(), Vec::new(), Vec::new());
        for vertex in isolated(&topology)? {
            let valence = topology.valence(vertex);
            let kernel = match kernels.entry(valence) {
                std::collections::btree_map::Entry::Occupied(entry) => entry.into_mut(),
                std::collections::btree_map::Entry::Vacant(entry) => {
                    let kernel = (valence <= table::LARGEST).then(|| Kernel::new(weights, valence));
                    let missing = NotApplicable::NotTabulated {
                        valence,
                        level: 0,
                        largest: table::LARGEST,
                        deepest: table::LAST,
                    };
                    entry.insert(kernel.flatten().ok_or(missing)?)
                }
            };
            gather(&topology, &positions, vertex, &mut net);
            let mut norms = Norms::default();
            kernel.norms(&mut net, radius, &mut norms);
            // Vertices keep their numbers.
            let extended = parent.as_ref().is_some_and(|parent| {
                is_extraordinary(parent, vertex) && obstacle(parent, vertex).is_none()
            });
            vertices.push(Decomposed {
                vertex,
                valence,
                norms,
                extended,
            });
        }
        let second_differences = regular::second_differences(&topology, &positions, radius);
        let mut others = second_differences.clone();
        for at in &vertices {
            for h in topology.fan(at.vertex) {
                others[topology.face_of(h) as usize] = 0.0;
            }
        }
        Ok(Prepared {
            weights,
            local_steps,
            exponent,
            second_differences,
            regular: others.into_iter().fold(0.0, f64::max),
            topology,
            kernels,
            vertices,
        })
    }

    /// The mesh after the local steps.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The weights of an estimator for a valence at a level.
    fn mode_weights(
        &self,
        estimator: Estimator,
        valence: u32,
        m: u32,
    ) -> Result<ModeWeights, NotApplicable> {
        let against = estimator.against();
        let found = |level| {
            table::distances(self.weights, valence, against, level).ok_or(
                NotApplicable::NotTabulated {
                    valence,
                    level,
                    largest: table::LARGEST,
                    deepest: table::LAST,
                },
            )
        };
        match estimator {
            Estimator::TabEigen => {
                let kernel = &self.kernels[&valence];
                Ok(decayed(kernel.eigenvalues(), &found(0)?, m))
            }
            _ => found(m),
        }
    }

    /// What second differences and coefficients are multiplied by for the level-m mesh.
    fn level(&self, estimator: Estimator, m: u32) -> Result<Level, NotApplicable> {
        let local_steps = self.local_steps;
        let level = m.checked_sub(local_steps).ok_or(NotApplicable::Level {
            level: m,
            local_steps,
        })?;
        let weights = self.kernels.keys().map(|&valence| {
            let weights = self.mode_weights(estimator, valence, level)?;
            Ok((valence, weights))
        });
        Ok(Level {
            factor: regular::factor(estimator.against(), level),
            weights: weights.collect::<Result<_, NotApplicable>>()?,
        })
    }

    /// The sums of the sectors at a vertex.
    fn sums(&self, at: &Decomposed, level: &Level, sum: Sum, out: &mut Vec<f64>) {
        self.kernels[&at.valence].sums(&at.norms, &level.weights[&at.valence], sum, out);
    }

    /// For each face of the mesh after the local steps, an upper bound over that face, in the mesh's own unit.
    ///
    /// # Errors
    /// As [`estimate`].
    pub fn face_bounds(
        &self,
        estimator: Estimator,
        m: u32,
        sum: Sum,
    ) -> Result<Vec<f64>, NotApplicable> {
        let level = self.level(estimator, m)?;
        let mut bounds: Vec<f64> = (self.second_differences.iter())
            .map(|m| self.outward(m * level.factor))
            .collect();
        let mut sums = Vec::new();
        for at in &self.vertices {
            self.sums(at, &level, sum, &mut sums);
            for (h, bound) in self.topology.fan(at.vertex).zip(&sums) {
                bounds[self.topology.face_of(h) as usize] = self.outward(*bound);
            }
        }
        Ok(bounds)
    }

    /// The largest of [`Prepared::face_bounds`], from the largest second difference and the vertices alone.
    fn bound(&self, estimator: Estimator, m: u32, sum: Sum) -> Result<f64, NotApplicable> {
        let level = self.level(estimator, m)?;
        let mut sums = Vec::new();
        let mut largest = self.regular * level.factor;
        for at in &self.vertices {
            self.sums(at, &level, sum, &mut sums);
            largest = sums.iter().copied().fold(largest, f64::max);
        }
        Ok(self.outward(largest))
    }

    /// The least level m, from the local steps to [`table::LAST`], whose estimate is at most a tolerance in the
    /// mesh's own unit; `None` if there is none.
    ///
    /// Where the estimate is safe ([`Estimate::safe`]) the distance at that level is at most the tolerance:
    /// bounds are rounded upwards, so that comparing them proves it.
    ///
    /// # Errors
    /// As [`estimate`], but for the level.
    pub fn depth(
        &self,
        estimator: Estimator,
        tolerance: f64,
        sum: Sum,
    ) -> Result<Option<u32>, NotApplicable> {
        for m in self.local_steps..=table::LAST {
            if self.bound(estimator, m, sum)? <= tolerance {
                return Ok(Some(m));
            }
        }
        Ok(None)
    }

    /// A length here in the mesh's own unit, rounded upwards.
    fn outward(&self, x: f64) -> f64 {
        unscaled(x, self.exponent).next_up()
    }

    /// The estimate for the level-m mesh: the largest over its faces.
    ///
    /// # Errors
    /// As [`estimate`].
    pub fn estimate(
        &self,
        estimator: Estimator,
        m: u32,
        sum: Sum,
    ) -> Result<Estimate, NotApplicable> {
        let bound = self.bound(estimator, m, sum)?;
        let (safe, why) = match estimator {
            Estimator::TabApprox => (true, "Corollary 1, with certified distances".to_string()),
            Estimator::TabEigen => {
                let sure = self.bound(Estimator::TabApprox, m, sum)?;
                match bound >= sure {
                    true => (true, format!("at least tab-approx, {sure:.6e}")),
                    false => (false, format!("below tab-approx, {sure:.6e}")),
                }
            }
            _ => match self.outside() {
                None => (true, "Corollary 1, with certified distances".into()),
                Some(at) => (
                    false,
                    format!(
                        "near vertex {} of valence {} the characteristic map leaves the limits of the known facets",
                        at.vertex, at.valence
                    ),
                ),
            },
        };
        Ok(Estimate { bound, safe, why })
    }

    /// A vertex whose characteristic map leaves the limit facets over S_n, where those beyond them are not
    /// known to be the mesh's own.
    fn outside(&self) -> Option<&Decomposed> {
        let known = |at: &&Decomposed| !(at.extended || stays_inside(at.valence) == Some(true));
        self.vertices.iter().find(known)
    }
}

/// `x 2^exponent`, in two halves of a power of two that may itself be out of range.
pub(crate) fn unscaled(x: f64, exponent: i32) -> f64 {
    let half = exponent / 2;
    x * 2f64.powi(half) * 2f64.powi(exponent - half)
}

/// The positions over 2^exponent, of a size from 1 to 2, and a bound of what underflow takes from them.
pub(crate) fn scaled(mesh: &Mesh) -> Result<(i32, Vec<Point<f64>>, f64), RefineError> {
    let largest = largest_coordinate(&mesh.positions)?;
    if largest == 0.0 {
        return Ok((0, mesh.positions.clone(), 0.0));
    }
    let exponent = largest.log2().floor() as i32;
    let half = -exponent / 2;
    let (a, b) = (2f64.powi(half), 2f64.powi(-exponent - half));
    let scale = |p: &Point<f64>| Point(p.0.map(|x| x * a * b));
    let positions = mesh.positions.iter().map(scale).collect();
    // Powers of two change no digit but of subnormal results.
    Ok((exponent, positions, 2.0 * f64::MIN_POSITIVE))
}
