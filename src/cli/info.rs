//! `subcert info`.

use std::path::PathBuf;

use subcert::mesh::summary::Summary;

use super::exit::Outcome;

/// Counts of a mesh.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:\n  subcert info examples/meshes/bumpy_torus_tri.obj")]
pub struct Info {
    /// Mesh file: .obj, .off or .ply
    mesh: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Info {
    pub fn run(&self) -> anyhow::Result<Outcome> {
        let mesh = super::read(&self.mesh)?;
        let summary = Summary::of(&mesh);
        super::print(self.json.then_some(&summary), || summary.to_string())?;
        Ok(Outcome::Done)
    }
}
