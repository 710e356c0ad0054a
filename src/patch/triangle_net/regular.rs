//! The most frequent face, without rings.

use crate::bernstein::from_net;
use crate::bernstein::triangle::QuarticTriangle;
use crate::mesh::{Point, Topology};
use crate::patch::{Facet, Space};
use crate::scalar::Module;

/// S - F over a face whose corners are interior and of valence 6, without rings; `None` for other
/// faces. Also tells the largest coordinate.
///
/// The twelve points are found by crossing nine edges: the three of the face, then twice round each
/// corner.
pub fn regular_face<A, V>(
    topology: &Topology,
    positions: &[Point<A::Scalar>],
    face: u32,
    compared: Facet,
) -> Option<(QuarticTriangle<V>, f64)>
where
    A: Space<Point = V>,
    V: Module<A::Scalar>,
{
    let mut halfedges = topology.halfedges(face);
    let first = halfedges.start;
    let regular = |h: u32| {
        let v = topology.origin(h);
        topology.valence(v) == 6 && !topology.is_boundary_vertex(v)
    };
    if !halfedges.all(regular) {
        return None;
    }
    let (next, prev) = (|h| topology.next(h), |h| topology.prev(h));
    let (twin, origin) = (|h| topology.twin(h), |h| topology.origin(h));
    let [a, b, c] = [first, first + 1, first + 2];
    // Across AB, BC, CA: half-edges from B to A, C to B, A to C.
    let [ba, cb, ac] = [twin(a), twin(b), twin(c)];
    let a_ab = twin(next(ba)); // from the vertex opposite AB to A
    let a_x2 = twin(next(a_ab)); // from x2 to A
    let b_ab = twin(prev(ba)); // from B to the vertex opposite AB
    let b_y1 = twin(prev(b_ab)); // from B to y1
    let c_bc = twin(prev(cb)); // from C to the vertex opposite BC
    let c_z1 = twin(prev(c_bc)); // from C to z1
    let vertices = [
        origin(prev(a_ab)), // x2, in the notation of `regular_patch`
        origin(prev(a_x2)),
        origin(prev(ba)),
        origin(a),
        origin(prev(ac)),
        origin(prev(b_ab)),
        origin(b),
        origin(c),
        origin(prev(c_z1)),
        origin(prev(b_y1)),
        origin(prev(cb)),
        origin(prev(c_bc)),
    ];
    let base = &positions[origin(a) as usize];
    let net: [V; 12] = vertices.map(|v| A::lift(&positions[v as usize], base));
    let size = net.iter().map(|p| A::magnitude(p)).fold(0.0, f64::max);
    let mut surface = from_net::box_spline::<A::Scalar, V>(&net);
    let facet = match compared {
        Facet::Limit => [0, 10, 14].map(|corner| surface.0[corner].clone()),
        Facet::Control => [3, 6, 7].map(|corner| net[corner].clone()),
        Facet::Nothing => return Some((surface, size)),
    };
    let facet = QuarticTriangle::from_linear::<A::Scalar>(&facet);
    surface.subtract::<A::Scalar>(&facet);
    Some((surface, size))
}
