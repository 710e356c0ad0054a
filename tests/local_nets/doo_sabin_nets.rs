//! Doo-Sabin's local net and tiles against brute force.

use subcert::bernstein::conversion::biquadratic_bezier_from_net;
use subcert::scalar::{Cyclotomic, Field, Rational};
use subcert::scheme::{Tile, doo_sabin};

use crate::brute_force::{self, Mesh, mean};
use crate::nets::{
    IRRATIONAL_VALENCES, assert_limits, irregular_net, tensor_tile_values, tensor_value, unit_nets,
};

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

fn check_doo_sabin_nets<S: Field>(n: u32) {
    let size = doo_sabin::local_net_size(n);
    for unit in unit_nets::<S>(size) {
        check_doo_sabin_against_brute_force(n, &unit, 1);
    }
    check_doo_sabin_against_brute_force(n, &irregular_net::<S>(size), 3);
}

#[test]
fn doo_sabin_nets_agree_with_brute_force() {
    for n in [3, 4, 6] {
        check_doo_sabin_nets::<Rational>(n);
    }
    for n in IRRATIONAL_VALENCES {
        check_doo_sabin_nets::<Cyclotomic>(n);
    }
}

fn check_doo_sabin_tiles<S: Field>(n: u32) {
    let net = irregular_net::<S>(doo_sabin::local_net_size(n));
    let mut mesh = Mesh::new(doo_sabin_faces(n as usize), &net);
    // Centroids of faces lie on the surface; their parameters are refined like points.
    let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
    let mut parameters: Vec<Option<[S; 2]>> = corners
        .iter()
        .map(|at| Some(at.map(|x| S::ratio(x, 1))))
        .collect();
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
        let points = face.iter().map(|&v| mesh.points[v].as_ref().unwrap());
        let sum = points.fold(S::zero(), |sum, point| sum + point);
        limits.push((at, doo_sabin::limit_point::<S, S>(&sum, face.len() as u32)));
    }
    assert_eq!(limits.len(), 17 * 17);
    let values = tensor_tile_values(2, net.clone(), |net| {
        let extended = doo_sabin::extended_net::<S, S>(n, net).unwrap();
        let tiles = Tile::ALL.map(|tile| {
            let grid = doo_sabin::tile_net(n, tile, &extended);
            biquadratic_bezier_from_net::<S, S>(&grid).to_vec()
        });
        (doo_sabin::refine_local_net::<S, S>(n, net).unwrap(), tiles)
    });
    assert_limits(&limits, values, n);
    if n == 4 {
        let grid = doo_sabin::REGULAR_LABELS.map(|label| net[label - 1].clone());
        let bezier = biquadratic_bezier_from_net::<S, S>(&grid);
        for (at, limit) in limits {
            assert_eq!(tensor_value(2, &bezier, &at), limit);
        }
    }
}

#[test]
fn doo_sabin_tiles_are_the_limit_surface() {
    for n in [3, 4, 6] {
        check_doo_sabin_tiles::<Rational>(n);
    }
    for n in IRRATIONAL_VALENCES {
        check_doo_sabin_tiles::<Cyclotomic>(n);
    }
}
