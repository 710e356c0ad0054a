//! A small proposer of certificates in floats: it refines the whole mesh a few times and takes what it sees.
//! Nothing of it is shared with the checker; where a formula can be written in another way, it is.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use serde_json::{Value, json};

pub type V = [f64; 3];

pub fn sub(a: V, b: V) -> V {
    [0, 1, 2].map(|i| a[i] - b[i])
}
pub fn add(a: V, b: V) -> V {
    [0, 1, 2].map(|i| a[i] + b[i])
}
pub fn mul(a: V, t: f64) -> V {
    a.map(|x| x * t)
}
pub fn dot(a: V, b: V) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}
pub fn len(a: V) -> f64 {
    dot(a, a).sqrt()
}
fn mean(all: impl IntoIterator<Item = V>) -> V {
    let all: Vec<V> = all.into_iter().collect();
    mul(all.iter().fold([0.0; 3], |s, x| add(s, *x)), 1.0 / all.len() as f64)
}

/// What is common to the certificates of an example.
#[derive(Clone, Debug)]
pub struct Example {
    pub scheme: &'static str,
    pub weights: Option<&'static str>,
    pub boundary: &'static str,
    pub points: Vec<V>,
    /// From 0.
    pub faces: Vec<Vec<usize>>,
    pub level: usize,
    pub against: &'static str,
    pub facets: &'static str,
    pub other: Option<(Vec<V>, Vec<Vec<usize>>)>,
    pub side: &'static str,
    /// How many times the proposer refines, from level K on.
    pub depth: usize,
    /// lo and hi are this much beside what is seen.
    pub slack: f64,
    pub vertex: Option<f64>,
    pub eigen: Option<(usize, usize, f64, f64)>,
}

#[derive(Clone)]
struct Level {
    points: Vec<V>,
    faces: Vec<Vec<usize>>,
}

/// The faces and neighbours round each vertex, in no order; boundary edges.
struct Around {
    faces: Vec<Vec<usize>>,
    near: Vec<BTreeSet<usize>>,
    rim: Vec<Vec<usize>>,
    sides: BTreeMap<[usize; 2], Vec<usize>>,
}

