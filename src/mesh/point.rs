//! A point of space over any arithmetic.

use std::ops::{Add, Mul, Sub};

use num_traits::Zero;

use crate::scalar::Ring;

/// Three coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<S>(pub [S; 3]);

impl<S: Ring> Point<S> {
    /// The scalar product.
    #[inline]
    pub fn dot(&self, other: &Self) -> S {
        let [a, b, c] = &self.0;
        let [x, y, z] = &other.0;
        a.clone() * x + &(b.clone() * y) + &(c.clone() * z)
    }

    /// The squared Euclidean length.
    #[inline]
    pub fn norm_squared(&self) -> S {
        self.dot(self)
    }
}

impl<S: Ring> Zero for Point<S> {
    #[inline]
    fn zero() -> Self {
        Point([S::zero(), S::zero(), S::zero()])
    }
    fn is_zero(&self) -> bool {
        self.0.iter().all(Zero::is_zero)
    }
}

impl<S: Ring> Add for Point<S> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self + &other
    }
}

impl<S: Ring> Add<&Point<S>> for Point<S> {
    type Output = Self;
    #[inline]
    fn add(self, other: &Self) -> Self {
        let [a, b, c] = self.0;
        Point([a + &other.0[0], b + &other.0[1], c + &other.0[2]])
    }
}

impl<S: Ring> Sub<&Point<S>> for Point<S> {
    type Output = Self;
    #[inline]
    fn sub(self, other: &Self) -> Self {
        let [a, b, c] = self.0;
        Point([a - &other.0[0], b - &other.0[1], c - &other.0[2]])
    }
}

impl<S: Ring> Mul<&S> for Point<S> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: &S) -> Self {
        let [a, b, c] = self.0;
        Point([a * factor, b * factor, c * factor])
    }
}
