//! The rules that bound a target over a region: by cells away from the extraordinary vertex, by a
//! tail near it.

use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use crate::cells::Goal;
use crate::covering::{self, text};
use crate::file::{Bases, By, Cell, Cover, LETTERS, Lemma, Name, Tail, Word};
use crate::form::Form;
use crate::net::{Net, Path};
use crate::patch::Point;
use crate::proof::{Proof, is_in_mesh, target};
use crate::rational::ratio;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::scalar::Scalar;
use crate::target::Target;
use crate::word::is_tile;

/// What the cells of a step prove: `target` (or, with a corner, its rest divided by the distance from it)
/// is at most `bound / q` over the word of J zeros without that of `tail` zeros, both inside the root.
struct Region<'a> {
    depth: usize,
    tail: usize,
    target: Target,
    /// q t_0, for a lemma of order 1.
    corner: Option<&'a Form>,
    bound: &'a Scalar,
}

/// `s factor differences of the net` is added to each form for s = 1, -1; the weights are at most `bound / q`.
struct Ending<'a> {
    forms: Vec<Form>,
    factor: &'a Scalar,
    net: &'a Net,
    bound: &'a Scalar,
}

/// True for a cell that is shown in the way with this name alone.
fn is_shown_by((_, _, by): &Cell, name: Name) -> bool {
    matches!(by, By::Alone(found) if *found == name)
}

fn half(times: usize) -> BigRational {
    pow(ratio(1, 2), times)
}

