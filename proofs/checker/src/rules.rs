//! The rules of section 4 of FORMAT.md.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::basis::Basis;
use crate::cells;
use crate::covering::{self, text};
use crate::file::{
    Apply, Attained, Cell, Cite, Claim, Cover, Differences, File, Kind, Lemma, Number, Place, Step,
    Tail, Weight,
};
use crate::form::Form;
use crate::net::Path;
use crate::polynomial::Polynomial;
use crate::rational::{decimal, ratio};
use crate::reject::{Outcome, Rejection, Rule, require};
use crate::space::Space;
use crate::target::{Mesh, Target};
use crate::word::{Triangle, exponents, is_regular, mirrored};

/// The most terms of all bases' programs together, for memory's sake.
const TERMS: u64 = 1 << 24;

/// A certificate with everything that its steps need.
pub struct Proof<'a> {
    file: &'a File,
    space: &'a Space,
    bases: Vec<Basis>,
    lower: Polynomial,
    upper: Polynomial,
}

/// The claim's target; that of a rate is not used.
fn target(claim: &Claim) -> Target {
    let mesh = if claim.kind == Kind::Control {
        Mesh::Control
    } else {
        Mesh::Limit
    };
    Target {
        mesh,
        level: claim.level,
    }
}

/// `Σ c f`.
fn sum(space: &Space, terms: &[(BigRational, &Form)]) -> Form {
    let terms: Vec<_> = terms
        .iter()
        .map(|(c, form)| (Polynomial::constant(c), *form))
        .collect();
    Form::sum(
        space.size,
        &terms.iter().map(|(c, form)| (c, *form)).collect::<Vec<_>>(),
    )
}

/// 2^-k.
fn half_power(k: usize) -> BigRational {
    num_traits::pow(ratio(1, 2), k)
}

fn is_in_triangle(v: &BigRational, w: &BigRational) -> bool {
    !v.is_negative() && !w.is_negative() && v + w <= BigRational::one()
}

impl<'a> Proof<'a> {
    /// Checks the claim by itself and the bases.
    ///
    /// # Errors
    ///
    /// If and only if they are not as the format says: rule `claim` or `bases`.
    pub fn new(file: &'a File, space: &'a Space) -> Outcome<Self> {
        let claim = &file.claim;
        let (lo, hi) = (space.q.scale(&claim.lo.0), space.q.scale(&claim.hi.0));
        let exact = claim.exact.as_ref().map(|value| space.value(value));
        space.require_at_most(&lo, &hi, Rule::Claim, || "lo and hi".into())?;
        if let Some(exact) = &exact {
            space.require_at_most(&lo, exact, Rule::Claim, || "lo and exact".into())?;
            space.require_at_most(exact, &hi, Rule::Claim, || "exact and hi".into())?;
        }
        let rate = matches!(claim.kind, Kind::Rate | Kind::MeshRate);
        require(!rate || claim.level >= 1, Rule::Claim, || {
            "a rate has a level of at least 1".into()
        })?;
        match (&claim.at, claim.kind) {
            (Some(at), Kind::Coefficient) => {
                let valid = is_regular(&at.word.0) || (space.n == 6 && at.word.0.is_empty());
                require(
                    valid && at.index < 15 && claim.level == 0,
                    Rule::Claim,
                    || "there is no such coefficient".into(),
                )?;
            }
            (None, Kind::Coefficient) => {
                return Err(Rejection::new(
                    Rule::Claim,
                    "it does not say which coefficient",
                ));
            }
            (Some(_), _) => {
                return Err(Rejection::new(
                    Rule::Claim,
                    "only a coefficient has a place",
                ));
            }
            (None, _) => (),
        }
        let (mut bases, mut terms) = (Vec::new(), 0);
        for list in &file.bases {
            let basis = Basis::new(space, list)?;
            terms += basis.length();
            require(terms <= TERMS, Rule::Format, || {
                "more bases than the checker allows".into()
            })?;
            bases.push(basis);
        }
        let (lower, upper) = (exact.clone().unwrap_or(lo), exact.unwrap_or(hi));
        Ok(Self {
            file,
            space,
            bases,
            lower,
            upper,
        })
    }

