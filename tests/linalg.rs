//! Exact and certified linear algebra.

use nalgebra::{DMatrix, dmatrix};
use num_traits::{One, Zero};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use subcert::linalg::{determinant, rank, solve, solve_certified};
use subcert::scalar::{Cyclotomic, Field, Interval, Rational, Ring};

const SEED: u64 = 0x5eed_0003;

fn matrix(rows: usize, columns: usize, entries: &[(i64, i64)]) -> DMatrix<Rational> {
    let entry = |i: usize, j: usize| entries[(i * columns + j) % entries.len()];
    DMatrix::from_fn(rows, columns, |i, j| {
        Rational::ratio(entry(i, j).0, entry(i, j).1)
    })
}

fn entries() -> impl Strategy<Value = Vec<(i64, i64)>> {
    prop::collection::vec((-4i64..=4, 1i64..4), 37)
}

/// The Hilbert matrix is the textbook case: det H_5 = 1/266716800000, and the inverse is integral.
#[test]
fn hilbert_matrix() {
    let hilbert = |n| DMatrix::from_fn(n, n, |i, j| Rational::ratio(1, (i + j + 1) as i64));
    assert_eq!(
        determinant(&hilbert(5)),
        Rational::ratio(1, 266_716_800_000)
    );
    let identity = DMatrix::from_fn(12, 12, |i, j| Rational::ratio(i64::from(i == j), 1));
    let inverse = solve(&hilbert(12), &identity).unwrap();
    assert!(inverse.iter().all(Rational::is_integer));
    assert_eq!(inverse * hilbert(12), identity);
}

#[test]
fn dependent_or_contradictory_systems_have_no_answer() {
    let r = |k| Rational::ratio(k, 1);
    let a = dmatrix![r(1), r(2); r(2), r(4); r(3), r(7)];
    assert_eq!(rank(&a), 2);
    let x = solve(&a, &dmatrix![r(1); r(2); r(4)]).unwrap();
    assert_eq!(x, dmatrix![r(-1); r(1)]);
    assert_eq!(solve(&a, &dmatrix![r(1); r(3); r(4)]), None);
    let singular = dmatrix![r(0), r(2); r(0), r(4)];
    assert_eq!((rank(&singular), determinant(&singular)), (1, r(0)));
    assert_eq!(solve(&singular, &dmatrix![r(2); r(4)]), None);
    assert_eq!(determinant(&dmatrix![r(0), r(1); r(1), r(0)]), r(-1));
    assert_eq!(determinant(&DMatrix::from_element(0, 0, r(0))), r(1));
    assert_eq!(rank(&DMatrix::from_element(3, 2, r(0))), 0);
}

/// The circulant with first row (0, 1, 0, .., 0, 1) has the eigenvalues 2 cos(2πk/n).
#[test]
fn eigenvector_of_a_circulant_in_the_real_cyclotomic_field() {
    for n in [5u32, 7, 9] {
        let size = n as usize;
        let shift = DMatrix::from_fn(size, size, |i, j| {
            let neighbours = (i + 1) % size == j || (j + 1) % size == i;
            Cyclotomic::from_integer(i64::from(neighbours))
        });
        let eigenvalue = Cyclotomic::two_cos(1, n).unwrap();
        let mut shifted = shift.clone();
        (0..size).for_each(|i| shifted[(i, i)] -= eigenvalue.clone());
        let zero = DMatrix::from_element(size, 1, Cyclotomic::zero());
        assert_eq!(solve_certified(&shifted, &zero), None, "singular");
        let right = DMatrix::from_fn(size, 1, |i, _| Cyclotomic::two_cos(i as u32, n).unwrap());
        (0..size).for_each(|i| shifted[(i, i)] -= Cyclotomic::one());
        // (shift - (c + 1)) v = -v on the eigenvector.
        assert_eq!(solve_certified(&shifted, &right), Some(-right));
    }
}

#[test]
fn intervals_that_may_be_singular_are_undecided() {
    let wide = Interval::new(0.9, 1.1);
    let one = Interval::one();
    assert_eq!(
        solve_certified(&dmatrix![one, wide; wide, one], &dmatrix![one; one]),
        None
    );
    let x = solve_certified(&dmatrix![one, wide; -wide, one], &dmatrix![one; one]).unwrap();
    assert!(x[0].contains(0.0) && x[1].contains(1.0));
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        rng_seed: RngSeed::Fixed(SEED),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn solutions_solve(n in 1usize..6, extra in 0usize..3, a in entries(), x in entries()) {
        let (a, x) = (matrix(n + extra, n, &a), matrix(n, 2, &x));
        let b = &a * &x;
        match solve(&a, &b) {
            Some(found) => prop_assert_eq!(found, x),
            None => prop_assert!(rank(&a) < n),
        }
    }

    #[test]
    fn determinant_is_multiplicative(n in 1usize..6, a in entries(), b in entries()) {
        let (a, b) = (matrix(n, n, &a), matrix(n, n, &b));
        prop_assert_eq!(determinant(&(&a * &b)), determinant(&a) * determinant(&b));
        prop_assert_eq!(determinant(&a).is_zero(), rank(&a) < n);
        prop_assert_eq!(determinant(&a.transpose()), determinant(&a));
    }

    #[test]
    fn rank_of_a_product_of_thin_matrices(k in 0usize..4, a in entries(), b in entries()) {
        let (a, b) = (matrix(5, k, &a), matrix(k, 6, &b));
        if rank(&a) == k && rank(&b) == k {
            prop_assert_eq!(rank(&(&a * &b)), k);
        }
        prop_assert_eq!(rank(&a), rank(&a.transpose()));
    }

    #[test]
    fn certified_solutions_contain_the_exact_one(n in 1usize..6, a in entries(), b in entries()) {
        let (a, b) = (matrix(n, n, &a), matrix(n, 2, &b));
        let enclosed = solve_certified(&a.map(|x| Interval::from_rational(&x)), &b.map(|x| Interval::from_rational(&x)));
        prop_assert_eq!(solve_certified(&a, &b), solve(&a, &b));
        match (solve(&a, &b), enclosed) {
            (Some(exact), Some(enclosure)) => {
                for (x, interval) in exact.iter().zip(enclosure.iter()) {
                    prop_assert!(interval.contains_rational(x), "{x} not in {interval}");
                }
            }
            (None, enclosure) => prop_assert_eq!(enclosure, None),
            (Some(_), None) => {}
        }
    }
}
