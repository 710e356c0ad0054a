//! Doo-Sabin: second differences and diameters round a vertex in a face.
//!
//! The surface over a quarter (face f, interior vertex v) belongs to the net round v. *Ready* is a quarter
//! whose vertex has valence 4 and three quads beside f; f has any number n of sides. Its M is the largest of
//! six second differences and, if n is not 4, the diameter of f
//! ([`crate::scheme::doo_sabin::face_differences`]). Other quarters wait for their four children at the vertex
//! that v leaves in f: a step makes all valences 4, another one parts extraordinary faces.
//!
//! **Roundings.** As in [`super::triangles`].

use super::connectivity::Connectivity;
use super::levels::Visit;
use super::vector::{Vector, middle, minus, second, square};
use crate::mesh::Point;

/// The levels from the first on, until all quarters are ready.
#[derive(Clone, Debug)]
pub struct QuarterLevels<'a> {
    /// The number of the first level.
    pub first: usize,
    /// Each level.
    pub levels: Vec<Quarters<'a>>,
    /// Squares of how far the mesh of a level moves over each quarter (by half-edge), for all but the last.
    pub moved: Vec<Vec<f64>>,
}

/// One level.
#[derive(Clone, Debug)]
pub struct Quarters<'a> {
    /// Connectivity.
    pub topology: Connectivity<'a>,
    positions: Vec<Vector>,
    /// Squared diameters of faces; 0 for quads.
    diameters: Vec<f64>,
    /// The kind of each face.
    kinds: Vec<u16>,
}

impl<'a> Quarters<'a> {
    /// The squares of a level; `kinds` is that of each face.
    pub fn new(topology: Connectivity<'a>, positions: &[Point<f64>], kinds: Vec<u16>) -> Self {
        let diameter = |f: u32| {
            let corners = topology.corners(f);
            if corners.len() == 4 {
                return 0.0;
            }
            let at = |v: u32| &positions[v as usize].0;
            let pairs =
                (1..corners.len()).flat_map(|i| (0..i).map(move |j| [corners[i], corners[j]]));
            let squares = pairs.map(|[a, b]| square(&minus(at(a), at(b))));
            squares.fold(0.0, f64::max)
        };
        Quarters {
            diameters: (0..topology.face_count()).map(diameter).collect(),
            positions: positions.iter().map(|p| p.0).collect(),
            topology,
            kinds,
        }
    }

    /// Whether there is a surface over the quarter of a half-edge's face at its origin.
    fn has_surface(&self, h: u32) -> bool {
        !self.topology.is_boundary_vertex(self.topology.origin(h))
    }

    /// The kind and M^2 of a ready quarter.
    fn ready(&self, h: u32) -> Option<(u16, f64)> {
        let t = &self.topology;
        let v = t.origin(h);
        if t.valence(v) != 4 {
            return None;
        }
        // Counterclockwise: f between x_0 and x_1, then the quads (x_1, d_1, x_2), (x_2, d_2, x_3), (x_3, d_3, x_0).
        let mut spokes = [h; 4];
        for i in 1..4 {
            spokes[i] = t.rotate(spokes[i - 1]);
            if t.face_size(t.face_of(spokes[i])) != 4 {
                return None;
            }
        }
        let at = |v: u32| &self.positions[v as usize];
        let x = spokes.map(|s| at(t.target(s)));
        let d = |i: usize| at(t.target(t.next(spokes[i])));
        let (p, d) = (at(v), [d(1), d(2), d(3)]);
        // The neighbours of x_0 and x_1 in f, along the lines through (d_3, x_0) and (d_1, x_1).
        let after = at(t.target(t.next(h)));
        let before = at(t.origin(t.prev(t.prev(h))));
        let rows = [
            second(p, x[0], x[2]),
            second(p, x[1], x[3]),
            second(x[0], after, d[2]),
            second(x[1], before, d[0]),
            second(x[2], d[0], d[1]),
            second(x[3], d[1], d[2]),
        ];
        let face = t.face_of(h) as usize;
        let largest = rows.iter().map(square).fold(self.diameters[face], f64::max);
        Some((self.kinds[face], largest))
    }

    /// Those with a surface over them.
    pub fn with_surface(&self) -> Vec<u32> {
        let all = 0..self.topology.halfedge_count();
        all.filter(|&h| self.has_surface(h)).collect()
    }

    /// Those of some quarters that have to wait.
    pub fn waiting(&self, quarters: &[u32]) -> Vec<u32> {
        let waits = |h: &u32| self.ready(*h).is_none();
        quarters.iter().copied().filter(waits).collect()
    }
}

impl QuarterLevels<'_> {
    /// The ready quarters of a face of the first level.
    pub fn visit(&self, face: u32, to: &mut impl Visit) {
        for h in self.levels[0].topology.halfedges(face) {
            if self.levels[0].has_surface(h) {
                self.descend(0, h, to);
            }
        }
    }

    fn descend(&self, index: usize, h: u32, to: &mut impl Visit) {
        match self.levels[index].ready(h) {
            Some((kind, square)) => to.ready(self.first + index, kind, square),
            None => {
                to.moved(self.first + index, self.moved[index][h as usize]);
                // A half-edge's own vertex.
                for child in self.levels[index + 1].topology.fan(h) {
                    self.descend(index + 1, child, to);
                }
            }
        }
    }
}

/// For each quarter (by half-edge) the square of the largest distance between a level's mesh and the next one's
/// over it; both are bilinear over its four quarters.
pub fn moves(coarse: &Quarters<'_>, fine: &Quarters<'_>) -> Vec<f64> {
    let t = &coarse.topology;
    let of_quarter = |h: u32| {
        if !coarse.has_surface(h) {
            return 0.0;
        }
        let at = |v: u32| &coarse.positions[v as usize];
        let [v, x, y] = [t.origin(h), t.target(h), t.origin(t.prev(h))].map(at);
        // Corners of the quarter: v, the middle towards x, the centroid, the middle towards y.
        let corners = [
            *v,
            middle(v, x),
            coarse.centroid(t.face_of(h)),
            middle(v, y),
        ];
        let f = &fine.topology;
        let own = &fine.positions[h as usize];
        let center = middle(
            &middle(&corners[0], &corners[2]),
            &middle(&corners[1], &corners[3]),
        );
        let mut largest = square(&minus(own, &center));
        // Round the new vertex: the face f' first (its half-edge is h itself), then that of the edge towards y, of v
        // and of the edge towards x.
        let mut spoke = h;
        for [at, from] in [[2, 1], [3, 2], [0, 3], [1, 0]] {
            let centroid = fine.centroid(f.face_of(spoke));
            largest = largest.max(square(&minus(&centroid, &corners[at])));
            // The spoke before this face, between it and the one before: the middle of that side.
            let end = &fine.positions[f.target(spoke) as usize];
            let side = middle(&corners[at], &corners[from]);
            largest = largest.max(square(&minus(&middle(own, end), &side)));
            spoke = f.rotate(spoke);
        }
        largest
    };
    (0..t.halfedge_count()).map(of_quarter).collect()
}

impl Quarters<'_> {
    fn centroid(&self, f: u32) -> Vector {
        let corners = self.topology.corners(f);
        let mut sum = [0.0; 3];
        for &v in corners {
            for (s, x) in sum.iter_mut().zip(&self.positions[v as usize]) {
                *s += x;
            }
        }
        sum.map(|s| s / corners.len() as f64)
    }
}
