//! The branch and bound of one side: `sup over a in A of dist(a, B)`.
//!
//! A piece of A, all of it within its thickness of its corners' interpolant, is closed as soon as one
//! triangle of B is near enough to all its corners ([`super::probe`]); else the distance of its
//! farthest corner is looked up, which may raise the lower bound, and the piece is split.
//!
//! *Order.* Work is done in rounds of tasks. A task knows the lower bound at the start of its round
//! and what it found itself, never what other tasks have found: results don't depend on the number
//! of threads. Only the clock of a budget can end a round early.

use std::time::Instant;

use rayon::prelude::*;

use super::bvh::Tree;
use super::metric::{foot, length};
use super::probe::{Found, Probe, Storage, nearest};
use super::shape::Shape;
use crate::distance::search::Queue;
use crate::patch::Lane;

/// How near the bounds must come, in the frame's unit.
#[derive(Clone, Copy, Debug)]
pub struct Closeness {
    /// Absolute gap.
    pub absolute: f64,
    /// Relative gap.
    pub relative: f64,
    /// Lengths up to this are at the level of rounding errors.
    pub noise: f64,
    /// Number of pieces after which to stop undecided.
    pub cells: u64,
    /// When to stop in any case.
    pub deadline: Option<Instant>,
}

impl Closeness {
    /// Pieces with a bound up to this are of no interest once `lo` is a lower bound: then
    /// `hi - lo <= absolute + relative hi`, with a twentieth to spare for what is rounded later.
    pub fn cutoff(&self, lo: f64) -> f64 {
        let near = (lo + 0.95 * self.absolute) / (1.0 - 0.95 * self.relative);
        near.max(self.noise)
    }

    /// What a probe may leave undecided.
    fn tolerance(&self, lo: f64) -> f64 {
        ((self.cutoff(lo) - lo) / 16.0).max(0.25 * self.noise)
    }

    /// Whether the budget is spent.
    pub fn late(&self) -> bool {
        self.deadline
            .is_some_and(|deadline| Instant::now() >= deadline)
    }
}

/// A point of A, and what is known of its distance to B.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// The distance is at least this.
    pub lower: f64,
    /// The point.
    pub point: Lane,
    /// A point of B (or within the probe's tolerance of it) near by.
    pub foot: Lane,
    /// Face of A's mesh.
    pub face: u32,
    /// Face of B's mesh.
    pub foot_face: u32,
}

/// What is to be bounded.
pub enum Start<P> {
    /// A whole item.
    Item(u32),
    /// A piece of a face.
    Piece(Box<P>),
}

/// A part of A with a bound of its distance; infinite if nothing is known.
pub struct Open<P> {
    /// The bound.
    pub bound: f64,
    /// Face of A's mesh.
    pub face: u32,
    /// The part.
    pub start: Start<P>,
}

/// An enclosure of one side, in the frame's unit.
#[derive(Clone, Debug, Default)]
pub struct Enclosure {
    /// The distance is at least this.
    pub lo: f64,
    /// The distance is at most this.
    pub hi: f64,
    /// Where `lo` was found.
    pub sample: Option<Sample>,
    /// Faces of A with the largest bounds of their parts, if above `lo` at the time.
    pub holders: Vec<(u32, f64)>,
    /// Pieces looked at.
    pub cells: u64,
    /// Probes made.
    pub probes: u64,
}

impl Enclosure {
    /// Takes a lower bound.
    pub fn include(&mut self, sample: Sample) {
        if sample.lower > self.lo {
            self.lo = sample.lower;
            self.sample = Some(sample);
        }
    }

    /// Takes the bound of a part that is closed.
    pub fn close(&mut self, face: u32, bound: f64) {
        self.hi = self.hi.max(bound);
        if bound > self.lo {
            match self.holders.last_mut() {
                Some((last, held)) if *last == face => *held = held.max(bound),
                _ => self.holders.push((face, bound)),
            }
        }
    }
}

