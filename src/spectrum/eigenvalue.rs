//! Eigenvalues: elements of Q(2 cos 2π/n), or roots of a quadratic polynomial over that field.

use std::cmp::Ordering;
use std::fmt;

use crate::scalar::{Cyclotomic, Field, Interval, Rational, Ring};

use super::represent::Represent;
use super::square::prime_against_square;

/// A real eigenvalue.
#[derive(Clone, Debug)]
pub enum Eigenvalue {
    /// An element of Q(2 cos 2π/n).
    Exact(Cyclotomic),
    /// A root of a quadratic polynomial over that field.
    Root(Root),
}

/// A root of `x^2 - trace x + determinant`, whose discriminant is positive and no rational square.
#[derive(Clone, Debug)]
pub struct Root {
    /// The sum of both roots.
    pub trace: Cyclotomic,
    /// Their product.
    pub determinant: Cyclotomic,
    /// Whether this is the larger root.
    pub larger: bool,
}

impl Root {
    /// `x^2 - trace x + determinant`.
    pub fn polynomial(&self, x: &Cyclotomic) -> Cyclotomic {
        x.clone() * &(x.clone() - &self.trace) + &self.determinant
    }

    /// `trace^2 - 4 determinant`.
    pub fn discriminant(&self) -> Cyclotomic {
        discriminant(&self.trace, &self.determinant)
    }

    /// A prime that proves the root not to lie in Q(2 cos 2π/n), the trace and the determinant lying
    /// there: see [`super::square`]. `None` if none below its limit does.
    pub fn irrational_by(&self, n: u32) -> Option<u64> {
        prime_against_square(&self.discriminant(), n)
    }

    /// An enclosure, by the quadratic formula; proved by the exact signs of the polynomial at its
    /// ends, which differ: the ends separate this root from the other.
    ///
    /// # Panics
    /// If the signs don't bear the formula out, which would be a fault of the interval arithmetic.
    pub fn enclose(&self) -> Interval {
        let half = Interval::ratio(1, 2);
        let root = self.discriminant().enclose().sqrt();
        let root = root.expect("the discriminant is positive");
        let sum = self.trace.enclose();
        let enclosure = if self.larger { sum + root } else { sum - root } * half;
        let sign = |end: f64| {
            let end = Rational::from_float(end).expect("a bounded enclosure");
            self.polynomial(&Cyclotomic::from_rational(&end)).signum()
        };
        let outward = if self.larger { 1 } else { -1 };
        assert!(
            sign(enclosure.sup()) == outward && sign(enclosure.inf()) == -outward,
            "{self:?} is not separated by {enclosure}"
        );
        enclosure
    }

    /// Whether x, a root of the polynomial, is this one.
    fn is(&self, x: &Cyclotomic) -> bool {
        let twice = x.clone() * &Cyclotomic::from_integer(2);
        twice.compare(&self.trace).is_gt() == self.larger
    }

    /// The order of this root and x.
    fn compare_exact(&self, x: &Cyclotomic) -> Ordering {
        let twice = x.clone() * &Cyclotomic::from_integer(2);
        let beyond_middle = twice.compare(&self.trace);
        // The sign of the polynomial: positive outside of the roots.
        match (self.polynomial(x).signum(), self.larger) {
            (0, _) if self.is(x) => Ordering::Equal,
            (0, larger) if larger => Ordering::Greater,
            (0, _) => Ordering::Less,
            (1, _) => beyond_middle.reverse(),
            (_, true) => Ordering::Greater,
            (_, false) => Ordering::Less,
        }
    }

    /// The number that two different polynomials have as a root in common, if there is one:
    /// `x^2 = t x - d = t' x - d'` gives x = (d - d') / (t - t').
    fn common(&self, other: &Root) -> Option<Cyclotomic> {
        let trace = self.trace.clone() - &other.trace;
        let determinant = self.determinant.clone() - &other.determinant;
        let x = determinant.checked_div(&trace)?;
        (self.polynomial(&x).signum() == 0).then_some(x)
    }

    fn compare_root(&self, other: &Root) -> Ordering {
        if self.trace == other.trace && self.determinant == other.determinant {
            return self.larger.cmp(&other.larger);
        }
        if let Some(x) = self.common(other)
            && self.is(&x)
            && other.is(&x)
        {
            return Ordering::Equal;
        }
        // Different numbers: a rational between them is found by halving.
        let (mut low, mut high) = {
            let hull = self.enclose().hull(other.enclose());
            let end = |x| Rational::from_float(x).expect("a bounded enclosure");
            (end(hull.inf()), end(hull.sup()))
        };
        loop {
            let middle = (low.clone() + &high) / &<Rational as Ring>::from_integer(2);
            let at = Cyclotomic::from_rational(&middle);
            match (self.compare_exact(&at), other.compare_exact(&at)) {
                (Ordering::Less, Ordering::Less) => high = middle,
                (Ordering::Greater, Ordering::Greater) => low = middle,
                (mine, its) => return mine.cmp(&its),
            }
        }
    }
}

