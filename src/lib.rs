//! Certified distances between subdivision surfaces and their meshes.
pub mod linalg;
pub mod mesh;
pub mod refine;
pub mod scalar;
pub mod scheme;
