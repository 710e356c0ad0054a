//! Checks certificates for Loop's, Catmull-Clark's and Doo-Sabin's schemes: an independent reading of
//! `proofs/FORMAT.md`.
//!
//! Integers and rationals only; the masks, nets and forms are rebuilt from the claim. The verdict by default is
//! rejection: [`check`] ends in `Ok` in one place, after every step has been checked.
//!
//! | file | section of FORMAT.md |
//! |---|---|
//! | `file`, `claim`, `words`, `rational`, `reject` | 3: the file; the claim, in words; numbers; the names of the rules |
//! | `scalar`, `ring`, `cosine` | 2, 8: coefficients, their enclosures, what these decide |
//! | `scheme`: `loop_scheme`, `lattice`, `catmull_clark`, `doo_sabin` | 1, 8: a scheme's masks and differences |
//! | `space`, `patch`, `word`, `form`, `net`, `target` | 1, 8: the claim's setting, Bernstein forms, words, nets, targets |
//! | `basis` | 3: bases, multipliers, weights |
//! | `proof`, `region`, `cells`, `covering` | 4: the rules |
//! | `inequality`, `violation`, `mesh` | 7: inequalities that hold, and violated ones |
//! | `fixed`, `complex`, `eigen`, `sector`, `piece`, `tilt` | 9: intervals on a fixed grid; eigenvectors of the two-ring; their lattices and pieces of surface |
//! | `embedding`, `centre`, `eigensplines` | 9: the rules |

#![forbid(unsafe_code)]

use std::panic::catch_unwind;

mod basis;
mod catmull_clark;
mod cells;
mod centre;
mod claim;
mod complex;
mod cosine;
mod covering;
mod doo_sabin;
mod eigen;
mod eigensplines;
mod embedding;
mod file;
mod fixed;
mod form;
mod inequality;
mod lattice;
mod loop_scheme;
mod mesh;
mod net;
mod patch;
mod piece;
mod proof;
mod rational;
mod region;
pub mod reject;
mod ring;
mod scalar;
mod scheme;
mod sector;
mod space;
mod spline_words;
mod target;
mod tilt;
mod violation;
mod word;
mod words;

use claim::Claim;
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
        Ok(file) => Verdict { claim: Some(words::in_words(&file)), outcome: prove(&file) },
        Err(rejection) => rejection.into(),
    }
}

fn prove(file: &file::File) -> Outcome<()> {
    match &file.claim {
        Claim::Constant(claim) => {
            let space = space::Space::new(&claim.setting(), claim.norm, file.cosine.as_ref())?;
            proof::Proof::new(file, claim, &space)?.check()
        }
        Claim::Inequality(claim) => inequality::check(file, claim),
        Claim::Violation(claim) => violation::check(file, claim),
        Claim::MeshViolation(claim) => mesh::check(file, claim),
        Claim::CharacteristicMap(claim) => embedding::check(file, claim),
        Claim::CentreDistance(claim) => centre::check(file, claim),
        Claim::Eigensplines(claim) => eigensplines::check(file, claim),
    }
}
