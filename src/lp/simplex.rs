//! The pivot loop, over exact numbers and over floats.
//!
//! At a basis with multipliers x and signs s the dual net is `y = B^-1 s`. If `|α_l(y)| <= 1` for all
//! l, then `t(y) = Σ s_l x_l` is the optimum, provided that s_l is the sign of x_l. Else let
//! `|z_l| > 1`, `z_l = α_l(y)`, σ its sign: raising σ x_l from 0 to θ changes the others to
//! `x_j - θ σ g_j`, g = α_l B^-1, and the sum by `θ (1 - |z_l|) < 0` until the first x_j reaches 0:
//! that one leaves.

use std::cmp::Ordering;

use super::basis::Basis;
use super::rows::{Rows, Solution};
use crate::scalar::{Cyclotomic, Decide, Field, Rational};

/// A right-hand side with a total order: exact numbers only.
pub trait Number: Field + Decide {
    /// The order of two numbers.
    fn order(&self, other: &Self) -> Ordering;
}

impl Number for Rational {
    fn order(&self, other: &Self) -> Ordering {
        self.decide(other).expect("rationals are ordered")
    }
}

impl Number for Cyclotomic {
    fn order(&self, other: &Self) -> Ordering {
        self.compare(other)
    }
}

fn multiplier<S: Field>(t: &[S], column: &[i64], determinant: &S) -> S {
    let mut sum = S::zero();
    for (value, &a) in t.iter().zip(column).filter(|(_, a)| **a != 0) {
        sum += value.clone() * &S::from_integer(a);
    }
    if sum.is_zero() {
        return sum;
    }
    sum / determinant
}

/// Exact, by Bland's rule: the least index enters, among equal ratios the least index leaves. Each
/// variable is a pair (row, sign), so a basic x_l = 0 keeps the sign it came in with.
pub(super) fn solve<S: Number>(rows: &Rows, t: &[S], from: &Basis) -> Option<Solution<S>> {
    assert_eq!(t.len(), rows.size(), "a functional has one entry per point");
    let mut basis = from.clone();
    let mut signs: Option<Vec<i64>> = None;
    loop {
        let determinant = S::from_integer(basis.determinant);
        let x: Vec<S> = (basis.columns.iter())
            .map(|column| multiplier(t, column, &determinant))
            .collect();
        let sign_of = |x: &S| x.order(&S::zero()) as i64;
        for (value, slot) in x.iter().zip(&basis.slots) {
            if slot.row().is_none() && !value.is_zero() {
                return None;
            }
        }
        let s = match signs {
            Some(s) => s,
            None => (x.iter().zip(&basis.slots))
                .map(|(x, slot)| match slot.row() {
                    None => 0,
                    Some(_) => sign_of(x) + i64::from(x.is_zero()),
                })
                .collect(),
        };
        let net = basis.scaled_net(&s);
        let bound = basis.determinant.abs();
        let entering = rows.rows().iter().enumerate().find_map(|(l, row)| {
            let z: i64 = row.terms().iter().map(|&(i, a)| a * net[i]).sum();
            (z.abs() > bound).then(|| (l, z.signum() * basis.determinant.signum()))
        });
        let Some((l, sigma)) = entering else {
            let mut all = vec![S::zero(); rows.rows().len()];
            let mut value = S::zero();
            for ((x, slot), s) in x.into_iter().zip(&basis.slots).zip(&s) {
                if let Some(l) = slot.row() {
                    value += x.clone() * &S::from_integer(*s);
                    all[l] = x;
                }
            }
            let y = basis.net(&net);
            return Some(Solution {
                basis,
                x: all,
                y,
                value,
            });
        };
        let g = basis.coordinates(&rows.rows()[l])?;
        // s_j x_j falls at the rate s_j σ g_j / determinant.
        let mut leaving: Option<(usize, S)> = None;
        for j in 0..g.len() {
            let rate = s[j] * sigma * g[j] * basis.determinant.signum();
            if rate <= 0 || basis.slots[j].row().is_none() {
                continue;
            }
            let ratio = x[j].clone() * &S::from_integer(s[j]) / &S::from_integer(rate);
            let better = leaving
                .as_ref()
                .is_none_or(|(known, least)| match ratio.order(least) {
                    Ordering::Less => true,
                    Ordering::Equal => basis.slots[j].row() < basis.slots[*known].row(),
                    Ordering::Greater => false,
                });
            if better {
                leaving = Some((j, ratio));
            }
        }
        // Σ|x| is bounded below, so something stops the decrease.
        let (slot, _) = leaving?;
        basis.replace(slot, l, &g)?;
        let mut s = s;
        s[slot] = sigma;
        signs = Some(s);
    }
}

