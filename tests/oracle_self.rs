//! The referee refereed, first part: values known in closed form.

mod oracle;

use Scheme::*;
use num_rational::BigRational;
use oracle::nets::{self, Random};
use oracle::*;
use std::collections::BTreeSet;

type Q = BigRational;

const SEED: u64 = 20_240_917;

fn q(p: i64, d: i64) -> Q {
    Q::ratio(p, d)
}

fn ask(scheme: Scheme, level: usize, against: Against, depth: usize) -> Question {
    Question {
        scheme,
        corner: Corner::Smooth,
        level,
        against,
        depth,
    }
}

/// An open a x a grid with position (i, j, z(i, j)), moved so that the middle is the origin.
fn graph(a: usize, quads: bool, z: impl Fn(i64, i64) -> Q) -> Mesh<Q> {
    let faces = nets::grid(a, a, quads, false);
    let (side, half) = (a as i64 + 1, a as i64 / 2);
    let place = (0..side * side).map(|k| (k / side - half, k % side - half));
    let points = place.map(|(i, j)| [q(i, 1), q(j, 1), z(i, j)]).collect();
    Mesh { points, faces }
}

/// Largest squared distance over the level-K faces inside [-1, 1]^2, with the points there.
fn inner(mesh: &Mesh<Q>, question: Question) -> (Q, Vec<Sample<Q>>) {
    let level = level_mesh(mesh, question);
    let near = |p: &Point<Q>| (0..2).all(|d| p[d] >= q(-1, 1) && p[d] <= q(1, 1));
    let all = samples(mesh, question).into_iter();
    let keep: Vec<_> = all
        .filter(|s| level.face_points(s.face).iter().all(near))
        .collect();
    assert!(!keep.is_empty());
    let top = keep
        .iter()
        .map(|s| squared_distance(&s.s, &s.f))
        .max()
        .unwrap();
    let at = keep
        .into_iter()
        .filter(|s| squared_distance(&s.s, &s.f) == top)
        .collect();
    (top, at)
}

/// Loop, f = i^2 - j^2 over neighbours (1,0), (0,1), (1,1). The limit mask adds w times the sum of
/// second differences 2 - 2 + 0 = 0, so S = x^2 - y^2, a quadratic (reproduced up to constants).
/// On (0,0), (1,0), (1,1) the mesh is x - y and S - F = (x - y)(x + y - 1); with a = x - y and
/// b = x + y - 1 the triangle is 0 <= a <= 1 - |b|, so |ab| <= 1/4, only at (1/2, 0).
/// Each level halves the lattice and keeps the form: 4^-K / 4.
#[test]
fn loop_saddle_is_a_quarter_at_edge_middles() {
    let mesh = graph(4, false, |i, j| q(i * i - j * j, 1));
    for (scheme, level) in [(LoopOriginal, 0), (LoopWarren, 0), (LoopWarren, 1)] {
        for against in [Against::Control, Against::Limit] {
            let (top, at) = inner(&mesh, ask(scheme, level, against, 3));
            assert_eq!(top, q(1, 16 * 16i64.pow(level as u32)));
            assert!(at.iter().all(|s| {
                let mut b = s.at;
                b.sort_unstable();
                b == [0, 4, 4]
            }));
        }
    }
}

/// Bicubic, z = (i^2 + j^2)/2: sum of i^2/2 N3(x - i) = x^2/2 + 1/6 (limit mask 1/6, 4/6, 1/6), so
/// S = (x^2 + y^2)/2 + 1/3 and S - F = 1/3 - x(1-x)/2 - y(1-y)/2 on [0,1]^2: 1/3 at the vertices.
/// Against the limit mesh F rises by 1/3: 1/4, at the centroids. Each level divides by 4.
#[test]
fn bicubic_paraboloid_is_a_third_at_vertices() {
    let mesh = graph(4, true, |i, j| q(i * i + j * j, 2));
    for level in [0, 1] {
        let scale = 16i64.pow(level as u32);
        let (top, at) = inner(&mesh, ask(CatmullClark, level, Against::Control, 3));
        assert_eq!(top, q(1, 9 * scale));
        assert!(at.iter().all(|s| s.at == [0, 0, 0]));
        let (top, at) = inner(&mesh, ask(CatmullClark, level, Against::Limit, 3));
        assert_eq!(top, q(1, 16 * scale));
        assert!(at.iter().all(|s| s.at == [8, 8, 0]));
    }
}

