//! The supremum of |S(u) - F(u)| over one face.
//!
//! A face is covered by polynomial patches of S - F and by nets at its irregular points. Patches are
//! halved and nets split, always the one with the largest upper bound first. Upper bounds: the
//! convex hull of the Bernstein coefficients; at an irregular point, where infinitely many rings of
//! patches remain, the hull of the net (S lies in it, F in the hull of its corners); at a smooth
//! maximum [`super::close`]. Lower bounds: values at corners, which are coefficients, at irregular
//! points (limit masks), and at the maximisers that `close` proposes.

use num_traits::Zero;

use super::close::close;
use super::model::{Gathered, Model};
use super::search::Queue;
use crate::bernstein::Patch;
use crate::patch::rounding::Extent;
use crate::patch::{Corners, Sink, Space};

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
