//! Refinement of meshes, in any arithmetic.
//!
//! | question | function |
//! |---|---|
//! | the mesh after k steps | [`refine`] |
//! | its connectivity, and how its indices follow from the parent's | [`refine_topology`], [`topology`] |
//! | its positions only | [`refine_positions`], [`Refiner`] (reuses memory) |
//! | where vertices go in the limit | [`limit_positions`] |
//! | all of that as a certified enclosure, at the speed of `f64` | [`enclose_refined`], [`enclosure`] |
//! | exactly, in integers, where masks are dyadic | [`Grid`], [`grid`] |
//!
//! Boundaries: cubic B-spline rules for Loop and Catmull-Clark ([`crate::scheme::boundary`]), with
//! [`CornerRule::Sharp`] vertices of one face stay; none for Doo-Sabin. Isolated vertices stay where
//! they are (Doo-Sabin drops them).
//!
//! ```
//! use subcert::mesh::{Mesh, Point, Topology};
//! use subcert::refine::refine;
//! use subcert::scheme::{CornerRule, Scheme};
//!
//! let topology = Topology::from_uniform(4, 4, vec![0, 1, 2, 3]).unwrap();
//! let corner = |x, y| Point([x, y, 0.0]);
//! let positions = vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
//! let mesh = Mesh { topology, positions };
//! let fine = refine(Scheme::CatmullClark, CornerRule::Smooth, &mesh, 1).unwrap();
//! assert_eq!(fine.topology.face_count(), 4);
//! assert_eq!(fine.positions[0], corner(0.125, 0.125)); // 6/8 (0,0) + 1/8 ((1,0) + (0,1))
//! assert_eq!(fine.positions[8], corner(0.5, 0.5)); // the face point
//! ```

mod corners;
mod doo_sabin;
pub mod enclosure;
mod error;
pub mod grid;
mod masks;
mod positions;
mod star;
pub mod topology;

pub use enclosure::{Enclosed, enclose_limits, enclose_refined, position_error_bound};
pub use error::RefineError;
pub use grid::Grid;
pub use topology::{refine_topology, refine_topology_into};

use std::marker::PhantomData;

use masks::{Masks, Present, Target};

use crate::mesh::{Mesh, Point, Topology};
use crate::scalar::{Field, Module};
use crate::scheme::{CornerRule, Scheme};

/// The mesh after `levels` steps of `scheme`.
///
/// Guarantee per arithmetic: rational and cyclotomic positions are exact, intervals contain the exact
/// ones, `f64` is a proposal.
///
/// # Errors
/// If and only if the scheme refuses the mesh ([`topology::check`]), the arithmetic has no value for a
/// weight, the positions are not one per vertex, or a corner rule is given to Doo-Sabin.
pub fn refine<S: Field>(
    scheme: Scheme,
    corner: CornerRule,
    mesh: &Mesh<S>,
    levels: u32,
) -> Result<Mesh<S>, RefineError> {
    let mut refiner = Refiner::new(scheme, corner);
    let mut mesh = mesh.clone();
    for _ in 0..levels {
        let mut positions = Vec::new();
        refiner.positions_into::<S>(&mesh.topology, &mesh.positions, &mut positions)?;
        mesh = Mesh {
            topology: refine_topology(scheme, &mesh.topology)?,
            positions,
        };
    }
    Ok(mesh)
}

/// The positions after one step, in the vertex order of [`refine_topology`].
///
/// S is the type of the weights, V that of the points: numbers or [`Point`]s over S.
///
/// # Errors
/// As [`refine`].
pub fn refine_positions<S: Field, V: Module<S> + Send + Sync>(
    scheme: Scheme,
    corner: CornerRule,
    topology: &Topology,
    positions: &[V],
) -> Result<Vec<V>, RefineError> {
    let mut out = Vec::new();
    Refiner::new(scheme, corner).positions_into::<S>(topology, positions, &mut out)?;
    Ok(out)
}

/// The limit position of every vertex.
///
/// - Loop: `(1 - n w) P + w Σ P_i`, `w = 8b / (3 + 8 n b)`.
/// - Catmull-Clark: `(n(n-1) P + 2 Σ e_i + 4 Σ f'_i) / (n (n+5))`, f' the next level's face points.
/// - both on the boundary: `4/6 P + 1/6 (a + b)`; a pinned corner is its own limit.
/// - Doo-Sabin: the mean over the faces at the vertex of their new corners there. For an interior
///   vertex this is the centroid of its face on the next level, hence the surface point at the
///   vertex; for a boundary vertex it is this library's convention (the surface does not reach it).
///
/// # Errors
/// As [`refine`].
pub fn limit_positions<S: Field, V: Module<S> + Send + Sync>(
    scheme: Scheme,
    corner: CornerRule,
    topology: &Topology,
    positions: &[V],
) -> Result<Vec<V>, RefineError> {
    let mut out = Vec::new();
    Refiner::new(scheme, corner).limits_into::<S>(topology, positions, &mut out)?;
    Ok(out)
}

/// Refinement of points V into memory that the caller keeps; it needs none of its own.
#[derive(Clone, Debug)]
pub struct Refiner<V = Point<f64>> {
    scheme: Scheme,
    corner: CornerRule,
    points: PhantomData<V>,
}

impl<V> Refiner<V> {
    /// A refiner by these rules.
    pub fn new(scheme: Scheme, corner: CornerRule) -> Self {
        Refiner {
            scheme,
            corner,
            points: PhantomData,
        }
    }

    fn masks<S: Field>(
        &self,
        target: Target,
        topology: &Topology,
        positions: &[V],
    ) -> Result<Masks<S>, RefineError> {
        positions::check_arguments(self.scheme, self.corner, topology, positions)?;
        topology::check(self.scheme, topology)?;
        let present = Present::new(self.scheme, target, topology);
        Masks::new(self.scheme, target, &present, 1)
    }

    /// [`refine_positions`] into the memory of `out`, whose old contents are lost.
    ///
    /// # Errors
    /// As [`refine`].
    pub fn positions_into<S: Field>(
        &mut self,
        topology: &Topology,
        positions: &[V],
        out: &mut Vec<V>,
    ) -> Result<(), RefineError>
    where
        V: Module<S> + Send + Sync,
    {
        let masks = self.masks::<S>(Target::Refined, topology, positions)?;
        positions::refined(&masks, self.corner, topology, positions, out);
        Ok(())
    }

    /// [`limit_positions`] into the memory of `out`, whose old contents are lost.
    ///
    /// # Errors
    /// As [`refine`].
    pub fn limits_into<S: Field>(
        &mut self,
        topology: &Topology,
        positions: &[V],
        out: &mut Vec<V>,
    ) -> Result<(), RefineError>
    where
        V: Module<S> + Send + Sync,
    {
        let masks = self.masks::<S>(Target::Limit, topology, positions)?;
        positions::limits(&masks, self.corner, topology, positions, out);
        Ok(())
    }
}
