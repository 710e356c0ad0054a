//! Writes the tables of constants in `src/predict/constants` anew, from the repository's root:
//!
//! ```sh
//! cargo run --release --example author_constants
//! ```
//!
//! A line holds a number n (a valence; for Doo-Sabin the sides of a face), the name of a constant and its
//! upper bounds at the levels 0, 1, .., each the upper end of a proved enclosure ([`subcert::bound`]),
//! rounded upward to six digits: `control` C_k, `limit` B_k, `rate` r_k from k = 1, `face-rate` R. The
//! certificates behind a table are what `subcert bound` writes, for instance
//! `subcert bound control --scheme loop --valence 3..64 --level 0..16 --gap 1e-3 --certificates DIR`.

use std::error::Error;
use std::fs;
use std::path::Path;

use rayon::prelude::*;
use subcert::bound::face_rate::face_rate;
use subcert::bound::value::Numbers;
use subcert::bound::{Against, Constant, Family, Norm, tabulate};
use subcert::scalar::Rational;
use subcert::scalar::float::decimal_above;
use subcert::scheme::LoopWeights::{Original, Warren};

/// Valences, and sides of faces.
const LARGEST: u32 = 64;

/// Levels.
const DEEPEST: usize = 16;

/// Relative gap of the enclosures.
const GAP: f64 = 1e-3;

const DIGITS: u32 = 6;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new("src/predict/constants");
    if !folder.is_dir() {
        return Err("run this from the repository's root".into());
    }
    let only = std::env::args().nth(1);
    let families = [
        ("loop-original", Family::Loop(Original)),
        ("loop-warren", Family::Loop(Warren)),
        ("catmull-clark", Family::CatmullClark(Norm::Second)),
        ("doo-sabin", Family::DooSabin),
    ];
    for (name, family) in families {
        if only.as_deref().is_none_or(|only| only == name) {
            fs::write(folder.join(format!("{name}.txt")), table(family)?)?;
        }
    }
    Ok(())
}

fn table(family: Family) -> Result<String, Box<dyn Error>> {
    let valences: Vec<u32> = (3..=LARGEST).collect();
    let levels = |constant: fn(usize) -> Constant, first| {
        (first..=DEEPEST)
            .map(constant)
            .filter(|&constant| family.knows(constant))
            .collect::<Vec<_>>()
    };
    let kinds: [(&str, Vec<Constant>); 3] = [
        (
            "control",
            levels(|k| Constant::Distance(Against::Control, k), 0),
        ),
        (
            "limit",
            levels(|k| Constant::Distance(Against::Limit, k), 0),
        ),
        ("rate", levels(Constant::Rate, 1)),
    ];
    let all: Vec<Constant> = kinds.iter().flat_map(|(_, list)| list.clone()).collect();
    let tell = |done, count| eprintln!("{family:?}: {done} of {count}");
    let rows = tabulate(family, &valences, &all, GAP, false, &tell);
    let face_rates = face_rates(family, &valences)?;
    let mut text = String::new();
    for (i, (n, rows)) in valences.iter().zip(rows.chunks(all.len())).enumerate() {
        let mut rest = rows;
        for (name, list) in kinds.iter().filter(|(_, list)| !list.is_empty()) {
            let (mine, others) = rest.split_at(list.len());
            rest = others;
            text += &format!("{n} {name}");
            for row in mine {
                let proof = row.proof.as_ref().ok_or(format!("no proof: {row:?}"))?;
                text += &format!(" {}", above(proof.hi)?);
            }
            text += "\n";
        }
        if let Some(rate) = face_rates.get(i) {
            text += &format!("{n} face-rate {}\n", above(*rate)?);
        }
    }
    Ok(text)
}

/// R(n) for Loop, none for the other schemes.
fn face_rates(family: Family, valences: &[u32]) -> Result<Vec<f64>, Box<dyn Error>> {
    let Family::Loop(weights) = family else {
        return Ok(Vec::new());
    };
    let one = |&n: &u32| {
        let numbers = Numbers::of_loop(weights, n);
        let rate = face_rate(&numbers)?.rate;
        Some(numbers.enclose(&rate).sup())
    };
    let found: Option<Vec<f64>> = valences.par_iter().map(one).collect();
    Ok(found.ok_or("R(n) was not found")?)
}

fn above(x: f64) -> Result<String, Box<dyn Error>> {
    let exact = Rational::from_float(x).ok_or("an infinite bound")?;
    Ok(decimal_above(&exact, DIGITS))
}
