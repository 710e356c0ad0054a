//! What a claim fixes: valence, beta, q, the second differences; and the work allowed for it.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt::Display;

use num_rational::BigRational;

use crate::file::{File, Number, Value};
use crate::net::{edges, opposite};
use crate::polynomial::{Beta, Polynomial};
use crate::rational::{contrast, ratio};
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::{basis, cosine};

/// Elementary operations allowed for one file: a few minutes.
const WORK: u64 = 20_000_000_000;

/// A second difference: labels (from 0) and coefficients.
pub type Row = Vec<(usize, i64)>;

/// The setting of a claim.
pub struct Space {
    pub n: usize,
    /// n + 6, the number of points.
    pub size: usize,
    pub beta: Beta,
    /// 3 + 8 beta.
    pub q: Polynomial,
    /// The second differences.
    pub rows: Vec<Row>,
    /// Their rank.
    pub rank: usize,
    work: Cell<u64>,
}

impl Space {
    /// The setting of a file's claim.
    ///
    /// # Errors
    ///
    /// If and only if the enclosure of cos(π/n) is missing, idle or wrong: rule `cosine`.
    pub fn new(file: &File) -> Outcome<Self> {
        let n = file.claim.valence;
        let beta = match (cosine::rational_beta(file.claim.weights, n), &file.cosine) {
            (Some(beta), None) => Ok(Beta::exact(&beta)),
            (Some(_), Some(_)) => Err("beta is rational here, so that \"cosine\" is null".into()),
            (None, Some((Number(lo), Number(hi)))) => cosine::enclose_beta(n, lo, hi),
            (None, None) => Err("an enclosure of cos(π/n) is missing".into()),
        };
        beta.map(|beta| Self::of(n, beta)).map_err(|why| Rejection::new(Rule::Cosine, why))
    }

    /// The setting of a valence and a beta.
    pub fn of(n: usize, beta: Beta) -> Self {
        let rows: Vec<Row> = edges(n).into_iter().map(|(a, b)| row(n, a, b)).collect();
        let q = &Polynomial::integer(3) + &beta.value.scale(&ratio(8, 1));
        let rank = basis::rank(&rows, n + 6);
        Self { n, size: n + 6, beta, q, rows, rank, work: Cell::new(WORK) }
    }

    /// Takes this much off the work allowed.
    ///
    /// # Errors
    ///
    /// If and only if less is left: rule `format`.
    pub fn charge(&self, work: u64) -> Outcome<()> {
        let left = self.work.get().checked_sub(work);
        self.work.set(left.unwrap_or(0));
        ensure!(left.is_some(), Rule::Format, "more work than the checker allows for one file");
        Ok(())
    }

    /// The polynomial that a value has over q.
    pub fn value(&self, value: &Value) -> Polynomial {
        let horner =
            |sum: Polynomial, c: &Number| &(&sum * &self.beta.value) + &Polynomial::constant(&c.0);
        match value {
            Value::Rational(r) => self.q.scale(&r.0),
            Value::OverQ(list) => list.iter().rev().fold(Polynomial::integer(0), horner),
        }
    }

    /// Checks `x / q <= y / q`; the rejection shows both.
    ///
    /// # Errors
    ///
    /// If and only if it is not certain: the rule given.
    pub fn at_most(
        &self,
        x: &Polynomial,
        y: &Polynomial,
        rule: Rule,
        what: impl Display,
    ) -> Outcome<()> {
        if (x - y).is_at_most_zero(&self.beta) {
            return Ok(());
        }
        let (x, y) = contrast(&self.near(x), &self.near(y));
        Err(Rejection::new(rule, format!("{what}: {x} is not shown to be at most {y}")))
    }

    /// `x / q` at the middle of the enclosure of beta: for decimals only.
    pub fn near(&self, x: &Polynomial) -> BigRational {
        let beta = self.beta.middle();
        x.at(&beta) / self.q.at(&beta)
    }
}

/// The second difference over the edge (a, b), coefficients at the same label added up.
fn row(n: usize, a: usize, b: usize) -> Row {
    let [c, d] = opposite(n, a, b);
    let mut sums = BTreeMap::new();
    for (label, sign) in [(a, 1), (b, 1), (c, -1), (d, -1)] {
        *sums.entry(label - 1).or_insert(0) += sign;
    }
    sums.into_iter().filter(|&(_, c)| c != 0).collect()
}
