//! The masks and one step of each scheme (section 1). The order of the result is in the head of
//! the module.

use super::{Corner, Mesh, Number, Point, Scheme, Topology};

/// The sum of w X over the terms (w, X).
pub(super) fn combine<N: Number>(terms: &[(N, &Point<N>)]) -> Point<N> {
    std::array::from_fn(|d| {
        terms
            .iter()
            .fold(N::ratio(0, 1), |sum, (w, x)| sum + w.clone() * x[d].clone())
    })
}

/// The plain mean.
pub fn mean<'a, N: Number + 'a>(points: impl IntoIterator<Item = &'a Point<N>>) -> Point<N> {
    let points: Vec<_> = points.into_iter().collect();
    let w = N::ratio(1, points.len() as i64);
    combine(
        &points
            .into_iter()
            .map(|p| (w.clone(), p))
            .collect::<Vec<_>>(),
    )
}

/// |a - b|^2.
pub fn squared_distance<N: Number>(a: &Point<N>, b: &Point<N>) -> N {
    (0..3).fold(N::ratio(0, 1), |sum, d| {
        let x = a[d].clone() - b[d].clone();
        sum + x.clone() * x
    })
}

/// The weight b of each neighbour in Loop's vertex point.
pub fn loop_weight<N: Number>(scheme: Scheme, n: usize) -> N {
    assert!(n >= 3, "Loop refuses interior valence {n}");
    match scheme {
        Scheme::LoopWarren if n > 3 => N::ratio(3, 8 * n as i64),
        Scheme::LoopWarren => N::ratio(3, 16),
        _ => {
            let x = N::ratio(3, 8) + N::cosine(1, n) / N::ratio(4, 1);
            (N::ratio(5, 8) - x.clone() * x) / N::ratio(n as i64, 1)
        }
    }
}

