//! Uniform quadratic and cubic B-spline curves.