/// The two sets, and how near the bounds must come.
pub struct Search<'a, A: Shape, B: Shape> {
    /// A.
    pub source: &'a A,
    /// B.
    pub target: &'a B,
    /// B's boxes.
    pub tree: &'a Tree,
    /// What a computed distance can be off by.
    pub error: f64,
    /// When to stop.
    pub closeness: Closeness,
}

/// Storage of a thread.
struct Workspace<A: Shape, B: Shape> {
    scratch: A::Scratch,
    fresh: Vec<A::Piece>,
    storage: Storage<B>,
    queue: Queue<f64, A::Piece>,
}

impl<A: Shape, B: Shape> Default for Workspace<A, B> {
    fn default() -> Self {
        Workspace {
            scratch: A::Scratch::default(),
            fresh: Vec::new(),
            storage: Storage::default(),
            queue: Queue::new(0.0),
        }
    }
}

/// What a task found.
struct Done<P> {
    face: u32,
    sample: Option<Sample>,
    closed: f64,
    left: Vec<Open<P>>,
    cells: u64,
    probes: u64,
}

/// Pieces that a task may look at.
const TASK: u32 = 192;
/// Tasks of the first round, and of the last.
const FIRST_ROUND: usize = 64;
const LAST_ROUND: usize = 4096;

