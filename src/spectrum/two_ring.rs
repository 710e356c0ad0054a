//! The two-ring of a vertex, and its subdivision as stencils: rows of the matrix, read off the masks.
//!
//! A two-ring has a centre and n equal *sectors*. The sector j lies between the rays j and j + 1:
//!
//! ```text
//! Loop, 1 + 3n points          Catmull-Clark, 1 + 6n points
//!
//!         ray b_(j+1)             ray      far      corner
//!        /  \                     |        |        |
//!   ring -- between d_j           edge --- face --- near
//!      /  \ /  \                  |        |        |
//! centre - ring - ray b_j         centre - edge --- ray
//! ```
//!
//! In a net the centre comes first, then each kind of point for all sectors: point q of sector j has
//! the index `1 + q n + j`. Kinds of Loop: ring (a_j), between (d_j, opposite to the edge a_j
//! a_(j+1)), ray (b_j, behind a_j). Of Catmull-Clark, on the lattice with the ray j along (1, 0) and
//! the ray j + 1 along (0, 1): edge (1,0), face (1,1), ray (2,0), near (2,1), far (1,2), corner (2,2).
//!
//! The second ring doesn't act on the first: the first ring of the next level needs the first ring
//! only. Hence *inner* kinds (the first ring) and *outer* ones (the second).
//!
//! [`Stencil`]s are formal sums of points. The refinement of [`crate::scheme`] is applied once to the
//! net whose points are these symbols, so no weight is written here.

use std::collections::BTreeMap;
use std::ops::{Add, Mul, Sub};

use nalgebra::DMatrix;
use num_traits::Zero;

use crate::scalar::{Field, Module};
use crate::scheme::{LoopWeights, catmull_clark, loop_scheme};

/// A scheme whose extraordinary vertices have a two-ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rules {
    /// Loop's scheme.
    Loop(LoopWeights),
    /// Catmull-Clark.
    CatmullClark,
}

impl Rules {
    /// The number of points of a sector: 3 or 6.
    pub const fn kinds(self) -> usize {
        match self {
            Rules::Loop(_) => 3,
            Rules::CatmullClark => 6,
        }
    }

    /// The names of the points of a sector, in order.
    pub const fn kind_names(self) -> &'static [&'static str] {
        match self {
            Rules::Loop(_) => &["ring", "between", "ray"],
            Rules::CatmullClark => &["edge", "face", "ray", "near", "far", "corner"],
        }
    }

    /// The number of kinds in the first ring, which come first: 1 or 2.
    pub const fn inner_kinds(self) -> usize {
        match self {
            Rules::Loop(_) => 1,
            Rules::CatmullClark => 2,
        }
    }

    /// Which point of the two-ring each label of Stam's local net of sector 0 is.
    pub(super) fn local_points(self, n: u32) -> Vec<Point> {
        let at = |kind: usize, sector: i64| Point::of(n, kind, sector);
        let turn = i64::from(n);
        match self {
            // Face {P1, P2, P(n+1)}: P2 lies on the ray 1, P(n+1) on the ray 0.
            Rules::Loop(_) => {
                let ring = (0..turn).map(|i| at(0, 1 + i));
                let outer = [at(1, 0), at(2, 1), at(1, 1), at(2, 0), at(1, -1)];
                [Point::Center]
                    .into_iter()
                    .chain(ring)
                    .chain(outer)
                    .collect()
            }
            // V6 lies on the ray 0 and V4 on the ray 1: labels run against the sectors.
            Rules::CatmullClark => {
                let ring = (1..=turn).flat_map(|j| [at(0, 3 - j), at(1, 2 - j)]);
                let outer = [
                    at(5, 0),
                    at(3, 0),
                    at(2, 0),
                    at(4, -1),
                    at(4, 0),
                    at(2, 1),
                    at(3, 1),
                ];
                [Point::Center]
                    .into_iter()
                    .chain(ring)
                    .chain(outer)
                    .collect()
            }
        }
    }
}

