//! The parametric distance: the supremum of |S(u) - F(u)| over a face and over a mesh.
//!
//! A face is covered by polynomial patches of S - F and by nets at its irregular points. Patches are
//! halved and nets split, always the one with the largest upper bound first. Upper bounds: the
//! convex hull of the Bernstein coefficients; at an irregular point, where infinitely many rings of
//! patches remain, the hull of the net (S lies in it, F in the hull of its corners); at a smooth
//! maximum [`super::close`]. Lower bounds: values at corners, which are coefficients, at irregular
//! points (limit masks), and at the maximisers that `close` proposes.
//!
//! *Order of faces.* Results don't depend on the thread count: a face is measured with a floor (a
//! length that the mesh's distance is already known to reach) that is fixed before its block of
//! faces begins, and blocks have fixed sizes.

use rayon::prelude::*;

use super::close::close;
use super::model::{Gathered, Model};
use super::search::Queue;
use crate::bernstein::Patch;
use crate::patch::rounding::Extent;
use crate::patch::{Corners, Sink, Space};
use num_traits::Zero;

/// How hard to try on one face.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Relative gap to reach.
    pub gap: f64,
    /// A length that the whole mesh's distance is known to reach: cells below it are of no interest.
    pub floor: f64,
    /// Number of cells after which to stop undecided.
    pub cells: u32,
    /// Number of halvings after which closing by concavity is tried.
    pub close_after: u32,
}

/// The enclosure of the distance over one face.
#[derive(Clone, Debug)]
pub struct FaceEnclosure<A: Space> {
    /// The distance is at least this (a certified length in the unit of the positions).
    pub lo: f64,
    /// The distance is at most this.
    pub hi: f64,
    /// The squared length behind `lo`, before rounding bounds.
    pub lower: A::Square,
    /// The squared length behind `hi`, before rounding bounds.
    pub upper: A::Square,
    /// Parameters of the point that attains `lo`.
    pub at: [f64; 2],
    /// S - F there.
    pub value: A::Point,
    /// A length at the level of the rounding bound: cells below it were not pursued. 0 in exact
    /// arithmetic.
    pub noise: f64,
    /// Whether the search ended because it was close enough.
    pub met: bool,
    /// Number of cells visited.
    pub cells: u32,
}

enum Cell<B, N> {
    Patch {
        patch: B,
        corners: Corners,
        halvings: u32,
    },
    Net(N),
}

/// The state of a search on one face; its memory is reused from face to face.
pub struct Workspace<A: Space, M: Model<A>> {
    cells: Cells<A, M>,
    scratch: M::Scratch,
    pending: Vec<M::Net>,
}

struct Cells<A: Space, M: Model<A>> {
    queue: Queue<A::Square, Cell<M::Patch, M::Net>>,
    spare: Vec<M::Net>,
    /// Nets that a split has just yielded.
    fresh: Vec<M::Net>,
    lower: A::Square,
    at: [f64; 2],
    value: A::Point,
    /// Cells with a bound up to here are closed at once.
    cutoff: A::Square,
    gap: f64,
    steps: u32,
    halvings: u32,
    largest: A::Square,
}

impl<A: Space, M: Model<A>> Default for Workspace<A, M> {
    fn default() -> Self {
        Workspace {
            cells: Cells {
                queue: Queue::new(A::zero()),
                spare: Vec::new(),
                fresh: Vec::new(),
                lower: A::zero(),
                at: [0.0; 2],
                value: A::Point::zero(),
                cutoff: A::zero(),
                gap: 0.0,
                steps: 0,
                halvings: 0,
                largest: A::zero(),
            },
            scratch: M::Scratch::default(),
            pending: Vec::new(),
        }
    }
}

impl<A: Space, M: Model<A>> Cells<A, M> {
    fn raise(&mut self, lower: A::Square, at: [f64; 2], value: &A::Point) {
        if lower > self.lower {
            let cutoff = A::relax(&lower, self.gap);
            if cutoff > self.cutoff {
                self.cutoff = cutoff;
            }
            self.lower = lower;
            self.at = at;
            self.value = value.clone();
        }
    }

    fn add_net(&mut self, upper: A::Square, net: M::Net) {
        if upper > self.cutoff {
            self.queue.push(upper, Cell::Net(net));
        } else {
            self.queue.close(upper);
            self.spare.push(net);
        }
    }

    fn add_patch(&mut self, patch: &M::Patch, corners: Corners, halvings: u32) {
        self.halvings = self.halvings.max(halvings);
        let coefficients = patch.coefficients();
        for corner in 0..M::Patch::CORNERS {
            let value = &coefficients[M::Patch::corner_index(corner)];
            self.raise(A::lower(value), corners[corner], value);
        }
        let upper = A::largest(coefficients);
        if halvings == 0 && upper > self.largest {
            self.largest = upper.clone();
        }
        if upper > self.cutoff {
            let patch = patch.clone();
            self.queue.push(
                upper,
                Cell::Patch {
                    patch,
                    corners,
                    halvings,
                },
            );
        } else {
            self.queue.close(upper);
        }
    }
}

