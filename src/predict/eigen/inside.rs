//! Does chi(S_n) stay over the facets whose corners are limit points?
//!
//! The outer boundary of those facets has its corners on the outer curve of chi(S_n). Within a sector the
//! curve c, run through counterclockwise, turns away from the centre where `det(c', c'') < 0`: then every chord
//! lies outside of it, at every level, and chi(S_n) inside. Where `det(c', c'') > 0` throughout, the curve lies
//! outside of its chords, and chi leaves the facets. Decided by the signs of Bernstein coefficients of the two
//! patches at the curve. At n = 6 the curve is the chord.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock};

use crate::bernstein::from_net::box_spline;
use crate::scalar::{Decide, Field, Interval, Ring};
use crate::scheme::{LoopWeights, Tile, loop_scheme};
use crate::spectrum::loop_modes::{Family, loop_modes};

/// Whether chi(S_n) stays over the facets between limit points of every level: `Some(false)` if it certainly
/// leaves them, `None` if undecided.
///
/// # Panics
/// If n < 3.
pub fn stays_inside(n: u32) -> Option<bool> {
    static FOUND: OnceLock<Mutex<BTreeMap<u32, Option<bool>>>> = OnceLock::new();
    if n == 6 {
        return Some(true);
    }
    let found = FOUND.get_or_init(Mutex::default);
    if let Some(known) = found.lock().ok().and_then(|map| map.get(&n).copied()) {
        return known;
    }
    let inside = turning(n);
    if let Ok(mut map) = found.lock() {
        map.insert(n, inside);
    }
    inside
}

fn turning(n: u32) -> Option<bool> {
    let weights = LoopWeights::Original;
    let (spectrum, modes) = loop_modes::<Interval>(weights, n)?;
    let is_chi = |family, frequency| family == Family::Ring && frequency == 1;
    let (_, members) = modes.iter().find(|(m, _)| is_chi(m.family, m.frequency))?;
    // The odd net is the sine over a positive number: turning keeps its sense.
    let nets: Vec<Vec<Interval>> = members.iter().map(|&m| spectrum.net(m)).collect();
    let curve = |tile: Tile| -> Option<Vec<[Interval; 2]>> {
        let coordinate = |net: &Vec<Interval>| {
            let local = spectrum.ring().local_net(0, net);
            let extended = loop_scheme::extended_net::<Interval, Interval>(weights, n, &local)?;
            let patch =
                box_spline::<Interval, Interval>(&loop_scheme::tile_net(n, tile, &extended));
            // The edge from corner 1 to corner 2.
            Some([10, 11, 12, 13, 14].map(|i: usize| patch.0[i]))
        };
        let (x, y) = (coordinate(&nets[0])?, coordinate(&nets[1])?);
        Some((0..5).map(|i| [x[i], y[i]]).collect())
    };
    let zero = Interval::from_integer(0);
    let mut signs = Vec::new();
    for tile in [Tile::First, Tile::Third] {
        // In Stam's numbering the sector's ray j + 1 comes first: the edge runs clockwise, so that turning
        // away from the centre is turning to the left.
        let turning = cross_of_derivatives(&curve(tile)?);
        signs.extend(turning.iter().map(|t| t.decide(&zero)));
    }
    let all = |wanted: Ordering| signs.iter().all(|s| *s == Some(wanted));
    match (all(Ordering::Greater), all(Ordering::Less)) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

/// The Bernstein coefficients of `det(c', c'')` over 36, c a plane curve of degree 4:
/// `t_k = Σ_(i+j=k) C(3,i) C(2,j) det(D_i, E_j) / C(5,k)`, D and E first and second differences.
fn cross_of_derivatives(c: &[[Interval; 2]]) -> Vec<Interval> {
    let differences = |c: &[[Interval; 2]]| -> Vec<[Interval; 2]> {
        c.windows(2)
            .map(|p| [p[1][0] - p[0][0], p[1][1] - p[0][1]])
            .collect()
    };
    let first = differences(c);
    let second = differences(&first);
    let (three, two, five) = ([1, 3, 3, 1], [1, 2, 1], [1, 5, 10, 10, 5, 1]);
    let coefficient = |k: usize| {
        let mut sum = Interval::from_integer(0);
        for (i, d) in first.iter().enumerate() {
            if let Some(e) = k.checked_sub(i).and_then(|j| second.get(j)) {
                let weight = Interval::ratio(three[i] * two[k - i], five[k]);
                sum += weight * (d[0] * e[1] - d[1] * e[0]);
            }
        }
        sum
    };
    (0..6).map(coefficient).collect()
}
