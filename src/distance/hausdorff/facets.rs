//! A mesh as a set: triangles, and bilinear quads that may be bent.

use rayon::prelude::*;

use super::Facets;
use super::metric::Aabb;
use super::shape::{Outline, Shape};
use crate::mesh::{Point, Topology};
use crate::patch::Lane;
use crate::scalar::float::UNIT_ROUNDOFF;

/// Halvings after which a piece of a facet is not split any further: both its sides are then 2^-48 of
/// the facet's.
const DEEPEST: u32 = 96;

/// The facets of a mesh.
///
/// | face | `Facets::Bilinear` | `Facets::Triangles` |
/// |---|---|---|
/// | triangle | itself | itself |
/// | quad | the bilinear interpolant of its corners | a fan of two triangles from the first corner |
/// | other polygon | bilinear quarters (corner, edge midpoint, centroid, edge midpoint) | a fan from the first corner |
#[derive(Clone, Debug)]
pub struct FacetSet {
    triangles: Vec<[Lane; 3]>,
    /// Corners of the quads, items after the triangles.
    quads: Vec<[Lane; 4]>,
    faces: Vec<u32>,
    slack: f64,
}

/// A part of a facet.
#[derive(Clone, Debug)]
pub struct FacetPiece {
    outline: Outline,
    halvings: u32,
}

impl FacetPiece {
    /// A piece with these corners, each off by at most `slack`, a vector.
    pub(super) fn new(corners: [Lane; 4], count: usize, slack: f64) -> Self {
        FacetPiece {
            outline: Outline {
                corners,
                count,
                thickness: slack,
                slack,
            },
            halvings: 0,
        }
    }
}

/// A point as four lanes.
#[inline]
pub(super) fn lane(p: &Point<f64>) -> Lane {
    Lane([p.0[0], p.0[1], p.0[2], 0.0])
}

impl FacetSet {
    /// The facets of a mesh whose positions are off by at most `radius` per coordinate, none of them
    /// above `largest` in magnitude.
    ///
    /// Error of a corner: the centroid of m vertices takes m + 1 roundings, each halving of a facet
    /// one: at most `(m + 1 + 96) u L` per coordinate beside the radius.
    pub fn new(
        topology: &Topology,
        positions: &[Point<f64>],
        facets: Facets,
        radius: f64,
        largest: f64,
    ) -> Self {
        let (mut triangles, mut quads) = (Vec::new(), Vec::new());
        let (mut faces, mut quad_faces) = (Vec::new(), Vec::new());
        let mut sides = 4;
        for face in 0..topology.face_count() {
            let corners = topology.corners(face);
            let at = |i: usize| lane(&positions[corners[i % corners.len()] as usize]);
            let m = corners.len();
            sides = sides.max(m);
            match (m, facets) {
                (3, _) => {
                    triangles.push([at(0), at(1), at(2)]);
                    faces.push(face);
                }
                (_, Facets::Triangles) => {
                    for i in 1..m - 1 {
                        triangles.push([at(0), at(i), at(i + 1)]);
                        faces.push(face);
                    }
                }
                (4, Facets::Bilinear) => {
                    quads.push([at(0), at(1), at(2), at(3)]);
                    quad_faces.push(face);
                }
                (_, Facets::Bilinear) => {
                    let points: Vec<Lane> = (0..m).map(at).collect();
                    for i in 0..m {
                        quads.push(quarter(&points, i));
                        quad_faces.push(face);
                    }
                }
            }
        }
        faces.extend(quad_faces);
        FacetSet {
            triangles,
            quads,
            faces,
            slack: 1.7321 * (radius + (sides as f64 + 98.0) * UNIT_ROUNDOFF * largest),
        }
    }

    /// Bound of the error of a corner, as a vector.
    pub fn slack(&self) -> f64 {
        self.slack
    }
}

