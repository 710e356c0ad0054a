//! Complex numbers over any field of this library: points of the plane, values of modes.

use std::ops::{Add, Mul, Sub};

use num_traits::Zero;

use crate::scalar::Field;

/// The number `re + i im`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex<S> {
    /// Real part.
    pub re: S,
    /// Imaginary part.
    pub im: S,
}

impl<S: Field> Complex<S> {
    /// A real number.
    pub fn real(re: S) -> Self {
        Complex { re, im: S::zero() }
    }

    /// `e^(2πi m/n)`; `None` if and only if S lacks one of its parts.
    ///
    /// `sin(2πm/n) = cos(2πm/n - π/2) = cos(2π(4m - n)/(4n))`.
    pub fn root_of_unity(m: u32, n: u32) -> Option<Self> {
        let half = S::ratio(1, 2);
        let shifted = (i64::from(4 * m) - i64::from(n)).unsigned_abs();
        Some(Complex {
            re: S::two_cos(m % n, n)? * &half,
            im: S::two_cos(u32::try_from(shifted).ok()? % (4 * n), 4 * n)? * &half,
        })
    }

    /// The conjugate.
    pub fn conjugate(&self) -> Self {
        Complex {
            re: self.re.clone(),
            im: -self.im.clone(),
        }
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Self {
        let (a, b) = (self, other);
        Complex {
            re: a.re.clone() * &b.re - &(a.im.clone() * &b.im),
            im: a.re.clone() * &b.im + &(a.im.clone() * &b.re),
        }
    }

    /// Twice the signed area of the triangle (0, self, other).
    pub fn cross(&self, other: &Self) -> S {
        self.re.clone() * &other.im - &(self.im.clone() * &other.re)
    }
}

impl<S: Field> Zero for Complex<S> {
    fn zero() -> Self {
        Self::real(S::zero())
    }
    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }
}

impl<S: Field> Add for Complex<S> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self + &other
    }
}

impl<S: Field> Add<&Self> for Complex<S> {
    type Output = Self;
    #[inline]
    fn add(self, other: &Self) -> Self {
        Complex {
            re: self.re + &other.re,
            im: self.im + &other.im,
        }
    }
}

impl<S: Field> Sub<&Self> for Complex<S> {
    type Output = Self;
    #[inline]
    fn sub(self, other: &Self) -> Self {
        Complex {
            re: self.re - &other.re,
            im: self.im - &other.im,
        }
    }
}

impl<S: Field> Mul<&S> for Complex<S> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: &S) -> Self {
        Complex {
            re: self.re * factor,
            im: self.im * factor,
        }
    }
}
