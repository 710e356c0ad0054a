//! Hausdorff distances between a limit surface and a mesh: section 10 of FORMAT.md.
//!
//! | file | what is in it |
//! |---|---|
//! | `claim` | the claim and the steps as they are written, the claim in words |
//! | `setting` | the mesh, its rules, the surface's faces, F: scaled and checked |
//! | `polygon_mesh`, `refine`, `part` | meshes with fans, one step of refinement, parts of faces with their nets |
//! | `facets`, `distance` | F's facets; lengths, foot points, directions |
//! | `cells` | walks through the words of the cells, which share their nets |
//! | `far`, `near` | the rules |
//! | `eigen` | the net of an eigenspline |

use self::claim::{Hausdorff, Side};
use self::setting::Setting;
use crate::file::{File, Step};
use crate::reject::{Outcome, Rejection, Rule, ensure};

mod cells;
pub mod claim;
mod distance;
mod eigen;
mod facets;
mod far;
mod near;
mod part;
mod polygon_mesh;
mod refine;
mod setting;

/// Shows that the distance is from lo to hi, and what else is claimed.
///
/// # Errors
///
/// If and only if a rule of section 10 does not accept it: by that rule; `bases`, `claim`, `cosine`, `format` if the file
/// is not one for this claim.
pub fn check(file: &File, claim: &Hausdorff) -> Outcome<()> {
    ensure!(file.bases.is_empty(), Rule::Bases, "a distance has no bases");
    claim.check_sense()?;
    ensure!(names(file) == wanted(claim), Rule::Format, "the steps are not those of the claim");
    let setting = Setting::new(claim, file.cosine.as_ref())?;
    for (index, step) in file.steps.iter().enumerate() {
        let shown = match step {
            Step::Far(step) => far::check(&setting, claim, step),
            Step::NearMesh(step) => near::check_mesh(&setting, &step.cells),
            Step::NearSurface(step) => near::check_surface(&setting, &step.cells),
            Step::Vertex(_) => near::check_vertices(&setting),
            _ => Err(Rejection::new(Rule::Format, "no step of a distance")),
        };
        shown.map_err(|rejection| Rejection { step: Some(index), ..rejection })?;
    }
    Ok(())
}

/// The rules that the claim asks for, in order.
fn wanted(claim: &Hausdorff) -> Vec<Rule> {
    let near_mesh = claim.has(Side::SurfaceToMesh).then_some(Rule::NearMesh);
    let near_surface = claim.has(Side::MeshToSurface).then_some(Rule::NearSurface);
    let vertex = claim.vertex.is_some().then_some(Rule::Vertex);
    [Some(Rule::Far), near_mesh, near_surface, vertex].into_iter().flatten().collect()
}

/// The rules of the steps; `format` stands for those of other claims.
fn names(file: &File) -> Vec<Rule> {
    let name = |step: &Step| match step {
        Step::Far(_) => Rule::Far,
        Step::NearMesh(_) => Rule::NearMesh,
        Step::NearSurface(_) => Rule::NearSurface,
        Step::Vertex(_) => Rule::Vertex,
        _ => Rule::Format,
    };
    file.steps.iter().map(name).collect()
}
