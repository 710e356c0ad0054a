// A search in floating point that proposes enclosures of the distances of eigensplines: nothing of it is proved.

use num_bigint::BigInt;
use num_rational::BigRational;
use serde_json::{Value, json};

use crate::cosine::cosine;
use crate::web::{Point, Web, key};

/// 24 times the matrix of HW, Appendix 1, for the rows p1 p2 / p3 p4 p5 / p6 .. p9 / p10 p11 p12.
const T: [[i32; 12]; 15] = [
    [2, 2, 2, 12, 2, 0, 2, 2, 0, 0, 0, 0],
    [1, 0, 3, 12, 1, 0, 4, 3, 0, 0, 0, 0],
    [0, 1, 1, 12, 3, 0, 3, 4, 0, 0, 0, 0],
    [0, 0, 4, 8, 0, 0, 8, 4, 0, 0, 0, 0],
    [0, 0, 1, 10, 1, 0, 6, 6, 0, 0, 0, 0],
    [0, 0, 0, 8, 4, 0, 4, 8, 0, 0, 0, 0],
    [0, 0, 3, 4, 0, 1, 12, 3, 0, 0, 1, 0],
    [0, 0, 1, 6, 0, 0, 10, 6, 0, 0, 1, 0],
    [0, 0, 0, 6, 1, 0, 6, 10, 0, 0, 1, 0],
    [0, 0, 0, 4, 3, 0, 3, 12, 1, 0, 1, 0],
    [0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2, 0],
    [0, 0, 1, 3, 0, 0, 12, 4, 0, 1, 3, 0],
    [0, 0, 0, 4, 0, 0, 8, 8, 0, 0, 4, 0],
    [0, 0, 0, 3, 1, 0, 4, 12, 0, 0, 3, 1],
    [0, 0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2],
];

/// A mode by its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Name(pub &'static str, pub Option<usize>);

#[derive(Clone)]
struct Mode {
    lambda: f64,
    kappa: f64,
    /// The webs of levels 0, 1, ..
    levels: Vec<std::rc::Rc<Web>>,
}

pub struct Case {
    pub n: usize,
    pub weights: &'static str,
    pub against: &'static str,
    pub levels: usize,
}

type Triangle = [i64; 3];
type Patch = [Point; 15];

fn add(x: Point, c: f64, y: Point) -> Point {
    [x[0] + c * y[0], x[1] + c * y[1]]
}

fn size(x: Point) -> f64 {
    x[0].hypot(x[1])
}

fn corners([p, q, t]: Triangle) -> [[i64; 2]; 3] {
    if t == 0 { [[p, q], [p + 1, q], [p, q + 1]] } else { [[p + 1, q + 1], [p, q + 1], [p + 1, q]] }
}

fn triangles(least: i64, most: i64) -> Vec<Triangle> {
    let all = (0..most).flat_map(|p| (0..most).flat_map(move |q| [[p, q, 0], [p, q, 1]]));
    all.filter(|t| corners(*t).iter().all(|[p, q]| (least..=most).contains(&(p + q)))).collect()
}

fn at(web: &Web, j: usize, [p, q]: [i64; 2]) -> Point {
    let n = web.n;
    web.points[&match (p, q) {
        (p, -1) => key(n, j + n - 1, 1, p - 1),
        (-1, q) => key(n, j + 1, q - 1, 1),
        _ => key(n, j, p, q),
    }]
}

fn patch(web: &Web, j: usize, triangle: Triangle) -> Patch {
    let [x, a, b] = corners(triangle);
    let p =
        |i: i64, k: i64| at(web, j, [0, 1].map(|d| x[d] + i * (a[d] - x[d]) + k * (b[d] - x[d])));
    let net = [
        p(0, -1),
        p(-1, 0),
        p(1, -1),
        p(0, 0),
        p(-1, 1),
        p(2, -1),
        p(1, 0),
        p(0, 1),
        p(-1, 2),
        p(2, 0),
        p(1, 1),
        p(0, 2),
    ];
    T.map(|row| row.iter().zip(net).fold([0.0; 2], |s, (c, y)| add(s, f64::from(*c) / 24.0, y)))
}

fn value(patch: &Patch, v: f64, w: f64) -> Point {
    let factorial = |i: usize| (1..=i).product::<usize>() as f64;
    let (mut sum, mut index, u) = ([0.0; 2], 0, 1.0 - v - w);
    for row in 0..=4 {
        for k in 0..=row {
            let (i, j) = (4 - row, row - k);
            let b = 24.0 / (factorial(i) * factorial(j) * factorial(k));
            let b = b * u.powi(i as i32) * v.powi(j as i32) * w.powi(k as i32);
            sum = add(sum, b, patch[index]);
            index += 1;
        }
    }
    sum
}

