//! Second differences: their kernels, and what subdivision does to them.

use subcert::scalar::Rational as R;
use subcert::scheme::{IntegerRow, LoopWeights, catmull_clark, linear, loop_scheme};

use crate::brute_force::Mesh;
use crate::exact;
use crate::loop_nets::loop_faces;
use crate::matrices::rows_of;

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

/// At N = 4 they are the second differences of the 4x4 grid along both axes.
#[test]
fn catmull_clark_second_differences_are_those_of_the_regular_grid() {
    let index = |i, j| match (i, j) {
        (-1, -1) => 8,
        _ => catmull_clark::lattice_label(4, i, j).unwrap() - 1,
    };
    let mut expected = Vec::new();
    for across in -1..=2 {
        for along in 0..=1 {
            let terms = |at: fn(i32, i32) -> (i32, i32)| {
                [(-1, -1), (0, 2), (1, -1)].map(|(step, weight)| {
                    let (i, j) = at(along + step, across);
                    (index(i, j), weight)
                })
            };
            expected.push(IntegerRow::new(terms(|i, j| (i, j))));
            expected.push(IntegerRow::new(terms(|i, j| (j, i))));
        }
    }
    let mut rows = catmull_clark::second_differences(4);
    for list in [&mut rows, &mut expected] {
        list.sort_by(|a, b| a.terms().cmp(b.terms()));
    }
    rows.dedup();
    assert_eq!(rows, expected);
}
