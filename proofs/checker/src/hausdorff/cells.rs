//! Words of parts: whether they cover a whole, and a walk through them in which words with a common beginning share
//! what it leads to.

use super::facets::{Patch, quarter};
use super::part::Part;
use super::polygon_mesh::Vector;
use super::refine::{Finer, Rules};
use crate::covering::text;
use crate::reject::{Outcome, Rejection, Rule, ensure};

/// A word, and the index of the cell that it is of.
pub type Named<'a> = (&'a [u8], usize);

/// Shows that the words, in order, cover the whole: each part of it is one of them, or else its children are covered.
/// `first` is the number of children of the whole; all others have four.
///
/// # Errors
///
/// If and only if they do not, or one is superfluous: the rule.
pub fn check_cover(words: &[Named], depth: usize, first: usize, rule: Rule) -> Outcome<()> {
    let Some(&(word, index)) = words.first() else {
        return Err(Rejection::new(rule, "the parts do not cover"));
    };
    if word.len() == depth {
        ensure!(words.len() == 1, rule, "a part of cell {index}, {}, is there twice", text(word));
        return Ok(());
    }
    let mut rest = words;
    for letter in 0..first {
        let count = rest.partition_point(|(word, _)| usize::from(word[depth]) <= letter);
        let (now, later) = rest.split_at(count);
        let part = || format!("the part {}{letter} is not covered", text(&word[..depth]));
        ensure!(!now.is_empty(), rule, "{}", part());
        check_cover(now, depth + 1, 4, rule)?;
        rest = later;
    }
    let beyond = rest.first().map_or(0, |(_, index)| *index);
    ensure!(rest.is_empty(), rule, "cell {beyond}: no such word");
    Ok(())
}

/// What words lead to, letter by letter.
pub trait Node: Sized {
    /// What the children have in common.
    type Step;
    fn step(&self, rules: &Rules) -> Self::Step;
    fn child(&self, rules: &Rules, step: &Self::Step, letter: u8) -> Option<Self>;
}

/// Visits the node of each word; the words are in order.
///
/// # Errors
///
/// If there is no such word: the rule; or the first that a visit returns.
pub fn walk<N: Node>(
    node: &N,
    rules: &Rules,
    depth: usize,
    words: &[Named],
    rule: Rule,
    visit: &mut impl FnMut(&N, usize) -> Outcome<()>,
) -> Outcome<()> {
    let here = words.partition_point(|(word, _)| word.len() == depth);
    for (_, index) in &words[..here] {
        visit(node, *index)?;
    }
    let mut rest = &words[here..];
    if rest.is_empty() {
        return Ok(());
    }
    let step = node.step(rules);
    while let Some(&(word, index)) = rest.first() {
        let letter = word[depth];
        let (now, later) = rest.split_at(rest.partition_point(|(word, _)| word[depth] <= letter));
        let missing = || Rejection::new(rule, format!("cell {index}: no such word"));
        let child = node.child(rules, &step, letter).ok_or_else(missing)?;
        walk(&child, rules, depth + 1, now, rule, visit)?;
        rest = later;
    }
    Ok(())
}

/// A part of the surface, with the corners of F over it if F is a mesh of the surface's own.
pub struct Piece {
    pub part: Part,
    pub own: Option<Vec<Vector>>,
}

impl Node for Piece {
    type Step = Finer;

    fn step(&self, rules: &Rules) -> Finer {
        rules.step(&self.part.net)
    }

    fn child(&self, rules: &Rules, step: &Finer, letter: u8) -> Option<Self> {
        let index = usize::from(letter);
        if !rules.letters(self.part.corners()).contains(&index) {
            return None;
        }
        let own = self.own.as_deref().map(|own| match own {
            &[a, b, c] if rules.is_loop() => {
                Patch::Triangle([a, b, c]).child(letter).corners().to_vec()
            }
            _ => quarter(own, index).to_vec(),
        });
        Some(Self { part: self.part.child(step, index)?, own })
    }
}

impl Node for Patch {
    type Step = ();

    fn step(&self, _: &Rules) {}

    fn child(&self, _: &Rules, (): &(), letter: u8) -> Option<Self> {
        (letter < 4).then(|| self.child(letter))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covers(first: usize, words: &[&str]) -> bool {
        let mut words: Vec<Vec<u8>> =
            words.iter().map(|word| word.bytes().map(|b| b - b'0').collect()).collect();
        words.sort_unstable();
        let named: Vec<Named> = words.iter().zip(0..).map(|(word, i)| (&word[..], i)).collect();
        check_cover(&named, 0, first, Rule::NearMesh).is_ok()
    }

    #[test]
    fn coverings() {
        assert!(covers(4, &[""]) && covers(5, &[""]));
        assert!(covers(4, &["0", "1", "3", "20", "21", "22", "23"]));
        assert!(covers(5, &["4", "1", "3", "2", "00", "03", "02", "01"]));
        assert!(covers(3, &["0", "1", "2"]));
    }

    #[test]
    fn gaps_and_idle_cells() {
        assert!(!covers(4, &[]) && !covers(4, &["", ""]) && !covers(4, &["", "0"]));
        assert!(!covers(4, &["0", "1", "2"]) && !covers(5, &["0", "1", "2", "3"]));
        assert!(!covers(3, &["0", "1", "2", "3"]) && !covers(4, &["0", "1", "2", "3", "4"]));
        assert!(!covers(4, &["0", "1", "2", "3", "3"]) && !covers(4, &["0", "1", "2", "3", "30"]));
        assert!(!covers(4, &["0", "1", "2", "30", "31", "32"]));
        assert!(!covers(5, &["0", "1", "2", "3", "40", "41", "42", "43", "44"]));
    }
}
