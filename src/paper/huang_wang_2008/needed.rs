//! The subdivision depth that is needed: the least k with C_k M <= ε, or B_k M <= ε.
//!
//! Not every level has to be proved. Over the extraordinary part of level j the level-(k+j) mesh is the
//! level-k mesh of its net, and so over each regular part; hence, with the rate r_j <= 1 and the mesh
//! rate m_j,
//!
//! ```text
//! C_(k+j)(n) <= max(r_j C_k(n), m_j C_k(6)) <= max(C_k(n), m_j 4^-k / 2),
//! ```
//!
//! and B_(k+j)(n) <= max(B_k(n), m_j 4^-k / 3) likewise. So where m_j 4^-k / 2 <= ε / M, **C_(k+j) > ε / M
//! proves C_k > ε / M**; only the levels k for which that fails are looked at themselves. Mesh rates
//! multiply, with those of regular nets, 4^-j, as a floor: `m_(i+j)(n) <= max(m_i, 4^-i) max(m_j, 4^-j)`.

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
    /// Certificates: of the level; of the one before, whose net needs so many steps; of others that
    /// were needed.
    pub files: Vec<String>,
}

impl Depth {
    /// Seeks the depth for ε, M = 1.
    ///
    /// `prove` encloses the constant of a level, well enough to compare it with ε if it can; the levels
    /// below `first` cost nothing. `mesh_rate` bounds m_j. `None` if a comparison stays open.
    pub fn seek(
        against: Against,
        epsilon: &Enclosure,
        first: usize,
        mesh_rate: &dyn Fn(usize) -> Enclosure,
        prove: &mut dyn FnMut(usize) -> Option<Proved>,
    ) -> Option<Self> {
        let part = match against {
            Against::Control => 2,
            Against::Limit => 3,
        };
        let mut suffices = |k: usize| -> Option<(bool, Proved)> {
            let level = (k <= DEEPEST).then(|| prove(k))??;
            Some((level.value.at_most(epsilon)?, level))
        };
        let mut known = Vec::new();
        for k in 0..first {
            let (enough, level) = suffices(k)?;
            if enough {
                let files = std::iter::once(level).chain(known.pop()).map(|l| l.file);
                let files = files.collect();
                return Some(Depth { depth: k, files });
            }
            known.push(level);
        }
        let (mut below, before) = (known.pop()?, known.pop()?);
        let guess = first + guess(before.value.float(), below.value.float(), epsilon.float());
        // Up until a level suffices, or down until one does not.
        let mut k = guess.clamp(first, DEEPEST);
        let (mut enough, mut level) = suffices(k)?;
        let mut above: Option<Proved> = None;
        while enough && k > first {
            above = Some(level);
            k -= 1;
            (enough, level) = suffices(k)?;
        }
        while !enough && above.is_none() {
            below = level;
            k += 1;
            (enough, level) = suffices(k)?;
        }
        let (depth, above, below) = match above {
            Some(above) if !enough => (k + 1, above, level),
            _ => (k, level, below),
        };
        let mut files = vec![above.file, below.file];
        for k in first..depth.saturating_sub(1) {
            let regular = Enclosure::exactly(Rational::ratio(1, part << (2 * k)));
            let rest = mesh_rate(depth - 1 - k).times(&regular);
            if rest.at_most(epsilon) != Some(true) {
                let (enough, level) = suffices(k)?;
                if enough {
                    return None;
                }
                files.push(level.file);
            }
        }
        Some(Depth { depth, files })
    }
}

/// How many levels after the next one the constants `first`, `second`, .. seem to fall below ε.
fn guess(first: f64, second: f64, epsilon: f64) -> usize {
    let steps = (epsilon / second).ln() / (second / first).ln();
    (steps.ceil() as usize).saturating_sub(1)
}
