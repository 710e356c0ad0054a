//! Doo-Sabin, round a vertex of valence 4 of one extraordinary face.

use num_traits::Zero;

use super::{Layout, Rules, log2};
use crate::bernstein::from_net::biquadratic;
use crate::bernstein::midpoint;
use crate::bound::arithmetic::Arithmetic;
use crate::bound::nets::{Against, Net};
use crate::bound::shape::Shape;
use crate::bound::word::Word;
use crate::scalar::{Field, Ring};
use crate::scheme::IntegerRow;
use crate::scheme::doo_sabin::{self as scheme, REGULAR_LABELS};

/// At a face of n >= 3 sides.
///
/// The face is the quarter 0 of the net's square: the part of the extraordinary face at the vertex,
/// with the corners centroid, midpoint of a side, vertex, midpoint of a side.
#[derive(Clone, Copy, Debug)]
pub struct DooSabin {
    /// The number of sides.
    pub n: u32,
}

const REGULAR: u32 = 4;

impl<A: Arithmetic> Rules<A> for DooSabin {
    fn layout(&self) -> Layout {
        Layout {
            shape: Shape::Biquadratic,
            root: Word::zeros(1),
            size: scheme::local_net_size(self.n),
            valence: self.n,
            regular: REGULAR,
            labels: &REGULAR_LABELS,
            tile_labels: |n, tile| scheme::tile_labels(n, tile).to_vec(),
        }
    }

    fn differences(&self, valence: u32) -> Vec<IntegerRow> {
        scheme::face_differences(valence)
    }

    /// The weights of the new corner at P_i are written for the differences P_j - P_i, so that
    /// functionals vanish on constants whatever the cosines are.
    fn refine(&self, arithmetic: &A, _extraordinary: bool, n: u32, local: &[A::V]) -> Vec<A::V> {
        if matches!(n, 3 | 4 | 6) {
            return scheme::extended_net::<A::S, A::V>(n, local)
                .expect("the cosines of 3, 4 and 6 sides are rational");
        }
        let corner = |face: &[A::V], i: usize| {
            let sides = face.len();
            let mut sum = face[i].clone();
            for j in (0..sides).filter(|&j| j != i) {
                let step = face[j].clone() - &face[i];
                let turn = ((j + sides - i) % sides) as u32;
                let cosine = arithmetic.times_two_cos(turn, n, &step);
                let weighted = step * &A::S::from_integer(3) + &cosine;
                sum = sum + &(weighted * &A::S::ratio(1, 4 * i64::from(n)));
            }
            sum
        };
        scheme::extended_net_by::<A::S, A::V>(n, local, corner)
    }

    fn surface(&self, points: &[A::V]) -> Vec<A::V> {
        let points = std::array::from_fn(|i| points[i].clone());
        biquadratic::<A::S, A::V>(&points).0.to_vec()
    }

    fn limit(&self, _: &A, net: &[A::V]) -> A::V {
        let face = &net[..self.n as usize];
        let sum = face.iter().fold(<A::V as Zero>::zero(), |sum, p| sum + p);
        scheme::limit_point::<A::S, A::V>(&sum, self.n)
    }

    /// The quarter's corners in their order: the vertex is at (1/2, 1/2).
    ///
    /// # Panics
    /// Against the limit mesh, which the net does not determine.
    fn mesh(&self, arithmetic: &A, net: &Net<A::V>, letter: u8, against: Against) -> Vec<A::V> {
        assert_eq!(against, Against::Control, "the net has no limit mesh");
        let (n, local) = Rules::<A>::local(self, net);
        let point = |i: i32, j: i32| {
            let label = scheme::lattice_label(n, i, j).expect("a point of the net");
            local[label - 1].clone()
        };
        let vertex = local[0].clone();
        let middle = |[i, j]: [i32; 2]| midpoint::<A::S, A::V>(&vertex, &point(i, j));
        // The neighbours before and after each corner of the square.
        const NEIGHBOURS: [[i32; 2]; 4] = [[0, -1], [1, 0], [0, 1], [-1, 0]];
        let at = usize::from(letter);
        let centroid = match (letter, net) {
            (0, Net::Extraordinary(points)) => Rules::<A>::limit(self, arithmetic, points),
            _ => {
                let [before, after] = [NEIGHBOURS[(at + 3) % 4], NEIGHBOURS[at]];
                let (i, j) = (before[0] + after[0], before[1] + after[1]);
                let far = match (i, j) {
                    // The lattice ends at the extraordinary face, which is a quad here.
                    (-1, -1) => local[2].clone(),
                    _ => point(i, j),
                };
                let [a, b] = [before, after].map(|[i, j]| point(i, j));
                (a + &b + &far + &vertex) * &A::S::ratio(1, 4)
            }
        };
        let before = middle(NEIGHBOURS[(at + 3) % 4]);
        let after = middle(NEIGHBOURS[at]);
        // Round the quarter from the centroid: the side in front, the vertex, the side behind; then
        // turned so that the corner at the lower left comes first.
        let mut corners = vec![centroid, after, vertex.clone(), before];
        corners.rotate_right(at);
        corners
    }

    fn scale(&self, _: &A, functional: &A::V) -> A::V {
        functional.clone()
    }

    /// All points are convex combinations: the sum of |numerators| over the cosines is at most 2 (h + 1)
    /// times the denominators. A step has the denominator 16 or, in the face, 4 n, and the products of
    /// cosines 2; Bernstein form has 4, the nodes of F 4 4^len n.
    fn bits(&self, word: Word) -> u32 {
        let n = u64::from(self.n);
        let (len, zeros) = (word.len() as u32, word.leading_zeros() as u32);
        4 * len + zeros * (2 + 2 * log2(n)) + 2 * len + 2 * log2(n) + 16
    }

    fn inverse_bits(&self) -> u32 {
        8
    }

    /// A difference of a refined regular net is a mean of differences, over 4; a quadratic spline misses
    /// its polygon by at most M/8, the tensor product by twice that.
    fn regular_factor(&self, against: Against) -> Option<(i64, i64)> {
        (against == Against::Control).then_some((1, 4))
    }
}