    /// Checks every step, and that the last one proves the claim.
    ///
    /// # Errors
    ///
    /// If and only if a step fails, or the steps are not those that the claim needs.
    pub fn check(&self) -> Outcome<()> {
        let last = self.file.steps.len().saturating_sub(1);
        require(last >= 1, Rule::Format, || {
            "the steps are not an attained value, lemmas and a conclusion".into()
        })?;
        for (i, step) in self.file.steps.iter().enumerate() {
            self.step(step, i, last).map_err(|rejection| Rejection {
                step: Some(i),
                ..rejection
            })?;
        }
        Ok(())
    }

    fn step(&self, step: &Step, i: usize, last: usize) -> Outcome<()> {
        let concludes = match step {
            Step::Attained(_) => i == 0,
            Step::Lemma(_) => 0 < i && i < last,
            _ => i == last,
        };
        require(concludes, Rule::Format, || {
            "the steps are not an attained value, lemmas and a conclusion, in this order".into()
        })?;
        match (step, self.file.claim.kind) {
            (Step::Attained(step), _) => self.attained(step),
            (Step::Lemma(step), _) => self.lemma(step),
            (Step::Cover(step), Kind::Control | Kind::Limit) => self.cover(step, i),
            (Step::Apply(step), Kind::Control) => self.apply(step, i),
            (Step::Differences(step), Kind::Rate | Kind::MeshRate) => self.differences(step),
            (Step::Weight(step), Kind::Coefficient) => self.weight_of_coefficient(step),
            _ => Err(Rejection::new(
                Rule::Claim,
                "the conclusion is of another kind than the claim",
            )),
        }
    }

    /// The weight (times q) of a form (times q) in a basis.
    fn weight(&self, cite: Cite, form: &Form) -> Outcome<Polynomial> {
        let basis = self
            .bases
            .get(cite)
            .ok_or_else(|| Rejection::new(Rule::Bases, format!("there is no basis {cite}")))?;
        basis.weight(self.space, form)
    }

    fn earlier_lemma(&self, cite: usize, step: usize, rule: Rule) -> Outcome<&Lemma> {
        match self.file.steps.get(cite) {
            Some(Step::Lemma(lemma)) if cite < step => Ok(lemma),
            _ => Err(Rejection::new(
                rule,
                format!("step {cite} is no earlier lemma"),
            )),
        }
    }

    fn attained(&self, step: &Attained) -> Outcome<()> {
        let (space, claim) = (self.space, &self.file.claim);
        let net: Vec<BigRational> = step.net.iter().map(|y| y.0.clone()).collect();
        require(net.len() == space.size, Rule::Attained, || {
            format!("the net has {} points, not {}", net.len(), space.size)
        })?;
        for (l, row) in space.rows.iter().enumerate() {
            let value = row
                .iter()
                .map(|&(i, c)| &net[i] * ratio(c, 1))
                .sum::<BigRational>()
                .abs();
            require(value <= BigRational::one(), Rule::Attained, || {
                format!(
                    "second difference {}: {} is above 1",
                    l + 1,
                    decimal(&value, 12)
                )
            })?;
        }
        let mut path = Path::new(space);
        let form = match (&step.at, claim.kind, &claim.at) {
            (Some(Place::Point(at)), Kind::Control | Kind::Limit, _) => {
                let (word, Number(v), Number(w)) = (&at.word.0, &at.v, &at.w);
                let valid =
                    is_in_triangle(v, w) && (is_regular(word) || (v.is_zero() && w.is_zero()));
                require(valid && word.len() >= claim.level, Rule::Attained, || {
                    "there is no such point".into()
                })?;
                target(claim).at_point(space, &mut path, word, v, w)?
            }
            (Some(Place::Difference(at)), Kind::Rate | Kind::MeshRate, _) => {
                let word = &at.word.0;
                let valid = word.len() == claim.level
                    && (claim.kind == Kind::MeshRate || !is_regular(word));
                require(valid, Rule::Attained, || "there is no such net".into())?;
                let differences = path.along(word)?[word.len()].differences();
                let difference = at
                    .difference
                    .checked_sub(1)
                    .and_then(|l| differences.get(l));
                let difference = difference
                    .ok_or_else(|| Rejection::new(Rule::Attained, "there is no such difference"))?;
                Form::sum(space.size, &[(&space.q, difference)])
            }
            (None, Kind::Coefficient, Some(at)) => {
                target(claim).coefficients(space, &mut path, &at.word.0)?[at.index].clone()
            }
            _ => {
                return Err(Rejection::new(
                    Rule::Attained,
                    "the place is not one of the claim's kind",
                ));
            }
        };
        space.require_at_most(&self.lower, &form.at(&net), Rule::Attained, || {
            "the lower target and the net's value".into()
        })
    }

