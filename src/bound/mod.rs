//! Bound constants of the schemes, two-sided, with proofs.
//!
//! For a net y of the points that govern a face with one extraordinary vertex of valence n, M is the
//! largest of some differences of the net:
//!
//! | scheme | points | norm | differences |
//! |---|---|---|---|
//! | Loop | n + 6 | second | n + 9 mixed second differences, HW (1) |
//! | Catmull-Clark | 2n + 8 | second | 2n + 10 second differences, CY's second-order norm |
//! | | | first | 2n + 18 first differences, CY (17), (18) |
//! | Doo-Sabin | n + 5 | face | 6 second differences, and the diameter of the face of n sides |
//!
//! This room encloses
//!
//! | constant | what it is | [`Constant`] |
//! |---|---|---|
//! | `C_k(n)` | sup `|S - F_k| / M` over nets and the face, F_k the level-k control mesh | `Distance(Control, k)` |
//! | `B_k(n)` | the same with the level-k limit mesh (not for Doo-Sabin, whose net does not determine it) | `Distance(Limit, k)` |
//! | `r_k(n)` | sup `M_k / M`, M_k of the extraordinary net of level k | `Rate(k)` |
//! | | the same over the nets of all 4^k parts of level k | `MeshRate(k)` |
//! | `δ_i` | sup `|b_i - b̄_i| / M`, one Bernstein coefficient (Loop) | `Coefficient` |
//!
//! What is known in closed form, proved for each n of the range by exact programs (see the tests; "~": a
//! two-sided enclosure within 1e-6 that holds the form):
//!
//! | | constant | n |
//! |---|---|---|
//! | Loop | C_0 = max(1/2, 8β/(3 + 8β)) | 3..50 |
//! | Catmull-Clark, second | C_0 = 1/3, but 3/8 at 3 | 3..50 |
//! | | r_1 = 3/4 + 2/n - 23/(2n^2) (odd), - 12/n^2 (2 mod 4), - 16/n^2 (0 mod 4); 2/3 at 3, 18/25 at 5, 1/4 at 4 | 3..50 |
//! | Catmull-Clark, first | C_0 = 5/9, but 5/8 at 3 (~ at 4); r_1 = 3/4 + 7/(4n) - 13/(2n^2) from 6 on | 3..50 |
//! | Doo-Sabin | C_0 = 27/64 - (11 + 4 cos 2π/n)/(16 n) (~ at 5 and 12) | 5..19 |
//!
//! **Why the diameter.** S - F is not 0 on the affine image of a regular n-gon, n not 4, so a norm that
//! bounds it must not vanish there; and no rational combination of points vanishes on these nets alone.
//! Of the norms that see them the diameter keeps the constants bounded: with the sides of the face in its
//! place C_0 grows like n, and r_1 exceeds 1 from n = 9 on.
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
//! **Exact.** Nets of functionals are computed with the irrational numbers of the scheme as variables
//! ([`value::Numbers`]): identities hold whatever they are, and only sizes need their values. So the
//! exact field Q(cos 2π/n) is met once, when a closed form is printed. Floats propose bases, points and
//! bounds; nothing rests on them.
//!
//! **One prover, three schemes.** What a scheme is, [`rules`] says: refinement, tiles, surface, mesh,
//! differences. What a patch is, [`shape`] says. Nothing else knows.
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
