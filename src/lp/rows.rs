//! The rows of the programs, and the two ways to solve one.

use super::basis::{Basis, Slot};
use super::simplex::{self, Number};
use crate::scalar::Rational;
use crate::scheme::IntegerRow;

/// Integer functionals α_0, α_1, .. of nets of `size` points, with a first basis.
#[derive(Clone, Debug)]
pub struct Rows {
    rows: Vec<IntegerRow>,
    start: Basis,
}

/// The optimum of a program, with proofs of both sides.
#[derive(Clone, Debug)]
pub struct Solution<S> {
    /// The basis it was found at.
    pub basis: Basis,
    /// The multipliers of all rows: `Σ x_l α_l = t`.
    pub x: Vec<S>,
    /// The net that attains the value: `|α_l(y)| <= 1`, `t(y) = value`.
    pub y: Vec<Rational>,
    /// `Σ |x_l|`.
    pub value: S,
}

impl Rows {
    /// The rows, each a functional of nets of `size` points.
    ///
    /// # Panics
    /// If an entry is too large for exact pivots in 64 bits, or an index is out of range.
    pub fn new(rows: Vec<IntegerRow>, size: usize) -> Self {
        let mut start = Basis::unit(size);
        for (l, row) in rows.iter().enumerate() {
            let g = start.coordinates(row).expect("small rows");
            // The smallest pivot keeps the determinant small. No pivot: the row is dependent.
            let free = (0..size).filter(|&i| g[i] != 0 && matches!(start.slots[i], Slot::Pin(_)));
            if let Some(slot) = free.min_by_key(|&i| g[i].abs()) {
                start.replace(slot, l, &g).expect("small rows");
            }
        }
        Rows { rows, start }
    }

    /// The rows.
    pub fn rows(&self) -> &[IntegerRow] {
        &self.rows
    }

    /// Number of points of a net.
    pub fn size(&self) -> usize {
        self.start.columns.len()
    }

    /// The rank of the rows.
    pub fn rank(&self) -> usize {
        self.start.row_columns().count()
    }

    /// A basis to start from, whatever t.
    pub fn start(&self) -> &Basis {
        &self.start
    }

    /// The basis of the given rows (from 0), if they are independent and as many as the rank.
    pub fn basis(&self, rows: &[usize]) -> Option<Basis> {
        let mut basis = Basis::unit(self.size());
        for &l in rows {
            let g = basis.coordinates(self.rows.get(l)?)?;
            let free = (0..g.len()).filter(|&i| g[i] != 0 && basis.slots[i].row().is_none());
            let slot = free.min_by_key(|&i| g[i].abs())?;
            basis.replace(slot, l, &g)?;
        }
        (rows.len() == self.rank()).then_some(basis)
    }

    /// The optimum for an exact right-hand side; `None` if and only if t is not in the span of the
    /// rows, or numbers of the basis leave 64 bits.
    ///
    /// Exact: t = Σ x_l α_l and `value = Σ |x_l| = t(y)` hold as identities of `S`.
    ///
    /// ```
    /// use num_traits::Zero;
    /// use subcert::lp::Rows;
    /// use subcert::scalar::{Field, Rational};
    /// use subcert::scheme::IntegerRow;
    /// // Second differences of 4 numbers; the middle one of y1 - y4 less the chord of y0 .. y3.
    /// let rows = (0..2).map(|i| IntegerRow::new([(i, -1), (i + 1, 2), (i + 2, -1)])).collect();
    /// let rows = Rows::new(rows, 4);
    /// let r = Rational::ratio;
    /// let t = [r(-2, 3), r(1, 1), r(0, 1), r(-1, 3)]; // y1 - (2 y0 + y3)/3
    /// let best = rows.minimise(&t, rows.start()).unwrap();
    /// assert_eq!(best.value, r(1, 1));
    /// assert_eq!(best.x, [r(2, 3), r(1, 3)]);
    /// ```
    pub fn minimise<S: Number>(&self, t: &[S], from: &Basis) -> Option<Solution<S>> {
        simplex::solve(self, t, from)
    }

    /// A basis that is optimal for a right-hand side near the float t, and its net y times the
    /// determinant. **A proposal**: that `|α_l(y)| <= 1` holds exactly; whether the basis is optimal
    /// for t itself is for the caller to see. `None` if the loop does not end or overflows.
    pub fn propose(&self, t: &[f64], from: &Basis) -> Option<(Basis, Vec<i64>)> {
        simplex::propose(self, t, from)
    }
}
