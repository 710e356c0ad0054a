//! Linear systems: exact over the rationals, verified over any arithmetic that decides.
//!
//! Rational elimination is Bareiss' fraction-free one: rows are cleared of denominators, every
//! intermediate entry is a minor of the integer matrix, every division comes out even, and no
//! fraction is ever reduced on the way.
//!
//! | function | matrix | answer |
//! |---|---|---|
//! | [`solve`] | rational, m x n | the one solution, if there is exactly one |
//! | [`rank`], [`determinant`] | rational | exact |
//! | [`solve_certified`] | [`Decide`] (intervals, Q(2 cos 2π/n)), n x n | a solution, if every pivot is certainly not 0 |

use std::cmp::Ordering;

use nalgebra::DMatrix;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use crate::scalar::{Decide, Rational};

/// The X with `a X = b`, if there is exactly one.
///
/// `None` if and only if the columns of `a` are dependent or no X solves the system. `a` may have
/// more rows than columns.
///
/// ```
/// use nalgebra::dmatrix;
/// use subcert::{linalg, scalar::{Field, Rational}};
/// let r = Rational::ratio;
/// let a = dmatrix![r(1, 2), r(1, 3); r(1, 1), r(1, 1)];
/// let x = linalg::solve(&a, &dmatrix![r(1, 1); r(2, 1)]).unwrap();
/// assert_eq!(x, dmatrix![r(2, 1); r(0, 1)]);
/// ```
///
/// # Panics
/// If the numbers of rows differ.
pub fn solve(a: &DMatrix<Rational>, b: &DMatrix<Rational>) -> Option<DMatrix<Rational>> {
    assert_eq!(
        a.nrows(),
        b.nrows(),
        "a has {} rows, b has {}",
        a.nrows(),
        b.nrows()
    );
    let n = a.ncols();
    let (mut rows, _) = integer_rows(a, Some(b));
    let echelon = eliminate(&mut rows, n);
    let consistent = rows
        .iter()
        .skip(n)
        .all(|row| row[n..].iter().all(Zero::is_zero));
    if echelon.rank < n || !consistent {
        return None;
    }
    // Row i now reads u_ii x_i + Σ_(j>i) u_ij x_j = c_i. With D the last pivot, D x_j is an integer
    // (Cramer), and D x_i = (D c_i - Σ_(j>i) u_ij (D x_j)) / u_ii.
    let last = echelon.last_pivot;
    let mut scaled = vec![vec![BigInt::ZERO; b.ncols()]; n];
    for i in (0..n).rev() {
        for k in 0..b.ncols() {
            let known: BigInt = (i + 1..n).map(|j| &rows[i][j] * &scaled[j][k]).sum();
            scaled[i][k] = (&last * &rows[i][n + k] - known) / &rows[i][i];
        }
    }
    Some(DMatrix::from_fn(n, b.ncols(), |i, k| {
        Rational::new(scaled[i][k].clone(), last.clone())
    }))
}

/// The rank.
pub fn rank(a: &DMatrix<Rational>) -> usize {
    let (mut rows, _) = integer_rows(a, None);
    eliminate(&mut rows, a.ncols()).rank
}

/// The determinant; 1 for the empty matrix.
///
/// # Panics
/// If the matrix is not square.
pub fn determinant(a: &DMatrix<Rational>) -> Rational {
    assert!(
        a.is_square(),
        "determinant of a {} x {} matrix",
        a.nrows(),
        a.ncols()
    );
    let (mut rows, scale) = integer_rows(a, None);
    let echelon = eliminate(&mut rows, a.ncols());
    if echelon.rank < a.nrows() {
        return Rational::zero();
    }
    let numerator = if echelon.odd {
        -echelon.last_pivot
    } else {
        echelon.last_pivot
    };
    Rational::new(numerator, scale)
}

/// The rows of [a | b], each multiplied by the common denominator of its entries, and the product
/// of these multipliers.
fn integer_rows(
    a: &DMatrix<Rational>,
    b: Option<&DMatrix<Rational>>,
) -> (Vec<Vec<BigInt>>, BigInt) {
    let mut product = BigInt::one();
    let rows = (0..a.nrows())
        .map(|i| {
            let left = (0..a.ncols()).map(|j| &a[(i, j)]);
            let right = b
                .into_iter()
                .flat_map(|b| (0..b.ncols()).map(move |j| &b[(i, j)]));
            let row: Vec<&Rational> = left.chain(right).collect();
            let common = row
                .iter()
                .fold(BigInt::one(), |common, x| common.lcm(x.denom()));
            product *= &common;
            row.iter()
                .map(|x| x.numer() * (&common / x.denom()))
                .collect()
        })
        .collect();
    (rows, product)
}

