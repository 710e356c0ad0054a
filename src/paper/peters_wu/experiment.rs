//! Estimates and measured distances of some models by level, printed or redone, and what Figure 6 makes
//! of them: ratios, their median over the models, their variance from the median.

use num_traits::Zero;

use super::printed::{self, LEVELS};
use crate::paper::Enclosure;
use crate::predict::Estimator;
use crate::scalar::{Rational, Ring};

/// A row of Table 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// An estimate, after some local subdivisions.
    Estimate(Estimator, u32),
    /// The distance itself.
    Measured,
}

/// Local subdivisions of the tabulated estimates.
pub const LOCAL: [u32; 3] = [0, 1, 2];

/// The tabulated estimates, in the order of Table 1.
pub const TABULATED: [Estimator; 3] = [
    Estimator::TabEigen,
    Estimator::TabApprox,
    Estimator::TabInterp,
];

impl Row {
    /// All rows, in the order of Table 1.
    pub fn all() -> Vec<Row> {
        let estimates = TABULATED
            .iter()
            .flat_map(|&e| LOCAL.iter().map(move |&j| Row::Estimate(e, j)));
        let rest = [Row::Estimate(Estimator::Heuristic, 0), Row::Measured];
        estimates.chain(rest).collect()
    }

    /// As in Table 1.
    pub fn name(self) -> String {
        match self {
            Row::Estimate(Estimator::Heuristic, _) => Estimator::Heuristic.name().into(),
            Row::Estimate(estimator, local) => format!("{} {local}", estimator.name()),
            Row::Measured => "measured".into(),
        }
    }

    /// The first level that the row has an entry for.
    pub fn first_level(self) -> usize {
        match self {
            Row::Estimate(_, local) => local as usize,
            Row::Measured => 0,
        }
    }
}

/// A model's rows; a missing entry is `None`.
#[derive(Clone, Debug)]
pub struct Model {
    /// Its name.
    pub name: String,
    /// Entries by row, in the order of [`Row::all`], and level.
    pub rows: Vec<Vec<Option<Enclosure>>>,
}

impl Model {
    /// An entry.
    pub fn at(&self, row: Row, m: usize) -> Option<&Enclosure> {
        let index = Row::all().iter().position(|&r| r == row)?;
        self.rows[index].get(m)?.as_ref()
    }

    /// An estimate over the measured distance; `None` if that may be 0.
    pub fn ratio(&self, row: Row, m: usize) -> Option<Enclosure> {
        quotient(self.at(row, m)?, self.at(Row::Measured, m)?)
    }
}

/// `a / b`; `None` if b may be 0.
pub fn quotient(a: &Enclosure, b: &Enclosure) -> Option<Enclosure> {
    (!b.lo.is_zero()).then(|| Enclosure::new(&a.lo / &b.hi, &a.hi / &b.lo))
}

/// Models with their rows.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// The models.
    pub models: Vec<Model>,
}

impl Experiment {
    /// Table 1 as printed, each decimal taken at its word.
    pub fn printed() -> Self {
        let model = |m: &printed::Model| Model {
            name: m.name.into(),
            rows: (m.rows.iter())
                .map(|row| {
                    let missing = std::iter::repeat_n(None, LEVELS - row.len());
                    let entries = row.iter().map(|p| Some(Enclosure::exactly(p.exact())));
                    missing.chain(entries).collect()
                })
                .collect(),
        };
        Experiment {
            models: printed::TABLE_1.iter().map(model).collect(),
        }
    }

    /// The number of levels.
    pub fn levels(&self) -> usize {
        let lengths = self.models.iter().flat_map(|m| m.rows.iter().map(Vec::len));
        lengths.max().unwrap_or(0)
    }

    /// The ratios of a row at a level, by model, where both numbers are known.
    pub fn ratios(&self, row: Row, m: usize) -> Vec<(&str, Enclosure)> {
        let ratio = |model: &'_ Model| model.ratio(row, m);
        self.models
            .iter()
            .filter_map(|model| Some((model.name.as_str(), ratio(model)?)))
            .collect()
    }

