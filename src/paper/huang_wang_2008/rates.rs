//! Section 5.1: convergence rates of the second-order norm, Table 1, Lemma 1.

use std::cmp::Ordering;

use super::Findings;
use super::printed;
use super::valence::{MESH_LEVELS, RATES, STEPS, Valence, place};
use crate::paper::words::{
    DIGITS, all, by_verdict, claim, exceptions, gravest, judge, list, ranges,
};
use crate::paper::{Claim, Enclosure, Table, Verdict};
use crate::scalar::{Cyclotomic, Field};

/// Table 1, one row for each printed number.
pub fn table(found: &Findings) -> Table {
    let mut rows = Vec::new();
    for (k, row) in printed::TABLE_1.iter().enumerate() {
        for valence in &found.asked {
            let Some(printed) = printed::at(row, valence.n) else {
                continue;
            };
            let rate = &valence.rates[k];
            rows.push(vec![
                format!("r_{}", k + 1),
                valence.n.to_string(),
                printed.to_string(),
                rate.value.decimal(DIGITS),
                rate.exact.as_ref().map_or("-".into(), short),
                judge(printed, Some(&rate.value), Some(&rate.value)).to_string(),
                rate.file.clone(),
            ]);
        }
    }
    Table {
        id: "table-1",
        title: "Table 1: convergence rates r_1, r_2, r_3".into(),
        heads: vec!["rate", "n", "printed", "redone = sharp", "exact", "verdict", "certificate"],
        rows,
        notes: vec![
            "The method's linear programs give the supremum itself (duality), so redone and sharp are \
             one number."
                .into(),
        ],
    }
}

/// A closed form that fits a column.
fn short(exact: &Cyclotomic) -> String {
    let text = exact.to_string();
    match text.chars().count() {
        0..=44 => text,
        _ => format!("in Q(2 cos 2π/{})", exact.conductor()),
    }
}

/// The claims of section 5.1.
pub fn claims(found: &Findings) -> Vec<Claim> {
    let mut claims: Vec<Claim> = (0..printed::TABLE_1.len()).map(|k| row(found, k)).collect();
    claims.extend([
        largest_is_the_first(found),
        four_programs(found),
        one_program(found),
        submultiplicative(found),
        slower_than_regular(found),
        at_least_a_quarter(found),
        falls_at_most_to_a_quarter(found),
        lemma_1(found),
        lemma_1_for_meshes(found),
        regular_rate(found),
    ]);
    claims.extend(valence_three(found));
    claims
}

fn row(found: &Findings, k: usize) -> Claim {
    let row = &printed::TABLE_1[k];
    let entries = found
        .asked
        .iter()
        .filter_map(|v| Some((v, printed::at(row, v.n)?)));
    let verdicts: Vec<(u32, Verdict)> = entries
        .map(|(v, printed)| {
            let rate = &v.rates[k].value;
            (v.n, judge(printed, Some(rate), Some(rate)))
        })
        .collect();
    let ids = ["table-1-r1", "table-1-r2", "table-1-r3"];
    let statement = format!("The convergence rates r_{}(n) are those of Table 1.", k + 1);
    let files = found
        .asked
        .iter()
        .filter(|v| printed::at(row, v.n).is_some());
    Claim {
        certificates: files.map(|v| v.rates[k].file.clone()).collect(),
        ..claim(
            ids[k],
            "Table 1",
            statement,
            gravest(&verdicts),
            by_verdict(&verdicts),
            found.scope_of(verdicts.iter().map(|(n, _)| *n)),
        )
    }
}

/// The largest of exact numbers.
fn largest(numbers: &[Cyclotomic]) -> &Cyclotomic {
    let largest = numbers.iter().max_by(|a, b| a.compare(b));
    largest.expect("a net has second differences")
}

fn largest_is_the_first(found: &Findings) -> Claim {
    let truths = found.asked.iter().filter(|v| v.n > 3).map(|v| {
        let c = &v.differences[0];
        (v.n, Some(c[0] == *largest(c)))
    });
    let truths: Vec<_> = truths.collect();
    claim(
        "c1-largest",
        "section 5.1",
        "c_1(n) is the largest of the c_l(n) for n > 3, so r_1(n) = c_1(n).",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "all c_l(n) by exact linear programs: {}",
            exceptions(&truths)
        ),
        found.scope_of(truths.iter().map(|t| t.0)),
    )
}

fn valence_three(found: &Findings) -> Option<Claim> {
    let v = found.asked.iter().find(|v| v.n == 3)?;
    let c = &v.differences[0];
    let (c1, c4) = (Enclosure::algebraic(&c[0]), Enclosure::algebraic(&c[3]));
    let printed = [(printed::C_4_OF_3, &c4), (printed::C_1_OF_3, &c1)];
    let equal =
        |(p, c): &(crate::paper::Printed, &Enclosure)| Some(p.compare(c)? == Ordering::Equal);
    let truth = all(printed.iter().map(equal)).map(|equal| equal && c[3] == *largest(c));
    Some(claim(
        "c4-of-3",
        "section 5.1",
        format!(
            "r_1(3) = c_4(3) = {} > c_1(3) = {}.",
            printed::C_4_OF_3,
            printed::C_1_OF_3
        ),
        match truth {
            Some(true) => Verdict::Sharp,
            other => Verdict::of(other),
        },
        format!("c_4(3) = {}, the largest; c_1(3) = {}", c[3], c[0]),
        "n = 3",
    ))
}

