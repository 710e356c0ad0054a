//! The distance of the centre of every level to the surface: section 9 of FORMAT.md.

use crate::claim::{CentreDistance, Family};
use crate::eigen::Angles;
use crate::file::{File, Step};
use crate::fixed::Fixed;
use crate::rational::decimal;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::sector::{Lattice, ring_zero};

/// Shows that the third coordinate is at most 0 on the surface.
///
/// # Errors
///
/// If and only if this is not shown: rule `sign`; `format`, `bases`, `cosine` if the file is not one for this claim.
pub fn check(file: &File, claim: &CentreDistance) -> Outcome<()> {
    ensure!(file.bases.is_empty(), Rule::Bases, "the distance of a centre has no bases");
    let [Step::Sign(_)] = &file.steps[..] else {
        return Err(Rejection::new(Rule::Format, "the one step is \"sign\""));
    };
    let rule = Rule::Sign;
    let angles = Angles::new(file, claim.valence)?;
    let mode = angles.mode(claim.weights, Family::Ring, Some(0));
    let mode = mode.ok_or_else(|| Rejection::new(rule, "no such mode"))?;
    let between = mode.lambda.is_positive() && mode.lambda.below(Fixed::ONE);
    ensure!(between, rule, "the eigenvalue is not shown to be between 0 and 1");
    let level = Lattice::first(&mode, 0).next(mode.lambda, 3);
    for triangle in ring_zero(1) {
        // The mode has a_j = 1: the third coordinate is its negative.
        for (i, e) in level.patch(triangle).iter().enumerate() {
            let z = decimal(&(-e.re).near(), 10);
            let why = "is not shown to be at most 0";
            let above = e.re.is_at_least_zero();
            ensure!(above, rule, "triangle {triangle:?}: coefficient {i}, near {z}, {why}");
        }
    }
    Ok(())
}