impl<A: Shape, B: Shape> Search<'_, A, B> {
    /// The distance of a point of A, up to `reach`, which it is known not to exceed.
    fn sample(
        &self,
        (point, slack): (Lane, f64),
        (face, lo): (u32, f64),
        (reach, known): (f64, Option<Found>),
        storage: &mut Storage<B>,
    ) -> Sample {
        let points = [point];
        let tolerance = self.closeness.tolerance(lo);
        let mut probe = Probe::new(&points, self.error, tolerance, lo, reach);
        nearest(self.target, self.tree, &mut probe, storage);
        let lower = (probe.lower() - slack).max(0.0);
        let found = probe.found.or(known);
        Sample {
            lower,
            point,
            foot: found.map_or(point, |found| foot(&point, &found.triangle)),
            face,
            foot_face: found.map_or(0, |found| self.target.face_of(found.item)),
        }
    }

    /// The distances of points of A that may be far, with the error of each and its face.
    pub fn samples(&self, points: &[(Lane, f64, u32)], lo: f64) -> Vec<Sample> {
        points
            .par_iter()
            .with_min_len(4)
            .map_init(Storage::default, |storage, (point, slack, face)| {
                self.sample(
                    (*point, *slack),
                    (*face, lo),
                    (f64::INFINITY, None),
                    storage,
                )
            })
            .collect()
    }

    /// Bounds one part of A as well as a task may.
    fn task(&self, open: Open<A::Piece>, floor: f64, work: &mut Workspace<A, B>) -> Done<A::Piece> {
        let Workspace {
            scratch,
            fresh,
            storage,
            queue,
        } = work;
        let face = open.face;
        let mut done = Done {
            face,
            sample: None,
            closed: 0.0,
            left: Vec::new(),
            cells: 0,
            probes: 0,
        };
        let (mut lo, mut cutoff) = (floor, self.closeness.cutoff(floor));
        queue.clear(0.0);
        match open.start {
            Start::Piece(piece) => queue.push(open.bound, *piece),
            Start::Item(item) => {
                fresh.clear();
                self.source.open(item, scratch, fresh);
                fresh
                    .drain(..)
                    .for_each(|piece| queue.push(open.bound, piece));
            }
        }
        while let Some(top) = queue.top() {
            if *top <= cutoff {
                break;
            }
            if queue.pushed() > TASK || self.closeness.late() {
                break;
            }
            let Some((mut bound, piece)) = queue.pop() else {
                break;
            };
            done.cells += 1;
            let outline = *self.source.outline(&piece);
            done.probes += 1;
            let (known, upper) = self.cover(&piece, bound, lo, storage);
            bound = bound.min(upper);
            if bound > cutoff
                && let Some(found) = known
            {
                let (far, corner) = outline.reach(&found.triangle);
                let reach = far + found.width + self.error;
                if reach > lo {
                    done.probes += 1;
                    let point = (outline.corners[corner], outline.slack);
                    let sample = self.sample(point, (face, lo), (reach, known), storage);
                    if sample.lower > lo {
                        lo = sample.lower;
                        cutoff = self.closeness.cutoff(lo);
                        done.sample = Some(sample);
                    }
                }
            }
            if bound <= cutoff {
                queue.close(bound);
                continue;
            }
            fresh.clear();
            self.source.split(&piece, scratch, fresh);
            if fresh.is_empty() {
                queue.close(bound);
            }
            fresh.drain(..).for_each(|part| queue.push(bound, part));
        }
        while let Some(top) = queue.top() {
            if *top <= cutoff {
                break;
            }
            let Some((bound, piece)) = queue.pop() else {
                break;
            };
            let start = Start::Piece(Box::new(piece));
            done.left.push(Open { bound, face, start });
        }
        done.closed = queue.upper();
        done
    }

    /// A bound of a piece's distance, and the triangle of B that gives it.
    fn cover(
        &self,
        piece: &A::Piece,
        bound: f64,
        lo: f64,
        storage: &mut Storage<B>,
    ) -> (Option<Found>, f64) {
        let outline = self.source.outline(piece);
        let cutoff = self.closeness.cutoff(lo);
        let enough = cutoff - outline.thickness;
        let tolerance = 4.0 * self.closeness.tolerance(lo);
        let mut probe = Probe::new(outline.corners(), self.error, tolerance, enough, bound);
        nearest(self.target, self.tree, &mut probe, storage);
        let mut upper = probe.upper + outline.thickness;
        if let Some(found) = probe.found
            && upper > cutoff
            && probe.upper <= cutoff
        {
            // The thickness is to blame: the hull itself may be nearer.
            let mut far = 0.0_f64;
            self.source.hull(piece, |p| {
                far = far.max(length(p, &foot(p, &found.triangle)));
            });
            upper = upper.min(far + found.width + self.error + outline.slack);
        }
        (probe.found, upper)
    }

    /// Searches until the bounds are near enough or the budget is spent; `result` holds what is known
    /// before. Returns whether everything was closed.
    pub fn run(
        &self,
        mut open: Vec<Open<A::Piece>>,
        result: &mut Enclosure,
        progress: &(dyn Fn(usize) + Sync),
    ) -> bool {
        let mut size = FIRST_ROUND;
        loop {
            let cutoff = self.closeness.cutoff(result.lo);
            let mut still = Vec::with_capacity(open.len());
            for part in open {
                if part.bound <= cutoff {
                    result.close(part.face, part.bound);
                } else {
                    still.push(part);
                }
            }
            open = still;
            progress(open.len());
            if open.is_empty() || self.closeness.late() || result.cells > self.closeness.cells {
                break;
            }
            // Stable: equal bounds stay in the order in which they came.
            open.sort_by(|a, b| b.bound.total_cmp(&a.bound));
            let rest = open.split_off(size.min(open.len()));
            let floor = result.lo;
            let round: Vec<Done<A::Piece>> = open
                .into_par_iter()
                .with_max_len(16)
                .map_init(Workspace::default, |work, part| {
                    self.task(part, floor, work)
                })
                .collect();
            open = rest;
            for done in round {
                if let Some(sample) = done.sample {
                    result.include(sample);
                }
                result.cells += done.cells;
                result.probes += done.probes;
                result.close(done.face, done.closed);
                open.extend(done.left);
            }
            size = LAST_ROUND.min(2 * size);
        }
        let all = open.is_empty();
        for part in &open {
            result.close(part.face, part.bound);
        }
        all
    }
}
