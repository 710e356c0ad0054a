//! A basis of the row space with its inverse in integers.

use num_traits::Zero;

use crate::scalar::{Field, Rational};
use crate::scheme::IntegerRow;

/// What fills a slot of a basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    /// The row α_l, l from 0.
    Row(usize),
    /// The coordinate j of the net: completes the row space to the whole space.
    Pin(usize),
}

/// A maximal independent set of rows, completed by coordinates to a square matrix B, and
/// `B^-1 = inverse / determinant` in integers.
///
/// The functional t has the multipliers `x = t B^-1`: those of rows are its coordinates in the
/// basis, those of pinned coordinates are the values of t on a basis of the kernel of all rows, so
/// **t is in the span of the rows if and only if these are 0**.
///
/// Replacing a row keeps integers by Edmonds' rule: with `g = α · inverse` and the pivot
/// `p = g_i != 0`, column j != i becomes `(p column_j - g_j column_i) / determinant`, which comes
/// out even, column i stays, and the new determinant is p.
#[derive(Clone, Debug)]
pub struct Basis {
    pub(super) slots: Vec<Slot>,
    /// `columns[slot][point]`.
    pub(super) columns: Vec<Vec<i64>>,
    pub(super) determinant: i64,
}

impl Basis {
    /// All coordinates pinned: the unit matrix.
    pub(super) fn unit(size: usize) -> Self {
        let unit = |j: usize| (0..size).map(|i| i64::from(i == j)).collect();
        Basis {
            slots: (0..size).map(Slot::Pin).collect(),
            columns: (0..size).map(unit).collect(),
            determinant: 1,
        }
    }

    /// The rows of the basis in increasing order, from 0.
    pub fn rows(&self) -> Vec<usize> {
        let mut rows: Vec<usize> = self.slots.iter().filter_map(|slot| slot.row()).collect();
        rows.sort_unstable();
        rows
    }

    /// The common denominator of the multipliers; not 0.
    pub fn determinant(&self) -> i64 {
        self.determinant
    }

    /// The columns of the integer inverse that belong to rows: the pair (l, column), so that
    /// `x_l = Σ t_i column_i / determinant`.
    pub fn row_columns(&self) -> impl Iterator<Item = (usize, &[i64])> {
        let pairs = self.slots.iter().zip(&self.columns);
        pairs.filter_map(|(slot, column)| Some((slot.row()?, column.as_slice())))
    }

    /// Nets on which every row is 0, up to a factor; with the rows' columns they span all nets.
    pub fn kernel(&self) -> impl Iterator<Item = &[i64]> {
        let pairs = self.slots.iter().zip(&self.columns);
        pairs.filter_map(|(slot, column)| slot.row().is_none().then_some(column.as_slice()))
    }

    /// `row · inverse`, slot by slot; `None` on overflow.
    pub(super) fn coordinates(&self, row: &IntegerRow) -> Option<Vec<i64>> {
        let dot = |column: &Vec<i64>| {
            row.terms().iter().try_fold(0i64, |sum, &(i, a)| {
                sum.checked_add(column[i].checked_mul(a)?)
            })
        };
        self.columns.iter().map(dot).collect()
    }

    /// Puts `row` (index l) in place of `slot`; `g` are its [`Basis::coordinates`], `g[slot] != 0`.
    /// `None` on overflow; the basis is then as before.
    pub(super) fn replace(&mut self, slot: usize, l: usize, g: &[i64]) -> Option<()> {
        let (pivot, determinant) = (g[slot], self.determinant);
        let leaving = &self.columns[slot];
        let mut columns = Vec::with_capacity(self.columns.len());
        for (j, column) in self.columns.iter().enumerate() {
            columns.push(if j == slot || (g[j] == 0 && pivot == determinant) {
                column.clone()
            } else {
                let entry = |(a, b): (&i64, &i64)| {
                    let wide =
                        i128::from(pivot) * i128::from(*a) - i128::from(g[j]) * i128::from(*b);
                    i64::try_from(wide / i128::from(determinant)).ok()
                };
                column
                    .iter()
                    .zip(leaving)
                    .map(entry)
                    .collect::<Option<_>>()?
            });
        }
        self.columns = columns;
        self.determinant = pivot;
        self.slots[slot] = Slot::Row(l);
        Some(())
    }

    /// The net y with `α_l(y) = sign_l` for the rows of the basis and `y_j = 0` for its pinned
    /// coordinates, times the determinant.
    pub(super) fn scaled_net(&self, signs: &[i64]) -> Vec<i64> {
        let mut net = vec![0; self.columns.len()];
        for (column, sign) in self.columns.iter().zip(signs).filter(|(_, s)| **s != 0) {
            for (value, a) in net.iter_mut().zip(column) {
                *value += sign * a;
            }
        }
        net
    }

    /// A net in integers over the determinant.
    pub fn net(&self, scaled: &[i64]) -> Vec<Rational> {
        let over = |a: &i64| {
            if a.is_zero() {
                Rational::zero()
            } else {
                <Rational as Field>::ratio(*a, self.determinant)
            }
        };
        scaled.iter().map(over).collect()
    }
}

impl Slot {
    pub(super) fn row(&self) -> Option<usize> {
        match self {
            Slot::Row(l) => Some(*l),
            Slot::Pin(_) => None,
        }
    }
}
