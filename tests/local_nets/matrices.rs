//! Subdivision matrices: convex combinations, limit masks, spectra, enclosures.

use std::cmp::Ordering;

use nalgebra::DMatrix;
use subcert::scalar::{Cyclotomic, Decide, Field, Interval, Rational};
use subcert::scheme::{LoopWeights, Tile, catmull_clark, doo_sabin, loop_scheme};

use crate::exact;
use crate::nets::{IRRATIONAL_VALENCES, rational_cases};

pub fn rows_of<S: Field>(matrix: &DMatrix<S>) -> Vec<Vec<S>> {
    let row = |i| matrix.row(i).iter().cloned().collect();
    (0..matrix.nrows()).map(row).collect()
}

/// The dimension of the kernel of (A - λ)^power.
fn nullity<S: Field>(matrix: &DMatrix<S>, eigenvalue: &S, power: usize) -> usize {
    let size = matrix.nrows();
    let shifted = matrix - DMatrix::from_diagonal_element(size, size, eigenvalue.clone());
    let product = (1..power).fold(shifted.clone(), |product, _| product * &shifted);
    size - exact::rank(rows_of(&product))
}

fn trace_of_power<S: Field>(matrix: &DMatrix<S>, power: u32) -> S {
    let product = (1..power).fold(matrix.clone(), |product, _| product * matrix);
    sum(product.diagonal().iter())
}

fn sum<'a, S: Field>(terms: impl IntoIterator<Item = &'a S>) -> S {
    terms.into_iter().fold(S::zero(), |sum, term| sum + term)
}

fn power<S: Field>(x: &S, exponent: u32) -> S {
    (0..exponent).fold(S::one(), |product, _| product * x)
}

fn assert_stochastic<S: Decide>(matrix: &DMatrix<S>) {
    for row in rows_of(matrix) {
        for entry in &row {
            assert!(matches!(
                entry.decide(&S::zero()),
                Some(Ordering::Greater | Ordering::Equal)
            ));
        }
        assert_eq!(sum(&row), S::one());
    }
}

fn check_loop_convexity<S: Decide>(weights: LoopWeights, n: u32) {
    assert_stochastic(&loop_scheme::subdivision_matrix::<S>(weights, n).unwrap());
    assert_stochastic(&loop_scheme::extended_matrix::<S>(weights, n).unwrap());
    for tile in Tile::ALL {
        let matrix = loop_scheme::tile_matrix::<S>(weights, n, tile).unwrap();
        assert_eq!(matrix.shape(), (12, n as usize + 6));
        assert_stochastic(&matrix);
    }
}

fn check_doo_sabin_convexity<S: Decide>(n: u32) {
    assert_stochastic(&doo_sabin::subdivision_matrix::<S>(n).unwrap());
    assert_stochastic(&doo_sabin::extended_matrix::<S>(n).unwrap());
    for tile in Tile::ALL {
        let matrix = doo_sabin::tile_matrix::<S>(n, tile).unwrap();
        assert_eq!(matrix.shape(), (9, n as usize + 5));
        assert_stochastic(&matrix);
    }
}

#[test]
fn all_matrices_are_convex_combinations() {
    for (weights, n) in rational_cases(12) {
        check_loop_convexity::<Rational>(weights, n);
    }
    for n in IRRATIONAL_VALENCES {
        check_loop_convexity::<Cyclotomic>(LoopWeights::Original, n);
        check_doo_sabin_convexity::<Cyclotomic>(n);
    }
    for n in [3, 4, 6] {
        check_doo_sabin_convexity::<Rational>(n);
    }
    for n in 3..=12 {
        assert_stochastic(&catmull_clark::subdivision_matrix::<Rational>(n));
        assert_stochastic(&catmull_clark::extended_matrix::<Rational>(n));
        for tile in Tile::ALL {
            let matrix = catmull_clark::tile_matrix::<Rational>(n, tile);
            assert_eq!(matrix.shape(), (16, 2 * n as usize + 8));
            assert_stochastic(&matrix);
        }
    }
}

/// A matrix over the intervals encloses the exact one, entry by entry, and is tight.
#[test]
fn interval_matrices_enclose_the_exact_ones() {
    let assert_encloses = |enclosure: DMatrix<Interval>, exact: DMatrix<Cyclotomic>| {
        assert_eq!(enclosure.shape(), exact.shape());
        for (interval, entry) in enclosure.iter().zip(exact.iter()) {
            assert!(entry.lies_in(*interval), "{entry:?} not in {interval:?}");
            assert!(interval.wid() <= 1e-14);
        }
    };
    for n in 3..=16 {
        for weights in [LoopWeights::Original, LoopWeights::Warren] {
            let exact = loop_scheme::extended_matrix(weights, n).unwrap();
            assert_encloses(loop_scheme::extended_matrix(weights, n).unwrap(), exact);
        }
        let exact = doo_sabin::extended_matrix(n).unwrap();
        assert_encloses(doo_sabin::extended_matrix(n).unwrap(), exact);
        let exact = catmull_clark::extended_matrix(n);
        assert_encloses(catmull_clark::extended_matrix(n), exact);
    }
}