/// Multiples of this constant modulo 1 are the perturbation: well spread and the same everywhere.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Relative size of the perturbation.
const PERTURBATION: f64 = 1e-8;

/// Functionals below this are rounding errors of functionals of size 1; the perturbation is then as
/// that of one of size 1e-6.
const NEGLIGIBLE: f64 = 1e-12;

/// As [`solve`] in `f64`, for t + a small combination of the rows: the most violated row enters, and
/// the step goes on over sign changes while the sum still falls.
pub(super) fn propose(rows: &Rows, t: &[f64], from: &Basis) -> Option<(Basis, Vec<i64>)> {
    let size = rows.size();
    let largest = t.iter().fold(0f64, |m, x| m.max(x.abs()));
    // A functional that is 0 but for rounding would leave only rounding to decide: it could cycle.
    let scale = PERTURBATION * if largest < NEGLIGIBLE { 1e-6 } else { largest };
    let mut t = t.to_vec();
    for (l, row) in rows.rows().iter().enumerate() {
        let weight = scale * (0.5 + ((l + 1) as f64 * GOLDEN).fract());
        let weight = if l % 2 == 0 { weight } else { -weight };
        for &(i, a) in row.terms() {
            t[i] += weight * a as f64;
        }
    }
    let mut basis = from.clone();
    let mut breaks: Vec<(f64, usize)> = Vec::with_capacity(size);
    for _ in 0..20 * (size + 20) {
        let determinant = basis.determinant as f64;
        let x: Vec<f64> = (basis.columns.iter())
            .map(|column| {
                let sum: f64 = column.iter().zip(&t).map(|(&a, t)| a as f64 * t).sum();
                sum / determinant
            })
            .collect();
        let signs: Vec<i64> = (x.iter().zip(&basis.slots))
            .map(|(x, slot)| match slot.row() {
                None => 0,
                Some(_) if *x < 0.0 => -1,
                Some(_) => 1,
            })
            .collect();
        let net = basis.scaled_net(&signs);
        let bound = basis.determinant.abs();
        let (mut entering, mut worst) = (None, bound);
        for (l, row) in rows.rows().iter().enumerate() {
            let z: i64 = row.terms().iter().map(|&(i, a)| a * net[i]).sum();
            if z.abs() > worst {
                worst = z.abs();
                entering = Some((l, z.signum() * basis.determinant.signum()));
            }
        }
        let Some((l, sigma)) = entering else {
            return Some((basis, net));
        };
        let g = basis.coordinates(&rows.rows()[l])?;
        breaks.clear();
        for j in 0..size {
            if basis.slots[j].row().is_none() || g[j] == 0 {
                continue;
            }
            let rate = sigma as f64 * g[j] as f64 / determinant;
            if rate * signs[j] as f64 > 0.0 {
                breaks.push((x[j] / rate, j));
            }
        }
        breaks.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut slope = 1.0 - worst as f64 / bound as f64;
        let slot = breaks.iter().find_map(|&(_, j)| {
            slope += 2.0 * (g[j] as f64 / determinant).abs();
            (slope >= -1e-9).then_some(j)
        })?;
        basis.replace(slot, l, &g)?;
    }
    None
}
