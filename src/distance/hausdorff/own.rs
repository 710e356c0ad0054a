//! A surface against its own mesh, piece by piece over the same parameters.
//!
//! Where F and S share parameters most of either set is settled at once, without a search for the
//! nearest face. Over a piece let S_i and F_i be the corners, and `|S(u) - I(u)| <= w` for the
//! interpolant I of the S_i.
//!
//! | | surface to mesh | mesh to surface |
//! |---|---|---|
//! | F linear on a triangle T | `max dist(S_i, T) + w` | `max dist(F_i, conv S_i) + w` |
//! | F bilinear | `max abs(S_i - F_i) + w` | the same |
//!
//! First row: the distance to a convex set is convex, and for a point f of the mesh the nearest point
//! of the triangle conv S_i is I(u) for some u. Second row: F and I are bilinear over the same square,
//! so their difference is, and its length is largest at a corner.

use rayon::prelude::*;

use super::facets::{FacetPiece, lane, quarter};
use super::metric::{foot, length};
use super::search::{Closeness, Enclosure, Open, Start};
use super::shape::Shape;
use super::surface::{SurfacePiece, SurfaceScratch, SurfaceSet};
use crate::distance::model::Model;
use crate::distance::search::Queue;
use crate::mesh::{Point, Topology};
use crate::patch::quad_net::bilinear;
use crate::patch::{Float, Lane};
use crate::scalar::float::UNIT_ROUNDOFF;

/// Which set is asked about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Points of the surface, distances to the mesh.
    Surface,
    /// Points of the mesh, distances to the surface.
    Mesh,
}

/// The mesh F over the parameters of its surface.
pub struct OwnMesh<'a, M> {
    /// The surface.
    pub surface: &'a SurfaceSet<'a, M>,
    /// Its model.
    pub model: &'a M,
    /// Connectivity.
    pub topology: &'a Topology,
    /// Positions of F's corners.
    pub positions: &'a [Point<f64>],
    /// Bound of the error of F at any parameter, as a vector.
    pub slack: f64,
    /// What a computed distance can be off by.
    pub error: f64,
    /// Which side.
    pub role: Role,
}

/// The error of F at exact parameters, as a vector: 8 roundings of a bilinear interpolant, m + 1 of a
/// centroid.
pub fn facet_slack(sides: u32, radius: f64, largest: f64) -> f64 {
    1.7321 * (radius + (f64::from(sides) + 12.0) * UNIT_ROUNDOFF * largest)
}

/// A face's F.
#[derive(Default)]
struct Face {
    corners: Vec<Lane>,
    quads: Vec<[Lane; 4]>,
}

/// A piece with what its own part of the mesh says of it.
struct Matched<M: Model<Float>> {
    piece: SurfacePiece<M>,
    facet: [Lane; 4],
    /// The largest distance at a corner, rounding included: what splitting can't improve.
    value: f64,
}

/// Storage of a thread.
struct Workspace<M: Model<Float>> {
    scratch: SurfaceScratch<M>,
    fresh: Vec<SurfacePiece<M>>,
    face: Face,
    queue: Queue<f64, Matched<M>>,
}

impl<M: Model<Float>> Default for Workspace<M> {
    fn default() -> Self {
        Workspace {
            scratch: SurfaceScratch::default(),
            fresh: Vec::new(),
            face: Face::default(),
            queue: Queue::new(0.0),
        }
    }
}

/// A point of the set that is asked about, and how far it is from its own part of the other set.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// That distance: no less than the true one.
    pub value: f64,
    /// The point.
    pub point: Lane,
    /// Its error, as a vector.
    pub slack: f64,
    /// Its face.
    pub face: u32,
}

/// A face after matching.
struct Done<P> {
    face: u32,
    worst: Option<Candidate>,
    closed: f64,
    left: Vec<Open<P>>,
    cells: u64,
}

/// Pieces of one face that may be looked at.
const FACE: u32 = 256;
/// First block of faces; blocks double.
const FIRST_BLOCK: u32 = 256;
const LAST_BLOCK: u32 = 1 << 14;

