//! Section 4: Theorem 3, β(n), the two facts found by plotting; the second row of Table 2.

use std::cmp::Ordering;

use super::Findings;
use super::bound_function::{BoundFunction, Curve};
use super::printed;
use super::valence::Valence;
use crate::paper::words::{
    DIGITS, FINE_DIGITS, all, bounds, by_verdict, claim, decimal, exceptions, gravest, if_true,
    judge, list,
};
use crate::paper::{Claim, Enclosure, Printed, Table, Verdict};
use crate::scalar::{Field, Rational};
use crate::scheme::Tile;

impl Valence {
    /// β(n) by the paper's own method.
    pub fn beta(&self) -> Option<&Enclosure> {
        self.bound_function
            .as_ref()
            .map(|function| &function.maximum)
    }

    /// B_0(n).
    pub fn best_limit(&self) -> Option<&Enclosure> {
        self.limit[0].as_ref().map(|proved| &proved.value)
    }
}

/// Table 2, β.
pub fn table(found: &Findings) -> Table {
    let mut rows = Vec::new();
    for v in &found.asked {
        let Some(printed) = printed::at(&printed::TABLE_2_LIMIT, v.n) else {
            continue;
        };
        let place = v.bound_function.as_ref().and_then(where_it_lies);
        let mut files: Vec<&str> = v.beta_file.as_deref().into_iter().collect();
        files.extend(v.limit[0].as_ref().map(|limit| limit.file.as_str()));
        rows.push(vec![
            v.n.to_string(),
            printed.to_string(),
            decimal(v.beta(), FINE_DIGITS),
            decimal(v.best_limit(), FINE_DIGITS),
            judge(printed, v.beta(), v.best_limit()).to_string(),
            match v.best_limit().and_then(|best| bounds(printed, best)) {
                Some(true) => "yes",
                Some(false) => "no: rounded down",
                None => "undecided",
            }
            .into(),
            place.unwrap_or("-".into()),
            files.join(" "),
        ]);
    }
    Table {
        id: "table-2-limit",
        title: "Table 2, second row, and Theorem 3: β(n), surface to limit mesh".into(),
        heads: vec![
            "n",
            "printed",
            "redone β",
            "sharp B_0",
            "verdict",
            "bound as printed",
            "maximum of B",
            "certificates",
        ],
        rows,
        notes: vec![
            "Redone: one linear program for each Bézier coefficient of each tile, the maximum of the \
             quartics, the rings near the extraordinary corner included. Sharp: the supremum of \
             |S - F̄| / M. Bound as printed: whether the decimal itself is at least B_0."
                .into(),
        ],
    }
}

/// The place of the maximum in words.
fn where_it_lies(function: &BoundFunction) -> Option<String> {
    let (tile, curve) = function.place()?;
    let index = match tile.tile {
        Tile::First => 1,
        Tile::Second => 2,
        Tile::Third => 3,
    };
    let curve = match curve {
        Curve::Diagonal => "diagonal",
        Curve::Border => "border",
    };
    Some(format!("S_{index}^{} {curve}", tile.ring))
}

/// The claims of section 4 and of the second row of Table 2.
pub fn claims(found: &Findings) -> Vec<Claim> {
    vec![
        theorem_3(found),
        table_2(found),
        fact_1(found),
        fact_2(found),
        four_functions(found),
        regular_is_optimum(found),
        can_be_improved(found),
        below_control(found),
    ]
}

fn theorem_3(found: &Findings) -> Claim {
    let judge = |v: &Valence| -> Option<Verdict> {
        let (beta, best) = (v.beta()?, v.best_limit()?);
        if v.beta_is_sharp {
            return Some(Verdict::Sharp);
        }
        match beta.compare(best) {
            Some(Ordering::Greater) => Some(Verdict::Loose),
            Some(Ordering::Less) => Some(Verdict::Refuted),
            _ => None,
        }
    };
    let verdicts = found
        .asked
        .iter()
        .map(|v| (v.n, judge(v).unwrap_or(Verdict::Undecided)));
    let verdicts: Vec<_> = verdicts.collect();
    let loose = found
        .asked
        .iter()
        .filter(|v| judge(v) == Some(Verdict::Loose));
    let loose = loose.map(|v| {
        let beta = decimal(v.beta(), FINE_DIGITS);
        (
            v.n,
            format!("β = {beta}, B_0 = {}", decimal(v.best_limit(), FINE_DIGITS)),
        )
    });
    Claim {
        certificates: found.files(|v| v.limit[0].as_ref()),
        ..claim(
            "theorem-3",
            "Theorem 3, (11)",
            "|S - F̄| <= β(n) M, β(n) the maximum of the distance bound function B.",
            gravest(&verdicts),
            format!(
                "β(n) redone; {}. Sharp: one net attains every coefficient of B along the curve of its \
                 maximum, so β = B_0 exactly. {}",
                by_verdict(&verdicts),
                list(loose)
            ),
            found.scope(),
        )
    }
}

fn table_2(found: &Findings) -> Claim {
    let entries = found.asked.iter();
    let entries: Vec<(&Valence, Printed)> = entries
        .filter_map(|v| Some((v, printed::at(&printed::TABLE_2_LIMIT, v.n)?)))
        .collect();
    let verdict = |(v, p): &(&Valence, Printed)| (v.n, judge(*p, v.beta(), v.best_limit()));
    let verdicts: Vec<_> = entries.iter().map(verdict).collect();
    let misprinted = entries
        .iter()
        .filter(|entry| verdict(entry).1 == Verdict::Misprint);
    let misprinted: Vec<(u32, String)> = misprinted
        .map(|(v, printed)| {
            let still = match v.best_limit().and_then(|best| bounds(*printed, best)) {
                Some(true) => "still a true bound",
                Some(false) => "not a bound",
                None => "whether a bound is undecided",
            };
            let method = decimal(v.beta(), FINE_DIGITS);
            let best = decimal(v.best_limit(), FINE_DIGITS);
            (
                v.n,
                format!("printed {printed}, method {method}, sharp {best}; {still}"),
            )
        })
        .collect();
    Claim {
        method: (!misprinted.is_empty()).then(|| list(misprinted)),
        certificates: found.files(|v| v.limit[0].as_ref()),
        ..claim(
            "table-2-beta",
            "Table 2",
            "The constants β(n) are those of the second row of Table 2.",
            gravest(&verdicts),
            by_verdict(&verdicts),
            found.scope_of(verdicts.iter().map(|(n, _)| *n)),
        )
    }
}

