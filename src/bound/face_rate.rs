//! R(n): how fast M falls on a face whose corners may all be extraordinary.
//!
//! **Setting.** Any triangle mesh, any face of it whose corners are interior, of valences n_1, n_2,
//! n_3 >= 3. M(face) is the largest norm of the second differences of the edges that meet a corner
//! of the face. One Loop step makes four children of it, three at its corners and one in the middle.
//!
//! **Theorem.** `M(child) <= max(R(n_1), R(n_2), R(n_3)) M(face)` for each child, R the table of this
//! module, and R(n) is the least number for which that holds: on faces (n, 6, 6) it is the rate r_1(n).
//!
//! *Proof.* The corners of children are the vertex points a' of the face's corners a and the edge
//! points of its sides. The edges of the refined mesh at these are, with e_x the edge point of (a, x):
//!
//! 1. (a', e_x), x in the ring of a; its difference is `α'_x = a' + e_x - e_y - e_z`, y and z the
//!    neighbours of x in the ring;
//! 2. (e_x, e_y), x and y neighbours in the ring of a; opposite are a' and the edge point of (x, y):
//!    `τ = e_x + e_y - a' - e_xy`. Around a side's point these are all: the two half edges are of the
//!    first kind, the other four edges of the second, for one end of the side or the other.
//!
//! With α_x the difference of the edge (a, x), Σ the sum over the ring of a, `b` its ring weight and
//! α_xy that of the edge (x, y):
//!
//! ```text
//! α'_x = 3/8 α_x + 1/8 (α_y + α_z) - b Σ α,        Σ α = n a - Σ ring,
//! τ    = 1/8 α_xy - 1/8 (α_x + α_y) + b Σ α.
//! ```
//!
//! Both see edges at a and, for τ, the edge (x, y) of a triangle at a. In the face (a, x, y) that is the
//! side opposite to a; in a triangle (a, x, y) beyond the side (a, x) it is an edge at x, a corner. So
//! all these edges meet a corner of the face: their differences are at most M(face), and the least
//! weight of α' and τ over multipliers on them is a bound. It depends on the valence n of a alone.
//! The least weights are programs in the ring of a, solved here with b as a variable. Identified
//! points (small valences next to each other) only add up coefficients: the identities stay.
//! That no smaller number serves is the lower side of `r_1(n)`, whose net is one of a face
//! (n, 6, 6). ∎
//!
//! So the depth of any face is bounded by one step and the table of one extraordinary vertex:
//! `|S - F_k| <= max_i R(n_i) max_i C_(k-1)(n_i) M` for k >= 1, C_(k-1)(6) included.
//!
//! Source: derived here.

use num_bigint::BigInt;
use num_traits::{ToPrimitive, Zero};

use super::arithmetic::{Arithmetic, Exact};
use super::cell::exact_weight;
use super::functional::{ExactFunctional, FloatFunctional};
use super::rules::vertex_point;
use super::value::{Numbers, Value};
use crate::lp::Rows;
use crate::scalar::{Rational, ShortRational};
use crate::scheme::{IntegerRow, loop_scheme};

/// R(n) with its two parts.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceRate {
    /// The least weight of the differences (a', e_x).
    pub spoke: Value,
    /// The least weight of the differences (e_x, e_y).
    pub rim: Value,
    /// R(n), the larger.
    pub rate: Value,
}

