//! Our bounds from second differences and certified constants ([`crate::predict::differences`]).

use super::{Context, Found, NoDepth, Request};
use crate::mesh::Mesh;
use crate::predict::differences::{self, Bounds, LocalSteps};
use crate::refine::RefineError;

fn asked(request: &Request, local_steps: u32) -> differences::Request {
    differences::Request {
        scheme: request.scheme,
        corner: request.corner,
        against: request.against,
        local_steps,
    }
}

pub(super) fn steps<'a>(mesh: &'a Mesh, request: &Request) -> Result<LocalSteps<'a>, RefineError> {
    LocalSteps::new(mesh, &asked(request, 0))
}

pub(super) fn depth(context: &Context<'_>, local_steps: u32) -> Result<Found, NoDepth> {
    let bounds = context.steps.borrow_mut().bounds(local_steps)?;
    let depth = bounds
        .depth(context.request.tolerance)
        .ok_or_else(|| NoDepth(format!("none up to {} is proved", Bounds::DEEPEST)))?;
    Ok(Found {
        depth,
        bound: bounds.at(depth),
        safe: true,
        why: match local_steps {
            0 => "certified constants".into(),
            1 => "certified constants after 1 local subdivision".into(),
            _ => format!("certified constants after {local_steps} local subdivisions"),
        },
    })
}

/// For each face of the mesh how many steps its own bound asks for; `None` beyond [`Bounds::DEEPEST`].
///
/// # Errors
/// If and only if the scheme refuses the mesh.
pub fn face_depths(
    mesh: &Mesh,
    request: &Request,
    local_steps: u32,
) -> Result<Vec<Option<u32>>, RefineError> {
    let bounds = Bounds::new(mesh, &asked(request, local_steps))?;
    Ok(bounds.face_depths(request.tolerance))
}
