//! Loop's scheme.

use num_traits::Zero;

use super::{Layout, Rules, log2};
use crate::bernstein::from_net::box_spline;
use crate::bound::arithmetic::Arithmetic;
use crate::bound::nets::{Against, Net};
use crate::bound::shape::Shape;
use crate::bound::word::Word;
use crate::scalar::Ring;
use crate::scheme::loop_scheme::{self, REGULAR_LABELS};
use crate::scheme::{IntegerRow, LoopWeights};

/// At valence n >= 3, with any ring weight: the arithmetic has b.
///
/// `v = P + b (Σ P_i - n P)`, and with q = 3 + 8 n b the limit mask of
/// [`loop_scheme::limit_mask`] is `q v_∞ = 3 P + 8 b Σ P_i`.
#[derive(Clone, Copy, Debug)]
pub struct Loop {
    /// The valence.
    pub n: u32,
}

const REGULAR: u32 = 6;

/// The vertex point `P + b (Σ P_i - n P)` from the sum of the ring.
pub fn vertex_point<A: Arithmetic>(arithmetic: &A, n: u32, center: &A::V, sum: &A::V) -> A::V {
    let n = A::S::from_integer(i64::from(n));
    let pull = sum.clone() - &(center.clone() * &n);
    center.clone() + &arithmetic.times_weight(&pull)
}

impl<A: Arithmetic> Rules<A> for Loop {
    fn layout(&self) -> Layout {
        Layout {
            shape: Shape::Triangle,
            root: Word::EMPTY,
            size: loop_scheme::local_net_size(self.n),
            valence: self.n,
            regular: REGULAR,
            labels: &REGULAR_LABELS,
            tile_labels: |n, tile| loop_scheme::tile_labels(n, tile).to_vec(),
        }
    }

    fn differences(&self, valence: u32) -> Vec<IntegerRow> {
        loop_scheme::second_differences(valence)
    }

    fn refine(
        &self,
        arithmetic: &A,
        extraordinary: bool,
        valence: u32,
        local: &[A::V],
    ) -> Vec<A::V> {
        if !extraordinary {
            return loop_scheme::extended_net::<A::S, A::V>(LoopWeights::Warren, valence, local)
                .expect("the weight of valence 6 is rational");
        }
        let rule = |center: &A::V, sum: &A::V| vertex_point(arithmetic, valence, center, sum);
        loop_scheme::extended_net_by::<A::S, A::V>(valence, local, rule)
    }

    fn surface(&self, points: &[A::V]) -> Vec<A::V> {
        let points = std::array::from_fn(|i| points[i].clone());
        box_spline::<A::S, A::V>(&points).0.to_vec()
    }

    fn limit(&self, arithmetic: &A, net: &[A::V]) -> A::V {
        let ring = loop_scheme::ring(self.n, 1).expect("a corner has a ring");
        let sum = ring
            .iter()
            .fold(<A::V as Zero>::zero(), |s, &i| s + &net[i - 1]);
        let integer = A::S::from_integer;
        let times_q = net[0].clone() * &integer(3) + &(arithmetic.times_weight(&sum) * &integer(8));
        arithmetic.over_q(self.n, times_q)
    }

    fn mesh(&self, arithmetic: &A, net: &Net<A::V>, _letter: u8, against: Against) -> Vec<A::V> {
        let scale = |p: &A::V| Rules::<A>::scale(self, arithmetic, p);
        match (against, net) {
            (Against::Control, Net::Extraordinary(p)) => {
                [&p[0], &p[1], &p[self.n as usize]].map(scale).to_vec()
            }
            (Against::Control, Net::Regular(p)) => [&p[3], &p[6], &p[7]].map(scale).to_vec(),
            (Against::Limit, Net::Regular(points)) => {
                let bezier = Rules::<A>::surface(self, points);
                [0, 10, 14].map(|i| scale(&bezier[i])).to_vec()
            }
            (Against::Limit, Net::Extraordinary(points)) => {
                let mask = loop_scheme::limit_mask::<A::S>(LoopWeights::Warren, REGULAR)
                    .expect("the weight of valence 6 is rational");
                let at = |label: usize| {
                    let ring = loop_scheme::ring(self.n, label).expect("a corner has a ring");
                    let sum =
                        (ring.iter()).fold(<A::V as Zero>::zero(), |s, &i| s + &points[i - 1]);
                    scale(&mask.apply_ring(&points[label - 1], &sum))
                };
                let corner = Rules::<A>::limit(self, arithmetic, points);
                vec![corner, at(2), at(self.n as usize + 1)]
            }
        }
    }

    fn scale(&self, arithmetic: &A, functional: &A::V) -> A::V {
        arithmetic.times_q(self.n, functional)
    }

    /// A refined point is a convex combination of points, but for the extraordinary vertex point
    /// `P + b (Σ P_i - n P)`, at most 2 n + 1 times as large in the sum of all coefficients; the factor q
    /// is at most 3 + 8 n, the limit mask 3 + 8 n; a level has denominator 16, Bernstein form 24, the
    /// nodes of F 4 2^len; the difference of two terms doubles, a second difference makes four.
    fn bits(&self, word: Word) -> u32 {
        let n = u64::from(self.n);
        let (len, zeros) = (word.len() as u32, word.leading_zeros() as u32);
        4 * len + len + 9 + (zeros + 1) * log2(2 * n + 1) + 2 * log2(8 * n + 3) + 3
    }

    fn inverse_bits(&self) -> u32 {
        8
    }

    /// Each second difference of a refined regular net is a mean of second differences over 4, so M
    /// falls by 4^-1 a level, also over all parts. A step moves vertex points by at most 3/8 M and edge
    /// points by M/8 off F_0, hence |F_1 - F_0| <= 3/8 M and |S - F_0| <= 3/8 (1 + 1/4 + ..) M = M/2.
    /// B_0 = 1/3 is Theorem 2 of HW.
    fn regular_factor(&self, against: Against) -> Option<(i64, i64)> {
        Some(match against {
            Against::Control => (1, 2),
            Against::Limit => (1, 3),
        })
    }
}
