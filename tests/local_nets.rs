//! Local nets and their tiles against subdivision by brute force.

mod brute_force;

use brute_force::{Mesh, Step, edge, loop_faces, mean, rational_cases, refine_parameters};
use num_traits::One;
use subcert::bernstein::conversion::{
    bicubic_bezier_from_net, biquadratic_bezier_from_net, box_spline_bezier_from_net,
};
use subcert::scalar::{Field, Rational, Ring};
use subcert::scheme::loop_scheme::{LevelOnePoint, level_one_point};
use subcert::scheme::{LoopWeights, Tile, catmull_clark, doo_sabin, loop_scheme};

type R = Rational;

fn r(p: i64, q: i64) -> R {
    R::ratio(p, q)
}

/// A net without symmetry; the multiplier is that of a well-known congruential generator.
fn irregular_net<S: Ring>(size: usize) -> Vec<S> {
    let next = |state: &mut u64| {
        *state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        Some(S::from_integer((*state >> 33) as i64 % 1000 - 500))
    };
    std::iter::repeat_n((), size)
        .scan(1, |state, ()| next(state))
        .collect()
}

fn unit_nets<S: Ring>(size: usize) -> Vec<Vec<S>> {
    let unit = |k: usize| {
        (0..size)
            .map(|i| if i == k { S::one() } else { S::zero() })
            .collect()
    };
    (0..size).map(unit).collect()
}

// --- Loop ---------------------------------------------------------------------------------------

/// b(n), written out independently of the library.
fn ring_weight<S: Field>(weights: LoopWeights, n: usize) -> S {
    let size = n as i64;
    match weights {
        LoopWeights::Warren if n == 3 => S::ratio(3, 16),
        LoopWeights::Warren => S::ratio(3, 8 * size),
        LoopWeights::Original if n == 6 => S::ratio(1, 16),
        LoopWeights::Original => {
            // (40 - (3 + 2 cos)^2) / (64 n), as 5/8 - (3/8 + cos/4)^2 = 5/8 - (3 + 2 cos)^2/64.
            let t = S::from_integer(3) + &S::two_cos(1, n as u32).unwrap();
            (S::from_integer(40) - &(t.clone() * &t)) * &S::ratio(1, 64 * size)
        }
    }
}

fn loop_step<S: Field>(weights: LoopWeights, mesh: &Mesh<S>) -> Step<S> {
    brute_force::loop_step(mesh, &|n| ring_weight::<S>(weights, n))
}

/// The new index of each level-1 label, found by what the label means.
fn loop_index<S>(step: &Step<S>, n: u32, index: &[usize], label: usize) -> usize {
    match level_one_point(n, label) {
        LevelOnePoint::Vertex(a) => step.vertex[index[a - 1]],
        LevelOnePoint::Edge(a, b) => step.edge[&edge(index[a - 1], index[b - 1])],
    }
}

fn check_loop_against_brute_force<S: Field>(weights: LoopWeights, n: u32, net: &[S], levels: u32) {
    let mut mesh = Mesh::new(loop_faces(n as usize), net);
    let mut index: Vec<usize> = (0..net.len()).collect();
    let mut net = net.to_vec();
    for _ in 0..levels {
        let step = loop_step(weights, &mesh);
        let extended = loop_scheme::extended_net::<S, S>(weights, n, &net).unwrap();
        assert_eq!(extended.len(), loop_scheme::extended_net_size(n));
        let fresh: Vec<usize> = (1..=extended.len())
            .map(|l| loop_index(&step, n, &index, l))
            .collect();
        for (at, point) in fresh.iter().zip(&extended) {
            assert_eq!(
                step.mesh.points[*at].as_ref(),
                Some(point),
                "{weights} n = {n}"
            );
        }
        net = loop_scheme::refine_local_net::<S, S>(weights, n, &net).unwrap();
        assert_eq!(net, extended[..net.len()]);
        index = fresh[..net.len()].to_vec();
        mesh = step.mesh;
    }
}

#[test]
fn loop_nets_agree_with_brute_force() {
    for (weights, n) in rational_cases(12) {
        let size = loop_scheme::local_net_size(n);
        for unit in unit_nets::<R>(size) {
            check_loop_against_brute_force(weights, n, &unit, 1);
        }
        check_loop_against_brute_force(weights, n, &irregular_net::<R>(size), 3);
    }
}

