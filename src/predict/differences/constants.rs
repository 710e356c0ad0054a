//! The constants of every vertex at every level: |S - F_k| <= D_k M and |S - L_k| <= D_k M.
//!
//! M is the largest difference of a *ready* face ([`super`]): one whose corners are regular but for one.
//!
//! | vertex | D_k |
//! |---|---|
//! | regular | D_0 4^-k |
//! | interior, valence n (Doo-Sabin: a face of n sides) in the table | proved levels, then the recurrence |
//! | others of Loop and Catmull-Clark | levels to 16 from [`super::star`], then the recurrence |
//!
//! **Recurrence.** After j steps the part of the face at the vertex is a ready face with M_j <= r_j M. The
//! regular faces that step i + 1 <= j sets free have M <= R r_i M, and K - i - 1 more steps to go. The level-K
//! mesh over a part of level i is the level-(K-i) mesh of that part. So for every j <= K
//!
//! ```text
//! D_K <= max(r_j D_(K-j), max_(i<j) R r_i D_0(regular) 4^-(K-i-1)).
//! ```
//!
//! Doo-Sabin: beside the extraordinary face the surface is that of regular nets one step later
//! (4^-(K-i-2), j <= K - 1), whose M is R r_i M.
//!
//! **Tables.** The files in `constants/` are written by the example `author_constants` from proved
//! enclosures, rounded upward; a decimal is read as the next `f64` above the nearest one.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::star::{Lattice, Star, Vertex, first_step, limit_step};
use crate::bound::Against;
use crate::scalar::float::gamma;
use crate::scheme::{LoopWeights, Scheme};

/// The deepest level.
pub const DEEPEST: usize = 64;

/// The rows of the table of one valence.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entry {
    /// C_k, from k = 0.
    pub control: Vec<f64>,
    /// B_k, from k = 0; empty for Doo-Sabin.
    pub limit: Vec<f64>,
    /// r_k, from k = 0.
    pub rates: Vec<f64>,
    /// R.
    pub beside: f64,
}

type Table = BTreeMap<u32, Entry>;

static ORIGINAL: LazyLock<Table> =
    LazyLock::new(|| read(include_str!("../constants/loop-original.txt")));
static WARREN: LazyLock<Table> =
    LazyLock::new(|| read(include_str!("../constants/loop-warren.txt")));
static CATMULL_CLARK: LazyLock<Table> =
    LazyLock::new(|| read(include_str!("../constants/catmull-clark.txt")));
static DOO_SABIN: LazyLock<Table> =
    LazyLock::new(|| read(include_str!("../constants/doo-sabin.txt")));

fn table(scheme: Scheme) -> &'static Table {
    match scheme {
        Scheme::Loop(LoopWeights::Original) => &ORIGINAL,
        Scheme::Loop(LoopWeights::Warren) => &WARREN,
        Scheme::CatmullClark => &CATMULL_CLARK,
        Scheme::DooSabin => &DOO_SABIN,
    }
}

/// What is tabulated of a valence; of a face's sides for Doo-Sabin.
///
/// ```
/// use subcert::predict::differences::constants::tabulated;
/// use subcert::scheme::{LoopWeights, Scheme};
/// // Regular patches: C_0 = 1/2 and a quarter of that after each step.
/// let six = tabulated(Scheme::Loop(LoopWeights::Original), 6).unwrap();
/// assert!((0.125..0.1251).contains(&six.control[1]));
/// ```
pub fn tabulated(scheme: Scheme, n: u32) -> Option<&'static Entry> {
    table(scheme).get(&n)
}

/// The valence of the lattice, and the sides of its faces for Doo-Sabin.
fn regular(scheme: Scheme) -> u32 {
    match scheme {
        Scheme::Loop(_) => 6,
        Scheme::CatmullClark | Scheme::DooSabin => 4,
    }
}

/// D_0 of regular faces.
fn of_lattice(scheme: Scheme, against: Against) -> Option<f64> {
    let entry = tabulated(scheme, regular(scheme))?;
    match against {
        Against::Control => entry.control.first(),
        Against::Limit => entry.limit.first(),
    }
    .copied()
}

