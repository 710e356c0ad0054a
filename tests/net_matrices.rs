//! Matrices of the local nets against spectral theory; second differences against their kernels.

mod brute_force;
mod exact;

use brute_force::{Mesh, loop_faces, rational_cases};
use nalgebra::DMatrix;
use num_traits::{One, Zero};
use subcert::scalar::{Field, Rational};
use subcert::scheme::{
    IntegerRow, LoopWeights, Tile, catmull_clark, doo_sabin, linear, loop_scheme,
};

type R = Rational;

fn r(p: i64, q: i64) -> R {
    R::ratio(p, q)
}

fn rows_of<S: Field>(matrix: &DMatrix<S>) -> Vec<Vec<S>> {
    matrix
        .row_iter()
        .map(|row| row.iter().cloned().collect())
        .collect()
}

fn nullity(matrix: &DMatrix<R>, eigenvalue: &R) -> usize {
    let size = matrix.nrows();
    let identity = DMatrix::<R>::from_diagonal_element(size, size, R::one());
    size - exact::rank(rows_of(&(matrix - identity * eigenvalue.clone())))
}

fn trace_of_power(matrix: &DMatrix<R>, power: u32) -> R {
    let product = (1..power).fold(matrix.clone(), |product, _| product * matrix);
    product.trace()
}

fn assert_stochastic(matrix: &DMatrix<R>) {
    for row in matrix.row_iter() {
        assert!(row.iter().all(|entry| *entry >= R::zero()));
        assert_eq!(row.iter().sum::<R>(), R::one());
    }
}

#[test]
fn all_matrices_are_convex_combinations() {
    for (weights, n) in rational_cases(12) {
        assert_stochastic(&loop_scheme::subdivision_matrix(weights, n).unwrap());
        assert_stochastic(&loop_scheme::extended_matrix(weights, n).unwrap());
        for tile in Tile::ALL {
            let matrix = loop_scheme::tile_matrix::<R>(weights, n, tile).unwrap();
            assert_eq!(matrix.shape(), (12, n as usize + 6));
            assert_stochastic(&matrix);
        }
    }
    for n in 3..=12 {
        assert_stochastic(&catmull_clark::subdivision_matrix(n));
        assert_stochastic(&catmull_clark::extended_matrix(n));
        for tile in Tile::ALL {
            let matrix = catmull_clark::tile_matrix::<R>(n, tile);
            assert_eq!(matrix.shape(), (16, 2 * n as usize + 8));
            assert_stochastic(&matrix);
        }
    }
    for n in [3, 4, 6] {
        assert_stochastic(&doo_sabin::subdivision_matrix(n).unwrap());
        assert_stochastic(&doo_sabin::extended_matrix(n).unwrap());
        for tile in Tile::ALL {
            let matrix = doo_sabin::tile_matrix::<R>(n, tile).unwrap();
            assert_eq!(matrix.shape(), (9, n as usize + 5));
            assert_stochastic(&matrix);
        }
    }
}

#[test]
fn limit_masks_are_left_eigenvectors() {
    for (weights, n) in rational_cases(12) {
        let matrix = loop_scheme::subdivision_matrix::<R>(weights, n).unwrap();
        let mask = loop_scheme::limit_mask::<R>(weights, n).unwrap();
        let left = DMatrix::from_fn(1, matrix.nrows(), |_, at| match at {
            0 => mask.center.clone(),
            _ if at <= n as usize => mask.edge.clone(),
            _ => R::zero(),
        });
        assert_eq!(&left * &matrix, left);
        assert_eq!(nullity(&matrix, &R::one()), 1);
    }
    for n in 3..=12 {
        let matrix = catmull_clark::subdivision_matrix::<R>(n);
        let mask = catmull_clark::limit_mask::<R>(n);
        let left = DMatrix::from_fn(1, matrix.nrows(), |_, at| match at {
            0 => mask.center.clone(),
            _ if at > 2 * n as usize => R::zero(),
            _ if at % 2 == 1 => mask.edge.clone(),
            _ => mask.face.clone(),
        });
        assert_eq!(&left * &matrix, left);
        assert_eq!(nullity(&matrix, &R::one()), 1);
    }
}

