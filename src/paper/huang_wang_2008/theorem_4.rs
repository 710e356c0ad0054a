//! Section 5.2: Theorem 4, (14) and (16), and how they are derived.

use num_traits::One;

use super::Findings;
use super::depth::steps;
use super::table_3::{LAMBDAS, Mesh, ratio};
use super::valence::{LEVELS, RATES};
use crate::paper::words::{DIGITS, all, by_verdict, claim, gravest, list};
use crate::paper::{Claim, Enclosure, Verdict};
use crate::scalar::{Cyclotomic, Field, Rational, Ring};

/// The claims of section 5.2, but for the rates.
pub fn claims(found: &Findings) -> Vec<Claim> {
    vec![
        exponent(found),
        level_bound(found),
        strict(found),
        regular_formula(found, Mesh::Limit),
        regular_formula(found, Mesh::Control),
    ]
}

/// The line before l_j, read literally.
fn exponent(found: &Findings) -> Claim {
    // k = λ j + j: r_k <= r_λ^(λ j) r_j.
    let mut truths = Vec::new();
    let mut false_at = Vec::new();
    for v in &found.asked {
        for lambda in 2..=3usize {
            for j in 1..lambda {
                let k = lambda * j + j;
                if k > RATES {
                    continue;
                }
                let power = (0..lambda * j).fold(v.rate(j), |p, _| p.times(&v.rate(lambda)));
                let truth = v.rate(k).at_most(&power);
                truths.push(truth);
                if truth == Some(false) {
                    let (rate, power) = (v.rate(k).decimal(DIGITS), power.decimal(DIGITS));
                    false_at.push(format!(
                        "n = {}, λ = {lambda}, j = {j}: r_{k} = {rate} > {power}",
                        v.n
                    ));
                }
            }
        }
    }
    let verdict = match all(truths) {
        Some(false) => Verdict::Misprint,
        other => Verdict::of(other),
    };
    Claim {
        method: Some(
            "k = λ l_j + j and r_k <= (r_λ)^(l_j) r_j, as the next line and (14) have it".into(),
        ),
        ..claim(
            "theorem-4-exponent",
            "section 5.2, before Theorem 4",
            "For k = λ j + j, r_k <= (r_λ)^(λ j) r_j (in the text at hand, which is scanned).",
            verdict,
            match false_at.first() {
                None => "no exception".into(),
                Some(first) => format!("false in {} cases, such as {first}", false_at.len()),
            },
            found.scope(),
        )
    }
}

/// `B_k <= max(β, 1/3) r_k`, from which (14) is derived.
fn level_bound(found: &Findings) -> Claim {
    let mut verdicts = Vec::new();
    let mut derivation_fails = Vec::new();
    for v in &found.asked {
        let truth = (1..LEVELS).map(|k| {
            let best = v.limit[k].as_ref()?;
            best.value.at_most(&v.factor()?.times(&v.rate(k)))
        });
        verdicts.push((
            v.n,
            match all(truth) {
                Some(true) if v.n == 6 => Verdict::Sharp,
                Some(true) => Verdict::Loose,
                other => Verdict::of(other),
            },
        ));
        for (i, mesh) in v.mesh_rates.iter().enumerate() {
            let third = Enclosure::exactly(Field::ratio(1, 3));
            let regular = mesh.value.times(&third);
            let bound = v.factor().map(|f| f.times(&v.rate(i + 1)));
            if bound.is_some_and(|b| regular.at_most(&b) == Some(false)) {
                derivation_fails.push(format!("n = {}, k = {}", v.n, i + 1));
            }
        }
    }
    let best = found.asked.iter().filter_map(|v| {
        let best = &v.limit[LEVELS - 1].as_ref()?.value;
        let bound = v.factor()?.times(&v.rate(LEVELS - 1));
        Some((
            v.n,
            format!("{} of {}", best.decimal(DIGITS), bound.decimal(DIGITS)),
        ))
    });
    Claim {
        certificates: found.files(|v| v.limit[LEVELS - 1].as_ref()),
        ..claim(
            "level-bound",
            "section 5.2",
            "The distance to the level-k limit mesh is at most max(β(n), 1/3) r_k(n) M.",
            gravest(&verdicts),
            format!(
                "{}; at k = {}: {}.{}",
                by_verdict(&verdicts),
                LEVELS - 1,
                list(best),
                match derivation_fails.is_empty() {
                    true => String::new(),
                    false => format!(
                        " The derivation bounds the regular subpatches by M^k / 3; that is more than the \
                         result (see lemma-1-meshes) at {}",
                        derivation_fails.join("; ")
                    ),
                }
            ),
            format!("{}, 1 <= k < {LEVELS}", found.scope()),
        )
    }
}