fn edge(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

fn around(mesh: &Level) -> Around {
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

    fn is_loop(&self) -> bool {
        self.scheme == "loop"
    }

    fn pinned(&self, at: &Around, a: usize) -> bool {
        self.boundary == "sharp" && at.faces[a].len() == 1
    }

    fn refined(&self, mesh: &Level) -> Level {
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
            for i in 0..m {
                faces.push(if self.is_loop() {
                    vec![face[i], e(i), e(i + m - 1)]
                } else {
                    vec![face[i], e(i), first + f, e(i + m - 1)]
                });
            }
            if self.is_loop() {
                faces.push(vec![e(0), e(1), e(2)]);
            }
        }
        Level { points, faces }
    }

    fn limits(&self, mesh: &Level) -> Vec<V> {
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

/// A facet: a triangle, or a bilinear patch, with its face.
#[derive(Clone, Debug)]
pub struct Facet {
    pub corners: Vec<V>,
    pub face: usize,
}

fn cut(points: &[V], faces: &[Vec<usize>], how: &str) -> Vec<Facet> {
    let mut all = Vec::new();
    for (face, list) in faces.iter().enumerate() {
        let at: Vec<V> = list.iter().map(|&i| points[i]).collect();
        let m = at.len();
        if m == 3 || (m == 4 && how == "bilinear") {
            all.push(Facet { corners: at, face });
        } else if how == "triangles" {
            for i in 1..m - 1 {
                all.push(Facet { corners: vec![at[0], at[i], at[i + 1]], face });
            }
        } else {
            let centre = mean(at.iter().copied());
            for i in 0..m {
                let corners = vec![
                    at[i],
                    mean([at[i], at[(i + 1) % m]]),
                    centre,
                    mean([at[i], at[(i + m - 1) % m]]),
                ];
                all.push(Facet { corners, face });
            }
        }
    }
    all
}

fn to_segment(p: V, a: V, b: V) -> f64 {
    let (d, e) = (sub(p, a), sub(b, a));
    let t = if dot(e, e) > 0.0 { (dot(d, e) / dot(e, e)).clamp(0.0, 1.0) } else { 0.0 };
    len(sub(d, mul(e, t)))
}

fn to_triangle(p: V, [a, b, c]: [V; 3]) -> f64 {
    let edges = to_segment(p, a, b).min(to_segment(p, b, c)).min(to_segment(p, c, a));
    let (x, y, d) = (sub(b, a), sub(c, a), sub(p, a));
    let (xx, xy, yy, dx, dy) = (dot(x, x), dot(x, y), dot(y, y), dot(d, x), dot(d, y));
    let area = xx * yy - xy * xy;
    let (v, w) = ((dx * yy - dy * xy) / area, (dy * xx - dx * xy) / area);
    if area > 0.0 && v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
        len(sub(d, add(mul(x, v), mul(y, w)))).min(edges)
    } else {
        edges
    }
}

impl Facet {
    fn at(&self, v: f64, w: f64) -> V {
        let c = &self.corners;
        if c.len() == 3 {
            return add(c[0], add(mul(sub(c[1], c[0]), v), mul(sub(c[2], c[0]), w)));
        }
        let [low, high] = [(c[0], c[1]), (c[3], c[2])].map(|(a, b)| add(a, mul(sub(b, a), v)));
        add(low, mul(sub(high, low), w))
    }

    /// A lower bound of the distance of a point.
    fn at_least(&self, p: V) -> f64 {
        let centre = mean(self.corners.iter().copied());
        let radius = self.corners.iter().map(|c| len(sub(*c, centre))).fold(0.0, f64::max);
        len(sub(p, centre)) - radius
    }

    /// The distance of a point; of a bilinear patch that of a net of triangles in it.
    fn distance(&self, p: V) -> f64 {
        if let [a, b, c] = self.corners[..] {
            return to_triangle(p, [a, b, c]);
        }
        let n = 5;
        let grid = |i: usize, j: usize| self.at(i as f64 / n as f64, j as f64 / n as f64);
        let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        cells.fold(f64::INFINITY, |least, (i, j)| {
            let (a, b, c, d) = (grid(i, j), grid(i + 1, j), grid(i + 1, j + 1), grid(i, j + 1));
            least.min(to_triangle(p, [a, b, c])).min(to_triangle(p, [a, c, d]))
        })
    }

    /// The parameters of a point near to the nearest, on finer and finer grids.
    fn nearest(&self, p: V) -> [f64; 2] {
        let mut best = [0.5; 2];
        for step in (1..=10).map(|i| 0.5_f64.powi(i)) {
            let around = (-2..=2).flat_map(|i| (-2..=2).map(move |j| [i, j]));
            let candidates = around.map(|d: [i32; 2]| {
                [0, 1].map(|k| (best[k] + f64::from(d[k]) * step).clamp(0.0, 1.0))
            });
            let far = |x: &[f64; 2]| len(sub(p, self.at(x[0], x[1])));
            best = candidates.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap();
        }
        best
    }

    fn child(&self, letter: usize) -> Self {
        let (c, m) = (&self.corners, self.corners.len());
        let middle = |i: usize| mean([c[i % m], c[(i + 1) % m]]);
        let corners = match (m, letter) {
            (3, 3) => vec![middle(0), middle(1), middle(2)],
            (3, _) => vec![c[letter], middle(letter), middle(letter + 2)],
            _ => vec![c[letter], middle(letter), mean(c.iter().copied()), middle(letter + 3)],
        };
        Self { corners, face: self.face }
    }
}

/// A number as a rational in lowest terms.
pub fn rational(x: f64) -> String {
    let (mut p, mut q) = ((x * (1u64 << 60) as f64).round() as i128, 1i128 << 60);
    while q > 1 && p % 2 == 0 {
        (p, q) = (p / 2, q / 2);
    }
    if q == 1 { p.to_string() } else { format!("{p}/{q}") }
}

fn point(p: &V) -> Value {
    json!(p.map(rational))
}

fn from_one(faces: &[Vec<usize>]) -> Value {
    json!(faces.iter().map(|f| f.iter().map(|i| i + 1).collect()).collect::<Vec<Vec<usize>>>())
}

/// What the proposer has seen.
pub struct Proposal {
    pub file: Value,
    pub distance: f64,
}

struct Seen<'a> {
    example: &'a Example,
    /// From level K on.
    levels: Vec<Level>,
    /// The faces of level K with a surface over them.
    inner: Vec<bool>,
    facets: Vec<Facet>,
    /// The corners of F over the faces of level K.
    own: Option<Vec<V>>,
    /// The vertices of the last level that the surface has: limit, face, word, corner.
    samples: Vec<(V, usize, String, usize)>,
}

