//! Writes the meshes of `proofs/counterexamples` and the certificates `lanquetin-neveu-*.json` of
//! `proofs/certificates`, from the repository's root:
//!
//! ```sh
//! cargo run --release --example author_counterexamples
//! ```
//!
//! With `-- --only-meshes` the certificates stay as they are. The meshes are made here, free of anyone's
//! rights (CC0-1.0); a test compares the files with what this program makes.

use std::error::Error;
use std::fs;
use std::path::Path;

use subcert::paper::lanquetin_neveu_2004::{examine, meshes};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new("proofs");
    if !folder.join("FORMAT.md").exists() {
        return Err("run this from the repository's root".into());
    }
    let target = folder.join("counterexamples");
    fs::create_dir_all(&target)?;
    for mesh in meshes::counterexamples() {
        fs::write(target.join(format!("{}.obj", mesh.name)), mesh.obj())?;
    }
    if std::env::args().any(|argument| argument == "--only-meshes") {
        return Ok(());
    }
    let valences: Vec<u32> = (3..=20).collect();
    let report = examine(&valences, &|done, count| eprintln!("{done} of {count}"));
    let ours = report
        .certificates
        .iter()
        .filter(|(name, _)| name.starts_with("lanquetin-neveu-"));
    for (name, certificate) in ours {
        let mut text = Vec::new();
        certificate.write(&mut text)?;
        fs::write(folder.join("certificates").join(name), text)?;
        println!("{name}");
    }
    Ok(())
}
