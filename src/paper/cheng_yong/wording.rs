//! Sentences about valences that have the same value.

use crate::paper::words::{NOWHERE, ranges};

/// The scope of a claim about these valences; of none, so that the claim is left out.
pub fn scope(valences: impl IntoIterator<Item = u32>) -> String {
    match &*ranges(valences) {
        "none" => NOWHERE.into(),
        some => format!("N = {some}"),
    }
}

/// The same, with what else bounds it.
pub fn within(valences: impl IntoIterator<Item = u32>, also: &str) -> String {
    match scope(valences) {
        nowhere if nowhere == NOWHERE => nowhere,
        scope => format!("{scope}, {also}"),
    }
}

/// The valences of some values.
pub fn valences<T>(values: &[(u32, T)]) -> impl Iterator<Item = u32> {
    values.iter().map(|(n, _)| *n)
}

/// `9/16 at N = 3; 23/40 at N = 5`: valences with the same text together, in the order of the first.
pub fn grouped(values: impl IntoIterator<Item = (u32, String)>) -> String {
    let mut groups: Vec<(String, Vec<u32>)> = Vec::new();
    for (n, text) in values {
        match groups.iter_mut().find(|(known, _)| *known == text) {
            Some((_, valences)) => valences.push(n),
            None => groups.push((text, vec![n])),
        }
    }
    let texts: Vec<String> = groups
        .into_iter()
        .map(|(text, valences)| format!("{text} at N = {}", ranges(valences)))
        .collect();
    texts.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_texts_are_said_once() {
        let values = [(3, "a"), (4, "b"), (5, "a"), (6, "a")];
        let text = grouped(values.map(|(n, t)| (n, t.to_string())));
        assert_eq!(text, "a at N = 3, 5, 6; b at N = 4");
    }
}
