//! The rules that bound a target over a region: by cells away from the extraordinary vertex, by a
//! tail near it.

use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use crate::cells;
use crate::covering::{self, text};
use crate::file::{Bases, By, Cell, Cover, LETTERS, Lemma, Name, Tail, Word};
use crate::form::Form;
use crate::net::Path;
use crate::polynomial::Polynomial;
use crate::proof::{Proof, target};
use crate::rational::ratio;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::target::{Mesh, Target};
use crate::word::{Triangle, exponents, is_tile};

/// What the cells of a step prove: `target` (or, with a corner, its rest divided by `2^J (v + w)`)
/// is at most `bound / q` over the word of J zeros without that of `tail` zeros.
struct Region<'a> {
    depth: usize,
    tail: usize,
    target: Target,
    /// q t_0, for a lemma of order 1.
    corner: Option<&'a Form>,
    bound: &'a Polynomial,
}

/// `s factor differences` is added to each form for s = 1, -1; the weights are at most `bound / q`.
struct Ending<'a> {
    forms: Vec<Form>,
    factor: &'a Polynomial,
    differences: Vec<Form>,
    bound: &'a Polynomial,
}

fn is_hull((_, _, by): &Cell) -> bool {
    matches!(by, By::Alone(Name::Hull))
}

fn is_regular((_, _, by): &Cell) -> bool {
    matches!(by, By::Alone(Name::Regular))
}

