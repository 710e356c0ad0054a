//! Loop's scheme in Stam's numbering: section 1 of FORMAT.md.

use num_rational::BigRational;

use crate::patch::Patch;
use crate::rational::ratio;
use crate::ring::Ring;
use crate::scalar::Scalar;
use crate::scheme::{Mask, Mesh, Row, Scheme, mask, row};
use crate::space::Space;

/// The label in a local net of valence 6 of each of the regular points p1..p12.
const REGULAR: [usize; 12] = [4, 5, 3, 1, 6, 10, 2, 7, 12, 9, 8, 11];

/// 24 times the matrix from twelve points to fifteen Bernstein coefficients (HW, Appendix 1).
pub const T: [[i64; 12]; 15] = [
    [2, 2, 2, 12, 2, 0, 2, 2, 0, 0, 0, 0],
    [1, 0, 3, 12, 1, 0, 4, 3, 0, 0, 0, 0],
    [0, 1, 1, 12, 3, 0, 3, 4, 0, 0, 0, 0],
    [0, 0, 4, 8, 0, 0, 8, 4, 0, 0, 0, 0],
    [0, 0, 1, 10, 1, 0, 6, 6, 0, 0, 0, 0],
    [0, 0, 0, 8, 4, 0, 4, 8, 0, 0, 0, 0],
    [0, 0, 3, 4, 0, 1, 12, 3, 0, 0, 1, 0],
    [0, 0, 1, 6, 0, 0, 10, 6, 0, 0, 1, 0],
    [0, 0, 0, 6, 1, 0, 6, 10, 0, 0, 1, 0],
    [0, 0, 0, 4, 3, 0, 3, 12, 1, 0, 1, 0],
    [0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2, 0],
    [0, 0, 1, 3, 0, 0, 12, 4, 0, 1, 3, 0],
    [0, 0, 0, 4, 0, 0, 8, 8, 0, 0, 4, 0],
    [0, 0, 0, 3, 1, 0, 4, 12, 0, 0, 3, 1],
    [0, 0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2],
];

/// Loop's scheme with the vertex weight of one valence; regular vertices have 3/8.
pub struct Loop {
    n: usize,
    beta: Scalar,
    /// 3 + 8 beta.
    q: Scalar,
}

/// The ring of label 1, 2 or n + 1, in order; empty for the other labels.
fn ring(n: usize, label: usize) -> Vec<usize> {
    match label {
        1 => (2..=n + 1).collect(),
        2 => vec![1, n + 1, n + 2, n + 3, n + 4, 3],
        _ if label == n + 1 => vec![1, 2, n + 2, n + 5, n + 6, n],
        _ => Vec::new(),
    }
}

/// The neighbours of b in the ring of a (b itself, should it not be there).
fn opposite(n: usize, (a, b): (usize, usize)) -> [usize; 2] {
    let ring = ring(n, a);
    let at = ring.iter().position(|&label| label == b);
    at.map_or([b, b], |i| [i + ring.len() - 1, i + 1].map(|i| ring[i % ring.len()]))
}

/// `centre y_label + share (the sum of its ring)`.
fn star(n: usize, label: usize, centre: Scalar, share: &Scalar) -> Mask {
    let ring = ring(n, label).into_iter().map(|i| (share.clone(), i));
    ring.chain([(centre, label)]).collect()
}

/// The labels in the extended net of the points p1..p12 of tile 1, 2 or 3.
fn tile(n: usize, letter: u8) -> [usize; 12] {
    let e = |i: usize| n + i;
    match letter {
        1 => [3, 1, e(4), 2, e(1), e(7), e(3), e(2), e(5), e(8), e(9), e(10)],
        2 => [e(10), e(9), e(5), e(2), e(3), e(6), e(1), 2, e(4), n, 1, 3],
        _ => [1, n, 2, e(1), e(6), e(3), e(2), e(5), e(12), e(9), e(10), e(11)],
    }
}

impl Loop {
    /// The setting of Loop's scheme with a valence and its beta, an element of the ring.
    pub fn space(n: usize, ring: Ring, beta: Scalar) -> Space {
        let q = &Scalar::integer(3) + &beta.scale(&ratio(8, 1));
        let scheme = Self { n, beta: beta.clone(), q: q.clone() };
        Space::of(Box::new(scheme), n, ring, beta, q)
    }

