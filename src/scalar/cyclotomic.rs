//! stub
/// stub
pub struct Cyclotomic;
