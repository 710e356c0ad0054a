//! stub
/// stub
pub struct Rational;
