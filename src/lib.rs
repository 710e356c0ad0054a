//! Certified distances between subdivision surfaces and their meshes.
pub mod bernstein;
pub mod distance;
pub mod linalg;
pub mod mesh;
pub mod patch;
pub mod refine;
pub mod report;
pub mod scalar;
pub mod scheme;
