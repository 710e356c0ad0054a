//! Cheng & Yong: Theorem 9, and Theorem 4 for faces without an extraordinary vertex.
//!
//! With n = n_ε of (23), the distance to the level-k mesh, k at least the depth of Theorem 9, is at most
//!
//! ```text
//! max( 7/2 G^0 δ^-n,  max_(1 <= j <= n) W^j Z^0 / (3 · 4^(k-j)) ):
//! ```
//!
//! the points of level n near the vertex lie in a ball of radius 7/4 G^0 δ^-n (Lemma 5, (20)), and those of later levels
//! in their hull; the faces that leave the neighbourhood of the vertex at level j are regular (Lemma 8).

use num_traits::One;

use super::norms::{Norm, valences};
use super::verdict::{THEOREM_4, THEOREM_9};
use super::{Needed, at_least_0, deepest, exactly};
use crate::depth::{Context, Found, NoDepth};
use crate::mesh::Topology;
use crate::paper::cheng_yong::depth::{n_epsilon, theorem_4, theorem_9, w};
use crate::paper::cheng_yong::printed::{EQ_23_FACTOR, QUARTER, THIRD, delta};
use crate::scalar::{Field, Rational};

/// The verdict on Theorem 9 was computed for valences up to this one, from 3.
pub const JUDGED: u32 = 20;

/// Whether the verdict is known for all vertices of a closed mesh; polygons become vertices.
pub(in crate::depth) fn may_be_safe(topology: &Topology) -> bool {
    let sizes = (0..topology.face_count()).map(|f| topology.face_size(f));
    let mut all = sizes.chain(valences(topology));
    topology.is_closed() && all.all(|n| n <= JUDGED)
}

pub(in crate::depth) fn depth(context: &Context<'_>) -> Result<Found, NoDepth> {
    let norms = context.norms()?;
    let tolerance = exactly(context.request.tolerance);
    let only_regular = norms.by_valence.keys().all(|&n| n == 4);
    let basis = match only_regular {
        true => THEOREM_4,
        false => THEOREM_9,
    };
    let mut found = deepest(norms, &tolerance, &basis, |n, norm| match n {
        4 => Ok(regular(norm, &tolerance)),
        _ => extraordinary(n, norm, &tolerance),
    })?;
    if let Some(&n) = norms.by_valence.keys().find(|&&n| n > JUDGED) {
        found.safe = false;
        found.why = format!(
            "valence {n}: cheng-yong theorem-9 is decided for valences up to {JUDGED}, not for all"
        );
    }
    Ok(found)
}

fn regular<'a>(norm: &'a Norm, tolerance: &Rational) -> Needed<'a> {
    Needed {
        depth: at_least_0(theorem_4(&norm.second, tolerance)),
        bound: Box::new(|k| after(&norm.second, k)),
    }
}

fn extraordinary<'a>(n: u32, norm: &'a Norm, tolerance: &Rational) -> Result<Needed<'a>, NoDepth> {
    let not_printed = || NoDepth(format!("nothing is printed for valence {n}"));
    if n < 3 {
        return Err(not_printed());
    }
    let depth = theorem_9(n, &norm.first, &norm.second, tolerance);
    let depth = at_least_0(Some(depth.ok_or_else(not_printed)?));
    let (w, delta) = (
        w(n).ok_or_else(not_printed)?,
        delta(n).ok_or_else(not_printed)?,
    );
    let levels = at_least_0(n_epsilon(n, &norm.first, tolerance));
    let bound = move |k: u32| {
        let (p, q) = EQ_23_FACTOR;
        let near = (0..levels).fold(Rational::ratio(p, q) * &norm.first, |x, _| x / &delta);
        let mut power = Rational::one();
        (1..=levels.min(k)).fold(near, |largest, j| {
            power *= &w;
            largest.max(after(&(&power * &norm.second), k - j))
        })
    };
    Ok(Needed {
        depth,
        bound: Box::new(bound),
    })
}

/// (6): `M / (3 · 4^k)`, k steps after second differences of at most M.
fn after(m: &Rational, k: u32) -> Rational {
    // One product: each costs a greatest common divisor.
    let quarters = Rational::ratio(QUARTER.0, QUARTER.1).pow(k as i32);
    m * (Rational::ratio(THIRD.0, THIRD.1) * quarters)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn r(p: i64, q: i64) -> Rational {
        Rational::ratio(p, q)
    }

    /// By hand, N = 3, δ = 4/3, W = 2/3, ε = 1: 7/2 G = (4/3)^2, so n_ε = 2; Z = 28: D = 4 (W^2 Z / 3 = 112/27 <= 4^2).
    /// At level 4: 7/2 G (3/4)^2 = 1, W Z / (3 · 4^3) = 56/576, W^2 Z / (3 · 4^2) = 112/432.
    #[test]
    fn theorem_9_at_valence_3() {
        let norm = Norm {
            first: r(32, 63),
            second: r(28, 1),
        };
        let needed = extraordinary(3, &norm, &r(1, 1)).unwrap();
        assert_eq!(needed.depth, 4);
        assert_eq!((needed.bound)(4), r(1, 1));
        // With a smaller first norm the regular parts count: 7/2 G = 17/10 < 16/9 still asks for two steps.
        let norm = Norm {
            first: r(17, 35),
            second: r(280, 1),
        };
        let needed = extraordinary(3, &norm, &r(1, 1)).unwrap();
        // W Z / 3 = 560/9 <= 4^3: 1 + 3; W^2 Z / 3 = 1120/27 = 41.5 <= 4^3: 2 + 3.
        assert_eq!(needed.depth, 5);
        assert_eq!((needed.bound)(5), r(17 * 9, 160).max(r(1120, 27 * 64)));
        assert!(extraordinary(2, &norm, &r(1, 1)).is_err());
    }

    /// By hand: M = 100: M / 3 = 33.3 <= 4^3, and 100 / (3 · 64) = 25/48.
    #[test]
    fn theorem_4_of_regular_faces() {
        let norm = Norm {
            first: r(0, 1),
            second: r(100, 1),
        };
        let needed = regular(&norm, &r(1, 1));
        assert_eq!((needed.depth, (needed.bound)(3)), (3, r(25, 48)));
        assert_eq!(regular(&norm, &r(1000, 1)).depth, 0);
    }
}
