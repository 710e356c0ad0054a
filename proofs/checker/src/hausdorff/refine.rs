//! One step of refinement and limits of vertices, for Loop's and the Catmull-Clark scheme, with boundary rules.

use std::collections::BTreeMap;

use super::claim::Boundary;
use super::distance::{minus, plus, scaled, sum, times};
use super::polygon_mesh::{Mesh, Star, Vector};
use crate::fixed::Fixed;

/// The rules of a scheme.
pub struct Rules {
    /// Loop's scheme: beta for each interior valence that occurs. `None`: Catmull-Clark.
    pub betas: Option<BTreeMap<usize, Fixed>>,
    pub boundary: Boundary,
}

/// The mesh after one step, as far as masks are complete.
pub struct Finer {
    pub points: Vec<Vector>,
    /// The children of the faces, in order of their letters; their corners in the order of words.
    pub faces: Vec<Vec<usize>>,
    /// The new points of vertices, edges and faces.
    vertices: Vec<Option<usize>>,
    edges: BTreeMap<[usize; 2], usize>,
    middles: Vec<usize>,
}

impl Rules {
    pub fn is_loop(&self) -> bool {
        self.betas.is_some()
    }

    /// The share that the ring has in the new point of an interior vertex; 0 where none is known, which cannot be.
    fn beta(&self, valence: usize) -> Fixed {
        let known = self.betas.as_ref().and_then(|betas| betas.get(&valence));
        known.copied().unwrap_or(Fixed::ZERO)
    }

    /// One step.
    pub fn step(&self, mesh: &Mesh) -> Finer {
        let mean = |face: &Vec<usize>| {
            times(&sum(face.iter().map(|&i| &mesh.points[i])), 1, face.len() as i64)
        };
        let quads = !self.is_loop();
        let mut points: Vec<_> = mesh.faces.iter().filter(|_| quads).map(mean).collect();
        let middles = (0..points.len()).collect();
        let mut vertices = vec![None; mesh.points.len()];
        let mut edges = BTreeMap::new();
        for (vertex, new) in vertices.iter_mut().enumerate() {
            let Some(star) = mesh.star(vertex) else { continue };
            *new = Some(points.len());
            points.push(self.vertex_point(mesh, vertex, star, &points));
            for (spoke, &end) in star.spokes.iter().enumerate() {
                if let std::collections::btree_map::Entry::Vacant(entry) =
                    edges.entry([vertex.min(end), vertex.max(end)])
                {
                    entry.insert(points.len());
                    points.push(self.edge_point(mesh, vertex, star, spoke, &points));
                }
            }
        }
        let mut finer = Finer { points, faces: Vec::new(), vertices, edges, middles };
        let children = |(face, corners): (usize, &Vec<usize>)| {
            let middle = finer.middles.get(face).copied();
            let child = |i| finer.child(corners, middle, i);
            self.letters(corners.len()).filter_map(child).collect::<Vec<_>>()
        };
        finer.faces = mesh.faces.iter().enumerate().flat_map(children).collect();
        finer
    }

    /// The letters of the children of a face.
    pub fn letters(&self, corners: usize) -> std::ops::Range<usize> {
        0..if self.is_loop() { 4 } else { corners }
    }

    /// The new point of a vertex; `middles` begins with those of the faces (Catmull-Clark).
    fn vertex_point(&self, mesh: &Mesh, vertex: usize, star: &Star, middles: &[Vector]) -> Vector {
        let (p, n) = (&mesh.points[vertex], star.valence() as i64);
        if !star.closed {
            if self.is_pinned(star) {
                return *p;
            }
            return times(&plus(&times(p, 6, 1), &ends(mesh, star)), 1, 8);
        }
        let ring = sum(star.spokes.iter().map(|&i| &mesh.points[i]));
        if self.is_loop() {
            // P + beta (mean of the ring - P).
            let way = minus(&times(&ring, 1, n), p);
            return plus(p, &scaled(&way, self.beta(star.valence())));
        }
        let faces = sum(star.faces.iter().map(|[face, _]| &middles[*face]));
        times(&plus(&times(p, n * (n - 2), 1), &plus(&ring, &faces)), 1, n * n)
    }