/// The limit mask is the left eigenvector of the simple eigenvalue 1: it is what subdivision keeps.
fn check_limit_mask<S: Field>(matrix: &DMatrix<S>, weight: impl Fn(usize) -> S) {
    let left = DMatrix::from_fn(1, matrix.nrows(), |_, at| weight(at));
    assert_eq!(&left * matrix, left);
    assert_eq!(sum(left.iter()), S::one());
    assert_eq!(nullity(matrix, &S::one(), 1), 1);
}

fn check_loop_limit_mask<S: Field>(weights: LoopWeights, n: u32) {
    let mask = loop_scheme::limit_mask::<S>(weights, n).unwrap();
    let matrix = loop_scheme::subdivision_matrix::<S>(weights, n).unwrap();
    check_limit_mask(&matrix, |at| match at {
        0 => mask.center.clone(),
        _ if at <= n as usize => mask.edge.clone(),
        _ => S::zero(),
    });
}

#[test]
fn limit_masks_are_left_eigenvectors() {
    for (weights, n) in rational_cases(12) {
        check_loop_limit_mask::<Rational>(weights, n);
    }
    for n in IRRATIONAL_VALENCES {
        check_loop_limit_mask::<Cyclotomic>(LoopWeights::Original, n);
        let matrix = doo_sabin::subdivision_matrix::<Cyclotomic>(n).unwrap();
        // The centroid of an n-gon is its limit point.
        let weight = |at| {
            if at < n {
                Cyclotomic::ratio(1, n.into())
            } else {
                num_traits::zero()
            }
        };
        check_limit_mask(&matrix, |at| weight(at as u32));
    }
    for n in 3..=12 {
        let mask = catmull_clark::limit_mask::<Rational>(n);
        check_limit_mask(&catmull_clark::subdivision_matrix(n), |at| match at {
            0 => mask.center.clone(),
            _ if at > 2 * n as usize => num_traits::zero(),
            _ if at % 2 == 1 => mask.edge.clone(),
            _ => mask.face.clone(),
        });
    }
}

/// `Σ_{k=1}^{n-1} (a + b cos(2πk/n))^m` for m = 1, 2, 3, from the power sums of the cosines over all
/// k: 0, n/2 and 0, but 3/4 for the third powers at n = 3.
fn ring_power_sum(n: u32, a: &Rational, b: &Rational, m: u32) -> Rational {
    let r = Rational::ratio;
    let size = r(i64::from(n), 1);
    let third = if n == 3 { r(3, 4) } else { r(0, 1) };
    let all = match m {
        1 => &size * a,
        2 => &size * a * a + b * b * &size / r(2, 1),
        3 => &size * a * a * a + r(3, 1) * a * b * b * &size / r(2, 1) + b * b * b * third,
        _ => unreachable!(),
    };
    all - power(&(a + b), m)
}

fn check_loop_traces<S: Field>(weights: LoopWeights, n: u32, embed: impl Fn(&Rational) -> S) {
    let r = Rational::ratio;
    let matrix = loop_scheme::subdivision_matrix::<S>(weights, n).unwrap();
    let nb = loop_scheme::ring_weight_sum::<S>(weights, n).unwrap();
    for m in 1..=3 {
        // Stam's outer block of five: 1/8 three times, 1/16 twice.
        let outer = r(3, 1) * power(&r(1, 8), m) + r(2, 1) * power(&r(1, 16), m);
        let rational = r(1, 1) + ring_power_sum(n, &r(3, 8), &r(1, 4), m) + outer;
        let expected = embed(&rational) + &power(&(S::ratio(5, 8) - &nb), m);
        assert_eq!(trace_of_power(&matrix, m), expected, "{weights} n = {n}");
    }
}

#[test]
fn loop_traces_are_the_sums_of_the_blocks() {
    for (weights, n) in rational_cases(12) {
        check_loop_traces::<Rational>(weights, n, Rational::clone);
    }
    for n in IRRATIONAL_VALENCES {
        check_loop_traces(LoopWeights::Original, n, Cyclotomic::from_rational);
    }
}

