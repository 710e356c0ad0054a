//! The distances μ of eigensplines that estimates rest on.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

use super::beyond::Recurrence;
use super::kernel::ModeWeights;
use crate::bound::Against;
use crate::scalar::float::round_up;
use crate::scheme::LoopWeights;
use crate::spectrum::eigenspline::mode::{Label, ModeFamily};
use crate::spectrum::eigenspline::{self, table};

/// The largest valence whose distances are known. Those up to 30 are in the file of [`table`]; each further
/// valence takes less than a minute on two cores when it is first met.
pub const LARGEST: u32 = 64;

/// The deepest level in the table.
pub const DEEPEST: u32 = 6;

/// The deepest level that the recurrence is followed to.
pub const LAST: u32 = 64;

/// The valence, the weights and the mesh of a part of the table.
type Key = (u32, bool, bool);

/// Upper bounds by level; `None` where they can't be had.
type Levels = Option<Arc<Vec<ModeWeights>>>;

/// What was computed once.
type Known = OnceLock<Mutex<BTreeMap<Key, Levels>>>;

/// Upper bounds of μ_i(m) for the modes of valence n that count, 3 <= n <= [`LARGEST`], m <= [`LAST`].
///
/// Up to [`DEEPEST`] they are those of [`table::upper`]; what that table lacks is enclosed when it is
/// first asked for ([`eigenspline::distances`]). Beyond, the recurrence of
/// [`super::beyond`] goes on from level [`DEEPEST`].
///
/// `None` beyond these valences and levels, or where the distances can't be enclosed.
pub fn distances(weights: LoopWeights, n: u32, against: Against, m: u32) -> Option<ModeWeights> {
    if !(3..=LARGEST).contains(&n) || m > LAST {
        return None;
    }
    if m <= DEEPEST {
        return tabulated(weights, n, against, m);
    }
    static KNOWN: Known = OnceLock::new();
    let levels = once(&KNOWN, weights, n, against, || {
        let recurrence = Recurrence::new(weights, n, against)?;
        let start = tabulated(weights, n, against, DEEPEST)?;
        let next = |mu: &mut ModeWeights, m: u32| {
            *mu = recurrence.next(mu, m);
            Some(mu.clone())
        };
        Some((DEEPEST..LAST).scan(start, next).collect())
    });
    levels?.get((m - DEEPEST - 1) as usize).cloned()
}

/// The same up to [`DEEPEST`].
fn tabulated(weights: LoopWeights, n: u32, against: Against, m: u32) -> Option<ModeWeights> {
    let polyhedron = match against {
        Against::Control => eigenspline::Against::Control,
        Against::Limit => eigenspline::Against::Limit,
    };
    if let Some(bounds) = table::upper(weights, n, polyhedron, m as usize) {
        return complete(n, bounds.iter().map(|b| (b.label, b.bound)));
    }
    static KNOWN: Known = OnceLock::new();
    let levels = once(&KNOWN, weights, n, against, || {
        enclose(weights, n, polyhedron)
    });
    levels?.get(m as usize).cloned()
}

/// What is known of a valence, computed at the first time.
fn once(
    known: &'static Known,
    weights: LoopWeights,
    n: u32,
    against: Against,
    compute: impl FnOnce() -> Option<Vec<ModeWeights>>,
) -> Levels {
    let known = known.get_or_init(Mutex::default);
    let key = (n, weights == LoopWeights::Warren, against == Against::Limit);
    if let Some(levels) = known.lock().ok()?.get(&key) {
        return levels.clone();
    }
    // Computed outside of the lock: several threads work at it.
    let levels = compute().map(Arc::new);
    known.lock().ok()?.entry(key).or_insert(levels).clone()
}

fn enclose(
    weights: LoopWeights,
    n: u32,
    polyhedron: eigenspline::Against,
) -> Option<Vec<ModeWeights>> {
    let modes = eigenspline::distances(weights, n, polyhedron, DEEPEST as usize)?;
    let at = |m: usize| {
        let upper = |mode: &eigenspline::ModeDistances| round_up(&mode.distances[m][1]);
        complete(n, modes.iter().map(|mode| (mode.label, upper(mode))))
    };
    (0..=DEEPEST as usize).map(at).collect()
}

/// Bounds by mode as weights, in the order of the frequencies 0, 2, 3, .., n/2; `None` if one is missing.
pub(super) fn complete(n: u32, bounds: impl Iterator<Item = (Label, f64)>) -> Option<ModeWeights> {
    let mut frequencies = Vec::new();
    let mut found = ModeWeights {
        ring: Vec::new(),
        between: f64::INFINITY,
        ray: f64::INFINITY,
    };
    for (label, bound) in bounds {
        match (label.family, label.frequency) {
            (ModeFamily::Ring, frequency) => {
                frequencies.extend(frequency);
                found.ring.push(bound);
            }
            (ModeFamily::Between, _) => found.between = bound,
            (ModeFamily::Ray, None) => found.ray = bound,
            // What the chain of a generalised mode leads to is no member of the basis.
            (ModeFamily::Ray, Some(_)) => (),
        }
    }
    let all = frequencies
        .iter()
        .copied()
        .eq((0..=n / 2).filter(|&k| k != 1));
    (all && found.between.is_finite() && found.ray.is_finite()).then_some(found)
}
