//! Suprema of functionals over a norm of nets: one linear program each, exact.

use num_traits::{ToPrimitive, Zero};

use super::functional::Functional;
use crate::lp::Rows;
use crate::paper::Enclosure;
use crate::paper::words::FINE_DIGITS;
use crate::scalar::{Decide, Rational, Ring};
use crate::scheme::IntegerRow;

/// The largest magnitude of some differences of points.
#[derive(Clone, Debug)]
pub struct Norm(Rows);

/// `sup |t(y)| / max_l |α_l(y)|` over all nets y.
#[derive(Clone, Debug)]
pub enum Sup {
    /// The supremum, and a net of norm at most 1 that attains it.
    Finite {
        /// The value.
        value: Rational,
        /// The net.
        net: Vec<Rational>,
        /// One for each row: the combination of the rows that is t, their magnitudes adding up to the value.
        multipliers: Vec<Rational>,
    },
    /// No bound: t does not vanish at a net of norm 0.
    Unbounded {
        /// The net.
        net: Vec<Rational>,
    },
    /// Numbers outgrew the exact simplex.
    Open,
}

impl Norm {
    /// The norm by its rows, for nets of so many points.
    pub fn new(rows: Vec<IntegerRow>, size: usize) -> Self {
        Norm(Rows::new(rows, size))
    }

    /// The rows.
    pub fn rows(&self) -> &[IntegerRow] {
        self.0.rows()
    }

    /// The supremum of a functional: the one place where suprema are computed.
    pub fn sup(&self, t: &Functional) -> Sup {
        let mut exact = t.coefficients().to_vec();
        exact.resize(self.0.size(), Rational::zero());
        let integer = <Rational as Ring>::from_integer;
        let unbounded = self.0.start().kernel().find_map(|net| {
            let net: Vec<Rational> = net.iter().map(|&y| integer(y)).collect();
            (!t.at(&net).is_zero()).then_some(net)
        });
        if let Some(net) = unbounded {
            return Sup::Unbounded { net };
        }
        let floats: Vec<f64> = exact.iter().map(|x| x.to_f64().unwrap_or(0.0)).collect();
        let proposed = self.0.propose(&floats, self.0.start());
        let proposed = proposed.and_then(|(basis, _)| self.0.minimise(&exact, &basis));
        match proposed.or_else(|| self.0.minimise(&exact, self.0.start())) {
            Some(best) => Sup::Finite {
                value: best.value,
                net: best.y,
                multipliers: best.x,
            },
            None => Sup::Open,
        }
    }

    /// The largest supremum of several functionals, and which takes it; the first of equals.
    ///
    /// # Panics
    /// If there are none.
    pub fn largest(&self, functionals: &[Functional]) -> (usize, Sup) {
        let sups = functionals.iter().map(|t| self.sup(t)).enumerate();
        sups.reduce(|a, b| if b.1.exceeds(&a.1) { b } else { a })
            .expect("a functional")
    }
}

impl Sup {
    /// The value, if it is known and finite.
    pub fn value(&self) -> Option<&Rational> {
        match self {
            Sup::Finite { value, .. } => Some(value),
            _ => None,
        }
    }

    /// The net that shows it.
    pub fn net(&self) -> Option<&[Rational]> {
        match self {
            Sup::Finite { net, .. } | Sup::Unbounded { net } => Some(net),
            Sup::Open => None,
        }
    }

    /// Whether it is larger; what is open counts as larger than all.
    fn exceeds(&self, other: &Self) -> bool {
        match (self, other) {
            (_, Sup::Open) => false,
            (Sup::Open, _) => true,
            (_, Sup::Unbounded { .. }) => false,
            (Sup::Unbounded { .. }, _) => true,
            (Sup::Finite { value: a, .. }, Sup::Finite { value: b, .. }) => {
                a.decide(b) == Some(std::cmp::Ordering::Greater)
            }
        }
    }

    /// How it compares with a bound; `None` if open.
    pub fn order(&self, bound: &Rational) -> Option<std::cmp::Ordering> {
        match self {
            Sup::Finite { value, .. } => value.decide(bound),
            Sup::Unbounded { .. } => Some(std::cmp::Ordering::Greater),
            Sup::Open => None,
        }
    }

    /// Whether it is at most a bound; `None` if open.
    pub fn at_most(&self, bound: &Rational) -> Option<bool> {
        Some(self.order(bound)?.is_le())
    }
}

impl std::fmt::Display for Sup {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Sup::Finite { value, .. } => f.write_str(&number(value)),
            Sup::Unbounded { .. } => f.write_str("unbounded"),
            Sup::Open => f.write_str("?"),
        }
    }
}

/// A fraction while it is short, else a decimal.
pub fn number(x: &Rational) -> String {
    let text = x.to_string();
    match text.len() {
        0..=11 => text,
        _ => Enclosure::exactly(x.clone()).decimal(FINE_DIGITS),
    }
}
