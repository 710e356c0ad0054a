//! The distances of eigensplines to their meshes, ring by ring: section 9 of FORMAT.md.

mod case;
mod near;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

use crate::claim::Eigensplines;
use crate::complex::Complex;
use crate::eigen::{Angles, Mode};
use crate::embedding::{Quarters, check_loop, quarters};
use crate::file::{File, Number, Rings, Step};
use crate::fixed::Fixed;
use crate::patch::Patch;
use crate::piece::{Across, Facet, Scene, Spline, heights, value};
use crate::rational::decimal;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::scheme::Mesh;
use crate::sector::{Lattice, Quartic, Triangle, across, around, corners, ring, ring_zero};

use case::Case;

/// How often a part of a spline may be looked at.
const WORK: u64 = 1 << 24;
const RULE: Rule = Rule::Rings;

/// An eigenspline in one sector.
struct Track {
    case: usize,
    sector: usize,
    /// The lattice of the level, and those of levels 0 and 1.
    now: Lattice,
    first: [Lattice; 2],
    /// The f of a generalised mode, of level 1.
    chain: Option<Lattice>,
}

struct Check<'a> {
    cases: Vec<Case<'a>>,
    tracks: Vec<Track>,
    /// The characteristic map, as the tracks.
    chi: Track,
    lambda: Fixed,
    against: Mesh,
    quarters: Quarters,
    /// Why a case fails, if it does.
    failed: Vec<Option<String>>,
    work: u64,
}

/// Shows the enclosures of the distances.
///
/// # Errors
///
/// If and only if one is not shown: rule `rings`; `claim` for one with lo > hi; `embedding` if the characteristic map
/// is not shown to be one; `format`, `bases`, `cosine` if the file is not one for this claim.
pub fn check(file: &File, claim: &Eigensplines) -> Outcome<()> {
    ensure!(file.bases.is_empty(), Rule::Bases, "eigensplines have no bases");
    let wrong = |why: &str| Rejection::new(Rule::Format, why);
    let one_each = file.steps.len() == claim.modes.len() && !claim.modes.is_empty();
    ensure!(one_each, Rule::Format, "the steps are not one for each mode");
    let angles = Angles::new(file, claim.valence)?;
    let mut cases: Vec<Case> = Vec::new();
    for (i, (mode, step)) in claim.modes.iter().zip(&file.steps).enumerate() {
        let Step::Rings(step) = step else { return Err(wrong("a step is not \"rings\"")) };
        let once = |other: &Case| {
            other.claim.family != mode.family || other.claim.frequency != mode.frequency
        };
        ensure!(cases.iter().all(once), Rule::Format, "mode {i} is there already");
        let found = angles.mode(claim.weights, mode.family, mode.frequency);
        let found = found.ok_or_else(|| wrong("there is no such mode"))?;
        let case = Case { claim: mode, step, mode: found, chain: None };
        cases.push(case.checked(i, &cases)?);
    }
    check_loop(claim.valence, &angles)?;
    Check::new(claim, cases, angles.ring(1)).check()
}

/// `x^r`.
fn power(x: Fixed, r: usize) -> Fixed {
    (0..r).fold(Fixed::ONE, |product, _| product * x)
}

fn number(x: &Number) -> Fixed {
    Fixed::of(&x.0)
}

impl Track {
    fn new(case: usize, sector: usize, mode: &Mode) -> Self {
        let zero = Lattice::first(mode, sector);
        let one = zero.next(mode.lambda, 4);
        let chain = mode.chain.as_ref();
        let chain = chain.map(|(_, f)| Lattice::first(f, sector).next(f.lambda, 4));
        Self { case, sector, now: one.clone(), first: [zero, one], chain }
    }
}

/// The patches of a scene are those of level max(s, 1), its facets those of level s; near the centre there is one.
#[derive(Clone, Copy)]
enum Place {
    Ring { level: usize, triangle: Triangle },
    Near,
}

impl<'a> Check<'a> {
    fn new(claim: &Eigensplines, cases: Vec<Case<'a>>, chi: Mode) -> Self {
        let sectors = |(i, case): (usize, &Case)| {
            (0..case.sectors()).map(|j| Track::new(i, j, &case.mode)).collect::<Vec<_>>()
        };
        let tracks = cases.iter().enumerate().flat_map(sectors).collect();
        let (failed, lambda) = (vec![None; cases.len()], chi.lambda);
        let chi = Track::new(0, 0, &chi);
        let (against, quarters) = (claim.against, quarters(Patch::Triangle));
        Self { cases, tracks, chi, lambda, against, quarters, failed, work: 0 }
    }

