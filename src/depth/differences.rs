//! Our bounds from second differences and certified constants ([`crate::predict::differences`]).

use super::{Context, Found, NoDepth, Request};
use crate::mesh::Mesh;
use crate::predict::differences::{self, Bounds};
use crate::refine::RefineError;

fn bounds<'a>(
    mesh: &'a Mesh,
    request: &Request,
    local_steps: u32,
) -> Result<Bounds<'a>, RefineError> {
    let asked = differences::Request {
        scheme: request.scheme,
        corner: request.corner,
        against: request.against,
        local_steps,
    };
    Bounds::new(mesh, &asked)
}

pub(super) fn depth(context: &Context<'_>, local_steps: u32) -> Result<Found, NoDepth> {
    let bounds = bounds(context.mesh, context.request, local_steps)?;
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
    Ok(bounds(mesh, request, local_steps)?.face_depths(request.tolerance))
}