/// "smaller than ε" at equality.
fn strict(found: &Findings) -> Claim {
    let regular = &found.regular;
    let mut refuted = None;
    for m in 1..LEVELS {
        // M / ε = 3 4^m: the formula gives m steps, B_m(6) M = ε.
        let ratio = 3i64 << (2 * m);
        let exact = Enclosure::exactly(<Rational as Ring>::from_integer(ratio));
        let third = Enclosure::exactly(Field::ratio(1, 3));
        let depth = steps(&[regular.rate(0), regular.rate(1)], &third, &exact);
        let proved = regular.limit[m].as_ref();
        let reached = proved.and_then(|p| p.exact.as_ref()?.to_rational());
        let product = reached.map(|b| b * <Rational as Ring>::from_integer(ratio));
        if depth == Some(m as i64) && product.is_some_and(|p| p.is_one()) {
            refuted = proved.map(|proved| (m, ratio, proved));
            break;
        }
    }
    let verdict = match refuted {
        Some(_) => Verdict::Refuted,
        None => Verdict::Undecided,
    };
    let large = Enclosure::exactly(Field::ratio(1, 4));
    let third = Enclosure::exactly(Field::ratio(1, 3));
    let negative = steps(&[regular.rate(0), regular.rate(1)], &third, &large);
    Claim {
        counterexample: refuted.map(|(m, ratio, proved)| {
            let what = format!(
                "with ε = 1/{ratio} the formula gives k = {m}; M = 1 and the distance to the level-{m} limit mesh \
                 is exactly ε"
            );
            regular.counterexample(proved, what)
        }),
        certificates: refuted.map(|(_, _, proved)| proved.file.clone()).into_iter().collect(),
        method: Some(format!(
            "at most ε in place of smaller; and max(l_j, 0): with ε = 4 M, n = 6, (14) gives {}",
            negative.map_or("?".into(), |k| format!("k = {k}"))
        )),
        ..claim(
            "theorem-4-strict",
            "Theorem 4",
            "After k steps, k by (14), the distance to the level-k limit mesh is smaller than ε.",
            verdict,
            match refuted {
                Some(_) => "false where the ceiling is taken of an integer: the distance can equal ε",
                None => "no exact case was found",
            },
            "n = 6, λ = 1",
        )
    }
}

/// `k = ⌈log_4 (M / (3 ε))⌉` and `⌈log_4 (M / (2 ε))⌉` for regular patches.
fn regular_formula(found: &Findings, mesh: Mesh) -> Claim {
    let regular = &found.regular;
    let (part, name) = match mesh {
        Mesh::Limit => (3, "B_k"),
        Mesh::Control => (2, "C_k"),
    };
    let constants = match mesh {
        Mesh::Limit => &regular.limit,
        Mesh::Control => &regular.control,
    };
    // The constant is 4^-k / part, so the formula is the least k with distance <= ε, whatever ε.
    let exact = constants.iter().enumerate().map(|(k, proved)| {
        let exact = proved.as_ref()?.exact.as_ref()?;
        Some(*exact == Cyclotomic::ratio(1, part << (2 * k)))
    });
    let agree = LAMBDAS.map(|lambda| {
        let plain = [regular.rate(0), regular.rate(1)];
        let c = Enclosure::exactly(Field::ratio(1, part));
        Some(regular.by_formula(mesh, lambda, &ratio())? == steps(&plain, &c, &ratio())?)
    });
    let truth = all(exact.chain(agree));
    let (id, place) = match mesh {
        Mesh::Limit => ("regular-depth-limit", "Theorem 4"),
        Mesh::Control => ("regular-depth-control", "(16)"),
    };
    Claim {
        certificates: constants.iter().flatten().map(|p| p.file.clone()).collect(),
        ..claim(
            id,
            place,
            format!("For regular patches k = ⌈log_4 (M / ({part} ε))⌉ steps suffice."),
            match truth {
                Some(true) => Verdict::Sharp,
                other => Verdict::of(other),
            },
            format!(
                "{name}(6) = 4^-k / {part} exactly: the formula is the least k with distance at most ε"
            ),
            format!("n = 6, k < {LEVELS}"),
        )
    }
}