impl<N: Number> Mesh<N> {
    /// From integer coordinates.
    pub fn from_integers(points: &[[i64; 3]], faces: &[Vec<usize>]) -> Mesh<N> {
        let points = points.iter().map(|p| p.map(|x| N::ratio(x, 1))).collect();
        Mesh {
            points,
            faces: faces.to_vec(),
        }
    }
    /// Positions of the corners of a face.
    pub fn face_points(&self, f: usize) -> Vec<Point<N>> {
        self.faces[f]
            .iter()
            .map(|&v| self.points[v].clone())
            .collect()
    }
    pub(super) fn topology(&self) -> Topology {
        Topology::new(self.points.len(), &self.faces).expect("an oriented manifold")
    }
    pub(super) fn centroid(&self, f: usize) -> Point<N> {
        mean(self.faces[f].iter().map(|&v| &self.points[v]))
    }
    /// Doo-Sabin's new corner: a_0 = (n+5)/(4n), a_j = (3 + 2 cos(2 pi j/n))/(4n).
    fn shrunk_corner(&self, (f, i): (usize, usize)) -> Point<N> {
        let n = self.faces[f].len();
        let terms: Vec<_> = (0..n)
            .map(|j| {
                let four_n_a = match j {
                    0 => N::ratio(n as i64 + 5, 1),
                    _ => N::ratio(3, 1) + N::ratio(2, 1) * N::cosine(j, n),
                };
                let x = &self.points[self.faces[f][(i + j) % n]];
                (four_n_a / N::ratio(4 * n as i64, 1), x)
            })
            .collect();
        combine(&terms)
    }
    /// a P + b (sum of edge neighbours) + c (sum of centroids of the faces at P).
    fn ring_mask(&self, t: &Topology, v: usize, a: N, b: N, c: N) -> Point<N> {
        // Loop has c = 0 and no use for centroids.
        let faces = t.corners[v].iter().filter(|_| c > N::ratio(0, 1));
        let centroids: Vec<_> = faces.map(|&(f, _)| self.centroid(f)).collect();
        let mut terms = vec![(a, &self.points[v])];
        terms.extend(
            t.neighbours[v]
                .iter()
                .map(|&w| (b.clone(), &self.points[w])),
        );
        terms.extend(centroids.iter().map(|x| (c.clone(), x)));
        combine(&terms)
    }
    /// Boundary vertex: (1 - 2 side) P + side (neighbours along the boundary), or P itself.
    fn boundary_mask(&self, t: &Topology, v: usize, corner: Corner, side: N) -> Point<N> {
        if t.corners[v].len() == 1 && corner == Corner::Sharp {
            return self.points[v].clone();
        }
        let [a, b] = t.boundary[v].unwrap().map(|w| &self.points[w]);
        let middle = N::ratio(1, 1) - side.clone() - side.clone();
        combine(&[(side.clone(), a), (middle, &self.points[v]), (side, b)])
    }
    /// The next level's point of an old vertex (Loop, Catmull-Clark).
    fn vertex_point(&self, t: &Topology, v: usize, scheme: Scheme, corner: Corner) -> Point<N> {
        if t.boundary[v].is_some() {
            return self.boundary_mask(t, v, corner, N::ratio(1, 8));
        }
        let n = t.corners[v].len() as i64;
        if n == 0 {
            self.points[v].clone()
        } else if scheme.is_loop() {
            let b: N = loop_weight(scheme, n as usize);
            let rest = N::ratio(1, 1) - N::ratio(n, 1) * b.clone();
            self.ring_mask(t, v, rest, b, N::ratio(0, 1))
        } else {
            let b = N::ratio(1, n * n);
            self.ring_mask(t, v, N::ratio(n - 2, n), b.clone(), b)
        }
    }
    /// The position on S of a vertex; for Doo-Sabin the mean of its new corners.
    fn limit_point(&self, t: &Topology, v: usize, scheme: Scheme, corner: Corner) -> Point<N> {
        let n = t.corners[v].len() as i64;
        if n == 0 {
            return self.points[v].clone();
        }
        if scheme == Scheme::DooSabin {
            return mean(
                &t.corners[v]
                    .iter()
                    .map(|&c| self.shrunk_corner(c))
                    .collect::<Vec<_>>(),
            );
        }
        if t.boundary[v].is_some() {
            return self.boundary_mask(t, v, corner, N::ratio(1, 6));
        }
        if scheme.is_loop() {
            let b: N = loop_weight(scheme, n as usize);
            let eight_b = N::ratio(8, 1) * b;
            let w = eight_b.clone() / (N::ratio(3, 1) + N::ratio(n, 1) * eight_b);
            let rest = N::ratio(1, 1) - N::ratio(n, 1) * w.clone();
            self.ring_mask(t, v, rest, w, N::ratio(0, 1))
        } else {
            let d = n * (n + 5);
            self.ring_mask(
                t,
                v,
                N::ratio(n * (n - 1), d),
                N::ratio(2, d),
                N::ratio(4, d),
            )
        }
    }
    /// The same faces with every vertex at its limit position.
    pub fn limit_mesh(&self, scheme: Scheme, corner: Corner) -> Mesh<N> {
        let t = self.topology();
        let points = (0..self.points.len()).map(|v| self.limit_point(&t, v, scheme, corner));
        Mesh {
            points: points.collect(),
            faces: self.faces.clone(),
        }
    }
    /// One step; the order of the result is in the head of this file.
    pub fn refine(&self, scheme: Scheme, corner: Corner) -> Mesh<N> {
        if scheme == Scheme::DooSabin {
            return self.shrink(&self.topology()).0;
        }
        let t = self.topology();
        let x = |v: usize| &self.points[v];
        let (vertices, edges) = (self.points.len(), t.edges.len());
        let mut points: Vec<_> = (0..vertices)
            .map(|v| self.vertex_point(&t, v, scheme, corner))
            .collect();
        for &(a, b) in &t.edges {
            let (Some(&p), Some(&q)) = (t.half_edges.get(&(a, b)), t.half_edges.get(&(b, a)))
            else {
                points.push(mean([x(a), x(b)]));
                continue;
            };
            points.push(if scheme.is_loop() {
                // Two places on from where the edge leaves: the opposite vertex of a triangle.
                let [c, d] = [p, q].map(|(f, i)| x(self.faces[f][(i + 2) % 3]));
                let [far, near] = [N::ratio(1, 8), N::ratio(3, 8)];
                combine(&[
                    (near.clone(), x(a)),
                    (near, x(b)),
                    (far.clone(), c),
                    (far, d),
                ])
            } else {
                mean([x(a), x(b), &self.centroid(p.0), &self.centroid(q.0)])
            });
        }
        if !scheme.is_loop() {
            points.extend((0..self.faces.len()).map(|f| self.centroid(f)));
        }
        let mut faces = vec![];
        for (f, face) in self.faces.iter().enumerate() {
            let n = face.len();
            assert!(
                n == 3 || !scheme.is_loop(),
                "Loop refuses face {f} with {n} sides"
            );
            let e = |i: usize| vertices + t.edge(face[i % n], face[(i + 1) % n]);
            for i in 0..n {
                faces.push(match scheme.is_loop() {
                    true => vec![face[i], e(i), e(i + 2)],
                    false => vec![face[i], e(i), vertices + edges + f, e(i + n - 1)],
                });
            }
            if scheme.is_loop() {
                faces.push(vec![e(0), e(1), e(2)]);
            }
        }
        Mesh { points, faces }
    }
    /// Doo-Sabin's step, with the numbers of the first vertex of each face.
    pub(super) fn shrink(&self, t: &Topology) -> (Mesh<N>, Vec<usize>) {
        let (mut points, mut faces, mut first) = (vec![], vec![], vec![]);
        for (f, face) in self.faces.iter().enumerate() {
            first.push(points.len());
            faces.push((points.len()..points.len() + face.len()).collect());
            points.extend((0..face.len()).map(|i| self.shrunk_corner((f, i))));
        }
        let id = |(f, i): (usize, usize)| first[f] + i % self.faces[f].len();
        for &(a, b) in &t.edges {
            // Face f keeps the direction a_f b_f, so the quad has b_f a_f; likewise a_g b_g.
            if let Some(&(g, j)) = t.half_edges.get(&(b, a)) {
                let (f, i) = t.half_edges[&(a, b)];
                faces.push(vec![id((f, i + 1)), id((f, i)), id((g, j + 1)), id((g, j))]);
            }
        }
        for v in (0..self.points.len()).filter(|&v| t.is_interior(v)) {
            assert!(
                t.corners[v].len() > 2,
                "Doo-Sabin refuses interior valence 2"
            );
            faces.push(t.corners[v].iter().map(|&c| id(c)).collect());
        }
        (Mesh { points, faces }, first)
    }
}
