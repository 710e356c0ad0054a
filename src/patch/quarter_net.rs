//! Doo-Sabin: the quarter of a face at one of its vertices.
//!
//! The quarter (g, w) of face g at vertex w is a square with (0,0) = w, (1,0) the middle of the edge
//! to the next corner, (1,1) the centroid of g, (0,1) the middle of the edge to the previous corner.
//! One step puts the child w_g at its middle; the four faces round w_g are those of the four quarter
//! squares, each with its centroid at a corner of (g, w): the next step's quarters are nested in it
//! for ever.

use num_traits::Zero;

use super::{Corners, Sink, Space, farthest};
use crate::bernstein::tensor::{Biquadratic, Tensor};
use crate::bernstein::{from_net, mid_parameter, midpoint};
use crate::mesh::{Point, Topology};
use crate::scalar::{Field, Module};
use crate::scheme::{catmull_clark, doo_sabin};

/// The faces round a vertex w, counterclockwise, each beginning with w; the first is the face of
/// the quarter. The second point of each face is the last of the one before.
#[derive(Clone, Debug)]
pub struct QuarterNet<V> {
    faces: Vec<Vec<V>>,
    /// F at the corners of the quarter.
    facet: [V; 4],
    /// Parameters of the quarter's corners.
    pub corners: Corners,
    /// Local steps taken since the mesh.
    pub steps: u32,
}

impl<V: Zero> Default for QuarterNet<V> {
    fn default() -> Self {
        QuarterNet {
            faces: Vec::new(),
            facet: std::array::from_fn(|_| V::zero()),
            corners: [[0.0; 2]; 4],
            steps: 0,
        }
    }
}

/// Doo-Sabin's corner masks, by face size.
#[derive(Clone, Debug)]
pub struct DooSabinRules<S> {
    masks: Vec<Option<Vec<S>>>,
}

impl<S: Field> DooSabinRules<S> {
    /// The masks of all face sizes and interior valences of the mesh (each vertex becomes a face),
    /// and of 4.
    ///
    /// # Errors
    /// The face size, if and only if the arithmetic cannot represent its mask.
    pub fn new(topology: &Topology) -> Result<Self, u32> {
        let mut masks: Vec<Option<Vec<S>>> = Vec::new();
        let mut want = |n: u32| -> Result<(), u32> {
            if masks.len() <= n as usize {
                masks.resize(n as usize + 1, None);
            }
            if masks[n as usize].is_none() {
                masks[n as usize] = Some(doo_sabin::corner_mask(n).ok_or(n)?);
            }
            Ok(())
        };
        want(4)?;
        for face in 0..topology.face_count() {
            want(topology.face_size(face))?;
        }
        for vertex in 0..topology.vertex_count() {
            if !topology.is_boundary_vertex(vertex) && topology.valence(vertex) >= 3 {
                want(topology.valence(vertex))?;
            }
        }
        Ok(DooSabinRules { masks })
    }

    fn child<V: Module<S>>(&self, face: &[V], corner: usize) -> V {
        let mask = self.masks[face.len()]
            .as_ref()
            .expect("a mask for each face size");
        doo_sabin::corner_point(mask, face, corner)
    }
}

impl<V> QuarterNet<V> {
    /// Gathers the faces round vertex `origin(h)`, beginning with the face of `h`. The vertex may be
    /// on the boundary (then only [`QuarterNet::limit`] makes sense).
    pub fn gather<A>(
        &mut self,
        topology: &Topology,
        positions: &[Point<A::Scalar>],
        h: u32,
        base: &Point<A::Scalar>,
    ) where
        A: Space<Point = V>,
        V: Module<A::Scalar>,
    {
        let vertex = topology.origin(h);
        let start = if topology.is_boundary_vertex(vertex) {
            topology.first_halfedge(vertex)
        } else {
            h
        };
        let (mut outgoing, mut count) = (start, 0);
        loop {
            if self.faces.len() <= count {
                self.faces.push(Vec::new());
            }
            let face = &mut self.faces[count];
            face.clear();
            let mut around = outgoing;
            loop {
                face.push(A::lift(&positions[topology.origin(around) as usize], base));
                around = topology.next(around);
                if around == outgoing {
                    break;
                }
            }
            count += 1;
            outgoing = topology.rotate(outgoing);
            if outgoing == crate::mesh::NONE || outgoing == start {
                break;
            }
        }
        self.faces.truncate(count);
        self.steps = 0;
    }

