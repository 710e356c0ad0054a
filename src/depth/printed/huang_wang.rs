//! Huang & Wang: (16) with C_3 to control meshes, (14) with max(β, 1/3) to limit meshes; λ = 3 for both.
//!
//! ```text
//! k = min_(0 <= j < λ) λ l_j + j,   l_j = ⌈log_(1/r_λ) (r_j C M / ε)⌉
//! ```
//!
//! is the least k = λ l + j with `ρ_k C M <= ε`, `ρ_k = r_λ^l r_j`; ρ falls with k. Constants are those of Tables 1 and 2
//! for n = 3, .., 10, each printed decimal read as the largest number that it stands for; at n = 6 what the text
//! gives, r_j = 4^-j, C_3 = 1/2, β = 1/3.
//!
//! **Why all levels.** Theorem 4 is derived with M^k over all subpatches, which is false at n = 3 (claim
//! lemma-1-meshes). That `ρ_k C M` bounds the distance to the level-k mesh all the same follows by induction. Let
//! E be the part of the face at the vertex after λ steps: its M is at most r_λ M, and k - λ steps remain. Outside
//! of E are regular parts, which appear at step s = 1, .., λ with second differences of at most m_s M (mesh rates);
//! there the distance is at most `c 4^(s-k) m_s M`, c = 1/2 or 1/3. As r_λ >= 4^-λ and m_s <= 1, it suffices that
//!
//! ```text
//! c 4^(s-k) m_s <= C ρ_k    for k = λ, .., 3 λ - 1, s <= λ, and from then on by 64 r_3 >= 1,
//! ```
//!
//! but for (14) at k = λ = 3, n = 3, where it fails and B_3 <= β r_3 is proved itself (level-bound); and the start,
//! C_k or B_k <= C r_k for k < λ. `tests/depth.rs` proves these numbers.

use super::norms::{Norm, valences};
use super::verdict::{EQ_14, EQ_16};
use super::{Needed, at_least_0, deepest, exactly};
use crate::bound::Against;
use crate::depth::{Context, Found, NoDepth};
use crate::mesh::Topology;
use crate::paper::Enclosure;
use crate::paper::huang_wang_2008::depth::steps;
use crate::paper::huang_wang_2008::printed::{TABLE_1, TABLE_2_CONTROL, TABLE_2_LIMIT, at};
use crate::scalar::{Field, Rational, Ring};

/// λ.
pub const LAMBDA: usize = 3;

/// The constants of a valence.
#[derive(Clone, Debug, PartialEq)]
pub struct Constants {
    /// C_3, or max(β, 1/3).
    pub c: Rational,
    /// r_0 = 1, r_1, r_2, r_3.
    pub rates: [Rational; LAMBDA + 1],
}

impl Constants {
    /// As printed; `None` if and only if nothing is printed for the valence.
    pub fn of(n: u32, against: Against) -> Option<Self> {
        let (table, third) = match against {
            Against::Control => (&TABLE_2_CONTROL, Rational::ratio(1, 2)),
            Against::Limit => (&TABLE_2_LIMIT, Rational::ratio(1, 3)),
        };
        let one = <Rational as Ring>::from_integer(1);
        if n == 6 {
            return Some(Constants {
                c: third,
                rates: [0, 1, 2, 3].map(|j| Rational::ratio(1, 1 << (2 * j))),
            });
        }
        let largest = |row| Some(at(row, n)?.range().hi);
        let c = largest(table)?;
        let [first, second, third_row] = &TABLE_1;
        Some(Constants {
            c: match against {
                Against::Control => c,
                Against::Limit => c.max(third),
            },
            rates: [one, largest(first)?, largest(second)?, largest(third_row)?],
        })
    }

    /// `C ρ_k`.
    pub fn at(&self, k: u32) -> Rational {
        let (l, j) = (k as usize / LAMBDA, k as usize % LAMBDA);
        (0..l).fold(&self.c * &self.rates[j], |x, _| x * &self.rates[LAMBDA])
    }
}

/// Whether something is printed for all vertices of a closed mesh.
pub(in crate::depth) fn may_be_safe(topology: &Topology, against: Against) -> bool {
    let printed = |n: &u32| Constants::of(*n, against).is_some();
    topology.is_closed() && valences(topology).iter().all(printed)
}

pub(in crate::depth) fn depth(context: &Context<'_>) -> Result<Found, NoDepth> {
    let request = context.request;
    let basis = match request.against {
        Against::Control => EQ_16,
        Against::Limit => EQ_14,
    };
    let tolerance = exactly(request.tolerance);
    deepest(context.norms()?, &tolerance, &basis, |n, norm| {
        let constants = Constants::of(n, request.against)
            .ok_or_else(|| NoDepth(format!("no constants are printed for valence {n}")))?;
        Ok(needed(constants, norm, &tolerance))
    })
}

fn needed<'a>(constants: Constants, norm: &'a Norm, tolerance: &Rational) -> Needed<'a> {
    let exact = |x: &Rational| Enclosure::exactly(x.clone());
    let rates: Vec<Enclosure> = constants.rates.iter().map(exact).collect();
    let ratio = Enclosure::exactly(&norm.second / tolerance);
    let depth = steps(&rates, &exact(&constants.c), &ratio);
    Needed {
        depth: at_least_0(depth),
        bound: Box::new(move |k| constants.at(k) * &norm.second),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn norm(m: i64) -> Norm {
        Norm {
            first: Rational::ratio(0, 1),
            second: Rational::ratio(m, 1),
        }
    }

    /// The rows of Table 3 for M / ε = 10000 with λ = 3: the control row as redone by the examination, the limit
    /// row as printed.
    #[test]
    fn depths_of_table_3() {
        let control = [8, 10, 13, 7, 17, 18, 20, 20];
        let limit = [7, 9, 12, 6, 16, 17, 18, 18];
        let one = Rational::ratio(1, 1);
        let ten_thousand = norm(10_000);
        for (i, n) in (3..=10).enumerate() {
            for (against, row) in [(Against::Control, control), (Against::Limit, limit)] {
                let constants = Constants::of(n, against).unwrap();
                let needed = needed(constants.clone(), &ten_thousand, &one);
                assert_eq!(needed.depth, row[i], "n = {n}");
                let at = &needed.bound;
                assert!(at(row[i]) <= one && at(row[i] - 1) > one, "n = {n}");
                assert!((1..30).all(|k| constants.at(k) < constants.at(k - 1)));
            }
        }
        assert_eq!(Constants::of(11, Against::Control), None);
    }

    /// n = 6 by hand: 10000 / 2 <= 4^7 = 16384, 5000 / 16384.
    #[test]
    fn regular_faces() {
        let m = norm(10_000);
        let constants = Constants::of(6, Against::Control).unwrap();
        let needed = needed(constants, &m, &Rational::ratio(1, 1));
        assert_eq!(
            (needed.depth, (needed.bound)(7)),
            (7, Rational::ratio(5000, 16384))
        );
    }
}
