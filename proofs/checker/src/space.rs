//! What a claim fixes: scheme, valence, ring, the differences; and the work allowed for it.

use std::cell::Cell;
use std::fmt::Display;

use num_rational::BigRational;

use crate::basis;
use crate::catmull_clark::CatmullClark;
use crate::claim::{Norm, SchemeName, Setting, Weights};
use crate::cosine;
use crate::doo_sabin::DooSabin;
use crate::file::{Number, Value};
use crate::loop_scheme::Loop;
use crate::patch::Patch;
use crate::rational::contrast;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::ring::Ring;
use crate::scalar::Scalar;
use crate::scheme::{Mask, Row, Scheme};

/// Elementary operations allowed for one file: a few minutes.
const WORK: u64 = 20_000_000_000;

/// The setting of a claim.
pub struct Space {
    pub scheme: Box<dyn Scheme>,
    pub n: usize,
    /// The number of points.
    pub size: usize,
    pub ring: Ring,
    /// Loop's beta; zero for the other schemes, whose values are rationals.
    beta: Scalar,
    /// What every target is times: 3 + 8 beta for Loop's scheme, 1 for the others.
    pub q: Scalar,
    /// q times the Bernstein coefficients of S over a regular net.
    pub surface: Vec<Mask>,
    /// The differences of the first net.
    pub rows: Vec<Row>,
    /// The differences of a regular net.
    pub regular_rows: Vec<Row>,
    /// The rank of the first net's.
    pub rank: usize,
    work: Cell<u64>,
}

impl Space {
    /// The setting of a claim.
    ///
    /// # Errors
    ///
    /// If and only if the enclosure of cos(π/n) is missing, idle or wrong: rule `cosine`.
    pub fn new(
        setting: &Setting,
        norm: Norm,
        enclosure: Option<&(Number, Number)>,
    ) -> Outcome<Self> {
        let n = setting.valence;
        let ends = enclosure.map(|(Number(lo), Number(hi))| (lo, hi));
        let idle = || Rejection::new(Rule::Cosine, "numbers are rational here: \"cosine\" is null");
        match (setting.scheme, setting.weights) {
            (SchemeName::CatmullClark, _) if ends.is_some() => Err(idle()),
            (SchemeName::CatmullClark, _) => {
                let (beta, one) = (Scalar::integer(0), Scalar::integer(1));
                Ok(Self::of(Box::new(CatmullClark(norm)), n, Ring::RATIONALS, beta, one))
            }
            (SchemeName::DooSabin, _) => {
                let (ring, list) = match (cosine::rational_cosines(n), ends) {
                    (Some(_), Some(_)) => return Err(idle()),
                    (Some(list), None) => {
                        (Ring::RATIONALS, list.iter().map(Scalar::constant).collect())
                    }
                    (None, ends) => {
                        let ring = Ring::cosines(n, cosine::enclose(n, ends)?);
                        (ring, (0..n).map(|k| Scalar::generator(k.min(n - k))).collect())
                    }
                };
                let (beta, one) = (Scalar::integer(0), Scalar::integer(1));
                Ok(Self::of(Box::new(DooSabin(list)), n, ring, beta, one))
            }
            (SchemeName::Loop, weights) => {
                let weights = weights.unwrap_or(Weights::Original);
                match (cosine::rational_beta(weights, n), ends) {
                    (Some(_), Some(_)) => Err(idle()),
                    (Some(beta), None) => {
                        Ok(Loop::space(n, Ring::RATIONALS, Scalar::constant(&beta)))
                    }
                    (None, ends) => {
                        let beta = cosine::enclose_beta(n, ends)?;
                        Ok(Loop::space(n, Ring::Powers(beta), Scalar::generator(1)))
                    }
                }
            }
        }
    }

    /// The setting of a scheme with a valence, over a ring.
    pub fn of(scheme: Box<dyn Scheme>, n: usize, ring: Ring, beta: Scalar, q: Scalar) -> Self {
        let (size, rows) = (scheme.size(n), scheme.differences(n));
        let (surface, regular_rows) = (scheme.surface(), scheme.differences(scheme.regular()));
        let (rank, work) = (basis::rank(&rows, size), Cell::new(WORK));
        Self { scheme, n, size, ring, beta, q, surface, rows, regular_rows, rank, work }
    }

    /// The valence of the net of a word.
    pub fn valence(&self, regular: bool) -> usize {
        if regular { self.scheme.regular() } else { self.n }
    }

    /// The differences of the net of a word.
    pub fn differences(&self, regular: bool) -> &[Row] {
        if regular { &self.regular_rows } else { &self.rows }
    }

    /// The surface over regular words.
    pub fn patch(&self) -> Patch {
        self.scheme.patch()
    }

    /// Takes this much off the work allowed.
    ///
    /// # Errors
    ///
    /// If and only if less is left: rule `format`.
    pub fn charge(&self, work: u64) -> Outcome<()> {
        let left = self.work.get().checked_sub(work);
        self.work.set(left.unwrap_or(0));
        ensure!(left.is_some(), Rule::Format, "more work than the checker allows for one file");
        Ok(())
    }

    /// q times a value: what it has over q.
    pub fn value(&self, value: &Value) -> Scalar {
        let horner = |sum: Scalar, c: &Number| {
            &self.ring.product(&sum, &self.beta) + &Scalar::constant(&c.0)
        };
        match value {
            Value::Rational(r) => self.q.scale(&r.0),
            Value::OverQ(list) => list.iter().rev().fold(Scalar::integer(0), horner),
        }
    }

    /// Checks `x / q <= y / q`; the rejection shows both.
    ///
    /// # Errors
    ///
    /// If and only if it is not certain: the rule given.
    pub fn at_most(&self, x: &Scalar, y: &Scalar, rule: Rule, what: impl Display) -> Outcome<()> {
        if self.ring.is_at_most_zero(&(x - y)) {
            return Ok(());
        }
        let (x, y) = contrast(&self.near(x), &self.near(y));
        Err(Rejection::new(rule, format!("{what}: {x} is not shown to be at most {y}")))
    }

    /// `x / q`, near the middle of its enclosure: for decimals only.
    pub fn near(&self, x: &Scalar) -> BigRational {
        self.ring.near(x) / self.ring.near(&self.q)
    }
}
