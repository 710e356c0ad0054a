//! Nets in Stam's numbering and their refinement: section 1 of FORMAT.md.

use crate::form::Form;
use crate::polynomial::Polynomial;
use crate::rational::ratio;
use crate::reject::Outcome;
use crate::space::Space;

/// The label in a local net of valence 6 of each of the regular points p1..p12.
pub const REGULAR: [usize; 12] = [4, 5, 3, 1, 6, 10, 2, 7, 12, 9, 8, 11];

/// The ring of label 1, 2 or n + 1, in order; empty for the other labels.
pub fn ring(n: usize, label: usize) -> Vec<usize> {
    match label {
        1 => (2..=n + 1).collect(),
        2 => vec![1, n + 1, n + 2, n + 3, n + 4, 3],
        _ if label == n + 1 => vec![1, 2, n + 2, n + 5, n + 6, n],
        _ => Vec::new(),
    }
}

/// The neighbours of b in the ring of a (b itself, should it not be there).
pub fn opposite(n: usize, a: usize, b: usize) -> [usize; 2] {
    let ring = ring(n, a);
    let at = ring.iter().position(|&label| label == b);
    at.map_or([b, b], |i| [i + ring.len() - 1, i + 1].map(|i| ring[i % ring.len()]))
}

/// The edges (a, b) of the n + 9 second differences, in order.
pub fn edges(n: usize) -> Vec<(usize, usize)> {
    let first = (2..=n + 1).map(|b| (1, b));
    let second = [n + 1, n + 2, n + 3, n + 4, 3].map(|b| (2, b));
    let third = [n, n + 6, n + 5, n + 2].map(|b| (n + 1, b));
    first.chain(second).chain(third).collect()
}

/// The labels in the extended net of the points p1..p12 of tile 1, 2 or 3.
pub fn tile(n: usize, letter: u8) -> [usize; 12] {
    let e = |i: usize| n + i;
    match letter {
        1 => [3, 1, e(4), 2, e(1), e(7), e(3), e(2), e(5), e(8), e(9), e(10)],
        2 => [e(10), e(9), e(5), e(2), e(3), e(6), e(1), 2, e(4), n, 1, 3],
        _ => [1, n, 2, e(1), e(6), e(3), e(2), e(5), e(12), e(9), e(10), e(11)],
    }
}

/// The net of a word: forms in the points of the first net, by label.
#[derive(Clone, Debug)]
pub struct Net {
    /// The valence of label 1.
    pub valence: usize,
    /// False if the word has zeros only.
    pub regular: bool,
    beta: Polynomial,
    points: Vec<Form>,
}

impl Net {
    /// The net of the empty word.
    pub fn first(space: &Space) -> Self {
        let points = (0..space.size).map(|i| Form::point(i, space.size)).collect();
        Self { valence: space.n, regular: false, beta: space.beta.value.clone(), points }
    }

    /// The point with a label, from 1 to valence + 6.
    pub fn point(&self, label: usize) -> &Form {
        &self.points[label - 1]
    }

    /// `Σ p point(label)` over the terms (p, label).
    pub fn sum(&self, terms: &[(&Polynomial, usize)]) -> Form {
        let terms: Vec<_> = terms.iter().map(|&(p, label)| (p, self.point(label))).collect();
        Form::sum(self.point(1).size(), &terms)
    }

    /// `centre point(label) + share (the sum of its ring)`.
    pub fn star(&self, label: usize, centre: &Polynomial, share: &Polynomial) -> Form {
        let ring = ring(self.valence, label).into_iter().map(|i| (share, i));
        self.sum(&ring.chain([(centre, label)]).collect::<Vec<_>>())
    }

    /// `ends (a + b) + sides (c + d)`, c and d the neighbours of b in the ring of a.
    fn diamond(&self, (a, b): (usize, usize), ends: &Polynomial, sides: &Polynomial) -> Form {
        let [c, d] = opposite(self.valence, a, b);
        self.sum(&[(ends, a), (ends, b), (sides, c), (sides, d)])
    }

    /// All second differences, in order.
    pub fn differences(&self) -> Vec<Form> {
        let (plus, minus) = (Polynomial::integer(1), Polynomial::integer(-1));
        let difference = |edge| self.diamond(edge, &plus, &minus);
        edges(self.valence).into_iter().map(difference).collect()
    }

    /// The new point of a vertex whose ring has the weight beta, and size points.
    fn vertex(&self, label: usize, beta: &Polynomial, size: usize) -> Form {
        let centre = &Polynomial::integer(1) - beta;
        self.star(label, &centre, &beta.scale(&ratio(1, size as i64)))
    }

    /// The point of the extended net of the next level with a label from 1 to valence + 12.
    fn refined(&self, label: usize) -> Form {
        let n = self.valence;
        let mask = [ratio(3, 8), ratio(1, 8)].map(|x| Polynomial::constant(&x));
        let edge = |edge| self.diamond(edge, &mask[0], &mask[1]);
        match label.checked_sub(n + 2) {
            None if label == 1 => self.vertex(1, &self.beta, n),
            None => edge((1, label)),
            Some(1) => self.vertex(2, &mask[0], 6),
            Some(3) => self.vertex(n + 1, &mask[0], 6),
            Some(0) => edge((2, n + 1)),
            Some(2) => edge((2, 3)),
            Some(4) => edge((n + 1, n)),
            Some(5) => edge((2, n + 4)),
            Some(6) => edge((2, n + 3)),
            Some(7) => edge((2, n + 2)),
            Some(8) => edge((n + 1, n + 2)),
            Some(9) => edge((n + 1, n + 5)),
            Some(_) => edge((n + 1, n + 6)),
        }
    }

    /// The net of the word with one letter more.
    pub fn child(&self, letter: u8) -> Self {
        if letter == 0 {
            let points = (1..=self.valence + 6).map(|label| self.refined(label)).collect();
            return Self { points, ..self.clone() };
        }
        // The tile's points, in the order of their labels in the new net.
        let mut tile: Vec<_> = REGULAR.into_iter().zip(tile(self.valence, letter)).collect();
        tile.sort_unstable();
        let points = tile.into_iter().map(|(_, label)| self.refined(label)).collect();
        let beta = Polynomial::constant(&ratio(3, 8));
        Self { valence: 6, regular: true, beta, points }
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
            let parent = &self.nets[self.word.len()];
            self.space.charge(6 * (parent.valence as u64 + 12) * parent.point(1).cost())?;
            let child = parent.child(letter);
            self.nets.push(child);
            self.word.push(letter);
        }
        Ok(&self.nets)
    }
}
