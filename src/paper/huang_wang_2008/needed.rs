//! The subdivision depth that is needed: the least k with C_k M <= ε, or B_k M <= ε.
//!
//! Not every level has to be proved. The level-(k+j) mesh over the extraordinary part of level j is the
//! level-k mesh of its net, and so over each regular part; hence, with r_j and m_j <= 1 the rate and
//! the mesh rate,
//!
//! ```text
//! C_(k+j)(n) <= max(r_j C_k(n), m_j C_k(6)) <= max(C_k(n), 4^-k / 2),
//! ```
//!
//! and B_(k+j)(n) <= max(B_k(n), 4^-k / 3) likewise. So where 4^-k / 2 <= ε / M, **C_d > ε / M excludes
//! every level from k to d**; only the few levels before that k are looked at one by one.

use super::valence::Proved;
use crate::bound::Against;
use crate::paper::Enclosure;
use crate::scalar::{Field, Rational};

/// The largest level at which depths are sought.
const DEEPEST: usize = 28;

/// The subdivision depth that ε asks for.
#[derive(Clone, Debug)]
pub struct Depth {
    /// The smallest k with a constant of level k proved <= ε.
    pub depth: usize,
    /// Certificates: of the level, and of the one before, whose net needs so many steps.
    pub files: Vec<String>,
}

impl Depth {
    /// Seeks the depth for ε, M = 1; `prove` encloses the constant of a level, well enough to compare
    /// it with ε if it can. `None` if a comparison stays open.
    pub fn seek(
        against: Against,
        epsilon: &Enclosure,
        prove: &mut dyn FnMut(usize) -> Option<Proved>,
    ) -> Option<Self> {
        let part = match against {
            Against::Control => 2,
            Against::Limit => 3,
        };
        let regular = |k: usize| {
            let constant = Rational::ratio(1, part << (2 * k));
            Enclosure::exactly(constant)
        };
        let mut suffices = |k: usize| -> Option<(bool, Proved)> {
            let level = (k <= DEEPEST).then(|| prove(k))??;
            Some((level.value.at_most(epsilon)?, level))
        };
        let found = |depth: usize, levels: Vec<Proved>| {
            let files = levels.into_iter().map(|level| level.file).collect();
            Some(Depth { depth, files })
        };
        let mut before: Vec<Proved> = Vec::new();
        let mut k = 0;
        while k < 2 || regular(k).at_most(epsilon) == Some(false) || before.len() < 2 {
            let (enough, level) = suffices(k)?;
            if enough {
                let levels = std::iter::once(level).chain(before.pop()).collect();
                return found(k, levels);
            }
            before.push(level);
            k += 1;
        }
        // From here on one level that does not suffice excludes all before it.
        let mut below = before.pop()?;
        let guess = k + guess(
            before.pop()?.value.float(),
            below.value.float(),
            epsilon.float(),
        );
        let mut at = guess.clamp(k, DEEPEST);
        let mut above: Option<Proved> = None;
        loop {
            let (enough, level) = suffices(at)?;
            match (enough, &above) {
                (true, _) if at == k => return found(at, vec![level, below]),
                (true, _) => {
                    above = Some(level);
                    at -= 1;
                }
                (false, Some(_)) => return found(at + 1, vec![above?, level]),
                (false, None) => {
                    below = level;
                    at += 1;
                    k = at;
                }
            }
        }
    }
}

/// How many levels after the next one the constants `first`, `second`, .. seem to fall below ε.
fn guess(first: f64, second: f64, epsilon: f64) -> usize {
    let steps = (epsilon / second).ln() / (second / first).ln();
    (steps.ceil() as usize).saturating_sub(1)
}
