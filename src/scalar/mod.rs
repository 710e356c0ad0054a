//! Arithmetic: one set of traits, four kinds of number.
//!
//! | type | module | what a result means |
//! |---|---|---|
//! | `f64` | [`float`] | a proposal; its rounding error is bounded elsewhere, never by the type |
//! | [`Interval`] | [`interval`] | an enclosure: it contains the exact result |
//! | [`Rational`] | [`rational`] | the exact result, as long as every mask met is rational |
//! | [`Cyclotomic`] | [`cyclotomic`] | the exact result in Q(2 cos 2π/n) |
//!
//! Every mask, matrix and Bézier conversion of this library is written once, over [`Field`]
//! coefficients and [`Module`] points, and runs in all of them. Only types with [`Decide`] may
//! answer a question of sign or order; `f64` has no such implementation.
//!
//! The cosines come from [`cosine`], by algebra; [`environment`] tests at run time what the first
//! two types assume of the processor.

use std::cmp::Ordering;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

pub mod cosine;
pub mod cyclotomic;
pub mod environment;
pub mod float;
pub mod interval;
pub mod rational;

pub use cyclotomic::Cyclotomic;
pub use interval::Interval;
pub use rational::{Rational, ShortRational};

/// A commutative ring with by-reference operators.
///
/// The idiom is `a.clone() * &b`: for `f64` it compiles to one multiplication.
pub trait Ring:
    Clone
    + Debug
    + PartialEq
    + Zero
    + One
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + Send
    + Sync
    + 'static
{
    /// The ring's image of the integer `k`.
    ///
    /// `f64` rounds to nearest beyond 2^53; [`Interval`] then returns the enclosure of the two
    /// neighbours; the exact types are exact.
    fn from_integer(k: i64) -> Self;
}

/// A field that contains the rationals and, where it can, the cosines of 2π/n.
pub trait Field: Ring + Div<Output = Self> + for<'a> Div<&'a Self, Output = Self> {
    /// The number `p / q`, `q != 0`. `f64` rounds once; intervals enclose; the others are exact.
    fn ratio(p: i64, q: i64) -> Self;

    /// `2 cos(2 π j / n)`, `n >= 1`; `None` if and only if the type cannot represent it
    /// ([`Rational`]: unless n / gcd(j, n) is 1, 2, 3, 4 or 6).
    fn two_cos(j: u32, n: u32) -> Option<Self>;
}

/// A type whose comparisons are theorems.
pub trait Decide: Field {
    /// The certain order of `self` and `other`; `None` means undecided.
    fn decide(&self, other: &Self) -> Option<Ordering>;
}

/// What masks are applied to: anything that can be added and scaled by coefficients of type `S`.
///
/// Numbers are modules over themselves, [`crate::mesh::Point`]s over their coordinate type. A
/// function written over `Module` therefore serves for points, for scalar control nets and, by
/// applying it to unit nets, for the matrices themselves.
pub trait Module<S>:
    Clone
    + Zero
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a S, Output = Self>
{
}

impl<S, V> Module<S> for V where
    V: Clone
        + Zero
        + for<'a> Add<&'a V, Output = V>
        + for<'a> Sub<&'a V, Output = V>
        + for<'a> Mul<&'a S, Output = V>
{
}
