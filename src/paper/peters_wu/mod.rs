//! dev
pub mod experiment;
pub mod meshes;
pub mod observations;
pub mod printed;
pub mod redone;