/// The value of a quartic triangle in HW's order at (v, w).
fn triangle_value<S: Field>(bezier: &[S; 15], [v, w]: &[S; 2]) -> S {
    let u = S::one() - v - w;
    let power = |x: &S, k: usize| (0..k).fold(S::one(), |p, _| p * x);
    let factorial = |k: usize| (1..=k as i64).product::<i64>();
    let mut sum = S::zero();
    for (j, k) in (0..=4).flat_map(|j| (0..=4 - j).map(move |k| (j, k))) {
        let i = 4 - j - k;
        let count = 24 / (factorial(i) * factorial(j) * factorial(k));
        let product = power(&u, i) * &power(v, j) * &power(w, k) * &S::from_integer(count);
        sum += product * &bezier[(j + k) * (j + k + 1) / 2 + k];
    }
    sum
}

/// S at (v, w) by Stam's tiles: ring by ring towards the corner until a tile contains it.
fn loop_tile_values<S: Field>(weights: LoopWeights, n: u32, net: &[S]) -> Vec<([S; 2], S)> {
    let mut values = Vec::new();
    let mut net = net.to_vec();
    for ring in 1..=2 {
        let extended = loop_scheme::extended_net::<S, S>(weights, n, &net).unwrap();
        for tile in Tile::ALL {
            let bezier =
                box_spline_bezier_from_net::<S, S>(&loop_scheme::tile_net(n, tile, &extended));
            let corners = loop_scheme::tile_corners(tile);
            for (j, k) in (0..=4).flat_map(|j| (0..=4 - j).map(move |k| (j, k))) {
                let weights = [4 - j - k, j, k];
                // Corners in halves, times 2^(1-ring), local coordinates in quarters.
                let at = [0, 1].map(|axis| {
                    let sum: i64 = (0..3).map(|c| weights[c] * corners[c][axis]).sum();
                    S::ratio(sum, 8 << (ring - 1))
                });
                let local = [S::ratio(j, 4), S::ratio(k, 4)];
                values.push((at, triangle_value(&bezier, &local)));
            }
        }
        net = loop_scheme::refine_local_net::<S, S>(weights, n, &net).unwrap();
    }
    values
}

fn check_loop_tiles<S: Field>(weights: LoopWeights, n: u32) {
    let net = irregular_net::<S>(loop_scheme::local_net_size(n));
    let mut mesh = Mesh::new(loop_faces(n as usize), &net);
    let mut parameters = vec![None; net.len()];
    parameters[0] = Some([S::zero(), S::zero()]);
    parameters[1] = Some([S::one(), S::zero()]);
    parameters[n as usize] = Some([S::zero(), S::one()]);
    for _ in 0..4 {
        let step = loop_step(weights, &mesh);
        parameters = refine_parameters(&mesh.faces, &parameters, &step);
        mesh = step.mesh;
    }
    let stars = mesh.stars();
    let mut limits = Vec::new();
    for (v, parameter) in parameters.iter().enumerate() {
        let Some(at) = parameter else { continue };
        let star = stars[v].as_ref().unwrap();
        let own = mesh.points[v].clone().unwrap();
        let ring = star
            .iter()
            .fold(S::zero(), |sum, &w| sum + mesh.points[w].as_ref().unwrap());
        let mask = loop_scheme::limit_mask::<S>(weights, star.len() as u32).unwrap();
        limits.push((at.clone(), mask.apply_ring(&own, &ring)));
    }
    assert_eq!(limits.len(), 17 * 18 / 2);
    let values = loop_tile_values(weights, n, &net);
    assert_eq!(values.len(), 2 * 3 * 15);
    for (at, value) in values {
        let (_, limit) = limits
            .iter()
            .find(|(place, _)| *place == at)
            .expect("a level-4 point");
        assert_eq!(*limit, value, "{weights} n = {n} at {at:?}");
    }
}

#[test]
fn loop_tiles_are_the_limit_surface() {
    for (weights, n) in rational_cases(9) {
        check_loop_tiles::<R>(weights, n);
    }
}

#[test]
fn regular_labels_turn_the_local_net_into_the_regular_patch() {
    let net = irregular_net::<R>(12);
    let regular = loop_scheme::REGULAR_LABELS.map(|label| net[label - 1].clone());
    let bezier = box_spline_bezier_from_net::<R, R>(&regular);
    for (at, value) in loop_tile_values(LoopWeights::Original, 6, &net) {
        assert_eq!(triangle_value(&bezier, &at), value);
    }
}

// --- Catmull-Clark ------------------------------------------------------------------------------

