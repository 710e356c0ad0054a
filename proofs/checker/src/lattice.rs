//! What Catmull-Clark and Doo-Sabin share: labels with lattice positions about the face's corner 0, and tensor masks.

use num_rational::BigRational;

use crate::scalar::Scalar;
use crate::scheme::Mask;

/// A position of the lattice.
pub type Place = (i64, i64);

/// The corners of the unit square, and the positions of the quarters, in the order of the letters.
pub const CORNERS: [Place; 4] = [(0, 0), (1, 0), (1, 1), (0, 1)];

/// The weights of positions along one direction.
pub type Line = Vec<(i64, BigRational)>;

/// A scheme on a lattice with one extraordinary vertex or face.
pub trait Lattice {
    /// The positions of the labels that have rules of their own; all of them at valence 4.
    const INNER: &'static [Place];
    /// The positions of the other labels, in order.
    const OUTER: &'static [Place];

    /// The number of labels with rules of their own.
    fn inner(&self, n: usize) -> usize;

    /// The label at a position of `INNER`, by its index.
    fn inner_label(&self, n: usize, index: usize) -> usize;

    /// The point of the next level with a label that has a rule of its own.
    fn inner_point(&self, n: usize, label: usize) -> Mask;

    /// The positions that make up a position of the halved lattice, along either direction.
    fn line(&self, position: i64) -> Line;

    /// The label at a position, if it is one with a rule of its own.
    fn inner_at(&self, n: usize, place: Place) -> Option<usize> {
        assert!(place != (-1, -1) || n == 4, "there is no lattice behind the corner 0");
        let index = Self::INNER.iter().position(|&other| other == place);
        index.map(|index| self.inner_label(n, index))
    }

    /// The label at a position.
    fn label(&self, n: usize, place: Place) -> usize {
        let outer = || Self::OUTER.iter().position(|&other| other == place);
        let label = self.inner_at(n, place).or_else(|| Some(self.inner(n) + 1 + outer()?));
        label.unwrap_or_else(|| unreachable!("{place:?} is no position of a local net"))
    }

    /// The product of two lines.
    fn tensor(&self, n: usize, u: &Line, v: &Line) -> Mask {
        let terms = v.iter().flat_map(|(j, y)| u.iter().map(move |(i, x)| (x * y, (*i, *j))));
        terms.map(|(c, place)| (Scalar::constant(&c), self.label(n, place))).collect()
    }

    /// The point of the next level at a position of the halved lattice.
    fn refined(&self, n: usize, place: Place) -> Mask {
        match self.inner_at(n, place) {
            Some(label) => self.inner_point(n, label),
            None => self.tensor(n, &self.line(place.0), &self.line(place.1)),
        }
    }

    /// The points of the net of a word with one letter more: round the new extraordinary vertex or face for letter 0,
    /// else (or at valence 4) those of valence 4, moved by the position of the quarter.
    fn refined_net(&self, n: usize, letter: u8) -> Vec<Mask> {
        let (a, b) = CORNERS[usize::from(letter)];
        let at = |&(i, j): &Place| self.refined(n, (i + a, j + b));
        let outer = Self::OUTER.iter().map(at);
        if letter == 0 {
            return (1..=self.inner(n))
                .map(|label| self.inner_point(n, label))
                .chain(outer)
                .collect();
        }
        Self::INNER.iter().map(at).chain(outer).collect()
    }
}
