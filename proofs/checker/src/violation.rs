//! Inequalities about nets that are false, and the forms in them: section 7 of FORMAT.md.

use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::claim::{Functional, Norm, Violation};
use crate::file::{File, Number, Step, Word};
use crate::form::Form;
use crate::net::Path;
use crate::proof::{is_in_mesh, is_known, numerators};
use crate::rational::contrast;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::space::Space;
use crate::target::Target;
use crate::word::is_regular;

/// The one step of a file that claims a violation.
///
/// # Errors
///
/// If there are others: rule `format`; or bases: rule `bases`.
pub fn only_step(file: &File) -> Outcome<&Step> {
    ensure!(file.bases.is_empty(), Rule::Bases, "a violation has no bases");
    match &file.steps[..] {
        [step] => Ok(step),
        _ => Err(Rejection::new(Rule::Format, "a violation has one step")),
    }
}

/// Shows that `|left| > factor |right_i|` for the net of the step, for all i.
///
/// # Errors
///
/// If and only if it is not certain, or the claim is not one: rule `violated`; rule `claim` for a step of another name;
/// `bases`, `cosine`, `format` as for other claims.
pub fn check(file: &File, claim: &Violation) -> Outcome<()> {
    let space = Space::new(&claim.setting(), Norm::Second, file.one_cosine()?)?;
    let Step::Violated(step) = only_step(file)? else {
        return Err(Rejection::new(Rule::Claim, "the step is not one for the claim's kind"));
    };
    let (rule, factor) = (Rule::Violated, &claim.factor.0);
    ensure!(!factor.is_negative(), rule, "the factor is negative");
    ensure!(!claim.right.is_empty(), rule, "there is nothing on the right");
    let (net, den) = numerators(&space, &step.net, rule)?;
    let mut path = Path::new(&space);
    // Both sides are times q > 0, at the same net and the same beta.
    let mut magnitudes = |form: &Functional| -> Outcome<[BigRational; 2]> {
        let form = functional(&space, &mut path, form, Rule::Violated)?;
        space.charge(form.cost() * (1 + den.bits() / 64))?;
        Ok(space.ring.magnitudes(&form.at(&net, &den)))
    };
    let [left, _] = magnitudes(&claim.left)?;
    for (i, form) in claim.right.iter().enumerate() {
        let [_, right] = magnitudes(form)?;
        let bound = factor * right;
        let (x, y) = contrast(&left, &bound);
        ensure!(left > bound, rule, "form {i} (times q): {x} is not above {y}");
    }
    Ok(())
}

/// q times the functional.
///
/// # Errors
///
/// If it is none: the given rule; `format` for limits.
pub fn functional(space: &Space, path: &mut Path, form: &Functional, rule: Rule) -> Outcome<Form> {
    match form {
        Functional::Terms(form) => {
            let Word(word) = &form.word;
            let regular = is_regular(word);
            let size = space.scheme.size(space.valence(regular));
            let labels = if regular { space.scheme.points() } else { (1..=size).collect() };
            let increasing = form.terms.windows(2).all(|pair| pair[0].0 < pair[1].0);
            let nonzero = form.terms.iter().all(|(_, Number(c))| !c.is_zero());
            let whole = increasing && nonzero && !form.terms.is_empty();
            ensure!(whole, rule, "the terms are none, not increasing, or zero");
            let label = |&(i, _): &(usize, Number)| i.checked_sub(1).and_then(|i| labels.get(i));
            ensure!(form.terms.iter().all(|term| label(term).is_some()), rule, "no such label");
            let scalar = |(_, Number(c)): &(usize, Number)| space.q.scale(c);
            let mask = form.terms.iter().filter_map(|term| Some((scalar(term), *label(term)?)));
            let net = &path.along(word)?[word.len()];
            space.charge(2 * form.terms.len() as u64 * net.cost())?;
            Ok(net.apply(space, &mask.collect()))
        }
        Functional::Against(form) => {
            let (Word(word), point) = (&form.word, [form.at.0.0.clone(), form.at.1.0.clone()]);
            let valid = is_in_mesh(space, form.level, word) && is_known(space, word, &point);
            ensure!(valid, rule, "no point of the mesh of this level");
            Target { mesh: form.against, level: form.level }.at_point(space, path, word, &point)
        }
    }
}