fn catmull_clark_faces(n: usize) -> Vec<Vec<usize>> {
    let ring = |i: usize| if i > 2 * n + 1 { i - 2 * n } else { i };
    let sector = |j: usize| [1, ring(2 * j), ring(2 * j + 1), ring(2 * j + 2)];
    let mut faces: Vec<[usize; 4]> = (1..=n).map(sector).collect();
    let far = 2 * n;
    faces.extend([
        [4, 3, far + 8, far + 7],
        [5, 4, far + 7, far + 6],
        [5, far + 6, far + 2, far + 3],
        [6, 5, far + 3, far + 4],
        [7, 6, far + 4, far + 5],
    ]);
    faces
        .into_iter()
        .map(|face| face.map(|label| label - 1).to_vec())
        .collect()
}

/// Level-1 labels from the meaning of the old ones: the lattice picture of the module, typed as
/// (label, ancestors): one ancestor is a vertex point, two an edge point, four a face point.
fn catmull_clark_ancestors(n: usize, label: usize) -> Vec<usize> {
    let ring = |i: usize| if i > 2 * n + 1 { i - 2 * n } else { i };
    let far = 2 * n;
    if label == 1 {
        return vec![1];
    }
    if label <= far + 1 {
        return match label % 2 {
            0 => vec![1, label],
            _ => vec![1, label - 1, label, ring(label + 1)],
        };
    }
    match label - far {
        2 => vec![5],
        3 => vec![5, 6],
        4 => vec![6],
        5 => vec![6, 7],
        6 => vec![4, 5],
        7 => vec![4],
        8 => vec![4, 3],
        9 => vec![5, far + 6, far + 2, far + 3],
        10 => vec![5, far + 3],
        11 => vec![5, 6, far + 3, far + 4],
        12 => vec![6, far + 4],
        13 => vec![6, 7, far + 4, far + 5],
        14 => vec![5, far + 6],
        15 => vec![4, 5, far + 6, far + 7],
        16 => vec![4, far + 7],
        17 => vec![3, 4, far + 7, far + 8],
        _ => unreachable!(),
    }
}

fn catmull_clark_index<S>(mesh: &Mesh<S>, step: &Step<S>, ancestors: &[usize]) -> usize {
    match ancestors {
        [v] => step.vertex[*v],
        [a, b] => step.edge[&edge(*a, *b)],
        corners => {
            let is_face = |face: &Vec<usize>| corners.iter().all(|v| face.contains(v));
            step.face[mesh.faces.iter().position(is_face).unwrap()]
        }
    }
}

fn check_catmull_clark_against_brute_force(n: u32, net: &[R], levels: u32) {
    let mut mesh = Mesh::new(catmull_clark_faces(n as usize), net);
    let mut index: Vec<usize> = (0..net.len()).collect();
    let mut net = net.to_vec();
    for _ in 0..levels {
        let step = brute_force::catmull_clark_step(&mesh);
        let extended = catmull_clark::extended_net::<R, R>(n, &net);
        assert_eq!(extended.len(), catmull_clark::extended_net_size(n));
        let place = |label: usize| {
            let ancestors = catmull_clark_ancestors(n as usize, label);
            let ancestors: Vec<usize> = ancestors.into_iter().map(|l| index[l - 1]).collect();
            catmull_clark_index(&mesh, &step, &ancestors)
        };
        let fresh: Vec<usize> = (1..=extended.len()).map(place).collect();
        for (at, point) in fresh.iter().zip(&extended) {
            assert_eq!(step.mesh.points[*at].as_ref(), Some(point), "N = {n}");
        }
        net = catmull_clark::refine_local_net::<R, R>(n, &net);
        assert_eq!(net, extended[..net.len()]);
        index = fresh[..net.len()].to_vec();
        mesh = step.mesh;
    }
}

#[test]
fn catmull_clark_nets_agree_with_brute_force() {
    for n in 3..=12 {
        let size = catmull_clark::local_net_size(n);
        for unit in unit_nets::<R>(size) {
            check_catmull_clark_against_brute_force(n, &unit, 1);
        }
        check_catmull_clark_against_brute_force(n, &irregular_net::<R>(size), 3);
    }
}

fn bernstein(degree: usize, i: usize, t: &R) -> R {
    let binomial = (0..i).fold(1, |b, k| b * (degree - k) / (k + 1));
    let one_minus = R::one() - t;
    let tail = (i..degree).fold(R::one(), |p, _| p * &one_minus);
    (0..i).fold(tail, |p, _| p * t) * r(binomial as i64, 1)
}

