//! Facets and distances in floats.

use super::{V, add, dot, len, mean, mul, sub};

/// A facet: a triangle, or a bilinear patch, with its face.
#[derive(Clone, Debug)]
pub struct Facet {
    pub corners: Vec<V>,
    pub face: usize,
}

pub fn cut(points: &[V], faces: &[Vec<usize>], how: &str) -> Vec<Facet> {
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

pub fn to_segment(p: V, a: V, b: V) -> f64 {
    let (d, e) = (sub(p, a), sub(b, a));
    let t = if dot(e, e) > 0.0 { (dot(d, e) / dot(e, e)).clamp(0.0, 1.0) } else { 0.0 };
    len(sub(d, mul(e, t)))
}

pub fn to_triangle(p: V, [a, b, c]: [V; 3]) -> f64 {
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
    pub fn at(&self, v: f64, w: f64) -> V {
        let c = &self.corners;
        if c.len() == 3 {
            return add(c[0], add(mul(sub(c[1], c[0]), v), mul(sub(c[2], c[0]), w)));
        }
        let [low, high] = [(c[0], c[1]), (c[3], c[2])].map(|(a, b)| add(a, mul(sub(b, a), v)));
        add(low, mul(sub(high, low), w))
    }

    /// A lower bound of the distance of a point.
    pub fn at_least(&self, p: V) -> f64 {
        let centre = mean(self.corners.iter().copied());
        let radius = self.corners.iter().map(|c| len(sub(*c, centre))).fold(0.0, f64::max);
        len(sub(p, centre)) - radius
    }

    /// The distance of a point; of a bilinear patch that of a net of triangles in it.
    pub fn distance(&self, p: V) -> f64 {
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
    pub fn nearest(&self, p: V) -> [f64; 2] {
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

    pub fn child(&self, letter: usize) -> Self {
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
