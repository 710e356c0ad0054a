//! Linear maps of control nets: as matrices, and as short rows of integers.

use nalgebra::DMatrix;

use crate::scalar::{Field, Module};

/// The matrix of a linear map of nets, column by column from its values at the unit nets.
///
/// `map` is the generic refinement function itself at `V = S`, so a matrix can't disagree with
/// the rule it stands for. `None` if and only if `map` returns `None`.
///
/// # Panics
/// If `map` returns nets of different lengths.
pub fn matrix_of<S: Field>(
    columns: usize,
    map: impl Fn(&[S]) -> Option<Vec<S>>,
) -> Option<DMatrix<S>> {
    let mut images = Vec::with_capacity(columns);
    for column in 0..columns {
        let mut unit = vec![S::zero(); columns];
        unit[column] = S::one();
        images.push(map(&unit)?);
    }
    let rows = images.first().map_or(0, Vec::len);
    assert!(images.iter().all(|image| image.len() == rows));
    Some(DMatrix::from_fn(rows, columns, |row, column| {
        images[column][row].clone()
    }))
}

/// A linear functional of a net with a few integer coefficients, such as a second difference.
///
/// Terms are sorted by index; an index that was given twice carries the sum of its coefficients
/// (rings of small valence meet themselves), and zero coefficients are absent.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct IntegerRow {
    terms: Vec<(usize, i64)>,
}

impl IntegerRow {
    /// The functional `Σ coefficient · net[index]`, indices 0-based.
    pub fn new(terms: impl IntoIterator<Item = (usize, i64)>) -> Self {
        let mut sums = std::collections::BTreeMap::new();
        for (index, coefficient) in terms {
            *sums.entry(index).or_insert(0) += coefficient;
        }
        let terms = sums.into_iter().filter(|&(_, c)| c != 0).collect();
        IntegerRow { terms }
    }

    /// The pairs (0-based index, nonzero coefficient), by increasing index.
    pub fn terms(&self) -> &[(usize, i64)] {
        &self.terms
    }

    /// The value of the functional at a net.
    ///
    /// # Panics
    /// If an index lies outside the net.
    pub fn apply<S: Field, V: Module<S>>(&self, net: &[V]) -> V {
        let mut sum = V::zero();
        for &(index, coefficient) in &self.terms {
            sum = match coefficient {
                1 => sum + &net[index],
                -1 => sum - &net[index],
                c => sum + &(net[index].clone() * &S::from_integer(c)),
            };
        }
        sum
    }
}

/// The matrix whose rows are the given functionals of nets of `columns` points.
pub fn matrix_of_rows<S: Field>(rows: &[IntegerRow], columns: usize) -> DMatrix<S> {
    let mut matrix = DMatrix::from_element(rows.len(), columns, S::zero());
    for (i, row) in rows.iter().enumerate() {
        for &(index, coefficient) in row.terms() {
            matrix[(i, index)] = S::from_integer(coefficient);
        }
    }
    matrix
}
