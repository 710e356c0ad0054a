//! Writes the sample meshes of `examples/meshes`, or of the folder given. They are made here, free
//! of anyone's rights (CC0-1.0); a test compares the files with what this program makes.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write;

type Point = [f64; 3];

/// A mesh in the making: points, and faces counterclockwise from outside, counted from 0.
#[derive(Default)]
struct Draft {
    points: Vec<Point>,
    faces: Vec<Vec<usize>>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/meshes");
    let folder = std::env::args()
        .nth(1)
        .unwrap_or_else(|| default.to_string());
    for (name, text) in meshes() {
        std::fs::write(format!("{folder}/{name}.obj"), text)?;
    }
    Ok(())
}

/// Name and OBJ text of each sample mesh.
pub fn meshes() -> Vec<(&'static str, String)> {
    let saddle = lattice(true, |i, j| i * i - j * j);
    let paraboloid = lattice(false, |i, j| (i * i + j * j) / 2.0);
    vec![
        (
            "loop_saddle_grid",
            saddle.obj("regular triangle lattice, z = x^2 - y^2"),
        ),
        (
            "paraboloid_grid",
            paraboloid.obj("square lattice, z = (x^2 + y^2) / 2"),
        ),
        (
            "valences_3_to_12",
            valences().obj("closed triangle mesh, one vertex of each valence 3 to 12 at least"),
        ),
        (
            "block_with_handle",
            block().obj("closed quad mesh of genus 1, valences 3 to 6"),
        ),
        (
            "mixed_patch",
            mixed().obj("open mesh of triangles, quads, a pentagon and a hexagon"),
        ),
        (
            "bumpy_torus_tri",
            torus(40, 25, true).obj("torus with bumps, all valences 6"),
        ),
        (
            "bumpy_torus_quads",
            torus(32, 24, false).obj("torus with bumps, all valences 4"),
        ),
    ]
}

impl Draft {
    fn obj(&self, title: &str) -> String {
        let mut text = format!("# {title}\n# made by examples/author_meshes.rs; CC0-1.0\n");
        for p in &self.points {
            // Six decimals: the last digits of sines differ between machines. No "-0".
            let [x, y, z] = p.map(|x| (x * 1e6).round() / 1e6 + 0.0);
            writeln!(text, "v {x} {y} {z}").expect("text");
        }
        for face in &self.faces {
            let corners: Vec<String> = face.iter().map(|v| (v + 1).to_string()).collect();
            writeln!(text, "f {}", corners.join(" ")).expect("text");
        }
        text
    }

    fn valence(&self, v: usize) -> usize {
        self.faces.iter().filter(|face| face.contains(&v)).count()
    }

    /// Splits face `f`, a triangle, at its centre.
    fn star(&mut self, f: usize) {
        let [a, b, c] = self.faces[f][..] else {
            unreachable!("a triangle")
        };
        let centre = self.points.len();
        let [p, q, r] = [a, b, c].map(|v| self.points[v]);
        self.points
            .push([0, 1, 2].map(|i| (p[i] + q[i] + r[i]) / 3.0));
        self.faces[f] = vec![a, b, centre];
        self.faces.extend([vec![b, c, centre], vec![c, a, centre]]);
    }
}

/// The vertices (i, j, height) for i, j from -4 to 4. Triangles have the neighbours (1, 0), (0, 1)
/// and (1, 1).
fn lattice(triangles: bool, height: impl Fn(f64, f64) -> f64) -> Draft {
    let mut draft = Draft::default();
    for j in -4..=4 {
        for i in -4..=4 {
            let (x, y) = (f64::from(i), f64::from(j));
            draft.points.push([x, y, height(x, y)]);
        }
    }
    for j in 0..8 {
        for i in 0..8 {
            draft.cell(|i, j| i + 9 * j, (i, j), triangles);
        }
    }
    draft
}

impl Draft {
    /// The lattice cell with lower left corner (i, j): one quad or two triangles.
    fn cell(&mut self, v: impl Fn(usize, usize) -> usize, (i, j): (usize, usize), triangles: bool) {
        let (a, b, c, d) = (v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1));
        if triangles {
            self.faces.extend([vec![a, b, c], vec![a, c, d]]);
        } else {
            self.faces.push(vec![a, b, c, d]);
        }
    }
}

fn torus(m: usize, n: usize, triangles: bool) -> Draft {
    let mut draft = Draft::default();
    for j in 0..n {
        for i in 0..m {
            let (u, v) = (TAU * i as f64 / m as f64, TAU * j as f64 / n as f64);
            let tube = 0.7 + 0.12 * (5.0 * u).sin() * (3.0 * v).cos();
            let radius = 2.0 + tube * v.cos();
            draft
                .points
                .push([radius * u.cos(), radius * u.sin(), tube * v.sin()]);
        }
    }
    for j in 0..n {
        for i in 0..m {
            draft.cell(|i, j| i % m + m * (j % n), (i, j), triangles);
        }
    }
    draft
}

