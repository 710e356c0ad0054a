//! The net of a word: forms in the points of the first net.

use crate::form::Form;
use crate::reject::Outcome;
use crate::scheme::{Mask, Row};
use crate::space::Space;
use crate::word::is_regular;

/// A local net.
#[derive(Clone, Debug)]
pub struct Net {
    /// The claim's valence for a word of zeros, else the regular one.
    pub valence: usize,
    points: Vec<Form>,
}

impl Net {
    /// The net of the empty word.
    pub fn first(space: &Space) -> Self {
        let points = (0..space.size).map(|i| Form::point(i, space.size)).collect();
        Self { valence: space.n, points }
    }

    /// The combination of the points that a mask says.
    pub fn apply(&self, space: &Space, mask: &Mask) -> Form {
        let terms: Vec<_> = mask.iter().map(|(p, label)| (p, &self.points[label - 1])).collect();
        Form::sum(&space.ring, space.size, &terms)
    }

    /// A difference of the points.
    pub fn difference(&self, row: &Row) -> Form {
        let terms = row.iter().map(|(i, c)| (c.clone().into(), &self.points[*i]));
        Form::mix(self.points[0].size(), &terms.collect::<Vec<_>>())
    }

    /// The elementary operations of one pass over a point, roughly.
    pub fn cost(&self) -> u64 {
        self.points[0].cost()
    }
}

/// The nets along one word, kept for the next word with the same beginning.
pub struct Path<'a> {
    space: &'a Space,
    word: Vec<u8>,
    nets: Vec<Net>,
}

impl<'a> Path<'a> {
    /// The path to the empty word.
    pub fn new(space: &'a Space) -> Self {
        Self { space, word: Vec::new(), nets: vec![Net::first(space)] }
    }

    /// The nets of all beginnings of a word, from the empty one to the word itself.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up.
    pub fn along(&mut self, word: &[u8]) -> Outcome<&[Net]> {
        let common = self.word.iter().zip(word).take_while(|(a, b)| a == b).count();
        self.word.truncate(common);
        self.nets.truncate(common + 1);
        for &letter in &word[common..] {
            let (space, parent) = (self.space, &self.nets[self.word.len()]);
            self.word.push(letter);
            let valence = space.valence(is_regular(&self.word));
            let masks = space.scheme.child(parent.valence, letter);
            let terms: usize = masks.iter().flatten().map(|(c, _)| 1 + c.num.len()).sum();
            space.charge(terms as u64 * parent.cost())?;
            let points = masks.iter().map(|mask| parent.apply(space, mask)).collect();
            self.nets.push(Net { valence, points });
        }
        Ok(&self.nets)
    }
}
