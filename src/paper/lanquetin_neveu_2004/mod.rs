//! S. Lanquetin, M. Neveu: A priori computation of the number of surface subdivision levels.
//! GraphiCon 2004.
//!
//! | claims | file | decided by |
//! |---|---|---|
//! | Theorems 1, 4, Corollaries 1, 4, (9) | `curves.rs` | exact linear programs |
//! | (1)-(3), Theorem 2, Corollary 2 | `catmull_clark_masks.rs`, `catmull_clark.rs` | eigenvectors, exact linear programs |
//! | (4), (5), 5/8 - nβ | `loop_masks.rs` | identities in Q(cos 2π/n) |
//! | Theorem 3, Corollary 3 at n = 6 | `theorem_3.rs`, `smallest.rs`, `meshes.rs`, `lengths.rs` | closed meshes, exact squares |
//! | the same by valence | `valences.rs`, `extremal.rs` | intervals; nets without displacements |
//! | no constant saves it | `tori.rs` | a proof, and exact nets on tori |
//! | what is true instead | `remedy.rs` | C_k(n), with certificates |
//! | Theorem 5, its proof, Corollary 5 | `doo_sabin.rs` | exact linear programs, nets |
//! | Tables 1-3, box, spinning top | `tables.rs` | the M_0 that would give the print |
//! | their method on other meshes | `needed.rs`, `depth.rs` | certified distances |
//! | farthest points, valences, faces | `heuristics.rs` | nets; topology |
//!
//! Printed numbers are in [`printed`]; everything else is computed by [`examine`].

mod catmull_clark;
mod catmull_clark_masks;
mod curves;
pub mod depth;
mod doo_sabin;
pub mod extremal;
mod heuristics;
pub mod lengths;
mod loop_masks;
pub mod meshes;
pub mod needed;
mod nets;
mod plots;
pub mod printed;
mod proofs;
mod remedy;
pub mod smallest;
mod tables;
pub mod theorem_3;
pub mod tori;
pub mod valences;

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use super::Report;
use super::proof::{by_name, cite};
use remedy::Constants;
use valences::ValenceFindings;

/// Judges every claim of the paper; what is said of valences, for the given ones, all at least 3.
///
/// The result does not depend on the number of threads. `tell` hears how many valences of how many
/// are done.
///
/// ```no_run
/// use subcert::paper::Verdict;
/// let report = subcert::paper::lanquetin_neveu_2004::examine(&[3, 4, 5, 6], &|_, _| ());
/// assert_eq!(report.claim("theorem-3-recurrence").unwrap().verdict, Verdict::Refuted);
/// ```
pub fn examine(asked: &[u32], tell: &(dyn Fn(u32, u32) + Sync)) -> Report {
    let mut all: Vec<u32> = asked.to_vec();
    all.sort_unstable();
    all.dedup();
    let done = AtomicU32::new(0);
    let one = |&n: &u32| {
        let found = (ValenceFindings::of(n), Constants::of(n));
        tell(done.fetch_add(1, Ordering::Relaxed) + 1, all.len() as u32);
        found
    };
    let each: Vec<_> = all.par_iter().with_max_len(1).map(one).collect();
    let (by_valence, constants): (Vec<_>, Vec<_>) = each.into_iter().unzip();
    let by_valence: Vec<ValenceFindings> = by_valence.into_iter().flatten().collect();
    let constants: Vec<Constants> = constants.into_iter().flatten().collect();
    report(&all, &by_valence, &constants)
}

fn report(asked: &[u32], by_valence: &[ValenceFindings], constants: &[Constants]) -> Report {
    let examined = theorem_3::examine();
    let members = tori::members();
    let depths = needed::examine();
    let mut claims = loop_masks::claims(asked);
    let mut certificates = Vec::new();
    claims.extend(curves::claims());
    for (more, files) in [
        catmull_clark::claims(asked),
        theorem_3::claims(&examined),
        valences::claims(by_valence),
        remedy::claims(constants),
        doo_sabin::claims(asked),
        heuristics::claims(),
    ] {
        claims.extend(more);
        certificates.extend(files);
    }
    claims.extend(tori::claims(&members));
    claims.extend(needed::claims(&depths));
    claims.extend(tables::claims());
    let constants_of_quads = proofs::of(asked);
    cite(&constants_of_quads, &mut claims);
    certificates.extend(constants_of_quads.into_iter().map(|proof| proof.named));
    Report {
        id: "lanquetin-neveu",
        title: "A priori computation of the number of surface subdivision levels",
        source: "S. Lanquetin, M. Neveu. GraphiCon 2004",
        preface: vec![
            "M_k of Theorem 3 is the largest distance of a control vertex of level k from its limit position; \
             elsewhere M_k is the largest second difference along lines of the mesh. Weights of Loop 1987, \
             nβ the sum of the weights of a ring."
                .into(),
            "Distances are those at the same parameter. Ratios are dimensionless; a decimal without brackets \
             is certain in all its digits. The paper's models are not public: its tables are compared with \
             themselves, and its method is tried on other meshes."
                .into(),
        ],
        tables: vec![
            theorem_3::table(&examined),
            smallest::table(),
            valences::table(by_valence),
            tori::table(&members),
            remedy::table(constants),
            needed::table(&depths),
            tables::table(),
        ],
        claims,
        plots: plots::plots(by_valence, &members),
        pictures: Vec::new(),
        certificates: by_name(certificates),
    }
}
