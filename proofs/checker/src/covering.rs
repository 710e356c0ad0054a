//! Coverings: the cells, their mirror images and the tail's word fill the whole, and none is superfluous.

use std::collections::{HashMap, HashSet};

use crate::reject::{Outcome, Rule, ensure};
use crate::word::{is_regular, mirrored};

/// The most cells of a step.
const CELLS: usize = 1 << 16;

/// Shows that the cells cover the word `whole`, apart from the word `tail`, both of zeros.
///
/// # Errors
///
/// If and only if they do not, or a cell takes no part: rule `covering`.
pub fn check(whole: &[u8], tail: &[u8], cells: &[&[u8]]) -> Outcome<()> {
    let rule = Rule::Covering;
    ensure!(cells.len() <= CELLS, Rule::Format, "more than {CELLS} cells in a step");
    let mut places = HashMap::new();
    for (i, &word) in cells.iter().enumerate() {
        ensure!(is_regular(word), rule, "cell {}: a word of zeros only", text(word));
        let image = mirrored(word);
        let twice = places.contains_key(word) || places.contains_key(&image);
        ensure!(!twice, rule, "cell {} is there twice", text(word));
        places.insert(word.to_vec(), i);
        places.insert(image, i);
    }
    let words = places.keys().map(Vec::as_slice).chain([tail]);
    let beginnings: HashSet<_> =
        words.flat_map(|word| (0..word.len()).map(|i| &word[..i])).collect();
    let mut used = vec![false; cells.len()];
    let mut open = vec![whole.to_vec()];
    // Each word taken up is covered itself, or all four parts of it are put up.
    while let Some(word) = open.pop() {
        if word == tail {
            continue;
        }
        if let Some(&i) = places.get(&word) {
            used[i] = true;
            continue;
        }
        ensure!(beginnings.contains(&word[..]), rule, "the word {} is not covered", text(&word));
        open.extend((0..4).map(|letter| [&word[..], &[letter]].concat()));
    }
    let idle = cells.iter().zip(used).find(|(_, used)| !used);
    ensure!(
        idle.is_none(),
        rule,
        "cell {} is superfluous",
        text(idle.map_or(&[], |(word, _)| word))
    );
    Ok(())
}

/// A word as it is written.
pub fn text(word: &[u8]) -> String {
    format!("{:?}", word.iter().map(|&letter| char::from(b'0' + letter)).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covers(whole: usize, tail: usize, words: &[&str]) -> bool {
        let words: Vec<Vec<u8>> =
            words.iter().map(|word| word.bytes().map(|b| b - b'0').collect()).collect();
        check(&vec![0; whole], &vec![0; tail], &words.iter().map(Vec::as_slice).collect::<Vec<_>>())
            .is_ok()
    }

    #[test]
    fn coverings_with_mirror_images() {
        assert!(covers(0, 1, &["1", "2"]));
        assert!(covers(0, 1, &["3", "2"]));
        assert!(covers(0, 1, &["1", "20", "21", "22"]));
        assert!(covers(0, 2, &["1", "2", "02", "03"]));
        assert!(covers(1, 2, &["01", "02"]));
        assert!(covers(0, 0, &[]));
        assert!(covers(0, 1, &["10", "11", "12", "13", "2"]));
        assert!(covers(0, 1, &["10", "11", "12", "31", "2"]));
    }

    #[test]
    fn gaps_and_idle_cells() {
        assert!(!covers(0, 1, &["1"]));
        assert!(!covers(0, 1, &["1", "2", "3"]));
        assert!(!covers(0, 1, &["1", "2", "2"]));
        assert!(!covers(0, 1, &["1", "2", "20"]));
        assert!(!covers(0, 1, &["1", "2", "30"]));
        assert!(!covers(0, 1, &["1", "20", "21"]));
        assert!(!covers(0, 1, &["1", "2", "01"]));
        assert!(!covers(1, 2, &["1", "01", "02"]));
        assert!(!covers(0, 40, &["1", "2"]));
        assert!(!covers(0, 1, &["10", "11", "12", "2"]));
        assert!(!covers(0, 1, &[]));
    }
}
