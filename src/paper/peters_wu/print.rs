//! The print against itself: Table 1 by the definitions of its rows, counts, costs.

use std::cmp::Ordering;

use super::experiment::{Experiment, LOCAL, Row, TABULATED, quotient};
use super::printed;
use super::redone::WEIGHTS;
use crate::paper::words::{claim, every};
use crate::paper::{Claim, Enclosure, Printed, Verdict};
use crate::predict::Estimator;
use crate::predict::eigen::kernel::Kernel;
use crate::scalar::{Field, Rational, Ring};

/// Digits of ratios.
const DIGITS: u32 = 4;

/// Entries of a row of a printed model by level, as ranges.
fn entries(model: &printed::Model, index: usize) -> Vec<(usize, Enclosure)> {
    let row = model.rows[index];
    let first = printed::LEVELS - row.len();
    (first..).zip(row).map(|(m, p)| (m, p.range())).collect()
}

fn index(row: Row) -> usize {
    Row::all()
        .iter()
        .position(|&r| r == row)
        .expect("a row of the table")
}

/// Ratios of successive entries of a row: (model, m, ratio of m + 1 to m), with the rounding of the print.
fn successive(row: Row) -> Vec<(&'static str, usize, Enclosure)> {
    let mut found = Vec::new();
    for model in &printed::TABLE_1 {
        let entries = entries(model, index(row));
        for pair in entries.windows(2) {
            if let Some(ratio) = quotient(&pair[1].1, &pair[0].1) {
                found.push((model.name, pair[0].0, ratio));
            }
        }
    }
    found
}

fn misprint(truth: Option<bool>) -> Verdict {
    match truth {
        Some(false) => Verdict::Misprint,
        other => Verdict::of(other),
    }
}

/// (14) and the definition of `tab-eigen`: `Σ c_i r_i^m`, r_i = max(λ_i, 1/4) < 5/8, per vertex, then the largest.
fn eigen_rows() -> (Option<bool>, String) {
    let bound = Enclosure::exactly({
        let (p, q) = printed::HIGH_VALENCE_RATE;
        Rational::ratio(p, q)
    });
    let rows = LOCAL.map(|j| Row::Estimate(Estimator::TabEigen, j));
    let (mut above, mut falling, mut truths) = (Vec::new(), 0, Vec::new());
    for row in rows {
        let ratios = successive(row);
        for (name, m, ratio) in &ratios {
            let truth = ratio.at_most(&bound);
            if truth == Some(false) {
                above.push(format!(
                    "{} of {name}, m = {m}: {}",
                    row.name(),
                    ratio.decimal(DIGITS)
                ));
            }
            truths.push(truth);
        }
        for pair in ratios.windows(2) {
            // A largest sum of powers is logarithmically convex in m: ratios don't fall.
            if pair[0].0 == pair[1].0 && pair[1].2.compare(&pair[0].2) == Some(Ordering::Less) {
                falling += 1;
                truths.push(Some(false));
            }
        }
    }
    let shown = above.iter().take(4).cloned().collect::<Vec<_>>().join(", ");
    (
        every(truths),
        format!(
            "by the formula the ratios of successive entries are below 5/8 and never fall; as printed {} of them exceed \
             5/8 ({shown}, ..) and {falling} times one falls",
            above.len()
        ),
    )
}

/// After its first two entries a row of `tab-eigen` falls by 1/4.
fn eigen_quarters() -> (Option<bool>, String) {
    let quarter = Enclosure::exactly(Rational::ratio(1, 4));
    let mut exceptions = Vec::new();
    let mut count = 0;
    for j in LOCAL {
        let row = Row::Estimate(Estimator::TabEigen, j);
        for (name, m, ratio) in successive(row) {
            if m == row.first_level() {
                continue;
            }
            count += 1;
            // The quarter lies in the range that the print stands for, or not.
            let holds = ratio.lo <= quarter.lo && quarter.lo <= ratio.hi;
            if !holds {
                exceptions.push(format!(
                    "{} of {name}, m = {m}: {}",
                    row.name(),
                    ratio.decimal(DIGITS)
                ));
            }
        }
    }
    let text = match exceptions.is_empty() {
        true => format!("all {count} ratios"),
        false => format!(
            "all but {} of {count}: {}",
            exceptions.len(),
            exceptions.join(", ")
        ),
    };
    (Some(exceptions.is_empty()), text)
}

/// At m = j `tab-eigen j` and `tab-approx j` are one sum.
fn same_start() -> Option<bool> {
    every(printed::TABLE_1.iter().flat_map(|model| {
        LOCAL.map(|j| {
            let first = |e| model.rows[index(Row::Estimate(e, j))].first();
            let pair = first(Estimator::TabEigen).zip(first(Estimator::TabApprox));
            pair.map(|(a, b)| a.exact() == b.exact())
        })
    }))
}

/// Adds and multiplications of a decomposition and the sums by our kernel and by full matrices, per coordinate.
fn cost() -> Option<(usize, usize)> {
    let (n, _, _) = printed::COST;
    let kernel = Kernel::new(WEIGHTS, n)?;
    let points = 1 + 3 * n as usize;
    let rows = points - 3;
    // A product of a row has one addition less than multiplications.
    let sparse = 2 * kernel.multiplications() - rows;
    Some((sparse, rows * (2 * points - 1)))
}