/// R(n) for Loop's scheme; `None` if a program could not be solved or b is too close to a tie.
///
/// ```
/// use subcert::bound::face_rate::face_rate;
/// use subcert::bound::value::Numbers;
/// use subcert::scheme::LoopWeights;
/// let numbers = Numbers::of_loop(LoopWeights::Original, 6);
/// let rate = face_rate(&numbers).unwrap().rate;
/// assert_eq!(numbers.evaluate(&rate).to_string(), "1/4");
/// ```
pub fn face_rate(numbers: &Numbers) -> Option<FaceRate> {
    let n = numbers.n as usize;
    // Points: a, its ring 1..n, and the vertex n + 1 opposite to a across the edge (1, 2).
    let next = |i: usize| i % n + 1;
    let last = |i: usize| (i + n - 2) % n + 1;
    let spoke = |i: usize| IntegerRow::new([(0, 1), (i, 1), (last(i), -1), (next(i), -1)]);
    let outer = IntegerRow::new([(1, 1), (2, 1), (0, -1), (n + 1, -1)]);
    let rows = (1..=n).map(spoke).chain([outer]).collect();
    let rows = Rows::new(rows, n + 2);

    let space = Net::new(n);
    let spoke = space.spoke();
    let rim = space.rim();
    let spoke = least(numbers, &rows, &spoke)?;
    let rim = least(numbers, &rows, &rim)?;
    let rate = if numbers.at_most(&rim, &spoke) {
        spoke.clone()
    } else if numbers.at_most(&spoke, &rim) {
        rim.clone()
    } else {
        return None;
    };
    Some(FaceRate { spoke, rim, rate })
}

/// The ring of a, refined, with b as a variable and everything times q.
struct Net {
    n: usize,
    space: Exact<BigInt>,
}

type Functional = ExactFunctional<BigInt>;

impl Net {
    fn new(n: usize) -> Self {
        Net {
            n,
            space: Exact::new(),
        }
    }

    fn point(&self, i: usize) -> Functional {
        Functional::unit(self.n + 2, i)
    }

    fn ring(&self, i: usize) -> usize {
        (i + self.n - 1) % self.n + 1
    }

    /// The edge point of (a, x), x = ring i.
    fn edge(&self, i: usize) -> Functional {
        let at = |i: usize| self.point(self.ring(i));
        let (a, x) = (self.point(0), at(i));
        loop_scheme::edge_point::<ShortRational, _>(&a, &x, &at(i + self.n - 1), &at(i + 1))
    }

    fn vertex(&self) -> Functional {
        let zero = <Functional as Zero>::zero();
        let sum = (1..=self.n).fold(zero, |sum, i| sum + &self.point(i));
        vertex_point(&self.space, self.n as u32, &self.point(0), &sum)
    }

    fn spoke(&self) -> Functional {
        let difference = self.vertex() + &self.edge(1) - &self.edge(self.n) - &self.edge(2);
        self.space.times_q(self.n as u32, &difference)
    }

    fn rim(&self) -> Functional {
        let (a, far) = (self.point(0), self.point(self.n + 1));
        let between =
            loop_scheme::edge_point::<ShortRational, _>(&self.point(1), &self.point(2), &a, &far);
        let difference = self.edge(1) + &self.edge(2) - &self.vertex() - &between;
        self.space.times_q(self.n as u32, &difference)
    }
}

/// The least weight of a functional: the basis is proposed in floats, the weight exact; that it is the
/// least is seen from the net of the basis, which attains it.
fn least(numbers: &Numbers, rows: &Rows, t: &Functional) -> Option<Value> {
    let float = float_of(numbers, t);
    let (basis, scaled) = rows.propose(&float.0, rows.start())?;
    let above = exact_weight(numbers, t, &basis)?;
    let net = basis.net(&scaled);
    let below = Value::new(
        (t.numerators.iter())
            .map(|row| {
                let terms = row.iter().zip(&net);
                let sum: Rational = terms
                    .map(|(a, y)| y * Rational::from_integer(a.clone()))
                    .sum();
                sum / Rational::from_integer(t.denominator.clone())
            })
            .collect(),
    );
    numbers.at_most(&above, &below).then_some(above)
}

fn float_of(numbers: &Numbers, t: &Functional) -> FloatFunctional {
    let b = numbers.ring_weight().enclose().mid();
    let size = t.numerators.first().map_or(0, Vec::len);
    let scale = t.denominator.to_f64().unwrap_or(f64::NAN);
    let at = |i: usize| {
        let horner = |sum: f64, row: &Vec<BigInt>| sum * b + row[i].to_f64().unwrap_or(f64::NAN);
        t.numerators.iter().rev().fold(0.0, horner) / scale
    };
    FloatFunctional((0..size).map(at).collect())
}
