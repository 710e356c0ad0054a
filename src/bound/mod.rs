//! Bound constants of Loop's scheme, two-sided, with proofs.
//!
//! For a net y of the n + 6 points that govern a face with one extraordinary vertex of valence n, M is
//! the largest of its n + 9 mixed second differences. This room encloses
//!
//! | constant | what it is | [`Constant`] |
//! |---|---|---|
//! | `C_k(n)` | sup `|S - F_k| / M` over nets and the face, F_k the level-k control mesh | `Distance(Control, k)` |
//! | `B_k(n)` | the same with the level-k limit mesh | `Distance(Limit, k)` |
//! | `r_k(n)` | sup `M_k / M`, M_k of the extraordinary net of level k | `Rate(k)` |
//! | | the same over the nets of all 4^k parts of level k | `MeshRate(k)` |
//! | `δ_i` | sup `|b_i - b̄_i| / M`, one Bernstein coefficient | `Coefficient` |
//!
//! All are dimensionless and mean the same for nets with values in any normed space.
//!
//! **The lower side** is a rational net with M <= 1 and a point where it attains the bound.
//!
//! **The upper side.** Every target is a functional t of the net, and `‖t‖ = sup |t(y)| / M(y)` is a
//! linear program ([`crate::lp`]): `t = Σ x_l α_l` proves `‖t‖ <= Σ |x_l|`. Over a part of the face
//! where S is one quartic the multipliers x are quartics too; a few bases serve the whole face
//! ([`cell`]). The infinitely many parts at the extraordinary corner are closed by a bound of S - F_0
//! there that carries itself from ring to ring ([`constant::Lemma`]).
//!
//! **Exact.** Nets of functionals are computed with the ring weight b as a variable: identities hold
//! for every b, and only sizes need its value. So the exact field Q(cos 2π/n) is met once, when a
//! closed form is printed. Floats propose bases, points and bounds; nothing rests on them.
//!
//! `proofs/FORMAT.md` states each rule with its proof; [`Proof`]s become certificates
//! ([`crate::certificate`]) that `subcert-check` verifies by its own means.
//!
//! ```
//! use subcert::bound::{Against, Constant, Prover};
//! use subcert::scheme::LoopWeights;
//! // HW Theorem 2: for regular patches B_0 = 1/3.
//! let mut prover = Prover::new(LoopWeights::Original, 6);
//! let proof = prover.prove(Constant::Distance(Against::Limit, 0), 1e-6).unwrap();
//! assert_eq!(prover.closed_form(&proof).unwrap().to_string(), "1/3");
//! ```

pub mod arithmetic;
mod beta;
pub mod cell;
pub mod constant;
pub mod curve;
mod distance;
mod export;
pub mod face_rate;
pub mod functional;
mod lemma;
pub mod maximum;
pub mod nets;
mod part;
mod prover;
mod rate;
pub mod rules;
mod search;
pub mod shape;
mod table;
mod tail;
pub mod value;
pub mod word;

pub use constant::{Constant, Proof};
pub use export::cosine_of_loop;
pub use nets::Against;
pub use part::CellProof;
pub use prover::{Bound, Candidate, Prover};
pub use rules::{Family, Norm};
pub use table::{Row, tabulate};
pub use tail::TailProof;
