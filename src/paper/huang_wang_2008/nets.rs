//! Control nets of numbers: the radial net, and S less the limit triangle over a tile.

use crate::bernstein::from_net::box_spline;
use crate::bernstein::triangle::QuarticTriangle;
use crate::scalar::Field;
use crate::scheme::{LoopWeights, Tile, loop_scheme};

/// The weights of the paper: those of Loop 1987.
pub const WEIGHTS: LoopWeights = LoopWeights::Original;

/// The net with all n + 9 mixed second differences equal to -1: 0 at P1, 1 on its ring, 3 and 4
/// beyond. At n = 6 it is a quadratic: the square of the distance to P1 on the regular lattice.
pub fn radial(n: u32) -> Vec<i64> {
    let ring = std::iter::repeat_n(1, n as usize);
    std::iter::once(0)
        .chain(ring)
        .chain([3, 4, 3, 4, 3])
        .collect()
}

/// The limits of the three corners P1, P2, P(n+1) of the face.
///
/// `None` if and only if the arithmetic can't represent the masks of valence n.
pub fn limit_triangle<S: Field>(n: u32, net: &[S]) -> Option<[S; 3]> {
    let last = n as usize + 1;
    let limit = |label: usize| {
        let mask = loop_scheme::limit_mask::<S>(WEIGHTS, if label == 1 { n } else { 6 })?;
        let ring = loop_scheme::ring(n, label)?;
        let sum = ring.iter().fold(S::zero(), |sum, &i| sum + &net[i - 1]);
        Some(mask.apply_ring(&net[label - 1], &sum))
    };
    Some([limit(1)?, limit(2)?, limit(last)?])
}

/// The Bernstein coefficients of S less the limit triangle over the tile of a ring, rings from 1.
///
/// `None` if and only if the arithmetic can't represent the masks of valence n.
pub fn coefficients<S: Field>(n: u32, net: &[S], ring: usize, tile: Tile) -> Option<[S; 15]> {
    let [f0, f1, f2] = limit_triangle(n, net)?;
    let mut level = net.to_vec();
    for _ in 1..ring {
        level = loop_scheme::refine_local_net::<S, S>(WEIGHTS, n, &level)?;
    }
    let extended = loop_scheme::extended_net::<S, S>(WEIGHTS, n, &level)?;
    let points = loop_scheme::tile_net(n, tile, &extended);
    let side = 1i64 << ring;
    let corner = |[v, w]: [i64; 2]| {
        let part = |p: i64| S::ratio(p, side);
        f0.clone() * &part(side - v - w) + &(f1.clone() * &part(v)) + &(f2.clone() * &part(w))
    };
    let triangle = loop_scheme::tile_corners(tile).map(corner);
    let mut difference = box_spline::<S, S>(&points);
    difference.subtract::<S>(&QuarticTriangle::from_linear::<S>(&triangle));
    Some(difference.0)
}

/// The Bernstein coefficients of S less the limit triangle over the whole face of a regular net.
pub fn regular_coefficients<S: Field>(net: &[S]) -> [S; 15] {
    let points = loop_scheme::REGULAR_LABELS.map(|label| net[label - 1].clone());
    let mut surface = box_spline::<S, S>(&points);
    let corners = [0, 10, 14].map(|i| surface.0[i].clone());
    surface.subtract::<S>(&QuarticTriangle::from_linear::<S>(&corners));
    surface.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Cyclotomic, Rational, Ring};

    #[test]
    fn all_second_differences_of_the_radial_net_are_minus_one() {
        for n in 3..=12 {
            let net: Vec<Rational> = radial(n).into_iter().map(Ring::from_integer).collect();
            let minus_one = <Rational as Ring>::from_integer(-1);
            for row in loop_scheme::second_differences(n) {
                assert_eq!(row.apply::<Rational, Rational>(&net), minus_one, "n = {n}");
            }
        }
    }

    #[test]
    fn a_constant_net_is_at_distance_zero() {
        let net = vec![Cyclotomic::ratio(2, 3); 11];
        for tile in Tile::ALL {
            let zero = coefficients(5, &net, 3, tile).unwrap();
            assert!(zero.iter().all(|c| *c == Cyclotomic::ratio(0, 1)));
        }
    }
}