/// The value of a tensor-product Bézier patch, rows of constant v, at (u, v).
fn tensor_value(degree: usize, bezier: &[R], [u, v]: &[R; 2]) -> R {
    let side = degree + 1;
    let term =
        |at: usize| bernstein(degree, at % side, u) * bernstein(degree, at / side, v) * &bezier[at];
    (0..side * side).map(term).sum()
}

/// Parameters and values on a 5x5 grid over each tile of two rings, from the tiles' Bézier nets.
fn tensor_tile_values(
    degree: usize,
    mut net: Vec<R>,
    step: impl Fn(&[R]) -> (Vec<R>, [Vec<R>; 3]),
) -> Vec<([R; 2], R)> {
    let mut values = Vec::new();
    for ring in 0..2 {
        let (next, tiles) = step(&net);
        for (tile, bezier) in Tile::ALL.into_iter().zip(&tiles) {
            let [u0, v0] = catmull_clark::tile_corner(tile);
            for (i, j) in (0..=4).flat_map(|j| (0..=4).map(move |i| (i, j))) {
                let at = [r(4 * u0 + i, 8 << ring), r(4 * v0 + j, 8 << ring)];
                values.push((at, tensor_value(degree, bezier, &[r(i, 4), r(j, 4)])));
            }
        }
        net = next;
    }
    values
}

fn assert_limits(limits: &[([R; 2], R)], values: Vec<([R; 2], R)>, n: u32) {
    for (at, value) in values {
        let (_, limit) = limits
            .iter()
            .find(|(place, _)| *place == at)
            .expect("a refined point");
        assert_eq!(*limit, value, "n = {n} at {at:?}");
    }
}

#[test]
fn catmull_clark_tiles_are_the_limit_surface() {
    for n in 3..=8 {
        let net = irregular_net::<R>(catmull_clark::local_net_size(n));
        let mut mesh = Mesh::new(catmull_clark_faces(n as usize), &net);
        let mut parameters = vec![None; net.len()];
        for (label, at) in [(1, [0, 0]), (4, [0, 1]), (5, [1, 1]), (6, [1, 0])] {
            parameters[label - 1] = Some(at.map(|x| r(x, 1)));
        }
        for _ in 0..4 {
            let step = brute_force::catmull_clark_step(&mesh);
            parameters = refine_parameters(&mesh.faces, &parameters, &step);
            mesh = step.mesh;
        }
        let stars = mesh.stars();
        let mut limits = Vec::new();
        for (v, parameter) in parameters.iter().enumerate() {
            let Some(at) = parameter else { continue };
            let star = stars[v].as_ref().unwrap();
            let point = |w: usize| mesh.points[w].as_ref().unwrap();
            let edges: R = star.iter().map(|&w| point(w)).sum();
            let around = mesh.faces_at(v).into_iter().flat_map(|f| &mesh.faces[f]);
            let diagonals: R = around
                .filter(|w| **w != v && !star.contains(w))
                .map(|&w| point(w))
                .sum();
            let mask = catmull_clark::limit_mask::<R>(star.len() as u32);
            limits.push((at.clone(), mask.apply(point(v), &edges, &diagonals)));
        }
        assert_eq!(limits.len(), 17 * 17);
        let values = tensor_tile_values(3, net, |net| {
            let extended = catmull_clark::extended_net::<R, R>(n, net);
            let tiles = Tile::ALL.map(|tile| {
                let grid = catmull_clark::tile_net(n, tile, &extended);
                bicubic_bezier_from_net::<R, R>(&grid).to_vec()
            });
            (catmull_clark::refine_local_net::<R, R>(n, net), tiles)
        });
        assert_limits(&limits, values, n);
    }
}

// --- Doo-Sabin ----------------------------------------------------------------------------------

fn doo_sabin_faces(n: usize) -> Vec<Vec<usize>> {
    let mut faces = vec![(1..=n).collect()];
    faces.extend(doo_sabin::quads(n as u32).map(|quad| quad.to_vec()));
    let zero_based = |face: Vec<usize>| face.into_iter().map(|label| label - 1).collect();
    faces.into_iter().map(zero_based).collect()
}

/// (Face, vertex label) of a level-1 label; faces 0..3 are f, g, h, k.
fn doo_sabin_ancestor(n: usize, label: usize) -> (usize, usize) {
    if label <= n {
        return (0, label);
    }
    match label - n {
        1 => (1, 2),
        2 => (1, 1),
        3 => (2, 1),
        4 => (3, 1),
        5 => (3, n),
        6 => (1, n + 1),
        7 => (1, n + 2),
        8 => (2, n + 2),
        9 => (2, n + 3),
        10 => (2, n + 4),
        11 => (3, n + 4),
        12 => (3, n + 5),
        _ => unreachable!(),
    }
}