/// The dimension that the eigenspaces of Loop's matrix miss. Its eigenvalues are those of MATH
/// section 5: all of Q(2 cos 2π/n).
fn loop_defect<S: Field>(weights: LoopWeights, n: u32) -> usize {
    let matrix = loop_scheme::subdivision_matrix::<S>(weights, n).unwrap();
    let nb = loop_scheme::ring_weight_sum::<S>(weights, n).unwrap();
    let ring = (1..n).map(|k| S::ratio(3, 8) + &(S::two_cos(k, n).unwrap() * &S::ratio(1, 8)));
    let center = S::ratio(5, 8) - &nb;
    let others = [S::one(), center, S::ratio(1, 8), S::ratio(1, 16)];
    let mut distinct: Vec<S> = Vec::new();
    for value in ring.chain(others) {
        if !distinct.contains(&value) {
            distinct.push(value);
        }
    }
    matrix.nrows()
        - distinct
            .iter()
            .map(|value| nullity(&matrix, value, 1))
            .sum::<usize>()
}

/// At n = 3 the eigenvalue 5/8 - n b = 1/16 meets an outer one in a Jordan block of size 2.
#[test]
fn loop_is_defective_at_valence_three_only() {
    for weights in [LoopWeights::Original, LoopWeights::Warren] {
        for n in 3..=12 {
            let defect = loop_defect::<Cyclotomic>(weights, n);
            assert_eq!(defect, usize::from(n == 3), "{weights} n = {n}");
        }
        assert_eq!(loop_defect::<Rational>(weights, 3), 1);
    }
}

#[test]
fn catmull_clark_traces_are_the_sums_of_the_blocks() {
    let r = Rational::ratio;
    for n in 3..=12 {
        let matrix = catmull_clark::subdivision_matrix::<Rational>(n);
        let size = i64::from(n);
        // Pairs with sum s and product p have the power sums s and s^2 - 2 p. Block k has
        // s = (5 + c)/8, p = ((5 + c)^2 - (c + 9)(c + 1))/256 = 1/16; block 0 has
        // s = (3n - 7)/(4n), p = ((3n - 7)^2 - (5n^2 - 30n + 49))/(64 n^2) = (n - 3)/(16 n).
        let center_sum = r(3 * size - 7, 4 * size);
        let center_product = r(size - 3, 16 * size);
        for m in 1..=2 {
            let outer = [8, 16, 32].map(|x| r(2, 1) * power(&r(1, x), m));
            let outer = sum(&outer) + power(&r(1, 64), m);
            let ring = ring_power_sum(n, &r(5, 8), &r(1, 8), m);
            let products = r(size - 1, 16) + &center_product;
            let pairs = ring + power(&center_sum, m) - r(i64::from(2 * m) - 2, 1) * products;
            assert_eq!(
                trace_of_power(&matrix, m),
                r(1, 1) + pairs + outer,
                "N = {n}"
            );
        }
    }
}

/// 1; 1/2 twice; 1/4 n - 1 times (n - 3 frequencies of the n-gon, two outer points); 1/8 twice; 1/16.
fn check_doo_sabin_spectrum<S: Field>(n: u32) {
    let matrix = doo_sabin::subdivision_matrix::<S>(n).unwrap();
    let size = n as usize;
    let spectrum = [(1, 1), (2, 2), (4, size - 1), (8, 2), (16, 1)];
    for (denominator, multiplicity) in spectrum {
        let value = S::ratio(1, denominator);
        let defect = if denominator == 4 && n >= 5 { 2 } else { 0 };
        assert_eq!(
            nullity(&matrix, &value, 1),
            multiplicity - defect,
            "n = {n}, 1/{denominator}"
        );
        assert_eq!(
            nullity(&matrix, &value, 2),
            multiplicity,
            "n = {n}, 1/{denominator}"
        );
    }
    assert_eq!(
        spectrum.iter().map(|(_, m)| m).sum::<usize>(),
        matrix.nrows()
    );
}

/// For n = 3 and 4 all eigenspaces are full. From n = 5 on that of 1/4 lacks two dimensions, two
/// Jordan blocks of size 2: the n-gon's frequencies of eigenvalue 1/4 are in resonance with the two
/// outer points of that eigenvalue, so terms k 4^-k appear next to an extraordinary face.
#[test]
fn doo_sabin_spectrum() {
    for n in [3, 4, 6] {
        check_doo_sabin_spectrum::<Rational>(n);
    }
    for n in [5, 7, 8, 9, 10] {
        check_doo_sabin_spectrum::<Cyclotomic>(n);
    }
}
