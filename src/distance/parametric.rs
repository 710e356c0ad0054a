//! The parametric distance over a mesh: the supremum of |S(u) - F(u)|, face by face ([`super::face`]).
//!
//! *Order of faces.* Results don't depend on the thread count: a face is measured with a floor (a
//! length that the mesh's distance is already known to reach) that is fixed before its block of
//! faces begins, and blocks have fixed sizes.

use rayon::prelude::*;

use super::face::{Effort, FaceEnclosure, Workspace};
use super::model::Model;
use crate::patch::Space;

/// What to measure, and how well.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// Relative gap `(hi - lo) / hi` for the mesh.
    pub gap: f64,
    /// Relative gap for every face by itself; `None` if only the mesh matters.
    pub face_gap: Option<f64>,
    /// Number of cells in one face after which it is left undecided.
    pub cells: u32,
}

impl Default for Goal {
    fn default() -> Self {
        Goal {
            gap: 1e-6,
            face_gap: None,
            cells: 1_000_000,
        }
    }
}

/// The point that attains the lower bound.
#[derive(Clone, Debug)]
pub struct WitnessAt<A: Space> {
    /// Face of the level-K mesh.
    pub face: u32,
    /// Quarter of the face, if it is measured by quarters: the place of its vertex in the face.
    pub quarter: Option<u32>,
    /// Parameters in the face or quarter.
    pub at: [f64; 2],
    /// F there, relative to the face's first corner.
    pub mesh_point: A::Point,
    /// S there, relative to the face's first corner.
    pub surface_point: A::Point,
}

/// A certified enclosure of the distance over a mesh.
#[derive(Clone, Debug)]
pub struct MeshEnclosure<A: Space> {
    /// The distance is at least this.
    pub lo: f64,
    /// The distance is at most this.
    pub hi: f64,
    /// Squared lengths behind `lo` and `hi` (exact in exact arithmetic).
    pub squares: [A::Square; 2],
    /// Where `lo` is attained; `None` if `lo` is 0.
    pub witness: Option<WitnessAt<A>>,
    /// Whether every face reached the face gap, if one was asked for.
    pub faces_met: bool,
    /// The largest length at the level of the rounding bound of a face; 0 in exact arithmetic.
    pub noise: f64,
    /// Per-face enclosures if a face gap was asked for; `None` for faces without surface.
    pub faces: Option<Vec<Option<[f64; 2]>>>,
    /// Number of faces with surface.
    pub measured: u32,
    /// Number of cells visited.
    pub cells: u64,
}

impl<A: Space> MeshEnclosure<A> {
    fn include_lower(&mut self, face: u32, enclosure: &FaceEnclosure<A>, model: &impl Model<A>) {
        if enclosure.lo > self.lo || (enclosure.lower > self.squares[0] && enclosure.lo >= self.lo)
        {
            self.lo = enclosure.lo;
            self.squares[0] = enclosure.lower.clone();
            let (quarter, at) = model.locate(face, enclosure.at);
            let mesh_point = model.mesh_point(face, enclosure.at);
            let surface_point = mesh_point.clone() + &enclosure.value;
            self.witness = Some(WitnessAt {
                face,
                quarter,
                at,
                mesh_point,
                surface_point,
            });
        }
    }
}

/// First block of faces; blocks double up to [`LAST_BLOCK`].
const FIRST_BLOCK: u32 = 256;
const LAST_BLOCK: u32 = 1 << 16;
/// Faces per round of the second pass.
const ROUND: usize = 32;
/// Gap of the first pass when faces by themselves don't matter.
const LOOSE_GAP: f64 = 0.1;

