//! F. Cheng, J. Yong: Subdivision depth computation and adaptive subdivision of Catmull-Clark subdivision
//! surfaces.
//!
//! | claims | file | decided by |
//! |---|---|---|
//! | (1)-(3), Lemmas 1 and 2 | `regular.rs` | Bernstein coefficients, exact linear programs |
//! | (4)-(7), (36)-(40), Lemma 3, Theorem 4 | `appendix_a.rs` | identities, linear programs, one net |
//! | (8)-(15), the Markov chain, Δ | `matrix.rs` | exact matrices |
//! | (13), (16)-(20), Lemma 5 | `first_order.rs` | linear programs over G, three levels |
//! | (21)-(23), Theorem 6 | `theorem_6.rs` | the same |
//! | (45)-(52), Appendix C | `appendix_c.rs`, `estimates.rs` | each identity, each inequality a linear program |
//! | (24)-(28), Lemma 7 | `second_order.rs` | linear programs over Z, three levels |
//! | (29)-(33), Lemma 8, Theorem 9 | `theorem_9.rs` | the same |
//! | Appendix D | `appendix_d.rs`, `appendix_d_sums.rs` | identities, linear programs |
//! | section 4 | `examples.rs` | the printed numbers against each other and the formulas |
//! | section 5 | `conclusion.rs` | the rates, and those of Loop's scheme |
//! | (7), (23), (31)-(33) as functions | [`depth`] | exact ceilings |
//!
//! What holds has certificates from `proofs.rs`, what fails from `violation.rs`. Printed numbers are in [`printed`]; everything else is computed by [`examine`]. Suprema over norms of nets come
//! from one place, [`norm`]. The text at hand is scanned and lacks Appendix B and (41)-(44).

mod appendix_a;
mod appendix_c;
mod appendix_d;
mod appendix_d_sums;
mod conclusion;
pub mod depth;
mod estimates;
pub mod examples;
pub mod first_order;
pub mod functional;
pub mod matrix;
pub mod norm;
mod plots;
pub mod printed;
mod proofs;
mod regular;
mod second_order;
pub mod setting;
mod theorem_6;
mod theorem_9;
mod violation;
mod wording;

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use super::Report;
use super::proof::{Named, Proof, by_name, cite};
use crate::paper::words::{self, ranges};
use setting::Setting;

/// Everything that is computed for a valence; the claims only compare.
#[derive(Clone, Debug)]
struct Valence {
    n: u32,
    matrix: matrix::Facts,
    first: first_order::Facts,
    c: appendix_c::Facts,
    second: second_order::Facts,
    d: appendix_d::Facts,
    triangles: conclusion::Facts,
    proofs: Vec<Proof>,
}

impl Valence {
    fn examine(n: u32) -> Self {
        let setting = Setting::new(n);
        Valence {
            n,
            matrix: matrix::Facts::of(n),
            first: first_order::Facts::of(&setting),
            c: appendix_c::Facts::of(&setting),
            second: second_order::Facts::of(&setting),
            d: appendix_d::Facts::of(&setting),
            triangles: conclusion::Facts::of(&setting),
            proofs: proofs::of(&setting),
        }
    }

    fn certificates(&self) -> impl Iterator<Item = &Named> {
        let single = [&self.d.certificate, &self.triangles.certificate];
        self.c.certificates().chain(single.into_iter().flatten())
    }
}

/// Judges every claim of the paper for the given valences, all at least 3.
///
/// The result does not depend on the number of threads. `tell` hears how many valences of how many are done.
pub fn examine(valences: &[u32], tell: &(dyn Fn(u32, u32) + Sync)) -> Report {
    let mut all: Vec<u32> = valences.to_vec();
    all.sort_unstable();
    all.dedup();
    all.reverse();
    let done = AtomicU32::new(0);
    // Large valences take longest: they go first.
    let mut found: Vec<Valence> = all
        .par_iter()
        .with_max_len(1)
        .map(|&n| {
            let valence = Valence::examine(n);
            tell(done.fetch_add(1, Ordering::Relaxed) + 1, all.len() as u32);
            valence
        })
        .collect();
    found.reverse();
    report(&found)
}

fn report(found: &[Valence]) -> Report {
    let regular = Setting::new(regular::REGULAR);
    let scope = format!("N = {}", ranges(found.iter().map(|v| v.n)));
    let matrices: Vec<_> = found.iter().map(|v| &v.matrix).collect();
    let first: Vec<_> = found.iter().map(|v| &v.first).collect();
    let c: Vec<_> = found.iter().map(|v| &v.c).collect();
    let d: Vec<_> = found.iter().map(|v| &v.d).collect();
    let mut claims = regular::claims(&regular);
    claims.extend(appendix_a::claims(&regular));
    claims.extend(matrix::claims(&matrices, &scope));
    claims.extend(first_order::claims(&first, &scope));
    claims.extend(theorem_6::claims(&first));
    let appendix_c = appendix_c::claims(&c, &first);
    let table_c = appendix_c::table(&c, &appendix_c);
    claims.extend(appendix_c);
    claims.extend(second_order::claims(found, &scope));
    claims.extend(theorem_9::claims(found));
    claims.extend(appendix_d::claims(&d, &scope));
    claims.extend(examples::claims());
    claims.extend(conclusion::claims(found, &scope));
    claims.retain(|claim| claim.scope != words::NOWHERE);
    let mut held = proofs::of_regular();
    held.extend(found.iter().flat_map(|v| v.proofs.iter().cloned()));
    cite(&held, &mut claims);
    let violated = found.iter().flat_map(|v| v.certificates().cloned());
    let held = held.into_iter().map(|proof| proof.named);
    let certificates = by_name(violated.chain(held));
    Report {
        id: "cheng-yong",
        title: "Subdivision depth computation and adaptive subdivision of Catmull-Clark subdivision surfaces",
        source: "F. Cheng, J. Yong. Online ID 0041",
        preface: vec![
            "N is the valence of V_1 in Stam's numbering of the 2N + 8 points. G_i is the largest distance of the points \
             of Φ_i from its centre, G the largest of the four; Z_0 the largest of the 2N + 10 second differences, Z_3 \
             that of the sixteen of Π_3. All constants are dimensionless suprema over all nets, from exact linear \
             programs: a net attains each."
                .into(),
            "Printed: as in the text at hand, which is scanned; it lacks Appendix B and (41)-(44). A formula is judged \
             as it stands there, and the algebra is done anew. The paper prints nothing for N = 4, which is regular."
                .into(),
            examples::UNAVAILABLE.into(),
        ],
        tables: vec![first_order::table(&first), first_order::table_by_set(&first), table_c, second_order::table(found)],
        claims,
        plots: plots::plots(found),
        pictures: Vec::new(),
        certificates,
    }
}