/// The barycentric coordinates of z.
fn barycentric([a, b, c]: [Point; 3], z: Point) -> [f64; 3] {
    let cross = |x: Point, y: Point| x[0] * y[1] - x[1] * y[0];
    let (u, v, d) = (add(b, -1.0, a), add(c, -1.0, a), add(z, -1.0, a));
    let (second, third) = (cross(d, v) / cross(u, v), cross(u, d) / cross(u, v));
    [1.0 - second - third, second, third]
}

fn mode(case: &Case, Name(family, frequency): Name, webs: usize) -> (Mode, Option<Mode>) {
    let n = case.n;
    let turn = |x: f64| std::f64::consts::TAU * x / n as f64;
    let beta = match (case.weights, n) {
        ("warren", 3) => 9.0 / 16.0,
        ("warren", _) => 3.0 / 8.0,
        _ => 0.625 - (0.375 + turn(1.0).cos() / 4.0).powi(2),
    };
    let mut web = Web { n, beta, radius: 2, points: Default::default() };
    let power = |k: usize, j: usize| {
        let x = turn((k * j) as f64);
        [x.cos(), x.sin()]
    };
    let (lambda, mut kappa, mut chain) = match (family, frequency) {
        ("ring", Some(0)) => (0.625 - beta, 0.0, None),
        ("ring", Some(k)) => (0.375 + turn(k as f64).cos() / 4.0, 0.0, None),
        ("ray", _) => (1.0 / 16.0, 0.0, None),
        _ => (1.0 / 8.0, 0.0, None),
    };
    for j in 0..n {
        let (a, b, d) = match (family, frequency) {
            ("ring", Some(0)) => {
                let centre = -8.0 * beta / 3.0;
                let d = (0.75 + centre / 8.0) / (lambda - 0.125);
                let rest = 12.0 + centre + 2.0 * d;
                if n == 3 {
                    kappa = rest / 16.0;
                }
                let b = if n == 3 { 0.0 } else { rest / (16.0 * lambda - 1.0) };
                web.points.insert((0, 0, 0), [centre, 0.0]);
                ([1.0, 0.0], [b, 0.0], [d, 0.0])
            }
            ("ring", Some(k)) => {
                let c = turn(k as f64).cos();
                let delta = if 2 * k == n { 0.0 } else { 3.0 / (8.0 * lambda - 1.0) };
                let rho = (10.0 + 2.0 * c + delta * (2.0 + 2.0 * c)) / (16.0 * lambda - 1.0);
                let d = add(power(k, j), 1.0, power(k, j + 1)).map(|x| delta * x);
                (power(k, j), power(k, j).map(|x| rho * x), d)
            }
            ("ray", k) => ([0.0; 2], [f64::from(u8::from(k.is_some() || j == 0)), 0.0], [0.0; 2]),
            _ => {
                let [b, d] = [j < 2, j < 1].map(|one| [f64::from(u8::from(one)), 0.0]);
                ([0.0; 2], b, d)
            }
        };
        web.points.insert((j, 1, 0), a);
        web.points.insert((j, 2, 0), b);
        web.points.insert((j, 1, 1), d);
    }
    web.points.entry((0, 0, 0)).or_insert([0.0; 2]);
    if kappa != 0.0 {
        chain = Some(mode(case, Name("ray", Some(0)), webs).0);
    }
    // The three-ring: the points of the next level over lambda.
    let next = web.refined();
    for (name, y) in next.points.iter().filter(|((_, p, q), _)| p + q == 3) {
        let f = chain.as_ref().map_or([0.0; 2], |f: &Mode| f.levels[0].points[name]);
        web.points.insert(*name, add(*y, -kappa, f).map(|x| x / lambda));
    }
    web.radius = 3;
    let mut levels = vec![std::rc::Rc::new(web)];
    for i in 1..webs {
        levels.push(std::rc::Rc::new(levels[i - 1].refined()));
    }
    (Mode { lambda, kappa, levels }, chain)
}

/// A facet: its place, the corners, and the values there.
type Facet = (Triangle, [Point; 3], [Point; 3]);

