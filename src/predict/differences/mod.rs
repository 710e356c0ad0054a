//! Upper bounds of the parametric distance between surface and level-k mesh, from second differences of the
//! control points and certified constants, without refining: for every scheme, mesh and level.
//!
//! **Ready faces.** Let all corners of a face be regular but for one (as the scheme sees it: a boundary vertex of
//! three triangles, or two quads, is regular). Then, M the largest second difference round the face,
//!
//! ```text
//! |S - F_k| <= C_k M,      |S - L_k| <= B_k M
//! ```
//!
//! over the face, with the constants of the one irregular corner ([`constants`]; proved by [`crate::bound`], or
//! from [`star`]). M is the norm of HW (1) for Loop, CY's second-order norm for Catmull-Clark, and that of
//! [`crate::scheme::doo_sabin::face_differences`] for Doo-Sabin, where faces have the vertices' part.
//!
//! **Other faces** become ready in one step (Loop, quads) or two (polygons; Doo-Sabin). The step is taken, all
//! at once with a bound on its errors, or, for Loop, spared: M(child) <= R M ([`crate::bound::face_rate`]).
//!
//! **Local subdivisions.** After j steps M is that of the children: the bound at level k >= j uses D_(k-j), and
//! is sharper. Loop's last step is a formula for the new differences ([`triangles`]). Of the bounds by 0, ..,
//! min(j, k) local steps the least counts.
//!
//! **In floats.** Lengths carry an absolute bound for all roundings and a relative one for their own; constants
//! are rounded upward. So each bound is a theorem about the coordinates as stored.
//!
//! | file | idea |
//! |---|---|
//! | [`constants`] | D_k of a vertex: table and recurrence |
//! | [`star`] | bounds for vertices that no table knows: large valences, boundaries |
//! | [`triangles`], [`quads`], [`quarters`] | M of the ready faces of a mesh, per scheme |
//! | `clusters`, [`MovingMesh`] | the same for one connectivity and many positions |
//! | `maker`, `stage`, `unit`, [`connectivity`] | local steps; the faces after them; their unit and connectivity |
//! | [`LocalSteps`] | bounds by 0, 1, .. local steps, one after the other |
//! | [`levels`], [`MeshBounds`] | from ready faces to a bound at each level |

use rayon::prelude::*;

use crate::bound::Against;
use crate::mesh::{Mesh, Topology};
use crate::refine::RefineError;
use crate::scheme::{CornerRule, Scheme};

mod clusters;
pub mod connectivity;
pub mod constants;
pub mod levels;
mod local_steps;
mod maker;
mod moving;
pub mod quads;
pub mod quarters;
mod stage;
pub mod star;
pub mod triangles;
mod unit;
mod vector;
mod whole;

use levels::{Lengths, Seen};
pub use local_steps::LocalSteps;
use maker::Maker;
pub use moving::MovingMesh;
use stage::{BLOCK, Stage};
pub use whole::MeshBounds;

/// What is bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Request {
    /// The scheme that defines the surface.
    pub scheme: Scheme,
    /// What one-face boundary vertices do.
    pub corner: CornerRule,
    /// Control or limit meshes. (Doo-Sabin's limit meshes have no constants: their bounds are infinite.)
    pub against: Against,
    /// Local subdivisions j before the constants are used, at most [`Bounds::MOST_STEPS`].
    pub local_steps: u32,
}

impl Request {
    /// Whether the scheme takes the mesh.
    fn check(&self, topology: &Topology) -> Result<(), RefineError> {
        let most = Bounds::MOST_STEPS;
        assert!(self.local_steps <= most, "at most two local steps");
        crate::refine::topology::check(self.scheme, topology)
    }
}

/// Upper bounds of the parametric distances between surface and level-k meshes, for all k: of the mesh, and of
/// the surface over each of its faces.
#[derive(Clone, Debug)]
pub struct Bounds<'a> {
    /// By 0, 1, .., j local steps.
    stages: Vec<Stage<'a>>,
    mesh: MeshBounds,
    faces: u32,
}

impl<'a> Bounds<'a> {
    /// The deepest level that is looked at.
    pub const DEEPEST: u32 = MeshBounds::DEEPEST;

    /// The largest number of local steps.
    pub const MOST_STEPS: u32 = 2;

    /// Prepares the bounds of a mesh.
    ///
    /// # Errors
    /// If and only if the scheme refuses the mesh, a coordinate is not finite, or there is not one position for
    /// each vertex; or if a local step would be too large for 32-bit indices.
    ///
    /// # Panics
    /// If there are more than [`Bounds::MOST_STEPS`] local steps.
    pub fn new(mesh: &'a Mesh, request: &Request) -> Result<Self, RefineError> {
        request.check(&mesh.topology)?;
        let mut maker = Maker::new(request, &mesh.topology, &mesh.positions)?;
        let steps = 0..=request.local_steps as usize;
        let stages: Result<Vec<_>, _> = steps.map(|j| maker.stage(j)).collect();
        let stages = stages?;
        Ok(Bounds {
            mesh: MeshBounds {
                stages: stages.iter().map(Stage::bounds).collect(),
            },
            stages,
            faces: mesh.topology.face_count(),
        })
    }

    /// An upper bound of the distance at level k: [`MeshBounds::at`].
    pub fn at(&self, k: u32) -> f64 {
        self.mesh.at(k)
    }

    /// The least k whose bound is at most the tolerance: [`MeshBounds::depth`].
    pub fn depth(&self, tolerance: f64) -> Option<u32> {
        self.mesh.depth(tolerance)
    }

    /// For each face of the mesh the least level at which its own bound is at most the tolerance; `None` if
    /// there is none up to [`Bounds::DEEPEST`]. 0 for faces without a surface.
    pub fn face_depths(&self, tolerance: f64) -> Vec<Option<u32>> {
        self.by_face(|lengths, stages| {
            let mut k = 0;
            while k <= Self::DEEPEST && self.face_bound(lengths, stages, k) > tolerance {
                k += 1;
            }
            (k <= Self::DEEPEST).then_some(k)
        })
    }

    /// For each face of the mesh an upper bound over it at level k, in the mesh's own unit.
    pub fn face_bounds(&self, k: u32) -> Vec<f64> {
        self.by_face(|lengths, stages| self.face_bound(lengths, stages, k))
    }

    fn face_bound(&self, lengths: &[Lengths], stages: &[Stage<'a>], k: u32) -> f64 {
        let pairs = lengths.iter().zip(stages).take(k as usize + 1);
        let bounds = pairs.map(|(lengths, stage)| {
            let bound = lengths.bound(&stage.kinds, k as usize);
            whole::in_unit(stage.exponent, bound)
        });
        bounds.fold(f64::INFINITY, f64::min)
    }

    fn by_face<T: Send>(&self, of: impl Fn(&[Lengths], &[Stage<'a>]) -> T + Sync) -> Vec<T> {
        let room = || (Seen::default(), vec![Lengths::default(); self.stages.len()]);
        let face = |(seen, lengths): &mut (Seen, Vec<Lengths>), face: u32| {
            for (stage, lengths) in self.stages.iter().zip(lengths.iter_mut()) {
                seen.clear();
                stage.visit(face, seen);
                lengths.set(seen, &stage.outward);
            }
            of(lengths, &self.stages)
        };
        let faces = (0..self.faces).into_par_iter().with_min_len(BLOCK as usize);
        faces.map_init(room, face).collect()
    }
}