impl Example {
    fn see(&self) -> Seen<'_> {
        let mut mesh = Level { points: self.points.clone(), faces: self.faces.clone() };
        for _ in 0..self.level {
            mesh = self.refined(&mesh);
        }
        let at = around(&mesh);
        let inner = |face: &Vec<usize>| {
            self.boundary != "none" || face.iter().all(|&a| at.rim[a].is_empty())
        };
        let inner = mesh.faces.iter().map(inner).collect();
        let own = match self.against {
            "control" => Some(mesh.points.clone()),
            "limit" => Some(self.limits(&mesh)),
            _ => None,
        };
        let facets = match &self.other {
            Some((points, faces)) => cut(points, faces, self.facets),
            None => cut(own.as_ref().unwrap(), &mesh.faces, self.facets),
        };
        let mut levels = vec![mesh];
        for i in 0..self.depth {
            levels.push(self.refined(&levels[i]));
        }
        let mut seen = Seen { example: self, levels, inner, facets, own, samples: vec![] };
        seen.sample();
        seen
    }

    /// A certificate.
    pub fn propose(&self) -> Proposal {
        let seen = self.see();
        let sides: Vec<&str> = match self.side {
            "both" => vec!["surface-to-mesh", "mesh-to-surface"],
            side => vec![side],
        };
        let far: Vec<(f64, Value, &str)> = sides
            .iter()
            .map(|side| {
                let (d, at) = if *side == "surface-to-mesh" {
                    seen.farthest()
                } else {
                    seen.farthest_of_mesh()
                };
                (d, at, *side)
            })
            .collect();
        let (distance, at, side) = far.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        let lo = distance * (1.0 - self.slack);
        let hi = distance * (1.0 + self.slack);
        let mut steps = vec![json!({"rule": "far", "side": side, "at": at})];
        if sides.contains(&"surface-to-mesh") {
            steps.push(json!({"rule": "near-mesh", "cells": seen.near_mesh(hi)}));
        }
        if sides.contains(&"mesh-to-surface") {
            steps.push(json!({"rule": "near-surface", "cells": seen.near_surface(hi)}));
        }
        if self.vertex.is_some() {
            steps.push(json!({"rule": "vertex"}));
        }
        let other = self.other.as_ref().map(|(points, faces)| {
            json!({"vertices": points.iter().map(point).collect::<Vec<_>>(), "faces": from_one(faces)})
        });
        let eigen = self.eigen.map(|(n, k, amplitude, within)| {
            json!({"valence": n, "frequency": k, "amplitude": rational(amplitude), "within": rational(within)})
        });
        let mut claim = json!({
            "scheme": self.scheme, "kind": "hausdorff", "boundary": self.boundary,
            "vertices": self.points.iter().map(point).collect::<Vec<_>>(),
            "faces": from_one(&self.faces), "level": self.level, "against": self.against,
            "facets": self.facets, "other": other, "side": self.side,
            "lo": rational(lo), "hi": rational(hi), "vertex": self.vertex.map(rational), "eigen": eigen,
        });
        if let Some(weights) = self.weights {
            claim["weights"] = json!(weights);
        }
        let file = json!({"format": "subcert", "version": 1, "claim": claim,
            "cosine": self.cosines(), "bases": [], "steps": steps});
        Proposal { file, distance }
    }

    fn cosines(&self) -> Value {
        let at = around(&Level { points: self.points.clone(), faces: self.faces.clone() });
        let mut needed = BTreeSet::new();
        if self.weights == Some("original") {
            let inner = (0..self.points.len()).filter(|&a| at.rim[a].is_empty());
            needed.extend(inner.map(|a| at.near[a].len()).filter(|n| ![3, 4, 6].contains(n)));
        }
        needed.extend(self.eigen.map(|(n, ..)| 4 * n));
        let unit = (1u64 << 50) as f64;
        let entry = |n: &usize| {
            let c = ((PI / *n as f64).cos() * unit).floor();
            json!([n, rational((c - 1.0) / unit), rational((c + 2.0) / unit)])
        };
        let list: Vec<Value> = needed.iter().map(entry).collect();
        if list.is_empty() { Value::Null } else { json!(list) }
    }
}

