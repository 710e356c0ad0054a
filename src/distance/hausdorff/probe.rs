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

use std::collections::HashMap;

use super::bvh::Tree;
use super::metric::{Aabb, Support, foot, length};
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

    /// A lower bound of `max_i dist(p_i, piece)` for any piece in the box.
    #[inline]
    fn box_promise(&self, bounds: &Aabb) -> f64 {
        let square = |p: &Lane| bounds.distance_squared(p);
        let farthest = self.points.iter().map(square).fold(0.0, f64::max);
        farthest.sqrt() - self.error
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

/// A piece, and the pieces it was split into, once it was.
struct Grown<P> {
    piece: P,
    bounds: Aabb,
    /// A range of the item's pieces; empty if it can't be split.
    parts: Option<std::ops::Range<u32>>,
}

/// The pieces of an item that have been needed so far, its first ones in front.
struct Grove<P> {
    roots: u32,
    pieces: Vec<Grown<P>>,
}

/// Storage of [`nearest`], reused: neighbouring questions look at the same pieces again and again.
pub struct Storage<B: Shape> {
    scratch: B::Scratch,
    fresh: Vec<B::Piece>,
    groves: HashMap<u32, Grove<B::Piece>>,
    /// Number of pieces in all groves.
    kept: usize,
    /// Pieces to look at, with what they promise.
    pending: Vec<(f64, u32)>,
}

/// Number of pieces that are kept before all are forgotten. What is kept changes no answer.
const KEPT: usize = 1 << 15;

impl<B: Shape> Default for Storage<B> {
    fn default() -> Self {
        Storage {
            scratch: B::Scratch::default(),
            fresh: Vec::new(),
            groves: HashMap::new(),
            kept: 0,
            pending: Vec::new(),
        }
    }
}

/// Answers the probe.
pub fn nearest<B: Shape>(shape: &B, tree: &Tree, probe: &mut Probe<'_>, storage: &mut Storage<B>) {
    tree.visit(
        probe,
        Probe::box_promise,
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
        groves,
        kept,
        pending,
    } = storage;
    if *kept > KEPT {
        groves.clear();
        *kept = 0;
    }
    let grove = groves.entry(item).or_insert_with(|| {
        shape.open(item, scratch, fresh);
        *kept += fresh.len();
        let grown = |piece| grow(shape, piece);
        Grove {
            roots: fresh.len() as u32,
            pieces: fresh.drain(..).map(grown).collect(),
        }
    });
    pending.clear();
    let mut next = 0..grove.roots;
    loop {
        for i in next {
            let bound = promise(shape, &grove.pieces[i as usize], probe);
            pending.push((bound, i));
        }
        next = 0..0;
        let least = |a: usize, b: usize| if pending[b].0 < pending[a].0 { b } else { a };
        let Some(best) = (0..pending.len()).reduce(least) else {
            break;
        };
        let (bound, index) = pending.swap_remove(best);
        if bound >= probe.upper {
            // No other piece is better.
            probe.leave(bound);
            break;
        }
        probe.visited += 1;
        let grown = &grove.pieces[index as usize];
        let outline = shape.outline(&grown.piece);
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
        next = match &grown.parts {
            Some(parts) => parts.clone(),
            None => {
                shape.split(&grown.piece, scratch, fresh);
                let start = grove.pieces.len() as u32;
                let parts = start..start + fresh.len() as u32;
                *kept += fresh.len();
                let grown = |piece| grow(shape, piece);
                grove.pieces.extend(fresh.drain(..).map(grown));
                grove.pieces[index as usize].parts = Some(parts.clone());
                parts
            }
        };
        if next.is_empty() {
            probe.leave(bound);
        }
    }
}

fn grow<B: Shape>(shape: &B, piece: B::Piece) -> Grown<B::Piece> {
    let bounds = shape.piece_box(&piece);
    Grown {
        piece,
        bounds,
        parts: None,
    }
}

/// A lower bound of `max_i dist(p_i, piece)`: of its box; or of the support of its corners, less its
/// thickness; or, where that is thick, the support of its hull. Directions are those from the feet
/// on its outline.
fn promise<B: Shape>(shape: &B, grown: &Grown<B::Piece>, probe: &Probe<'_>) -> f64 {
    let boxed = probe.box_promise(&grown.bounds);
    if boxed >= probe.upper {
        return boxed;
    }
    let outline = shape.outline(&grown.piece);
    let (count, cores, _) = outline.cores();
    let mut supports = [Support::new(&Lane([0.0; 4]), &Lane([0.0; 4])); 4];
    for (support, p) in supports.iter_mut().zip(probe.points) {
        let distance = |q: &Lane| length(p, q);
        let feet = cores[..count].iter().map(|core| foot(p, core));
        let nearest = feet.reduce(|a, b| if distance(&b) < distance(&a) { b } else { a });
        *support = Support::new(p, &nearest.unwrap_or(*p));
        outline.corners().iter().for_each(|x| support.include(x));
    }
    let supports = &mut supports[..probe.points.len()];
    let farthest = |supports: &[Support]| {
        let distances = supports.iter().map(Support::distance);
        distances.fold(0.0, f64::max) - probe.error
    };
    let thin = farthest(supports) - outline.thickness;
    let bound = boxed.max(thin);
    if bound >= probe.upper || outline.thickness <= 0.25 * probe.tolerance {
        return bound;
    }
    shape.hull(&grown.piece, |x| {
        supports.iter_mut().for_each(|s| s.include(x))
    });
    bound.max(farthest(supports) - outline.slack)
}