fn check_doo_sabin_against_brute_force<S: Field>(n: u32, net: &[S], levels: u32) {
    let mut mesh = Mesh::new(doo_sabin_faces(n as usize), net);
    let mut index: Vec<usize> = (0..net.len()).collect();
    let mut net = net.to_vec();
    for _ in 0..levels {
        let (step, _) = brute_force::doo_sabin_step(&mesh);
        let extended = doo_sabin::extended_net::<S, S>(n, &net).unwrap();
        assert_eq!(extended.len(), doo_sabin::extended_net_size(n));
        // The face of the present mesh that is f, g, h or k.
        let face_of = |labels: &[usize]| {
            let all = |face: &Vec<usize>| {
                face.len() == labels.len() && labels.iter().all(|l| face.contains(&index[l - 1]))
            };
            mesh.faces.iter().position(all).unwrap()
        };
        let ngon: Vec<usize> = (1..=n as usize).collect();
        let [g, h, k] = doo_sabin::quads(n);
        let faces = [face_of(&ngon), face_of(&g), face_of(&h), face_of(&k)];
        let place = |label: usize| {
            let (face, vertex) = doo_sabin_ancestor(n as usize, label);
            step.corner[&(faces[face], index[vertex - 1])]
        };
        let fresh: Vec<usize> = (1..=extended.len()).map(place).collect();
        for (at, point) in fresh.iter().zip(&extended) {
            assert_eq!(step.mesh.points[*at].as_ref(), Some(point), "n = {n}");
        }
        net = doo_sabin::refine_local_net::<S, S>(n, &net).unwrap();
        assert_eq!(net, extended[..net.len()]);
        index = fresh[..net.len()].to_vec();
        mesh = step.mesh;
    }
}

#[test]
fn doo_sabin_nets_agree_with_brute_force() {
    for n in [3, 4, 6] {
        let size = doo_sabin::local_net_size(n);
        for unit in unit_nets::<R>(size) {
            check_doo_sabin_against_brute_force(n, &unit, 1);
        }
        check_doo_sabin_against_brute_force(n, &irregular_net::<R>(size), 3);
    }
}

#[test]
fn doo_sabin_tiles_are_the_limit_surface() {
    for n in [3, 4, 6] {
        let net = irregular_net::<R>(doo_sabin::local_net_size(n));
        let mut mesh = Mesh::new(doo_sabin_faces(n as usize), &net);
        // Centroids of faces lie on the surface; their parameters are refined like points.
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let mut parameters: Vec<Option<[R; 2]>> =
            corners.iter().map(|at| Some(at.map(|x| r(x, 1)))).collect();
        for _ in 0..4 {
            let (step, origin) = brute_force::doo_sabin_step(&mesh);
            let refined = origin.iter().map(|old| {
                let known: Vec<_> = old.iter().map(|&f| &parameters[f]).collect();
                mean(&known)
            });
            parameters = refined.collect();
            mesh = step.mesh;
        }
        let mut limits = Vec::new();
        for (face, parameter) in mesh.faces.iter().zip(&parameters) {
            let at = parameter.clone().unwrap();
            let sum: R = face.iter().map(|&v| mesh.points[v].as_ref().unwrap()).sum();
            limits.push((at, sum / r(face.len() as i64, 1)));
        }
        assert_eq!(limits.len(), 17 * 17);
        let values = tensor_tile_values(2, net.clone(), |net| {
            let extended = doo_sabin::extended_net::<R, R>(n, net).unwrap();
            let tiles = Tile::ALL.map(|tile| {
                let grid = doo_sabin::tile_net(n, tile, &extended);
                biquadratic_bezier_from_net::<R, R>(&grid).to_vec()
            });
            (doo_sabin::refine_local_net::<R, R>(n, net).unwrap(), tiles)
        });
        assert_limits(&limits, values, n);
        if n == 4 {
            let grid = doo_sabin::REGULAR_LABELS.map(|label| net[label - 1].clone());
            let bezier = biquadratic_bezier_from_net::<R, R>(&grid);
            for (at, limit) in limits {
                assert_eq!(tensor_value(2, &bezier, &at), limit);
            }
        }
    }
}
