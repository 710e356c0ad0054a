//! A part of a face with the faces that touch it: what a proof names by a face and a word of letters.
//!
//! A net is a small mesh. One step of refinement gives the nets of the children: all masks of the
//! points that touch a child are complete, because every edge and face at a corner of the part is in
//! its net. So the same step serves any valences, several extraordinary vertices, boundaries and
//! polygons, and needs no numbering. It is slower than [`crate::patch`], which measures; proofs are
//! written for small meshes.
//!
//! Letter `i` of a face with m corners is the child at its corner i; for triangles, letter 3 is the
//! inner child (`proofs/FORMAT.md`, section 10).

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use num_traits::Zero;

use crate::bernstein::from_net;
use crate::mesh::{Mesh, Point};
use crate::scalar::{Field, Interval};
use crate::scheme::{CornerRule, Scheme, StarMask, boundary, catmull_clark, loop_scheme};

type P = Point<Interval>;

/// The rules of a scheme in intervals.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    pub(super) scheme: Scheme,
    corner: CornerRule,
    /// Vertex and limit masks of Loop by valence.
    masks: HashMap<usize, (StarMask<Interval>, StarMask<Interval>)>,
}

/// Which point of a vertex is wanted.
#[derive(Clone, Copy)]
enum Target {
    Refined,
    Limit,
}

/// The points round a corner of a part.
struct Star<'a> {
    /// Ends of its edges, those with two faces first.
    neighbours: Vec<u32>,
    /// Neighbours across edges with one face.
    boundary: Vec<u32>,
    /// Its faces.
    faces: Vec<&'a [u32]>,
}

/// A part of a face of S.
#[derive(Clone, Debug)]
pub(super) struct Net {
    points: Vec<P>,
    /// The part is the first.
    faces: Vec<Vec<u32>>,
}

impl Rules {
    /// The rules; `None` if a weight is missing, which intervals never are.
    pub(super) fn new(scheme: Scheme, corner: CornerRule, mesh: &Mesh<Interval>) -> Option<Self> {
        let mut masks = HashMap::new();
        if let Scheme::Loop(weights) = scheme {
            let valences = (0..mesh.topology.vertex_count()).map(|v| mesh.topology.valence(v));
            for n in valences.chain([6]).filter(|n| *n >= 3) {
                let mask = || {
                    Some((
                        loop_scheme::vertex_mask(weights, n)?,
                        loop_scheme::limit_mask(weights, n)?,
                    ))
                };
                if let Entry::Vacant(place) = masks.entry(n as usize) {
                    place.insert(mask()?);
                }
            }
        }
        Some(Rules {
            scheme,
            corner,
            masks,
        })
    }

    fn is_loop(&self) -> bool {
        matches!(self.scheme, Scheme::Loop(_))
    }
}

fn sum<'a>(points: impl Iterator<Item = &'a P>) -> P {
    points.fold(P::zero(), |sum, p| sum + p)
}

fn centroid(points: &[P], face: &[u32]) -> P {
    let corners = face.iter().map(|v| &points[*v as usize]);
    sum(corners) * &Interval::ratio(1, face.len() as i64)
}

impl Net {
    /// The whole face of a mesh.
    pub(super) fn of_face(mesh: &Mesh<Interval>, face: u32) -> Self {
        let topology = &mesh.topology;
        let touching = |other: &u32| {
            let corners = topology.corners(face);
            topology.corners(*other).iter().any(|v| corners.contains(v))
        };
        let others = (0..topology.face_count()).filter(|other| *other != face && touching(other));
        let faces = [face].into_iter().chain(others);
        let faces: Vec<Vec<u32>> = faces.map(|f| topology.corners(f).to_vec()).collect();
        Self::renumbered(&mesh.positions, faces)
    }

    /// With the points that occur only.
    fn renumbered(points: &[P], mut faces: Vec<Vec<u32>>) -> Self {
        let mut new = HashMap::new();
        let mut kept = Vec::new();
        for v in faces.iter_mut().flatten() {
            *v = *new.entry(*v).or_insert_with(|| {
                kept.push(points[*v as usize]);
                kept.len() as u32 - 1
            });
        }
        Net {
            points: kept,
            faces,
        }
    }

    /// The number of corners of the part.
    pub(super) fn size(&self) -> usize {
        self.faces[0].len()
    }

    /// The control points at its corners.
    pub(super) fn corners(&self) -> Vec<P> {
        self.faces[0]
            .iter()
            .map(|v| self.points[*v as usize])
            .collect()
    }