fn of_function(
    found: &Findings,
    test: impl Fn(&BoundFunction) -> Option<bool>,
) -> Vec<(u32, Option<bool>)> {
    let truth = |v: &Valence| v.bound_function.as_ref().and_then(&test);
    found.asked.iter().map(|v| (v.n, truth(v))).collect()
}

fn fact_1(found: &Findings) -> Claim {
    let truths = of_function(found, BoundFunction::fact_1);
    claim(
        "fact-1",
        "section 4.2, fact 1",
        format!(
            "B attains its maximum in v + w >= 1/4 ({} <= n <= {}).",
            printed::INVESTIGATED.0,
            printed::INVESTIGATED.1
        ),
        Verdict::of(all(truths.iter().map(|t| t.1))),
        if_true(
            &truths,
            "B is smaller than β(n) on every ring beyond the second, the infinitely many included",
        ),
        found.scope(),
    )
}

fn fact_2(found: &Findings) -> Claim {
    let truths = of_function(found, BoundFunction::fact_2);
    let places = found.asked.iter().map(|v| {
        let place = v.bound_function.as_ref().and_then(where_it_lies);
        (
            v.n,
            place.unwrap_or("several candidates, or undecided".into()),
        )
    });
    claim(
        "fact-2",
        "section 4.2, fact 2",
        format!(
            "B attains its maximum on the diagonal v = w or on the borders ({} <= n <= {}).",
            printed::INVESTIGATED.0,
            printed::INVESTIGATED.1
        ),
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "by strict concavity across the diagonal, or strict decrease away from the border: {}",
            list(places)
        ),
        found.scope(),
    )
}

fn four_functions(found: &Findings) -> Claim {
    let truths = of_function(found, BoundFunction::fact_1);
    let mut places: Vec<String> = found
        .asked
        .iter()
        .filter_map(|v| where_it_lies(v.bound_function.as_ref()?))
        .collect();
    places.sort();
    places.dedup();
    claim(
        "four-functions",
        "section 4.2",
        "For β(n) at most four bound functions are needed: those of S_1^1, S_2^1, S_1^2, S_2^2.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!("the maximum is attained on {}", places.join(", ")),
        found.scope(),
    )
}

fn regular_is_optimum(found: &Findings) -> Claim {
    let exact = |p: &Option<super::valence::Proved>| p.as_ref()?.exact.as_ref()?.to_rational();
    let third = <Rational as Field>::ratio(1, 3);
    let best = exact(&found.regular.limit[0]);
    let truth = best.as_ref().map(|best| *best == third);
    Claim {
        certificates: found.regular.limit[0]
            .iter()
            .map(|p| p.file.clone())
            .collect(),
        ..claim(
            "beta-of-6",
            "section 4.2",
            "For regular patches the constant β(6) = 1/3 is optimum.",
            match truth {
                Some(true) => Verdict::Sharp,
                other => Verdict::of(other),
            },
            format!(
                "B_0(6) = {}",
                best.map_or("?".into(), |best| best.to_string())
            ),
            "n = 6",
        )
    }
}

fn can_be_improved(found: &Findings) -> Claim {
    let truth = |v: &Valence| match (v.beta(), v.best_limit(), v.beta_is_sharp) {
        (_, _, true) => Some(false),
        (Some(beta), Some(best), _) => Some(beta.compare(best)? == Ordering::Greater),
        _ => None,
    };
    let irregular = found.asked.iter().filter(|v| v.n != 6);
    let truths: Vec<_> = irregular.map(|v| (v.n, truth(v))).collect();
    let gains = found
        .asked
        .iter()
        .filter(|v| truth(v) == Some(true) && v.n != 6);
    let gains = gains.filter_map(|v| {
        let ratio = 100.0 * (1.0 - v.best_limit()?.float() / v.beta()?.float());
        Some((v.n, format!("{ratio:.2} %")))
    });
    claim(
        "improvable",
        "section 4.2",
        "For extraordinary patches the constants can be improved through further subdividing.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "{}, where β(n) is the supremum itself; gains of at most {}",
            exceptions(&truths),
            list(gains)
        ),
        found.scope_of(truths.iter().map(|t| t.0)),
    )
}

fn below_control(found: &Findings) -> Claim {
    let half = Enclosure::exactly(Field::ratio(1, 2));
    let truth = |v: &Valence| Some(v.beta()?.compare(&half)? == Ordering::Less);
    let truths: Vec<_> = found.asked.iter().map(|v| (v.n, truth(v))).collect();
    let largest = found.asked.iter().filter_map(|v| Some((v.n, v.beta()?)));
    let largest = largest.max_by(|a, b| a.1.float().total_cmp(&b.1.float()));
    claim(
        "beta-below-half",
        "section 6",
        "β(n) < C_3(6) = 1/2 for n >= 3.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        largest.map_or(String::new(), |(n, beta)| {
            format!("the largest is β({n}) = {}", beta.decimal(DIGITS))
        }),
        found.scope(),
    )
}
