//! Inequalities about nets that hold: section 7 of FORMAT.md.

use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::claim::{Functional, Inequality, Norm};
use crate::file::{Combined, File, Number, Reached, Step};
use crate::form::Form;
use crate::net::Path;
use crate::proof::numerators;
use crate::rational::contrast;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::space::Space;
use crate::violation::functional;

/// Shows that every left side is a combination of the right ones with multipliers that sum to at most the factor; and,
/// if the file says so, that a net reaches the factor.
///
/// # Errors
///
/// If and only if this fails, or the claim is none: rules `combined` and `reached`; `claim` for steps of other names;
/// `bases`, `cosine`, `format` as for other claims.
pub fn check(file: &File, claim: &Inequality) -> Outcome<()> {
    let space = Space::new(&claim.setting(), Norm::Second, file.one_cosine()?)?;
    ensure!(file.bases.is_empty(), Rule::Bases, "an inequality has no bases");
    let (combined, reached) = match &file.steps[..] {
        [Step::Combined(combined)] => (combined, None),
        [Step::Combined(combined), Step::Reached(reached)] => (combined, Some(reached)),
        _ => return Err(Rejection::new(Rule::Claim, "the steps are not those of an inequality")),
    };
    let rule = Rule::Combined;
    ensure!(!claim.factor.0.is_negative(), rule, "the factor is negative");
    let (left, right) = (&claim.left, &claim.right);
    ensure!(!left.is_empty() && !right.is_empty(), rule, "there is nothing on one side");
    let mut path = Path::new(&space);
    let mut forms = |list: &[Functional]| -> Outcome<Vec<Form>> {
        list.iter().map(|form| functional(&space, &mut path, form, rule)).collect()
    };
    let (left, right) = (forms(left)?, forms(right)?);
    check_combined(&space, &left, &right, &claim.factor.0, combined)?;
    match reached {
        Some(reached) => check_reached(&space, &left, &right, &claim.factor.0, reached),
        None => Ok(()),
    }
}

fn check_combined(
    space: &Space,
    left: &[Form],
    right: &[Form],
    factor: &BigRational,
    step: &Combined,
) -> Outcome<()> {
    let rule = Rule::Combined;
    ensure!(step.multipliers.len() == left.len(), rule, "not one list for each left side");
    for (j, (form, list)) in left.iter().zip(&step.multipliers).enumerate() {
        let increasing = list.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let within = list.iter().all(|(i, _)| *i < right.len());
        ensure!(increasing && within, rule, "left side {j}: no such right side, or not increasing");
        let cost: u64 = list.iter().map(|(i, _)| right[*i].cost()).sum();
        space.charge(2 * (form.cost() + cost) * form.limbs())?;
        let minus_one = -BigRational::from_integer(1.into());
        let mut terms: Vec<_> = list.iter().map(|(i, Number(x))| (x.clone(), &right[*i])).collect();
        terms.push((minus_one, form));
        let rest = Form::mix(space.size, &terms);
        ensure!(rest.num.iter().all(Zero::is_zero), rule, "left side {j} is not the combination");
        let sum: BigRational = list.iter().map(|(_, Number(x))| x.abs()).sum();
        let (x, y) = contrast(&sum, factor);
        ensure!(sum <= *factor, rule, "left side {j}: the multipliers' sum {x} is above {y}");
    }
    Ok(())
}

fn check_reached(
    space: &Space,
    left: &[Form],
    right: &[Form],
    factor: &BigRational,
    step: &Reached,
) -> Outcome<()> {
    let rule = Rule::Reached;
    let form = left.get(step.left).ok_or_else(|| Rejection::new(rule, "no such left side"))?;
    let (net, den) = numerators(space, &step.net, rule)?;
    // Both sides are times q > 0, at the same net and the same beta.
    let magnitudes = |form: &Form| -> Outcome<[BigRational; 2]> {
        space.charge(form.cost() * (1 + den.bits() / 64))?;
        Ok(space.ring.magnitudes(&form.at(&net, &den)))
    };
    let [least, _] = magnitudes(form)?;
    ensure!(!least.is_zero(), rule, "the left side may be 0");
    for (i, form) in right.iter().enumerate() {
        let [_, most] = magnitudes(form)?;
        let bound = factor * most;
        let (x, y) = contrast(&least, &bound);
        ensure!(least >= bound, rule, "form {i} (times q): {x} is below {y}");
    }
    Ok(())
}
