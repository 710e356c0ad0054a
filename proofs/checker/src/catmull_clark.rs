//! The Catmull-Clark scheme: section 8 of FORMAT.md.

use num_rational::BigRational;

use crate::claim::Norm;
use crate::lattice::{CORNERS, Lattice, Line, Place};
use crate::patch::Patch;
use crate::rational::ratio;
use crate::scheme::{Mask, Mesh, Row, Scheme, mask, row};

/// 6 times the matrix from four points to the Bernstein coefficients of a cubic B-spline.
pub const LINE: [[i64; 4]; 4] = [[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]];

/// The Catmull-Clark scheme with a norm, `second` or `first`.
pub struct CatmullClark(pub Norm);

/// The ring label that stands for i, cyclic from 2 to 2n + 1.
fn cyclic(n: usize, i: usize) -> usize {
    2 + (i + 2 * n - 2) % (2 * n)
}

impl Lattice for CatmullClark {
    const INNER: &'static [Place] =
        &[(0, 0), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1)];
    const OUTER: &'static [Place] = &[(2, 2), (2, 1), (2, 0), (2, -1), (1, 2), (0, 2), (-1, 2)];

    fn inner(&self, n: usize) -> usize {
        2 * n + 1
    }

    fn inner_label(&self, n: usize, index: usize) -> usize {
        if index == 0 { 1 } else { cyclic(n, index + 1) }
    }

    /// With the face points put in: the vertex point, edge points (even labels), face points (odd labels).
    fn inner_point(&self, n: usize, label: usize) -> Mask {
        let m = n as i64;
        let near = |step: usize| cyclic(n, label + 2 * n + step - 2);
        match (label, label % 2) {
            // (n-2)/n P + (Σ edge + Σ face)/n^2, and Σ face = (n P + 2 Σ edge + Σ diagonal)/4.
            (1, _) => {
                let ring = (2..=2 * n + 1).map(|i| (if i % 2 == 0 { 6 } else { 1 }, 4 * m * m, i));
                mask(ring.chain([(4 * m - 7, 4 * m, 1)]))
            }
            // (P + Q + face + face)/4: near(2) is the label itself.
            (_, 0) => mask([
                (6, 16, 1),
                (6, 16, label),
                (1, 16, near(0)),
                (1, 16, near(1)),
                (1, 16, near(3)),
                (1, 16, near(4)),
            ]),
            _ => mask([(1, 4, 1), (1, 4, near(1)), (1, 4, label), (1, 4, near(3))]),
        }
    }

    /// Cubic B-splines.
    fn line(&self, position: i64) -> Line {
        let i = position.div_euclid(2);
        match position.rem_euclid(2) {
            0 => vec![(i - 1, ratio(1, 8)), (i, ratio(3, 4)), (i + 1, ratio(1, 8))],
            _ => vec![(i, ratio(1, 2)), (i + 1, ratio(1, 2))],
        }
    }
}

impl Scheme for CatmullClark {
    fn regular(&self) -> usize {
        4
    }

    fn size(&self, n: usize) -> usize {
        2 * n + 8
    }

    fn patch(&self) -> Patch {
        Patch::Square(3)
    }

    fn child(&self, n: usize, letter: u8) -> Vec<Mask> {
        self.refined_net(n, letter)
    }

    fn surface(&self) -> Vec<Mask> {
        let line = |i: usize| -> Line {
            (-1..).zip(LINE[i].map(|c| ratio(c, 6))).filter(|(_, c)| *c != ratio(0, 1)).collect()
        };
        let coefficient = |(i, j)| self.tensor(4, &line(i), &line(j));
        (0..4).flat_map(|j| (0..4).map(move |i| (i, j))).map(coefficient).collect()
    }

    fn limit(&self, n: usize) -> Mask {
        let m = n as i64;
        let ring = (2..=2 * n + 1).map(|i| (if i % 2 == 0 { 4 } else { 1 }, m * (m + 5), i));
        mask(ring.chain([(m, m + 5, 1)]))
    }

    fn mesh(&self, mesh: Mesh, n: usize, _: &[u8]) -> Option<Vec<Mask>> {
        let line = |i: i64| vec![(i - 1, ratio(1, 6)), (i, ratio(2, 3)), (i + 1, ratio(1, 6))];
        let corner = |place: Place| match (mesh, place) {
            (Mesh::Control, _) => mask([(1, 1, self.label(n, place))]),
            (Mesh::Limit, (0, 0)) => self.limit(n),
            (Mesh::Limit, (i, j)) => self.tensor(n, &line(i), &line(j)),
        };
        Some(CORNERS.map(corner).to_vec())
    }

    fn differences(&self, n: usize) -> Vec<Row> {
        let m = 2 * n;
        if self.0 == Norm::First {
            let round = |a, list: &[usize]| list.iter().map(|&b| (a, b)).collect::<Vec<_>>();
            let pairs = [
                round(1, &(2..=m + 1).collect::<Vec<_>>()),
                round(6, &[7, cyclic(n, 8), m + 3, m + 4, m + 5, 5, 4]),
                round(5, &[4, m + 2, m + 3, m + 4, m + 6, m + 7]),
                round(4, &[2, 3, m + 6, m + 7, m + 8]),
            ];
            return pairs.concat().into_iter().map(|(a, b)| row(&[(b, 1), (a, -1)])).collect();
        }
        let across = (1..=n).map(|j| (2 * j, 1, cyclic(n, 2 * j + 4)));
        let around = (1..=n).map(|j| (cyclic(n, 2 * j - 1), 2 * j, 2 * j + 1));
        let others = [
            (cyclic(n, 8), 7, m + 5),
            (1, 6, m + 4),
            (4, 5, m + 3),
            (m + 8, m + 7, m + 6),
            (m + 7, m + 6, m + 2),
            (2, 3, m + 8),
            (1, 4, m + 7),
            (6, 5, m + 6),
            (m + 5, m + 4, m + 3),
            (m + 4, m + 3, m + 2),
        ];
        let bend = |(a, b, c)| row(&[(b, 2), (a, -1), (c, -1)]);
        across.chain(around).chain(others).map(bend).collect()
    }

    fn points(&self) -> Vec<usize> {
        let places = (-1..=2).flat_map(|j| (-1..=2).map(move |i| (i, j)));
        places.map(|place| self.label(4, place)).collect()
    }

    fn bend(&self, mesh: Mesh) -> Option<BigRational> {
        let factor = if mesh == Mesh::Control { ratio(1, 3) } else { ratio(1, 4) };
        (self.0 == Norm::Second).then_some(factor)
    }
}
