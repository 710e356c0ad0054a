//! The nets of words, and the targets: what S - F is as a functional of the first net.

use std::collections::HashMap;

use num_traits::Zero;

use super::functional::{ExactFunctional, FloatFunctional, Integer};
use super::word::{Word, tile};
use crate::bernstein::from_net::box_spline;
use crate::bernstein::triangle::QuarticTriangle;
use crate::scalar::{Field, Module, ShortRational};
use crate::scheme::loop_scheme::{self, REGULAR_LABELS};
use crate::scheme::{IntegerRow, LoopWeights};

/// Which mesh the surface is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Against {
    /// The level-k control mesh.
    Control,
    /// The level-k limit mesh.
    Limit,
}

/// An arithmetic for nets of functionals.
///
/// Targets come multiplied by a positive factor: q = 3 + 8 n b in exact arithmetic, so that all of
/// them are polynomials in b; 1 in floats.
pub trait Space: Sync {
    /// Coefficients of the masks.
    type S: Field;
    /// Functionals.
    type V: Module<Self::S> + Send + Sync;
    /// The valence.
    fn valence(&self) -> u32;
    /// The coordinate functional `point` (from 0) of the first net.
    fn unit(&self, point: usize) -> Self::V;
    /// The vertex point of the extraordinary vertex.
    fn vertex(&self, center: &Self::V, ring_sum: &Self::V) -> Self::V;
    /// The factor times the limit point of the extraordinary vertex.
    fn limit(&self, center: &Self::V, ring_sum: &Self::V) -> Self::V;
    /// The factor times a functional.
    fn scale(&self, functional: &Self::V) -> Self::V;
}

/// `f64`: proposals.
#[derive(Clone, Debug)]
pub struct Floats {
    n: u32,
    vertex: crate::scheme::StarMask<f64>,
    limit: crate::scheme::StarMask<f64>,
}

impl Floats {
    /// For Loop's scheme at valence n >= 3.
    pub fn new(weights: LoopWeights, n: u32) -> Self {
        let known = "f64 has every cosine";
        Floats {
            n,
            vertex: loop_scheme::vertex_mask(weights, n).expect(known),
            limit: loop_scheme::limit_mask(weights, n).expect(known),
        }
    }
}

impl Space for Floats {
    type S = f64;
    type V = FloatFunctional;

    fn valence(&self) -> u32 {
        self.n
    }
    fn unit(&self, point: usize) -> FloatFunctional {
        let mut unit = vec![0.0; loop_scheme::local_net_size(self.n)];
        unit[point] = 1.0;
        FloatFunctional(unit)
    }
    fn vertex(&self, center: &FloatFunctional, ring_sum: &FloatFunctional) -> FloatFunctional {
        self.vertex.apply_ring(center, ring_sum)
    }
    fn limit(&self, center: &FloatFunctional, ring_sum: &FloatFunctional) -> FloatFunctional {
        self.limit.apply_ring(center, ring_sum)
    }
    fn scale(&self, functional: &FloatFunctional) -> FloatFunctional {
        functional.clone()
    }
}

/// Exact, for every ring weight b at once.
///
/// `v = P + b (Σ P_i - n P)`, and with q = 3 + 8 n b the limit mask of
/// [`loop_scheme::limit_mask`] is `q v_∞ = 3 P + 8 b Σ P_i`.
#[derive(Clone, Debug)]
pub struct Exact<T> {
    n: u32,
    integers: std::marker::PhantomData<T>,
}

impl<T> Exact<T> {
    /// For Loop's scheme at valence n >= 3, any weights.
    pub fn new(n: u32) -> Self {
        Exact {
            n,
            integers: std::marker::PhantomData,
        }
    }
}

impl<T: Integer> Space for Exact<T> {
    type S = ShortRational;
    type V = ExactFunctional<T>;

    fn valence(&self) -> u32 {
        self.n
    }
    fn unit(&self, point: usize) -> Self::V {
        ExactFunctional::unit(loop_scheme::local_net_size(self.n), point)
    }
    fn vertex(&self, center: &Self::V, ring_sum: &Self::V) -> Self::V {
        let n = ShortRational::from_integer(i64::from(self.n));
        let pull = ring_sum.clone() - &(center.clone() * &n);
        center.clone() + &pull.times_weight()
    }
    fn limit(&self, center: &Self::V, ring_sum: &Self::V) -> Self::V {
        let integer = ShortRational::from_integer;
        center.clone() * &integer(3) + &(ring_sum.times_weight() * &integer(8))
    }
    fn scale(&self, functional: &Self::V) -> Self::V {
        let integer = ShortRational::from_integer;
        let eight_n = integer(8 * i64::from(self.n));
        functional.clone() * &integer(3) + &(functional.times_weight() * &eight_n)
    }
}

