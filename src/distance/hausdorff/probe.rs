//! One question to a set B: how near is it to a point, or to the hull of a few points?
//!
//! *Upper.* For a triangle T such that B comes within w of each of its points, every x has
//! `dist(x, B) <= dist(x, T) + w`, and the right-hand side is convex in x. So over the hull of points
//! p_i it is at most `max_i dist(p_i, T) + w`. The probe looks for the triangle where this is least.
//!
//! *Lower (one point).* The distance to B is at least the least of: the boxes passed over, and, of
//! each piece looked at, the support of its hull or of its parts.
//!
//! Pieces are split while they might still offer something better by more than the tolerance.

use super::bvh::Tree;
use super::metric::{Support, foot, length};
use super::shape::Shape;
use crate::patch::Lane;

/// What is asked, and the best answer so far.
#[derive(Clone, Debug)]
pub struct Probe<'a> {
    points: &'a [Lane],
    /// What a computed distance can be off by ([`super::metric::error_bound`]).
    error: f64,
    /// Pieces are not split for less than this.
    tolerance: f64,
    /// The search ends when `upper` is down to this.
    enough: f64,
    /// `max_i dist(p_i, B)` is at most this, and so is the distance from every point of their hull;
    /// at first the reach that was asked for.
    pub upper: f64,
    /// For one point: the distance is at least this.
    lower: f64,
    /// The best triangle, its width w, and the item that holds it.
    pub found: Option<Found>,
    /// Pieces and triangles looked at.
    pub visited: u64,
}

/// A triangle within `width` of B.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// The triangle.
    pub triangle: [Lane; 3],
    /// B comes within this of each of its points.
    pub width: f64,
    /// The item.
    pub item: u32,
}

impl<'a> Probe<'a> {
    /// Asks about the hull of `points`. Answers above `reach` are of no interest.
    pub fn new(points: &'a [Lane], error: f64, tolerance: f64, enough: f64, reach: f64) -> Self {
        Probe {
            points,
            error,
            tolerance,
            enough,
            upper: reach,
            lower: f64::INFINITY,
            found: None,
            visited: 0,
        }
    }

    /// For one point: the distance is at least this. 0 if the search ended early.
    pub fn lower(&self) -> f64 {
        if self.done() {
            return 0.0;
        }
        // Boxes that were passed over are not nearer than `upper` was then.
        self.lower.min(self.upper).max(0.0)
    }

    fn done(&self) -> bool {
        self.upper <= self.enough
    }

    /// Offers a triangle within `width` of B.
    #[inline]
    fn offer(&mut self, triangle: &[Lane; 3], width: f64, item: u32) {
        let mut worst = 0.0_f64;
        for p in self.points {
            worst = worst.max((*p - &foot(p, triangle)).norm_squared());
        }
        let bound = worst.sqrt() + self.error + width;
        if bound < self.upper {
            self.upper = bound;
            self.found = Some(Found {
                triangle: *triangle,
                width,
                item,
            });
        }
    }

    /// Notes that nothing nearer than `bound` is left in some part of B.
    #[inline]
    fn leave(&mut self, bound: f64) {
        self.lower = self.lower.min(bound);
    }

    /// A triangle of B that can't be split, whose corners are off by `slack`.
    #[inline]
    pub fn triangle(&mut self, triangle: &[Lane; 3], slack: f64, item: u32) {
        self.visited += 1;
        if let [p] = self.points {
            let q = foot(p, triangle);
            let distance = length(p, &q);
            let mut support = Support::new(p, &q);
            for x in triangle {
                support.include(x);
            }
            self.leave(support.distance() - self.error - slack);
            let bound = distance + self.error + slack;
            if bound < self.upper {
                self.upper = bound;
                self.found = Some(Found {
                    triangle: *triangle,
                    width: slack,
                    item,
                });
            }
        } else {
            self.offer(triangle, slack, item);
        }
    }
}

/// Storage of [`nearest`], reused.
pub struct Storage<B: Shape> {
    scratch: B::Scratch,
    fresh: Vec<B::Piece>,
    pieces: Vec<(f64, B::Piece)>,
}

impl<B: Shape> Default for Storage<B> {
    fn default() -> Self {
        Storage {
            scratch: B::Scratch::default(),
            fresh: Vec::new(),
            pieces: Vec::new(),
        }
    }
}

/// Answers the probe.
pub fn nearest<B: Shape>(shape: &B, tree: &Tree, probe: &mut Probe<'_>, storage: &mut Storage<B>) {
    tree.visit(
        probe,
        |probe, bounds| {
            let square = |p: &Lane| bounds.distance_squared(p);
            let farthest = probe.points.iter().map(square).fold(0.0, f64::max);
            farthest.sqrt() - probe.error
        },
        |probe| {
            if probe.done() {
                f64::NEG_INFINITY
            } else {
                probe.upper
            }
        },
        |probe, item| {
            if let Some((triangle, slack)) = shape.triangle(item) {
                probe.triangle(triangle, slack, item);
            } else {
                visit_item(shape, item, probe, storage);
            }
        },
    );
}

/// The pieces of an item, the most promising first.
fn visit_item<B: Shape>(shape: &B, item: u32, probe: &mut Probe<'_>, storage: &mut Storage<B>) {
    let Storage {
        scratch,
        fresh,
        pieces,
    } = storage;
    pieces.clear();
    fresh.clear();
    shape.open(item, scratch, fresh);
    loop {
        for piece in fresh.drain(..) {
            pieces.push((promise(shape, &piece, probe), piece));
        }
        let best = (0..pieces.len()).reduce(|a, b| if pieces[b].0 < pieces[a].0 { b } else { a });
        let Some(best) = best else { break };
        let (bound, piece) = pieces.swap_remove(best);
        if bound >= probe.upper {
            // No other piece is better.
            probe.leave(bound);
            break;
        }
        probe.visited += 1;
        let outline = shape.outline(&piece);
        let (count, cores, twist) = outline.cores();
        let width = outline.thickness + twist + probe.error;
        for triangle in &cores[..count] {
            probe.offer(triangle, width, item);
        }
        let fine = 2.0 * width <= probe.tolerance;
        if probe.done() || fine || bound >= probe.upper - probe.tolerance {
            probe.leave(bound);
            continue;
        }
        shape.split(&piece, scratch, fresh);
        if fresh.is_empty() {
            probe.leave(bound);
        }
    }
}

/// A lower bound of `max_i dist(p_i, piece)`: supports of its hull, away from the foot on its
/// outline.
fn promise<B: Shape>(shape: &B, piece: &B::Piece, probe: &Probe<'_>) -> f64 {
    let outline = shape.outline(piece);
    let (count, cores, _) = outline.cores();
    let mut supports = [Support::new(&Lane([0.0; 4]), &Lane([0.0; 4])); 4];
    for (support, p) in supports.iter_mut().zip(probe.points) {
        let feet = cores[..count].iter().map(|core| foot(p, core));
        let distance = |q: &Lane| length(p, q);
        let nearest = feet.reduce(|a, b| if distance(&b) < distance(&a) { b } else { a });
        *support = Support::new(p, &nearest.unwrap_or(*p));
    }
    let supports = &mut supports[..probe.points.len()];
    shape.hull(piece, |x| supports.iter_mut().for_each(|s| s.include(x)));
    let farthest = supports.iter().map(Support::distance).fold(0.0, f64::max);
    farthest - probe.error - outline.slack
}
