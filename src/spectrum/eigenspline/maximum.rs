//! The largest magnitude of e - E over patches: an upper bound by best-first quartering.
//!
//! With barycentric coordinates b_v of χ_i in a facet that may lie under a part, the Bernstein
//! coefficients of e - E there are `e_i - Σ b_v(i) E_v`; [`super::facet_bound`] bounds |e - E| by them. The
//! part with the largest bound is quartered, until that bound is near enough to a value
//! that was met, or the part is as small as certificates allow.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::complex::Complex;
use super::facet_bound::bound_over;
use super::facets::{Covering, Part, Patch};
use super::reach::{Reached, reach};
use crate::bernstein::triangle::{QUARTER_CORNERS, QuarticTriangle};
use crate::scalar::Interval;

/// A value of a mode.
pub type Value = Complex<Interval>;

/// The number of quarterings that certificates allow.
pub const MOST_QUARTERINGS: u32 = 20;
/// Quarterings at most.
const MOST_PARTS: usize = 20_000;

/// e over a patch, and E at the corners of its candidates.
#[derive(Debug)]
pub struct Start<'a> {
    /// The patch.
    pub patch: &'a Patch,
    /// The sector of the mode.
    pub sector: usize,
    /// The ring.
    pub ring: u32,
    /// e.
    pub spline: QuarticTriangle<Value>,
    /// E.
    pub facets: Vec<[Value; 3]>,
}

/// What is known of a supremum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maximum {
    /// It is at most this.
    pub hi: f64,
    /// And at least the value here; `None` if no value was above the floor.
    pub reached: Option<Reached>,
}

/// The supremum of |e - E| over the patches of the starts, or a floor if that is larger, enclosed: the
/// bound above the value by at most `gap` of it, if that can be had. `None` if the facets under some part stay uncertain.
pub fn enclose(starts: &[Start], floor: f64, gap: f64) -> Option<Maximum> {
    let mut search = Search::new(starts, floor);
    for _ in 0..MOST_PARTS {
        let Some(top) = search.heap.peek() else {
            break;
        };
        if top.depth == MOST_QUARTERINGS || top.bound <= search.best * (1.0 + gap) {
            break;
        }
        let top = search.heap.pop()?;
        search.quarter(top);
    }
    let left = search.heap.peek().map_or(0.0, |top| top.bound);
    let most = left.max(search.dropped);
    let hi = most.max(floor);
    let reached = match search.best_at {
        Some((start, at)) => Some(reach(starts, start, at)?),
        None => None,
    };
    most.is_finite().then_some(Maximum { hi, reached })
}

struct Node<'a> {
    /// An upper bound of the magnitude; infinite where the facets are not certain.
    bound: f64,
    number: usize,
    start: usize,
    part: &'a Part,
    spline: QuarticTriangle<Value>,
    corners: [[f64; 2]; 3],
    depth: u32,
}

impl PartialEq for Node<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Node<'_> {}
impl PartialOrd for Node<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Node<'_> {
    /// By bound, then the older one: the order of a search depends on nothing else.
    fn cmp(&self, other: &Self) -> Ordering {
        let older = other.number.cmp(&self.number);
        self.bound.total_cmp(&other.bound).then(older)
    }
}

struct Search<'a> {
    starts: &'a [Start<'a>],
    heap: BinaryHeap<Node<'a>>,
    /// The largest value met, about, or the floor: a proposal.
    best: f64,
    /// Where it was met.
    best_at: Option<(usize, [f64; 2])>,
    /// The largest bound of a part that was not kept.
    dropped: f64,
    number: usize,
}

impl<'a> Search<'a> {
    fn new(starts: &'a [Start<'a>], floor: f64) -> Self {
        let mut search = Search {
            starts,
            heap: BinaryHeap::new(),
            best: floor,
            best_at: None,
            dropped: 0.0,
            number: 0,
        };
        for (i, start) in starts.iter().enumerate() {
            let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
            search.push(i, &start.patch.root, start.spline.clone(), corners, 0);
        }
        search
    }

    fn push(
        &mut self,
        start: usize,
        part: &'a Part,
        spline: QuarticTriangle<Value>,
        corners: [[f64; 2]; 3],
        depth: u32,
    ) {
        let facets = &self.starts[start].facets;
        let bound = bound(part, &spline, facets, self.best);
        for (value, corner) in estimates(part, &spline, facets).into_iter().zip(corners) {
            if value > self.best {
                self.best = value;
                self.best_at = Some((start, corner));
            }
        }
        self.number += 1;
        if bound < self.best {
            self.dropped = self.dropped.max(bound);
            return;
        }
        self.heap.push(Node {
            bound,
            number: self.number,
            start,
            part,
            spline,
            corners,
            depth,
        });
    }

    fn quarter(&mut self, node: Node<'a>) {
        let candidates = &self.starts[node.start].patch.candidates;
        let parts = node.part.quarters(candidates);
        let splines = node.spline.quarters::<Interval>();
        for ((part, spline), corners) in parts.iter().zip(splines).zip(quarters(&node.corners)) {
            self.push(node.start, part, spline, corners, node.depth + 1);
        }
    }
}

/// The corners of the quarters of a triangle.
fn quarters(corners: &[[f64; 2]; 3]) -> [[[f64; 2]; 3]; 4] {
    let [o, a, b] = corners;
    QUARTER_CORNERS.map(|quarter| {
        quarter.map(|[v, w]| {
            let (v, w) = (v as f64 / 2.0, w as f64 / 2.0);
            [0, 1].map(|c| o[c] + v * (a[c] - o[c]) + w * (b[c] - o[c]))
        })
    })
}

/// e - E, given e and the barycentric coordinates of a point in a facet.
pub fn difference(e: &Value, weights: &[Interval; 3], facet: &[Value; 3]) -> Value {
    let terms = weights.iter().zip(facet);
    terms.fold(*e, |sum, (b, value)| sum - &(*value * b))
}

/// |z|.
pub fn magnitude(z: &Value) -> Interval {
    let square = z.re.sqr() + z.im.sqr();
    square.sqrt().unwrap_or(Interval::ENTIRE)
}

/// An upper bound of |e - E| over a part.
fn bound(part: &Part, spline: &QuarticTriangle<Value>, facets: &[[Value; 3]], enough: f64) -> f64 {
    let Some(covering) = &part.covering else {
        return f64::INFINITY;
    };
    let over =
        |covering: &Covering| bound_over(covering, spline, &facets[covering.candidate], enough);
    covering.iter().map(over).fold(0.0, f64::max)
}

/// |e - E| at the corners of a part, about.
fn estimates(part: &Part, spline: &QuarticTriangle<Value>, facets: &[[Value; 3]]) -> [f64; 3] {
    let covering = part.covering.as_deref().unwrap_or_default();
    [0, 10, 14].map(|i| {
        let inside = |c: &&Covering| c.weights[i].iter().all(|b| b.mid() > -1e-9);
        covering.iter().find(inside).map_or(0.0, |c| {
            let facet = &facets[c.candidate];
            magnitude(&difference(&spline.0[i], &c.weights[i], facet)).mid()
        })
    })
}