/// Biquadratic, z = (i^2 + j^2)/2. With points at their Greville places the quadratic B-spline has
/// variance 3/12: sum of i^2/2 N2(x - i) = x^2/2 + 1/8, so S = (x^2 + y^2)/2 + 1/4 and
/// S - F = 1/4 - x(1-x)/2 - y(1-y)/2 on [0,1]^2: 1/4 at the vertices, 0 at the centroids. (By hand:
/// v_f at 0 is 3/16 (1/2 + 1/2) + 1/16 = 1/4 in each of the four faces.) Against the limit mesh,
/// raised by 1/4: 1/4 at the centroids. Each level divides by 4 (step h adds h^2/4).
#[test]
fn biquadratic_paraboloid_is_a_quarter_at_vertices() {
    let mesh = graph(4, true, |i, j| q(i * i + j * j, 2));
    for level in [0, 1] {
        for (against, place) in [(Against::Control, [0, 0, 0]), (Against::Limit, [8, 8, 0])] {
            let (top, at) = inner(&mesh, ask(DooSabin, level, against, 3));
            assert_eq!(top, q(1, 16 * 16i64.pow(level as u32)));
            assert!(at.iter().all(|s| s.at == place));
        }
    }
}

/// Regular nets that are affine in (i, j): S = F inside. (Across an extraordinary vertex nothing
/// is "affine": only the partition of unity is left, tested by `equivariant`.)
#[test]
fn affine_nets_have_distance_zero() {
    for scheme in Scheme::ALL {
        let mesh = graph(4, matches!(scheme, CatmullClark | DooSabin), |i, j| {
            q(2 * i - 3 * j + 5, 1)
        });
        for (level, against) in [
            (0, Against::Control),
            (1, Against::Control),
            (1, Against::Limit),
        ] {
            assert_eq!(inner(&mesh, ask(scheme, level, against, 2)).0, q(0, 1));
        }
    }
}

/// Branched covers (section 2): affine nets wound twice round the centre (Loop n = 12,
/// Catmull-Clark n = 8) and z = (-1)^sector i j for even n have S = F up to the rim. Doo-Sabin
/// keeps the second (frequency n/2 has eigenvalue 1/4 = 1/2 * 1/2), and not the first.
#[test]
fn branched_covers_have_distance_zero() {
    let hexagon = [[1, 0], [1, 1], [0, 1], [-1, 0], [-1, -1], [0, -1]];
    let square = [[1, 0], [0, 1], [-1, 0], [0, -1]];
    let wound = |spokes: &[[i64; 2]], (s, i, j): nets::Place| {
        let at = |s: usize, d: usize| spokes[s % spokes.len()][d];
        [0, 1, 0].map(|d| i as i64 * at(s, d) + j as i64 * at(s + 1, d))
    };
    let saddle = |(s, i, j): nets::Place| [0, 0, [1, -1][s % 2] * (i * j) as i64];
    for (scheme, n, cover, zero) in [
        (LoopWarren, 12, 1, true),
        (CatmullClark, 8, 2, true),
        (CatmullClark, 6, 3, true),
        (CatmullClark, 2, 3, true),
        (DooSabin, 6, 3, true),
        (LoopWarren, 9, 1, false),
        (CatmullClark, 6, 2, false),
    ] {
        let quads = !matches!(scheme, LoopWarren);
        let (faces, places) = nets::round_vertex(n, 3, quads);
        let points = places.iter().map(|&p| match cover {
            1 => wound(&hexagon, p),
            2 => wound(&square, p),
            _ => saddle(p),
        });
        let mesh = Mesh::<Q>::from_integers(&points.collect::<Vec<_>>(), &faces);
        let t = Topology::new(mesh.points.len(), &faces).unwrap();
        let keep = |f: usize| faces[f].iter().all(|&v| t.is_interior(v));
        for against in [Against::Control, Against::Limit] {
            let all = samples(&mesh, ask(scheme, 0, against, 3));
            let mut inside = all.iter().filter(|s| keep(s.face));
            assert_eq!(inside.all(|s| s.s == s.f), zero, "{scheme:?} {n}");
        }
    }
}

