//! S and F over the same parameters (section 4), densely. The parameters are described in the head
//! of the module.

use super::{Against, Corner, Mesh, Number, Point, Scheme, combine, mean, squared_distance};
use std::collections::BTreeMap;

/// One parameter with both points over it.
#[derive(Clone, Debug)]
pub struct Sample<N> {
    /// Face of the level-K mesh.
    pub face: usize,
    /// Quarter of the face (its corner); 0 for Loop.
    pub corner: usize,
    /// The parameter times 2^L, see the head of this file.
    pub at: [i64; 3],
    /// The limit surface, exactly.
    pub s: Point<N>,
    /// The mesh.
    pub f: Point<N>,
}

/// What is compared with what, how finely.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// The rule.
    pub scheme: Scheme,
    /// Corner rule (Doo-Sabin: `Smooth`, it has none).
    pub corner: Corner,
    /// K: F is the mesh of this level.
    pub level: usize,
    /// F: control points or limit points.
    pub against: Against,
    /// L >= 1: samples are vertices of level K + L.
    pub depth: usize,
}

/// The level-K mesh F, whose corner positions identify `Sample::face`.
pub fn level_mesh<N: Number>(mesh: &Mesh<N>, q: Question) -> Mesh<N> {
    let fine = (0..q.level).fold(mesh.clone(), |m, _| m.refine(q.scheme, q.corner));
    match q.against {
        Against::Control => fine,
        Against::Limit => fine.limit_mesh(q.scheme, q.corner),
    }
}

/// A piece of a level-K face: (face, quarter, parameters of the corners of the piece).
type Cell = (usize, usize, Vec<[i64; 3]>);

fn halfway(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    std::array::from_fn(|d| {
        assert!((a[d] + b[d]) % 2 == 0);
        (a[d] + b[d]) / 2
    })
}

/// All samples, in order of (face, corner, parameter), each parameter once per face or quarter.
pub fn samples<N: Number>(mesh: &Mesh<N>, q: Question) -> Vec<Sample<N>> {
    assert!(q.depth >= 1);
    let control = level_mesh(
        mesh,
        Question {
            against: Against::Control,
            ..q
        },
    );
    let surface = match q.scheme {
        Scheme::DooSabin => surface_over_quarters(&control, q),
        _ => surface_over_faces(&control, q),
    };
    let f = level_mesh(mesh, q);
    let w = |a: i64| N::ratio(a, 1 << q.depth);
    let f_at = |face: usize, i: usize, at: [i64; 3]| {
        let p = f.face_points(face);
        let n = p.len();
        if q.scheme.is_loop() {
            return combine(&[(w(at[0]), &p[0]), (w(at[1]), &p[1]), (w(at[2]), &p[2])]);
        }
        let (next, last) = (
            mean([&p[i], &p[(i + 1) % n]]),
            mean([&p[i], &p[(i + n - 1) % n]]),
        );
        let [a, b] = [w(at[0]), w(at[1])];
        let [a1, b1] = [&a, &b].map(|x| N::ratio(1, 1) - x.clone());
        combine(&[
            (a1.clone() * b1.clone(), &p[i]),
            (a.clone() * b1, &next),
            (a * b.clone(), &mean(&p)),
            (a1 * b, &last),
        ])
    };
    let pairs = surface.into_iter();
    pairs
        .map(|((face, corner, at), s)| Sample {
            face,
            corner,
            at,
            s,
            f: f_at(face, corner, at),
        })
        .collect()
}

type Surface<N> = BTreeMap<(usize, usize, [i64; 3]), Point<N>>;

/// Loop and Catmull-Clark: S at the vertices of level K + L.
fn surface_over_faces<N: Number>(control: &Mesh<N>, q: Question) -> Surface<N> {
    let one = 1 << q.depth;
    let (mut fine, mut cells) = (control.clone(), Vec::<Cell>::new());
    for (f, face) in control.faces.iter().enumerate() {
        if q.scheme.is_loop() {
            cells.push((f, 0, vec![[one, 0, 0], [0, one, 0], [0, 0, one]]));
        } else {
            let square = vec![[0, 0, 0], [one, 0, 0], [one, one, 0], [0, one, 0]];
            cells.extend((0..face.len()).map(|i| (f, i, square.clone())));
        }
    }
    for step in 0..q.depth {
        fine = fine.refine(q.scheme, q.corner);
        if step == 0 && !q.scheme.is_loop() {
            continue; // the quarters themselves are the faces of level K + 1
        }
        let mut children = vec![];
        for (f, i, u) in cells {
            let n = u.len();
            let e = |k: usize| halfway(u[k % n], u[(k + 1) % n]);
            for k in 0..n {
                children.push((
                    f,
                    i,
                    match n {
                        3 => vec![u[k], e(k), e(k + 2)],
                        _ => vec![u[k], e(k), halfway(e(0), e(2)), e(k + 3)],
                    },
                ));
            }
            if n == 3 {
                children.push((f, i, vec![e(0), e(1), e(2)]));
            }
        }
        cells = children;
    }
    assert_eq!(cells.len(), fine.faces.len());
    let limit = fine.limit_mesh(q.scheme, q.corner);
    let mut surface = Surface::new();
    for ((f, i, u), face) in cells.iter().zip(&limit.faces) {
        for (&at, &v) in u.iter().zip(face) {
            surface.insert((*f, *i, at), limit.points[v].clone());
        }
    }
    surface
}

