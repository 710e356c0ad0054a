//! J. Peters, X. Wu: The distance of a subdivision surface to its control polyhedron.
//! Journal of Approximation Theory 2009.
//!
//! | claims | file | decided by |
//! |---|---|---|
//! | eigenvalues, steps, characteristic map | `spectral.rs` | exact spectra |
//! | Definition 2.1, Lemmas 1 to 3, Theorem 1, Corollaries 2, 3 | `theorems.rs` | identities in Q(cos 2π/n) |
//! | Example 1, all m, both weights, both scopes | `example_1.rs` | Bernstein coefficients; certificates |
//! | Figure 5, other saddles | `figure_5.rs`, `saddles.rs`, `picture.rs` | points of the surface, certified; certificates from both sides |
//! | Corollary 1, the tables, `tab-eigen`, `tab-interp` | `estimates.rs` | certified distances of eigensplines |
//! | Table 1 against its definitions, costs | `print.rs` | the printed numbers alone |
//! | (ii) to (iv), observations (1) to (4) | `observations.rs` over `experiment.rs` | the printed table, and the redone one |
//! | Table 1 redone | `redone.rs`, `meshes.rs` | [`crate::predict`], certified Hausdorff distances |
//!
//! Printed numbers are in [`printed`]; everything else is computed by [`examine`].

mod estimates;
pub mod example_1;
pub mod experiment;
pub mod figure_5;
pub mod meshes;
mod observations;
mod picture;
mod plots;
mod print;
pub mod printed;
pub mod redone;
pub mod saddles;
mod spectral;
mod tables;
pub mod theorems;

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use super::Report;
use super::proof::by_name;
use experiment::Experiment;
use meshes::StandIn;
use observations::Source;
use theorems::Found;

/// The deepest level of the table redone, on meshes of up to so many triangles; on larger ones fewer, so that
/// a level has no more than [`FACETS`] facets.
const DEEPEST: u32 = 5;

/// Facets of a level that are measured, at most.
const FACETS: u32 = 1 << 17;

/// Judges every claim of the paper; what is said of valences, for the given ones, all from 3 to 30. Table 1 is
/// redone on the stand-ins ([`meshes::stand_ins`]) and on the given meshes of triangles.
///
/// The result does not depend on the number of threads. `tell` hears how many valences and meshes of how many
/// are done.
///
/// ```no_run
/// use subcert::paper::Verdict;
/// let report = subcert::paper::peters_wu::examine(&[3, 4, 8, 12], &[], &|_, _| ());
/// assert_eq!(report.claim("figure-5").unwrap().verdict, Verdict::True);
/// ```
pub fn examine(asked: &[u32], given: &[StandIn], tell: &(dyn Fn(u32, u32) + Sync)) -> Report {
    let mut all: Vec<u32> = asked.to_vec();
    all.sort_unstable();
    all.dedup();
    let models: Vec<StandIn> = meshes::stand_ins()
        .into_iter()
        .chain(given.iter().cloned())
        .collect();
    let count = (all.len() + models.len()) as u32;
    let done = AtomicU32::new(0);
    let heard = || tell(done.fetch_add(1, Ordering::Relaxed) + 1, count);
    let (found, redone) = rayon::join(
        || -> Vec<Option<Found>> {
            let one = |&n: &u32| {
                let found = Found::of(n);
                heard();
                found
            };
            all.par_iter().with_max_len(1).map(one).collect()
        },
        || -> Vec<redone::Redone> {
            let one = |model: &StandIn| {
                let made = redone::of_mesh(model, deepest(model));
                heard();
                made
            };
            models.par_iter().with_max_len(1).map(one).collect()
        },
    );
    let found: Vec<Found> = found.into_iter().flatten().collect();
    report(&all, &found, &redone)
}

/// The deepest level of a model.
fn deepest(model: &StandIn) -> u32 {
    let triangles = model.mesh.topology.face_count();
    let fits = |m: &u32| u64::from(triangles) << (2 * m) <= u64::from(FACETS);
    (0..=DEEPEST).rev().find(fits).unwrap_or(0)
}

fn report(asked: &[u32], found: &[Found], redone: &[redone::Redone]) -> Report {
    let spectra = spectral::Spectra::of(asked);
    let printed = Experiment::printed();
    let ours = redone::experiment(redone);
    let mut claims = spectra.claims();
    claims.extend(theorems::claims(found));
    let (example, mut certificates) = example_1::claims();
    claims.extend(example);
    let saddles = saddles::all().unwrap_or_default();
    claims.extend(figure_5::claims(&saddles));
    certificates.extend(saddles.into_iter().map(|s| (s.name, s.certificate)));
    claims.extend(estimates::claims(asked, redone, &ours));
    claims.extend(print::claims());
    claims.extend(observations::claims(&printed, Source::Print));
    claims.extend(observations::claims(&ours, Source::Redone));
    Report {
        id: "peters-wu",
        title: "The distance of a subdivision surface to its control polyhedron",
        source: "J. Peters, X. Wu. J. Approx. Theory 2009",
        preface: vec![
            "Loop subdivision with the weights of Loop 1987, if nothing else is said. Distances are one-sided, from \
             the limit surface to the mesh, as the paper measures; ours are certified enclosures, in each mesh's own \
             unit. Estimates are rounded upwards. A decimal without brackets is certain in all its digits."
                .into(),
            "The paper's models are not public: its Table 1 is judged by itself (claims named -printed), and redone on \
             stand-ins and given meshes (-redone). Its tabulated constants are not printed: those here are our own, \
             certified, and may be sharper."
                .into(),
        ],
        tables: tables::tables(&printed, &ours, redone, &spectra),
        claims,
        plots: plots::plots(&printed, &ours),
        pictures: picture::pictures(),
        certificates: by_name(certificates),
    }
}
