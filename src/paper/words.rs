//! Sentences about many valences.

use std::cmp::Ordering;

use super::{Claim, Enclosure, Printed, Verdict};

/// Digits of the tables.
pub const DIGITS: u32 = 6;

/// Digits of values in sentences.
pub const FINE_DIGITS: u32 = 8;

/// `3..10`, `3, 6..8`, or `none`.
pub fn ranges(valences: impl IntoIterator<Item = u32>) -> String {
    let mut runs: Vec<(u32, u32)> = Vec::new();
    for n in valences {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == n => *last = n,
            _ => runs.push((n, n)),
        }
    }
    let run = |&(first, last): &(u32, u32)| match last - first {
        0 => first.to_string(),
        1 => format!("{first}, {last}"),
        _ => format!("{first}..{last}"),
    };
    let texts: Vec<String> = runs.iter().map(run).collect();
    match texts.is_empty() {
        true => "none".into(),
        false => texts.join(", "),
    }
}

/// `sharp at n = 3, 6; loose at n = 4`.
pub fn by_verdict(verdicts: &[(u32, Verdict)]) -> String {
    let of = |verdict: Verdict| {
        let valences = verdicts.iter().filter(|(_, v)| *v == verdict);
        let valences: Vec<u32> = valences.map(|(n, _)| *n).collect();
        (!valences.is_empty()).then(|| format!("{verdict} at n = {}", ranges(valences)))
    };
    let parts: Vec<String> = Verdict::ALL.into_iter().filter_map(of).collect();
    parts.join("; ")
}

/// The gravest of the verdicts of valences; undecided if there are none.
pub fn gravest(verdicts: &[(u32, Verdict)]) -> Verdict {
    match verdicts.is_empty() {
        true => Verdict::Undecided,
        false => Verdict::gravest(verdicts.iter().map(|(_, v)| *v)),
    }
}

/// The verdict on a printed bound, given what the paper's method yields and the best bound.
///
/// A print that stands for the best bound is sharp whatever the method.
pub fn judge(printed: Printed, method: Option<&Enclosure>, best: Option<&Enclosure>) -> Verdict {
    let (Some(method), Some(best)) = (method, best) else {
        return Verdict::Undecided;
    };
    match (printed.compare(method), printed.compare(best)) {
        (None, _) => Verdict::Undecided,
        (Some(Ordering::Equal), Some(Ordering::Equal)) => Verdict::Sharp,
        (Some(Ordering::Equal), Some(Ordering::Greater)) => Verdict::Loose,
        (Some(Ordering::Equal), Some(Ordering::Less)) => Verdict::Refuted,
        (Some(Ordering::Equal), None) => Verdict::Undecided,
        (Some(_), Some(Ordering::Less)) => Verdict::Refuted,
        (Some(_), _) => Verdict::Misprint,
    }
}

/// Whether a printed decimal, taken at its word, is a bound of a constant.
pub fn bounds(printed: Printed, best: &Enclosure) -> Option<bool> {
    best.at_most(&Enclosure::exactly(printed.exact()))
}

/// A decimal, or a dash.
pub fn decimal(value: Option<&Enclosure>, digits: u32) -> String {
    value.map_or("-".into(), |value| value.decimal(digits))
}

/// `n: value` for each, joined.
pub fn list(values: impl IntoIterator<Item = (u32, String)>) -> String {
    let texts: Vec<String> = values
        .into_iter()
        .map(|(n, v)| format!("n = {n}: {v}"))
        .collect();
    texts.join(", ")
}

/// All of them true, one of them false, or undecided.
pub fn all(truths: impl IntoIterator<Item = Option<bool>>) -> Option<bool> {
    let mut every = Some(true);
    for truth in truths {
        match truth {
            Some(false) => return Some(false),
            None => every = None,
            Some(true) => (),
        }
    }
    every
}

/// As [`all`], but undecided if there is nothing to decide.
pub fn every(truths: impl IntoIterator<Item = Option<bool>>) -> Option<bool> {
    let mut truths = truths.into_iter().peekable();
    truths.peek()?;
    all(truths)
}

/// The valences at which a statement was found false.
pub fn failures(truths: &[(u32, Option<bool>)]) -> Vec<u32> {
    let failed = truths.iter().filter(|(_, truth)| *truth == Some(false));
    failed.map(|(n, _)| *n).collect()
}

/// `no exception`, or where a statement was found false or stayed open.
pub fn exceptions(truths: &[(u32, Option<bool>)]) -> String {
    let open = truths.iter().filter(|(_, truth)| truth.is_none());
    let open: Vec<u32> = open.map(|(n, _)| *n).collect();
    let failed = failures(truths);
    let mut parts = Vec::new();
    if !failed.is_empty() {
        parts.push(format!("false at n = {}", ranges(failed)));
    }
    if !open.is_empty() {
        parts.push(format!("undecided at n = {}", ranges(open)));
    }
    match parts.is_empty() {
        true => "no exception".into(),
        false => parts.join("; "),
    }
}

/// The sentence if it is true of all, else the exceptions.
pub fn if_true(truths: &[(u32, Option<bool>)], sentence: &str) -> String {
    match all(truths.iter().map(|t| t.1)) {
        Some(true) => sentence.into(),
        _ => exceptions(truths),
    }
}

/// The scope of a claim about no valence that was asked for.
pub const NOWHERE: &str = "n = none";

/// A claim without extras.
pub fn claim(
    id: &'static str,
    place: &'static str,
    statement: impl Into<String>,
    verdict: Verdict,
    found: impl Into<String>,
    scope: impl Into<String>,
) -> Claim {
    Claim {
        id,
        place,
        statement: statement.into(),
        verdict,
        found: found.into(),
        method: None,
        scope: scope.into(),
        counterexample: None,
        certificates: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Field, Rational};

    #[test]
    fn ranges_are_short() {
        assert_eq!(ranges([3, 4, 5, 6, 8, 10, 11]), "3..6, 8, 10, 11");
        assert_eq!(ranges([]), "none");
    }

    #[test]
    fn judgements() {
        let at = |p| Enclosure::exactly(Rational::ratio(p, 1000));
        let printed = Printed::new("0.50");
        let judge = |m, b| judge(printed, Some(&at(m)), Some(&at(b)));
        assert_eq!(judge(501, 500), Verdict::Sharp);
        assert_eq!(judge(501, 400), Verdict::Loose);
        assert_eq!(judge(480, 400), Verdict::Misprint);
        assert_eq!(judge(501, 600), Verdict::Refuted);
        assert_eq!(
            super::judge(printed, None, Some(&at(1))),
            Verdict::Undecided
        );
    }
}