/// The claims.
pub fn claims() -> Vec<Claim> {
    let scope = "the printed numbers";
    let (eigen, eigen_found) = eigen_rows();
    let (quarters, quarters_found) = eigen_quarters();
    let starts = same_start();
    let decreasing = every(Row::all().into_iter().flat_map(|row| {
        let one = Enclosure::exactly(<Rational as Ring>::from_integer(1));
        successive(row)
            .into_iter()
            .map(move |(_, _, ratio)| ratio.compare(&one).map(|o| o == Ordering::Less))
    }));
    let local = local_steps();
    let (n, m, operations) = printed::COST;
    let sum = |pair: [Printed; 2]| pair[0].exact() + pair[1].exact();
    let [prior, posterior] = printed::SECONDS.map(sum);
    let factor = Enclosure::exactly(&posterior / &prior);
    let times = <Rational as Ring>::from_integer(printed::COST_FACTOR);
    let parts = printed::SECONDS.map(|p| p.map(Printed::range));
    let ranges = parts.map(|[a, b]| Enclosure::new(a.lo + b.lo, a.hi + b.hi));
    let rounded = quotient(&ranges[1], &ranges[0]);
    let (timed, triangles) = printed::TIMED;
    let figure_7 = printed::TABLE_1
        .iter()
        .find(|m| m.name == timed)
        .map(|m| m.triangles);
    let (refinements, width) = printed::SANDWICH;
    let (p, q) = printed::REGULAR_RATE;
    let sandwich = Rational::ratio(p, q).pow(refinements as i32);
    vec![
        claim(
            "table-1-decreasing",
            "Table 1",
            "Every row falls with m.",
            Verdict::of(decreasing),
            "all successive entries",
            scope,
        ),
        claim(
            "table-1-starts",
            "Table 1",
            "By definition tab-eigen j and tab-approx j agree at m = j.",
            misprint(starts),
            match starts {
                Some(true) => "all 15 pairs agree",
                _ => "some pairs differ",
            },
            scope,
        ),
        claim(
            "table-1-eigen",
            "Table 1; (14), section 5",
            "The rows of tab-eigen are Σ |p_i| max(λ_i, 1/4)^m μ_i, the largest over all vertices.",
            misprint(eigen),
            eigen_found,
            scope,
        ),
        claim(
            "table-1-eigen-quarter",
            "Table 1",
            "(Seen in the table.) From the second entry on tab-eigen falls by 1/4 exactly.",
            Verdict::of(quarters),
            quarters_found,
            scope,
        ),
        claim(
            "table-1-local",
            "introduction, (iv); Table 1",
            "Local subdivision makes the bounds tighter: tab-approx j + 1 is below tab-approx j, at each m.",
            Verdict::of(local.0),
            local.1,
            scope,
        ),
        claim(
            "cost-operations",
            "section 5",
            format!(
                "For n = {n}, m = {m} the cost per coordinate is {operations} adds and multiplications, local steps included."
            ),
            Verdict::Undecided,
            match cost() {
                Some((sparse, full)) => format!(
                    "the sums are not spelled out. With full matrices of the {} left eigenvectors the decomposition alone \
                     takes {full}, with the nonzero entries only {sparse}; with the structure of the two-ring fewer",
                    3 * n - 2
                ),
                None => "not counted".into(),
            },
            "counted from the left eigenvectors of spectrum",
        ),
        claim(
            "cost-factor",
            "section 5",
            format!(
                "A posteriori estimation costs at least {} times as much, for two steps: {} + {} s against {} + {} s.",
                printed::COST_FACTOR,
                printed::SECONDS[1][0],
                printed::SECONDS[1][1],
                printed::SECONDS[0][0],
                printed::SECONDS[0][1]
            ),
            Verdict::of(Some(factor.lo >= times)),
            format!(
                "{} times; {} within the rounding of the print",
                factor.decimal(2),
                rounded.map_or("-".into(), |r| r.decimal(2))
            ),
            "the printed seconds, taken at their word",
        ),
        claim(
            "figure-7-venus",
            "section 5, Figure 7",
            format!("The model {timed} has {triangles} triangles."),
            misprint(figure_7.map(|t| t == triangles)),
            "the same in both places",
            scope,
        ),
        claim(
            "sandwich",
            "section 5",
            format!(
                "{refinements} refinements reduce the width of the enclosure to at most {}/{} of the initial.",
                width.0, width.1
            ),
            Verdict::of(Some(sandwich <= Rational::ratio(width.0, width.1))),
            format!(
                "(1/4)^{refinements} is small enough; with the rate λ_3 of a high valence it would not be: (5/8)^{refinements} = {}",
                Enclosure::exactly(Rational::ratio(5, 8).pow(refinements as i32)).decimal(4)
            ),
            "the rate 1/4 of regular patches",
        ),
    ]
}

fn local_steps() -> (Option<bool>, String) {
    let printed = Experiment::printed();
    let mut truths = Vec::new();
    let mut factors: Vec<Enclosure> = Vec::new();
    for model in &printed.models {
        for &estimator in TABULATED.iter().filter(|e| **e == Estimator::TabApprox) {
            for j in 1..LOCAL.len() as u32 {
                for m in j as usize..printed::LEVELS {
                    let at = |j| model.at(Row::Estimate(estimator, j), m);
                    let Some((less, more)) = at(j).zip(at(j - 1)) else {
                        continue;
                    };
                    truths.push(less.compare(more).map(|o| o == Ordering::Less));
                    factors.extend(quotient(more, less));
                }
            }
        }
    }
    let least = factors.iter().map(|f| &f.lo).min().cloned();
    let most = factors.iter().map(|f| &f.hi).max().cloned();
    let text = least.zip(most).map_or("-".into(), |(a, b)| {
        let show = |x| Enclosure::exactly(x).decimal(2);
        format!("{} to {} times smaller", show(a), show(b))
    });
    (every(truths), text)
}