/// The net of a word.
#[derive(Clone, Debug)]
pub enum Net<V> {
    /// n + 6 points round the extraordinary vertex.
    Extraordinary(Vec<V>),
    /// p1..p12.
    Regular(Box<[V; 12]>),
}

impl<V: Clone> Net<V> {
    /// The net as a local net, with its valence.
    pub fn local(&self, n: u32) -> (u32, Vec<V>) {
        match self {
            Net::Extraordinary(points) => (n, points.clone()),
            Net::Regular(points) => {
                let mut local = points.to_vec();
                for (point, label) in points.iter().zip(REGULAR_LABELS) {
                    local[label - 1] = point.clone();
                }
                (6, local)
            }
        }
    }

    /// The points at the corners of the face.
    fn corners(&self, n: u32) -> [V; 3] {
        match self {
            Net::Extraordinary(p) => [&p[0], &p[1], &p[n as usize]].map(V::clone),
            Net::Regular(p) => [&p[3], &p[6], &p[7]].map(V::clone),
        }
    }
}

/// The nets of words in an arithmetic, each computed once.
#[derive(Debug)]
pub struct Nets<A: Space> {
    /// The arithmetic.
    pub space: A,
    /// By word: the extended net of level 1 within it, from which its four children are picked.
    extended: HashMap<Word, Vec<A::V>>,
    nets: HashMap<Word, Net<A::V>>,
}

impl<A: Space> Nets<A> {
    /// The first net only.
    pub fn new(space: A) -> Self {
        let size = loop_scheme::local_net_size(space.valence());
        let first = Net::Extraordinary((0..size).map(|i| space.unit(i)).collect());
        Nets {
            space,
            extended: HashMap::new(),
            nets: HashMap::from([(Word::EMPTY, first)]),
        }
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
        let n = self.space.valence();
        let (valence, local) = self.net(parent).local(n);
        if !self.extended.contains_key(&parent) {
            let extended = if parent.is_extraordinary() {
                let space = &self.space;
                let rule = |center: &A::V, sum: &A::V| space.vertex(center, sum);
                loop_scheme::extended_net_by::<A::S, A::V>(n, &local, rule)
            } else {
                loop_scheme::extended_net::<A::S, A::V>(LoopWeights::Warren, 6, &local)
                    .expect("the weight of valence 6 is rational")
            };
            self.extended.insert(parent, extended);
        }
        let extended = &self.extended[&parent];
        match tile(letter) {
            Some(tile) => Net::Regular(Box::new(loop_scheme::tile_net(valence, tile, extended))),
            None if parent.is_extraordinary() => {
                Net::Extraordinary(extended[..loop_scheme::local_net_size(n)].to_vec())
            }
            None => Net::Regular(Box::new(REGULAR_LABELS.map(|l| extended[l - 1].clone()))),
        }
    }

    /// The factor times the values at the corners of a word of the mesh of that word's level.
    fn mesh_corners(&mut self, word: Word, against: Against) -> [A::V; 3] {
        let n = self.space.valence();
        let net = self.net(word).clone();
        match against {
            Against::Control => net.corners(n).map(|p| self.space.scale(&p)),
            Against::Limit => match &net {
                Net::Regular(points) => {
                    let bezier = box_spline::<A::S, A::V>(points).0;
                    [0, 10, 14].map(|i| self.space.scale(&bezier[i]))
                }
                Net::Extraordinary(points) => {
                    let sum = |center| {
                        let ring = loop_scheme::ring(n, center).expect("a corner has a ring");
                        ring.iter()
                            .fold(<A::V as Zero>::zero(), |s, &i| s + &points[i - 1])
                    };
                    let regular = loop_scheme::limit_mask::<A::S>(LoopWeights::Warren, 6)
                        .expect("the weight of valence 6 is rational");
                    let last = n as usize + 1;
                    let at = |label: usize| {
                        let limit = regular.apply_ring(&points[label - 1], &sum(label));
                        self.space.scale(&limit)
                    };
                    [self.space.limit(&points[0], &sum(1)), at(2), at(last)]
                }
            },
        }
    }

    /// The factor times F_k at the corners of a word of at least k letters.
    pub fn mesh_at_corners(&mut self, word: Word, against: Against, k: usize) -> [A::V; 3] {
        let [f0, f1, f2] = self.mesh_corners(word.prefix(k), against);
        if word.len() == k {
            return [f0, f1, f2];
        }
        let side = 1i64 << (word.len() - k);
        word.corners_within(k).map(|[v, w]| {
            let part = |p: i64| A::S::ratio(p, side);
            f0.clone() * &part(side - v - w) + &(f1.clone() * &part(v)) + &(f2.clone() * &part(w))
        })
    }

