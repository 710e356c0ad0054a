//! Linear functionals of a control net, exact: what a point of any level is of the first net.

use std::ops::{Add, Mul, Sub};

use num_traits::{One, Zero};

use crate::scalar::{Rational, Ring};
use crate::scheme::IntegerRow;

/// A functional by its coefficients, one per point; the empty one is 0.
#[derive(Clone, Debug)]
pub struct Functional(Vec<Rational>);

impl Functional {
    /// The point of a label, of so many.
    pub fn point(size: usize, label: usize) -> Self {
        Self::of_row(&IntegerRow::new([(label - 1, 1)]), size)
    }

    /// A short integer row.
    pub fn of_row(row: &IntegerRow, size: usize) -> Self {
        let mut coefficients = vec![Rational::zero(); size];
        for &(i, a) in row.terms() {
            coefficients[i] = <Rational as Ring>::from_integer(a);
        }
        Functional(coefficients)
    }

    /// The coefficients.
    pub fn coefficients(&self) -> &[Rational] {
        &self.0
    }

    /// The value at a net.
    pub fn at(&self, net: &[Rational]) -> Rational {
        let terms = self.0.iter().zip(net).filter(|(a, _)| !a.is_zero());
        terms.map(|(a, y)| a * y).sum()
    }

    /// The same combination of other points.
    pub fn of(&self, points: &[Functional]) -> Functional {
        let terms = self.0.iter().zip(points).filter(|(a, _)| !a.is_zero());
        terms.fold(Functional::zero(), |sum, (a, point)| {
            sum + &(point.clone() * a)
        })
    }

    /// Whether two functionals are the same.
    pub fn same(&self, other: &Self) -> bool {
        (self.clone() - other).is_zero()
    }

    /// 0.
    pub fn of_nothing() -> Self {
        Functional(Vec::new())
    }

    /// `-t`.
    pub fn zero_minus(t: &Self) -> Self {
        Functional::zero() - t
    }

    /// A combination as the paper prints it: `3/16 ( V2 + V3 ) - 1/8 V2N+7`.
    ///
    /// `label` knows the points. Tokens are separated by blanks; a number multiplies what follows.
    ///
    /// # Panics
    /// If a token is neither a number nor a point: the printed formulas are constants.
    pub fn parse(text: &str, size: usize, label: &dyn Fn(&str) -> Option<usize>) -> Self {
        let mut sum = vec![Rational::zero(); size];
        let mut outer = vec![Rational::one()];
        let mut factor = Rational::one();
        for token in text.split_whitespace() {
            match token {
                "+" => factor = Rational::one(),
                "-" => factor = -Rational::one(),
                "(" => {
                    outer.push(&outer[outer.len() - 1] * &factor);
                    factor = Rational::one();
                }
                ")" => {
                    outer.pop();
                }
                _ => match label(token) {
                    Some(label) => sum[label - 1] += &outer[outer.len() - 1] * &factor,
                    None => factor *= token.parse::<Rational>().expect("a printed number"),
                },
            }
        }
        Functional(sum)
    }
}

/// The label of a point as printed: `V4` or `V2N+8`. At N = 3 the ring's V8 is V2 (`V2N+2` is not).
pub fn label(n: u32, text: &str) -> Option<usize> {
    let name = text.strip_prefix('V')?;
    match name.strip_prefix("2N+") {
        Some(far) => Some(2 * n as usize + far.parse::<usize>().ok()?),
        None => Some(ring(n, name.parse().ok()?)),
    }
}

/// The label of the ring's vertex with cyclic index i, in 2..=2N+1; 1 stays.
pub fn ring(n: u32, i: usize) -> usize {
    let len = 2 * n as usize;
    match i {
        1 => 1,
        _ => (i + len - 2) % len + 2,
    }
}

impl Zero for Functional {
    fn zero() -> Self {
        Functional(Vec::new())
    }
    fn is_zero(&self) -> bool {
        self.0.iter().all(Zero::is_zero)
    }
}

fn zip_longer(
    mut a: Vec<Rational>,
    b: &[Rational],
    op: impl Fn(&mut Rational, &Rational),
) -> Functional {
    a.resize(a.len().max(b.len()), Rational::zero());
    for (x, y) in a.iter_mut().zip(b).filter(|(_, y)| !y.is_zero()) {
        op(x, y);
    }
    Functional(a)
}

impl Add for Functional {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self + &other
    }
}

impl Add<&Functional> for Functional {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        zip_longer(self.0, &other.0, |x, y| *x += y)
    }
}

impl Sub<&Functional> for Functional {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        zip_longer(self.0, &other.0, |x, y| *x -= y)
    }
}

impl Mul<&Rational> for Functional {
    type Output = Self;
    fn mul(mut self, factor: &Rational) -> Self {
        let nonzero = self.0.iter_mut().filter(|a| !a.is_zero());
        nonzero.for_each(|a| *a *= factor);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Field;

    #[test]
    fn printed_combinations_are_read() {
        let read = Functional::parse("1/2 ( V1 - 2 V3 ) - 3/4 V2N+2", 8, &|t| label(3, t));
        let r = Rational::ratio;
        let mut expected = vec![r(0, 1); 8];
        expected[0] = r(1, 2);
        expected[2] = r(-1, 1);
        expected[7] = r(-3, 4);
        assert_eq!(read.coefficients(), expected);
    }
}
