//! The nets of words, and the targets: what S - F is as a functional of the first net.

use std::collections::HashMap;

use super::arithmetic::Arithmetic;
use super::rules::Rules;
use super::shape::Shape;
use super::word::Word;
use crate::scalar::Field;

/// Which mesh the surface is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Against {
    /// The level-k control mesh.
    Control,
    /// The level-k limit mesh.
    Limit,
}

/// The net of a word.
#[derive(Clone, Debug)]
pub enum Net<V> {
    /// The local net round the extraordinary corner.
    Extraordinary(Vec<V>),
    /// A regular net, in the order in which patches take it.
    Regular(Vec<V>),
}

/// The nets of words in an arithmetic, each computed once.
#[derive(Debug)]
pub struct Nets<A: Arithmetic> {
    arithmetic: A,
    rules: Box<dyn Rules<A>>,
    /// By word: the level-1 points of its net, from which its four children are picked.
    refined: HashMap<Word, Vec<A::V>>,
    nets: HashMap<Word, Net<A::V>>,
}

impl<A: Arithmetic> Nets<A> {
    /// The first net only.
    pub fn new(arithmetic: A, rules: Box<dyn Rules<A>>) -> Self {
        let size = rules.layout().size;
        let first = (0..size).map(|i| arithmetic.unit(size, i)).collect();
        Nets {
            arithmetic,
            rules,
            refined: HashMap::new(),
            nets: HashMap::from([(Word::EMPTY, Net::Extraordinary(first))]),
        }
    }

    /// The rules of the scheme.
    pub fn rules(&self) -> &dyn Rules<A> {
        &*self.rules
    }

    fn shape(&self) -> Shape {
        self.rules.layout().shape
    }

    /// The net of a word.
    pub fn net(&mut self, word: Word) -> &Net<A::V> {
        if !self.nets.contains_key(&word) {
            let made = self.make(word);
            self.nets.insert(word, made);
        }
        &self.nets[&word]
    }

    fn make(&mut self, word: Word) -> Net<A::V> {
        let (parent, letter) = word.split_last().expect("the first net is there");
        let net = self.net(parent).clone();
        let rules = &self.rules;
        let refined = self.refined.entry(parent).or_insert_with(|| {
            let (valence, local) = rules.local(&net);
            let extraordinary = matches!(net, Net::Extraordinary(_));
            rules.refine(&self.arithmetic, extraordinary, valence, &local)
        });
        rules.child(&net, letter, refined)
    }

    /// The factor times the corner values of F_0 of the net of a word, over the word or, where the root
    /// has a letter, over its quarter `letter`.
    fn mesh_corners(&mut self, word: Word, letter: u8, against: Against) -> Vec<A::V> {
        let net = self.net(word).clone();
        self.rules.mesh(&self.arithmetic, &net, letter, against)
    }

    /// The factor times F_k at the corners of a word of the root with at least k letters more.
    pub fn mesh_at_corners(&mut self, word: Word, against: Against, k: usize) -> Vec<A::V> {
        let piece = k + self.rules.layout().root.len();
        let letter = if piece > k { word.letter(k) } else { 0 };
        let mesh = self.mesh_corners(word.prefix(k), letter, against);
        if word.len() == piece {
            return mesh;
        }
        let (shape, side) = (self.shape(), 1i64 << (word.len() - piece));
        let corners = word.corners_within(shape, piece);
        (corners.into_iter())
            .map(|corner| shape.interpolate::<A::S, A::V>(&mesh, corner, side))
            .collect()
    }

    /// The factor times the Bernstein coefficients of S - F_k over a regular word; at the regular valence
    /// any word.
    pub fn target(&mut self, word: Word, against: Against, k: usize) -> Vec<A::V> {
        let net = self.net(word).clone();
        let points = self.rules.regular(&net);
        let points = points.unwrap_or_else(|| panic!("S is not polynomial over the word {word}"));
        let mesh = self.mesh_at_corners(word, against, k);
        let mesh = self.shape().raise::<A::S, A::V>(&mesh);
        let surface = self.rules.surface(&points);
        let difference = |(s, f): (&A::V, &A::V)| self.scale(s) - f;
        surface.iter().zip(&mesh).map(difference).collect()
    }

    /// The factor times the Bernstein coefficients of `t - (1 - mu) t_0` over a regular word, each divided
    /// by mu at its node; t = S - F_0 against the control mesh, t_0 its value at the extraordinary
    /// corner, mu the ramp of the root's `0^depth`.
    pub fn linear_target(&mut self, word: Word, depth: usize) -> Vec<A::V> {
        let corner = self.corner_target(Against::Control, 0);
        let (shape, start) = (self.shape(), self.rules.layout().root.len() + depth);
        let side = 1i64 << (word.len() - start);
        let corners = word.corners_within(shape, start);
        let ramps: Vec<i64> = (corners.iter())
            .map(|&corner| shape.ramp(corner, side).0)
            .collect();
        let whole = shape.ramp([0, 0], side).1;
        let degree = shape.degree() as i64;
        let target = self.target(word, Against::Control, 0);
        let divided = |(at, t): (usize, A::V)| {
            let (weights, sum) = shape.interpolation(shape.node(at), degree);
            let mu: i64 = weights.iter().zip(&ramps).map(|(w, r)| w * r).sum();
            let whole = whole * sum;
            let rest = corner.clone() * &A::S::ratio(whole - mu, whole);
            (t - &rest) * &A::S::ratio(whole, mu)
        };
        target.into_iter().enumerate().map(divided).collect()
    }

    /// The factor times S at the extraordinary corner of a word of zeros.
    fn limit(&mut self, word: Word) -> A::V {
        let Net::Extraordinary(points) = self.net(word).clone() else {
            panic!("the word {word} is regular")
        };
        self.rules.limit(&self.arithmetic, &points)
    }

    /// The factor times S - F_k at the extraordinary corner.
    pub fn corner_target(&mut self, against: Against, k: usize) -> A::V {
        let word = Word::zeros(k);
        let mesh = self.mesh_corners(word, 0, against);
        self.limit(word) - &mesh[0]
    }

    /// The differences of a word's net, as functionals of the first net (no factor).
    pub fn differences(&mut self, word: Word) -> Vec<A::V> {
        let net = self.net(word).clone();
        let (valence, local) = self.rules.local(&net);
        let rows = self.rules.differences(valence);
        (rows.iter())
            .map(|row| row.apply::<A::S, A::V>(&local))
            .collect()
    }

    /// One of the differences of a word's net.
    pub fn difference(&mut self, word: Word, l: usize) -> A::V {
        let net = self.net(word).clone();
        let (valence, local) = self.rules.local(&net);
        self.rules.differences(valence)[l].apply::<A::S, A::V>(&local)
    }

    /// The factor times a functional.
    pub fn scale(&self, functional: &A::V) -> A::V {
        self.rules.scale(&self.arithmetic, functional)
    }

    /// The factor times the corner values on the root of F_0 of the extraordinary net of a level.
    pub fn root_corners(&mut self, level: usize) -> Vec<A::V> {
        self.mesh_corners(Word::zeros(level), 0, Against::Control)
    }
}
