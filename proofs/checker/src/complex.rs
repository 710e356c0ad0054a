//! Points of the plane, in intervals.

use std::ops::{Add, Mul, Neg, Sub};

use crate::fixed::Fixed;

/// `re + i im`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Complex {
    pub re: Fixed,
    pub im: Fixed,
}

impl Complex {
    pub const ZERO: Self = Self { re: Fixed::ZERO, im: Fixed::ZERO };
    /// Nothing is known.
    pub const WHOLE: Self = Self { re: Fixed::WHOLE, im: Fixed::WHOLE };

    pub fn real(re: Fixed) -> Self {
        Self { re, im: Fixed::ZERO }
    }

    pub fn conjugate(self) -> Self {
        Self { re: self.re, im: -self.im }
    }

    /// What the function makes of either part.
    pub fn map(self, f: impl Fn(Fixed) -> Fixed) -> Self {
        Self { re: f(self.re), im: f(self.im) }
    }

    /// Twice the signed area of the triangle 0, self, other.
    pub fn cross(self, other: Self) -> Fixed {
        self.re * other.im - self.im * other.re
    }

    /// The square of the magnitude.
    pub fn norm(self) -> Fixed {
        self.re.square() + self.im.square()
    }

    /// `(Σ c z) / d`, as [`Fixed::mean`].
    pub fn mean(terms: impl Iterator<Item = (i64, Self)> + Clone, d: i64) -> Self {
        let part = |f: fn(Self) -> Fixed| Fixed::mean(terms.clone().map(|(c, z)| (c, f(z))), d);
        Self { re: part(|z| z.re), im: part(|z| z.im) }
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Neg for Complex {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl Mul<Fixed> for Complex {
    type Output = Self;
    fn mul(self, factor: Fixed) -> Self {
        self.map(|x| x * factor)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let re = self.re * other.re - self.im * other.im;
        Self { re, im: self.re * other.im + self.im * other.re }
    }
}
