//! What is claimed of a scheme at a valence: all eigenvalues, and the characteristic map.

use std::cmp::Ordering;

use num_traits::One;
use rayon::prelude::*;

use super::characteristic::{Check, check};
use super::outer::outer_modes;
use super::{Eigenvalue, InnerMode, Rules, Spectrum, TwoRing};
use crate::scalar::{Cyclotomic, Decide, Interval};

/// Where an eigenvalue comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    /// The net that is 1 everywhere.
    Constant,
    /// A mode of frequency k with values on the first ring; its conjugate has the frequency n - k.
    Frequency(u32),
    /// A local mode of the second ring: one for each sector, or for each frequency.
    Local,
}

/// An eigenvalue with all of its multiplicity.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The number, exactly.
    pub value: Eigenvalue,
    /// A proved enclosure of it.
    pub enclosure: Interval,
    /// The algebraic multiplicity.
    pub multiplicity: u32,
    /// The number of independent eigenvectors.
    pub geometric: u32,
    /// Its modes.
    pub sources: Vec<Source>,
}

impl Entry {
    /// The frequencies of its modes on the first ring, conjugates included, in order.
    pub fn frequencies(&self, n: u32) -> Vec<u32> {
        let mut all: Vec<u32> = (self.sources.iter())
            .flat_map(|source| match source {
                Source::Constant => vec![0],
                Source::Frequency(k) => vec![*k, (n - k) % n],
                Source::Local => vec![],
            })
            .collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Whether local modes belong to it.
    pub fn is_local(&self) -> bool {
        self.sources.contains(&Source::Local)
    }
}

/// The spectrum at one valence.
#[derive(Clone, Debug)]
pub struct Row {
    /// The valence.
    pub n: u32,
    /// All different eigenvalues, the largest first.
    pub entries: Vec<Entry>,
    /// The modes with values on the first ring, right and left, by frequency; the constant excepted.
    pub modes: Vec<InnerMode<Interval>>,
    /// The checks of the characteristic map.
    pub map: Check,
}

impl Row {
    /// Whether some eigenvalue has fewer eigenvectors than its multiplicity.
    pub fn is_defective(&self) -> bool {
        self.entries
            .iter()
            .any(|entry| entry.geometric < entry.multiplicity)
    }

    /// The subdominant eigenvalue λ1 = λ2, if it is as smooth surfaces need it: after a simple 1 and
    /// before all others in magnitude, a double eigenvalue, of the frequencies 1 and n - 1 alone.
    pub fn subdominant(&self) -> Option<&Entry> {
        let [first, second, ..] = &self.entries[..] else {
            return None;
        };
        let pair = [Source::Frequency(1)];
        let last = &self.entries[self.entries.len() - 1];
        // Negative eigenvalues would come last.
        let fine = second.value.compare_magnitude(&last.value).is_gt()
            && first.multiplicity == 1
            && first.sources == [Source::Constant]
            && second.multiplicity == 2
            && second.geometric == 2
            && second.sources == pair;
        fine.then_some(second)
    }

    /// The subsubdominant eigenvalue λ3, if there is a [`Row::subdominant`] one.
    pub fn subsubdominant(&self) -> Option<&Entry> {
        self.subdominant().and(self.entries.get(2))
    }
}

/// One row for each valence, in the order given, whatever the number of threads.
///
/// # Panics
/// If a valence is below 3.
pub fn tabulate(rules: Rules, valences: &[u32]) -> Vec<Row> {
    valences.par_iter().map(|&n| row(rules, n)).collect()
}

fn row(rules: Rules, n: u32) -> Row {
    let spectrum = Spectrum::<Interval>::new(rules, n).expect("intervals have all numbers");
    let exact = TwoRing::<Cyclotomic>::new(rules, n).expect("Q(2 cos 2π/n) has the masks");
    let one = Eigenvalue::Exact(Cyclotomic::one());
    let mut found = vec![(one, Source::Constant, 1, 1)];
    for mode in spectrum.inner() {
        let real = (2 * mode.frequency).is_multiple_of(n);
        let count = if real { 1 } else { 2 };
        let geometric = if mode.chain.is_empty() { count } else { 0 };
        let source = Source::Frequency(mode.frequency);
        found.push((mode.eigenvalue.clone(), source, count, geometric));
    }
    for mode in outer_modes(&exact) {
        found.push((Eigenvalue::Exact(mode.eigenvalue), Source::Local, n, n));
    }
    // A stable sort: equal values stay in the order of their frequencies.
    let mut found: Vec<_> = (found.into_iter())
        .map(|(value, source, count, geometric)| (value.enclose(), value, source, count, geometric))
        .collect();
    found.sort_by(|a, b| compare((&b.0, &b.1), (&a.0, &a.1)));
    let mut entries: Vec<Entry> = Vec::new();
    for (enclosure, value, source, count, geometric) in found {
        match entries.last_mut() {
            Some(last) if compare((&last.enclosure, &last.value), (&enclosure, &value)).is_eq() => {
                last.multiplicity += count;
                last.geometric += geometric;
                last.sources.push(source);
            }
            _ => entries.push(Entry {
                value,
                enclosure,
                multiplicity: count,
                geometric,
                sources: vec![source],
            }),
        }
    }
    let characteristic = spectrum.inner().iter().find(|mode| mode.frequency == 1);
    let characteristic = characteristic.expect("n >= 3 has a frequency 1");
    Row {
        n,
        entries,
        modes: spectrum.inner().to_vec(),
        map: check(&spectrum, characteristic),
    }
}

/// The exact order; enclosures that are apart answer for it.
fn compare(a: (&Interval, &Eigenvalue), b: (&Interval, &Eigenvalue)) -> Ordering {
    let apart = a.0.decide(b.0).filter(|order| order.is_ne());
    apart.unwrap_or_else(|| a.1.compare(b.1))
}
