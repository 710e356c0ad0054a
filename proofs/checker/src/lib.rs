//! Checks certificates for Loop's constants: an independent reading of `proofs/FORMAT.md`.
//!
//! Integers and rationals only; the masks, nets and forms are rebuilt from the claim. The verdict by default is
//! rejection: [`check`] ends in `Ok` in one place, after every step has been checked.
//!
//! | file | section of FORMAT.md |
//! |---|---|
//! | `file`, `rational`, `reject` | 3: the file; numbers; the names of the rules |
//! | `space`, `polynomial`, `cosine` | 2: q, beta and its enclosure, what it decides |
//! | `net`, `word`, `form`, `target` | 1: nets, refinement, tiles, words, the surface, targets |
//! | `basis` | 3: bases, multipliers, weights |
//! | `proof`, `region`, `cells`, `covering` | 4: the rules |

#![forbid(unsafe_code)]

use std::panic::catch_unwind;

mod basis;
mod cells;
mod claim;
mod cosine;
mod covering;
mod file;
mod form;
mod net;
mod polynomial;
mod proof;
mod rational;
mod region;
pub mod reject;
mod space;
mod target;
mod word;

pub use file::BYTES;
use reject::{Outcome, Rejection, Rule};

/// What is found out about a certificate.
#[derive(Debug)]
pub struct Verdict {
    /// The claim in words, if there is one.
    pub claim: Option<String>,
    /// Verified, or why not.
    pub outcome: Outcome<()>,
}

impl From<Rejection> for Verdict {
    fn from(rejection: Rejection) -> Self {
        Self { claim: None, outcome: Err(rejection) }
    }
}

/// Checks a certificate.
pub fn check(bytes: &[u8]) -> Verdict {
    // A panic would be a fault of the checker: it rejects.
    let failed = Rejection::new(Rule::Format, "the checker failed on this file");
    catch_unwind(|| examine(bytes)).unwrap_or(failed.into())
}

fn examine(bytes: &[u8]) -> Verdict {
    match file::read(bytes) {
        Ok(file) => Verdict { claim: Some(claim::in_words(&file.claim)), outcome: prove(&file) },
        Err(rejection) => rejection.into(),
    }
}

fn prove(file: &file::File) -> Outcome<()> {
    let space = space::Space::new(file)?;
    proof::Proof::new(file, &space)?.check()
}
