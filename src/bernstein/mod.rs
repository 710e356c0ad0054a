//! Polynomials in Bernstein form.

pub mod conversion;
