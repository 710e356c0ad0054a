//! The steps of a certificate, and all rules but those with cells (those are in `region`).

use std::collections::HashSet;

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::basis::Basis;
use crate::claim::{Constant, Kind};
use crate::covering::text;
use crate::file::{
    Apply, Attained, AttainedTile, Cite, Differences, File, Lemma, Number, Place, Step, Weight,
    Word,
};
use crate::form::Form;
use crate::net::Path;
use crate::rational::decimal;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::scalar::Scalar;
use crate::scheme::Mesh;
use crate::space::Space;
use crate::target::Target;
use crate::word::{is_regular, is_tile, mirrored};

/// The most terms of all bases' programs together, for memory's sake.
const TERMS: u64 = 1 << 24;
/// The most bits of a net's common denominator.
const NET_BITS: u64 = 1 << 16;
const ORDER: &str = "the steps are not one attained, lemmas and one conclusion, in this order";

/// A certificate of a constant with everything that its steps need.
pub struct Proof<'a> {
    file: &'a File,
    pub claim: &'a Constant,
    pub space: &'a Space,
    bases: Vec<Basis>,
    /// What the attained value reaches, times q.
    lower: Scalar,
    /// What the conclusion bounds the constant by, times q.
    pub upper: Scalar,
}

/// The target of a claim other than a rate.
pub fn target(claim: &Constant) -> Target {
    let mesh = if claim.kind == Kind::Control { Mesh::Control } else { Mesh::Limit };
    Target { mesh, level: claim.level }
}

/// True if the claim, a rate, is about the net of this word.
fn names(claim: &Constant, Word(word): &Word) -> bool {
    word.len() == claim.level && (claim.kind == Kind::MeshRate || !is_regular(word))
}

/// The points of a net over their common denominator.
///
/// # Errors
///
/// If and only if there are not as many as the first net has: the rule given; or the denominator is too large.
pub fn numerators(space: &Space, net: &[Number], rule: Rule) -> Outcome<(Vec<BigInt>, BigInt)> {
    ensure!(net.len() == space.size, rule, "{} points, not {}", net.len(), space.size);
    let mut den = BigInt::one();
    for Number(y) in net {
        den = den.lcm(y.denom());
        ensure!(den.bits() <= NET_BITS, Rule::Format, "the net's denominators are too large");
    }
    Ok((net.iter().map(|Number(y)| y.numer() * (&den / y.denom())).collect(), den))
}

/// True for a part of the root with as many letters as the mesh of the claim's level has.
pub fn is_in_mesh(space: &Space, level: usize, word: &[u8]) -> bool {
    let root = space.scheme.root();
    word.len() >= level + root && !is_regular(&word[..root])
}

/// True for a point at which the target of a word is known: any of a regular word, the corner 0 of another.
pub fn is_known(space: &Space, word: &[u8], point: &[BigRational; 2]) -> bool {
    space.patch().contains(point) && (is_regular(word) || point.iter().all(Zero::is_zero))
}

impl<'a> Proof<'a> {
    /// Checks the claim by itself, and the bases.
    ///
    /// # Errors
    ///
    /// If and only if they are not as the format says: rule `claim` or `bases`.
    pub fn new(file: &'a File, claim: &'a Constant, space: &'a Space) -> Outcome<Self> {
        let rule = Rule::Claim;
        let (lo, hi) = (space.q.scale(&claim.lo.0), space.q.scale(&claim.hi.0));
        let exact = claim.exact.as_ref().map(|value| space.value(value));
        space.at_most(&lo, &hi, rule, "lo and hi")?;
        if let Some(exact) = &exact {
            space.at_most(&lo, exact, rule, "lo and exact")?;
            space.at_most(exact, &hi, rule, "exact and hi")?;
        }
        let rate = matches!(claim.kind, Kind::Rate | Kind::MeshRate);
        ensure!(claim.level >= 1 || !rate, rule, "the level of a rate is at least 1");
        ensure!(claim.level == 0 || claim.kind != Kind::Beta, rule, "the level of beta is 0");
        let placed = match &claim.at {
            None => claim.kind != Kind::Coefficient,
            Some(at) => {
                let word = is_regular(&at.word.0) || (space.n == 6 && at.word.0.is_empty());
                claim.kind == Kind::Coefficient && claim.level == 0 && word && at.index < 15
            }
        };
        ensure!(placed, rule, "the kind, the level and \"at\" do not fit");
        let (mut bases, mut terms) = (Vec::new(), 0);
        for (i, list) in file.bases.iter().enumerate() {
            let name =
                |fault: Rejection| Rejection::new(fault.rule, format!("basis {i}: {}", fault.why));
            let basis = Basis::new(space, list).map_err(name)?;
            terms += basis.length();
            ensure!(terms <= TERMS, Rule::Format, "more bases than the checker allows");
            bases.push(basis);
        }
        let (lower, upper) = (exact.clone().unwrap_or(lo), exact.unwrap_or(hi));
        Ok(Self { file, claim, space, bases, lower, upper })
    }

