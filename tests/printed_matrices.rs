//! Matrices as the papers print them, compared entry by entry with those that the library builds.
//!
//! The printed data of CY are typed here once, in the paper's own letters and layout; those of HW are in
//! `paper::huang_wang_2008::printed`.

use num_traits::Zero;
use subcert::bernstein::conversion::{BOX_SPLINE_DENOMINATOR, BOX_SPLINE_ROWS};
use subcert::paper::huang_wang_2008::printed;
use subcert::scalar::{Field, Rational};
use subcert::scheme::catmull_clark;

/// CY (10): the rows of the block of the ring, after the first row. `.` marks an entry that the
/// print leaves to its dots; the last two columns are the last two of the matrix, whatever N.
const CY_10_FIRST: [&str; 4] = [
    "d d e e 0 0 . e e",
    "f f f f 0 0 . 0 0",
    "d e e d e e . 0 0",
    "f 0 0 f f f . 0 0",
];
const CY_10_LAST: [&str; 2] = ["d e 0 0 0 0 . d e", "f f 0 0 0 0 . f f"];

/// CY (11): columns V1..V9 of the rows V(2N+2)..V(2N+8).
const CY_11: [&str; 7] = [
    "c 0 0 b a b 0 0 0",
    "e 0 0 e d d 0 0 0",
    "b 0 0 c b a b c 0",
    "e 0 0 0 0 d d e 0",
    "e 0 0 d d e 0 0 0",
    "b c b a b c 0 0 0",
    "e e d d 0 0 0 0 0",
];

/// CY (12): columns V(2N+2)..V(2N+8) of the same rows.
const CY_12: [&str; 7] = [
    "c b c 0 b c 0",
    "0 e e 0 0 0 0",
    "0 c b c 0 0 0",
    "0 0 e e 0 0 0",
    "0 0 0 0 e e 0",
    "0 0 0 0 c b c",
    "0 0 0 0 0 e e",
];

fn letter(name: &str) -> Rational {
    let (p, q) = match name {
        "0" => (0, 1),
        "a" => (9, 16),
        "b" => (3, 32),
        "c" => (1, 64),
        "d" => (3, 8),
        "e" => (1, 16),
        "f" => (1, 4),
        _ => panic!("no such letter: {name}"),
    };
    Rational::ratio(p, q)
}

/// What the print says of row `row` (0-based, 1..=2N) and column `column` of CY (10): the first and
/// the last rows as they stand, those under the vertical dots by shifting the pair of rows V2, V3
/// round the ring. `None` where only dots are printed.
fn printed_ring_entry(n: usize, row: usize, column: usize) -> Option<Rational> {
    let size = 2 * n + 1;
    let line = match row {
        1..=4 => CY_10_FIRST[row - 1],
        _ if row + 2 >= size => CY_10_LAST[row + 2 - size],
        _ => return None,
    };
    let entries: Vec<&str> = line.split_whitespace().collect();
    if column < 6 {
        Some(letter(entries[column]))
    } else if column + 2 >= size {
        Some(letter(entries[column + 9 - size]))
    } else {
        None
    }
}

/// The whole ring block: rows V2 and V3, as printed, shifted cyclically by two columns per sector.
fn shifted_ring_entry(n: usize, row: usize, column: usize) -> Rational {
    if column == 0 {
        return letter(if row % 2 == 1 { "d" } else { "f" });
    }
    let ring = 2 * n;
    let sector = (row - 1) / 2;
    let at = (column - 1 + ring - 2 * sector) % ring;
    let line = if row % 2 == 1 {
        // d e e at V2 V3 V4, e e at V(2N) V(2N+1).
        ["d", "e", "e"]
            .get(at)
            .copied()
            .unwrap_or(if at + 2 >= ring { "e" } else { "0" })
    } else {
        ["f", "f", "f"].get(at).copied().unwrap_or("0")
    };
    letter(line)
}

/// The matrix T of CY (9) with its blocks as printed; at N = 3 column V8 is added to V2.
fn printed_matrix(n: usize) -> Vec<Vec<Rational>> {
    let (ring_size, size) = (2 * n + 1, 2 * n + 8);
    let mut matrix = vec![vec![Rational::zero(); size]; size];
    let valence = n as i64;
    for (column, entry) in matrix[0][..ring_size].iter_mut().enumerate() {
        *entry = match column {
            0 => Rational::ratio(4 * valence - 7, 4 * valence),
            _ if column % 2 == 1 => Rational::ratio(3, 2 * valence * valence),
            _ => Rational::ratio(1, 4 * valence * valence),
        };
    }
    for (row, entries) in matrix.iter_mut().enumerate().take(ring_size).skip(1) {
        for (column, entry) in entries.iter_mut().enumerate().take(ring_size) {
            *entry = shifted_ring_entry(n, row, column);
        }
    }
    for (i, line) in CY_11.iter().enumerate() {
        for (column, name) in line.split_whitespace().enumerate() {
            let wrapped = if column < ring_size {
                column
            } else {
                column - 2 * n
            };
            matrix[ring_size + i][wrapped] += letter(name);
        }
    }
    for (i, line) in CY_12.iter().enumerate() {
        for (column, name) in line.split_whitespace().enumerate() {
            matrix[ring_size + i][ring_size + column] = letter(name);
        }
    }
    matrix
}

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
        let mut disagreements = Vec::new();
        for row in 1..=2 * n {
            for column in 0..=2 * n {
                let printed = printed_ring_entry(n, row, column);
                if printed.is_some_and(|entry| entry != shifted_ring_entry(n, row, column)) {
                    disagreements.push((row + 1, column + 1));
                }
            }
        }
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
