//! Writes the tables of constants in `src/predict/constants` anew, from the repository's root:
//!
//! ```sh
//! cargo run --release --example author_constants
//! ```
//!
//! With the name of a table after `--` only that one is written. A line holds a number n (a valence; for
//! Doo-Sabin the sides of a face), the name of a constant and its upper bounds at the levels 0, 1, .., each the
//! upper end of a proved enclosure ([`subcert::bound`]), rounded upward to six digits: `control` C_k, `limit`
//! B_k, `rate` r_k from k = 1, `face-rate` R (Loop: R(n); Catmull-Clark: the mesh rate of
//! one step; Doo-Sabin: regular nets two steps on). The
//! certificates behind a table are what `subcert bound` writes, for instance
//! `subcert bound control --scheme loop --valence 3..64 --level 0..16 --gap 1e-3 --certificates DIR`.

use std::error::Error;
use std::fs;
use std::path::Path;

use rayon::prelude::*;
use subcert::bound::face_rate::face_rate;
use subcert::bound::value::Numbers;
use subcert::bound::{Against, Constant, Family, Norm, tabulate};
use subcert::lp::Rows;
use subcert::scalar::Rational;
use subcert::scalar::float::decimal_above;
use subcert::scheme::LoopWeights::{Original, Warren};
use subcert::scheme::Tile;
use subcert::scheme::doo_sabin::{
    face_differences, local_net_size, subdivision_matrix, tile_matrix,
};

/// Valences.
const LARGEST: u32 = 64;

/// Sides of Doo-Sabin's faces: with the diameter the number of differences grows with their square.
const MOST_SIDES: u32 = 24;

/// Levels of rates, and of distances at the valences up to [`SMALL`].
const DEEPEST: usize = 16;

/// The valences for which distances are proved at all levels; beyond, where a proof takes long, at the levels
/// up to [`SHALLOW`], and those below follow from the rates ([`subcert::predict::differences::constants`]).
const SMALL: u32 = 12;

/// Levels of distances at large valences.
const SHALLOW: usize = 3;

/// Levels of distances at valence 3, where the number of parts doubles with the level.
const OF_THREE: usize = 6;

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
    let small: Vec<u32> = (4..=SMALL).collect();
    let largest = match family {
        Family::DooSabin => MOST_SIDES,
        _ => LARGEST,
    };
    let large: Vec<u32> = (SMALL + 1..=largest).collect();
    let three = rows(family, &[3], OF_THREE)?;
    let small = rows(family, &small, DEEPEST)?;
    Ok(three + &small + &rows(family, &large, SHALLOW)?)
}

/// The lines of some valences, distances to the level `deepest`.
fn rows(family: Family, valences: &[u32], deepest: usize) -> Result<String, Box<dyn Error>> {
    let control = |k| Constant::Distance(Against::Control, k);
    let limit = |k| Constant::Distance(Against::Limit, k);
    let face_rate = vec![Constant::MeshRate(1)];
    let kinds: [(&str, Vec<Constant>); 4] = [
        ("control", (0..=deepest).map(control).collect()),
        ("limit", (0..=deepest).map(limit).collect()),
        ("rate", (1..=DEEPEST).map(Constant::Rate).collect()),
        ("face-rate", face_rate),
    ];
    // Loop's R(n) is about more faces than the mesh rate.
    let is_loop = matches!(family, Family::Loop(_));
    let of_family = |(name, list): &&(&str, Vec<Constant>)| {
        family.knows(list[0]) && !(is_loop && *name == "face-rate")
    };
    let kinds: Vec<_> = kinds.iter().filter(of_family).collect();
    let all: Vec<Constant> = kinds.iter().flat_map(|(_, list)| list.clone()).collect();
    let tell = |done, count| eprintln!("{family:?}: {done} of {count}");
    let rows = tabulate(family, valences, &all, GAP, false, &tell);
    let face_rates = face_rates(family, valences)?;
    let mut text = String::new();
    for (i, (n, rows)) in valences.iter().zip(rows.chunks(all.len())).enumerate() {
        let mut rest = rows;
        for (name, list) in &kinds {
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

/// R(n) for Loop and Doo-Sabin; Catmull-Clark's is a constant of the prover.
fn face_rates(family: Family, valences: &[u32]) -> Result<Vec<f64>, Box<dyn Error>> {
    let one = |&n: &u32| match family {
        Family::Loop(weights) => {
            let numbers = Numbers::of_loop(weights, n);
            let rate = face_rate(&numbers)?.rate;
            Some(numbers.enclose(&rate).sup())
        }
        _ => rate_beside_a_face(n),
    };
    if let Family::CatmullClark(_) = family {
        return Ok(Vec::new());
    }
    let found: Option<Vec<f64>> = valences.par_iter().map(one).collect();
    Ok(found.ok_or("R(n) was not found")?)
}

/// Doo-Sabin: the largest second difference of the level-2 nets beside the extraordinary face, over M.
///
/// A multiplier of each difference comes from a basis in integers, so `t = Σ x_l α_l` holds but for the
/// roundings of t, some 1e-14 over all; what these weigh is below 1e-9.
fn rate_beside_a_face(n: u32) -> Option<f64> {
    let rows = Rows::new(face_differences(n), local_net_size(n));
    let matrix = subdivision_matrix::<f64>(n)?;
    let mut largest = 0.0_f64;
    for tile in [Tile::First, Tile::Second, Tile::Third] {
        let grid = tile_matrix::<f64>(n, tile)? * &matrix;
        let mut basis = rows.start().clone();
        for line in [
            [0, 1, 2],
            [3, 4, 5],
            [6, 7, 8],
            [0, 3, 6],
            [1, 4, 7],
            [2, 5, 8],
        ] {
            let [a, b, c] = line.map(|i| grid.row(i));
            let t: Vec<f64> = (a - 2.0 * b + c).iter().copied().collect();
            basis = rows.propose(&t, &basis)?.0;
            let multiplier =
                |column: &[i64]| -> f64 { t.iter().zip(column).map(|(t, &c)| t * c as f64).sum() };
            let sum: f64 = basis
                .row_columns()
                .map(|(_, column)| multiplier(column).abs())
                .sum();
            largest = largest.max(sum / basis.determinant() as f64);
        }
    }
    Some(largest + 1e-9)
}

fn above(x: f64) -> Result<String, Box<dyn Error>> {
    let exact = Rational::from_float(x).ok_or("an infinite bound")?;
    Ok(decimal_above(&exact, DIGITS))
}