    /// Checks every step: the first attains the lower target, the last proves the upper one.
    ///
    /// # Errors
    ///
    /// If and only if a step fails, or the steps are not those that the claim needs.
    pub fn check(&self) -> Outcome<()> {
        let steps = &self.file.steps;
        ensure!(steps.len() >= 2, Rule::Format, "{ORDER}");
        for (i, step) in steps.iter().enumerate() {
            let checked = self.step(step, i, i + 1 == steps.len());
            checked.map_err(|rejection| Rejection { step: Some(i), ..rejection })?;
        }
        Ok(())
    }

    fn step(&self, step: &Step, i: usize, last: bool) -> Outcome<()> {
        let in_place = match step {
            Step::Attained(_) | Step::AttainedTile(_) => i == 0,
            Step::Lemma(_) => i > 0 && !last,
            _ => last,
        };
        ensure!(in_place, Rule::Format, "{ORDER}");
        match (step, self.claim.kind) {
            (Step::AttainedTile(step), Kind::Beta) => self.attained_tile(step),
            (Step::Attained(step), kind) if kind != Kind::Beta => self.attained(step),
            (Step::Lemma(step), _) => self.lemma(step),
            (Step::Cover(step), Kind::Control | Kind::Limit) => self.cover(step, i, Rule::Cover),
            (Step::Tiles(step), Kind::Beta) => self.cover(step, i, Rule::Tiles),
            (Step::Apply(step), Kind::Control) => self.apply(step, i),
            (Step::Differences(step), Kind::Rate | Kind::MeshRate) => self.differences(step),
            (Step::Weight(step), Kind::Coefficient) => self.weight_of_coefficient(step),
            _ => Err(Rejection::new(Rule::Claim, "the step is not one for the claim's kind")),
        }
    }

    /// The weight (times q) of a form (times q) in a basis.
    pub fn weight(&self, cite: Cite, form: &Form) -> Outcome<Scalar> {
        let missing = || Rejection::new(Rule::Bases, format!("there is no basis {cite}"));
        self.bases.get(cite).ok_or_else(missing)?.weight(self.space, form)
    }

    /// The lemma that step i cites.
    pub fn earlier_lemma(&self, cite: usize, i: usize, rule: Rule) -> Outcome<&Lemma> {
        match self.file.steps.get(cite) {
            Some(Step::Lemma(lemma)) if cite < i => Ok(lemma),
            _ => Err(Rejection::new(rule, format!("step {cite} is not an earlier lemma"))),
        }
    }

    /// The numerators and the denominator of a net with differences of at most 1.
    fn net(&self, net: &[Number], rule: Rule) -> Outcome<(Vec<BigInt>, BigInt)> {
        let (space, (num, den)) = (self.space, numerators(self.space, net, rule)?);
        for (l, row) in space.rows.iter().enumerate() {
            let value = row.iter().map(|(i, c)| &num[*i] * c).sum::<BigInt>().abs();
            let shown = || decimal(&BigRational::new(value.clone(), den.clone()), 12);
            ensure!(value <= den, rule, "difference {}: {} > 1", l + 1, shown());
        }
        Ok((num, den))
    }

    fn attained(&self, step: &Attained) -> Outcome<()> {
        let rule = Rule::Attained;
        let (net, den) = self.net(&step.net, rule)?;
        let reached = self.place(step)?.at(&net, &den);
        self.space.at_most(&self.lower, &reached, rule, "the lower target and the net's value")
    }

