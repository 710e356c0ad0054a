//! Parts of the faces of a surface: their nets, what the surface over them is in the hull of, their children.

use std::collections::BTreeMap;

use super::distance::{plus, times};
use super::polygon_mesh::{Mesh, Vector};
use super::refine::{Finer, Rules};
use crate::catmull_clark::LINE;
use crate::fixed::Fixed;
use crate::loop_scheme::T;

/// A part of a face.
pub struct Part {
    /// The faces that have a vertex in common with the part, which is the first of them; its corners are complete.
    pub net: Mesh,
}

/// What the surface over a part is in the hull of.
pub struct Hull {
    pub points: Vec<Vector>,
    /// True if these are the Bernstein coefficients.
    pub is_regular: bool,
}

impl Part {
    /// The part that a face of a mesh is; its corners must be complete.
    pub fn of_face(mesh: &Mesh, face: usize) -> Option<Self> {
        let corners = mesh.faces.get(face)?;
        let stars = corners.iter().map(|&i| mesh.star(i)).collect::<Option<Vec<_>>>()?;
        let mut round: Vec<usize> =
            stars.iter().flat_map(|star| star.faces.iter().map(|[face, _]| *face)).collect();
        round.sort_unstable();
        round.dedup();
        let others = round.into_iter().filter(|&other| other != face);
        Self::gather(&mesh.points, corners, others.map(|other| &mesh.faces[other][..]))
    }

    /// The part with these corners, and the faces round it.
    fn gather<'a>(
        points: &[Vector],
        corners: &'a [usize],
        others: impl Iterator<Item = &'a [usize]>,
    ) -> Option<Self> {
        let (mut names, mut net) = (BTreeMap::new(), Vec::new());
        let mut name = |&i: &usize| {
            *names.entry(i).or_insert_with(|| {
                net.push(points[i]);
                net.len() - 1
            })
        };
        let faces: Vec<Vec<usize>> = std::iter::once(corners)
            .chain(others)
            .map(|face| face.iter().map(&mut name).collect())
            .collect();
        let complete: Vec<usize> = (0..corners.len()).collect();
        Some(Self { net: Mesh::new(net, faces, &complete).ok()? })
    }

    /// The number of corners; they are the first points of the net.
    pub fn corners(&self) -> usize {
        self.net.faces[0].len()
    }

    /// The child with a letter, from the net after one step.
    pub fn child(&self, finer: &Finer, letter: usize) -> Option<Self> {
        let corners = finer.first_child(&self.net.faces[0], letter)?;
        let touches = |face: &&Vec<usize>| {
            **face != corners && face.iter().any(|vertex| corners.contains(vertex))
        };
        let others = finer.faces.iter().filter(touches).map(|face| &face[..]);
        Self::gather(&finer.points, &corners, others)
    }

    /// What the surface is in the hull of.
    pub fn hull(&self, rules: &Rules) -> Hull {
        let regular = if rules.is_loop() { self.triangle() } else { self.square() };
        match regular {
            Some(points) => Hull { points, is_regular: true },
            None => Hull { points: self.net.points.clone(), is_regular: false },
        }
    }

    /// The neighbours of a corner, from the next corner on, if it is interior and has this valence.
    fn ring(&self, corner: usize, valence: usize) -> Option<Vec<usize>> {
        let star = self.net.star(corner).filter(|star| star.closed)?;
        let mut ring = star.spokes.clone();
        ring.rotate_left(star.position(0)?);
        (ring.len() == valence).then_some(ring)
    }

    /// The coefficients of the quartic triangle, if the part is regular.
    fn triangle(&self) -> Option<Vec<Vector>> {
        // With the corners 4, 7, 8, the rings of p1..p12 are these, each from the next corner on.
        let [a, b, c] = [self.ring(0, 6)?, self.ring(1, 6)?, self.ring(2, 6)?];
        let names = [a[4], a[3], a[5], 0, a[2], b[3], 1, 2, c[4], b[4], b[5], c[3]];
        let points = names.map(|i| self.net.points[i]);
        let coefficient = |row: &[i64; 12]| times(&combination(row, &points), 1, 24);
        Some(T.iter().map(coefficient).collect())
    }

    /// The coefficients of the bicubic square, if the part is regular.
    fn square(&self) -> Option<Vec<Vector>> {
        if self.net.faces.iter().any(|face| face.len() != 4) {
            return None;
        }
        // Round each corner: the neighbours, and the corners opposite to it in the faces at it.
        let mut grid = [[[Fixed::ZERO; 3]; 4]; 4];
        for (corner, [x, y]) in [[1_usize, 1], [2, 1], [2, 2], [1, 2]].into_iter().enumerate() {
            let ring = self.ring(corner, 4)?;
            let star = self.net.star(corner)?;
            let first = star.position(0)?;
            // Step 0 leads to the next corner; the steps turn with the corners.
            let step = |i: usize| [[1, 0], [0, 1], [-1, 0], [0, -1_isize]][(i + corner) % 4];
            for (i, &neighbour) in ring.iter().enumerate() {
                let ([dx, dy], [ex, ey]) = (step(i), step(i + 1));
                let [face, place] = star.faces[(first + i) % 4];
                let opposite = self.net.faces[face][(place + 2) % 4];
                let mut put = |dx: isize, dy: isize, vertex: usize| {
                    grid[y.wrapping_add_signed(dy)][x.wrapping_add_signed(dx)] =
                        self.net.points[vertex];
                };
                put(dx, dy, neighbour);
                put(dx + ex, dy + ey, opposite);
            }
        }
        let along_u = grid.map(|row| LINE.map(|weights| combination(&weights, &row)));
        let coefficient = |(i, j): (usize, usize)| {
            let column = [0, 1, 2, 3].map(|row| along_u[row][i]);
            times(&combination(&LINE[j], &column), 1, 36)
        };
        let indices = (0..4).flat_map(|j| (0..4).map(move |i| (i, j)));
        Some(indices.map(coefficient).collect())
    }
}

fn combination(weights: &[i64], points: &[Vector]) -> Vector {
    let terms = weights.iter().zip(points).filter(|(weight, _)| **weight != 0);
    terms.fold([Fixed::ZERO; 3], |sum, (weight, point)| plus(&sum, &times(point, *weight, 1)))
}
