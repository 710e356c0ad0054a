//! Catmull-Clark: (1), (2) and (3).

use num_traits::Zero;

use super::nets::{combine, integer, ratio};
use super::printed;
use crate::paper::words::{claim, ranges};
use crate::paper::{Claim, Verdict};
use crate::scalar::Rational;
use crate::scheme::catmull_clark;

/// The point at an index of the ring 2..2N+1, cyclic, from 0.
fn ring(n: u32, label: usize) -> usize {
    (label + 2 * n as usize - 2) % (2 * n as usize) + 1
}

/// (1) and (2) at a net, as printed: the edge vertex of V2 (from f_0 and f_1) and the vertex vertex.
fn printed_rules(n: u32, net: &[Rational]) -> [Rational; 2] {
    let face = |j: usize| {
        let corners = [0, ring(n, 2 * j), ring(n, 2 * j + 1), ring(n, 2 * j + 2)];
        corners
            .iter()
            .fold(Rational::zero(), |sum, &i| sum + &net[i])
            * ratio(1, 4)
    };
    let v = &net[0];
    let size = n as usize;
    let edge =
        (v + &net[ring(n, 2)] + face(size) + face(1)) * ratio(1, printed::EDGE_POINT_DENOMINATOR);
    let square = i64::from(n) * i64::from(n);
    let sum = |of: &dyn Fn(usize) -> Rational| {
        (1..=size).fold(Rational::zero(), |sum, j| sum + of(j)) * ratio(1, square)
    };
    let edges = sum(&|j| net[ring(n, 2 * j)].clone());
    let faces = sum(&face);
    let vertex = v * ratio(i64::from(n) - 2, i64::from(n)) + edges + faces;
    [edge, vertex]
}

/// The functional of (3) on one level's net.
pub fn printed_limit(n: u32) -> Vec<(usize, Rational)> {
    let [v, e, f] = printed::LIMIT_OF_CATMULL_CLARK;
    let n64 = i64::from(n);
    let over = n64 * (n64 + printed::LIMIT_SHIFT);
    let ring = (1..=2 * n as usize).map(|i| (i, ratio(if i % 2 == 1 { e } else { f }, over)));
    std::iter::once((0, ratio(n64 * n64 * v, over)))
        .chain(ring)
        .collect()
}

/// The claims on masks.
pub fn claims(valences: &[u32]) -> Vec<Claim> {
    let scope = format!("N = {}", ranges(valences.iter().copied()));
    let both = valences.iter().map(|&n| {
        let matrix = catmull_clark::subdivision_matrix::<Rational>(n);
        let size = catmull_clark::local_net_size(n);
        let unit = |i: usize| {
            (0..size)
                .map(|j| integer(i64::from(i == j)))
                .collect::<Vec<_>>()
        };
        let agree = (0..size).all(|i| {
            let [edge, vertex] = printed_rules(n, &unit(i));
            edge == matrix[(1, i)] && vertex == matrix[(0, i)]
        });
        // A limit is what refinement keeps: the same mask on either level, with weights of sum 1.
        let mask = printed_limit(n);
        let fine = combine(&matrix, mask.iter().cloned());
        let mut coarse = vec![Rational::zero(); size];
        for (i, weight) in &mask {
            coarse[*i] += weight;
        }
        let sum = mask.iter().fold(Rational::zero(), |s, (_, w)| s + w);
        (agree, fine == coarse && sum == integer(1))
    });
    let (masks, limits): (Vec<bool>, Vec<bool>) = both.unzip();
    // v^0 and e^0 with f^1, as one might read "the image of v^0".
    let mixed = valences.iter().all(|&n| {
        let matrix = catmull_clark::subdivision_matrix::<Rational>(n);
        let (old, faces): (Vec<_>, Vec<_>) = printed_limit(n)
            .into_iter()
            .partition(|(i, _)| i % 2 == 1 || *i == 0);
        let mut t = combine(&matrix, faces);
        for (i, weight) in old {
            t[i] += weight;
        }
        t == combine(&matrix, printed_limit(n))
    });
    vec![
        claim(
            "eq-1-2",
            "(1), (2)",
            "Edge vertex (v + e_j + f_(j-1)' + f_j') / 4; vertex vertex (n-2)/n v + Σ e_j / n^2 + Σ f_j' / n^2.",
            Verdict::of(Some(masks.iter().all(|b| *b))),
            "the scheme's own rules, at every unit net",
            scope.clone(),
        ),
        claim(
            "eq-3",
            "(3)",
            "The image of v^0 is (n^2 v^1 + 4 Σ e_j^1 + Σ f_j^1) / (n (n + 5)).",
            Verdict::of(Some(limits.iter().all(|b| *b) && !mixed)),
            "a left eigenvector of the subdivision matrix for the eigenvalue 1, with weights of sum 1. The \
             superscripts must all be of one level: 1 as printed, for any faces, or 0 where all faces at v \
             have four sides and f_j is the vertex opposite; v^0 and e^0 with f^1 give another point",
            scope,
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The row of a matrix that refinement gives to a point is that of the printed rule, at N = 5.
    #[test]
    fn the_vertex_rule_by_hand() {
        let matrix = catmull_clark::subdivision_matrix::<Rational>(5);
        // (n-2)/n + n / (4 n^2) = 1 - 7/(4 n) at the vertex itself.
        assert_eq!(matrix[(0, 0)], ratio(13, 20));
    }
}