    fn attained_tile(&self, step: &AttainedTile) -> Outcome<()> {
        let (space, rule) = (self.space, Rule::AttainedTile);
        let (Word(word), point) = (&step.word, [step.v.0.clone(), step.w.0.clone()]);
        ensure!(is_tile(word) && space.patch().contains(&point), rule, "no point of a tile");
        ensure!(step.nets.len() == 15, rule, "{} nets, not 15", step.nets.len());
        let forms = target(self.claim).coefficients(space, &mut Path::new(space), word)?;
        let mut reached = Scalar::integer(0);
        for ((form, net), b) in forms.iter().zip(&step.nets).zip(space.patch().value(&point)) {
            let (net, den) = self.net(net, rule)?;
            let value = form.at(&net, &den).scale(&b);
            match space.ring.sign(&value) {
                Some(Sign::Plus) => reached = &reached + &value,
                Some(Sign::Minus) => reached = &reached - &value,
                _ => (),
            }
        }
        space.at_most(&self.lower, &reached, rule, "the lower target and the nets' value")
    }

    /// The form (times q) whose value is claimed to be attained.
    fn place(&self, step: &Attained) -> Outcome<Form> {
        let (space, claim, rule) = (self.space, self.claim, Rule::Attained);
        let mut path = Path::new(space);
        match (&step.at, claim.kind, &claim.at) {
            (Some(Place::Point(at)), Kind::Control | Kind::Limit, _) => {
                let (Word(word), point) = (&at.word, [at.v.0.clone(), at.w.0.clone()]);
                let valid = is_in_mesh(space, claim.level, word) && is_known(space, word, &point);
                ensure!(valid, rule, "no point of the target");
                target(claim).at_point(space, &mut path, word, &point)
            }
            (Some(Place::Difference(at)), Kind::Rate | Kind::MeshRate, _) => {
                ensure!(names(claim, &at.word), rule, "no net of the claim");
                let rows = space.differences(is_regular(&at.word.0));
                let row = at.difference.checked_sub(1).and_then(|l| rows.get(l));
                let missing = || Rejection::new(rule, "no difference of the net");
                let row = row.ok_or_else(missing)?;
                let difference = path.along(&at.word.0)?[claim.level].difference(row);
                Ok(Form::sum(&space.ring, space.size, &[(&space.q, &difference)]))
            }
            (None, Kind::Coefficient, Some(at)) => {
                Ok(target(claim).coefficients(space, &mut path, &at.word.0)?.swap_remove(at.index))
            }
            _ => Err(Rejection::new(rule, "the place is not one for the claim's kind")),
        }
    }

    fn apply(&self, step: &Apply, i: usize) -> Outcome<()> {
        let (space, rule) = (self.space, Rule::Apply);
        let lemma = self.earlier_lemma(step.lemma, i, rule)?;
        let fits = lemma.depth == 0 && self.claim.level == 0;
        ensure!(fits, rule, "only a lemma of depth 0 applies, and only to level 0");
        space.at_most(&space.value(&lemma.bound), &self.upper, rule, "the lemma's bound")
    }

    fn differences(&self, step: &Differences) -> Outcome<()> {
        let (space, claim, rule) = (self.space, self.claim, Rule::Differences);
        let mut seen = HashSet::new();
        for (word, _) in &step.words {
            let written = text(&word.0);
            ensure!(names(claim, word), rule, "the word {written} is not one of the claim");
            let image = mirrored(&word.0);
            let new = !seen.contains(&word.0) && !seen.contains(&image);
            ensure!(new, rule, "the word {written} is there twice");
            seen.extend([word.0.clone(), image]);
        }
        let whole = if claim.kind == Kind::MeshRate { 1u64 << (2 * claim.level) } else { 1 };
        ensure!(seen.len() as u64 == whole, rule, "{} words of {whole} are there", seen.len());
        let mut path = Path::new(space);
        for (word, bases) in &step.words {
            let rows = space.differences(is_regular(&word.0));
            let (count, given) = (rows.len(), bases.len());
            ensure!(count == given, rule, "{given} bases for {count} differences");
            let net = &path.along(&word.0)?[claim.level];
            for (l, (row, &cite)) in rows.iter().zip(bases).enumerate() {
                let form = Form::sum(&space.ring, space.size, &[(&space.q, &net.difference(row))]);
                let name = format!("word {}, difference {}: the weight", text(&word.0), l + 1);
                space.at_most(&self.weight(cite, &form)?, &self.upper, rule, name)?;
            }
        }
        Ok(())
    }

    fn weight_of_coefficient(&self, step: &Weight) -> Outcome<()> {
        let form = self.place(&Attained { net: Vec::new(), at: None })?;
        let weight = self.weight(step.basis, &form)?;
        self.space.at_most(&weight, &self.upper, Rule::Weight, "the weight")
    }
}