fn four_programs(found: &Findings) -> Claim {
    // Indices from 0: ring edges 0..n, then (2, n+1), (2, n+2), (2, n+3), (2, n+4), (2, 3) and the
    // mirror images (n+1, n), (n+1, n+6), (n+1, n+5), (n+1, n+2) of the last four, backwards.
    let same = |v: &Valence| {
        let n = v.n as usize;
        let c = &v.differences[0];
        let represented = |l: usize, by: usize| c[l] == c[by];
        (0..n).all(|l| represented(l, 0))
            && represented(n + 3, n + 1)
            && represented(n + 4, n)
            && represented(n + 5, n)
            && represented(n + 6, n + 1)
            && represented(n + 7, n + 2)
            && represented(n + 8, n + 1)
    };
    let truths: Vec<_> = found.asked.iter().map(|v| (v.n, Some(same(v)))).collect();
    claim(
        "four-programs",
        "section 5.1",
        "By symmetry at most four programs are needed for r_1: those of α_1, α_(n+1), α_(n+2), α_(n+3).",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "every c_l(n) compared with these four, though not every edge is a mirror image of one of \
             theirs: {}",
            exceptions(&truths)
        ),
        found.scope(),
    )
}

fn one_program(found: &Findings) -> Claim {
    let first = |v: &Valence| v.differences[1..].iter().all(|c| c[0] == *largest(c));
    let truths: Vec<_> = found.asked.iter().map(|v| (v.n, Some(first(v)))).collect();
    claim(
        "one-program",
        "section 5.1",
        "For j > 1 the program of α_1 alone gives r_j(n), n >= 3.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "the norm of α_1 against all others: {}",
            exceptions(&truths)
        ),
        format!("{}, j = 2..{STEPS}", found.scope()),
    )
}

fn submultiplicative(found: &Findings) -> Claim {
    let holds = |v: &Valence| {
        let pairs = (1..RATES).flat_map(|j| (1..=RATES - j).map(move |k| (j, k)));
        all(pairs.map(|(j, k)| v.rate(j + k).at_most(&v.rate(j).times(&v.rate(k)))))
    };
    let truths: Vec<_> = found.asked.iter().map(|v| (v.n, holds(v))).collect();
    claim(
        "submultiplicative",
        "section 5.1",
        "r_(j+k)(n) <= r_j(n) r_k(n).",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "follows from the definition; compared for all pairs: {}",
            exceptions(&truths)
        ),
        format!("{}, j + k <= {RATES}", found.scope()),
    )
}

fn slower_than_regular(found: &Findings) -> Claim {
    let holds = |v: &Valence| {
        let compare = |k| found.regular.rate(k).compare(&v.rate(k));
        all((1..=RATES).map(|k| Some(compare(k)? == Ordering::Less)))
    };
    let irregular = found.asked.iter().filter(|v| v.n != 6);
    let truths: Vec<_> = irregular.map(|v| (v.n, holds(v))).collect();
    claim(
        "slower-than-regular",
        "section 5.1",
        "r_j(n) > r_j(6) for n ≠ 6.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        exceptions(&truths),
        format!(
            "{}, j <= {RATES}",
            found.scope_of(truths.iter().map(|t| t.0))
        ),
    )
}

fn quarter() -> Enclosure {
    Enclosure::exactly(Field::ratio(1, 4))
}

fn at_least_a_quarter(found: &Findings) -> Claim {
    let truths = found.asked.iter().map(|v| quarter().at_most(&v.rate(1)));
    claim(
        "r1-quarter",
        "section 5.2",
        "r_1(n) >= 1/4.",
        Verdict::of(all(truths)),
        match found.regular.rate(1) == quarter() {
            true => "equality at n = 6",
            false => "",
        },
        found.scope(),
    )
}

fn falls_at_most_to_a_quarter(found: &Findings) -> Claim {
    let mut false_at = Vec::new();
    let mut truths = Vec::new();
    for v in &found.asked {
        for i in 1..RATES {
            let truth = v.rate(i).times(&quarter()).at_most(&v.rate(i + 1));
            truths.push(truth);
            if truth == Some(false) {
                false_at.push(format!(
                    "n = {}: r_{}({}) = {} < {} = r_{i} / 4",
                    v.n,
                    i + 1,
                    v.n,
                    v.rate(i + 1).decimal(8),
                    v.rate(i).times(&quarter()).decimal(8)
                ));
            }
        }
    }
    let verdict = Verdict::of(all(truths));
    Claim {
        certificates: match verdict {
            Verdict::Refuted => found.at(3).map_or(Vec::new(), |v| {
                v.rates[..2].iter().map(|r| r.file.clone()).collect()
            }),
            _ => Vec::new(),
        },
        ..claim(
            "rate-quarter",
            "section 5.2",
            "r_(i+1)(n) >= r_i(n) / 4.",
            verdict,
            match false_at.is_empty() {
                true => "no exception".into(),
                false => format!("false at {}{}", false_at.join("; "), said_by_table_1()),
            },
            format!("{}, i < {RATES}", found.scope()),
        )
    }
}

