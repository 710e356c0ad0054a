//! Local nets, their tiles and their matrices.
//!
//! | module | oracle |
//! |---|---|
//! | `loop_nets`, `catmull_clark_nets`, `doo_sabin_nets` | subdivision of a list of faces by brute force |
//! | `matrices` | spectral theory, block by block; enclosure in intervals |
//! | `second_differences` | dimension of the kernels; the edges of the net |
//!
//! Everything is exact: over the rationals where all masks are rational, else over Q(2 cos 2π/n).

mod brute_force;
mod catmull_clark_nets;
mod doo_sabin_nets;
#[path = "../exact/mod.rs"]
mod exact;
mod loop_nets;
mod matrices;
mod nets;
mod second_differences;