impl Seen<'_> {
    fn children(&self, level: usize, face: usize) -> std::ops::Range<usize> {
        let faces = &self.levels[level].faces;
        let count = |face: &Vec<usize>| if self.example.is_loop() { 4 } else { face.len() };
        // Only the first level has faces of different sizes.
        let first: usize = if faces.iter().all(|f| count(f) == 4) {
            4 * face
        } else {
            faces[..face].iter().map(count).sum()
        };
        first..first + count(&faces[face])
    }

    fn sample(&mut self) {
        // Coarser than the parts: a grid of samples need not be fine to meet the largest distance.
        let last = (self.levels.len() - 1).min(4);
        let limits = self.example.limits(&self.levels[last]);
        let mut taken = vec![false; limits.len()];
        let mut open: Vec<(usize, usize, usize, String)> = (0..self.levels[0].faces.len())
            .filter(|&f| self.inner[f])
            .map(|f| (0, f, f, String::new()))
            .collect();
        while let Some((level, root, face, word)) = open.pop() {
            if level < last {
                for (letter, child) in self.children(level, face).enumerate() {
                    open.push((level + 1, root, child, format!("{word}{letter}")));
                }
                continue;
            }
            for (corner, &a) in self.levels[last].faces[face].iter().enumerate() {
                if !std::mem::replace(&mut taken[a], true) {
                    self.samples.push((limits[a], root, word.clone(), corner));
                }
            }
        }
    }

    fn to_mesh(&self, p: V) -> f64 {
        self.facets.iter().fold(f64::INFINITY, |least, f| {
            if f.at_least(p) > least { least } else { least.min(f.distance(p)) }
        })
    }

    fn farthest(&self) -> (f64, Value) {
        let all = self.samples.iter().map(|s| (self.to_mesh(s.0), s));
        let (d, (_, face, word, corner)) = all.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        (d, json!({"face": face, "word": word, "corner": corner}))
    }

    fn counting(&self) -> impl Iterator<Item = (usize, &Facet)> {
        let counts = |f: &Facet| self.own.is_none() || self.inner[f.face];
        self.facets.iter().enumerate().filter(move |(_, f)| counts(f))
    }

    fn farthest_of_mesh(&self) -> (f64, Value) {
        let mut best = (-1.0, Value::Null);
        for (i, facet) in self.counting() {
            let n = 4;
            for (v, w) in (0..=n).flat_map(|v| (0..=n).map(move |w| (v, w))) {
                if facet.corners.len() == 3 && v + w > n {
                    continue;
                }
                let [v, w] = [v, w].map(|x| x as f64 / n as f64);
                let p = facet.at(v, w);
                let d = self.samples.iter().map(|s| len(sub(p, s.0))).fold(f64::INFINITY, f64::min);
                if d > best.0 {
                    best = (d, json!({"facet": i, "at": [rational(v), rational(w)]}));
                }
            }
        }
        best
    }

    fn near_mesh(&self, hi: f64) -> Vec<Value> {
        let at: Vec<Around> = self.levels.iter().map(around).collect();
        let mut cells = Vec::new();
        let mut open: Vec<(usize, usize, usize, String, Option<Facet>)> = Vec::new();
        for face in (0..self.levels[0].faces.len()).filter(|&f| self.inner[f]) {
            let own = self.own.as_ref().map(|own| Facet {
                corners: self.levels[0].faces[face].iter().map(|&i| own[i]).collect(),
                face,
            });
            let shared = self.example.facets == "bilinear" || self.levels[0].faces[face].len() == 3;
            open.push((0, face, face, String::new(), own.filter(|_| shared)));
        }
        while let Some((level, root, face, word, own)) = open.pop() {
            let mesh = &self.levels[level];
            let corners = &mesh.faces[face];
            let net: BTreeSet<usize> = corners
                .iter()
                .flat_map(|&a| &at[level].faces[a])
                .flat_map(|&f| mesh.faces[f].iter().copied())
                .collect();
            let net: Vec<V> = net.iter().map(|&i| mesh.points[i]).collect();
            if let Some(with) = self.near(&net, own.as_ref(), hi * (1.0 - 1e-9)) {
                cells.push(json!([root, word, with]));
                continue;
            }
            let least = |f: &Facet| net.iter().map(|p| f.distance(*p)).fold(0.0, f64::max);
            let least = || self.facets.iter().map(least).fold(f64::INFINITY, f64::min);
            let deepest = level + 1 == self.levels.len();
            assert!(!deepest, "part {word} of face {root}: {} is above {hi}", least());
            for (letter, child) in self.children(level, face).enumerate() {
                let own = own.as_ref().map(|own| {
                    if own.corners.len() == 3 && !self.example.is_loop() {
                        let c = &own.corners;
                        let [next, last] = [1, 2].map(|i| mean([c[letter], c[(letter + i) % 3]]));
                        let corners = vec![c[letter], next, mean(c.iter().copied()), last];
                        return Facet { corners, face: own.face };
                    }
                    if own.corners.len() > 4 {
                        let m = own.corners.len();
                        let c = &own.corners;
                        let [next, last] =
                            [1, m - 1].map(|i| mean([c[letter], c[(letter + i) % m]]));
                        let corners = vec![c[letter], next, mean(c.iter().copied()), last];
                        return Facet { corners, face: own.face };
                    }
                    own.child(letter)
                });
                open.push((level + 1, root, child, format!("{word}{letter}"), own));
            }
        }
        cells
    }

    /// What all points of a net are near to.
    fn near(&self, net: &[V], own: Option<&Facet>, hi: f64) -> Option<Value> {
        if let Some(own) = own {
            if net.iter().all(|p| own.corners.iter().all(|c| len(sub(*p, *c)) <= hi)) {
                return Some(json!("match"));
            }
        }
        let centre = mean(net.iter().copied());
        let mut order: Vec<(f64, usize)> =
            self.facets.iter().enumerate().map(|(i, f)| (f.at_least(centre), i)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        order.truncate(12);
        for (d, i) in &mut order {
            *d = self.facets[*i].distance(centre);
        }
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        for &(_, i) in order.iter().take(4) {
            let facet = &self.facets[i];
            if let [a, b, c] = facet.corners[..] {
                if net.iter().all(|p| to_triangle(*p, [a, b, c]) <= hi) {
                    return Some(json!(i));
                }
                continue;
            }
            let [v, w] = facet.nearest(centre);
            for (from, to) in [([v, 0.0], [v, 1.0]), ([0.0, w], [1.0, w])] {
                let (a, b) = (facet.at(from[0], from[1]), facet.at(to[0], to[1]));
                if net.iter().all(|p| to_segment(*p, a, b) <= hi) {
                    return Some(json!([i, from.map(rational), to.map(rational)]));
                }
            }
        }
        None
    }

    fn near_surface(&self, hi: f64) -> Vec<Value> {
        let mut cells = Vec::new();
        let mut open: Vec<(usize, String, Facet)> =
            self.counting().map(|(i, f)| (i, String::new(), f.clone())).collect();
        while let Some((root, path, facet)) = open.pop() {
            let centre = mean(facet.corners.iter().copied());
            let far = |p: V| facet.corners.iter().map(|c| len(sub(*c, p))).fold(0.0, f64::max);
            let near = self
                .samples
                .iter()
                .filter(|s| len(sub(s.0, centre)) <= hi)
                .min_by(|a, b| far(a.0).total_cmp(&far(b.0)));
            match near {
                Some((p, face, word, corner)) if far(*p) <= hi * (1.0 - 1e-9) => {
                    cells.push(json!([root, path, [face, word, corner]]));
                }
                _ => {
                    assert!(path.len() < 9, "part {path} of facet {root}: too coarse");
                    for letter in 0..4 {
                        open.push((root, format!("{path}{letter}"), facet.child(letter)));
                    }
                }
            }
        }
        cells
    }
}
