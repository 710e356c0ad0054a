//! Refinement against exact identities and second ways.

mod connectivity;
mod exact;
mod float;
mod meshes;
