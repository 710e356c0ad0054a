//! Constants for a range of valences, in parallel.

use std::time::Instant;

use rayon::prelude::*;

use super::constant::{Constant, Proof};
use super::prover::Prover;
use super::rules::Family;
use crate::certificate::Certificate;

/// One constant of one valence.
#[derive(Clone, Debug)]
pub struct Row {
    /// The valence.
    pub n: u32,
    /// Which constant.
    pub constant: Constant,
    /// The proof; `None` if none was found.
    pub proof: Option<Proof>,
    /// The constant in closed form, where both sides meet: an element of Q(2 cos 2π/n) as text.
    pub exact: Option<String>,
    /// The certificate, if asked for.
    pub certificate: Option<Certificate>,
    /// Time taken.
    pub seconds: f64,
}

/// Encloses the constants for the valences, each within the relative gap; rows in the order of
/// valences, then of constants. The result does not depend on the number of threads: a valence is
/// one sequential piece of work.
///
/// `tell` hears how many valences are done.
pub fn tabulate(
    family: impl Into<Family>,
    valences: &[u32],
    constants: &[Constant],
    gap: f64,
    certify: bool,
    tell: &(dyn Fn(u32, u32) + Sync),
) -> Vec<Row> {
    let family = family.into();
    let done = std::sync::atomic::AtomicU32::new(0);
    let one = |&n: &u32| -> Vec<Row> {
        let mut prover = Prover::new(family, n);
        let rows = constants.iter().map(|&constant| {
            let start = Instant::now();
            let proof = prover.prove(constant, gap);
            let closed = proof.as_ref().and_then(|proof| prover.closed_form(proof));
            Row {
                n,
                constant,
                exact: closed.map(|value| value.to_string()),
                certificate: (proof.as_ref())
                    .filter(|_| certify)
                    .map(|proof| prover.certificate(proof)),
                proof,
                seconds: start.elapsed().as_secs_f64(),
            }
        });
        let rows = rows.collect();
        let count = done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1;
        tell(count, valences.len() as u32);
        rows
    };
    // Large valences take longest: they go first, the order is restored after.
    let mut order: Vec<usize> = (0..valences.len()).collect();
    order.sort_by_key(|&i| std::cmp::Reverse(valences[i]));
    let mut blocks: Vec<(usize, Vec<Row>)> = (order.par_iter().with_max_len(1))
        .map(|&i| (i, one(&valences[i])))
        .collect();
    blocks.sort_by_key(|(i, _)| *i);
    blocks.into_iter().flat_map(|(_, rows)| rows).collect()
}