/// Doo-Sabin: S at the centroids of level K + L. A cell is a quarter (g, j) of the current mesh
/// with the parameters of its vertex, next edge middle, centroid, previous edge middle.
fn surface_over_quarters<N: Number>(control: &Mesh<N>, q: Question) -> Surface<N> {
    assert!(q.corner == Corner::Smooth, "Doo-Sabin has no corner rule");
    let one = 1 << q.depth;
    let (mut fine, mut t) = (control.clone(), control.topology());
    let mut quarters: Vec<((usize, usize), Cell)> = vec![];
    for (v, corners) in t
        .corners
        .iter()
        .enumerate()
        .filter(|&(v, _)| t.is_interior(v))
    {
        assert!(corners.iter().all(|&(f, i)| fine.faces[f][i] == v));
        let square = vec![[0, 0, 0], [one, 0, 0], [one, one, 0], [0, one, 0]];
        quarters.extend(
            corners
                .iter()
                .map(|&(f, i)| ((f, i), (f, i, square.clone()))),
        );
    }
    for _ in 0..q.depth {
        let (next_mesh, first) = fine.shrink(&t);
        let next_t = next_mesh.topology();
        let mut children = vec![];
        for ((f, i), (root, quarter, u)) in quarters {
            let (face, n) = (&fine.faces[f], fine.faces[f].len());
            let (v, next, last) = (face[i], face[(i + 1) % n], face[(i + n - 1) % n]);
            let id = |(f, i): (usize, usize)| first[f] + i;
            // v's corner in the face beyond v v_next, which has that edge directed towards v, and
            // in the one beyond v_last v, directed away from v.
            let (g, j) = t.half_edges[&(next, v)];
            let across_next = id((g, (j + 1) % fine.faces[g].len()));
            let across_last = id(t.half_edges[&(v, last)]);
            let (in_next, in_last) = (id((f, (i + 1) % n)), id((f, (i + n - 1) % n)));
            // v_f is joined to four vertices; where each edge's middle lies in the quarter.
            let middle = |w: usize| match w {
                _ if w == across_next => halfway(u[0], u[1]),
                _ if w == across_last => halfway(u[0], u[3]),
                _ if w == in_next => halfway(u[1], u[2]),
                _ if w == in_last => halfway(u[3], u[2]),
                _ => panic!("not joined to v_f"),
            };
            let corners = &next_t.corners[id((f, i))];
            assert!(corners.len() == 4 && next_t.is_interior(id((f, i))));
            for &(g, j) in corners {
                let m = next_mesh.faces[g].len();
                let after = next_mesh.faces[g][(j + 1) % m];
                let before = next_mesh.faces[g][(j + m - 1) % m];
                // The centroid of g is the corner of the quarter between the two edges.
                let is =
                    |x: usize, y: usize| (after, before) == (x, y) || (after, before) == (y, x);
                let centroid = match () {
                    _ if is(across_next, across_last) => u[0],
                    _ if is(across_next, in_next) => u[1],
                    _ if is(in_next, in_last) => u[2],
                    _ if is(across_last, in_last) => u[3],
                    _ => panic!("not a face at v_f"),
                };
                let cell = vec![halfway(u[0], u[2]), middle(after), centroid, middle(before)];
                children.push(((g, j), (root, quarter, cell)));
            }
        }
        (fine, t, quarters) = (next_mesh, next_t, children);
    }
    let of = |(g, (f, i, u)): ((usize, usize), Cell)| ((f, i, u[2]), fine.centroid(g.0));
    quarters.into_iter().map(of).collect()
}

/// The largest squared distance of the samples: overall, and per face of the level-K mesh with
/// the sample that has it (`None`: no surface over that face).
pub fn max_distance<N: Number>(mesh: &Mesh<N>, q: Question) -> (N, Vec<Option<(N, Sample<N>)>>) {
    let mut per_face = vec![None; level_mesh(mesh, q).faces.len()];
    let mut largest = N::ratio(0, 1);
    for sample in samples(mesh, q) {
        let d = squared_distance(&sample.s, &sample.f);
        if d > largest {
            largest = d.clone();
        }
        let best: &mut Option<(N, Sample<N>)> = &mut per_face[sample.face];
        if best.as_ref().is_none_or(|(b, _)| d > *b) {
            *best = Some((d, sample));
        }
    }
    (largest, per_face)
}
