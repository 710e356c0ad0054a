//! Certificates about eigensplines, characteristic maps and centres, and the table made of them.

use std::error::Error;
use std::fs;
use std::path::Path;

use subcert::certificate::Certificate;
use subcert::scheme::LoopWeights::{Original, Warren};
use subcert::scheme::{LoopWeights, Scheme};
use subcert::spectrum::eigenspline::certificates::{
    centre_distance, certificate, characteristic_map, own_modes,
};
use subcert::spectrum::eigenspline::{Against, table};
use subcert_check::check;

use super::text;

/// The levels of the distances: 0..=6.
const LAST_LEVEL: usize = 6;

/// What the names of these families' files have in them.
const FAMILIES: [&str; 3] = [
    "-eigensplines-",
    "-characteristic-map-",
    "-centre-distance-",
];

/// Takes the files of these families away.
pub fn remove(folder: &Path) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if FAMILIES.iter().any(|family| name.contains(family)) {
            fs::remove_file(&path)?;
        }
    }
    Ok(())
}

/// Writes the certificates, and the table.
pub fn write_all(folder: &Path, table: &Path) -> Result<(), Box<dyn Error>> {
    for n in 3..=50 {
        for scheme in [Scheme::Loop(Original), Scheme::CatmullClark] {
            write(folder, &least_splits(scheme, n)?)?;
        }
    }
    for n in 4..=30 {
        for weights in [Original, Warren] {
            let file = centre_distance(weights, n);
            // Where a coefficient is positive, nothing is claimed.
            if check(&text(&file)?).outcome.is_ok() {
                write(folder, &file)?;
            }
        }
    }
    let mut lines = String::new();
    for weights in [Original, Warren] {
        for n in (3..=30).filter(|n| weights == Original || !matches!(n, 3 | 6)) {
            for against in [Against::Control, Against::Limit] {
                lines += &distances(folder, weights, n, against)?;
            }
        }
    }
    fs::write(table, lines)?;
    Ok(())
}

/// The certificate of one valence; its lines of the table.
fn distances(
    folder: &Path,
    weights: LoopWeights,
    n: u32,
    against: Against,
) -> Result<String, Box<dyn Error>> {
    let found = own_modes(weights, n, against, LAST_LEVEL);
    let found = found.ok_or_else(|| format!("no distances of {weights}, {against}, n = {n}"))?;
    write(folder, &certificate(weights, n, against, &found))?;
    let lines = found
        .iter()
        .map(|mode| table::line(weights, n, against, mode));
    Ok(lines.collect())
}

/// With as few quarterings as will do.
fn least_splits(scheme: Scheme, n: u32) -> Result<Certificate, Box<dyn Error>> {
    for splits in 0..=8 {
        let file = characteristic_map(scheme, n, splits).ok_or("no characteristic map")?;
        if check(&text(&file)?).outcome.is_ok() {
            return Ok(file);
        }
    }
    Err(format!("the characteristic map of {scheme:?}, n = {n}, is not verified").into())
}

fn write(folder: &Path, certificate: &Certificate) -> Result<(), Box<dyn Error>> {
    let name = certificate
        .file_name()
        .ok_or("a certificate without a name")?;
    println!("{name}");
    fs::write(folder.join(name), text(certificate)?)?;
    Ok(())
}
