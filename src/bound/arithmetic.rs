//! Arithmetics for nets of functionals: floats, which propose, and exact ones, which decide.

use num_traits::Zero;

use super::functional::{ExactFunctional, FloatFunctional, Integer};
use super::value::Numbers;
use crate::scalar::{Field, Module, ShortRational};

/// An arithmetic for nets of functionals of a first net.
///
/// Targets come multiplied by a positive factor: in exact arithmetic by Loop's q = 3 + 8 n b, so that
/// all of them are polynomials in b; else by 1.
pub trait Arithmetic: Sync + Send {
    /// Coefficients of the masks.
    type S: Field;
    /// Functionals.
    type V: Module<Self::S> + Send + Sync;
    /// The coordinate functional `point` (from 0) of a net of `size` points.
    fn unit(&self, size: usize, point: usize) -> Self::V;
    /// The ring weight b times a functional.
    fn times_weight(&self, functional: &Self::V) -> Self::V;
    /// 2 cos(2πm/n) times a functional.
    fn times_two_cos(&self, m: u32, n: u32, functional: &Self::V) -> Self::V;
    /// From q times a functional to the factor times it, q = 3 + 8 n b.
    fn over_q(&self, n: u32, times_q: Self::V) -> Self::V;
    /// The factor times a functional, where the scheme has q.
    fn times_q(&self, n: u32, functional: &Self::V) -> Self::V;
}

/// `f64`: proposals.
#[derive(Clone, Debug)]
pub struct Floats {
    weight: f64,
}

impl Floats {
    /// With the numbers of a scheme.
    pub fn new(numbers: &Numbers) -> Self {
        Floats {
            weight: numbers.ring_weight().enclose().mid(),
        }
    }
}

impl Arithmetic for Floats {
    type S = f64;
    type V = FloatFunctional;

    fn unit(&self, size: usize, point: usize) -> FloatFunctional {
        let mut unit = vec![0.0; size];
        unit[point] = 1.0;
        FloatFunctional(unit)
    }
    fn times_weight(&self, functional: &FloatFunctional) -> FloatFunctional {
        functional.clone() * &self.weight
    }
    fn times_two_cos(&self, m: u32, n: u32, functional: &FloatFunctional) -> FloatFunctional {
        let cosine = f64::two_cos(m, n).expect("f64 has every cosine");
        functional.clone() * &cosine
    }
    fn over_q(&self, n: u32, times_q: FloatFunctional) -> FloatFunctional {
        times_q * &(1.0 / (3.0 + 8.0 * f64::from(n) * self.weight))
    }
    fn times_q(&self, _n: u32, functional: &FloatFunctional) -> FloatFunctional {
        functional.clone()
    }
}

/// Exact, with the numbers of the scheme as variables.
#[derive(Clone, Debug, Default)]
pub struct Exact<T> {
    integers: std::marker::PhantomData<T>,
}

impl<T> Exact<T> {
    /// The arithmetic.
    pub fn new() -> Self {
        Exact {
            integers: std::marker::PhantomData,
        }
    }
}

impl<T: Integer> Arithmetic for Exact<T> {
    type S = ShortRational;
    type V = ExactFunctional<T>;

    fn unit(&self, size: usize, point: usize) -> Self::V {
        ExactFunctional::unit(size, point)
    }
    fn times_weight(&self, functional: &Self::V) -> Self::V {
        functional.times_weight()
    }
    fn times_two_cos(&self, m: u32, n: u32, functional: &Self::V) -> Self::V {
        functional.times_two_cos(m, n)
    }
    fn over_q(&self, _n: u32, times_q: Self::V) -> Self::V {
        times_q
    }
    fn times_q(&self, n: u32, functional: &Self::V) -> Self::V {
        let integer = |k: i64| ShortRational::from_integer(k);
        if functional.is_zero() {
            return functional.clone();
        }
        functional.clone() * &integer(3) + &(functional.times_weight() * &integer(8 * i64::from(n)))
    }
}
