//! Z. Huang, G. Wang: Bounding the distance between a Loop subdivision surface and its limit mesh.
//! GMP 2008.
//!
//! | claims | file | decided by |
//! |---|---|---|
//! | matrix T, δ_i, Theorems 1 and 2 | `regular.rs` | exact linear programs, one net |
//! | Table 1, Lemma 1, what is said of rates | `rates.rs` | rates and mesh rates, exact |
//! | Theorem 3, β(n), facts 1 and 2 | `limit.rs`, `bound_function.rs` | the paper's method on intervals; B_0 |
//! | (15), C_3(n) | `control.rs` | (15) in three readings, exact; C_0 |
//! | Theorem 4, (14), (16) | `theorem_4.rs`, `depth.rs` | exact ceilings; B_k |
//! | Table 3 | `table_3.rs`, `needed.rs` | the same; the depths that C_k, B_k need |
//! | limit mesh against control mesh | `comparison.rs` | C_k against B_k |
//!
//! Printed numbers are in [`printed`]; everything else is computed by [`examine`].

mod bound_function;
mod comparison;
mod control;
pub mod depth;
mod limit;
mod needed;
pub mod nets;
mod plots;
pub mod printed;
mod rates;
mod regular;
mod table_3;
mod theorem_4;
mod valence;

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use super::Report;
use super::proof::by_name;
use crate::paper::words::{self, ranges};
use valence::{Proved, Valence};

/// What is known of all valences asked for.
struct Findings {
    /// In order.
    asked: Vec<Valence>,
    /// Valence 6, with which the paper compares; also if it was not asked for.
    regular: Valence,
}

impl Findings {
    /// A valence that was asked for.
    fn at(&self, n: u32) -> Option<&Valence> {
        self.asked.iter().find(|v| v.n == n)
    }

    /// The scope in words.
    fn scope(&self) -> String {
        self.scope_of(self.asked.iter().map(|v| v.n))
    }

    fn scope_of(&self, valences: impl Iterator<Item = u32>) -> String {
        format!("n = {}", ranges(valences))
    }

    /// The certificate files of a constant of each valence.
    fn files<'a>(&'a self, of: impl Fn(&'a Valence) -> Option<&'a Proved>) -> Vec<String> {
        self.asked
            .iter()
            .filter_map(|v| Some(of(v)?.file.clone()))
            .collect()
    }
}

/// Why nothing could be said.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no proof of the convergence rates of valence {0} was found")]
pub struct NoRates(pub u32);

/// Judges every claim of the paper for the given valences, all at least 3.
///
/// The result does not depend on the number of threads. `tell` hears how many valences of how many
/// are done.
///
/// # Errors
/// If and only if the prover fails on a rate.
pub fn examine(valences: &[u32], tell: &(dyn Fn(u32, u32) + Sync)) -> Result<Report, NoRates> {
    let mut all: Vec<u32> = valences.to_vec();
    all.push(6);
    all.sort_unstable();
    all.dedup();
    all.reverse();
    let done = AtomicU32::new(0);
    let examine = |&n: &u32| {
        // Deep levels cost most: only where Table 3 has an entry.
        let ratio = printed::VALENCES
            .contains(&n)
            .then_some(printed::TABLE_3_RATIO);
        let valence = Valence::examine(n, ratio).ok_or(NoRates(n));
        tell(done.fetch_add(1, Ordering::Relaxed) + 1, all.len() as u32);
        valence
    };
    // Large valences take longest: they go first.
    let mut examined: Vec<Valence> = all
        .par_iter()
        .with_max_len(1)
        .map(examine)
        .collect::<Result<_, _>>()?;
    examined.reverse();
    let regular = examined
        .iter()
        .find(|v| v.n == 6)
        .cloned()
        .ok_or(NoRates(6))?;
    let asked = examined
        .into_iter()
        .filter(|v| valences.contains(&v.n))
        .collect();
    Ok(report(&Findings { asked, regular }))
}

fn report(found: &Findings) -> Report {
    let mut claims = regular::claims(&found.regular);
    claims.extend(limit::claims(found));
    claims.extend(rates::claims(found));
    claims.extend(theorem_4::claims(found));
    claims.extend(table_3::claims(found));
    claims.extend(control::claims(found));
    claims.extend(comparison::claims(found));
    claims.retain(|claim| claim.scope != words::NOWHERE);
    let every = found.asked.iter().chain([&found.regular]);
    let certificates = by_name(every.flat_map(|v| v.certificates.clone()));
    Report {
        id: "huang-wang",
        title: "Bounding the distance between a Loop subdivision surface and its limit mesh",
        source: "Z. Huang, G. Wang. Geometric Modeling and Processing (GMP) 2008",
        preface: vec![
            "All constants are dimensionless: distances over M, the largest mixed second difference of \
             the n + 6 control points of a face with one extraordinary vertex of valence n, weights of \
             Loop 1987."
                .into(),
            "Printed: as in the paper; a decimal of p digits stands for every number within half a unit \
             of its last digit. Redone: the paper's own method in exact or interval arithmetic. Sharp: \
             the supremum itself, proved from both sides. A decimal without brackets is certain in all \
             its digits."
                .into(),
        ],
        tables: vec![
            rates::table(found),
            control::table(found),
            limit::table(found),
            table_3::table(found),
            comparison::table(found),
        ],
        claims,
        plots: plots::plots(found),
        pictures: Vec::new(),
        certificates,
    }
}
