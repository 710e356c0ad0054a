//! Certified distances between subdivision surfaces and their meshes.
//!
//! What is proved here: for a mesh and a scheme (Loop, Catmull-Clark, Doo-Sabin), two numbers
//! `lo <= sup |S(u) - F(u)| <= hi` that hold for the numbers in the file, with every rounding taken
//! outward, S being the limit surface and F the level-K control or limit mesh over the same
//! parameters.
//!
//! ```
//! use subcert::distance::measure::{Request, measure};
//! use subcert::distance::model::Against;
//! use subcert::distance::parametric::Goal;
//! use subcert::mesh::io::{Format, parse};
//! use subcert::scheme::{CornerRule, LoopWeights, Scheme};
//!
//! // An octahedron: every vertex P has valence 4 and its ring sums to 0, so its limit is (1 - 4 w) P;
//! // with Warren's weights 4 b = 3/8 and 4 w = 8 (3/8) / (3 + 8 (3/8)) = 1/2: it moves by 1/2.
//! let text = b"v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
//!     f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
//! let mesh = parse(text, Format::Obj, "octahedron")?.mesh;
//! let request = Request {
//!     scheme: Scheme::Loop(LoopWeights::Warren),
//!     corner: CornerRule::Smooth,
//!     level: 0,
//!     against: Against::Control,
//!     goal: Goal::default(),
//! };
//! let found = measure(&mesh, &request, &|_, _| ())?;
//! assert!(found.lo <= 0.5 && 0.5 <= found.hi && found.gap() <= 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The tour: [`scalar`] has one set of traits and four kinds of number; [`scheme`] has the masks,
//! written once over those traits; [`mesh`] and [`refine`] hold and subdivide meshes; [`bernstein`]
//! and [`patch`] turn the neighbourhood of a face into polynomials; [`distance`] searches them.
//! `ARCHITECTURE.md` shows how they hang together.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod bernstein;
pub mod bound;
pub mod certificate;
pub mod depth;
pub mod distance;
pub mod linalg;
pub mod lp;
pub mod mesh;
pub mod paper;
pub mod patch;
pub mod predict;
pub mod refine;
pub mod report;
pub mod scalar;
pub mod scheme;
pub mod spectrum;
