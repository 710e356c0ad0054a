//! Section 6: the control mesh. (15) in three readings, the first row of Table 2.
//!
//! (15) says `C_λ = x Σ_(i<λ) r_i / (1 - r_λ)`. It telescopes over the steps: x has to bound how far
//! one step moves the mesh, with M = 1. Three readings of x:
//!
//! | x | why |
//! |---|---|
//! | β(n) | the symbol as printed, that of Theorem 3 |
//! | n b | the displacement of the extraordinary vertex; what the printed values use |
//! | max(n b, 3/8) | the displacement of all vertices: 3/8 is that of the regular neighbours |

use std::cmp::Ordering;

use super::Findings;
use super::nets::radial;
use super::printed;
use super::valence::{Valence, place};
use crate::paper::words::{
    DIGITS, all, bounds, by_verdict, claim, decimal, exceptions, gravest, judge, list, ranges,
};
use crate::paper::{Claim, Counterexample, Enclosure, Printed, Table, Verdict};
use crate::scalar::{Cyclotomic, Field, Rational, Ring};

/// A reading of the factor of (15).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// β(n) of Theorem 3.
    Symbol,
    /// n b.
    RingWeight,
    /// max(n b, 3/8).
    Displacement,
}

impl Valence {
    /// `Σ_(i<λ) r_i / (1 - r_λ)`.
    fn series(&self, lambda: usize) -> Option<Cyclotomic> {
        let one = Cyclotomic::from_integer(1);
        let mut sum = one.clone();
        for rate in &self.rates[..lambda - 1] {
            sum += rate.exact.clone()?;
        }
        Some(sum / (one - self.rates[lambda - 1].exact.as_ref()?))
    }

    /// C_λ(n) by (15) in a reading.
    pub fn by_15(&self, reading: Reading, lambda: usize) -> Option<Enclosure> {
        let series = self.series(lambda)?;
        let displacement = Cyclotomic::from_rational(&self.neighbour_displacement);
        match reading {
            Reading::Symbol => Some(self.beta()?.times(&Enclosure::algebraic(&series))),
            Reading::RingWeight => {
                Some(Enclosure::algebraic(&(self.ring_weight.clone() * &series)))
            }
            Reading::Displacement => {
                let larger = match self.ring_weight.compare(&displacement) {
                    Ordering::Less => displacement,
                    _ => self.ring_weight.clone(),
                };
                Some(Enclosure::algebraic(&(larger * &series)))
            }
        }
    }

    /// C_λ(n) with n b and with the rates as Table 1 prints them, if it does.
    fn by_15_with_printed_rates(&self, lambda: usize) -> Option<Enclosure> {
        let rates = printed::TABLE_1.iter().take(lambda);
        let rates = rates.map(|row| Some(printed::at(row, self.n)?.exact()));
        let rates: Vec<Rational> = rates.collect::<Option<_>>()?;
        let one = <Rational as Ring>::from_integer(1);
        let (last, others) = rates.split_last()?;
        let sum = others.iter().fold(one.clone(), |sum, rate| sum + rate);
        let series = Enclosure::exactly(sum / (one - last));
        Some(Enclosure::algebraic(&self.ring_weight).times(&series))
    }

    /// C_0(n).
    pub fn best_control(&self) -> Option<&Enclosure> {
        self.control[0].as_ref().map(|proved| &proved.value)
    }

    /// Whether one step moves a regular neighbour of the extraordinary vertex by more than n b M.
    fn neighbour_moves_more(&self) -> bool {
        let displacement = Cyclotomic::from_rational(&self.neighbour_displacement);
        self.ring_weight.compare(&displacement).is_lt()
    }
}

const LAMBDA: usize = printed::TABLE_2_LAMBDA;

