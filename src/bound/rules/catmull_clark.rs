//! Catmull-Clark.

use super::{Layout, Norm, Rules, log2};
use crate::bernstein::from_net::bicubic;
use crate::bound::arithmetic::Arithmetic;
use crate::bound::nets::{Against, Net};
use crate::bound::shape::Shape;
use crate::bound::word::Word;
use crate::scheme::IntegerRow;
use crate::scheme::catmull_clark::{self as scheme, REGULAR_LABELS};

/// At valence n >= 3.
#[derive(Clone, Copy, Debug)]
pub struct CatmullClark {
    /// The valence.
    pub n: u32,
    /// The norm.
    pub norm: Norm,
}

const REGULAR: u32 = 4;

impl<A: Arithmetic> Rules<A> for CatmullClark {
    fn layout(&self) -> Layout {
        Layout {
            shape: Shape::Bicubic,
            root: Word::EMPTY,
            size: scheme::local_net_size(self.n),
            valence: self.n,
            regular: REGULAR,
            labels: &REGULAR_LABELS,
            tile_labels: |n, tile| scheme::tile_labels(n, tile).to_vec(),
        }
    }

    fn differences(&self, valence: u32) -> Vec<IntegerRow> {
        match self.norm {
            Norm::First => scheme::first_differences(valence),
            Norm::Second | Norm::Face => scheme::second_differences(valence),
        }
    }

    fn refine(&self, _: &A, _extraordinary: bool, valence: u32, local: &[A::V]) -> Vec<A::V> {
        scheme::extended_net::<A::S, A::V>(valence, local)
    }

    fn surface(&self, points: &[A::V]) -> Vec<A::V> {
        let points = std::array::from_fn(|i| points[i].clone());
        bicubic::<A::S, A::V>(&points).0.to_vec()
    }

    fn limit(&self, _: &A, net: &[A::V]) -> A::V {
        let at = |i: usize| &net[scheme::ring_label(self.n, i) - 1];
        let sum = |first: usize| {
            let ring = (1..self.n as usize).map(|j| at(2 * j + first));
            ring.fold(at(first).clone(), |sum, p| sum + p)
        };
        scheme::limit_mask::<A::S>(self.n).apply(&net[0], &sum(2), &sum(3))
    }

    fn mesh(&self, arithmetic: &A, net: &Net<A::V>, _letter: u8, against: Against) -> Vec<A::V> {
        match (against, net) {
            (Against::Control, Net::Extraordinary(p)) => {
                [0, 5, 4, 3].map(|i| p[i].clone()).to_vec()
            }
            (Against::Control, Net::Regular(p)) => [5, 6, 10, 9].map(|i| p[i].clone()).to_vec(),
            (Against::Limit, Net::Regular(points)) => {
                let bezier = Rules::<A>::surface(self, points);
                [0, 3, 15, 12].map(|i| bezier[i].clone()).to_vec()
            }
            (Against::Limit, Net::Extraordinary(points)) => {
                let mask = scheme::limit_mask::<A::S>(REGULAR);
                let at = |x: i32, y: i32| {
                    let p = |i: i32, j: i32| {
                        let label = scheme::lattice_label(self.n, x + i, y + j);
                        points[label.expect("the ring of a corner") - 1].clone()
                    };
                    let edges = p(1, 0) + &p(0, 1) + &p(-1, 0) + &p(0, -1);
                    let diagonals = p(1, 1) + &p(-1, 1) + &p(-1, -1) + &p(1, -1);
                    mask.apply(&p(0, 0), &edges, &diagonals)
                };
                let corner = Rules::<A>::limit(self, arithmetic, points);
                vec![corner, at(1, 0), at(1, 1), at(0, 1)]
            }
        }
    }

    fn scale(&self, _: &A, functional: &A::V) -> A::V {
        functional.clone()
    }

    /// All points are convex combinations: the numerators are at most the denominators. A step has the
    /// denominator 64 or, at the extraordinary vertex, 4 n^2; Bernstein form has 36, the limit mask
    /// n (n + 5), the nodes of F 9 4^len; the difference of two terms doubles, a difference makes four.
    fn bits(&self, word: Word) -> u32 {
        let n = u64::from(self.n);
        let (len, zeros) = (word.len() as u32, word.leading_zeros() as u32);
        6 * len + zeros * log2(n * n) + 2 * len + log2(n * (n + 5)) + 16
    }

    fn inverse_bits(&self) -> u32 {
        2 * log2(u64::from(self.n)) + 8
    }

    /// A difference of a refined regular net is a mean of differences, over 4. `control`: a cubic spline
    /// misses its polygon by at most M/6 (CY (1)), the tensor product by twice that. `limit`: the second
    /// derivatives along u and v are means of second differences, and a chord is missed by at most an
    /// eighth of the largest.
    fn regular_factor(&self, against: Against) -> Option<(i64, i64)> {
        match (self.norm, against) {
            (Norm::Second, Against::Control) => Some((1, 3)),
            (Norm::Second, Against::Limit) => Some((1, 4)),
            _ => None,
        }
    }
}
