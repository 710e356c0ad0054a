//! Writes the meshes of `proofs/counterexamples`, from the repository's root:
//!
//! ```sh
//! cargo run --release --example author_counterexamples
//! ```
//!
//! The meshes are made here, free of anyone's rights (CC0-1.0); a test compares the files with what this
//! program makes. Their certificates are written by `author_proofs`.

use std::error::Error;
use std::fs;
use std::path::Path;

use subcert::paper::lanquetin_neveu_2004::meshes;

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
    Ok(())
}