impl<A: Space, M: Model<A>> Sink<M::Patch, M::Net> for Cells<A, M> {
    fn patch(&mut self, patch: &M::Patch, corners: Corners, steps: u32) {
        self.steps = self.steps.max(steps);
        self.add_patch(patch, corners, 0);
    }

    fn spare(&mut self) -> M::Net {
        self.spare.pop().unwrap_or_default()
    }

    fn net(&mut self, net: M::Net) {
        self.fresh.push(net);
    }

    fn discard(&mut self, net: M::Net) {
        self.spare.push(net);
    }
}

impl<A: Space, M: Model<A>> Workspace<A, M> {
    /// Bounds the nets that the last split yielded, splitting at once those without a useful bound.
    fn settle_nets(&mut self, model: &M) {
        std::mem::swap(&mut self.pending, &mut self.cells.fresh);
        while let Some(net) = self.pending.pop() {
            if model.splits_at_once(&net) {
                model.split(&net, &mut self.scratch, &mut self.cells);
                self.cells.spare.push(net);
                self.pending.append(&mut self.cells.fresh);
            } else {
                let (value, at) = model.net_value(&net);
                self.cells.raise(A::lower(&value), at, &value);
                let upper = model.net_upper(&net);
                self.cells.add_net(upper, net);
            }
        }
    }

    /// Encloses the distance over one face; `None` if the face has no surface.
    ///
    /// `mesh_radius` bounds the error of the positions, per coordinate.
    pub fn enclose_face(
        &mut self,
        model: &M,
        face: u32,
        mesh_radius: f64,
        effort: Effort,
    ) -> Option<FaceEnclosure<A>> {
        let cells = &mut self.cells;
        cells.queue.clear(A::zero());
        cells.fresh.clear();
        (cells.lower, cells.at, cells.value) = (A::zero(), [0.0; 2], A::Point::zero());
        (cells.gap, cells.steps, cells.halvings) = (effort.gap, 0, 0);
        cells.largest = A::zero();
        cells.cutoff = A::relax(&A::square(effort.floor), effort.gap);
        let Gathered { size, arity } = model.open(face, &mut self.scratch, cells);
        let extent = Extent {
            size,
            arity,
            mesh_radius,
        };
        self.settle_nets(model);
        if self.cells.queue.pushed() == 0 && arity == 0 {
            return None;
        }
        // Distances at the level of the rounding bound are as good as known.
        let noise = if size > 0.0 {
            16.0 * extent.radius(4, 8, 0.0)
        } else {
            0.0
        };
        if A::square(noise) > self.cells.cutoff {
            self.cells.cutoff = A::square(noise);
        }
        let met = loop {
            match self.cells.queue.top() {
                None => break true,
                Some(top) if *top <= self.cells.cutoff => break true,
                Some(_) if self.cells.queue.pushed() > effort.cells => break false,
                Some(_) => {}
            }
            let Some((upper, cell)) = self.cells.queue.pop() else {
                break true;
            };
            match cell {
                Cell::Net(net) => {
                    model.split(&net, &mut self.scratch, &mut self.cells);
                    self.cells.spare.push(net);
                    self.settle_nets(model);
                }
                Cell::Patch {
                    patch,
                    corners,
                    halvings,
                } => {
                    if halvings >= effort.close_after
                        && let Some(closed) = close::<A, M::Patch>(&patch)
                    {
                        self.cells.raise(
                            closed.lower,
                            place::<A, M>(&corners, closed.at),
                            &closed.value,
                        );
                        let better = if closed.upper < upper {
                            closed.upper
                        } else {
                            upper.clone()
                        };
                        if better <= self.cells.cutoff {
                            self.cells.queue.close(better);
                            continue;
                        }
                    }
                    for (half, corners) in patch.halve(&corners) {
                        self.cells.add_patch(&half, corners, halvings + 1);
                    }
                }
            }
        };
        let cells = &self.cells;
        let upper = cells.queue.upper();
        let radius = extent.radius(
            cells.steps + 1,
            cells.halvings,
            A::estimate(&cells.largest).sqrt(),
        );
        let [lo, hi] = A::lengths(&cells.lower, &upper, radius);
        Some(FaceEnclosure {
            lo,
            hi,
            lower: cells.lower.clone(),
            upper,
            at: cells.at,
            value: cells.value.clone(),
            noise: noise + 4.0 * radius,
            met,
            cells: cells.queue.pushed(),
        })
    }
}

/// Parameters in the face of local parameters in a patch with the given corners.
fn place<A: Space, M: Model<A>>(corners: &Corners, at: [f64; 2]) -> [f64; 2] {
    let last = if M::Patch::CORNERS == 3 { 2 } else { 3 };
    std::array::from_fn(|i| {
        let [o, v, w] = [corners[0][i], corners[1][i], corners[last][i]];
        o + at[0] * (v - o) + at[1] * (w - o)
    })
}

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