    /// The mean of the children of the vertex: its limit position if it is interior, and what this
    /// library takes in its place on a boundary.
    pub fn limit<S: Field>(&self, rules: &DooSabinRules<S>) -> V
    where
        V: Module<S>,
    {
        let total = self
            .faces
            .iter()
            .fold(V::zero(), |total, face| total + &rules.child(face, 0));
        catmull_clark::face_point(&total, self.faces.len() as u32)
    }

    /// S - F at the four corners of the quarter of an interior vertex. One step puts a face there: the
    /// face of the vertex at corner 0, those of its two edges in the first face at corners 1 and 3, the
    /// child of the first face at corner 2; S is their centroid.
    pub fn corner_differences<S: Field>(&self, rules: &DooSabinRules<S>) -> [V; 4]
    where
        V: Module<S>,
    {
        let n = self.faces.len();
        let (own, before, after) = (&self.faces[0], &self.faces[n - 1], &self.faces[1 % n]);
        let child = |face: &[V], corner: usize| rules.child(face, corner);
        let edge = |a: V, b: V, c: V, d: V| catmull_clark::quad_point(&a, &b, &c, &d);
        let vertex = child(own, 0);
        let next = edge(
            vertex.clone(),
            child(own, 1),
            child(before, before.len() - 1),
            child(before, 0),
        );
        let prev = edge(
            vertex,
            child(own, own.len() - 1),
            child(after, 1),
            child(after, 0),
        );
        let [at_vertex, at_next, _, at_prev] = &self.facet;
        [
            self.limit(rules) - at_vertex,
            next - at_next,
            self.corner_difference::<S>(),
            prev - at_prev,
        ]
    }

    /// Sets what to compare with and where the quarter lies.
    pub fn place(&mut self, facet: [V; 4], corners: Corners) {
        self.facet = facet;
        self.corners = corners;
    }

    /// Whether the next step yields one polynomial patch.
    pub fn is_regular(&self) -> bool {
        self.faces.len() == 4 && self.faces[0].len() == 4
    }

    /// The number of faces plus the size of the largest.
    pub fn arity(&self) -> u32 {
        (self.faces.len() + self.faces.iter().map(Vec::len).max().unwrap_or(0)) as u32
    }

    /// The points of the net.
    pub fn points(&self) -> impl Iterator<Item = &V> {
        self.faces.iter().flatten()
    }

    /// The largest squared distance of a point of the net to a corner of F: an upper bound for
    /// |S - F|^2 over the quarter.
    pub fn hull_bound<A>(&self) -> A::Square
    where
        A: Space<Point = V>,
        V: Module<A::Scalar>,
    {
        farthest::<A>(self.points(), &self.facet)
    }

    /// S - F at the centroid corner: S there is the centroid of the first face.
    pub fn corner_difference<S: Field>(&self) -> V
    where
        V: Module<S>,
    {
        let face = &self.faces[0];
        let total = face.iter().fold(V::zero(), |total, p| total + p);
        catmull_clark::face_point(&total, face.len() as u32) - &self.facet[2]
    }
}

