//! Matrices as the papers print them, compared entry by entry with those that the library builds.
//!
//! The printed data are in the papers' `printed` modules.

use subcert::bernstein::conversion::{BOX_SPLINE_DENOMINATOR, BOX_SPLINE_ROWS};
use subcert::paper::cheng_yong::matrix::{printed_matrix, ring_disagreements};
use subcert::paper::huang_wang_2008::printed;
use subcert::scalar::Rational;
use subcert::scheme::catmull_clark;

#[test]
fn hw_appendix_1_is_the_derived_conversion() {
    assert_eq!(BOX_SPLINE_DENOMINATOR, 24);
    assert_eq!(BOX_SPLINE_ROWS, printed::T_TIMES_24);
}

/// Where CY (10) prints an entry and the shifted rows speak too, they agree, from N = 5 on. At N = 4
/// one printed zero is wrong if the layout (six columns, dots, two columns) is taken at its word:
/// row V8 must have e, not 0, at V6, its neighbour round the ring. At N = 3 the columns overlap.
#[test]
fn cy_10_continues_as_its_printed_rows() {
    for n in 4..=20 {
        let disagreements = ring_disagreements(n);
        let expected: &[(usize, usize)] = if n == 4 { &[(8, 6)] } else { &[] };
        assert_eq!(disagreements, expected, "N = {n}");
    }
}

#[test]
fn cy_9_to_12_are_the_subdivision_matrix() {
    for n in 3..=20 {
        let ours = catmull_clark::subdivision_matrix::<Rational>(n as u32);
        let printed = printed_matrix(n);
        assert_eq!(ours.shape(), (printed.len(), printed.len()));
        for (i, row) in printed.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                assert_eq!(
                    ours[(i, j)],
                    *entry,
                    "N = {n}, entry ({}, {})",
                    i + 1,
                    j + 1
                );
            }
        }
    }
}
