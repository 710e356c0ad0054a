//! Refinement against exact identities and second ways.

mod connectivity;
mod meshes;
