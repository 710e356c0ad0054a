//! Exact linear algebra for the tests: plain Gauss over any field with an exact zero test.
#![allow(dead_code)]

use subcert::scalar::Field;

/// Reduces to row echelon form in place; returns the pivot columns.
fn eliminate<S: Field>(a: &mut [Vec<S>], columns: usize) -> Vec<usize> {
    let mut pivots = Vec::new();
    for column in 0..columns {
        let row = pivots.len();
        let Some(pivot) = (row..a.len()).find(|&r| !a[r][column].is_zero()) else {
            continue;
        };
        a.swap(row, pivot);
        let inverse = S::one() / &a[row][column];
        for entry in &mut a[row] {
            *entry *= inverse.clone();
        }
        let pivot_row = a[row].clone();
        for (r, other) in a.iter_mut().enumerate() {
            if r != row && !other[column].is_zero() {
                let factor = other[column].clone();
                for (entry, p) in other.iter_mut().zip(&pivot_row) {
                    if !p.is_zero() {
                        *entry -= factor.clone() * p;
                    }
                }
            }
        }
        pivots.push(column);
    }
    pivots
}

/// The rank of a matrix given by rows.
pub fn rank<S: Field>(mut a: Vec<Vec<S>>) -> usize {
    let columns = a.first().map_or(0, Vec::len);
    eliminate(&mut a, columns).len()
}

/// The solution X of A X = B for a square regular A, or a tall A with a consistent B.
pub fn solve<S: Field>(a: &[Vec<S>], b: &[Vec<S>]) -> Vec<Vec<S>> {
    let columns = a[0].len();
    let mut joined = Vec::new();
    for (left, right) in a.iter().zip(b) {
        joined.push([left.as_slice(), right.as_slice()].concat());
    }
    let pivots = eliminate(&mut joined, columns);
    assert_eq!(pivots.len(), columns, "singular");
    for row in &joined[columns..] {
        assert!(row.iter().all(S::is_zero), "inconsistent");
    }
    joined.truncate(columns);
    joined
        .into_iter()
        .map(|row| row[columns..].to_vec())
        .collect()
}