    fn star(&self, vertex: u32) -> Star<'_> {
        let faces: Vec<&[u32]> = self
            .faces
            .iter()
            .filter(|f| f.contains(&vertex))
            .map(Vec::as_slice)
            .collect();
        let mut neighbours: Vec<u32> = Vec::new();
        let mut boundary: Vec<u32> = Vec::new();
        for face in &faces {
            let (m, at) = (face.len(), place(face, vertex));
            for w in [face[(at + 1) % m], face[(at + m - 1) % m]] {
                if let Some(seen) = boundary.iter().position(|v| *v == w) {
                    boundary.swap_remove(seen);
                } else {
                    boundary.push(w);
                    neighbours.push(w);
                }
            }
        }
        Star {
            neighbours,
            boundary,
            faces,
        }
    }

    fn at(&self, vertex: u32) -> &P {
        &self.points[vertex as usize]
    }

    /// The vertex point of the next level, or the limit.
    fn vertex_point(&self, rules: &Rules, vertex: u32, target: Target) -> P {
        let (p, star) = (self.at(vertex), self.star(vertex));
        if let [a, b] = star.boundary[..] {
            if star.faces.len() == 1 && rules.corner == CornerRule::Sharp {
                return *p;
            }
            let (a, b) = (self.at(a), self.at(b));
            return match target {
                Target::Refined => boundary::vertex_point(p, a, b),
                Target::Limit => boundary::limit_point(p, a, b),
            };
        }
        let n = star.neighbours.len();
        let ring = sum(star.neighbours.iter().map(|w| self.at(*w)));
        if rules.is_loop() {
            let (refined, limit) = &rules.masks[&n];
            return match target {
                Target::Refined => refined.apply_ring(p, &ring),
                Target::Limit => limit.apply_ring(p, &ring),
            };
        }
        let mask = match target {
            Target::Refined => catmull_clark::vertex_mask(n as u32),
            Target::Limit => catmull_clark::limit_mask_polygons(n as u32),
        };
        let faces = star.faces.iter().map(|f| centroid(&self.points, f));
        mask.apply(p, &ring, &faces.fold(P::zero(), |sum, f| sum + f))
    }

    /// The point of the surface at a corner of the part.
    pub(super) fn limit(&self, rules: &Rules, corner: usize) -> P {
        self.vertex_point(rules, self.faces[0][corner], Target::Limit)
    }

    fn edge_point(&self, rules: &Rules, a: u32, b: u32) -> P {
        let beside: Vec<&Vec<u32>> = self
            .faces
            .iter()
            .filter(|f| {
                (0..f.len()).any(|i| {
                    let (x, y) = (f[i], f[(i + 1) % f.len()]);
                    (x, y) == (a, b) || (x, y) == (b, a)
                })
            })
            .collect();
        let (p, q) = (self.at(a), self.at(b));
        match beside[..] {
            [f, g] if rules.is_loop() => {
                let opposite = |f: &[u32]| {
                    f.iter()
                        .find(|v| **v != a && **v != b)
                        .copied()
                        .unwrap_or(a)
                };
                loop_scheme::edge_point(p, q, self.at(opposite(f)), self.at(opposite(g)))
            }
            [f, g] => {
                let (f, g) = (centroid(&self.points, f), centroid(&self.points, g));
                catmull_clark::edge_point(p, q, &f, &g)
            }
            _ => boundary::edge_point(p, q),
        }
    }

    /// The nets of the children, in the order of letters.
    pub(super) fn children(&self, rules: &Rules) -> Vec<Net> {
        let part = self.faces[0].clone();
        let mut points: Vec<P> = Vec::new();
        let mut add = |p: P| {
            points.push(p);
            points.len() as u32 - 1
        };
        let vertex: HashMap<u32, u32> = part
            .iter()
            .map(|v| (*v, add(self.vertex_point(rules, *v, Target::Refined))))
            .collect();
        let mut edge: HashMap<(u32, u32), u32> = HashMap::new();
        for face in &self.faces {
            for (i, a) in face.iter().enumerate() {
                let b = face[(i + 1) % face.len()];
                let key = (*a.min(&b), *a.max(&b));
                if (part.contains(a) || part.contains(&b)) && !edge.contains_key(&key) {
                    edge.insert(key, add(self.edge_point(rules, key.0, key.1)));
                }
            }
        }
        let on = |a: u32, b: u32| edge.get(&(a.min(b), a.max(b))).copied();
        // The children of all faces whose points have complete masks; those of the part first.
        let mut faces: Vec<Vec<u32>> = Vec::new();
        for face in &self.faces {
            let m = face.len();
            let middle = (!rules.is_loop()).then(|| add(centroid(&self.points, face)));
            for (i, v) in face.iter().enumerate() {
                let (next, prev) = (on(*v, face[(i + 1) % m]), on(face[(i + m - 1) % m], *v));
                if let (Some(v), Some(next), Some(prev)) = (vertex.get(v), next, prev) {
                    faces.push(
                        [Some(*v), Some(next), middle, Some(prev)]
                            .into_iter()
                            .flatten()
                            .collect(),
                    );
                }
            }
            if rules.is_loop()
                && let (Some(a), Some(b), Some(c)) = (
                    on(face[0], face[1]),
                    on(face[1], face[2]),
                    on(face[2], face[0]),
                )
            {
                faces.push(vec![a, b, c]);
            }
        }
        let count = if rules.is_loop() { 4 } else { part.len() };
        let child = |letter: usize| {
            let own = faces[letter].clone();
            let touching = |f: &&Vec<u32>| **f != own && f.iter().any(|v| own.contains(v));
            let others = faces.iter().filter(touching).cloned();
            Net::renumbered(&points, [own.clone()].into_iter().chain(others).collect())
        };
        (0..count).map(child).collect()
    }

    /// The corner opposite to the directed edge in its face, if the faces are triangles.
    fn across(&self, from: u32, to: u32) -> Option<u32> {
        let face = self
            .faces
            .iter()
            .find(|f| (0..3).any(|i| f[i] == from && f[(i + 1) % 3] == to))?;
        face.iter().find(|v| **v != from && **v != to).copied()
    }

    /// In the face of quads with the directed edge: the corner before `from`, and that after `to`.
    fn beside(&self, from: u32, to: u32) -> Option<[u32; 2]> {
        let face = self
            .faces
            .iter()
            .find(|f| (0..4).any(|i| f[i] == from && f[(i + 1) % 4] == to))?;
        let at = place(face, from);
        Some([face[(at + 3) % 4], face[(at + 2) % 4]])
    }

    /// The Bernstein coefficients of S, if the part is regular.
    pub(super) fn patch(&self, rules: &Rules) -> Option<Vec<P>> {
        let valence = if rules.is_loop() { 6 } else { 4 };
        let regular = |v: &u32| {
            let star = self.star(*v);
            star.boundary.is_empty() && star.neighbours.len() == valence
        };
        if !self.faces[0].iter().all(regular) || !self.faces.iter().all(|f| f.len() == self.size())
        {
            return None;
        }
        let points = |labels: &[u32]| labels.iter().map(|v| *self.at(*v)).collect::<Vec<P>>();
        if rules.is_loop() {
            let [p4, p7, p8] = self.faces[0][..] else {
                return None;
            };
            let [p3, p5, p11] = [
                self.across(p7, p4)?,
                self.across(p4, p8)?,
                self.across(p8, p7)?,
            ];
            let [p1, p2] = [self.across(p3, p4)?, self.across(p4, p5)?];
            let [p6, p10] = [self.across(p7, p3)?, self.across(p11, p7)?];
            let [p12, p9] = [self.across(p8, p11)?, self.across(p5, p8)?];
            let net = points(&[p1, p2, p3, p4, p5, p6, p7, p8, p9, p10, p11, p12]);
            return Some(
                from_net::box_spline::<Interval, P>(&net.try_into().ok()?)
                    .0
                    .to_vec(),
            );
        }
        let [a, b, c, d] = self.faces[0][..] else {
            return None;
        };
        // Round the square from below: the two points beyond each edge, then those beyond the corners.
        let [a_down, b_down] = self.beside(b, a).map(|[y, x]| [x, y])?;
        let [b_right, c_right] = self.beside(c, b).map(|[y, x]| [x, y])?;
        let [c_up, d_up] = self.beside(d, c).map(|[y, x]| [x, y])?;
        let [d_left, a_left] = self.beside(a, d).map(|[y, x]| [x, y])?;
        // The face beyond a corner has the directed edge from the point below (right of, ..) it.
        let far = |corner: u32, one: u32, other: u32| {
            let face = self
                .faces
                .iter()
                .find(|f| [corner, one, other].iter().all(|v| f.contains(v)))?;
            face.iter()
                .find(|v| ![corner, one, other].contains(v))
                .copied()
        };
        let net = points(&[
            far(a, a_down, a_left)?,
            a_down,
            b_down,
            far(b, b_down, b_right)?,
            a_left,
            a,
            b,
            b_right,
            d_left,
            d,
            c,
            c_right,
            far(d, d_left, d_up)?,
            d_up,
            c_up,
            far(c, c_up, c_right)?,
        ]);
        Some(
            from_net::bicubic::<Interval, P>(&net.try_into().ok()?)
                .0
                .to_vec(),
        )
    }

    /// Points whose convex hull contains S over the part.
    pub(super) fn hull(&self, rules: &Rules) -> Vec<P> {
        self.patch(rules).unwrap_or_else(|| self.points.clone())
    }
}

fn place(face: &[u32], vertex: u32) -> usize {
    face.iter().position(|v| *v == vertex).unwrap_or(0)
}

/// The middle of two points.
pub(super) fn middle(a: &P, b: &P) -> P {
    (*a + b) * &Interval::ratio(1, 2)
}

/// The parts of a triangle or a bilinear quad given by its corners, in the order of letters.
pub(super) fn quarters(corners: &[P]) -> Vec<Vec<P>> {
    let m = corners.len();
    let mids: Vec<P> = (0..m)
        .map(|i| middle(&corners[i], &corners[(i + 1) % m]))
        .collect();
    let inner = if m == 3 {
        mids.clone()
    } else {
        vec![sum(corners.iter()) * &Interval::ratio(1, m as i64)]
    };
    let at_corner = |i: usize| match m {
        3 => vec![corners[i], mids[i], mids[(i + 2) % 3]],
        _ => vec![corners[i], mids[i], inner[0], mids[(i + m - 1) % m]],
    };
    let all = (0..m).map(at_corner);
    if m == 3 {
        all.chain([inner.clone()]).collect()
    } else {
        all.collect()
    }
}
