//! Upper bounds of the distances as a table: what certificates prove, for programs in a hurry.
//!
//! The table is the file `table.txt` beside this one, written together with the certificates from their
//! upper bounds, rounded upward to seven digits. A line holds weights, valence, polyhedron, family,
//! frequency or `-`, and the bounds of μ_0, μ_1, .. The modes that don't depend on the weights are listed
//! once, under `original`.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::mode::{CHAINED, Label, ModeFamily};
use super::{Against, ModeDistances};
use crate::scalar::float::decimal_above;
use crate::scheme::LoopWeights;

/// The bound of one mode at one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeBound {
    /// Which mode.
    pub label: Label,
    /// The distance is at most this.
    pub bound: f64,
}

type Key = (LoopWeights, u32, Against);

/// By level, by mode.
type Levels = Vec<Vec<ModeBound>>;

static TABLE: LazyLock<HashMap<Key, Levels>> = LazyLock::new(|| read(include_str!("table.txt")));

/// Upper bounds of the distances μ_m of all modes of valence n from the polyhedron of level m, in the
/// order of [`crate::spectrum::loop_modes::loop_modes`], without the constant and frequency 1, whose
/// distances are 0.
///
/// `None` unless 3 <= n <= 30 and m <= 6. Guarantee: each bound is at least the `hi` of a certificate in
/// `proofs/certificates`, hence at least the distance.
///
/// ```
/// use subcert::scheme::LoopWeights::Original;
/// use subcert::spectrum::eigenspline::{Against, table};
///
/// // At n = 6 the mode of frequency 2 is (x + iy)^2, and E its linear interpolant: the distance is 1/4,
/// // taken at the middle of an edge, and a quarter of that at each further level.
/// let bounds = table::upper(Original, 6, Against::Control, 0).unwrap();
/// let saddle = bounds.iter().find(|b| b.label.frequency == Some(2)).unwrap();
/// assert!((0.25..0.25003).contains(&saddle.bound));
/// ```
pub fn upper(
    weights: LoopWeights,
    n: u32,
    against: Against,
    m: usize,
) -> Option<&'static [ModeBound]> {
    let levels = TABLE.get(&(weights, n, against))?;
    levels.get(m).map(Vec::as_slice)
}

/// The line of one mode.
pub fn line(weights: LoopWeights, n: u32, against: Against, mode: &ModeDistances) -> String {
    let frequency = mode.label.frequency;
    let frequency = frequency.map_or_else(|| "-".to_string(), |k| k.to_string());
    let bounds = mode.distances.iter().map(|[_, hi]| decimal_above(hi, 7));
    let bounds: Vec<String> = bounds.collect();
    let family = mode.label.family;
    let bounds = bounds.join(" ");
    format!("{weights} {n} {against} {family} {frequency} {bounds}\n")
}

/// The file is a part of this program: what is wrong in it is a fault of the program.
fn read(text: &str) -> HashMap<Key, Levels> {
    let mut table: HashMap<Key, Levels> = HashMap::new();
    let rows: Vec<(Key, Label, Vec<f64>)> = text.lines().map(row).collect();
    for (key, label, bounds) in &rows {
        if key.0 == LoopWeights::Original && *label != CHAINED {
            let levels = table.entry(*key).or_default();
            levels.resize_with(bounds.len(), Vec::new);
            for (level, &bound) in levels.iter_mut().zip(bounds) {
                let label = *label;
                level.push(ModeBound { label, bound });
            }
        }
    }
    // Warren's: the same but for the rows of its own.
    let own: Vec<Key> = table.keys().copied().collect();
    for (_, n, against) in own {
        let levels = table[&(LoopWeights::Original, n, against)].clone();
        table.insert((LoopWeights::Warren, n, against), levels);
    }
    for (key, label, bounds) in &rows {
        if key.0 == LoopWeights::Warren {
            for (level, &bound) in table.entry(*key).or_default().iter_mut().zip(bounds) {
                let mode = level.iter_mut().find(|mode| mode.label == *label);
                mode.expect("a mode of this valence").bound = bound;
            }
        }
    }
    table
}

fn row(line: &str) -> (Key, Label, Vec<f64>) {
    let words: Vec<&str> = line.split(' ').collect();
    let [weights, n, against, family, frequency] = words[..5] else {
        panic!("a line of the table: {line}")
    };
    let weights = match weights {
        "original" => LoopWeights::Original,
        _ => LoopWeights::Warren,
    };
    let against = match against {
        "control" => Against::Control,
        _ => Against::Limit,
    };
    let family = match family {
        "ring" => ModeFamily::Ring,
        "ray" => ModeFamily::Ray,
        _ => ModeFamily::Between,
    };
    let label = Label {
        family,
        frequency: frequency.parse().ok(),
    };
    let number = |word: &&str| word.parse::<f64>().expect("a number");
    let bounds = words[5..].iter().map(number).collect();
    let n = n.parse().expect("a valence");
    ((weights, n, against), label, bounds)
}