    fn lemma(&self, step: &Lemma) -> Outcome<()> {
        let space = self.space;
        let shape = match (step.order, step.corner) {
            (0, None) => true,
            (1, Some(_)) => {
                step.depth == 0
                    && step
                        .cells
                        .iter()
                        .all(|(_, _, by)| cells::rule(by) == Rule::CellHull)
            }
            _ => false,
        };
        require(shape, Rule::Lemma, || {
            "order, depth, corner and cells do not fit".into()
        })?;
        self.require_depth(step.depth, step.steps, Rule::Lemma)?;
        let bound = space.value(&step.bound);
        let control = Target {
            mesh: Mesh::Control,
            level: 0,
        };
        let mut path = Path::new(space);
        let corner = match step.corner {
            None => None,
            Some(cite) => {
                let form = control.at_point(
                    space,
                    &mut path,
                    &[],
                    &BigRational::zero(),
                    &BigRational::zero(),
                )?;
                space.require_at_most(&self.weight(cite, &form)?, &bound, Rule::Lemma, || {
                    "the corner's weight".into()
                })?;
                Some(form)
            }
        };
        self.cells(
            &step.cells,
            [step.depth, step.depth + step.steps],
            control,
            corner.as_ref(),
            &bound,
        )?;
        // The displacements L_c = F_0(u)(A^K y) - F_0(2^-K u)(y) at the corners (0, 0) and (h, 0).
        let (h, shrink) = (half_power(step.depth), half_power(step.steps));
        let nets = path.along(&vec![0; step.steps])?;
        let (first, last) = (&nets[0], &nets[step.steps]);
        let displacement = |h: &BigRational| {
            let one = BigRational::one();
            let form = sum(
                space,
                &[
                    (&one - h, last.point(1)),
                    (h.clone(), last.point(2)),
                    (h * &shrink - &one, first.point(1)),
                    (-h * &shrink, first.point(2)),
                ],
            );
            Form::sum(space.size, &[(&space.q, &form)])
        };
        let (grow, forms) = match &corner {
            None => (
                BigRational::one(),
                vec![displacement(&BigRational::zero()), displacement(&h)],
            ),
            Some(corner) => {
                let grow = shrink.recip();
                let form = sum(
                    space,
                    &[
                        (grow.clone(), &displacement(&h)),
                        (BigRational::one() - &grow, corner),
                    ],
                );
                (grow, vec![form])
            }
        };
        self.tail(
            &step.tail,
            &forms,
            &bound.scale(&grow),
            &last.differences(),
            &bound,
        )
    }