/// The pieces of a set that matching has not settled.
pub trait Leftover<M: Model<Float>> {
    /// The kind of piece.
    type Piece: Send;
    /// Makes it of a surface piece and the corners of F.
    fn leave(surface: SurfacePiece<M>, facet: Facet) -> Self::Piece;
}

/// F over a piece.
pub struct Facet {
    corners: [Lane; 4],
    count: usize,
    slack: f64,
}

/// The surface is asked about.
pub enum OfSurface {}
/// The mesh is asked about.
pub enum OfMesh {}

impl<M: Model<Float>> Leftover<M> for OfSurface {
    type Piece = SurfacePiece<M>;
    fn leave(surface: SurfacePiece<M>, _: Facet) -> Self::Piece {
        surface
    }
}

impl<M: Model<Float>> Leftover<M> for OfMesh {
    type Piece = FacetPiece;
    fn leave(_: SurfacePiece<M>, facet: Facet) -> Self::Piece {
        FacetPiece::new(facet.corners, facet.count, facet.slack)
    }
}

impl<M: Model<Float>> OwnMesh<'_, M> {
    fn gather(&self, item: u32, face: &mut Face) {
        let corners = self.topology.corners(item);
        let at = |v: &u32| lane(&self.positions[*v as usize]);
        face.corners.clear();
        face.corners.extend(corners.iter().map(at));
        face.quads.clear();
        if self.surface.is_triangular() {
            return;
        }
        if self.model.locate(item, [0.0; 2]).0.is_none() {
            let c = &face.corners;
            face.quads.push([c[0], c[1], c[2], c[3]]);
        } else {
            let all = 0..face.corners.len();
            face.quads.extend(all.map(|i| quarter(&face.corners, i)));
        }
    }

    /// F at parameters of the face, and its triangle if it is one.
    fn at(&self, item: u32, face: &Face, [u, v]: [f64; 2]) -> Lane {
        if self.surface.is_triangular() {
            let c = &face.corners;
            return c[0] * &(1.0 - u - v) + (c[1] * &u) + (c[2] * &v);
        }
        let (quarter, [u, v]) = self.model.locate(item, [u, v]);
        let quad = &face.quads[quarter.unwrap_or(0) as usize];
        bilinear::<f64, Lane>(quad, [&u, &v])
    }

    fn matched(&self, item: u32, face: &Face, piece: SurfacePiece<M>) -> Matched<M> {
        let corners = self.surface.parameters(&piece);
        let facet = corners.map(|at| self.at(item, face, at));
        let outline = self.surface.outline(&piece);
        let mut value = 0.0_f64;
        for i in 0..outline.count {
            value = value.max(self.distance(face, outline.corners(), &facet, i));
        }
        let value = value + self.error + outline.slack + self.slack;
        Matched {
            piece,
            facet,
            value,
        }
    }

    /// The distance at a corner, of S or F, to the other's own part.
    fn distance(&self, face: &Face, surface: &[Lane], facet: &[Lane; 4], i: usize) -> f64 {
        match (surface, self.role) {
            (_, Role::Surface) if surface.len() == 3 => {
                let triangle = [face.corners[0], face.corners[1], face.corners[2]];
                length(&surface[i], &foot(&surface[i], &triangle))
            }
            ([a, b, c], Role::Mesh) => length(&facet[i], &foot(&facet[i], &[*a, *b, *c])),
            _ => length(&surface[i], &facet[i]),
        }
    }

    /// The hull of a surface piece against the face's own triangle.
    fn hull_bound(&self, face: &Face, piece: &SurfacePiece<M>) -> f64 {
        if self.role == Role::Mesh || !self.surface.is_triangular() {
            return f64::INFINITY;
        }
        let triangle = [face.corners[0], face.corners[1], face.corners[2]];
        let mut far = 0.0_f64;
        self.surface
            .hull(piece, |p| far = far.max(length(p, &foot(p, &triangle))));
        far + self.error + self.surface.outline(piece).slack + self.slack
    }

    /// The point of the set asked about that is farthest from its own part.
    fn candidate(&self, item: u32, face: &Face, matched: &Matched<M>) -> Candidate {
        let outline = self.surface.outline(&matched.piece);
        let surface = outline.corners();
        let distance = |i: usize| self.distance(face, surface, &matched.facet, i);
        let far = (0..outline.count).fold(0, |best, i| {
            if distance(i) > distance(best) {
                i
            } else {
                best
            }
        });
        let (point, slack) = match self.role {
            Role::Surface => (surface[far], outline.slack),
            Role::Mesh => (matched.facet[far], self.slack),
        };
        Candidate {
            value: matched.value,
            point,
            slack,
            face: item,
        }
    }

    fn face<L: Leftover<M>>(
        &self,
        item: u32,
        cutoff: f64,
        limit: u32,
        work: &mut Workspace<M>,
    ) -> Done<L::Piece> {
        let Workspace {
            scratch,
            fresh,
            face,
            queue,
        } = work;
        let mut done = Done {
            face: item,
            worst: None,
            closed: 0.0,
            left: Vec::new(),
            cells: 0,
        };
        queue.clear(0.0);
        fresh.clear();
        self.gather(item, face);
        self.surface.open(item, scratch, fresh);
        loop {
            for piece in fresh.drain(..) {
                let matched = self.matched(item, face, piece);
                if done.worst.is_none_or(|worst| matched.value > worst.value) {
                    done.worst = Some(self.candidate(item, face, &matched));
                }
                let bound = matched.value + self.surface.outline(&matched.piece).thickness;
                if bound <= cutoff {
                    queue.close(bound);
                } else {
                    queue.push(bound, matched);
                }
            }
            let Some((bound, matched)) = queue.pop() else {
                break;
            };
            done.cells += 1;
            let hopeless = matched.value > cutoff;
            let hull = if hopeless {
                f64::INFINITY
            } else {
                self.hull_bound(face, &matched.piece)
            };
            if hull <= cutoff {
                queue.close(hull);
                continue;
            }
            if !hopeless && queue.pushed() < limit {
                self.surface.split(&matched.piece, scratch, fresh);
                if !fresh.is_empty() {
                    continue;
                }
            }
            let outline = self.surface.outline(&matched.piece);
            let facet = Facet {
                corners: matched.facet,
                count: outline.count,
                slack: self.slack,
            };
            done.left.push(Open {
                bound: bound.min(hull),
                face: item,
                start: Start::Piece(Box::new(L::leave(matched.piece, facet))),
            });
        }
        done.closed = queue.upper();
        done
    }

    /// For each face, in order, the point that matching finds farthest, without any splitting.
    pub fn glance<L: Leftover<M>>(&self) -> Vec<Candidate> {
        (0..self.surface.item_count())
            .into_par_iter()
            .with_min_len(64)
            .map_init(Workspace::default, |work, item| {
                self.face::<L>(item, f64::INFINITY, 0, work).worst
            })
            .flatten_iter()
            .collect()
    }

    /// Settles what matching can, in blocks of faces; after each block `look` is asked for better lower
    /// bounds at its farthest points. Returns what is left.
    pub fn settle<L: Leftover<M>>(
        &self,
        closeness: &Closeness,
        result: &mut Enclosure,
        mut look: impl FnMut(&mut Enclosure, Vec<Candidate>),
        progress: &(dyn Fn(u32) + Sync),
    ) -> Vec<Open<L::Piece>> {
        let count = self.surface.item_count();
        let (mut start, mut size) = (0, FIRST_BLOCK);
        let mut left = Vec::new();
        while start < count {
            let end = count.min(start.saturating_add(size));
            let late = closeness.late();
            let cutoff = closeness.cutoff(result.lo);
            let limit = if late { 0 } else { FACE };
            let block: Vec<Done<L::Piece>> = (start..end)
                .into_par_iter()
                .with_min_len(16)
                .map_init(Workspace::default, |work, item| {
                    self.face::<L>(item, cutoff, limit, work)
                })
                .collect();
            let mut far = Vec::new();
            for done in block {
                result.cells += done.cells;
                result.close(done.face, done.closed);
                far.extend(done.worst.filter(|_| !done.left.is_empty()));
                left.extend(done.left);
            }
            if !late {
                look(result, far);
            }
            progress(end);
            (start, size) = (end, LAST_BLOCK.min(2 * size));
        }
        left
    }
}