/// Table 2, C_3.
pub fn table(found: &Findings) -> Table {
    let mut rows = Vec::new();
    for v in &found.asked {
        let Some(printed) = printed::at(&printed::TABLE_2_CONTROL, v.n) else {
            continue;
        };
        let by = |reading| decimal(v.by_15(reading, LAMBDA).as_ref(), DIGITS);
        let method = v.by_15(Reading::RingWeight, LAMBDA);
        let best = v.best_control();
        let times = best.map(|best| printed.range().float() / best.float());
        rows.push(vec![
            v.n.to_string(),
            printed.to_string(),
            by(Reading::Symbol),
            by(Reading::RingWeight),
            by(Reading::Displacement),
            decimal(best, DIGITS),
            times.map_or("-".into(), |times| format!("{times:.3}")),
            judge(printed, method.as_ref(), best).to_string(),
            v.control[0].as_ref().map_or("-".into(), |c| c.file.clone()),
        ]);
    }
    Table {
        id: "table-2-control",
        title: format!("Table 2, first row, and (15): C_{LAMBDA}(n), surface to control mesh"),
        heads: vec![
            "n",
            "printed",
            "(15) with β(n)",
            "(15) with n b",
            "(15) with max(n b, 3/8)",
            "sharp C_0",
            "printed / sharp",
            "verdict",
            "certificate",
        ],
        rows,
        notes: vec![
            "(15) is printed with the β(n) of Theorem 3; the printed values come from n b. The verdict is \
             on the printed value as a bound, read with n b."
                .into(),
        ],
    }
}

/// The claims on (15) and the first row of Table 2.
pub fn claims(found: &Findings) -> Vec<Claim> {
    vec![
        literal(found),
        table_2(found),
        telescoping(found),
        smallest(found),
    ]
}

/// (15) as it stands.
fn literal(found: &Findings) -> Claim {
    let mut truths = Vec::new();
    let mut false_at = Vec::new();
    let mut witness = None;
    let mut files = Vec::new();
    for v in &found.asked {
        for lambda in 1..=LAMBDA {
            let (Some(bound), Some(best)) = (v.by_15(Reading::Symbol, lambda), &v.control[0])
            else {
                truths.push(None);
                continue;
            };
            let truth = best.value.at_most(&bound);
            truths.push(truth);
            if truth == Some(false) {
                let (value, bound) = (best.value.decimal(DIGITS), bound.decimal(DIGITS));
                false_at.push(format!(
                    "n = {}, λ = {lambda}: C_0 = {value} > {bound}",
                    v.n
                ));
                files.push(best.file.clone());
                let what = format!("M = 1 and |S - F| = {value} > {bound} {}", place(&best.at));
                witness.get_or_insert_with(|| v.counterexample(best, what));
            }
        }
    }
    files.dedup();
    Claim {
        counterexample: witness,
        certificates: files,
        method: Some(format!(
            "the values of Table 2 come from n b in place of β(n); see table-2-c{LAMBDA}"
        )),
        ..claim(
            "eq-15-literal",
            "(15)",
            "|S - F| <= C_λ(n) M with C_λ = β(n) Σ_(i<λ) r_i / (1 - r_λ), β(n) being that of Theorem 3.",
            Verdict::of(all(truths)),
            match false_at.is_empty() {
                true => "no exception".into(),
                false => format!("false at {}", false_at.join("; ")),
            },
            format!("{}, λ <= {LAMBDA}", found.scope()),
        )
    }
}

fn table_2(found: &Findings) -> Claim {
    let entries = found.asked.iter();
    let entries: Vec<(&Valence, Printed)> = entries
        .filter_map(|v| Some((v, printed::at(&printed::TABLE_2_CONTROL, v.n)?)))
        .collect();
    let judged = |(v, p): &(&Valence, Printed)| {
        let method = v.by_15(Reading::RingWeight, LAMBDA);
        (v.n, judge(*p, method.as_ref(), v.best_control()))
    };
    let verdicts: Vec<_> = entries.iter().map(judged).collect();
    let same = |of: &dyn Fn(&Valence) -> Option<Enclosure>| {
        let same = entries
            .iter()
            .filter(|(v, p)| of(v).and_then(|value| p.compare(&value)) == Some(Ordering::Equal));
        ranges(same.map(|(v, _)| v.n))
    };
    let by = |reading| same(&move |v: &Valence| v.by_15(reading, LAMBDA));
    let valid = entries.iter().map(|(v, p)| bounds(*p, v.best_control()?));
    let valid = match all(valid) {
        Some(true) => "all printed values are true bounds",
        Some(false) => "some printed values are no bounds",
        None => "whether all are bounds is undecided",
    };
    let best = entries.iter().map(|(v, p)| {
        let factor = v
            .best_control()
            .map_or(0.0, |best| p.range().float() / best.float());
        (
            v.n,
            format!("{} ({factor:.2} times)", decimal(v.best_control(), DIGITS)),
        )
    });
    Claim {
        method: Some(format!(
            "printed = (15) with β(n) at n = {}; with n b at n = {}; with n b and the rates rounded as in \
             Table 1 at n = {}; with max(n b, 3/8) at n = {}",
            by(Reading::Symbol),
            by(Reading::RingWeight),
            same(&|v| v.by_15_with_printed_rates(LAMBDA)),
            by(Reading::Displacement)
        )),
        certificates: found.files(|v| v.control[0].as_ref()),
        ..claim(
            "table-2-c3",
            "Table 2",
            format!("|S - F| <= C_{LAMBDA}(n) M with the first row of Table 2."),
            gravest(&verdicts),
            format!(
                "{valid}; {}; best values {}",
                by_verdict(&verdicts),
                list(best)
            ),
            found.scope_of(verdicts.iter().map(|(n, _)| *n)),
        )
    }
}