struct Echelon {
    rank: usize,
    /// The last pivot; up to its sign the minor of the pivot rows and columns.
    last_pivot: BigInt,
    /// Whether an odd number of rows was exchanged.
    odd: bool,
}

/// Bareiss' elimination to row echelon form with pivots in the first `columns` columns.
///
/// With p the pivot and q the one before, `a_ij <- (p a_ij - a_ic a_rj) / q` is again a minor of
/// the original matrix (Sylvester), hence an integer.
fn eliminate(rows: &mut [Vec<BigInt>], columns: usize) -> Echelon {
    let mut echelon = Echelon {
        rank: 0,
        last_pivot: BigInt::one(),
        odd: false,
    };
    for column in 0..columns {
        let top = echelon.rank;
        // The shortest pivot keeps the following products short.
        let candidates = (top..rows.len()).filter(|i| !rows[*i][column].is_zero());
        let Some(pivot_row) = candidates.min_by_key(|i| rows[*i][column].bits()) else {
            continue;
        };
        if pivot_row != top {
            rows.swap(pivot_row, top);
            echelon.odd = !echelon.odd;
        }
        let (above, below) = rows.split_at_mut(top + 1);
        let pivot_row = &above[top];
        let pivot = &pivot_row[column];
        for row in below {
            let factor = std::mem::take(&mut row[column]);
            for (entry, p) in row.iter_mut().zip(pivot_row).skip(column + 1) {
                *entry = (pivot * &*entry - &factor * p) / &echelon.last_pivot;
            }
        }
        echelon.last_pivot = pivot.clone();
        echelon.rank += 1;
    }
    echelon
}

/// An X with `a X = b` by Gauss' elimination; `None` if some column has no pivot that is certainly
/// different from 0.
///
/// Guarantee. Over intervals: `a` is then regular for every choice of entries in its intervals, and
/// X contains every solution. Over exact types: the solution, and `None` if and only if `a` is
/// singular.
///
/// # Panics
/// If `a` is not square or the numbers of rows differ.
pub fn solve_certified<S: Decide>(a: &DMatrix<S>, b: &DMatrix<S>) -> Option<DMatrix<S>> {
    assert!(a.is_square(), "a is {} x {}", a.nrows(), a.ncols());
    assert_eq!(
        a.nrows(),
        b.nrows(),
        "a has {} rows, b has {}",
        a.nrows(),
        b.nrows()
    );
    let n = a.nrows();
    let (mut a, mut b) = (a.clone(), b.clone());
    for column in 0..n {
        let pivot_row = certain_pivot(&a, column)?;
        a.swap_rows(pivot_row, column);
        b.swap_rows(pivot_row, column);
        for i in column + 1..n {
            if a[(i, column)].is_zero() {
                continue;
            }
            let factor = a[(i, column)].clone() / &a[(column, column)];
            for j in column + 1..n {
                let product = a[(column, j)].clone() * &factor;
                a[(i, j)] -= product;
            }
            for k in 0..b.ncols() {
                let product = b[(column, k)].clone() * &factor;
                b[(i, k)] -= product;
            }
        }
    }
    for i in (0..n).rev() {
        for k in 0..b.ncols() {
            let mut value = b[(i, k)].clone();
            for j in i + 1..n {
                value -= b[(j, k)].clone() * &a[(i, j)];
            }
            b[(i, k)] = value / &a[(i, i)];
        }
    }
    Some(b)
}

/// Among the entries on and below the diagonal that are certainly not 0, one that none of the later
/// ones certainly exceeds in magnitude.
fn certain_pivot<S: Decide>(a: &DMatrix<S>, column: usize) -> Option<usize> {
    let mut best: Option<(usize, S)> = None;
    for i in column..a.nrows() {
        let entry = &a[(i, column)];
        let magnitude = match entry.decide(&S::zero()) {
            Some(Ordering::Greater) => entry.clone(),
            Some(Ordering::Less) => -entry.clone(),
            _ => continue,
        };
        let better = best
            .as_ref()
            .is_none_or(|(_, known)| magnitude.decide(known) == Some(Ordering::Greater));
        if better {
            best = Some((i, magnitude));
        }
    }
    best.map(|(i, _)| i)
}