    fn check(mut self) -> Outcome<()> {
        let most = self.cases.iter().map(|case| case.step.rings.len()).max().unwrap_or(0);
        for level in 0..most {
            if level > 1 {
                let radius = (1 << level) + 2;
                for track in &mut self.tracks {
                    let case = &self.cases[track.case];
                    if level < case.step.rings.len() {
                        track.now = track.now.next(case.mode.lambda, radius);
                    }
                }
                self.chi.now = self.chi.now.next(self.lambda, radius);
            }
            self.check_level(level)?;
        }
        self.check_near()?;
        for i in 0..self.cases.len() {
            let shown = match self.failed[i].take() {
                Some(why) => Err(Rejection::new(RULE, why)),
                None => self.conclude(i),
            };
            shown.map_err(|rejection| Rejection { step: Some(i), ..rejection })?;
        }
        Ok(())
    }

    /// The lattice that facets of a level have, by what they are.
    fn mesh(&self, lattice: &Lattice) -> Lattice {
        if self.against == Mesh::Limit { lattice.limits() } else { lattice.clone() }
    }

    /// The tracks that a part of the surface matters for: those that have not failed.
    fn active(&self, wanted: impl Fn(&Case, &Track) -> bool) -> Vec<usize> {
        let wanted = |i: &usize| {
            let track = &self.tracks[*i];
            self.failed[track.case].is_none() && wanted(&self.cases[track.case], track)
        };
        (0..self.tracks.len()).filter(wanted).collect()
    }

    fn fail(&mut self, case: usize, why: String) {
        self.failed[case].get_or_insert(why);
    }

