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
//! | `rules`, `cells`, `covering` | 4: the rules |

#![forbid(unsafe_code)]

use std::panic::{AssertUnwindSafe, catch_unwind};

pub mod basis;
pub mod cells;
pub mod claim;
pub mod cosine;
pub mod covering;
pub mod file;
pub mod form;
pub mod net;
pub mod polynomial;
pub mod rational;
pub mod reject;
pub mod rules;
pub mod space;
pub mod target;
pub mod word;

use reject::{Outcome, Rejection, Rule};

/// What is found out about a certificate.
#[derive(Debug)]
pub struct Verdict {
    /// The claim in words, if there is one.
    pub claim: Option<String>,
    /// Verified, or why not.
    pub outcome: Outcome<()>,
}

/// Checks a certificate.
pub fn check(bytes: &[u8]) -> Verdict {
    let file = match file::read(bytes) {
        Ok(file) => file,
        Err(rejection) => {
            return Verdict {
                claim: None,
                outcome: Err(rejection),
            };
        }
    };
    let claim = claim::in_words(&file.claim);
    // A panic would be a fault of the checker: it rejects.
    let outcome = catch_unwind(AssertUnwindSafe(|| prove(&file)));
    let outcome = outcome.unwrap_or_else(|_| {
        Err(Rejection::new(
            Rule::Format,
            "the checker failed on this file",
        ))
    });
    Verdict {
        claim: Some(claim),
        outcome,
    }
}

fn prove(file: &file::File) -> Outcome<()> {
    let space = space::Space::new(file)?;
    rules::Proof::new(file, &space)?.check()
}