/// `Σ_{k=1}^{n-1} (a + b cos(2πk/n))^m` for m = 1, 2, 3, from the power sums of the cosines over all
/// k: 0, n/2 and 0, but 3/4 for the third powers at n = 3.
fn ring_power_sum(n: u32, a: &R, b: &R, m: u32) -> R {
    let size = r(i64::from(n), 1);
    let third = if n == 3 { r(3, 4) } else { R::zero() };
    let all = match m {
        1 => &size * a,
        2 => &size * a * a + b * b * &size / r(2, 1),
        3 => &size * a * a * a + r(3, 1) * a * b * b * &size / r(2, 1) + b * b * b * third,
        _ => unreachable!(),
    };
    let first = a + b;
    all - (0..m).fold(R::one(), |p, _| p * &first)
}

#[test]
fn loop_traces_are_the_sums_of_the_blocks() {
    for (weights, n) in rational_cases(12) {
        let matrix = loop_scheme::subdivision_matrix::<R>(weights, n).unwrap();
        let nb = loop_scheme::ring_weight_sum::<R>(weights, n).unwrap();
        for m in 1..=3 {
            let power = |x: R| (0..m).fold(R::one(), |p, _| p * &x);
            // Stam's outer block of five: 1/8 three times, 1/16 twice.
            let outer = r(3, 1) * power(r(1, 8)) + r(2, 1) * power(r(1, 16));
            let center = R::one() + power(r(5, 8) - &nb);
            let expected = ring_power_sum(n, &r(3, 8), &r(1, 4), m) + center + outer;
            assert_eq!(trace_of_power(&matrix, m), expected, "{weights} n = {n}");
        }
    }
}

/// Where all eigenvalues are rational their eigenspaces are counted: they fill the space but at
/// n = 3, where 5/8 - n b = 1/16 meets an outer eigenvalue in a Jordan block of size 2.
#[test]
fn loop_is_defective_at_valence_three_only() {
    for (weights, n) in [(LoopWeights::Warren, 3), (LoopWeights::Warren, 4)]
        .into_iter()
        .chain([3, 4, 6].map(|n| (LoopWeights::Original, n)))
        .chain([(LoopWeights::Warren, 6)])
    {
        let matrix = loop_scheme::subdivision_matrix::<R>(weights, n).unwrap();
        let nb = loop_scheme::ring_weight_sum::<R>(weights, n).unwrap();
        let mut eigenvalues = vec![R::one(), r(5, 8) - nb, r(1, 8), r(1, 16)];
        for k in 1..n {
            eigenvalues.push(r(3, 8) + R::two_cos(k, n).unwrap() * r(1, 8));
        }
        eigenvalues.sort();
        eigenvalues.dedup();
        let dimension: usize = eigenvalues
            .iter()
            .map(|value| nullity(&matrix, value))
            .sum();
        assert_eq!(
            matrix.nrows() - dimension,
            usize::from(n == 3),
            "{weights} n = {n}"
        );
    }
}

#[test]
fn catmull_clark_traces_are_the_sums_of_the_blocks() {
    for n in 3..=12 {
        let matrix = catmull_clark::subdivision_matrix::<R>(n);
        let size = i64::from(n);
        // Pairs with sum s and product p have the power sums s and s^2 - 2 p. Block k has
        // s = (5 + c)/8, p = ((5 + c)^2 - (c + 9)(c + 1))/256 = 1/16.
        let center_sum = r(3 * size - 7, 4 * size);
        // ((3n - 7)^2 - (5n^2 - 30n + 49)) / (64 n^2) = (n - 3)/(16 n)
        let center_product = r(size - 3, 16 * size);
        let center = |m| match m {
            1 => center_sum.clone(),
            _ => &center_sum * &center_sum - r(2, 1) * &center_product,
        };
        for m in 1..=2 {
            let power = |x: R| (0..m).fold(R::one(), |p, _| p * &x);
            let mut outer = power(r(1, 64));
            for x in [8, 16, 32] {
                outer += r(2, 1) * power(r(1, x));
            }
            let ring = ring_power_sum(n, &r(5, 8), &r(1, 8), m);
            let products = if m == 2 { r(size - 1, 8) } else { R::zero() };
            let expected = R::one() + center(m) + ring - products + outer;
            assert_eq!(trace_of_power(&matrix, m), expected, "N = {n}");
        }
    }
}