/// Encloses `sup |S - F|` over all faces of the model.
///
/// `mesh_radius` bounds the error of the positions per coordinate (0 if they are exact); `progress`
/// is told the number of faces done. Pass one measures each face to a loose gap, in blocks whose
/// floor is the lower bound of all earlier blocks. Pass two takes the faces that may still exceed
/// the lower bound by more than the gap, the largest upper bound first, in rounds with a fixed floor.
///
/// `None` if no face has a surface.
pub fn enclose_mesh<A: Space, M: Model<A>>(
    model: &M,
    mesh_radius: f64,
    goal: Goal,
    progress: &(dyn Fn(u32) + Sync),
) -> Option<MeshEnclosure<A>> {
    let count = model.face_count();
    let mut result = MeshEnclosure {
        lo: 0.0,
        hi: 0.0,
        squares: [A::zero(), A::zero()],
        witness: None,
        faces_met: true,
        faces: goal.face_gap.map(|_| Vec::with_capacity(count as usize)),
        measured: 0,
        cells: 0,
        noise: 0.0,
    };
    let target = 0.9 * goal.gap;
    let first_gap = goal.face_gap.unwrap_or_else(|| LOOSE_GAP.max(target));
    // Largest bound of the faces that are settled, and those that are not, with their bounds.
    let mut settled = (0.0_f64, A::zero());
    let mut open: Vec<(u32, f64, A::Square)> = Vec::new();
    let settle = |settled: &mut (f64, A::Square), hi: f64, square: &A::Square| {
        settled.0 = settled.0.max(hi);
        if *square > settled.1 {
            settled.1 = square.clone();
        }
    };
    let (mut start, mut size) = (0, FIRST_BLOCK);
    while start < count {
        let end = count.min(start.saturating_add(size));
        let effort = Effort {
            gap: first_gap,
            floor: if goal.face_gap.is_some() {
                0.0
            } else {
                result.lo
            },
            cells: if goal.face_gap.is_some() {
                goal.cells
            } else {
                20_000
            },
            close_after: if first_gap < 1e-3 { 6 } else { 12 },
        };
        let block: Vec<Option<FaceEnclosure<A>>> = (start..end)
            .into_par_iter()
            .with_min_len(32)
            .map_init(Workspace::<A, M>::default, |workspace, face| {
                workspace.enclose_face(model, face, mesh_radius, effort)
            })
            .collect();
        for (face, enclosure) in (start..end).zip(&block) {
            if let Some(enclosure) = enclosure {
                result.include_lower(face, enclosure, model);
            }
        }
        for (face, enclosure) in (start..end).zip(block) {
            if let Some(faces) = &mut result.faces {
                faces.push(enclosure.as_ref().map(|e| [e.lo, e.hi]));
            }
            let Some(enclosure) = enclosure else { continue };
            result.measured += 1;
            result.faces_met &= enclosure.met || goal.face_gap.is_none();
            result.noise = result.noise.max(enclosure.noise);
            result.cells += u64::from(enclosure.cells);
            if enclosure.hi > result.lo {
                open.push((face, enclosure.hi, enclosure.upper));
            } else {
                settle(&mut settled, enclosure.hi, &enclosure.upper);
            }
        }
        progress(end);
        (start, size) = (end, LAST_BLOCK.min(size.saturating_mul(2)));
    }
    if result.measured == 0 {
        return None;
    }
    // Pass two.
    let enough = |lo: f64, hi: f64| hi <= lo * (1.0 + target);
    open.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut round = 0;
    while round < open.len() && !enough(result.lo, open[round].1) {
        let end = open.len().min(round + ROUND);
        let effort = Effort {
            gap: 0.9 * target,
            floor: result.lo,
            cells: goal.cells,
            close_after: 6,
        };
        let lo = result.lo;
        let done: Vec<Option<FaceEnclosure<A>>> = open[round..end]
            .par_iter()
            .with_max_len(1)
            .map_init(Workspace::<A, M>::default, |workspace, (face, hi, _)| {
                (!enough(lo, *hi))
                    .then(|| workspace.enclose_face(model, *face, mesh_radius, effort))
                    .flatten()
            })
            .collect();
        for ((face, hi, square), enclosure) in open[round..end].iter().zip(done) {
            match enclosure {
                Some(enclosure) => {
                    result.cells += u64::from(enclosure.cells);
                    result.noise = result.noise.max(enclosure.noise);
                    result.include_lower(*face, &enclosure, model);
                    let better = enclosure.upper < *square;
                    let upper = if better { &enclosure.upper } else { square };
                    settle(&mut settled, enclosure.hi.min(*hi), upper);
                    if let Some(faces) = &mut result.faces
                        && let Some([old_lo, old_hi]) = &mut faces[*face as usize]
                    {
                        *old_lo = old_lo.max(enclosure.lo);
                        *old_hi = old_hi.min(enclosure.hi);
                    }
                }
                None => settle(&mut settled, *hi, square),
            }
        }
        round = end;
    }
    for (_, hi, square) in &open[round..] {
        settle(&mut settled, *hi, square);
    }
    result.hi = settled.0;
    result.squares[1] = settled.1;
    Some(result)
}
