//! The bounds of `predict::differences` against the worst nets, found by an independent linear program.
//!
//! For a face whose M is made of the differences written out here, and a point of the surface over it, the program
//! of `microlp` finds heights with M <= 1 that bring surface and level-k mesh farthest apart at that point. No
//! bound over the face may be below that distance.

use microlp::{ComparisonOp, OptimizationDirection, Problem};
use subcert::bound::Against;
use subcert::mesh::{Mesh, NONE, Point, Topology, io};
use subcert::predict::differences::star::{Lattice, Star, Vertex};
use subcert::predict::differences::{Bounds, Request};
use subcert::refine::{limit_positions, refine, refine_topology};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const LOOP: Scheme = Scheme::Loop(LoopWeights::Original);

/// A row: coefficients of heights.
type Row = Vec<(usize, f64)>;

/// Points of the surface are limits of vertices two steps below the mesh.
const BELOW: u32 = 2;

/// The two-ring of a vertex with n sectors, open or closed: all other vertices near it are regular.
fn two_ring(n: usize, open: bool, quads: bool) -> Topology {
    let rays = if open { n + 1 } else { n };
    let x = |i: usize| 1 + i % rays;
    let y = |i: usize| 1 + rays + i % rays;
    let d = |i: usize, kind: usize| 1 + 2 * rays + 4 * i + kind;
    let mut faces: Vec<Vec<usize>> = Vec::new();
    for i in 0..n {
        let j = i + 1;
        if quads {
            // The diagonal vertex and, beyond it, e, g, h.
            faces.push(vec![0, x(i), d(i, 0), x(j)]);
            faces.push(vec![x(i), y(i), d(i, 1), d(i, 0)]);
            faces.push(vec![d(i, 0), d(i, 1), d(i, 2), d(i, 3)]);
            faces.push(vec![d(i, 0), d(i, 3), y(j), x(j)]);
        } else {
            faces.push(vec![0, x(i), x(j)]);
            faces.push(vec![x(i), y(i), d(i, 0)]);
            faces.push(vec![x(i), d(i, 0), x(j)]);
            faces.push(vec![x(j), d(i, 0), y(j)]);
        }
    }
    // Vertices in use, renumbered.
    let mut names: Vec<usize> = faces.concat();
    names.sort_unstable();
    names.dedup();
    let place = |v: &usize| names.binary_search(v).expect("a vertex in use") as u32;
    let mut start = vec![0];
    let mut corners = Vec::new();
    for face in &faces {
        corners.extend(face.iter().map(place));
        start.push(corners.len() as u32);
    }
    Topology::from_polygons(names.len(), start, corners).expect("a disc")
}

/// The differences that M of a face is made of, and those of them that only its boundary adds: δ, ghost rows.
fn norm(scheme: Scheme, corner: CornerRule, t: &Topology, face: u32) -> [Vec<Row>; 2] {
    let is_loop = matches!(scheme, Scheme::Loop(_));
    let row = |terms: &[(u32, f64)]| terms.iter().map(|&(v, a)| (v as usize, a)).collect::<Row>();
    let [mut rows, mut added] = [Vec::new(), Vec::new()];
    for &v in t.corners(face) {
        for h in 0..t.halfedge_count() {
            let twin = t.twin(h);
            if t.origin(h) != v || twin == NONE {
                continue;
            }
            let x = t.target(h);
            let (left, right) = (t.target(t.next(h)), t.target(t.next(twin)));
            if is_loop {
                rows.push(row(&[(v, 1.0), (x, 1.0), (left, -1.0), (right, -1.0)]));
                continue;
            }
            // Beside x: left and the vertex before; beside v: the vertices after.
            let after = t.target(t.next(t.next(h)));
            let before = t.target(t.next(t.next(twin)));
            let rho = [(v, 2.0), (after, -1.0), (right, -1.0)];
            let sigma = [(x, 2.0), (left, -1.0), (before, -1.0)];
            rows.push(row(&rho));
            rows.push(row(&sigma));
            if t.is_boundary_vertex(v) && t.valence(v) == 3 {
                let ghost = rho.map(|(v, a)| (v, 2.0 * a)).into_iter();
                let minus = sigma.map(|(v, a)| (v, -a));
                added.push(row(&ghost.chain(minus).collect::<Vec<_>>()));
            }
        }
        let faces = t.valence(v) - 1;
        let regular =
            faces == if is_loop { 3 } else { 2 } || faces == 1 && corner == CornerRule::Sharp;
        if t.is_boundary_vertex(v) && !regular {
            let ends: Vec<u32> = t.ring(v).collect();
            added.push(row(&[
                (v, 2.0),
                (ends[0], -1.0),
                (ends[ends.len() - 1], -1.0),
            ]));
        }
    }
    [rows, added]
}

