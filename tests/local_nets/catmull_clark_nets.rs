//! Catmull-Clark's local net and tiles against brute force.

use subcert::bernstein::conversion::bicubic_bezier_from_net;
use subcert::scalar::{Field, Rational as R};
use subcert::scheme::{Tile, catmull_clark};

use crate::brute_force::{self, Mesh, Step, edge, refine_parameters};
use crate::nets::{assert_limits, irregular_net, tensor_tile_values, unit_nets};

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

#[test]
fn catmull_clark_tiles_are_the_limit_surface() {
    for n in 3..=8 {
        let net = irregular_net::<R>(catmull_clark::local_net_size(n));
        let mut mesh = Mesh::new(catmull_clark_faces(n as usize), &net);
        let mut parameters = vec![None; net.len()];
        for (label, at) in [(1, [0, 0]), (4, [0, 1]), (5, [1, 1]), (6, [1, 0])] {
            parameters[label - 1] = Some(at.map(|x| R::ratio(x, 1)));
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
