//! Writes `proofs/certificates` and `proofs/rejected` anew, from the repository's root:
//!
//! ```sh
//! cargo run --release --example author_proofs
//! ```
//!
//! With `-- --only-rejected` the certificates stay as they are; with `-- --only eigensplines` all files but
//! those about eigensplines, characteristic maps and centres do.
//!
//! The certificates are what `subcert bound` writes for n = 3..50, and what `subcert reproduce` writes of
//! inequalities. A rejected file is a certificate with
//! one fault, named `<rule>-<fault>.json` after the rule that must reject it.

mod eigen_faults;
mod eigensplines;
mod loop_faults;
mod quad_faults;
mod violation_faults;

use std::error::Error;
use std::fs;
use std::ops::RangeInclusive;
use std::path::Path;

use serde_json::Value;
use subcert::bound::word::Word;
use subcert::bound::{Against, Constant, Family, Norm, Row, tabulate};
use subcert::certificate::Certificate;
use subcert::paper::{Report, cheng_yong, lanquetin_neveu_2004};
use subcert::report::constants::write_certificates;
use subcert::scheme::LoopWeights::{Original, Warren};

const GAP: f64 = 1e-6;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new("proofs");
    if !folder.join("FORMAT.md").exists() {
        return Err("run this from the repository's root".into());
    }
    let [certificates, rejected] = ["certificates", "rejected"].map(|name| folder.join(name));
    let table = Path::new("src/spectrum/eigenspline/table.txt");
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] | ["--only-rejected"] => (),
        ["--only", "eigensplines"] => {
            eigen_faults::write_all(&rejected)?;
            eigensplines::remove(&certificates)?;
            return eigensplines::write_all(&certificates, table);
        }
        _ => return Err("usage: author_proofs [--only-rejected | --only eigensplines]".into()),
    }
    renew(&folder.join("rejected"))?;
    eigen_faults::write_all(&rejected)?;
    loop_faults::write_all(&folder.join("rejected"))?;
    quad_faults::write_all(&folder.join("rejected"))?;
    violation_faults::write_all(&folder.join("rejected"))?;
    if !arguments.is_empty() {
        return Ok(());
    }
    renew(&folder.join("certificates"))?;
    eigensplines::write_all(&certificates, table)?;
    for (family, valences, list) in committed() {
        let rows = constants(family, &valences.collect::<Vec<_>>(), &list);
        write_certificates(&folder.join("certificates"), &rows)?;
    }
    for report in papers() {
        for (name, certificate) in report
            .certificates
            .iter()
            .filter(|(n, _)| n.starts_with(report.id))
        {
            fs::write(folder.join("certificates").join(name), text(certificate)?)?;
        }
    }
    let deltas: Vec<Constant> = (0..15)
        .map(|i| Constant::Coefficient(Word::EMPTY, i))
        .collect();
    write_certificates(
        &folder.join("certificates"),
        &constants(Original, &[6], &deltas),
    )?;
    Ok(())
}

fn renew(folder: &Path) -> std::io::Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    fs::create_dir_all(folder)
}

fn distances(levels: RangeInclusive<usize>) -> impl Iterator<Item = Constant> {
    let meshes = [Against::Control, Against::Limit].into_iter();
    meshes.flat_map(move |a| levels.clone().map(move |k| Constant::Distance(a, k)))
}

/// The families with the valences and the constants that are committed; `subcert bound` makes the others.
fn committed() -> Vec<(Family, RangeInclusive<u32>, Vec<Constant>)> {
    let rates = || (1..=3).map(Constant::Rate);
    let mesh_rates = |last| (1..=last).map(Constant::MeshRate);
    let of_loop: Vec<Constant> = distances(0..=3)
        .chain(rates())
        .chain(mesh_rates(2))
        .chain([Constant::Beta])
        .collect();
    let of_quads = |last| -> Vec<Constant> {
        let distances = distances(0..=last);
        distances.chain(rates()).chain(mesh_rates(1)).collect()
    };
    let faces = (0..=2).map(|k| Constant::Distance(Against::Control, k));
    vec![
        (Original.into(), 3..=50, of_loop.clone()),
        (Warren.into(), 3..=50, of_loop),
        (Family::CatmullClark(Norm::Second), 3..=50, of_quads(2)),
        (Family::CatmullClark(Norm::First), 3..=20, of_quads(1)),
        (Family::DooSabin, 3..=20, faces.chain(rates()).collect()),
    ]
}

fn constants(family: impl Into<Family>, valences: &[u32], constants: &[Constant]) -> Vec<Row> {
    let rows = tabulate(family, valences, constants, GAP, true, &|_, _| ());
    for row in &rows {
        assert!(
            row.proof.is_some(),
            "no proof of {:?} at {}",
            row.constant,
            row.n
        );
    }
    rows
}

/// The papers whose certificates are not all constants: inequalities that hold, and violations.
fn papers() -> [Report; 2] {
    let valences = |last| (3..=last).collect::<Vec<u32>>();
    [
        cheng_yong::examine(&valences(10), &|_, _| ()),
        lanquetin_neveu_2004::examine(&valences(20), &|_, _| ()),
    ]
}

fn text(certificate: &Certificate) -> std::io::Result<Vec<u8>> {
    let mut text = Vec::new();
    certificate.write(&mut text)?;
    Ok(text)
}

/// A certificate as JSON.
fn certificate(
    family: impl Into<Family>,
    n: u32,
    constant: Constant,
) -> Result<Value, Box<dyn Error>> {
    let rows = constants(family, &[n], &[constant]);
    let certificate = rows[0].certificate.as_ref().ok_or("no certificate")?;
    println!("from {}", certificate.file_name().unwrap_or_default());
    Ok(serde_json::from_slice(&text(certificate)?)?)
}

/// The first cell of a list whose way has the given name.
fn way<'a>(cells: &'a mut Value, name: &str) -> Option<&'a mut Value> {
    let cells = cells.as_array_mut()?;
    let has = |cell: &&mut Value| cell[2] == name || cell[2][0] == name;
    cells.iter_mut().find(has)
}

/// A name and what it does to a certificate.
type Fault = (&'static str, fn(&mut Value));

fn write(folder: &Path, certificate: &Value, faults: &[Fault]) -> Result<(), Box<dyn Error>> {
    for (name, fault) in faults {
        let mut faulty = certificate.clone();
        fault(&mut faulty);
        assert!(&faulty != certificate, "{name} changes nothing");
        fs::write(
            folder.join(format!("{name}.json")),
            serde_json::to_string(&faulty)? + "\n",
        )?;
    }
    Ok(())
}