/// One Doo-Sabin step: one patch if the four faces round the new vertex are quads, otherwise the
/// four nested quarters as nets.
pub fn split<A, V>(
    rules: &DooSabinRules<A::Scalar>,
    net: &QuarterNet<V>,
    sink: &mut impl Sink<Biquadratic<V>, QuarterNet<V>>,
) where
    A: Space<Point = V>,
    V: Module<A::Scalar>,
{
    let n = net.faces.len();
    let g = &net.faces[0];
    let (before, after) = (&net.faces[n - 1], &net.faces[1 % n]);
    let m = g.len();
    // Children: of g all; of w in every face; of a (next in g) in the face before, where it is the
    // last corner; of z (previous in g) in the face after, where it is the second.
    let a_before = rules.child(before, before.len() - 1);
    let z_after = rules.child(after, 1);
    let own = |k: usize| rules.child(&net.faces[k], 0);
    let steps = net.steps + 1;
    if m == 4 && n == 4 {
        let [w, a, c, z]: [V; 4] = std::array::from_fn(|i| rules.child(g, i));
        let grid = [own(2), own(3), a_before, own(1), w, a, z_after, z, c];
        let facet = Tensor::from_bilinear::<A::Scalar>(&net.facet);
        let mut patch = from_net::biquadratic::<A::Scalar, V>(&grid);
        patch.subtract::<A::Scalar>(&facet);
        sink.patch(&patch, net.corners, steps);
        return;
    }
    let faces: [Vec<V>; 4] = {
        let own_face: Vec<V> = (0..m).map(|i| rules.child(g, i)).collect();
        let vertex_face: Vec<V> = (0..n).map(own).collect();
        let (w, a, z) = (
            own_face[0].clone(),
            own_face[1].clone(),
            own_face[m - 1].clone(),
        );
        let left = vec![w.clone(), z, z_after, vertex_face[1].clone()];
        let right = vec![w, vertex_face[n - 1].clone(), a_before, a];
        [own_face, left, vertex_face, right]
    };
    let (p, f) = (&net.corners, &net.facet);
    let center = mid_parameter(p[0], p[2]);
    let facet_center = catmull_clark::quad_point(&f[0], &f[1], &f[2], &f[3]);
    let middle = |i: usize| mid_parameter(p[i % 4], p[(i + 1) % 4]);
    let facet_middle = |i: usize| midpoint::<A::Scalar, V>(&f[i % 4], &f[(i + 1) % 4]);
    for k in 0..4 {
        // The square at corner 2, 3, 0, 1 of the quarter; its own u runs towards the middle of the
        // side before that corner.
        let corner = (k + 2) % 4;
        let mut child = sink.spare();
        child.faces.resize_with(4, Vec::new);
        for (i, face) in child.faces.iter_mut().enumerate() {
            face.clear();
            face.extend_from_slice(&faces[(k + i) % 4]);
        }
        child.facet = [
            facet_center.clone(),
            facet_middle(corner + 3),
            f[corner].clone(),
            facet_middle(corner),
        ];
        child.corners = [center, middle(corner + 3), p[corner], middle(corner)];
        child.steps = steps;
        sink.net(child);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::patch::Exact;
    use crate::scalar::{Rational, Ring};

    struct Nets(Vec<QuarterNet<Point<Rational>>>);

    impl Sink<Biquadratic<Point<Rational>>, QuarterNet<Point<Rational>>> for Nets {
        fn patch(&mut self, _: &Biquadratic<Point<Rational>>, _: Corners, _: u32) {
            unreachable!("an irregular quarter yields nets");
        }
        fn spare(&mut self) -> QuarterNet<Point<Rational>> {
            QuarterNet::default()
        }
        fn net(&mut self, net: QuarterNet<Point<Rational>>) {
            self.0.push(net);
        }
        fn discard(&mut self, _: QuarterNet<Point<Rational>>) {}
    }

    /// A corner of a quarter is the centroid corner of one of the four quarters nested in it, where S
    /// is the centroid of that quarter's face: the definition, and another way.
    #[test]
    fn corners_are_the_centroids_of_the_next_step() {
        for (valence, sides) in [(3, 4), (3, 6), (4, 3), (6, 4), (6, 3)] {
            let mut state = 7 * valence as i64 + sides as i64;
            let mut point = || {
                Point([(); 3].map(|()| {
                    state = (state * 1_103_515_245 + 12_345) % 2_147_483_648;
                    <Rational as Ring>::from_integer(state % 100)
                }))
            };
            let center = point();
            let edges: Vec<_> = (0..valence).map(|_| point()).collect();
            let mut net = QuarterNet::default();
            for k in 0..valence {
                let mut face = vec![center.clone(), edges[k].clone()];
                let inner = if k == 0 { sides - 3 } else { 1 };
                face.extend((0..inner).map(|_| point()));
                face.push(edges[(k + 1) % valence].clone());
                net.faces.push(face);
            }
            let facet = std::array::from_fn(|_| point());
            net.place(facet, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
            let mask = |n: usize| doo_sabin::corner_mask::<Rational>(n as u32);
            let rules = DooSabinRules {
                masks: (0..7)
                    .map(|n| (n >= 3).then(|| mask(n)).flatten())
                    .collect(),
            };
            let mut children = Nets(Vec::new());
            split::<Exact, _>(&rules, &net, &mut children);
            let corners = net.corner_differences::<Rational>(&rules);
            assert_eq!(children.0.len(), 4);
            for child in &children.0 {
                let at = net.corners.iter().position(|p| *p == child.corners[2]);
                let corner = at.expect("a corner of the quarter");
                assert_eq!(child.corner_difference::<Rational>(), corners[corner]);
            }
        }
    }
}