/// Where the printed rates of Table 1 exclude r_(i+1) >= r_i / 4 by themselves.
fn said_by_table_1() -> String {
    let excludes = |n: u32, i: usize| {
        let range = |k: usize| Some(printed::at(&printed::TABLE_1[k], n)?.range());
        Some(range(i)?.times(&quarter()).compare(&range(i + 1)?)? == Ordering::Greater)
    };
    let pairs = 0..printed::TABLE_1.len() - 1;
    let says = |n: &u32| pairs.clone().any(|i| excludes(*n, i) == Some(true));
    let valences: Vec<u32> = printed::VALENCES.into_iter().filter(says).collect();
    match valences.is_empty() {
        true => String::new(),
        false => format!("; Table 1 as printed says so at n = {}", ranges(valences)),
    }
}

fn lemma_1(found: &Findings) -> Claim {
    let exact = found.asked.iter().map(|v| {
        let all = v.rates.iter().all(|rate| rate.exact.is_some());
        (
            v.n,
            if all {
                Verdict::Sharp
            } else {
                Verdict::Undecided
            },
        )
    });
    let verdicts: Vec<_> = exact.collect();
    claim(
        "lemma-1",
        "Lemma 1",
        "M_0^(k+j) <= r_j(n) M_0^k for the extraordinary subpatch.",
        gravest(&verdicts),
        "each rate as a supremum, with the net that attains it: ".to_string()
            + &by_verdict(&verdicts),
        format!("{}, j <= {RATES}", found.scope()),
    )
}

fn lemma_1_for_meshes(found: &Findings) -> Claim {
    let mut truths = Vec::new();
    let mut false_at = Vec::new();
    let mut witness = None;
    let mut files = Vec::new();
    for v in &found.asked {
        for j in 1..=MESH_LEVELS {
            let mesh = &v.mesh_rates[j - 1];
            let truth = match (&mesh.exact, &v.rates[j - 1].exact) {
                (Some(mesh), Some(rate)) => Some(mesh.compare(rate).is_le()),
                _ => mesh.value.at_most(&v.rate(j)),
            };
            truths.push(truth);
            if truth == Some(false) {
                let value = |exact: &Option<Cyclotomic>, value: &Enclosure| match exact {
                    Some(exact) => exact.to_string(),
                    None => value.decimal(8),
                };
                let sharp = value(&mesh.exact, &mesh.value);
                let rate = value(&v.rates[j - 1].exact, &v.rate(j));
                false_at.push(format!("n = {}, j = {j}: {sharp} > r_{j} = {rate}", v.n));
                files.push(mesh.file.clone());
                witness.get_or_insert_with(|| {
                    let what = format!("M = 1 and M^{j} = {sharp}, {}", place(&mesh.at));
                    v.counterexample(mesh, what)
                });
            }
        }
    }
    Claim {
        counterexample: witness,
        certificates: files,
        ..claim(
            "lemma-1-meshes",
            "section 5.1, after Lemma 1",
            "Lemma 1 holds with M^k, the second-order norm over all 4^k subpatches, in place of M_0^k.",
            Verdict::of(all(truths)),
            match false_at.is_empty() {
                true => "no exception".into(),
                false => format!("false at {}", false_at.join("; ")),
            },
            format!("{}, k = 0, j <= {MESH_LEVELS}", found.scope()),
        )
    }
}

fn regular_rate(found: &Findings) -> Claim {
    let power = |j: usize| Cyclotomic::ratio(1, 1 << (2 * j));
    let rates = found.regular.rates.iter().enumerate();
    let truth = rates.map(|(i, rate)| rate.exact.as_ref().map(|r| *r == power(i + 1)));
    let values = found.regular.rates.iter().filter_map(|r| r.exact.as_ref());
    let values = values
        .enumerate()
        .map(|(i, r)| (i as u32 + 1, r.to_string()));
    Claim {
        certificates: found.regular.rates.iter().map(|r| r.file.clone()).collect(),
        ..claim(
            "regular-rate",
            "section 5.1",
            "r_j(6) = (1/4)^j is sharp for regular patches.",
            match all(truth) {
                Some(true) => Verdict::Sharp,
                other => Verdict::of(other),
            },
            list(values).replace("n =", "j ="),
            format!("n = 6, j <= {RATES}"),
        )
    }
}