/// Distances at given parameters of small solids.
///
/// Cube (+-1)^3, Catmull-Clark: at (1,1,1) sum e = (1,1,1), sum f' = (1,1,1), so the limit is
/// (6 + 2 + 4)/24 = 1/2 in each coordinate. Level 1: vertex 1/3 + 1/9 + 1/9 = 5/9, edge (3/4,3/4,0),
/// face (1,0,0). Face centre: (16 + 4 * 3 + 4 * 5/9)/36 = 68/81.
/// Doo-Sabin: v_f on x = 1 is (1, 1/2, 1/2) since 9/16 + 3/16 - 3/16 - 1/16 = 1/2; the three have mean
/// 2/3. Edge middle: mean of (1,1/2,.) and (1/2,1,.) is (3/4,3/4,0). Face centre: (1,0,0).
/// Octahedron (sum of ring 0): limit (1 - 4w) P; warren b = 3/32, w = 1/8: P/2;
/// original 4b = 5/8 - 9/64 = 31/64, w = (31/32)/(3 + 31/8) = 31/220: 24/55 P.
/// Tetrahedron with sum 0: b = 3/16, w = 1/5: 2/5 P - 1/5 P = P/5.
#[test]
fn solids_by_hand() {
    let cube: Vec<[i64; 3]> = [-1, 1]
        .iter()
        .flat_map(|&z| [[-1, -1, z], [1, -1, z], [1, 1, z], [-1, 1, z]])
        .collect();
    let cube = Mesh::<Q>::from_integers(&cube, &nets::prism(4));
    let value = |mesh: &Mesh<Q>, scheme, at: [i64; 3]| {
        let all = samples(mesh, ask(scheme, 0, Against::Control, 1));
        let found: BTreeSet<Q> = all
            .iter()
            .filter(|s| s.at == at)
            .map(|s| squared_distance(&s.s, &s.f))
            .collect();
        assert_eq!(found.len(), 1, "a solid is the same everywhere");
        found.first().unwrap().clone()
    };
    assert_eq!(value(&cube, CatmullClark, [0, 0, 0]), q(3, 4));
    assert_eq!(value(&cube, CatmullClark, [2, 2, 0]), q(13 * 13, 81 * 81));
    assert_eq!(value(&cube, DooSabin, [0, 0, 0]), q(1, 3));
    assert_eq!(value(&cube, DooSabin, [2, 0, 0]), q(1, 8));
    assert_eq!(value(&cube, DooSabin, [2, 2, 0]), q(0, 1));
    assert_eq!(
        max_distance(&cube, ask(CatmullClark, 0, Against::Control, 3)).0,
        q(3, 4)
    );
    let octahedron = [
        [1, 0, 0],
        [0, 1, 0],
        [-1, 0, 0],
        [0, -1, 0],
        [0, 0, 1],
        [0, 0, -1],
    ];
    let octahedron = Mesh::<Q>::from_integers(&octahedron, &nets::bipyramid(4));
    assert_eq!(value(&octahedron, LoopWarren, [2, 0, 0]), q(1, 4));
    assert_eq!(
        value(&octahedron, LoopOriginal, [0, 2, 0]),
        q(31 * 31, 55 * 55)
    );
    let tetrahedron = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    let tetrahedron = Mesh::<Q>::from_integers(&tetrahedron, &nets::tetrahedron());
    for scheme in [LoopOriginal, LoopWarren] {
        assert_eq!(value(&tetrahedron, scheme, [0, 0, 2]), q(16 * 3, 25));
    }
}

/// Boundaries: a lone n-gon's boundary is the closed cubic B-spline of its corners, whatever the
/// surface scheme; with sharp corners each vertex stays. Values of the B-spline: (1, 4, 1)/6 at a
/// knot, (1, 23, 23, 1)/48 halfway; sharp ends: with v pinned the curve's own end conditions say
/// level 1 is (a, (a+b)/2, b), so halfway it is a/6 + 4/6 (a+b)/2 + b/6 = (a+b)/2.
#[test]
fn boundaries_of_lone_polygons() {
    for n in 3..=6i64 {
        let net = nets::with_points(
            "".into(),
            vec![(0..n as usize).collect()],
            50,
            &mut Random(SEED + n as u64),
        );
        let mesh = Mesh::<Q>::from_integers(&net.points, &net.faces);
        let p = |i: i64, d: usize| mesh.points[i.rem_euclid(n) as usize][d].clone();
        for (scheme, corner) in [
            (LoopWarren, Corner::Smooth),
            (LoopOriginal, Corner::Sharp),
            (CatmullClark, Corner::Smooth),
            (CatmullClark, Corner::Sharp),
        ] {
            if n > 3 && scheme != CatmullClark {
                continue;
            }
            for s in samples(
                &mesh,
                Question {
                    corner,
                    ..ask(scheme, 0, Against::Control, 1)
                },
            ) {
                for d in 0..3 {
                    // The boundary place in half edges from vertex 0.
                    let half = match (scheme, s.at) {
                        (CatmullClark, [0, 0, _]) => 2 * s.corner as i64,
                        (CatmullClark, [2, 0, _]) => 2 * s.corner as i64 + 1,
                        (CatmullClark, [0, 2, _]) => 2 * s.corner as i64 - 1,
                        (CatmullClark, _) => continue,
                        (_, [1, 1, 0]) => 1,
                        (_, [0, 1, 1]) => 3,
                        (_, [1, 0, 1]) => 5,
                        (_, at) => 2 * at.iter().position(|&x| x == 2).unwrap() as i64,
                    };
                    let i = half.div_euclid(2);
                    let sum = |w: [i64; 4], e: i64| {
                        (0..4).fold(q(0, 1), |t, k| t + q(w[k], e) * p(i - 1 + k as i64, d))
                    };
                    let expect = match (corner, half.rem_euclid(2)) {
                        (Corner::Smooth, 0) => sum([1, 4, 1, 0], 6),
                        (Corner::Smooth, _) => sum([1, 23, 23, 1], 48),
                        (Corner::Sharp, 0) => p(i, d),
                        (Corner::Sharp, _) => sum([0, 1, 1, 0], 2),
                    };
                    assert_eq!(s.s[d], expect);
                }
            }
        }
    }
}

