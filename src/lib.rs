//! Certified distances between subdivision surfaces and their meshes.
pub mod bernstein;
pub mod linalg;
pub mod mesh;
pub mod scalar;
pub mod scheme;
