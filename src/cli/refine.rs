//! `subcert refine`.

use std::path::PathBuf;

use subcert::mesh::{Mesh, io};
use subcert::refine::{limit_positions, refine};

use super::SchemeArguments;
use super::exit::Outcome;

/// Subdivides a mesh.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Example:\n  subcert refine examples/meshes/block_with_handle.obj --scheme catmull-clark --levels 3 --limit -o block.ply"
)]
pub struct Refine {
    /// Mesh file: .obj, .off or .ply
    mesh: PathBuf,
    #[command(flatten)]
    scheme: SchemeArguments,
    /// Number of subdivision steps
    #[arg(long, value_name = "K", default_value_t = 1)]
    levels: u32,
    /// Move the vertices to their limit positions at the end
    #[arg(long)]
    limit: bool,
    /// Where to write: .obj, .off or .ply
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
}

impl Refine {
    pub fn run(&self) -> anyhow::Result<Outcome> {
        let (scheme, corner) = self.scheme.resolve()?;
        io::Format::of_path(&self.output)?;
        let mesh = super::read(&self.mesh)?;
        super::check_size(&self.mesh, &mesh, self.levels)?;
        let mut fine =
            refine(scheme, corner, &mesh, self.levels).map_err(super::about(&self.mesh))?;
        if self.limit {
            let positions =
                limit_positions::<f64, _>(scheme, corner, &fine.topology, &fine.positions)?;
            fine = Mesh {
                topology: fine.topology,
                positions,
            };
        }
        io::write(&self.output, &fine)?;
        println!(
            "{}: {} vertices, {} faces ({}{}, boundary rule: {})",
            self.output.display(),
            fine.topology.vertex_count(),
            fine.topology.face_count(),
            scheme.name(),
            scheme
                .weights()
                .map(|w| format!(", {w} weights"))
                .unwrap_or_default(),
            super::boundary_rule(scheme, corner),
        );
        Ok(Outcome::Done)
    }
}
