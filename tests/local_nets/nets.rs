//! Nets to try, and tiles evaluated in Bernstein form.

use subcert::scalar::{Field, Ring};
use subcert::scheme::{LoopWeights, Tile, catmull_clark};

/// The valences beyond the rational ones at which exact fields are tried.
pub const IRRATIONAL_VALENCES: [u32; 3] = [5, 7, 8];

/// The valences at which all masks of a weight variant are rational, up to a largest one.
pub fn rational_cases(largest: u32) -> Vec<(LoopWeights, u32)> {
    let warren = (3..=largest).map(|n| (LoopWeights::Warren, n));
    warren
        .chain([3, 4, 6].map(|n| (LoopWeights::Original, n)))
        .collect()
}

/// A net without symmetry; the multiplier is that of a well-known congruential generator.
pub fn irregular_net<S: Ring>(size: usize) -> Vec<S> {
    let next = |state: &mut u64| {
        *state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        Some(S::from_integer((*state >> 33) as i64 % 1000 - 500))
    };
    std::iter::repeat_n((), size)
        .scan(1, |state, ()| next(state))
        .collect()
}

pub fn unit_nets<S: Ring>(size: usize) -> Vec<Vec<S>> {
    let unit = |k: usize| {
        (0..size)
            .map(|i| if i == k { S::one() } else { S::zero() })
            .collect()
    };
    (0..size).map(unit).collect()
}

fn bernstein<S: Field>(degree: usize, i: usize, t: &S) -> S {
    let binomial = (0..i).fold(1, |b, k| b * (degree - k) / (k + 1));
    let one_minus = S::one() - t;
    let tail = (i..degree).fold(S::one(), |p, _| p * &one_minus);
    (0..i).fold(tail, |p, _| p * t) * &S::ratio(binomial as i64, 1)
}

/// The value of a tensor-product Bézier patch, rows of constant v, at (u, v).
pub fn tensor_value<S: Field>(degree: usize, bezier: &[S], [u, v]: &[S; 2]) -> S {
    let side = degree + 1;
    let mut sum = S::zero();
    for (at, point) in bezier.iter().enumerate() {
        sum += bernstein(degree, at % side, u) * bernstein(degree, at / side, v) * point;
    }
    sum
}

/// Parameters and values on a 5x5 grid over each tile of two rings, from the tiles' Bézier nets.
pub fn tensor_tile_values<S: Field>(
    degree: usize,
    mut net: Vec<S>,
    step: impl Fn(&[S]) -> (Vec<S>, [Vec<S>; 3]),
) -> Vec<([S; 2], S)> {
    let mut values = Vec::new();
    for ring in 0..2 {
        let (next, tiles) = step(&net);
        for (tile, bezier) in Tile::ALL.into_iter().zip(&tiles) {
            let [u0, v0] = catmull_clark::tile_corner(tile);
            for (i, j) in (0..=4).flat_map(|j| (0..=4).map(move |i| (i, j))) {
                let place = [
                    S::ratio(4 * u0 + i, 8 << ring),
                    S::ratio(4 * v0 + j, 8 << ring),
                ];
                let local = [S::ratio(i, 4), S::ratio(j, 4)];
                values.push((place, tensor_value(degree, bezier, &local)));
            }
        }
        net = next;
    }
    values
}

/// Every value has the limit found at its parameters.
pub fn assert_limits<S: Field>(limits: &[([S; 2], S)], values: Vec<([S; 2], S)>, n: u32) {
    for (at, value) in values {
        let (_, limit) = limits
            .iter()
            .find(|(place, _)| *place == at)
            .expect("a refined point");
        assert_eq!(*limit, value, "n = {n} at {at:?}");
    }
}