/// Sharp pins vertices with one face and no others: the middle of a fan of two stays smooth.
#[test]
fn sharp_pins_one_face_corners_only() {
    for (scheme, quads) in [(LoopWarren, false), (CatmullClark, true)] {
        let net = nets::with_points("".into(), nets::fan(2, quads), 50, &mut Random(SEED));
        let mesh = Mesh::<Q>::from_integers(&net.points, &net.faces);
        let limit = mesh.limit_mesh(scheme, Corner::Sharp).points;
        let [p, first, last] = [0, 1, if quads { 5 } else { 3 }].map(|v: usize| &mesh.points[v]);
        assert!((0..3).all(|d| limit[0][d] == (&first[d] + q(4, 1) * &p[d] + &last[d]) / q(6, 1)));
        let corner = if quads { 2 } else { 1 };
        assert_eq!(limit[corner], mesh.points[corner]);
    }
}

/// Masks in Q(sqrt 5): cos 72 = (sqrt 5 - 1)/4 gives Loop's b = (13 - sqrt 5)/128 at n = 5; a regular
/// pentagon shrinks to a_0 + 2 a_1 cos 72 + 2 a_2 cos 144 = 1/4 + 1/4 = 1/2 under Doo-Sabin.
#[test]
fn valence_five_by_hand() {
    assert!((loop_weight::<f64>(LoopOriginal, 5) - (13.0 - 5f64.sqrt()) / 128.0).abs() < 1e-15);
    let at = |k: usize| {
        [
            f64::cosine(k % 5, 5),
            f64::cosine(4 * (k % 5) + 15, 20),
            (k / 5) as f64,
        ]
    };
    let mesh = Mesh {
        points: (0..10).map(at).collect(),
        faces: nets::prism(5),
    };
    let cap = mesh.refine(DooSabin, Corner::Smooth).face_points(6);
    assert!((0..5).all(|k| (0..2).all(|d| (cap[k][d] - at(k)[d] / 2.0).abs() < 1e-15)));
}