impl Proof<'_> {
    /// `‖S - F_0‖ <= bound` over the word of J zeros.
    pub fn lemma(&self, step: &Lemma) -> Outcome<()> {
        let (space, rule) = (self.space, Rule::Lemma);
        let bound = &space.value(&step.bound);
        let valid = step.steps >= 1 && step.steps.max(step.depth) <= LETTERS;
        let valid = valid && step.steps + step.depth <= LETTERS;
        ensure!(valid, rule, "steps is below 1, or steps and depth are above {LETTERS}");
        let target = Target { mesh: Mesh::Control, level: 0 };
        let mut path = Path::new(space);
        let (zero, one) = (BigRational::zero(), BigRational::one());
        let corner = match (step.order, step.corner) {
            (0, None) => None,
            (1, Some(cite)) if step.cells.iter().all(is_hull) => {
                let form = target.at_point(space, &mut path, &[], &zero, &zero)?;
                space.at_most(&self.weight(cite, &form)?, bound, rule, "the corner's weight")?;
                Some(form)
            }
            _ => return Err(Rejection::new(rule, "order, corner and cells do not fit")),
        };
        let (depth, tail) = (step.depth, step.depth + step.steps);
        self.cells(&step.cells, &Region { depth, tail, target, corner: corner.as_ref(), bound })?;

        // L_c = F_0(u)(A^K y) - F_0(2^-K u)(y) at the corners u = (0, 0), (h, 0) of the region.
        let (h, shrink) = (pow(ratio(1, 2), step.depth), pow(ratio(1, 2), step.steps));
        let nets = path.along(&vec![0; step.steps])?;
        let (first, last) = (&nets[0], &nets[step.steps]);
        let displacement = |h: &BigRational| {
            let h_first = h * &shrink;
            let plus = [(&one - h, last.point(1)), (h.clone(), last.point(2))];
            let minus = [(&h_first - &one, first.point(1)), (-h_first, first.point(2))];
            let form = Form::mix(space.size, &[plus, minus].concat());
            Form::sum(space.size, &[(&space.q, &form)])
        };
        let differences = last.differences();
        let (forms, grow) = match &corner {
            None => (vec![displacement(&zero), displacement(&h)], one),
            Some(t_0) => {
                let grow = shrink.recip();
                let terms = [(grow.clone(), &displacement(&h)), (&one - &grow, t_0)];
                (vec![Form::mix(space.size, &terms)], grow)
            }
        };
        self.tail(&step.tail, &Ending { forms, factor: &bound.scale(&grow), differences, bound })
    }

    /// `‖S - F_k‖ <= upper` over the face; by the rule `tiles` for all Bernstein coefficients.
    pub fn cover(&self, step: &Cover, i: usize, rule: Rule) -> Outcome<()> {
        let (space, claim) = (self.space, &self.file.claim);
        let lemma = self.earlier_lemma(step.lemma, i, rule)?;
        let (target, bound) = (target(claim), &self.upper);
        ensure!(step.steps >= claim.level, rule, "fewer steps than levels");
        let valid = step.steps <= LETTERS && lemma.depth <= LETTERS - step.steps;
        ensure!(valid, rule, "steps and depth are above {LETTERS}");
        if rule == Rule::Tiles {
            let whole = |cell: &Cell| is_tile(&cell.0.0);
            ensure!(step.cells.iter().all(whole), rule, "a cell is not a whole tile");
            let hulls = lemma.cells.iter().all(|cell| whole(cell) && is_hull(cell));
            ensure!(hulls, rule, "a cell of the lemma is not the hull of a whole tile");
        }
        let long = |cell: &Cell| cell.0.0.len() >= claim.level || is_regular(cell);
        ensure!(step.cells.iter().all(long), rule, "a cell's word has fewer letters than levels");
        let tail = step.steps + lemma.depth;
        self.cells(&step.cells, &Region { depth: 0, tail, target, corner: None, bound })?;

        // L_c = F_K - F_k, F_K the control mesh, at the corners of the word of the tail.
        let word = vec![0; step.steps];
        let mut path = Path::new(space);
        let nets = path.along(&word)?;
        let last = &nets[step.steps];
        let displacement = |h: &BigRational| {
            let terms = [(BigRational::one() - h, last.point(1)), (h.clone(), last.point(2))];
            let control = Form::mix(space.size, &terms);
            let mesh = target.mesh_at(space, nets, &word, h, &BigRational::zero());
            Form::sum(space.size, &[(&space.q, &control), (&Polynomial::integer(-1), &mesh)])
        };
        let forms = vec![displacement(&ratio(0, 1)), displacement(&pow(ratio(1, 2), lemma.depth))];
        let (factor, differences) = (&space.value(&lemma.bound), last.differences());
        self.tail(&step.tail, &Ending { forms, factor, differences, bound })
    }

    fn cells(&self, cells: &[Cell], region: &Region) -> Outcome<()> {
        let words: Vec<&[u8]> = cells.iter().map(|(word, ..)| &word.0[..]).collect();
        covering::check(region.depth, region.tail, &words)?;
        let mut cells: Vec<_> = cells.iter().collect();
        cells.sort_by_key(|(word, ..)| word); // so that the path is followed, not begun anew
        let mut path = Path::new(self.space);
        for cell in cells {
            let name = |why| format!("cell {}: {why}", text(&cell.0.0));
            let named = |fault: Rejection| Rejection::new(fault.rule, name(fault.why));
            self.cell(cell, region, &mut path).map_err(named)?;
        }
        Ok(())
    }

    fn cell(&self, cell: &Cell, region: &Region, path: &mut Path) -> Outcome<()> {
        if is_regular(cell) {
            return self.regular(cell, region, path);
        }
        let (Word(word), bases, by) = cell;
        let mut forms = region.target.coefficients(self.space, path, word)?;
        if let Some(t_0) = region.corner {
            let part = Triangle::of(word);
            let unit = pow(ratio(2, 1), region.depth);
            for ([_, j, k], form) in exponents(4).into_iter().zip(&mut forms) {
                let [v, w] = part.point(&ratio(j as i64, 4), &ratio(k as i64, 4));
                let mu = (v + w) * &unit;
                ensure!(!mu.is_zero(), Rule::Lemma, "a node at the corner");
                let over = mu.recip();
                let rest = BigRational::one() - &over; // (t - (1 - mu) t_0) / mu
                *form = Form::mix(self.space.size, &[(over, form), (rest, t_0)]);
            }
        }
        let cite = |i: usize| match bases {
            Bases::One(cite) => *cite,
            Bases::Each(list) => list[i],
        };
        let weights = forms.iter().enumerate().map(|(i, form)| self.weight(cite(i), form));
        cells::check(self.space, &weights.collect::<Outcome<Vec<_>>>()?, region.bound, by, 0)
    }

    /// `f 4^-d` times the second differences of the word's net, d levels above F_k, bounds S - F_k.
    fn regular(
        &self,
        (Word(word), bases, _): &Cell,
        region: &Region,
        path: &mut Path,
    ) -> Outcome<()> {
        let (space, rule, target) = (self.space, Rule::CellRegular, region.target);
        let above = target.level.saturating_sub(word.len());
        ensure!(above > 0, rule, "only for a word with fewer letters than levels");
        let Bases::Each(list) = bases else {
            return Err(Rejection::new(rule, "one basis, not 15"));
        };
        let distance = if target.mesh == Mesh::Control { ratio(1, 2) } else { ratio(1, 3) };
        let factor = distance * pow(ratio(1, 4), above);
        let differences = path.along(word)?[word.len()].differences();
        for (l, (difference, &cite)) in differences.iter().zip(list).enumerate() {
            let form = Form::sum(space.size, &[(&space.q.scale(&factor), difference)]);
            let weight = self.weight(cite, &form)?;
            space.at_most(&weight, region.bound, rule, format_args!("difference {}", l + 1))?;
        }
        Ok(())
    }

    fn tail(&self, tail: &Tail, ending: &Ending) -> Outcome<()> {
        let (space, rule) = (self.space, Rule::Tail);
        let (count, given) = (ending.forms.len(), tail.len());
        ensure!(count == given, rule, "{given} entries, not {count}");
        let one = Polynomial::integer(1);
        for (c, (form, (plus, minus))) in ending.forms.iter().zip(tail).enumerate() {
            for (s, bases) in [(1, plus), (-1, minus)] {
                let (count, given) = (ending.differences.len(), bases.len());
                ensure!(count == given, rule, "{given} bases for {count} differences");
                let factor = ending.factor.scale(&ratio(s, 1));
                for (l, (difference, &cite)) in ending.differences.iter().zip(bases).enumerate() {
                    space.charge(4 * difference.cost() * factor.num.len() as u64)?;
                    let form = Form::sum(space.size, &[(&one, form), (&factor, difference)]);
                    let weight = self.weight(cite, &form)?;
                    let name = format_args!("entry {c}, s = {s}, difference {}", l + 1);
                    space.at_most(&weight, ending.bound, rule, name)?;
                }
            }
        }
        Ok(())
    }
}
