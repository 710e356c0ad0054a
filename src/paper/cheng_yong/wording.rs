//! Sentences about valences that have the same value.

use crate::paper::words::ranges;

/// The valences about which the paper says something: all but 4.
pub fn of_paper(valences: impl Iterator<Item = u32>) -> impl Iterator<Item = u32> {
    valences.filter(|&n| n != 4)
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
