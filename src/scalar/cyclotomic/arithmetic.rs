//! Sums, products, quotients, and the operators.

use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::element::{Cyclotomic, FieldMismatch, MAX_COMMON_DEGREE};
use super::field::RealField;
use crate::scalar::{Decide, Field, Rational, Ring};

impl Cyclotomic {
    /// The sum; `None` if and only if the operands are not [`Cyclotomic::compatible`].
    pub fn checked_add(&self, other: &Self) -> Option<Self> {
        self.sum(other, MAX_COMMON_DEGREE).ok()
    }

    /// The difference; `None` if and only if the operands are not [`Cyclotomic::compatible`].
    pub fn checked_sub(&self, other: &Self) -> Option<Self> {
        self.sum(&-other, MAX_COMMON_DEGREE).ok()
    }

    /// The product; `None` if and only if the operands are not [`Cyclotomic::compatible`].
    pub fn checked_mul(&self, other: &Self) -> Option<Self> {
        self.product(other).ok()
    }

    /// The quotient; `None` if and only if `other` is zero or the operands are not
    /// [`Cyclotomic::compatible`].
    pub fn checked_div(&self, other: &Self) -> Option<Self> {
        self.product(&other.inverse()?).ok()
    }

    /// The sum in the common field, of degree at most `cap`.
    pub(super) fn sum(&self, other: &Self, cap: usize) -> Result<Self, FieldMismatch> {
        let both = self.aligned(other, cap)?;
        let (p, q) = (&self.denominator, &other.denominator);
        let same = p == q;
        let length = both.left.len().max(both.right.len());
        let scaled = |a: Option<&BigInt>, factor: &BigInt| match a {
            None => BigInt::ZERO,
            Some(a) if same || a.is_zero() => a.clone(),
            Some(a) => a * factor,
        };
        // a/p + b/q = (a q + b p) / (p q).
        let coefficients = (0..length)
            .map(|k| scaled(both.left.get(k), q) + scaled(both.right.get(k), p))
            .collect();
        let denominator = if same { p.clone() } else { p * q };
        Ok(Self::normal(both.field, coefficients, denominator))
    }

    fn product(&self, other: &Self) -> Result<Self, FieldMismatch> {
        let both = self.aligned(other, MAX_COMMON_DEGREE)?;
        let coefficients = multiply(both.field, &both.left, &both.right);
        Ok(Self::normal(
            both.field,
            coefficients,
            &self.denominator * &other.denominator,
        ))
    }
}

/// The product of two coefficient vectors in the basis 1, C_1, ..
pub(super) fn multiply(field: Option<&RealField>, a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let (Some(field), true) = (field, a.len() > 1 && b.len() > 1) else {
        let (vector, factor) = if b.len() > 1 { (b, &a[0]) } else { (a, &b[0]) };
        return vector.iter().map(|x| x * factor).collect();
    };
    let mut sums = field.empty_sums();
    for (i, x) in a.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
        for (j, y) in b.iter().enumerate().filter(|(_, y)| !y.is_zero()) {
            if i == 0 && j == 0 {
                continue;
            }
            let xy = x * y;
            // C_i C_j = C_(i+j) + C_|i-j|; but 1 is no C_0, which is 2.
            if i != 0 && j != 0 {
                sums[i.abs_diff(j)] += &xy;
            }
            sums[field.fold((i + j) as u64)] += xy;
        }
    }
    field.reduce(&a[0] * &b[0], sums)
}

fn unless_mismatched(result: Result<Cyclotomic, FieldMismatch>) -> Cyclotomic {
    result.unwrap_or_else(|mismatch| panic!("{mismatch}"))
}

fn quotient(a: &Cyclotomic, b: &Cyclotomic) -> Cyclotomic {
    unless_mismatched(a.product(&b.inverse().expect("division by zero")))
}

macro_rules! operator {
    ($Op:ident, $op:ident, $OpAssign:ident, $op_assign:ident, |$a:ident, $b:ident| $value:expr) => {
        impl $Op<&Cyclotomic> for &Cyclotomic {
            type Output = Cyclotomic;
            fn $op(self, other: &Cyclotomic) -> Cyclotomic {
                let ($a, $b) = (self, other);
                $value
            }
        }
        impl $Op<Cyclotomic> for &Cyclotomic {
            type Output = Cyclotomic;
            fn $op(self, other: Cyclotomic) -> Cyclotomic {
                $Op::$op(self, &other)
            }
        }
        impl $Op<&Cyclotomic> for Cyclotomic {
            type Output = Cyclotomic;
            fn $op(self, other: &Cyclotomic) -> Cyclotomic {
                $Op::$op(&self, other)
            }
        }
        impl $Op for Cyclotomic {
            type Output = Cyclotomic;
            fn $op(self, other: Cyclotomic) -> Cyclotomic {
                $Op::$op(&self, &other)
            }
        }
        impl $OpAssign<&Cyclotomic> for Cyclotomic {
            fn $op_assign(&mut self, other: &Cyclotomic) {
                *self = $Op::$op(&*self, other);
            }
        }
        impl $OpAssign for Cyclotomic {
            fn $op_assign(&mut self, other: Cyclotomic) {
                *self = $Op::$op(&*self, &other);
            }
        }
    };
}

operator!(Add, add, AddAssign, add_assign, |a, b| unless_mismatched(
    a.sum(b, MAX_COMMON_DEGREE)
));
operator!(Sub, sub, SubAssign, sub_assign, |a, b| unless_mismatched(
    a.sum(&-b, MAX_COMMON_DEGREE)
));
operator!(Mul, mul, MulAssign, mul_assign, |a, b| unless_mismatched(
    a.product(b)
));
operator!(Div, div, DivAssign, div_assign, |a, b| quotient(a, b));

impl Neg for Cyclotomic {
    type Output = Cyclotomic;
    fn neg(mut self) -> Cyclotomic {
        self.coefficients
            .iter_mut()
            .for_each(|a| *a = -std::mem::take(a));
        self
    }
}

impl Neg for &Cyclotomic {
    type Output = Cyclotomic;
    fn neg(self) -> Cyclotomic {
        -self.clone()
    }
}

impl Zero for Cyclotomic {
    fn zero() -> Self {
        Self::from_integer(0)
    }
    fn is_zero(&self) -> bool {
        self.field.is_none() && self.coefficients[0].is_zero()
    }
}

impl One for Cyclotomic {
    fn one() -> Self {
        Self::from_integer(1)
    }
}

impl Field for Cyclotomic {
    fn ratio(p: i64, q: i64) -> Self {
        Self::from_rational(&<Rational as Field>::ratio(p, q))
    }

    /// `None` if and only if n = 0.
    fn two_cos(j: u32, n: u32) -> Option<Self> {
        Self::cosine(j, n)
    }
}

impl Decide for Cyclotomic {
    /// Never `None`.
    fn decide(&self, other: &Self) -> Option<Ordering> {
        Some(self.compare(other))
    }
}