    /// The scene of a place for some tracks with their bounds; meshes are those of chi and of all tracks.
    fn scene(
        &self,
        place: Place,
        tracks: &[usize],
        bounds: Vec<Fixed>,
        meshes: &Meshes,
    ) -> Scene<'_> {
        let radius = if self.against == Mesh::Limit { 2 } else { 3 };
        let (list, bits) = match place {
            Place::Near => (vec![[0, 0, 0]], 0),
            Place::Ring { level: 0, .. } => (ring(0, radius), 0),
            Place::Ring { level, triangle } => (around(triangle), level as u32),
        };
        let large = |z: Complex| z.map(|x| x.doubled(bits));
        let facet = |triangle: &Triangle| {
            let next = [0, 1, 2].map(|corner| match across(*triangle, corner) {
                None => Across::Ray,
                Some(next) => list
                    .iter()
                    .position(|other| *other == next)
                    .map_or(Across::Other, Across::Facet),
            });
            Facet::new(corners(*triangle).map(|place| large(meshes.chi.at(place))), next)
        };
        let over = |track: &usize| {
            let mesh = &meshes.tracks[*track];
            let at = |triangle: &Triangle| {
                let mesh = mesh.as_ref();
                let point = |place| mesh.map_or(Complex::WHOLE, |mesh| mesh.at(place));
                heights(corners(*triangle).map(|place| large(point(place))))
            };
            list.iter().map(at).collect()
        };
        Scene {
            facets: list.iter().map(facet).collect(),
            heights: tracks.iter().map(over).collect(),
            bounds: bounds.into_iter().map(|bound| bound.doubled(bits)).collect(),
            alone: matches!(place, Place::Near),
            quarters: &self.quarters,
            failed: Vec::new(),
            work: 0,
        }
    }

    fn spend(&mut self, work: u64) -> Outcome<()> {
        self.work += work;
        ensure!(self.work <= WORK, Rule::Format, "more than {WORK} parts are to be looked at");
        Ok(())
    }

    /// lo <= D_s <= hi for all cases.
    fn check_level(&mut self, level: usize) -> Outcome<()> {
        let deep = |case: &Case| level < case.step.rings.len();
        let mesh = |track: &Track| {
            let lattice = if level == 0 { &track.first[0] } else { &track.now };
            self.mesh(lattice)
        };
        let tracks =
            self.tracks.iter().map(|track| deep(&self.cases[track.case]).then(|| mesh(track)));
        let meshes = Meshes { chi: mesh(&self.chi), tracks: tracks.collect() };
        let large = |net: Quartic| net.map(|z| z.map(|x| x.doubled(level as u32)));
        for (i, case) in self.cases.iter().enumerate().filter(|(_, case)| deep(case)) {
            if !self.is_reached(i, case, level, &meshes) {
                let lo = decimal(&case.step.rings[level].lo.0, 10);
                self.failed[i]
                    .get_or_insert(format!("ring {level}: lo = {lo} is not shown to be reached"));
            }
        }
        for triangle in ring_zero(level.max(1)) {
            let [p, q, _] = triangle;
            let tracks =
                self.active(|case, _| deep(case) && (p >= q || case.claim.frequency.is_none()));
            if tracks.is_empty() {
                continue;
            }
            let case = |track: &usize| &self.cases[self.tracks[*track].case];
            let bounds = tracks.iter().map(|t| number(&case(t).step.rings[level].hi)).collect();
            let mut scene = self.scene(Place::Ring { level, triangle }, &tracks, bounds, &meshes);
            let spline = |(i, t): (usize, &usize)| (i, large(self.tracks[*t].now.patch(triangle)));
            let splines: Vec<Spline> = tracks.iter().enumerate().map(spline).collect();
            scene.show(&large(self.chi.now.patch(triangle)), &splines, 0);
            let (failed, work) = (std::mem::take(&mut scene.failed), scene.work);
            drop(scene);
            for i in failed {
                let case = self.tracks[tracks[i]].case;
                let (hi, sector) =
                    (&self.cases[case].step.rings[level].hi.0, self.tracks[tracks[i]].sector);
                let hi = decimal(hi, 10);
                self.fail(case, format!("ring {level}: sector {sector}, triangle {triangle:?} is not shown to stay below hi = {hi}"));
            }
            self.spend(work)?;
        }
        Ok(())
    }

    /// The point of a ring is shown to be as far away as lo.
    fn is_reached(&self, i: usize, case: &Case, level: usize, meshes: &Meshes) -> bool {
        let ring = &case.step.rings[level];
        let (triangle, point) = (ring.at.triangle, [&ring.at.point.0.0, &ring.at.point.1.0]);
        let track = case.sector(ring.at.sector).and_then(|sector| self.track(i, sector));
        let Some(track) = track.filter(|_| is_point(level.max(1), triangle, point)) else {
            return false;
        };
        let scene =
            self.scene(Place::Ring { level, triangle }, &[track], vec![number(&ring.lo)], meshes);
        let at = |lattice: &Lattice| {
            let value = value(&lattice.patch(triangle), point.map(Fixed::of));
            value.map(|x| x.doubled(level as u32))
        };
        scene.reaches(0, at(&self.chi.now), at(&self.tracks[track].now))
    }

    /// The number of the track of a case in a sector.
    fn track(&self, case: usize, sector: usize) -> Option<usize> {
        self.tracks.iter().position(|track| track.case == case && track.sector == sector)
    }

    /// The enclosures of the claim follow from those of D_0, .., D_M and N.
    fn conclude(&self, i: usize) -> Outcome<()> {
        let case = &self.cases[i];
        let unknown = || Rejection::new(RULE, "the eigenvalue is not known");
        let [least, most] = case.mode.lambda.ends().ok_or_else(unknown)?;
        ensure!(least.is_positive(), RULE, "the eigenvalue is not shown to be positive");
        let zero = BigRational::zero;
        let kappa = match &case.mode.chain {
            Some((kappa, _)) => {
                let ends = kappa.ends().ok_or_else(unknown)?;
                ends.iter().map(BigRational::abs).max().unwrap_or_else(zero)
            }
            None => zero(),
        };
        // r lambda^(r-1) |kappa| times the hi of f.
        let other = |r: usize, f: &dyn Fn(&Rings) -> BigRational| match case.chain {
            Some(chain) if r > 0 => {
                let factor = pow(most.clone(), r - 1) * &kappa * BigInt::from(r);
                factor * f(self.cases[chain].step)
            }
            _ => zero(),
        };
        for (m, (Number(lo), Number(hi))) in case.claim.distances.iter().enumerate() {
            let mut reached = zero();
            let mut compare = |r: usize, low: &Number, high: &Number, other: BigRational| {
                let bound = pow(most.clone(), r) * &high.0 + &other;
                reached = (pow(least.clone(), r) * &low.0 - other).max(reached.clone());
                let (x, y) = (decimal(&bound, 12), decimal(hi, 12));
                ensure!(bound <= *hi, RULE, "level {m}: {x}, from ring {r}, is not at most {y}");
                Ok(())
            };
            for r in 0..=m {
                let (ring, s) = (&case.step.rings[m - r], m - r);
                compare(r, &ring.lo, &ring.hi, other(r, &|f| f.rings[s].hi.0.clone()))?;
            }
            let near = &case.step.near;
            compare(m, &near.lo, &near.hi, other(m, &|f| f.near.hi.0.clone()))?;
            let (x, y) = (decimal(&reached, 12), decimal(lo, 12));
            ensure!(*lo <= reached, RULE, "level {m}: the largest value, {x}, is not at least {y}");
        }
        Ok(())
    }
}

/// Facets' vertices of a level: those of chi and of each track.
struct Meshes {
    chi: Lattice,
    tracks: Vec<Option<Lattice>>,
}

/// A point of a patch of ring 0 of a level.
fn is_point(level: usize, triangle: Triangle, [v, w]: [&BigRational; 2]) -> bool {
    let within = !v.is_negative() && !w.is_negative() && v + w <= BigRational::one();
    let [p, q, t] = triangle;
    let side = 0..1 << level;
    let small = side.contains(&p) && side.contains(&q) && (t == 0 || t == 1);
    let radii = || corners(triangle).map(|[p, q]| p + q);
    within && small && radii().iter().all(|r| (1 << (level - 1)..=1 << level).contains(r))
}
