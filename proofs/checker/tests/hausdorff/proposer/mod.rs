//! A small proposer of certificates in floats: it refines the whole mesh a few times and takes what it sees.
//! Nothing of it is shared with the checker.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use serde_json::{Value, json};

pub mod examples;
mod facets;
mod refine;

use facets::{Facet, cut, to_segment, to_triangle};
use refine::{Around, Level, around};

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
        let matched =
            |own: &Facet| net.iter().all(|p| own.corners.iter().all(|c| len(sub(*p, *c)) <= hi));
        if own.is_some_and(matched) {
            return Some(json!("match"));
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
