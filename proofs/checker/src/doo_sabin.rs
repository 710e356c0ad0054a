//! The Doo-Sabin scheme: section 8 of FORMAT.md.

use num_rational::BigRational;

use crate::lattice::{CORNERS, Lattice, Line, Place};
use crate::patch::Patch;
use crate::rational::ratio;
use crate::scalar::Scalar;
use crate::scheme::{Mask, Mesh, Row, Scheme, mask, row};

/// The Doo-Sabin scheme with the `cos(2πk/n)`, k = 0..n-1, of its extraordinary face.
pub struct DooSabin(pub Vec<Scalar>);

impl DooSabin {
    /// The Bernstein coefficient (i, j) of S over the word of a net: a point of its control polygon. Only (0, 0) is known
    /// of an extraordinary word without more letters.
    fn coefficient(&self, n: usize, (i, j): Place) -> Mask {
        let line = |i: i64| match i {
            0 => vec![(-1, ratio(1, 2)), (0, ratio(1, 2))],
            1 => vec![(0, ratio(1, 1))],
            _ => vec![(0, ratio(1, 2)), (1, ratio(1, 2))],
        };
        if (i, j) == (0, 0) { self.limit(n) } else { self.tensor(n, &line(i), &line(j)) }
    }
}

impl Lattice for DooSabin {
    const INNER: &'static [Place] = &[(0, 0), (0, -1), (-1, -1), (-1, 0)];
    const OUTER: &'static [Place] = &[(1, -1), (1, 0), (1, 1), (0, 1), (-1, 1)];

    fn inner(&self, n: usize) -> usize {
        n
    }

    fn inner_label(&self, n: usize, index: usize) -> usize {
        if index == 3 { n } else { index + 1 }
    }

    /// The corner of the face at `P_i`: `P_i + Σ_j (3 + 2 cos(2π(j-i)/n))/(4n) (P_j - P_i)`.
    fn inner_point(&self, n: usize, label: usize) -> Mask {
        if n != self.0.len() {
            return mask((0..4).map(|k| ([9, 3, 1, 3][k], 16, 1 + (label - 1 + k) % 4)));
        }
        let mut rest = Scalar::integer(1);
        let mut terms = Mask::new();
        for k in 1..n {
            let cosine = self.0[k].scale(&ratio(2, 1));
            let weight = (&Scalar::integer(3) + &cosine).scale(&ratio(1, 4 * n as i64));
            rest = &rest - &weight;
            terms.push((weight, 1 + (label - 1 + k) % n));
        }
        terms.push((rest, label));
        terms
    }

    /// Quadratic B-splines.
    fn line(&self, position: i64) -> Line {
        let i = position.div_euclid(2);
        match position.rem_euclid(2) {
            0 => vec![(i - 1, ratio(1, 4)), (i, ratio(3, 4))],
            _ => vec![(i, ratio(3, 4)), (i + 1, ratio(1, 4))],
        }
    }
}

impl Scheme for DooSabin {
    fn regular(&self) -> usize {
        4
    }

    fn size(&self, n: usize) -> usize {
        n + 5
    }

    fn patch(&self) -> Patch {
        Patch::Square(2)
    }

    /// The empty word's square belongs to a vertex; the part of it in the extraordinary face is its quarter 0.
    fn root(&self) -> usize {
        1
    }

    fn child(&self, n: usize, letter: u8) -> Vec<Mask> {
        self.refined_net(n, letter)
    }

    fn surface(&self) -> Vec<Mask> {
        let places = (0..3).flat_map(|j| (0..3).map(move |i| (i, j)));
        places.map(|place| self.coefficient(4, place)).collect()
    }

    /// The centroid of the face.
    fn limit(&self, n: usize) -> Mask {
        mask((1..=n).map(|label| (1, n as i64, label)))
    }

    /// F_0 is bilinear on the quarters of the net's word, with the coefficients of S as values at their corners.
    fn mesh(&self, mesh: Mesh, n: usize, rest: &[u8]) -> Option<Vec<Mask>> {
        let (a, b) = CORNERS[usize::from(*rest.first()?)];
        let corner = |(i, j): Place| self.coefficient(n, (a + i, b + j));
        (mesh == Mesh::Control).then(|| CORNERS.map(corner).to_vec())
    }

    fn differences(&self, n: usize) -> Vec<Row> {
        let six = [
            (2, 1, n + 4),
            (n, 1, n + 2),
            (3, 2, n + 1),
            (n - 1, n, n + 5),
            (n + 1, n + 2, n + 3),
            (n + 5, n + 4, n + 3),
        ];
        let bends = six.into_iter().map(|(a, b, c)| row(&[(a, 1), (c, 1), (b, -2)]));
        let pairs = (1..=n).flat_map(|i| (i + 1..=n).map(move |j| row(&[(j, 1), (i, -1)])));
        bends.chain(pairs.filter(|_| n != 4)).collect()
    }

    fn points(&self) -> Vec<usize> {
        let places = (-1..=1).flat_map(|j| (-1..=1).map(move |i| (i, j)));
        places.map(|place| self.label(4, place)).collect()
    }

    fn bend(&self, mesh: Mesh) -> Option<BigRational> {
        (mesh == Mesh::Control).then(|| ratio(1, 4))
    }
}
