//! The most frequent face, without fans.

use super::rules::PLACE;
use crate::bernstein::from_net;
use crate::bernstein::tensor::{Bicubic, Tensor};
use crate::mesh::{Point, Topology};
use crate::patch::{Facet, Space};
use crate::scalar::Module;

/// S - F over a quad of an all-quad mesh whose corners are interior and of valence 4; `None` for
/// other faces. Also tells the largest coordinate.
///
/// The twelve points round the face are found by crossing two edges at each corner.
pub fn regular_face<A, V>(
    topology: &Topology,
    positions: &[Point<A::Scalar>],
    face: u32,
    compared: Facet,
) -> Option<(Bicubic<V>, f64)>
where
    A: Space<Point = V>,
    V: Module<A::Scalar>,
{
    if topology.arity() != Some(4) {
        return None;
    }
    let first = topology.halfedges(face).start;
    let mut vertices = [0; 16];
    for (h, [at, at_e2, at_e3, at_d2]) in (first..).zip(PLACE) {
        let corner = topology.origin(h);
        if topology.valence(corner) != 4 || topology.is_boundary_vertex(corner) {
            return None;
        }
        // Outgoing half-edges counterclockwise: to the next corner, to the previous one, to e2. The
        // face of the last is (corner, e2, d2, e3).
        let to_e2 = topology.rotate(topology.rotate(h));
        let (e2, d2) = (topology.next(to_e2), topology.next(topology.next(to_e2)));
        vertices[at] = corner;
        vertices[at_e2] = topology.origin(e2);
        vertices[at_d2] = topology.origin(d2);
        vertices[at_e3] = topology.origin(topology.next(d2));
    }
    let base = &positions[topology.origin(first) as usize];
    let net: [V; 16] = vertices.map(|v| A::lift(&positions[v as usize], base));
    let size = net.iter().map(|p| A::magnitude(p)).fold(0.0, f64::max);
    let mut surface = from_net::bicubic::<A::Scalar, V>(&net);
    let facet = match compared {
        Facet::Limit => [0, 3, 15, 12].map(|corner| surface.0[corner].clone()),
        Facet::Control => [5, 6, 10, 9].map(|corner| net[corner].clone()),
        Facet::Nothing => return Some((surface, size)),
    };
    surface.subtract::<A::Scalar>(&Tensor::from_bilinear::<A::Scalar>(&facet));
    Some((surface, size))
}