    /// The new point of a vertex, with the weight of its valence.
    fn vertex(&self, n: usize, label: usize) -> Mask {
        let beta = if label == 1 && n == self.n {
            self.beta.clone()
        } else {
            Scalar::constant(&ratio(3, 8))
        };
        let size = ring(n, label).len() as i64;
        star(n, label, &Scalar::integer(1) - &beta, &beta.scale(&ratio(1, size)))
    }

    /// The point of the extended net of the next level with a label from 1 to n + 12.
    fn refined(&self, n: usize, label: usize) -> Mask {
        let edge = |(a, b)| {
            let [c, d] = opposite(n, (a, b));
            mask([(3, 8, a), (3, 8, b), (1, 8, c), (1, 8, d)])
        };
        match label.checked_sub(n + 2) {
            None if label == 1 => self.vertex(n, 1),
            None => edge((1, label)),
            Some(1) => self.vertex(n, 2),
            Some(3) => self.vertex(n, n + 1),
            Some(0) => edge((2, n + 1)),
            Some(2) => edge((2, 3)),
            Some(4) => edge((n + 1, n)),
            Some(5) => edge((2, n + 4)),
            Some(6) => edge((2, n + 3)),
            Some(7) => edge((2, n + 2)),
            Some(8) => edge((n + 1, n + 2)),
            Some(9) => edge((n + 1, n + 5)),
            Some(_) => edge((n + 1, n + 6)),
        }
    }

    /// q times S at a vertex with a regular ring.
    fn regular_limit(&self, n: usize, label: usize) -> Mask {
        let [centre, share] = [ratio(1, 2), ratio(1, 12)].map(|x| self.q.scale(&x));
        star(n, label, centre, &share)
    }
}

impl Scheme for Loop {
    fn regular(&self) -> usize {
        6
    }

    fn size(&self, n: usize) -> usize {
        n + 6
    }

    fn patch(&self) -> Patch {
        Patch::Triangle
    }

    fn child(&self, n: usize, letter: u8) -> Vec<Mask> {
        if letter == 0 {
            return (1..=n + 6).map(|label| self.refined(n, label)).collect();
        }
        // The tile's points, in the order of their labels in the new net.
        let mut tile: Vec<_> = REGULAR.into_iter().zip(tile(n, letter)).collect();
        tile.sort_unstable();
        tile.into_iter().map(|(_, label)| self.refined(n, label)).collect()
    }

    fn surface(&self) -> Vec<Mask> {
        let coefficient = |row: &[i64; 12]| {
            let terms = row.iter().zip(REGULAR).filter(|(c, _)| **c != 0);
            terms.map(|(c, label)| (self.q.scale(&ratio(*c, 24)), label)).collect()
        };
        T.iter().map(coefficient).collect()
    }

    fn limit(&self, n: usize) -> Mask {
        if n != self.n {
            return self.regular_limit(n, 1);
        }
        star(n, 1, Scalar::integer(3), &self.beta.scale(&ratio(8, n as i64)))
    }

    fn mesh(&self, mesh: Mesh, n: usize, _: &[u8]) -> Option<Vec<Mask>> {
        let other = |label| match mesh {
            Mesh::Control => vec![(self.q.clone(), label)],
            Mesh::Limit => self.regular_limit(n, label),
        };
        let first = if mesh == Mesh::Control { other(1) } else { self.limit(n) };
        Some(vec![first, other(2), other(n + 1)])
    }

    fn differences(&self, n: usize) -> Vec<Row> {
        let first = (2..=n + 1).map(|b| (1, b));
        let second = [n + 1, n + 2, n + 3, n + 4, 3].map(|b| (2, b));
        let third = [n, n + 6, n + 5, n + 2].map(|b| (n + 1, b));
        let difference = |(a, b)| {
            let [c, d] = opposite(n, (a, b));
            row(&[(a, 1), (b, 1), (c, -1), (d, -1)])
        };
        first.chain(second).chain(third).map(difference).collect()
    }

    fn points(&self) -> Vec<usize> {
        REGULAR.to_vec()
    }

    fn bend(&self, mesh: Mesh) -> Option<BigRational> {
        Some(if mesh == Mesh::Control { ratio(1, 2) } else { ratio(1, 3) })
    }
}