    /// The new point of the edge from a vertex along one of its spokes.
    fn edge_point(
        &self,
        mesh: &Mesh,
        vertex: usize,
        star: &Star,
        spoke: usize,
        middles: &[Vector],
    ) -> Vector {
        let count = star.spokes.len();
        let ends = plus(&mesh.points[vertex], &mesh.points[star.spokes[spoke]]);
        if !star.closed && (spoke == 0 || spoke + 1 == count) {
            return times(&ends, 1, 2);
        }
        let sides = [spoke + count - 1, spoke + 1].map(|i| i % count);
        if self.is_loop() {
            let [a, b] = sides.map(|i| &mesh.points[star.spokes[i]]);
            return times(&plus(&times(&ends, 3, 1), &plus(a, b)), 1, 8);
        }
        // Face i lies between the spokes i and i + 1.
        let [a, b] = [sides[0], spoke].map(|i| &middles[star.faces[i][0]]);
        times(&plus(&ends, &plus(a, b)), 1, 4)
    }

    /// True for a vertex that stays: a sharp corner.
    fn is_pinned(&self, star: &Star) -> bool {
        self.boundary == Boundary::Sharp && star.faces.len() == 1
    }

    /// The limit of a complete vertex; `None` for the others.
    pub fn limit(&self, mesh: &Mesh, vertex: usize) -> Option<Vector> {
        let (star, p) = (mesh.star(vertex)?, &mesh.points[vertex]);
        let n = star.valence() as i64;
        if !star.closed {
            let smooth = times(&plus(&times(p, 4, 1), &ends(mesh, star)), 1, 6);
            return Some(if self.is_pinned(star) { *p } else { smooth });
        }
        let ring = sum(star.spokes.iter().map(|&i| &mesh.points[i]));
        if self.is_loop() {
            // w = 8 beta/(3 + 8 beta).
            let beta = self.beta(star.valence()).times(8, 1);
            let weight = beta.over(Fixed::ratio(3, 1) + beta);
            return Some(plus(p, &scaled(&minus(&times(&ring, 1, n), p), weight)));
        }
        // (n (n-1) P + 2 Σ e + 4 Σ f')/(n (n+5)), f' the means of the faces.
        let mean = |[face, _]: &[usize; 2]| {
            let corners = &mesh.faces[*face];
            times(&sum(corners.iter().map(|&i| &mesh.points[i])), 4, corners.len() as i64)
        };
        let faces: Vec<Vector> = star.faces.iter().map(mean).collect();
        let rest = plus(&times(&ring, 2, 1), &sum(&faces));
        Some(times(&plus(&times(p, n * (n - 1), 1), &rest), 1, n * (n + 5)))
    }
}

/// The sum of the two neighbours of a boundary vertex along the boundary.
fn ends(mesh: &Mesh, star: &Star) -> Vector {
    sum(star.spokes.first().into_iter().chain(star.spokes.last()).map(|&i| &mesh.points[i]))
}

impl Finer {
    /// The child with a letter of a face of the coarse mesh, if its points are known.
    pub fn child(
        &self,
        corners: &[usize],
        middle: Option<usize>,
        letter: usize,
    ) -> Option<Vec<usize>> {
        let m = corners.len();
        let edge = |i: usize| {
            let [a, b] = [corners[i % m], corners[(i + 1) % m]];
            self.edges.get(&[a.min(b), a.max(b)]).copied()
        };
        if letter == m {
            return Some(vec![edge(0)?, edge(1)?, edge(2)?]);
        }
        let first = self.vertices[corners[letter]];
        let (next, last) = (edge(letter), edge(letter + m - 1));
        match middle {
            None => Some(vec![first?, next?, last?]),
            Some(middle) => Some(vec![first?, next?, middle, last?]),
        }
    }

    /// The same of the first face.
    pub fn first_child(&self, corners: &[usize], letter: usize) -> Option<Vec<usize>> {
        self.child(corners, self.middles.first().copied(), letter)
    }
}
