// A mesh of n sectors in floating point, refined by the rules of Loop's scheme from its triangles alone.

use std::collections::{HashMap, HashSet};

/// Sector, p >= 1, q >= 0; or the centre (0, 0, 0).
pub type Key = (usize, i64, i64);
pub type Point = [f64; 2];

pub struct Web {
    pub n: usize,
    pub beta: f64,
    pub radius: i64,
    pub points: HashMap<Key, Point>,
}

/// The one name of the point (p, q) of a sector, p, q >= 0.
pub fn key(n: usize, j: usize, p: i64, q: i64) -> Key {
    match (p, q) {
        (0, 0) => (0, 0, 0),
        (0, q) => ((j + 1) % n, q, 0),
        _ => (j % n, p, q),
    }
}

fn sum(terms: &[(f64, Point)]) -> Point {
    [0, 1].map(|i| terms.iter().map(|(c, x)| c * x[i]).sum())
}

impl Web {
    /// The triangles, each with its corners counterclockwise in the lattice of its sector.
    fn triangles(&self) -> Vec<(usize, [(i64, i64); 3])> {
        let mut list = Vec::new();
        for j in 0..self.n {
            for p in 0..self.radius {
                for q in 0..self.radius - p {
                    list.push((j, [(p, q), (p + 1, q), (p, q + 1)]));
                    if p + q + 2 <= self.radius {
                        list.push((j, [(p + 1, q + 1), (p, q + 1), (p + 1, q)]));
                    }
                }
            }
        }
        list
    }

    /// The third corner of the triangle on the left of each directed edge.
    fn left(&self) -> HashMap<(Key, Key), Key> {
        let mut left = HashMap::new();
        for (j, corners) in self.triangles() {
            let [a, b, c] = corners.map(|(p, q)| key(self.n, j, p, q));
            for (a, b, c) in [(a, b, c), (b, c, a), (c, a, b)] {
                assert!(left.insert((a, b), c).is_none());
            }
        }
        left
    }

    /// The neighbours of each vertex that has a closed fan.
    fn rings(left: &HashMap<(Key, Key), Key>) -> HashMap<Key, HashSet<Key>> {
        let mut rings: HashMap<Key, HashSet<Key>> = HashMap::new();
        for (a, b) in left.keys() {
            rings.entry(*a).or_default().insert(*b);
        }
        rings.retain(|a, ring| ring.iter().all(|b| left.contains_key(&(*b, *a))));
        rings
    }

    pub fn refined(&self) -> Self {
        let left = self.left();
        let mut points = HashMap::new();
        for (a, ring) in Self::rings(&left) {
            let beta = if a == (0, 0, 0) { self.beta } else { 3.0 / 8.0 };
            assert_eq!(ring.len(), if a == (0, 0, 0) { self.n } else { 6 });
            let share = beta / ring.len() as f64;
            let around: Vec<_> = ring.iter().map(|b| (share, self.points[b])).collect();
            let centre = (1.0 - beta, self.points[&a]);
            points.insert((a.0, 2 * a.1, 2 * a.2), sum(&[around, vec![centre]].concat()));
        }
        for (j, corners) in self.triangles() {
            for i in 0..3 {
                let [(p, q), (r, s)] = [corners[i], corners[(i + 1) % 3]];
                let [a, b] = [key(self.n, j, p, q), key(self.n, j, r, s)];
                if let (Some(c), Some(d)) = (left.get(&(a, b)), left.get(&(b, a))) {
                    let terms = [(0.375, a), (0.375, b), (0.125, *c), (0.125, *d)];
                    let terms = terms.map(|(x, k)| (x, self.points[&k]));
                    points.insert(key(self.n, j, p + r, q + s), sum(&terms));
                }
            }
        }
        Self { n: self.n, beta: self.beta, radius: 2 * self.radius - 1, points }
    }

    /// The limits of the vertices with closed fans.
    pub fn limits(&self) -> HashMap<Key, Point> {
        let rings = Self::rings(&self.left());
        let limit = |(a, ring): (Key, HashSet<Key>)| {
            let beta = if a == (0, 0, 0) { self.beta } else { 3.0 / 8.0 };
            let w = 8.0 * beta / (3.0 + 8.0 * beta);
            let share = w / ring.len() as f64;
            let around: Vec<_> = ring.iter().map(|b| (share, self.points[b])).collect();
            (a, sum(&[around, vec![(1.0 - w, self.points[&a])]].concat()))
        };
        rings.into_iter().map(limit).collect()
    }
}
