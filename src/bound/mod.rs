//! Bound constants, with proofs.
pub mod functional;
pub mod nets;
pub mod value;
pub mod word;
pub mod cell;
pub mod constant;
pub mod prover;
pub mod quartic;