/// Positions at the middles of edges, and of quads, of each of some steps.
fn flat(topology: &Topology, positions: &[Point<f64>], scheme: Scheme) -> Vec<Point<f64>> {
    let (mut t, mut p) = (topology.clone(), positions.to_vec());
    for _ in 0..BELOW {
        let mut next = p.clone();
        for e in 0..t.edge_count() {
            let h = t.edge_halfedges(e)[0];
            next.push((p[t.origin(h) as usize] + p[t.target(h) as usize]) * &0.5);
        }
        if !matches!(scheme, Scheme::Loop(_)) {
            for f in 0..t.face_count() {
                let corners = t.corners(f);
                let sum = corners
                    .iter()
                    .fold(Point([0.0; 3]), |sum, &v| sum + p[v as usize]);
                next.push(sum * &(1.0 / corners.len() as f64));
            }
        }
        (t, p) = (refine_topology(scheme, &t).expect("a mesh"), next);
    }
    p
}

/// The vertices over a face so many steps below.
fn over(scheme: Scheme, topology: &Topology, face: u32, steps: u32) -> Vec<u32> {
    let (mut t, mut faces) = (topology.clone(), vec![face]);
    for _ in 0..steps {
        faces = match scheme {
            Scheme::Loop(_) => faces.iter().flat_map(|f| 4 * f..4 * f + 4).collect(),
            _ => faces.iter().flat_map(|&f| t.halfedges(f)).collect(),
        };
        t = refine_topology(scheme, &t).expect("a mesh");
    }
    let mut vertices: Vec<u32> = faces.iter().flat_map(|&f| t.corners(f).to_vec()).collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

/// The targets S - F_k (or S - L_k) at points over a face, as coefficients of heights.
fn targets(request: &Request, topology: &Topology, face: u32, k: u32) -> Vec<Vec<f64>> {
    let (scheme, corner) = (request.scheme, request.corner);
    let points = over(scheme, topology, face, k + BELOW);
    let count = topology.vertex_count() as usize;
    let mut targets = vec![vec![0.0; count]; points.len()];
    for first in (0..count).step_by(3) {
        let unit = |v: usize| Point([0, 1, 2].map(|i| if v == first + i { 1.0 } else { 0.0 }));
        let mesh = Mesh {
            topology: topology.clone(),
            positions: (0..count).map(unit).collect(),
        };
        let level = refine(scheme, corner, &mesh, k).expect("a mesh");
        let limits = |mesh: &Mesh| {
            limit_positions::<f64, _>(scheme, corner, &mesh.topology, &mesh.positions)
        };
        let from = match request.against {
            Against::Control => level.positions.clone(),
            Against::Limit => limits(&level).expect("limits"),
        };
        let flat = flat(&level.topology, &from, scheme);
        let surface = limits(&refine(scheme, corner, &level, BELOW).expect("a mesh"));
        let surface = surface.expect("limits");
        for (target, &v) in targets.iter_mut().zip(&points) {
            for i in 0..3.min(count - first) {
                target[first + i] = surface[v as usize].0[i] - flat[v as usize].0[i];
            }
        }
    }
    targets
}

/// Heights with all rows within 1 that make the target largest; `None` where the program finds none.
fn worst(rows: &[Row], target: &[f64]) -> Option<Vec<f64>> {
    let mut problem = Problem::new(OptimizationDirection::Maximize);
    let range = |v: usize| if v == 0 { (0.0, 0.0) } else { (-50.0, 50.0) };
    let heights: Vec<_> = (0..target.len())
        .map(|v| problem.add_var(target[v], range(v)))
        .collect();
    for row in rows {
        let terms = || {
            row.iter()
                .map(|&(v, a)| (heights[v], a))
                .collect::<Vec<_>>()
        };
        problem.add_constraint(terms(), ComparisonOp::Le, 1.0);
        problem.add_constraint(terms(), ComparisonOp::Ge, -1.0);
    }
    let solution = problem.solve().ok()?.into_solution().ok()?;
    Some(heights.iter().map(|&h| solution[h]).collect())
}

fn value(target: &[f64], heights: &[f64]) -> f64 {
    let sum: f64 = target.iter().zip(heights).map(|(t, y)| t * y).sum();
    sum.abs()
}

/// The bound of a face for a net is not below the distance at a point; that of no local step is returned.
fn not_below(
    request: &dyn Fn(u32) -> Request,
    topology: &Topology,
    face: u32,
    k: u32,
    target: &[f64],
    heights: &[f64],
) -> f64 {
    let distance = value(target, heights);
    let mesh = Mesh {
        topology: topology.clone(),
        positions: heights.iter().map(|&z| Point([0.0, 0.0, z])).collect(),
    };
    let bounds = [0, 1, 2].map(|local_steps| {
        let bounds = Bounds::new(&mesh, &request(local_steps)).expect("bounds");
        let own = bounds.face_bounds(k)[face as usize];
        let what = request(local_steps);
        assert!(
            own >= distance * (1.0 - 1e-9),
            "{what:?}, level {k}, face {face}: {own} < {distance}"
        );
        own
    });
    bounds[0]
}

/// Checks all points over a face; returns the largest ratio of the bound of no local step to the distance of the
/// worst net, over the levels.
fn check(scheme: Scheme, corner: CornerRule, topology: &Topology, face: u32, levels: u32) -> f64 {
    let [inner, added] = norm(scheme, corner, topology, face);
    let rows = [inner.clone(), added].concat();
    let mut slackest = 0.0_f64;
    for against in [Against::Control, Against::Limit] {
        for k in 0..=levels {
            let request = |local_steps| Request {
                scheme,
                corner,
                against,
                local_steps,
            };
            let (mut farthest, mut bound) = (0.0_f64, 0.0);
            for target in targets(&request(0), topology, face, k) {
                // Nets that only the rows from the boundary would rule out have a large M.
                let Some(heights) = worst(&inner, &target) else {
                    continue;
                };
                not_below(&request, topology, face, k, &target, &heights);
                let Some(heights) = worst(&rows, &target) else {
                    continue;
                };
                let own = not_below(&request, topology, face, k, &target, &heights);
                let distance = value(&target, &heights);
                if distance > farthest {
                    (farthest, bound) = (distance, own);
                }
            }
            if farthest > 0.0 {
                slackest = slackest.max(bound / farthest);
            }
        }
    }
    slackest
}

#[test]
fn triangles_at_one_irregular_vertex() {
    for n in [3, 4, 5, 6, 7, 9, 12] {
        let slack = check(LOOP, CornerRule::Smooth, &two_ring(n, false, false), 0, 2);
        assert!(slack < 2.5, "n = {n}: {slack}");
    }
    // Beyond the table.
    check(LOOP, CornerRule::Smooth, &two_ring(66, false, false), 0, 0);
}

#[test]
fn triangles_at_the_boundary() {
    for m in 1..=7 {
        let topology = two_ring(m, true, false);
        for corner in [CornerRule::Smooth, CornerRule::Sharp] {
            for face in [0, 4 * (m as u32 / 2)] {
                let slack = check(LOOP, corner, &topology, face, 2);
                assert!(slack < 12.0, "m = {m}, {corner:?}: {slack}");
            }
        }
    }
}

#[test]
fn quads_at_one_irregular_vertex() {
    for n in [3, 4, 5, 6, 7] {
        let slack = check(
            Scheme::CatmullClark,
            CornerRule::Smooth,
            &two_ring(n, false, true),
            0,
            2,
        );
        assert!(slack < 3.0, "n = {n}: {slack}");
    }
}

#[test]
fn quads_at_the_boundary() {
    for m in 1..=5 {
        let topology = two_ring(m, true, true);
        for corner in [CornerRule::Smooth, CornerRule::Sharp] {
            let slack = check(Scheme::CatmullClark, corner, &topology, 0, 1);
            assert!(slack < 12.0, "m = {m}, {corner:?}: {slack}");
        }
    }
}

/// Faces with several extraordinary vertices: M is that of all three corners.
#[test]
fn triangles_with_several_extraordinary_vertices() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/meshes/valences_3_to_12.obj"
    );
    let mesh = io::read(std::path::Path::new(path))
        .expect("a sample mesh")
        .mesh;
    let t = &mesh.topology;
    let irregular = |f: &u32| t.corners(*f).iter().filter(|&&v| t.valence(v) != 6).count();
    let several = (0..t.face_count()).filter(|f| irregular(f) > 1);
    for face in several.step_by(12) {
        check(LOOP, CornerRule::Smooth, t, face, 1);
    }
}