/// `trace^2 - 4 determinant`.
pub(super) fn discriminant(trace: &Cyclotomic, determinant: &Cyclotomic) -> Cyclotomic {
    trace.clone() * trace - &(determinant.clone() * &Cyclotomic::from_integer(4))
}

impl Eigenvalue {
    /// The exact value, if it lies in Q(2 cos 2π/n).
    pub fn exact(&self) -> Option<&Cyclotomic> {
        match self {
            Eigenvalue::Exact(x) => Some(x),
            Eigenvalue::Root(_) => None,
        }
    }

    /// A proved enclosure: neighbouring floats for an exact value, a few units for a root.
    pub fn enclose(&self) -> Interval {
        match self {
            Eigenvalue::Exact(x) => x.enclose(),
            Eigenvalue::Root(root) => root.enclose(),
        }
    }

    /// The value in another arithmetic.
    pub fn represent<S: Represent>(&self) -> Option<S> {
        match self {
            Eigenvalue::Exact(x) => S::of_exact(x),
            Eigenvalue::Root(root) => S::of_enclosure(&root.enclose()),
        }
    }

    /// The order, decided exactly.
    pub fn compare(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Eigenvalue::Exact(a), Eigenvalue::Exact(b)) => a.compare(b),
            (Eigenvalue::Root(a), Eigenvalue::Exact(b)) => a.compare_exact(b),
            (Eigenvalue::Exact(a), Eigenvalue::Root(b)) => b.compare_exact(a).reverse(),
            (Eigenvalue::Root(a), Eigenvalue::Root(b)) => a.compare_root(b),
        }
    }

    /// The order of the absolute values, decided exactly.
    pub fn compare_magnitude(&self, other: &Self) -> Ordering {
        self.magnitude().compare(&other.magnitude())
    }

    fn magnitude(&self) -> Self {
        let zero = Eigenvalue::Exact(Cyclotomic::from_integer(0));
        if self.compare(&zero).is_ge() {
            return self.clone();
        }
        match self {
            Eigenvalue::Exact(x) => Eigenvalue::Exact(-x),
            // The roots of x^2 + t x + d are the negatives.
            Eigenvalue::Root(root) => Eigenvalue::Root(Root {
                trace: -&root.trace,
                determinant: root.determinant.clone(),
                larger: !root.larger,
            }),
        }
    }
}

impl fmt::Display for Eigenvalue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Eigenvalue::Exact(x) => write!(f, "{x}"),
            Eigenvalue::Root(root) => write!(
                f,
                "{} root of x^2 - t x + d, d = {}, t = {}",
                if root.larger { "larger" } else { "smaller" },
                root.determinant,
                root.trace
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(p: i64, q: i64) -> Eigenvalue {
        Eigenvalue::Exact(Cyclotomic::ratio(p, q))
    }

    fn root(trace: i64, determinant: i64, larger: bool) -> Eigenvalue {
        Eigenvalue::Root(Root {
            trace: Cyclotomic::from_integer(trace),
            determinant: Cyclotomic::from_integer(determinant),
            larger,
        })
    }

    /// Numbers in their order: -√3, -√2, -1, 1 - √2, .., by the polynomials x^2 - 3, x^2 - 2, x^2 - 2x - 1.
    #[test]
    fn roots_are_ordered_exactly() {
        let ascending = [
            root(0, -3, false),
            root(0, -2, false),
            exact(-1, 1),
            root(2, -1, false),
            exact(0, 1),
            exact(7, 5),
            root(0, -2, true),
            exact(3, 2),
            root(0, -3, true),
            exact(12071, 5000),
            root(2, -1, true),
            exact(5, 2),
        ];
        for (i, a) in ascending.iter().enumerate() {
            for (j, b) in ascending.iter().enumerate() {
                assert_eq!(a.compare(b), i.cmp(&j), "{a} and {b}");
            }
        }
        // -√2 and √2 in magnitude; the root 2 that (x - 1)(x - 2) and (x - 2)(x - 3) have in common.
        let [low, high] = [root(0, -2, false), root(0, -2, true)];
        assert!(low.compare_magnitude(&high).is_eq());
        assert!(root(3, 2, true).compare(&root(5, 6, false)).is_eq());
        assert!(root(3, 2, true).compare(&exact(2, 1)).is_eq());
        assert!(root(3, 2, false).compare(&exact(2, 1)).is_lt());
    }
}