    /// The factor times the Bernstein coefficients of S - F_k over a regular word of at least k
    /// letters; at valence 6 any word.
    pub fn target(&mut self, word: Word, against: Against, k: usize) -> [A::V; 15] {
        let points = match self.net(word).clone() {
            Net::Regular(points) => points,
            // At valence 6 the first net is regular too.
            Net::Extraordinary(points) if points.len() == REGULAR_LABELS.len() => {
                Box::new(REGULAR_LABELS.map(|label| points[label - 1].clone()))
            }
            Net::Extraordinary(_) => panic!("S is not polynomial over the word {word}"),
        };
        let mesh = self.mesh_at_corners(word, against, k);
        let surface = box_spline::<A::S, A::V>(&points).0;
        let mut target = QuarticTriangle(surface.map(|b| self.space.scale(&b)));
        target.subtract::<A::S>(&QuarticTriangle::from_linear::<A::S>(&mesh));
        target.0
    }

    /// The factor times the Bernstein coefficients of `t - (1 - |u|) t_0` over a regular word, each
    /// divided by `|u| = 2^depth (v + w)` at its node; t = S - F_0 against the control mesh, t_0 its
    /// value at the extraordinary corner.
    pub fn linear_target(&mut self, word: Word, depth: usize) -> [A::V; 15] {
        let corner = self.corner_target(Against::Control, 0);
        let side = 1i64 << word.len();
        // Four times |u| at the nodes, over `side`: whole numbers.
        let [u0, u1, u2] = word.corners_within(0).map(|[v, w]| (v + w) << depth);
        let mut target = self.target(word, Against::Control, 0);
        for r in 0..=4i64 {
            for k in 0..=r {
                let u = (4 - r) * u0 + (r - k) * u1 + k * u2;
                let rest = corner.clone() * &A::S::ratio(4 * side - u, 4 * side);
                let coefficient = &mut target[(r * (r + 1) / 2 + k) as usize];
                *coefficient = (coefficient.clone() - &rest) * &A::S::ratio(4 * side, u);
            }
        }
        target
    }

    /// The factor times S - F_k at the extraordinary corner.
    pub fn corner_target(&mut self, against: Against, k: usize) -> A::V {
        let word = Word::zeros(k);
        let [limit, ..] = self.mesh_corners(word, Against::Limit);
        let [mesh, ..] = self.mesh_corners(word, against);
        limit - &mesh
    }

    /// The second differences of a word's net, as functionals of the first net (no factor).
    pub fn differences(&mut self, word: Word) -> Vec<A::V> {
        let n = self.space.valence();
        let (valence, local) = self.net(word).local(n);
        let rows: Vec<IntegerRow> = loop_scheme::second_differences(valence);
        rows.iter()
            .map(|row| row.apply::<A::S, A::V>(&local))
            .collect()
    }

    /// One of the second differences of a word's net.
    pub fn difference(&mut self, word: Word, l: usize) -> A::V {
        let n = self.space.valence();
        let (valence, local) = self.net(word).local(n);
        loop_scheme::second_differences(valence)[l].apply::<A::S, A::V>(&local)
    }

    /// The factor times a functional.
    pub fn space_scale(&self, functional: &A::V) -> A::V {
        self.space.scale(functional)
    }

    /// The factor times the points 1, 2 of the extraordinary net of a level.
    pub fn leading_points(&mut self, level: usize) -> [A::V; 2] {
        let [p0, p1, _] = self.mesh_corners(Word::zeros(level), Against::Control);
        [p0, p1]
    }
}

/// How many bits the exact numerators of a word may take, at most: a bound of Σ|numerators| n^0.
///
/// A refined point is a convex combination of points, but for the extraordinary vertex point
/// `P + b (Σ P_i - n P)`, at most 2 n + 1 times as large in the sum of all coefficients; the factor q
/// is at most 3 + 8 n, the limit mask 3 + 8 n; a level has denominator 16, Bernstein form 24, the
/// nodes of F 4 2^len; the difference of two terms doubles, a second difference makes four.
pub fn bits_needed(n: u32, word: Word) -> u32 {
    let log2 = |k: u64| u64::BITS - k.leading_zeros();
    let n = u64::from(n);
    let (len, zeros) = (word.len() as u32, word.leading_zeros() as u32);
    4 * len + len + 9 + (zeros + 1) * log2(2 * n + 1) + 2 * log2(8 * n + 3) + 3
}