impl Proof<'_> {
    /// The word of zeros that stands for so many zeros inside the root.
    fn zeros(&self, count: usize) -> Vec<u8> {
        vec![0; count + self.space.scheme.root()]
    }

    /// The corners of the word of J zeros in the parameters of the root, without the last, which is the mirror image of
    /// number 1.
    fn corners(&self, depth: usize) -> Vec<Point> {
        let mut corners = self.space.patch().corners();
        corners.pop();
        corners.into_iter().map(|point| point.map(|x| x * half(depth))).collect()
    }

    /// `‖S - F_0‖ <= bound` over the word of J zeros: the bound carries itself from ring to ring. At `2^-K u` the target is
    /// that of the level-K net at u plus `L(u)`, which is affine or bilinear, so that it lies between its corner values.
    /// Order 1 does the same for `(t - (1 - mu) t_0)/mu`, mu the distance from the corner, t_0 the target there.
    pub fn lemma(&self, step: &Lemma) -> Outcome<()> {
        let (space, rule) = (self.space, Rule::Lemma);
        let bound = &space.value(&step.bound);
        let valid = step.steps >= 1 && step.steps.max(step.depth) <= LETTERS;
        let valid = valid && step.steps + step.depth <= LETTERS;
        ensure!(valid, rule, "steps is below 1, or steps and depth are above {LETTERS}");
        let (target, root) = (Target::FIRST, self.zeros(0));
        let mut path = Path::new(space);
        let corner = match (step.order, step.corner) {
            (0, None) => None,
            (1, Some(cite)) if step.cells.iter().all(|cell| is_shown_by(cell, Name::Hull)) => {
                let zero = [0, 0].map(|_| BigRational::zero());
                let form = target.at_point(space, &mut path, &root, &zero)?;
                space.at_most(&self.weight(cite, &form)?, bound, rule, "the corner's weight")?;
                Some(form)
            }
            _ => return Err(Rejection::new(rule, "order, corner and cells do not fit")),
        };
        let (depth, tail) = (step.depth, step.depth + step.steps);
        self.cells(&step.cells, &Region { depth, tail, target, corner: corner.as_ref(), bound })?;

        // L_c = F_0(u)(A^K y) - F_0(2^-K u)(y) at the corners u of the region.
        let nets = path.along(&vec![0; step.steps])?;
        let last = &nets[step.steps];
        let before = target.mesh(space, nets, &root)?;
        let after = target.mesh(space, &nets[step.steps..], &root)?;
        let displacement = |point: &Point| {
            let image = point.each_ref().map(|x| x * half(step.steps));
            before.below(&after.at(point), &image)
        };
        let mut forms: Vec<_> = self.corners(depth).iter().map(displacement).collect();
        let mut grow = BigRational::one();
        if let Some(t_0) = &corner {
            // 2^K ((L_c - (1 - mu) L_0)/mu - (1 - 2^-K) t_0) at the other corners, mu their distance.
            grow = half(step.steps).recip();
            let zeroth = forms.remove(0);
            for (form, point) in forms.iter_mut().zip(&space.patch().corners()[1..]) {
                let over = &grow / space.patch().distance(point);
                let terms = [
                    (over.clone(), &*form),
                    (&grow - over, &zeroth),
                    (BigRational::one() - &grow, t_0),
                ];
                *form = Form::mix(space.size, &terms);
            }
        }
        self.tail(&step.tail, &Ending { forms, factor: &bound.scale(&grow), net: last, bound })
    }

    /// `‖S - F_k‖ <= upper` over the face; by the rule `tiles` for all Bernstein coefficients. Near the corner it is at
    /// most the lemma's bound for the level-K net, plus `F_K - F_k` for the control mesh F_K.
    pub fn cover(&self, step: &Cover, i: usize, rule: Rule) -> Outcome<()> {
        let (space, claim) = (self.space, self.claim);
        let lemma = self.earlier_lemma(step.lemma, i, rule)?;
        let (target, bound) = (target(claim), &self.upper);
        ensure!(step.steps >= claim.level, rule, "fewer steps than levels");
        let valid = step.steps <= LETTERS && lemma.depth <= LETTERS - step.steps;
        ensure!(valid, rule, "steps and depth are above {LETTERS}");
        if rule == Rule::Tiles {
            let whole = |cell: &Cell| is_tile(&cell.0.0);
            ensure!(step.cells.iter().all(whole), rule, "a cell is not a whole tile");
            let hulls = lemma.cells.iter().all(|cell| whole(cell) && is_shown_by(cell, Name::Hull));
            ensure!(hulls, rule, "a cell of the lemma is not the hull of a whole tile");
        }
        let long = |cell: &Cell| {
            is_in_mesh(space, claim.level, &cell.0.0) || is_shown_by(cell, Name::Regular)
        };
        ensure!(step.cells.iter().all(long), rule, "a cell's word has fewer letters than levels");
        let tail = step.steps + lemma.depth;
        self.cells(&step.cells, &Region { depth: 0, tail, target, corner: None, bound })?;

        // L_c = F_K - F_k, F_K the control mesh, at the corners of the word of the tail.
        let mut path = Path::new(space);
        let nets = path.along(&vec![0; step.steps])?;
        let control = Target::FIRST.mesh(space, &nets[step.steps..], &self.zeros(0))?;
        let mesh = target.mesh(space, nets, &self.zeros(step.steps))?;
        let displacement = |point: &Point| mesh.below(&control.at(point), point);
        let forms = self.corners(lemma.depth).iter().map(displacement).collect();
        let (factor, net) = (&space.value(&lemma.bound), &nets[step.steps]);
        self.tail(&step.tail, &Ending { forms, factor, net, bound })
    }

    fn cells(&self, cells: &[Cell], region: &Region) -> Outcome<()> {
        let words: Vec<&[u8]> = cells.iter().map(|(word, ..)| &word.0[..]).collect();
        covering::check(&self.zeros(region.depth), &self.zeros(region.tail), &words)?;
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
        if is_shown_by(cell, Name::Regular) {
            return self.regular(cell, region, path);
        }
        let (Word(word), bases, by) = cell;
        let (space, bound) = (self.space, region.bound);
        let mut forms = region.target.coefficients(space, path, word)?;
        if let Some(t_0) = region.corner {
            let part = space.patch().part(&word[space.scheme.root()..]);
            for (node, form) in space.patch().nodes().iter().zip(&mut forms) {
                let mu = space.patch().distance(&part.point(node)) / half(region.depth);
                ensure!(!mu.is_zero(), Rule::Lemma, "a node at the corner");
                let over = mu.recip();
                let rest = BigRational::one() - &over; // (t - (1 - mu) t_0) / mu
                *form = Form::mix(space.size, &[(over, form), (rest, t_0)]);
            }
        }
        let cites = match bases {
            Bases::One(cite) => &vec![*cite; forms.len()],
            Bases::Each(list) => list,
        };
        let (count, given) = (forms.len(), cites.len());
        ensure!(count == given, Rule::Format, "{given} bases for {count} coefficients");
        let weights = forms.iter().zip(cites).map(|(form, &cite)| self.weight(cite, form));
        let c = &weights.collect::<Outcome<Vec<_>>>()?;
        Goal { space, c, bound }.check(by, 0)
    }

    /// `f 4^-d` times the differences of the word's net bounds S - F_k: d levels below it F_k is F_0.
    fn regular(
        &self,
        (Word(word), bases, _): &Cell,
        region: &Region,
        path: &mut Path,
    ) -> Outcome<()> {
        let (space, rule, target) = (self.space, Rule::CellRegular, region.target);
        let short = word.len() < target.level + space.scheme.root();
        ensure!(short, rule, "only for a word with fewer letters than levels");
        let missing = || Rejection::new(rule, "not for this norm");
        let bend = space.scheme.bend(target.mesh).ok_or_else(missing)?;
        let Bases::Each(list) = bases else {
            return Err(Rejection::new(rule, "one basis, not one for each difference"));
        };
        let (rows, given) = (space.differences(true), list.len());
        ensure!(rows.len() == given, Rule::Format, "{given} bases for {} differences", rows.len());
        let factor = space.q.scale(&(bend * pow(ratio(1, 4), target.level - word.len())));
        let net = &path.along(word)?[word.len()];
        for (l, (row, &cite)) in rows.iter().zip(list).enumerate() {
            let form = Form::sum(&space.ring, space.size, &[(&factor, &net.difference(row))]);
            let weight = self.weight(cite, &form)?;
            space.at_most(&weight, region.bound, rule, format_args!("difference {}", l + 1))?;
        }
        Ok(())
    }

    fn tail(&self, tail: &Tail, ending: &Ending) -> Outcome<()> {
        let (space, rule) = (self.space, Rule::Tail);
        let (count, given) = (ending.forms.len(), tail.len());
        ensure!(count == given, rule, "{given} entries, not {count}");
        let count = space.rows.len();
        for given in tail.iter().flat_map(|(plus, minus)| [plus.len(), minus.len()]) {
            ensure!(count == given, rule, "{given} bases for {count} differences");
        }
        let one = Scalar::integer(1);
        let factors = [ratio(1, 1), ratio(-1, 1)].map(|s| ending.factor.scale(&s));
        for (l, row) in space.rows.iter().enumerate() {
            let difference = ending.net.difference(row);
            for (c, (form, (plus, minus))) in ending.forms.iter().zip(tail).enumerate() {
                for (factor, (s, bases)) in factors.iter().zip([("+1", plus), ("-1", minus)]) {
                    space.charge(4 * difference.cost() * factor.num.len() as u64)?;
                    let terms = [(&one, form), (factor, &difference)];
                    let form = Form::sum(&space.ring, space.size, &terms);
                    let name = format_args!("entry {c}, s = {s}, difference {}", l + 1);
                    space.at_most(&self.weight(bases[l], &form)?, ending.bound, rule, name)?;
                }
            }
        }
        Ok(())
    }
}
