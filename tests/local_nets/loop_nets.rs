//! Loop's local net and tiles against brute force.

use subcert::bernstein::conversion::box_spline_bezier_from_net;
use subcert::scalar::{Cyclotomic, Field, Rational};
use subcert::scheme::loop_scheme::{LevelOnePoint, level_one_point};
use subcert::scheme::{LoopWeights, Tile, loop_scheme};

use crate::brute_force::{self, Mesh, Step, edge, refine_parameters};
use crate::nets::{IRRATIONAL_VALENCES, irregular_net, rational_cases, unit_nets};

/// The faces of the local net as 0-based indices, from the rings of P1, P2 and P(n+1).
pub fn loop_faces(n: usize) -> Vec<Vec<usize>> {
    let last = n + 1;
    let mut faces: Vec<[usize; 3]> = (2..last).map(|i| [1, i, i + 1]).collect();
    faces.push([1, last, 2]);
    faces.extend([
        [2, last, n + 2],
        [2, n + 2, n + 3],
        [2, n + 3, n + 4],
        [2, n + 4, 3],
    ]);
    faces.extend([[last, n, n + 6], [last, n + 6, n + 5], [last, n + 5, n + 2]]);
    faces
        .into_iter()
        .map(|face| face.map(|label| label - 1).to_vec())
        .collect()
}

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

fn check_loop_nets<S: Field>(weights: LoopWeights, n: u32) {
    let size = loop_scheme::local_net_size(n);
    for unit in unit_nets::<S>(size) {
        check_loop_against_brute_force(weights, n, &unit, 1);
    }
    check_loop_against_brute_force(weights, n, &irregular_net::<S>(size), 3);
}

#[test]
fn loop_nets_agree_with_brute_force() {
    for (weights, n) in rational_cases(12) {
        check_loop_nets::<Rational>(weights, n);
    }
    for n in IRRATIONAL_VALENCES {
        check_loop_nets::<Cyclotomic>(LoopWeights::Original, n);
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
        check_loop_tiles::<Rational>(weights, n);
    }
    for n in IRRATIONAL_VALENCES {
        check_loop_tiles::<Cyclotomic>(LoopWeights::Original, n);
    }
}

#[test]
fn regular_labels_turn_the_local_net_into_the_regular_patch() {
    let net = irregular_net::<Rational>(12);
    let regular = loop_scheme::REGULAR_LABELS.map(|label| net[label - 1].clone());
    let bezier = box_spline_bezier_from_net::<Rational, Rational>(&regular);
    for (at, value) in loop_tile_values(LoopWeights::Original, 6, &net) {
        assert_eq!(triangle_value(&bezier, &at), value);
    }
}