/// Quarter i of a polygon: its corner, the middle of the next edge, the centroid, the middle of the
/// edge before.
pub(super) fn quarter(points: &[Lane], i: usize) -> [Lane; 4] {
    let m = points.len();
    let total = points.iter().fold(Lane([0.0; 4]), |sum, p| sum + p);
    let middle = |a: &Lane, b: &Lane| (*a + b) * &0.5;
    let (own, next, prev) = (&points[i], &points[(i + 1) % m], &points[(i + m - 1) % m]);
    [
        *own,
        middle(own, next),
        total * &(1.0 / m as f64),
        middle(own, prev),
    ]
}

impl Shape for FacetSet {
    type Piece = FacetPiece;
    type Scratch = ();

    fn item_count(&self) -> u32 {
        self.faces.len() as u32
    }

    fn face_of(&self, item: u32) -> u32 {
        self.faces[item as usize]
    }

    fn open(&self, item: u32, (): &mut (), out: &mut Vec<FacetPiece>) {
        let item = item as usize;
        out.push(match self.triangles.get(item) {
            Some([a, b, c]) => FacetPiece::new([*a, *b, *c, *a], 3, self.slack),
            None => {
                let quad = self.quads[item - self.triangles.len()];
                FacetPiece::new(quad, 4, self.slack)
            }
        });
    }

    /// Halves the longest side of a triangle, or the longer direction of a bilinear quad: its halves
    /// are bilinear quads.
    fn split(&self, piece: &FacetPiece, (): &mut (), out: &mut Vec<FacetPiece>) {
        if piece.halvings >= DEEPEST {
            return;
        }
        let c = &piece.outline.corners;
        let middle = |i: usize, j: usize| (c[i] + c[j]) * &0.5;
        let corner = |i: usize| c[i];
        let side = |i: usize, j: usize| (c[i] - &c[j]).norm_squared();
        let halves = if piece.outline.count == 3 {
            let sides = [side(0, 1), side(1, 2), side(2, 0)];
            let i = (1..3).fold(0, |best, i| if sides[i] > sides[best] { i } else { best });
            let (a, b, o) = (i, (i + 1) % 3, (i + 2) % 3);
            let m = middle(a, b);
            [[m, corner(o), corner(a), m], [m, corner(b), corner(o), m]]
        } else if side(0, 1).max(side(3, 2)) >= side(0, 3).max(side(1, 2)) {
            let (m, n) = (middle(0, 1), middle(3, 2));
            [[corner(0), m, n, corner(3)], [m, corner(1), corner(2), n]]
        } else {
            let (m, n) = (middle(0, 3), middle(1, 2));
            [[corner(0), corner(1), n, m], [m, n, corner(2), corner(3)]]
        };
        for half in halves {
            out.push(FacetPiece {
                outline: Outline {
                    corners: half,
                    ..piece.outline
                },
                halvings: piece.halvings + 1,
            });
        }
    }

    fn outline<'a>(&self, piece: &'a FacetPiece) -> &'a Outline {
        &piece.outline
    }

    fn hull(&self, piece: &FacetPiece, visit: impl FnMut(&Lane)) {
        piece.outline.corners().iter().for_each(visit);
    }

    fn boxes(&self) -> Vec<Aabb> {
        let around = |corners: &[Lane]| {
            let mut bounds = Aabb::EMPTY;
            corners.iter().for_each(|p| bounds.include(p));
            bounds.widen(self.slack);
            bounds
        };
        let triangles = self.triangles.par_iter().with_min_len(1024);
        let quads = self.quads.par_iter().with_min_len(1024);
        let mut boxes: Vec<Aabb> = triangles.map(|t| around(t)).collect();
        boxes.par_extend(quads.map(|q| around(q)));
        boxes
    }

    fn triangle(&self, item: u32) -> Option<(&[Lane; 3], f64)> {
        self.triangles.get(item as usize).map(|t| (t, self.slack))
    }
}