/// What else the lattice's part in [`Star`] needs.
pub(super) fn lattice(scheme: Scheme) -> Option<Lattice> {
    let limit = match scheme {
        Scheme::Loop(_) => 0.5,
        Scheme::CatmullClark => (1.0_f64 / 3.0).next_up(),
        Scheme::DooSabin => return None,
    };
    Some(Lattice {
        control: of_lattice(scheme, Against::Control)?,
        step: first_step(scheme, Vertex::Regular),
        limit,
    })
}

/// R of a vertex: regular faces beside it after one step have M <= R M. At the regular vertex it is the rate.
pub fn beside(scheme: Scheme, vertex: Vertex) -> f64 {
    let entry = match vertex {
        Vertex::Regular => tabulated(scheme, regular(scheme)),
        Vertex::Interior(n) => tabulated(scheme, n),
        Vertex::Boundary(_) => None,
    };
    if let Some(entry) = entry {
        return entry.beside;
    }
    let star = lattice(scheme).and_then(|lattice| Star::new(scheme, vertex, lattice));
    star.map_or(f64::INFINITY, |star| star.rates[1])
}

/// D_0, .., D_[`DEEPEST`] of a vertex, rounded upward; infinite where nothing is proved (Doo-Sabin: limit
/// meshes, and faces of more sides than the table has).
pub fn distances(scheme: Scheme, against: Against, vertex: Vertex) -> Vec<f64> {
    let unproved = || vec![f64::INFINITY; DEEPEST + 1];
    let Some(start) = of_lattice(scheme, against) else {
        return unproved();
    };
    if vertex == Vertex::Regular {
        // Exact products.
        let powers = std::iter::successors(Some(start), |d| Some(d / 4.0));
        return powers.take(DEEPEST + 1).collect();
    }
    let tabulated = match vertex {
        Vertex::Interior(n) => tabulated(scheme, n),
        _ => None,
    };
    if let Some(entry) = tabulated {
        let list = match against {
            Against::Control => &entry.control,
            Against::Limit => &entry.limit,
        };
        return continued(scheme, list.clone(), &entry.rates, entry.beside, start);
    }
    let star = lattice(scheme).and_then(|lattice| Star::new(scheme, vertex, lattice));
    match star {
        Some(star) => {
            let list = match against {
                Against::Control => star.control,
                Against::Limit => star.limit,
            };
            continued(scheme, list, &star.rates, star.rates[1], start)
        }
        None => unproved(),
    }
}

/// The recurrence.
fn continued(
    scheme: Scheme,
    mut list: Vec<f64>,
    rates: &[f64],
    beside: f64,
    start: f64,
) -> Vec<f64> {
    // Doo-Sabin's regular nets come a step later.
    let late = usize::from(scheme == Scheme::DooSabin);
    // max_(i<j) r_i 4^i, j = 0, 1, ..
    let mut freed = vec![0.0_f64];
    for (i, rate) in (0..).zip(rates) {
        freed.push(freed[i as usize].max(rate * 4f64.powi(i)));
    }
    for k in list.len()..=DEEPEST {
        let lattice = beside * start * 0.25f64.powi((k - 1 - late) as i32);
        let through = |j: usize| (lattice * freed[j]).max(rates[j] * list[k - j]);
        let steps = 1..rates.len().min(k + 1 - late);
        let least = steps.map(through).fold(f64::INFINITY, f64::min);
        list.push(least * (1.0 + gamma(8)));
    }
    list
}

/// The file is a part of this program: what is wrong in it is a fault of the program.
fn read(text: &str) -> Table {
    let mut table = Table::new();
    for line in text.lines() {
        let mut words = line.split(' ');
        let mut word = || words.next().expect("a line of the table");
        let (n, name) = (word(), word());
        let number = |word: &str| word.parse::<f64>().expect("a number").next_up();
        let numbers: Vec<f64> = words.map(number).collect();
        let entry = table.entry(n.parse().expect("a valence")).or_default();
        match name {
            "control" => entry.control = numbers,
            "limit" => entry.limit = numbers,
            "rate" => entry.rates = std::iter::once(1.0).chain(numbers).collect(),
            _ => entry.beside = numbers[0],
        }
    }
    table
}

/// An upper bound, over M, of the distance of a vertex to its limit.
pub(super) fn to_limit(scheme: Scheme, vertex: Vertex) -> f64 {
    let regular = lattice(scheme).map_or(f64::INFINITY, |lattice| lattice.limit);
    limit_step(scheme, vertex).max(regular)
}