fn telescoping(found: &Findings) -> Claim {
    let truths = found
        .asked
        .iter()
        .map(|v| (v.n, Some(!v.neighbour_moves_more())));
    let truths: Vec<_> = truths.collect();
    let failed = found.asked.iter().find(|v| v.neighbour_moves_more());
    let fails: Vec<&Valence> = found
        .asked
        .iter()
        .filter(|v| v.neighbour_moves_more())
        .collect();
    let corrected = fails.iter().map(|v| {
        let value = v.by_15(Reading::Displacement, LAMBDA);
        (v.n, decimal(value.as_ref(), DIGITS))
    });
    let corrected = list(corrected);
    Claim {
        counterexample: failed.map(|v| Counterexample {
            valence: v.n,
            net: radial(v.n).iter().map(i64::to_string).collect(),
            what: format!(
                "M = 1; P2 moves by {} in one step, P1 by n b = {}",
                v.neighbour_displacement,
                Enclosure::algebraic(&v.ring_weight).decimal(DIGITS)
            ),
        }),
        method: (!fails.is_empty())
            .then(|| format!("the argument gives C_{LAMBDA} with max(n b, 3/8): {corrected}")),
        ..claim(
            "eq-15-telescoping",
            "(15), read with n b",
            "(15) follows by summing over the steps, one step moving the mesh by at most n b M.",
            Verdict::of(all(truths.iter().map(|t| t.1))),
            match fails.is_empty() {
                true => exceptions(&truths),
                false => format!(
                    "{}: there one step moves P2 by more. Whether the printed values are bounds all the \
                     same is said in table-2-c{LAMBDA}",
                    exceptions(&truths)
                ),
            },
            found.scope(),
        )
    }
}

fn smallest(found: &Findings) -> Claim {
    let half = Enclosure::exactly(Field::ratio(1, 2));
    let readings = [Reading::RingWeight, Reading::Displacement];
    let regular = |reading| Some(found.regular.by_15(reading, LAMBDA)? == half);
    let larger =
        |v: &Valence, reading| Some(half.compare(&v.by_15(reading, LAMBDA)?)? == Ordering::Less);
    let irregular: Vec<&Valence> = found.asked.iter().filter(|v| v.n != 6).collect();
    let truths = readings.into_iter().flat_map(|reading| {
        let others = irregular.iter().map(move |v| larger(v, reading));
        std::iter::once(regular(reading)).chain(others)
    });
    let verdict = Verdict::of(all(truths.collect::<Vec<_>>()));
    let best = found.regular.control[0].as_ref();
    let best = best
        .and_then(|c| c.exact.as_ref())
        .map_or("?".into(), Cyclotomic::to_string);
    Claim {
        certificates: found.regular.control[0]
            .iter()
            .map(|c| c.file.clone())
            .collect(),
        ..claim(
            "c3-smallest",
            "section 6",
            format!("C_{LAMBDA}(6) = 1/2 is the smallest of the C_{LAMBDA}(n), n >= 3."),
            verdict,
            format!(
                "compared with n b and with max(n b, 3/8); the best bound at n = 6 is C_0(6) = {best}"
            ),
            found.scope(),
        )
    }
}