/// A point of the two-ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Point {
    /// The extraordinary vertex.
    Center,
    /// A point of a sector.
    Sector {
        /// Which of the sector's points.
        kind: usize,
        /// The sector, below n.
        sector: u32,
    },
}

impl Point {
    /// The point of a sector given modulo n.
    pub fn of(n: u32, kind: usize, sector: i64) -> Self {
        let sector = sector.rem_euclid(i64::from(n)) as u32;
        Point::Sector { kind, sector }
    }

    /// The index in a net.
    pub fn index(self, n: u32) -> usize {
        match self {
            Point::Center => 0,
            Point::Sector { kind, sector } => 1 + kind * n as usize + sector as usize,
        }
    }

    /// The image under a rotation by some sectors.
    pub fn turned(self, n: u32, by: i64) -> Self {
        match self {
            Point::Center => Point::Center,
            Point::Sector { kind, sector } => Point::of(n, kind, i64::from(sector) + by),
        }
    }
}

/// A formal sum of points with coefficients in S: a row of a matrix, or a sparse net.
#[derive(Clone, Debug, PartialEq)]
pub struct Stencil<S>(BTreeMap<Point, S>);

impl<S: Field> Stencil<S> {
    /// The sum of the given terms; a point given twice carries the sum of its coefficients.
    pub fn new(terms: impl IntoIterator<Item = (Point, S)>) -> Self {
        let mut sum = Self::zero();
        for (point, weight) in terms {
            sum.add_term(point, &weight);
        }
        sum
    }

    /// The terms, none of them zero, in the order of the points.
    pub fn terms(&self) -> impl Iterator<Item = (Point, &S)> {
        self.0.iter().map(|(point, weight)| (*point, weight))
    }

    /// The coefficient of a point.
    pub fn at(&self, point: Point) -> S {
        self.0.get(&point).cloned().unwrap_or_else(S::zero)
    }

    /// The value at a net of valence n, of the stencil turned by some sectors.
    pub fn apply<V: Module<S>>(&self, n: u32, turned: i64, net: &[V]) -> V {
        self.terms().fold(V::zero(), |sum, (point, weight)| {
            sum + &(net[point.turned(n, turned).index(n)].clone() * weight)
        })
    }

    /// The stencil turned by some sectors.
    pub fn turned(&self, n: u32, by: i64) -> Self {
        Stencil::new(self.terms().map(|(p, a)| (p.turned(n, by), a.clone())))
    }

    /// The stencil in another arithmetic; `None` if some coefficient has no image.
    pub fn map<T: Field>(&self, image: impl Fn(&S) -> Option<T>) -> Option<Stencil<T>> {
        let terms = self.terms().map(|(p, a)| Some((p, image(a)?)));
        Some(Stencil::new(terms.collect::<Option<Vec<_>>>()?))
    }

    fn add_term(&mut self, point: Point, weight: &S) {
        let sum = self.at(point) + weight;
        if sum.is_zero() {
            self.0.remove(&point);
        } else {
            self.0.insert(point, sum);
        }
    }
}

impl<S: Field> Zero for Stencil<S> {
    fn zero() -> Self {
        Stencil(BTreeMap::new())
    }
    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }
}

impl<S: Field> Add for Stencil<S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self + &other
    }
}

impl<S: Field> Add<&Self> for Stencil<S> {
    type Output = Self;
    fn add(mut self, other: &Self) -> Self {
        for (point, weight) in other.terms() {
            self.add_term(point, weight);
        }
        self
    }
}

impl<S: Field> Sub<&Self> for Stencil<S> {
    type Output = Self;
    fn sub(mut self, other: &Self) -> Self {
        for (point, weight) in other.terms() {
            self.add_term(point, &-weight.clone());
        }
        self
    }
}

impl<S: Field> Mul<&S> for Stencil<S> {
    type Output = Self;
    fn mul(self, factor: &S) -> Self {
        Stencil::new(self.0.into_iter().map(|(p, a)| (p, a * factor)))
    }
}