fn facets(case: &Case, [chi, e]: [&Web; 2], j: usize, radius: i64) -> Vec<Facet> {
    let limit = case.against == "limit";
    let vertices = |web: &Web| -> Box<dyn Fn([i64; 2]) -> Point> {
        if limit {
            let (limits, n) = (web.limits(), web.n);
            Box::new(move |[p, q]| limits[&key(n, j, p, q)])
        } else {
            let (points, n) = (web.points.clone(), web.n);
            Box::new(move |[p, q]| points[&key(n, j, p, q)])
        }
    };
    let (z, y) = (vertices(chi), vertices(e));
    triangles(0, radius).into_iter().map(|t| (t, corners(t).map(&z), corners(t).map(&y))).collect()
}

/// |e - E|, where there is a facet.
fn gap(facets: &[Facet], z: Point, e: Point) -> Option<f64> {
    facets.iter().find_map(|(_, corners, values)| {
        let b = barycentric(*corners, z);
        let inside = b.iter().all(|x| *x > -1e-12);
        inside.then(|| size((0..3).fold(e, |d, i| add(d, -b[i], values[i]))))
    })
}

struct Best {
    value: f64,
    sector: usize,
    ring: usize,
    triangle: Triangle,
    /// Over 2^30.
    point: [i64; 2],
}

const UNIT: i64 = 1 << 30;

/// The largest value of a function of the points of a patch.
fn maximum(f: &dyn Fn(f64, f64) -> Option<f64>) -> (f64, [i64; 2]) {
    let at = |[v, w]: [i64; 2]| {
        let valid = v >= 0 && w >= 0 && v + w <= UNIT;
        let [v, w] = [v, w].map(|x| x as f64 / UNIT as f64);
        valid.then(|| f(v, w)).flatten().unwrap_or(0.0)
    };
    let grid = (0..=16).flat_map(|i| (0..=16 - i).map(move |k| [i, k].map(|x| x * UNIT / 16)));
    let mut starts: Vec<_> = grid.map(|p| (at(p), p)).collect();
    starts.sort_by(|a, b| b.0.total_cmp(&a.0));
    // Finer and finer grids round the best points: ridges, at the edges of facets, run in any direction.
    let climb = |start: &(f64, [i64; 2])| {
        let (mut best, mut step) = (*start, UNIT as f64 / 16.0);
        while step > 1.0 {
            let middle = best.1;
            for (i, k) in (-3..=3).flat_map(|i| (-3..=3).map(move |k| (i, k))) {
                let [v, w] =
                    [(0, i), (1, k)].map(|(d, i)| middle[d] + (f64::from(i) * step / 3.0) as i64);
                let found = at([v, w]);
                if found > best.0 {
                    best = (found, [v, w]);
                }
            }
            step *= 0.6;
        }
        best
    };
    let tops = starts.iter().take(12).map(climb);
    tops.fold((-1.0, [0, 0]), |a, b| if b.0 > a.0 { b } else { a })
}

fn rational(x: f64) -> BigRational {
    BigRational::new(BigInt::from((x * 1e18).round() as i128), BigInt::from(10).pow(18))
}

fn text(x: f64) -> String {
    rational(x).to_string()
}

fn spot(best: &Best, near: bool) -> Value {
    let point = best.point.map(|x| BigRational::new(x.into(), UNIT.into()).to_string());
    let mut spot = json!({"sector": best.sector, "triangle": best.triangle, "point": point});
    if near {
        spot["ring"] = json!(best.ring);
    }
    spot
}

/// What the search finds for a mode.
struct Found {
    lambda: f64,
    kappa: f64,
    rings: Vec<f64>,
    near: f64,
    step: Value,
}