    fn cover(&self, step: &Cover, i: usize) -> Outcome<()> {
        let (space, claim) = (self.space, &self.file.claim);
        let lemma = self.earlier_lemma(step.lemma, i, Rule::Cover)?;
        require(step.steps >= claim.level, Rule::Cover, || {
            "there are fewer steps than levels".into()
        })?;
        self.require_depth(lemma.depth, step.steps, Rule::Cover)?;
        let short = step
            .cells
            .iter()
            .find(|(word, ..)| word.0.len() < claim.level);
        require(short.is_none(), Rule::Cover, || {
            "a cell has fewer letters than levels".into()
        })?;
        let target = target(claim);
        self.cells(
            &step.cells,
            [0, lemma.depth + step.steps],
            target,
            None,
            &self.upper,
        )?;
        // The displacements F_K - F_k at the corners of the tail's word, F_K the control mesh.
        let word = vec![0; step.steps];
        let mut path = Path::new(space);
        let nets = path.along(&word)?;
        let last = &nets[step.steps];
        let displacement = |h: &BigRational| {
            let control = sum(
                space,
                &[
                    (BigRational::one() - h, last.point(1)),
                    (h.clone(), last.point(2)),
                ],
            );
            let mesh = target.mesh_at(space, nets, &word, h, &BigRational::zero());
            Form::sum(
                space.size,
                &[(&space.q, &control), (&Polynomial::integer(-1), &mesh)],
            )
        };
        let forms = [
            displacement(&BigRational::zero()),
            displacement(&half_power(lemma.depth)),
        ];
        self.tail(
            &step.tail,
            &forms,
            &space.value(&lemma.bound),
            &last.differences(),
            &self.upper,
        )
    }

    fn require_depth(&self, depth: usize, steps: usize, rule: Rule) -> Outcome<()> {
        let valid =
            steps >= 1 && steps <= crate::file::LETTERS && depth <= crate::file::LETTERS - steps;
        require(valid, rule, || {
            "steps is not at least 1, or steps and depth are above 40 together".into()
        })
    }

    fn apply(&self, step: &Apply, i: usize) -> Outcome<()> {
        let lemma = self.earlier_lemma(step.lemma, i, Rule::Apply)?;
        let fits = lemma.depth == 0 && self.file.claim.level == 0;
        require(fits, Rule::Apply, || {
            "only a lemma of depth 0 applies, and only to level 0".into()
        })?;
        self.space.require_at_most(
            &self.space.value(&lemma.bound),
            &self.upper,
            Rule::Apply,
            || "the lemma's bound and the upper target".into(),
        )
    }

    /// The words of `whole` zeros without that of `tail` zeros is covered, and each cell shows the bound for its target.
    fn cells(
        &self,
        cells: &[Cell],
        [whole, tail]: [usize; 2],
        target: Target,
        corner: Option<&Form>,
        bound: &Polynomial,
    ) -> Outcome<()> {
        let words: Vec<&[u8]> = cells.iter().map(|(word, ..)| &word.0[..]).collect();
        let zeros = words.iter().any(|word| !is_regular(word));
        require(!zeros, Rule::Covering, || {
            "a cell's word has zeros only".into()
        })?;
        covering::check(whole, tail, &words)?;
        let mut cells: Vec<_> = cells.iter().collect();
        cells.sort_by(|(a, ..), (b, ..)| a.cmp(b)); // for the path's sake
        let mut path = Path::new(self.space);
        for (word, cite, by) in cells {
            let name = |rejection: Rejection| Rejection {
                why: format!("cell {}: {}", text(&word.0), rejection.why),
                ..rejection
            };
            let mut forms = target.coefficients(self.space, &mut path, &word.0)?;
            if let Some(corner) = corner {
                let part = Triangle::of(&word.0);
                for ([_, j, k], form) in exponents(4).into_iter().zip(&mut forms) {
                    let [v, w] = part.point(&ratio(j as i64, 4), &ratio(k as i64, 4));
                    let u = v + w;
                    require(u.is_positive(), Rule::Lemma, || {
                        "a node at the corner".into()
                    })
                    .map_err(name)?;
                    *form = sum(
                        self.space,
                        &[(u.recip(), form), (BigRational::one() - u.recip(), corner)],
                    );
                }
            }
            let weights = forms
                .iter()
                .map(|form| self.weight(*cite, form))
                .collect::<Outcome<Vec<_>>>()
                .map_err(name)?;
            cells::check(self.space, &weights, bound, by).map_err(name)?;
        }
        Ok(())
    }