/// Random regular nets against the closed formulas of the splines.
#[test]
fn regular_patches_by_their_basis() {
    let pow = |x: &Q, k: i32| num_traits::pow(x.clone(), k as usize);
    let c = |k: i64| q(k, 1);
    // Cubic on [0,1] with points -1, 0, 1, 2; quadratic on [-1/2,1/2] with points -1, 0, 1.
    let cubic = |x: &Q| {
        let y = c(1) - x;
        let inner = |x: &Q| (c(4) - c(6) * pow(x, 2) + c(3) * pow(x, 3)) / c(6);
        vec![pow(&y, 3) / c(6), inner(x), inner(&y), pow(x, 3) / c(6)]
    };
    let quadratic = |x: &Q| {
        vec![
            pow(&(q(1, 2) - x), 2) / c(2),
            q(3, 4) - pow(x, 2),
            pow(&(q(1, 2) + x), 2) / c(2),
        ]
    };
    let tensor = |mesh: &Mesh<Q>, (a, b): (Vec<Q>, Vec<Q>)| -> Point<Q> {
        std::array::from_fn(|d| {
            (0..mesh.points.len()).fold(c(0), |t, k| {
                t + a[k / b.len()].clone() * b[k % b.len()].clone() * mesh.points[k][d].clone()
            })
        })
    };
    let net = |side, quads, seed| {
        let net = nets::with_points(
            "".into(),
            nets::grid(side, side, quads, false),
            50,
            &mut Random(seed),
        );
        Mesh::<Q>::from_integers(&net.points, &net.faces)
    };
    let mesh = net(3, true, SEED);
    for s in samples(&mesh, ask(CatmullClark, 0, Against::Control, 3))
        .iter()
        .filter(|s| s.face == 4)
    {
        // Corners in order (0,0), (1,0), (1,1), (0,1); quarter i is turned by i right angles.
        let [a, b] = [q(s.at[0], 16), q(s.at[1], 16)];
        let [e, g] = [c(1) - &a, c(1) - &b];
        let (x, y) = [
            (a.clone(), b.clone()),
            (g.clone(), a),
            (e.clone(), g),
            (b, e),
        ][s.corner]
            .clone();
        assert_eq!(s.s, tensor(&mesh, (cubic(&x), cubic(&y))));
    }
    let mesh = net(2, true, SEED + 1);
    let all = samples(&mesh, ask(DooSabin, 0, Against::Control, 3));
    assert!(all.iter().all(|s| mesh.faces[s.face][s.corner] == 4) && all.len() == 4 * 25);
    for s in &all {
        // From the middle vertex: the quarter's first direction is that of the next corner.
        let face = &mesh.faces[s.face];
        let step = |v: usize| [v as i64 / 3 - 1, v as i64 % 3 - 1];
        let (m, n) = (
            step(face[(s.corner + 1) % 4]),
            step(face[(s.corner + 3) % 4]),
        );
        let at = |d: usize| q(s.at[0] * m[d] + s.at[1] * n[d], 16);
        assert_eq!(s.s, tensor(&mesh, (quadratic(&at(0)), quadratic(&at(1)))));
    }
    // Loop: face (1,1), (2,1), (2,2) of a 3 x 3 grid with barycentric (u, v, w). Per lattice point
    // relative to (1,1) the quartic box spline, from three types by symmetry: a corner, the point
    // across an edge, a point that sees one corner only.
    let mesh = net(3, false, SEED + 2);
    let m = |a: &Q, i: i32, b: &Q, j: i32, e: &Q, k: i32, n: i64| {
        c(n) * pow(a, i) * pow(b, j) * pow(e, k)
    };
    let far = |u: &Q, v: &Q| pow(u, 4) + c(2) * pow(u, 3) * v;
    let across = |u: &Q, v: &Q, w: &Q| {
        let half = |u: &Q, v: &Q| {
            pow(u, 4) + m(u, 3, v, 1, w, 0, 6) + m(u, 3, v, 0, w, 1, 2) + m(u, 2, v, 1, w, 1, 6)
        };
        half(u, v) + half(v, u) + m(u, 2, v, 2, w, 0, 12)
    };
    let corner = |u: &Q, v: &Q, w: &Q| {
        let half = |v: &Q, w: &Q| {
            m(u, 3, v, 1, w, 0, 24)
                + m(u, 2, v, 2, w, 0, 24)
                + m(u, 1, v, 3, w, 0, 8)
                + pow(v, 4)
                + m(u, 1, v, 2, w, 1, 36)
                + m(v, 3, w, 1, u, 0, 6)
        };
        c(6) * pow(u, 4)
            + half(v, w)
            + half(w, v)
            + m(u, 2, v, 1, w, 1, 60)
            + m(v, 2, w, 2, u, 0, 12)
    };
    let place = |i: usize, j: usize| (i + 1) * 4 + j + 1;
    let face = mesh
        .faces
        .iter()
        .position(|f| *f == [place(0, 0), place(1, 0), place(1, 1)])
        .unwrap();
    for s in samples(&mesh, ask(LoopWarren, 0, Against::Control, 3))
        .iter()
        .filter(|s| s.face == face)
    {
        let [u, v, w] = &s.at.map(|x| q(x, 8));
        let terms = [
            (5, corner(u, v, w)),
            (9, corner(v, w, u)),
            (10, corner(w, u, v)),
            (4, across(u, v, w)),
            (14, across(v, w, u)),
            (6, across(w, u, v)),
            (0, far(u, v)),
            (1, far(u, w)),
            (8, far(v, u)),
            (13, far(v, w)),
            (11, far(w, u)),
            (15, far(w, v)),
        ];
        for d in 0..3 {
            let sum = terms
                .iter()
                .fold(c(0), |t, (k, n)| t + n * mesh.points[*k][d].clone());
            assert_eq!(s.s[d], sum / c(12));
        }
    }
}
