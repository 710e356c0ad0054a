//! Certificates of constants for the claims that rest on them.

use super::Claim;
use crate::bound::{Constant, Family, Prover};
use crate::certificate::Certificate;

/// Relative gap of constants that are not exact.
const GAP: f64 = 1e-6;

/// The name of a file, and the certificate in it.
pub type Named = (String, Certificate);

/// A certificate and the claims that it supports.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The file's name and its content.
    pub named: Named,
    /// Names of claims.
    pub claims: &'static [&'static str],
}

/// Constants, each with the claims that rest on it.
pub type Wanted<'a> = &'a [(Constant, &'static [&'static str])];

/// The certificates of those constants of a family and valence for which a proof is found.
pub fn constants(family: Family, n: u32, wanted: Wanted<'_>) -> Vec<Proof> {
    let mut prover = Prover::new(family, n);
    let prove = |&(constant, claims): &(Constant, &'static [&'static str])| {
        let proof = prover.prove(constant, GAP)?;
        let certificate = prover.certificate(&proof);
        let named = (certificate.file_name()?, certificate);
        Some(Proof { named, claims })
    };
    wanted.iter().filter_map(prove).collect()
}

/// Adds the names of the files to the claims.
pub fn cite(proofs: &[Proof], claims: &mut [Claim]) {
    for claim in claims {
        let of_claim = proofs
            .iter()
            .filter(|proof| proof.claims.contains(&claim.id));
        let files = of_claim.map(|proof| proof.named.0.clone());
        claim.certificates.extend(files);
    }
}

/// Certificates in the order of their files' names, each once.
pub fn by_name(certificates: impl IntoIterator<Item = Named>) -> Vec<Named> {
    let mut sorted: Vec<Named> = certificates.into_iter().collect();
    sorted.sort_by(|a, b| a.0.cmp(&b.0));
    sorted.dedup_by(|a, b| a.0 == b.0);
    sorted
}