fn search(case: &Case, name: Name, slack: f64, depth: usize) -> Found {
    let webs = case.levels.max(2);
    let chi = mode(case, Name("ring", Some(1)), webs).0;
    let (e, chain) = mode(case, name, webs);
    let sectors = if name.0 == "between" { 2 } else { 1 };
    let (mut rings, mut list) = (Vec::new(), Vec::new());
    let over = |level: usize, facets: &[Facet], sector: usize, ring: usize| {
        let t = level.max(1);
        let mut best = Best { value: -1.0, sector, ring, triangle: [0; 3], point: [0; 2] };
        for triangle in triangles(1 << (t - 1), 1 << t) {
            let z = patch(&chi.levels[t], sector, triangle);
            let y = patch(&e.levels[t], sector, triangle);
            let f = chain.as_ref().map(|f| patch(&f.levels[t], sector, triangle));
            // Of the same level, those not far away.
            let near = |facet: &&Facet| {
                let apart = |i: usize| (facet.0[i] - triangle[i]).abs() <= 2;
                level == 0 || ring > 0 || (apart(0) && apart(1))
            };
            let near: Vec<_> = facets.iter().filter(near).copied().collect();
            let scale = |x: Point, c: f64| x.map(|x| x * c);
            let r = ring as i32;
            let value = |v: f64, w: f64| {
                let z = scale(value(&z, v, w), chi.lambda.powi(r));
                let mut y = scale(value(&y, v, w), e.lambda.powi(r));
                if let Some(f) = &f {
                    let share = f64::from(r) * e.lambda.powi(r - 1) * e.kappa;
                    y = add(y, share, self::value(f, v, w));
                }
                gap(&near, z, y)
            };
            let (found, point) = maximum(&value);
            if found > best.value {
                best = Best { value: found, triangle, point, ..best };
            }
        }
        best
    };
    let larger = |a: Best, b: Best| if b.value > a.value { b } else { a };
    for level in 0..case.levels {
        let radius = match (level, case.against) {
            (0, "limit") => 2,
            (0, _) => 3,
            _ => (1 << level) + 1,
        };
        let best = (0..sectors).map(|j| {
            let facets = facets(case, [&chi.levels[level], &e.levels[level]], j, radius);
            over(level, &facets, j, 0)
        });
        let best = best.reduce(larger).unwrap();
        rings.push(best.value);
        let (lo, hi) = (text(best.value * (1.0 - 1e-6)), text(best.value * (1.0 + slack)));
        list.push(json!({"lo": lo, "hi": hi, "at": spot(&best, false)}));
    }
    let best = (0..sectors).flat_map(|j| (1..4).map(move |r| (j, r))).map(|(j, r)| {
        let all = facets(case, [&chi.levels[0], &e.levels[0]], j, 2);
        over(1, &all[..1], j, r)
    });
    let best = best.reduce(larger).unwrap();
    let centre = facets(case, [&chi.levels[0], &e.levels[0]], 0, 2)[0].2[0][0].abs();
    let near = best.value.max(centre);
    let at = if centre >= best.value { Value::Null } else { spot(&best, true) };
    let (lo, hi) = (text(near * (1.0 - 1e-6)), text(near * (1.0 + slack)));
    let step = json!({
        "rule": "rings", "rings": list,
        "near": {"lo": lo, "hi": hi, "at": at, "depth": depth},
    });
    Found { lambda: e.lambda, kappa: e.kappa, rings, near, step }
}

/// A certificate for some modes, with an upper bound by `slack` above what is found; and the distances found.
pub fn propose(case: &Case, names: &[Name], slack: f64, depth: usize) -> (Value, Vec<Vec<f64>>) {
    let found: Vec<_> = names.iter().map(|name| search(case, *name, slack, depth)).collect();
    let (mut modes, mut distances) = (Vec::new(), Vec::new());
    for (name, mode) in names.iter().zip(&found) {
        let f = names.iter().position(|name| *name == Name("ray", Some(0)));
        let f = f.filter(|_| mode.kappa != 0.0).map(|f| &found[f]);
        let mut list = Vec::new();
        let mut values = Vec::new();
        for m in 0..case.levels {
            let each = |sign: f64, scale: f64| {
                let one = |r: usize, d: f64, f: Option<f64>| {
                    let other =
                        f64::from(r as u32) * mode.lambda.powi(r as i32 - 1) * mode.kappa.abs();
                    let f = f.unwrap_or(0.0) * (1.0 + slack);
                    mode.lambda.powi(r as i32) * d * scale
                        + if r > 0 { sign * other * f } else { 0.0 }
                };
                let rings = (0..=m).map(|r| one(r, mode.rings[m - r], f.map(|f| f.rings[m - r])));
                rings.chain([one(m, mode.near, f.map(|f| f.near))]).fold(0.0, f64::max)
            };
            let (lo, hi) = (each(-1.0, 1.0 - 2e-6), each(1.0, 1.0 + slack) * (1.0 + 1e-9));
            values.push(each(0.0, 1.0));
            list.push(json!([text(lo), text(hi)]));
        }
        modes.push(json!({"family": name.0, "frequency": name.1, "distances": list}));
        distances.push(values);
    }
    let claim = json!({
        "scheme": "loop", "weights": case.weights, "valence": case.n, "kind": "eigensplines",
        "against": case.against, "modes": modes,
    });
    let file = json!({
        "format": "subcert", "version": 1, "claim": claim, "cosine": cosine(case.n), "bases": [],
        "steps": found.iter().map(|mode| mode.step.clone()).collect::<Vec<_>>(),
    });
    (file, distances)
}
