//! Nets in Stam's numbering, their refinement, words: section 1 of FORMAT.md.

use crate::form::Form;
use crate::polynomial::Polynomial;
use crate::rational::ratio;
use crate::reject::Outcome;
use crate::space::Space;

/// Label i of a local net of valence 6 for the regular points p1..p12.
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

/// The neighbours of b in the ring of a; b itself if it is not in the ring.
pub fn opposite(n: usize, a: usize, b: usize) -> [usize; 2] {
    let ring = ring(n, a);
    let Some(i) = ring.iter().position(|&x| x == b) else {
        return [b, b];
    };
    let cyclic = |i: usize| ring.get(i % ring.len()).copied().unwrap_or(b);
    [cyclic(i + ring.len() - 1), cyclic(i + 1)]
}

/// The edges (a, b) of the n + 9 second differences, in order.
pub fn edges(n: usize) -> Vec<(usize, usize)> {
    let spokes = (2..=n + 1).map(|b| (1, b));
    let second = [n + 1, n + 2, n + 3, n + 4, 3].map(|b| (2, b));
    let third = [n, n + 6, n + 5, n + 2].map(|b| (n + 1, b));
    spokes.chain(second).chain(third).collect()
}

/// The labels of the extended net that are the points p1..p12 of tile 1, 2 or 3.
pub fn tile(n: usize, letter: u8) -> [usize; 12] {
    match letter {
        1 => [
            3,
            1,
            n + 4,
            2,
            n + 1,
            n + 7,
            n + 3,
            n + 2,
            n + 5,
            n + 8,
            n + 9,
            n + 10,
        ],
        2 => [
            n + 10,
            n + 9,
            n + 5,
            n + 2,
            n + 3,
            n + 6,
            n + 1,
            2,
            n + 4,
            n,
            1,
            3,
        ],
        _ => [
            1,
            n,
            2,
            n + 1,
            n + 6,
            n + 3,
            n + 2,
            n + 5,
            n + 12,
            n + 9,
            n + 10,
            n + 11,
        ],
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
        let points = (0..space.size)
            .map(|i| Form::point(i, space.size))
            .collect();
        Self {
            valence: space.n,
            regular: false,
            beta: space.beta.value.clone(),
            points,
        }
    }

    /// The point with a label from 1 to valence + 6.
    pub fn point(&self, label: usize) -> &Form {
        &self.points[label - 1]
    }

    /// The point p_j, j from 1 to 12, of a net of valence 6.
    pub fn regular_point(&self, j: usize) -> &Form {
        self.point(REGULAR[j - 1])
    }

    /// `Σ p_i point(label_i)`.
    pub fn sum(&self, terms: &[(&Polynomial, usize)]) -> Form {
        let terms: Vec<_> = terms
            .iter()
            .map(|&(p, label)| (p, self.point(label)))
            .collect();
        Form::sum(self.point(1).num.len() / self.point(1).width, &terms)
    }

    /// The second difference over the edge (a, b).
    pub fn difference(&self, (a, b): (usize, usize)) -> Form {
        let [c, d] = opposite(self.valence, a, b);
        let (plus, minus) = (Polynomial::integer(1), Polynomial::integer(-1));
        self.sum(&[(&plus, a), (&plus, b), (&minus, c), (&minus, d)])
    }

    /// All second differences, in order.
    pub fn differences(&self) -> Vec<Form> {
        edges(self.valence)
            .into_iter()
            .map(|edge| self.difference(edge))
            .collect()
    }

    /// `(1 - weight) point(label) + weight (mean of its ring)`.
    pub fn vertex(&self, label: usize, weight: &Polynomial) -> Form {
        let ring = ring(self.valence, label);
        let centre = &Polynomial::integer(1) - weight;
        let share = weight.scale(&ratio(1, ring.len() as i64));
        let terms: Vec<_> = ring
            .iter()
            .map(|&i| (&share, i))
            .chain([(&centre, label)])
            .collect();
        self.sum(&terms)
    }

    fn edge(&self, a: usize, b: usize) -> Form {
        let [c, d] = opposite(self.valence, a, b);
        let (end, side) = (
            Polynomial::constant(&ratio(3, 8)),
            Polynomial::constant(&ratio(1, 8)),
        );
        self.sum(&[(&end, a), (&end, b), (&side, c), (&side, d)])
    }

    /// A point of the extended net of the next level.
    fn refined(&self, label: usize) -> Form {
        let n = self.valence;
        let regular = Polynomial::constant(&ratio(3, 8));
        match label {
            1 => self.vertex(1, &self.beta),
            _ if label <= n + 1 => self.edge(1, label),
            _ => match label - n {
                2 => self.edge(2, n + 1),
                3 => self.vertex(2, &regular),
                4 => self.edge(2, 3),
                5 => self.vertex(n + 1, &regular),
                6 => self.edge(n + 1, n),
                7 => self.edge(2, n + 4),
                8 => self.edge(2, n + 3),
                9 => self.edge(2, n + 2),
                10 => self.edge(n + 1, n + 2),
                11 => self.edge(n + 1, n + 5),
                _ => self.edge(n + 1, n + 6),
            },
        }
    }

    /// The net of the word with one letter more.
    pub fn child(&self, letter: u8) -> Self {
        if letter == 0 {
            let points = (1..=self.valence + 6)
                .map(|label| self.refined(label))
                .collect();
            return Self {
                points,
                ..self.clone()
            };
        }
        let mut points: Vec<_> = REGULAR
            .into_iter()
            .zip(tile(self.valence, letter))
            .collect();
        points.sort_unstable(); // by the label in the new net
        let points = points
            .into_iter()
            .map(|(_, label)| self.refined(label))
            .collect();
        Self {
            valence: 6,
            regular: true,
            beta: Polynomial::constant(&ratio(3, 8)),
            points,
        }
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
        Self {
            space,
            word: Vec::new(),
            nets: vec![Net::first(space)],
        }
    }

    /// The nets of all beginnings of a word, from the empty one to the word.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up.
    pub fn along(&mut self, word: &[u8]) -> Outcome<&[Net]> {
        let common = self
            .word
            .iter()
            .zip(word)
            .take_while(|(a, b)| a == b)
            .count();
        self.word.truncate(common);
        self.nets.truncate(common + 1);
        for &letter in &word[common..] {
            let parent = &self.nets[self.word.len()];
            self.space
                .charge(6 * (parent.valence as u64 + 12) * parent.point(1).cost())?;
            let child = parent.child(letter);
            self.nets.push(child);
            self.word.push(letter);
        }
        Ok(&self.nets)
    }
}