    /// Each `form + s factor difference`, s = 1, -1, has a weight of at most the bound.
    fn tail(
        &self,
        tail: &Tail,
        forms: &[Form],
        factor: &Polynomial,
        differences: &[Form],
        bound: &Polynomial,
    ) -> Outcome<()> {
        require(tail.len() == forms.len(), Rule::Tail, || {
            format!("{} entries, not {}", tail.len(), forms.len())
        })?;
        let (one, minus) = (Polynomial::integer(1), factor * &Polynomial::integer(-1));
        for (c, (form, (plus_bases, minus_bases))) in forms.iter().zip(tail).enumerate() {
            for (sign, factor, bases) in [('+', factor, plus_bases), ('-', &minus, minus_bases)] {
                let count = bases.len() == differences.len();
                require(count, Rule::Tail, || {
                    format!("{} bases, not {}", bases.len(), differences.len())
                })?;
                for (l, (difference, &cite)) in differences.iter().zip(bases).enumerate() {
                    self.space.charge(4 * difference.cost())?;
                    let weight = self.weight(
                        cite,
                        &Form::sum(self.space.size, &[(&one, form), (factor, difference)]),
                    )?;
                    let name =
                        || format!("entry {c}, s = {sign}1, difference {}: the weight", l + 1);
                    self.space
                        .require_at_most(&weight, bound, Rule::Tail, name)?;
                }
            }
        }
        Ok(())
    }

    fn differences(&self, step: &Differences) -> Outcome<()> {
        let (space, claim) = (self.space, &self.file.claim);
        let mut seen = std::collections::HashSet::new();
        for (word, _) in &step.words {
            let named = word.0.len() == claim.level
                && (claim.kind == Kind::MeshRate || !is_regular(&word.0));
            require(named, Rule::Differences, || {
                format!("the word {} is not one of the claim", text(&word.0))
            })?;
            let image = mirrored(&word.0);
            let new = !seen.contains(&word.0) && !seen.contains(&image);
            require(new, Rule::Differences, || {
                format!("the word {} is there twice", text(&word.0))
            })?;
            seen.extend([word.0.clone(), image]);
        }
        let whole = if claim.kind == Kind::MeshRate {
            1 << (2 * claim.level)
        } else {
            1
        };
        require(seen.len() == whole, Rule::Differences, || {
            format!("{} words of {whole} are there", seen.len())
        })?;
        let mut path = Path::new(space);
        for (word, bases) in &step.words {
            let differences = path.along(&word.0)?[word.0.len()].differences();
            let count = bases.len() == differences.len();
            require(count, Rule::Differences, || {
                format!("{} bases, not {}", bases.len(), differences.len())
            })?;
            for (l, (difference, &cite)) in differences.iter().zip(bases).enumerate() {
                let weight =
                    self.weight(cite, &Form::sum(space.size, &[(&space.q, difference)]))?;
                let name = || format!("word {}, difference {}: the weight", text(&word.0), l + 1);
                space.require_at_most(&weight, &self.upper, Rule::Differences, name)?;
            }
        }
        Ok(())
    }

    fn weight_of_coefficient(&self, step: &Weight) -> Outcome<()> {
        let claim = &self.file.claim;
        let Some(at) = &claim.at else {
            return Err(Rejection::new(
                Rule::Claim,
                "it does not say which coefficient",
            ));
        };
        let forms =
            target(claim).coefficients(self.space, &mut Path::new(self.space), &at.word.0)?;
        let weight = self.weight(step.basis, &forms[at.index])?;
        self.space
            .require_at_most(&weight, &self.upper, Rule::Weight, || "the weight".into())
    }
}
