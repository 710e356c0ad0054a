//! Sections 1, 6, 7: the limit mesh against the control mesh.

use std::cmp::Ordering;

use super::Findings;
use super::nets::regular_coefficients;
use super::valence::{LEVELS, place};
use crate::paper::words::{DIGITS, all, claim};
use crate::paper::{Claim, Table, Verdict};
use crate::scalar::{Rational, Ring};

/// C_k and B_k, k = 0, 1, ..
pub fn table(found: &Findings) -> Table {
    let mut rows = Vec::new();
    for k in 0..LEVELS {
        for v in &found.asked {
            let value = |p: &Option<super::valence::Proved>| {
                p.as_ref()
                    .map_or("?".into(), |p| p.value.decimal(DIGITS + 2))
            };
            rows.push(vec![
                k.to_string(),
                v.n.to_string(),
                value(&v.control[k]),
                value(&v.limit[k]),
                match better(v, k) {
                    Some(true) => "limit",
                    Some(false) => "control",
                    None => "?",
                }
                .into(),
                [&v.control[k], &v.limit[k]]
                    .into_iter()
                    .flatten()
                    .map(|p| p.file.as_str())
                    .collect::<Vec<_>>()
                    .join(" "),
            ]);
        }
    }
    Table {
        id: "comparison",
        title: "The level-k control mesh against the level-k limit mesh: sharp constants".into(),
        heads: vec!["k", "n", "sharp C_k", "sharp B_k", "nearer", "certificates"],
        rows,
        notes: Vec::new(),
    }
}

/// Whether B_k < C_k.
fn better(v: &super::valence::Valence, k: usize) -> Option<bool> {
    let (limit, control) = (v.limit[k].as_ref()?, v.control[k].as_ref()?);
    Some(limit.value.compare(&control.value)? == Ordering::Less)
}

/// The claims of the comparison.
pub fn claims(found: &Findings) -> Vec<Claim> {
    vec![at_level_0(found), at_all_levels(found), inscribed()]
}

fn at_level_0(found: &Findings) -> Claim {
    let truths = found.asked.iter().map(|v| better(v, 0));
    Claim {
        certificates: found.files(|v| v.control[0].as_ref()),
        ..claim(
            "limit-better",
            "section 6",
            "The limit mesh approximates a Loop surface better than the corresponding control mesh (as \
             constants at level 0).",
            Verdict::of(all(truths)),
            "B_0(n) against C_0(n): the suprema themselves, not the paper's unlike bounds β(n) and C_3(6)",
            found.scope(),
        )
    }
}

fn at_all_levels(found: &Findings) -> Claim {
    let mut truths = Vec::new();
    let mut false_at = Vec::new();
    let mut witness = None;
    let mut files = Vec::new();
    for v in &found.asked {
        for k in 1..LEVELS {
            let truth = better(v, k);
            truths.push(truth);
            let (Some(false), Some(limit), Some(control)) = (truth, &v.limit[k], &v.control[k])
            else {
                continue;
            };
            let (b, c) = (limit.value.decimal(DIGITS), control.value.decimal(DIGITS));
            false_at.push(format!("n = {}, k = {k}: B_k = {b} > C_k = {c}", v.n));
            files.extend([limit.file.clone(), control.file.clone()]);
            let what = format!(
                "M = 1 and the distance to the level-{k} limit mesh is {b} {}; no net is farther than {c} \
                 from its level-{k} control mesh",
                place(&limit.at)
            );
            witness.get_or_insert_with(|| v.counterexample(limit, what));
        }
    }
    Claim {
        counterexample: witness,
        certificates: files,
        ..claim(
            "limit-better-levels",
            "sections 6, 7",
            "The same for the refined meshes, level k against level k: the limit mesh is the better one \
             in general.",
            Verdict::of(all(truths)),
            match false_at.is_empty() {
                true => "no exception".into(),
                false => format!("false at {}", false_at.join("; ")),
            },
            format!("{}, 1 <= k < {LEVELS}", found.scope()),
        )
    }
}

fn inscribed() -> Claim {
    let net = |sign: i64| -> Vec<Rational> {
        let radial = super::nets::radial(6);
        radial
            .into_iter()
            .map(|y| <Rational as Ring>::from_integer(sign * y))
            .collect()
    };
    let zero = <Rational as Ring>::from_integer(0);
    let corners = |c: &[Rational; 15]| [0, 10, 14].iter().all(|&i| c[i] == zero);
    let (above, below) = (
        regular_coefficients(&net(1)),
        regular_coefficients(&net(-1)),
    );
    let on_surface = corners(&above) && corners(&below);
    let both_sides = above.iter().zip(&below).all(|(a, b)| *a == -b.clone());
    claim(
        "inscribed",
        "abstract, section 1",
        "The limit mesh inscribes the limit surface.",
        Verdict::of(Some(on_surface)),
        format!(
            "true of its vertices, which lie on S by definition; its edges and faces do not in general, \
             and S lies on {} of them (S - F̄ changes its sign with the net)",
            if both_sides {
                "either side"
            } else {
                "one side"
            }
        ),
        "every n",
    )
}