/// 1; 1/2 twice; 1/4 n - 1 times (n - 3 frequencies of the n-gon, two outer points); 1/8 twice; 1/16.
///
/// For n = 3 and 4 all eigenspaces are full. For n = 6 that of 1/4 has dimension 3 instead of 5: two
/// Jordan blocks of size 2, so terms k 4^-k appear next to an extraordinary Doo-Sabin face.
#[test]
fn doo_sabin_spectrum() {
    for n in [3, 4, 6] {
        let matrix = doo_sabin::subdivision_matrix::<R>(n).unwrap();
        let size = n as usize;
        let spectrum = [
            (r(1, 1), 1),
            (r(1, 2), 2),
            (r(1, 4), size - 1),
            (r(1, 8), 2),
            (r(1, 16), 1),
        ];
        let mut sum = R::zero();
        for (value, multiplicity) in &spectrum {
            let defect = if *value == r(1, 4) && n == 6 { 2 } else { 0 };
            assert_eq!(
                nullity(&matrix, value),
                multiplicity - defect,
                "n = {n}, {value}"
            );
            let identity = DMatrix::<R>::identity(matrix.nrows(), matrix.nrows());
            let shifted = &matrix - identity * value.clone();
            let generalised = matrix.nrows() - exact::rank(rows_of(&(&shifted * &shifted)));
            assert_eq!(generalised, *multiplicity, "n = {n}, {value}");
            sum += value * r(*multiplicity as i64, 1);
        }
        assert_eq!(
            spectrum.iter().map(|(_, m)| m).sum::<usize>(),
            matrix.nrows()
        );
        assert_eq!(matrix.trace(), sum);
    }
}

// --- Second differences -------------------------------------------------------------------------

fn kernel_dimension(rows: &[IntegerRow], size: usize) -> usize {
    size - exact::rank(rows_of(&linear::matrix_of_rows::<R>(rows, size)))
}

#[test]
fn loop_second_differences_have_the_known_kernel() {
    for n in 3..=24 {
        let rows = loop_scheme::second_differences(n);
        assert_eq!(rows.len(), n as usize + 9);
        let expected = if n % 6 == 0 { 3 } else { 1 };
        assert_eq!(
            kernel_dimension(&rows, loop_scheme::local_net_size(n)),
            expected,
            "n = {n}"
        );
    }
}

#[test]
fn catmull_clark_second_differences_have_the_known_kernel() {
    for n in 3..=24 {
        let rows = catmull_clark::second_differences(n);
        assert_eq!(rows.len(), 2 * n as usize + 10);
        let expected = match n % 4 {
            0 => 4,
            2 => 2,
            _ => 1,
        };
        assert_eq!(
            kernel_dimension(&rows, catmull_clark::local_net_size(n)),
            expected,
            "N = {n}"
        );
    }
    let mut distinct = catmull_clark::second_differences(4);
    distinct.sort_by(|a, b| a.terms().cmp(b.terms()));
    distinct.dedup();
    assert_eq!(distinct.len(), 16);
}

/// HW's differences are those of the interior edges of the net, each once.
#[test]
fn loop_second_differences_belong_to_the_interior_edges() {
    for n in 3..=12 {
        let size = loop_scheme::local_net_size(n);
        let mesh = Mesh::new(loop_faces(n as usize), &vec![(); size]);
        let mut expected = Vec::new();
        for ((a, b), faces) in mesh.edges() {
            if faces.len() == 2 {
                let corners = faces.iter().flat_map(|&f| &mesh.faces[f]);
                let opposite = corners.filter(|&&v| v != a && v != b).map(|&v| (v, -1));
                expected.push(IntegerRow::new(opposite.chain([(a, 1), (b, 1)])));
            }
        }
        let mut rows = loop_scheme::second_differences(n);
        for list in [&mut rows, &mut expected] {
            list.sort_by(|a, b| a.terms().cmp(b.terms()));
        }
        assert_eq!(rows, expected, "n = {n}");
    }
}

/// The kernel is kept by subdivision: a difference of the refined net is a combination of those of
/// the net, so it vanishes where they all do.
#[test]
fn subdivision_keeps_the_kernel() {
    for n in 3..=12 {
        let size = loop_scheme::local_net_size(n);
        let rows = loop_scheme::second_differences(n);
        let differences = linear::matrix_of_rows::<R>(&rows, size);
        let matrix = loop_scheme::subdivision_matrix::<R>(LoopWeights::Warren, n).unwrap();
        let mut both = rows_of(&differences);
        let rank = exact::rank(both.clone());
        both.extend(rows_of(&(&differences * matrix)));
        assert_eq!(exact::rank(both), rank, "Loop n = {n}");

        let size = catmull_clark::local_net_size(n);
        let rows = catmull_clark::second_differences(n);
        let differences = linear::matrix_of_rows::<R>(&rows, size);
        let mut both = rows_of(&differences);
        let rank = exact::rank(both.clone());
        both.extend(rows_of(
            &(&differences * catmull_clark::subdivision_matrix::<R>(n)),
        ));
        assert_eq!(exact::rank(both), rank, "Catmull-Clark N = {n}");
    }
}
