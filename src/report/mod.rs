//! What people and programs read: text, JSON, per-face files, plots.

pub mod constants;
pub mod depth;
pub mod faces;
pub mod hausdorff;
pub mod measurement;
pub mod paper;
pub mod papers;
pub mod picture;
pub mod plots;
pub mod spectrum;
