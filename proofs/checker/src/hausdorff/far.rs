//! The rule `far`: a point that is at least lo away from the other side.

use num_traits::Zero;

use super::cells::{Piece, walk};
use super::claim::{Far, Hausdorff, Place, Side};
use super::distance::is_far;
use super::facets::Patch;
use super::part::Part;
use super::polygon_mesh::Vector;
use super::refine::Rules;
use super::setting::Setting;
use crate::fixed::Fixed;
use crate::reject::{Outcome, Rejection, Rule, ensure};

const RULE: Rule = Rule::Far;
/// How often a facet, and a face of the surface, may be split.
const FACET_SPLITS: u32 = 10;
const PART_SPLITS: u32 = 12;
/// The most parts that are looked at.
const PARTS: u32 = 1 << 22;

/// Shows that a point of one side is at least lo away from the other.
///
/// # Errors
///
/// If and only if it is not shown, or there is no such point: rule `far`.
pub fn check(setting: &Setting, claim: &Hausdorff, step: &Far) -> Outcome<()> {
    ensure!(step.side != Side::Both && claim.has(step.side), RULE, "not the side of the claim");
    let mut search = Search { rules: &setting.rules, lo: setting.lo, left: PARTS };
    // Nothing is nearer than 0.
    let trivial = claim.lo.0.is_zero();
    let no_point = || Rejection::new(RULE, "no such point");
    match (step.side, &step.at) {
        (Side::SurfaceToMesh, Place::Surface(at)) => {
            let part = setting.part(at.face).ok_or_else(no_point)?;
            let mut limit = None;
            let root = Piece { part, own: None };
            walk(&root, &setting.rules, 0, &[(&at.word.0, 0)], RULE, &mut |piece: &Piece, _| {
                let known = at.corner < piece.part.corners();
                limit = known.then(|| setting.rules.limit(&piece.part.net, at.corner)).flatten();
                Ok(())
            })?;
            let point = limit.ok_or_else(no_point)?;
            for (index, facet) in setting.facets.iter().enumerate() {
                let far = trivial || search.facet(&point, &facet.patch, FACET_SPLITS)?;
                ensure!(far, RULE, "facet {index} is not shown to be as far away");
            }
            Ok(())
        }
        (Side::MeshToSurface, Place::Facet(at)) => {
            let facet = setting.facets.get(at.facet).filter(|facet| setting.counts(facet));
            let [v, w] = &at.at;
            let point = facet.and_then(|facet| facet.patch.point([&v.0, &w.0]));
            let point = point.ok_or_else(no_point)?;
            for face in 0..setting.mesh.faces.len() {
                let Some(part) = setting.part(face) else { continue };
                let far = trivial || search.part(&point, &part, PART_SPLITS)?;
                ensure!(far, RULE, "the surface over face {face} is not shown to be as far away");
            }
            Ok(())
        }
        _ => Err(no_point()),
    }
}

struct Search<'a> {
    rules: &'a Rules,
    lo: Fixed,
    /// How many parts may still be looked at.
    left: u32,
}

impl Search<'_> {
    fn count(&mut self) -> Outcome<()> {
        let none = || Rejection::new(RULE, format!("more than {PARTS} parts to look at"));
        self.left = self.left.checked_sub(1).ok_or_else(none)?;
        Ok(())
    }

    /// True if the facet is shown to be far away, in parts if need be.
    fn facet(&mut self, point: &Vector, patch: &Patch, splits: u32) -> Outcome<bool> {
        self.count()?;
        if is_far(point, patch.corners(), self.lo) {
            return Ok(true);
        }
        if splits == 0 {
            return Ok(false);
        }
        for letter in 0..4 {
            if !self.facet(point, &patch.child(letter), splits - 1)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// True if the surface over the part is shown to be far away, in parts if need be.
    fn part(&mut self, point: &Vector, part: &Part, splits: u32) -> Outcome<bool> {
        self.count()?;
        if is_far(point, &part.hull(self.rules).points, self.lo) {
            return Ok(true);
        }
        if splits == 0 {
            return Ok(false);
        }
        let finer = self.rules.step(&part.net);
        for letter in self.rules.letters(part.corners()) {
            let no_child = || Rejection::new(RULE, "a part without children");
            let child = part.child(&finer, letter).ok_or_else(no_child)?;
            if !self.part(point, &child, splits - 1)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