/// The subdivision of the two-ring of a vertex of valence n, as one stencil for the centre and one
/// for each kind of point of sector 0; the other sectors' are these turned.
#[derive(Clone, Debug)]
pub struct TwoRing<S> {
    rules: Rules,
    n: u32,
    center: Stencil<S>,
    kinds: Vec<Stencil<S>>,
}

impl<S: Field> TwoRing<S> {
    /// The stencils of a scheme; `None` if and only if S cannot represent its masks.
    ///
    /// # Panics
    /// If n < 3.
    pub fn new(rules: Rules, n: u32) -> Option<Self> {
        let local = rules.local_points(n);
        let symbols: Vec<Stencil<S>> = (local.iter())
            .map(|&point| Stencil::new([(point, S::one())]))
            .collect();
        let refined = match rules {
            Rules::Loop(weights) => {
                loop_scheme::refine_local_net::<S, Stencil<S>>(weights, n, &symbols)?
            }
            Rules::CatmullClark => catmull_clark::refine_local_net::<S, Stencil<S>>(n, &symbols),
        };
        let row = |kind: usize| {
            let at = local.iter().position(|&p| p == Point::of(n, kind, 0));
            refined[at.expect("sector 0 lies in its local net")].clone()
        };
        Some(TwoRing {
            rules,
            n,
            center: refined[0].clone(),
            kinds: (0..rules.kinds()).map(row).collect(),
        })
    }

    /// The stencils in another arithmetic; `None` if some weight has no image.
    pub fn map<T: Field>(&self, image: impl Fn(&S) -> Option<T>) -> Option<TwoRing<T>> {
        let kinds = self.kinds.iter().map(|row| row.map(&image));
        Some(TwoRing {
            rules: self.rules,
            n: self.n,
            center: self.center.map(&image)?,
            kinds: kinds.collect::<Option<_>>()?,
        })
    }

    /// The scheme.
    pub fn rules(&self) -> Rules {
        self.rules
    }

    /// The valence n.
    pub fn valence(&self) -> u32 {
        self.n
    }

    /// The number of points, 1 + 3n or 1 + 6n.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        1 + self.rules.kinds() * self.n as usize
    }

    /// The new centre as a sum of old points.
    pub fn center(&self) -> &Stencil<S> {
        &self.center
    }

    /// The new point of a kind in sector 0 as a sum of old points.
    pub fn kind(&self, kind: usize) -> &Stencil<S> {
        &self.kinds[kind]
    }

    /// The two-ring of the next level.
    ///
    /// # Panics
    /// If the net has not [`TwoRing::len`] points.
    pub fn refine<V: Module<S>>(&self, net: &[V]) -> Vec<V> {
        assert_eq!(net.len(), self.len(), "points of a two-ring");
        let mut next = vec![self.center.apply(self.n, 0, net)];
        for row in &self.kinds {
            next.extend((0..i64::from(self.n)).map(|j| row.apply(self.n, j, net)));
        }
        next
    }

    /// The local net of Stam's numbering over the face of a sector.
    pub fn local_net<V: Clone>(&self, sector: u32, net: &[V]) -> Vec<V> {
        let points = self.rules.local_points(self.n).into_iter();
        let at = |p: Point| net[p.turned(self.n, i64::from(sector)).index(self.n)].clone();
        points.map(at).collect()
    }

    /// The matrix of [`TwoRing::refine`].
    pub fn matrix(&self) -> DMatrix<S> {
        let mut matrix = DMatrix::from_element(self.len(), self.len(), S::zero());
        let mut write = |row: Point, stencil: &Stencil<S>, turned: i64| {
            for (point, weight) in stencil.terms() {
                let column = point.turned(self.n, turned).index(self.n);
                matrix[(row.index(self.n), column)] = weight.clone();
            }
        };
        write(Point::Center, &self.center, 0);
        for (kind, row) in self.kinds.iter().enumerate() {
            for j in 0..i64::from(self.n) {
                write(Point::of(self.n, kind, j), row, j);
            }
        }
        matrix
    }
}