/// An octahedron split twice, with stars put round some vertices of valence 6 to raise it.
fn valences() -> Draft {
    let mut draft = Draft {
        points: vec![
            [1., 0., 0.],
            [-1., 0., 0.],
            [0., 1., 0.],
            [0., -1., 0.],
            [0., 0., 1.],
            [0., 0., -1.],
        ],
        faces: [
            [0, 2, 4],
            [2, 1, 4],
            [1, 3, 4],
            [3, 0, 4],
            [2, 0, 5],
            [1, 2, 5],
            [3, 1, 5],
            [0, 3, 5],
        ]
        .map(Vec::from)
        .into(),
    };
    for _ in 0..2 {
        let mut midpoints = BTreeMap::new();
        for face in std::mem::take(&mut draft.faces) {
            let middle = [0, 1, 2].map(|i| {
                let (a, b) = (face[i], face[(i + 1) % 3]);
                *midpoints.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    let (p, q) = (draft.points[a], draft.points[b]);
                    draft.points.push([0, 1, 2].map(|i| (p[i] + q[i]) / 2.0));
                    draft.points.len() - 1
                })
            });
            for i in 0..3 {
                draft
                    .faces
                    .push(vec![face[i], middle[i], middle[(i + 2) % 3]]);
            }
            draft.faces.push(middle.into());
        }
    }
    // One corner of an octahedron goes from 4 to 5, and six others from 6 to 7 .. 12; the faces of
    // a vertex once raised are left alone.
    let mut raised = Vec::new();
    for (from, to) in [(6, 12), (6, 11), (6, 10), (6, 9), (4, 5), (6, 8), (6, 7)] {
        let alone = |draft: &Draft, v: usize| {
            let mut faces = draft.faces.iter().filter(|face| face.contains(&v));
            draft.valence(v) == from && !faces.any(|face| raised.iter().any(|r| face.contains(r)))
        };
        let v = (0..draft.points.len())
            .find(|&v| alone(&draft, v))
            .expect("a vertex to raise");
        let faces: Vec<usize> = (0..draft.faces.len())
            .filter(|&f| draft.faces[f].contains(&v))
            .collect();
        for &f in &faces[..to - from] {
            draft.star(f);
        }
        raised.push(v);
    }
    for p in &mut draft.points {
        let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        let radius = 1.0 + 0.2 * p[0] * p[1] / (length * length);
        *p = p.map(|x| x * radius / length);
    }
    draft
}

/// The surface of eight cubes round a hole with one more on top.
fn block() -> Draft {
    let solid = |cell: [i32; 3]| match cell {
        [1, 1, 0] => false,
        [0..=2, 0..=2, 0] | [0, 0, 1] => true,
        _ => false,
    };
    let mut draft = Draft::default();
    let mut numbers = BTreeMap::new();
    for k in 0..18 {
        let cell = [k % 3, k / 3 % 3, k / 9];
        for (axis, side) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1)] {
            let mut outside = cell;
            outside[axis] += 2 * side - 1;
            if !solid(cell) || solid(outside) {
                continue;
            }
            let mut quad = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(s, t)| {
                let mut corner = cell;
                corner[axis] += side;
                corner[(axis + 1) % 3] += s;
                corner[(axis + 2) % 3] += t;
                *numbers.entry(corner).or_insert_with(|| {
                    draft.points.push(corner.map(f64::from));
                    draft.points.len() - 1
                })
            });
            if side == 0 {
                quad.reverse();
            }
            draft.faces.push(quad.into());
        }
    }
    draft
}

/// A hexagon with a quad on each side, triangles between them, and a pentagon on the first quad.
fn mixed() -> Draft {
    let mut draft = Draft::default();
    let at = |turn: f64, radius: f64, height: f64| {
        let angle = TAU * turn / 12.0;
        [radius * angle.cos(), radius * angle.sin(), height]
    };
    draft
        .points
        .extend((0..6).map(|i| at(2.0 * f64::from(i), 1.0, 0.5)));
    // Outer corners of the quad on side i: over corner i, and over corner i + 1.
    for i in 0..6 {
        let turn = 2.0 * f64::from(i);
        draft
            .points
            .extend([at(turn + 0.5, 1.9, 0.0), at(turn + 1.5, 1.9, 0.0)]);
    }
    draft.faces.push((0..6).collect());
    for i in 0..6 {
        let next = (i + 1) % 6;
        draft.faces.push(vec![i, 6 + 2 * i, 7 + 2 * i, next]);
        draft.faces.push(vec![next, 7 + 2 * i, 6 + 2 * next]);
    }
    let tip = draft.points.len();
    draft
        .points
        .extend([at(0.4, 2.8, -0.6), at(1.0, 3.2, -0.8), at(1.6, 2.8, -0.6)]);
    draft.faces.push(vec![6, tip, tip + 1, tip + 2, 7]);
    draft
}
