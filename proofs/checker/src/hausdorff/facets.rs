//! The mesh F: its facets, triangles and bilinear patches, and their parts.

use num_rational::BigRational;
use num_traits::{One, Signed};

use super::claim::Cut;
use super::distance::{between, middle, minus, plus, sum, times};
use super::polygon_mesh::Vector;
use crate::fixed::Fixed;

/// A triangle or a bilinear patch, its corners in order.
#[derive(Clone, Copy, Debug)]
pub enum Patch {
    Triangle([Vector; 3]),
    Bilinear([Vector; 4]),
}

/// A facet, and what it is of the mesh.
#[derive(Debug)]
pub struct Facet {
    pub patch: Patch,
    pub face: usize,
    /// The letter of the quarter, where a face consists of bilinear quarters.
    pub quarter: Option<u8>,
}

/// The facets of a mesh, in the order of its faces.
pub fn facets(points: &[Vector], faces: &[Vec<usize>], cut: Cut) -> Vec<Facet> {
    let mut all = Vec::new();
    for (face, corners) in faces.iter().enumerate() {
        let at: Vec<Vector> = corners.iter().map(|&i| points[i]).collect();
        let mut push = |patch, quarter| all.push(Facet { patch, face, quarter });
        match (&at[..], cut) {
            (&[a, b, c], _) => push(Patch::Triangle([a, b, c]), None),
            (_, Cut::Triangles) => {
                for pair in at[1..].windows(2) {
                    push(Patch::Triangle([at[0], pair[0], pair[1]]), None);
                }
            }
            (&[a, b, c, d], Cut::Bilinear) => push(Patch::Bilinear([a, b, c, d]), None),
            (_, Cut::Bilinear) => {
                for letter in 0..at.len() {
                    push(Patch::Bilinear(quarter(&at, letter)), Some(letter as u8));
                }
            }
        }
    }
    all
}

/// The bilinear quarter of a polygon at a corner: corner, middle, centroid, middle.
pub fn quarter(at: &[Vector], letter: usize) -> [Vector; 4] {
    let (m, corner) = (at.len(), at[letter]);
    let [next, last] = [letter + 1, letter + m - 1].map(|i| middle(&corner, &at[i % m]));
    [corner, next, times(&sum(at), 1, m as i64), last]
}

impl Patch {
    pub fn corners(&self) -> &[Vector] {
        match self {
            Self::Triangle(corners) => corners,
            Self::Bilinear(corners) => corners,
        }
    }

    /// The quarter with a letter, 0 to 3: as the words of faces.
    pub fn child(&self, letter: u8) -> Self {
        match self {
            Self::Triangle([a, b, c]) => {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                Self::Triangle(match letter {
                    0 => [*a, ab, ca],
                    1 => [*b, bc, ab],
                    2 => [*c, ca, bc],
                    _ => [ab, bc, ca],
                })
            }
            Self::Bilinear(corners) => Self::Bilinear(quarter(corners, usize::from(letter % 4))),
        }
    }

    /// The point with parameters: from the first corner towards the second, and towards the last.
    pub fn point(&self, [v, w]: [&BigRational; 2]) -> Option<Vector> {
        let inside = |x: &BigRational| !x.is_negative() && x <= &BigRational::one();
        if !inside(v) || !inside(w) {
            return None;
        }
        match self {
            Self::Triangle([a, b, c]) => {
                let way = minus(&between(a, c, w), a);
                inside(&(v + w)).then(|| plus(&between(a, b, v), &way))
            }
            Self::Bilinear([a, b, c, d]) => Some(between(&between(a, b, v), &between(d, c, v), w)),
        }
    }

    /// The Bernstein coefficients of the affine or bilinear function in the degree of the surface.
    pub fn raised(&self) -> Vec<Vector> {
        let mix = |weights: &[i64]| {
            let terms = weights.iter().zip(self.corners());
            terms.fold([Fixed::ZERO; 3], |sum, (weight, corner)| {
                plus(&sum, &times(corner, *weight, 1))
            })
        };
        match self {
            Self::Triangle(_) => {
                let rows = (0..=4).flat_map(|row| (0..=row).map(move |k| [4 - row, row - k, k]));
                rows.map(|weights| times(&mix(&weights), 1, 4)).collect()
            }
            Self::Bilinear(_) => {
                let nodes = (0..=3).flat_map(|j| (0..=3).map(move |i| (i, j)));
                let weights =
                    |(i, j): (i64, i64)| [(3 - i) * (3 - j), i * (3 - j), i * j, (3 - i) * j];
                nodes.map(|node| times(&mix(&weights(node)), 1, 9)).collect()
            }
        }
    }
}
