//! Refinement and limits in floats; where a formula can be written in another way than the checker's, it is.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use super::{Example, V, add, mean, mul};

#[derive(Clone)]
pub struct Level {
    pub points: Vec<V>,
    pub faces: Vec<Vec<usize>>,
}

/// The faces and neighbours round each vertex, in no order; boundary edges.
pub struct Around {
    pub faces: Vec<Vec<usize>>,
    pub near: Vec<BTreeSet<usize>>,
    pub rim: Vec<Vec<usize>>,
    sides: BTreeMap<[usize; 2], Vec<usize>>,
}

fn edge(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

pub fn around(mesh: &Level) -> Around {
    let count = mesh.points.len();
    let mut all = Around {
        faces: vec![vec![]; count],
        near: vec![BTreeSet::new(); count],
        rim: vec![vec![]; count],
        sides: BTreeMap::new(),
    };
    for (f, face) in mesh.faces.iter().enumerate() {
        for (i, &a) in face.iter().enumerate() {
            let b = face[(i + 1) % face.len()];
            all.faces[a].push(f);
            all.near[a].insert(b);
            all.near[b].insert(a);
            all.sides.entry(edge(a, b)).or_default().push(f);
        }
    }
    for (&[a, b], faces) in &all.sides {
        if faces.len() == 1 {
            all.rim[a].push(b);
            all.rim[b].push(a);
        }
    }
    all
}

impl Example {
    fn beta(&self, n: usize) -> f64 {
        let c = (2.0 * PI / n as f64).cos();
        match self.weights {
            Some("warren") if n == 3 => 9.0 / 16.0,
            Some("warren") => 3.0 / 8.0,
            _ => 5.0 / 8.0 - (3.0 / 8.0 + c / 4.0) * (3.0 / 8.0 + c / 4.0),
        }
    }

    pub fn is_loop(&self) -> bool {
        self.scheme == "loop"
    }

    fn pinned(&self, at: &Around, a: usize) -> bool {
        self.boundary == "sharp" && at.faces[a].len() == 1
    }

    pub fn refined(&self, mesh: &Level) -> Level {
        let (at, p) = (around(mesh), &mesh.points);
        let face_points: Vec<V> =
            mesh.faces.iter().map(|f| mean(f.iter().map(|&i| p[i]))).collect();
        let mut points = Vec::new();
        for a in 0..p.len() {
            let n = at.near[a].len();
            points.push(if let [b, c] = at.rim[a][..] {
                if self.pinned(&at, a) {
                    p[a]
                } else {
                    add(mul(p[a], 0.75), mul(add(p[b], p[c]), 0.125))
                }
            } else if self.is_loop() {
                let beta = self.beta(n);
                let ring = mean(at.near[a].iter().map(|&b| p[b]));
                add(mul(p[a], 1.0 - beta), mul(ring, beta))
            } else {
                // (F + 2 R + (n - 3) P)/n with the means F of face points and R of edge middles.
                let faces = mean(at.faces[a].iter().map(|&f| face_points[f]));
                let edges = mean(at.near[a].iter().map(|&b| mul(add(p[a], p[b]), 0.5)));
                let n = n as f64;
                mul(add(add(faces, mul(edges, 2.0)), mul(p[a], n - 3.0)), 1.0 / n)
            });
        }
        let mut edges = BTreeMap::new();
        for (&[a, b], faces) in &at.sides {
            let middle = mul(add(p[a], p[b]), 0.5);
            edges.insert([a, b], points.len());
            points.push(if faces.len() == 1 {
                middle
            } else if self.is_loop() {
                let opposite = faces.iter().flat_map(|&f| &mesh.faces[f]);
                let opposite = opposite.filter(|&&c| c != a && c != b).map(|&c| p[c]);
                add(mul(middle, 0.75), mul(mean(opposite), 0.25))
            } else {
                mul(add(middle, mean(faces.iter().map(|&f| face_points[f]))), 0.5)
            });
        }
        let first = points.len();
        points.extend(&face_points);
        let mut faces = Vec::new();
        for (f, face) in mesh.faces.iter().enumerate() {
            let m = face.len();
            let e = |i: usize| edges[&edge(face[i % m], face[(i + 1) % m])];
            for (i, &corner) in face.iter().enumerate() {
                faces.push(if self.is_loop() {
                    vec![corner, e(i), e(i + m - 1)]
                } else {
                    vec![corner, e(i), first + f, e(i + m - 1)]
                });
            }
            if self.is_loop() {
                faces.push(vec![e(0), e(1), e(2)]);
            }
        }
        Level { points, faces }
    }

    pub fn limits(&self, mesh: &Level) -> Vec<V> {
        let (at, p) = (around(mesh), &mesh.points);
        let limit = |a: usize| {
            let n = at.near[a].len() as f64;
            if let [b, c] = at.rim[a][..] {
                if self.pinned(&at, a) {
                    return p[a];
                }
                return mul(add(mul(p[a], 4.0), add(p[b], p[c])), 1.0 / 6.0);
            }
            if self.is_loop() {
                // The ring's part is 1/(1 + 3/(8 beta)).
                let w = 1.0 / (1.0 + 3.0 / (8.0 * self.beta(at.near[a].len())));
                return add(mul(p[a], 1.0 - w), mul(mean(at.near[a].iter().map(|&b| p[b])), w));
            }
            let faces =
                mean(at.faces[a].iter().map(|&f| mean(mesh.faces[f].iter().map(|&i| p[i]))));
            let ring = mean(at.near[a].iter().map(|&b| p[b]));
            mul(add(add(mul(p[a], n - 1.0), mul(ring, 2.0)), mul(faces, 4.0)), 1.0 / (n + 5.0))
        };
        (0..p.len()).map(limit).collect()
    }
}