    /// Figure 6, top: the median of the ratios of a row at a level.
    pub fn median(&self, row: Row, m: usize) -> Option<Enclosure> {
        let ratios = self.ratios(row, m);
        median(ratios.iter().map(|(_, r)| r))
    }

    /// Figure 6, bottom: the mean square of the ratios' differences from their median.
    pub fn variance(&self, row: Row, m: usize) -> Option<Enclosure> {
        let ratios = self.ratios(row, m);
        let middle = median(ratios.iter().map(|(_, r)| r))?;
        let count = <Rational as Ring>::from_integer(ratios.len() as i64);
        let mut sum = Enclosure::exactly(Rational::zero());
        for (_, ratio) in &ratios {
            let square = square(&deviation(ratio, &middle));
            sum = Enclosure::new(sum.lo + square.lo, sum.hi + square.hi);
        }
        Some(Enclosure::new(sum.lo / &count, sum.hi / &count))
    }

    /// The smallest and the largest ratio.
    pub fn spread(&self, row: Row, m: usize) -> Option<[Enclosure; 2]> {
        let ratios = self.ratios(row, m);
        let all = || ratios.iter().map(|(_, r)| r.clone());
        let largest = all().reduce(|a, b| a.max(&b))?;
        let least = |a: Enclosure, b: Enclosure| Enclosure::new(a.lo.min(b.lo), a.hi.min(b.hi));
        Some([all().reduce(least)?, largest])
    }
}

/// `|a - b|`.
pub fn deviation(a: &Enclosure, b: &Enclosure) -> Enclosure {
    let (over, under) = (&a.hi - &b.lo, &b.hi - &a.lo);
    let apart = (&a.lo - &b.hi).max(&b.lo - &a.hi).max(Rational::zero());
    Enclosure::new(apart, over.max(under))
}

fn square(x: &Enclosure) -> Enclosure {
    x.times(x)
}

/// The median; the mean of the two in the middle of an even number. It grows with each of the numbers, so
/// the medians of the ends enclose it.
pub fn median<'a>(values: impl Iterator<Item = &'a Enclosure>) -> Option<Enclosure> {
    let (mut lo, mut hi): (Vec<_>, Vec<_>) = values.map(|x| (x.lo.clone(), x.hi.clone())).unzip();
    if lo.is_empty() {
        return None;
    }
    let middle = |ends: &mut Vec<Rational>| {
        ends.sort();
        let (a, b) = (&ends[(ends.len() - 1) / 2], &ends[ends.len() / 2]);
        (a + b) / <Rational as Ring>::from_integer(2)
    };
    Some(Enclosure::new(middle(&mut lo), middle(&mut hi)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Field;

    #[test]
    fn medians_and_deviations() {
        let at = |p, q| Enclosure::new(Rational::ratio(p, 10), Rational::ratio(q, 10));
        let values = [at(10, 11), at(30, 40), at(20, 35)];
        assert_eq!(median(values.iter()), Some(at(20, 35)));
        assert_eq!(
            median(values[..2].iter()),
            Some(Enclosure::new(
                Rational::ratio(2, 1),
                Rational::ratio(51, 20)
            ))
        );
        assert_eq!(deviation(&values[0], &values[1]), at(19, 30));
        assert_eq!(deviation(&values[1], &values[2]), at(0, 20));
    }

    /// Every row of the print ends at m = 5 and begins where its local steps do.
    #[test]
    fn the_print_has_the_shape_of_table_1() {
        for model in Experiment::printed().models {
            for (row, entries) in Row::all().into_iter().zip(&model.rows) {
                let first = entries.iter().position(Option::is_some);
                assert_eq!((first, entries.len()), (Some(row.first_level()), LEVELS));
            }
        }
    }
}