/// Rates of a star: after i steps the differences of the face at the vertex, and of those beside it, are at most r_i M;
/// the largest is found by programs.
fn check_rates(scheme: Scheme, vertex: Vertex, topology: &Topology, slack: f64) {
    let corner = CornerRule::Smooth;
    let rows = norm(scheme, corner, topology, 0).concat();
    let lattice = Lattice {
        control: 0.5,
        step: 0.375,
        limit: 0.5,
    };
    let star = Star::new(scheme, vertex, lattice).expect("a star");
    let count = topology.vertex_count() as usize;
    for i in 1..=3 {
        let mut fine = topology.clone();
        for _ in 0..i {
            fine = refine_topology(scheme, &fine).expect("a mesh");
        }
        // The children of face 0, i - 1 times its first; all of them see the vertex or are set free.
        let children = 0..4;
        let fine_rows: Vec<Row> = children
            .flat_map(|f| norm(scheme, corner, &fine, f).concat())
            .collect();
        let mut targets = vec![vec![0.0; count]; fine_rows.len()];
        for first in (0..count).step_by(3) {
            let unit = |v: usize| Point([0, 1, 2].map(|i| if v == first + i { 1.0 } else { 0.0 }));
            let mesh = Mesh {
                topology: topology.clone(),
                positions: (0..count).map(unit).collect(),
            };
            let level = refine(scheme, corner, &mesh, i as u32).expect("a mesh");
            for (target, row) in targets.iter_mut().zip(&fine_rows) {
                for c in 0..3.min(count - first) {
                    let terms = row.iter().map(|&(v, a)| a * level.positions[v].0[c]);
                    target[first + c] = terms.sum();
                }
            }
        }
        let values = targets
            .iter()
            .filter_map(|target| Some(value(target, &worst(&rows, target)?)));
        let largest = values.fold(0.0, f64::max);
        let rate = star.rates[i];
        assert!(
            rate >= largest * (1.0 - 1e-9),
            "{vertex:?}, {i} steps: {rate} < {largest}"
        );
        assert!(
            rate <= largest * slack,
            "{vertex:?}, {i} steps: {rate} > {largest}"
        );
    }
}

#[test]
fn rates_of_stars() {
    for n in [3, 4, 5, 7, 9] {
        let [three, four] = [false, true].map(|quads| two_ring(n as usize, false, quads));
        check_rates(LOOP, Vertex::Interior(n), &three, 6.0);
        if n != 4 {
            check_rates(Scheme::CatmullClark, Vertex::Interior(n), &four, 6.0);
        }
    }
    for m in [1, 2, 4, 5, 7] {
        let [three, four] = [false, true].map(|quads| two_ring(m as usize, true, quads));
        check_rates(LOOP, Vertex::Boundary(m), &three, 6.0);
        if m != 2 {
            // What is proved of the ghost row halves at best: no measure of tightness here.
            let any = f64::INFINITY;
            check_rates(Scheme::CatmullClark, Vertex::Boundary(m), &four, any);
        }
    }
}
