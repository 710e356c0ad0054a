//! Certified distances between a subdivision surface and its meshes.
//!
//! | file | idea |
//! |---|---|
//! | `search` | best-first branch and bound; knows no geometry |
//! | `model` | what a face of each scheme yields: patches and nets of S - F |
//! | `close` | ends the search at a smooth maximum |
//! | `face` | the supremum over a face |
//! | `parametric` | the supremum over a mesh, in two passes |
//! | `hausdorff` | one-sided and symmetric Hausdorff distances, to any mesh |
//! | `certify` | certificates of Hausdorff distances of small meshes |
//! | `measure` | from a mesh to an enclosure in its own unit |

pub mod certify;
pub mod close;
pub mod face;
pub mod hausdorff;
pub mod measure;
pub mod model;
pub mod parametric;
pub mod search;
