//! What people and programs read: text, JSON, per-face files.

pub mod constants;
pub mod faces;
pub mod measurement;
