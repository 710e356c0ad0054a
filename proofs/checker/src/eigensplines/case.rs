//! A mode of a claim with its numbers.

use num_traits::Signed;

use super::{RULE, power};
use crate::claim::{Family, ModeClaim};
use crate::eigen::Mode;
use crate::file::{Number, Rings};
use crate::fixed::Fixed;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::sector::Quartic;

/// The largest M.
const LEVELS: usize = 8;
/// The most rings that are looked at one by one.
pub const DEPTH: usize = 60;
/// An eigenspline with what is claimed and how it is shown.
pub struct Case<'a> {
    pub claim: &'a ModeClaim,
    pub step: &'a Rings,
    pub mode: Mode,
    /// The number of the mode f, for a generalised one.
    pub chain: Option<usize>,
}

impl<'a> Case<'a> {
    /// Checks the numbers of a mode, and finds its chain.
    pub fn checked(mut self, i: usize, earlier: &[Case]) -> Outcome<Self> {
        let (claim, step) = (self.claim, self.step);
        let at = |rejection: Rejection| Rejection { step: Some(i), ..rejection };
        let count = claim.distances.len();
        ensure!((1..=LEVELS + 1).contains(&count), Rule::Format, "more than {LEVELS} levels");
        ensure!(step.near.depth <= DEPTH, Rule::Format, "the depth is above {DEPTH}");
        let numbers = claim.distances.iter().map(|(lo, hi)| (lo, hi));
        for (Number(lo), Number(hi)) in numbers {
            ensure!(!lo.is_negative() && lo <= hi, Rule::Claim, "mode {i}: not 0 <= lo <= hi");
        }
        let rings = step.rings.iter().map(|ring| (&ring.lo, &ring.hi));
        let ordered = rings.chain([(&step.near.lo, &step.near.hi)]);
        let ordered = ordered.into_iter().all(|(lo, hi)| !lo.0.is_negative() && lo.0 <= hi.0);
        let why = "not 0 <= lo <= hi";
        if !ordered {
            return Err(at(Rejection::new(RULE, why)));
        }
        if step.rings.len() != count {
            return Err(at(Rejection::new(RULE, "not one ring for each level")));
        }
        if self.mode.chain.is_some() {
            let is_ray = |case: &Case| {
                case.claim.family == Family::Ray
                    && case.claim.frequency == Some(0)
                    && case.step.rings.len() >= count
            };
            self.chain = earlier.iter().position(is_ray);
            if self.chain.is_none() {
                let why = "the mode \"ray\" 0 with as many levels does not come earlier";
                return Err(at(Rejection::new(RULE, why)));
            }
        }
        Ok(self)
    }

    /// The sectors whose values differ.
    pub fn sectors(&self) -> usize {
        if self.claim.family == Family::Between { 2 } else { 1 }
    }

    /// The sector with the same magnitudes as that of a point, if it is known.
    pub fn sector(&self, given: usize) -> Option<usize> {
        let turned = self.claim.frequency.is_some() && given < self.mode.a.len();
        if turned { Some(0) } else { (given < self.sectors()).then_some(given) }
    }

    /// The coefficients over ring r, from those over ring 0 and those of f.
    pub fn over_ring(&self, r: usize, e: &Quartic, f: Option<&Quartic>) -> Quartic {
        let share = power(self.mode.lambda, r);
        let other = self.mode.chain.as_ref().map_or(Fixed::ZERO, |(kappa, _)| {
            power(self.mode.lambda, r - 1) * *kappa * Fixed::ratio(r as i64, 1)
        });
        std::array::from_fn(|i| f.map_or(e[i] * share, |f| e[i] * share + f[i] * other))
    }
}
