//! The distances μ of eigensplines that estimates rest on.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

use super::kernel::ModeWeights;
use crate::bound::Against;
use crate::scalar::float::round_up;
use crate::scheme::LoopWeights;
use crate::spectrum::eigenspline::{self, mode::ModeFamily};

/// The largest valence in the table.
pub const LARGEST: u32 = 30;

/// The deepest level in the table.
pub const DEEPEST: u32 = 5;

/// The valence, the weights and the mesh of a part of the table.
type Key = (u32, bool, bool);

/// Upper bounds by level.
type Levels = Option<Arc<Vec<ModeWeights>>>;

/// Upper bounds of μ_i(m), m <= [`DEEPEST`], for the modes of valence n that count, n <= [`LARGEST`]: the upper
/// ends of [`eigenspline::distances`], rounded upwards.
///
/// `None` beyond the table. The distances of a valence are enclosed when they are first asked for.
pub fn distances(weights: LoopWeights, n: u32, against: Against, m: u32) -> Option<ModeWeights> {
    static FOUND: OnceLock<Mutex<BTreeMap<Key, Levels>>> = OnceLock::new();
    if !(3..=LARGEST).contains(&n) || m > DEEPEST {
        return None;
    }
    let found = FOUND.get_or_init(Mutex::default);
    let key = (n, weights == LoopWeights::Warren, against == Against::Limit);
    let known = found.lock().ok()?.get(&key).cloned();
    // Enclosed outside of the lock: several threads work at it.
    let levels = match known {
        Some(levels) => levels,
        None => {
            let levels = enclose(weights, n, against).map(Arc::new);
            found.lock().ok()?.entry(key).or_insert(levels).clone()
        }
    };
    levels?.get(m as usize).cloned()
}

fn enclose(weights: LoopWeights, n: u32, against: Against) -> Option<Vec<ModeWeights>> {
    let against = match against {
        Against::Control => eigenspline::Against::Control,
        Against::Limit => eigenspline::Against::Limit,
    };
    let modes = eigenspline::distances(weights, n, against, DEEPEST as usize)?;
    let at = |m: usize| {
        let mut found = ModeWeights {
            ring: Vec::new(),
            between: f64::INFINITY,
            ray: f64::INFINITY,
        };
        for mode in &modes {
            let hi = round_up(&mode.distances[m][1]);
            match (mode.label.family, mode.label.frequency) {
                (ModeFamily::Ring, _) => found.ring.push(hi),
                (ModeFamily::Between, _) => found.between = hi,
                // The chain of a generalised mode is no member of the basis.
                (ModeFamily::Ray, Some(_)) => (),
                (ModeFamily::Ray, None) => found.ray = hi,
            }
        }
        found
    };
    Some((0..=DEEPEST as usize).map(at).collect())
}
