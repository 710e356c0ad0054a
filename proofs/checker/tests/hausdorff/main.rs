//! Certificates about Hausdorff distances: proposed in floats, verified; what is changed in them is rejected, by the
//! rule that it breaks.

mod proposer;
mod refused;

use proposer::examples::{bump, grid, icosahedron, octahedron, prism, saddle, tetrahedron};
use proposer::{Example, Proposal, rational};
use serde_json::{Value, json};
use subcert_check::check;

/// "verified", or the name of the rule that rejects.
fn verdict(file: &Value) -> &'static str {
    match check(file.to_string().as_bytes()).outcome {
        Ok(()) => "verified",
        Err(rejection) => rejection.rule.name(),
    }
}

/// The certificate with other values at some places.
fn with(file: &Value, changes: &[(&str, Value)]) -> Value {
    let mut file = file.clone();
    for (pointer, value) in changes {
        *file.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = value.clone();
    }
    file
}

/// What must be rejected whatever the example is, the distance being known to within the slack.
fn tampered(name: &str, proposal: &Proposal) {
    let (file, d) = (&proposal.file, proposal.distance);
    assert_eq!(verdict(file), "verified", "{name}: {:?}", check(file.to_string().as_bytes()));
    let rule = |step: usize| file["steps"][step]["rule"].as_str().unwrap().to_string();
    let shown = verdict(&with(
        file,
        &[("/claim/lo", json!("0")), ("/claim/hi", json!(rational(d * 0.985)))],
    ));
    assert!(shown.starts_with("near-"), "{name}: hi lowered: {shown}");
    let raised =
        [("/claim/lo", json!(rational(d * 1.01))), ("/claim/hi", json!(rational(d * 1.02)))];
    assert_eq!(verdict(&with(file, &raised)), "far", "{name}: lo raised");
    let crossed =
        [("/claim/lo", json!(rational(d * 1.02))), ("/claim/hi", json!(rational(d * 1.01)))];
    assert_eq!(verdict(&with(file, &crossed)), "claim", "{name}: lo above hi");
    for step in 1..file["steps"].as_array().unwrap().len() {
        let Some(cells) = file["steps"][step]["cells"].as_array() else { continue };
        let pointer = format!("/steps/{step}/cells");
        for index in [0, cells.len() / 2, cells.len() - 1] {
            let mut less = cells.clone();
            let cell = less.remove(index);
            let missing = with(file, &[(&pointer, json!(less))]);
            assert_eq!(verdict(&missing), rule(step), "{name}: cell {index} missing");
            let mut more = cells.clone();
            more.push(cell);
            let doubled = with(file, &[(&pointer, json!(more))]);
            assert_eq!(verdict(&doubled), rule(step), "{name}: cell {index} doubled");
            let deeper = format!("{pointer}/{index}/1");
            let word = format!("{}0", cells[index][1].as_str().unwrap());
            let part = with(file, &[(&deeper, json!(word))]);
            assert_eq!(verdict(&part), rule(step), "{name}: cell {index} is a part of itself");
            let whole = with(file, &[(&format!("{pointer}/{index}/0"), json!(1 << 20))]);
            assert_eq!(verdict(&whole), rule(step), "{name}: no such face");
        }
        // The order is free.
        let turned: Vec<_> = cells.iter().rev().collect();
        assert_eq!(verdict(&with(file, &[(&pointer, json!(turned))])), "verified", "{name}");
    }
    let mut steps = file["steps"].as_array().unwrap().clone();
    steps.rotate_left(1);
    assert_eq!(verdict(&with(file, &[("/steps", json!(steps))])), "format", "{name}: order");
    steps.pop();
    assert_eq!(verdict(&with(file, &[("/steps", json!(steps))])), "format", "{name}: no far");
    let mut faces = file["claim"]["faces"].as_array().unwrap().clone();
    faces.push(faces[0].clone());
    let twice = with(file, &[("/claim/faces", json!(faces))]);
    assert_eq!(verdict(&twice), "mesh", "{name}: a face twice");
    faces.pop();
    let turned: Vec<_> = faces[0].as_array().unwrap().iter().rev().collect();
    let turned = with(file, &[("/claim/faces/0", json!(turned))]);
    assert_eq!(verdict(&turned), "mesh", "{name}: a face turned");
}

#[test]
fn closed_triangle_meshes() {
    let original = |example| Example { weights: Some("original"), ..example };
    for (name, example) in [
        ("tetrahedron", tetrahedron()),
        ("tetrahedron, original", original(tetrahedron())),
        ("octahedron", Example { vertex: Some(0.501), ..octahedron() }),
        ("octahedron, original", original(octahedron())),
        ("icosahedron, original", icosahedron()),
        (
            "icosahedron to mesh",
            Example { side: "surface-to-mesh", depth: 5, slack: 0.08, ..icosahedron() },
        ),
        ("icosahedron from mesh", Example { side: "mesh-to-surface", ..icosahedron() }),
        ("octahedron, limit", Example { against: "limit", depth: 6, slack: 0.15, ..octahedron() }),
        ("octahedron, level 1", Example { level: 1, depth: 5, slack: 0.2, ..octahedron() }),
        (
            "tetrahedron, level 1, limit",
            Example { level: 1, against: "limit", depth: 4, slack: 0.1, ..tetrahedron() },
        ),
    ] {
        tampered(name, &example.propose());
    }
}

#[test]
fn polygon_meshes() {
    let triangles = |example| Example { facets: "triangles", ..example };
    let limit = |example| Example { against: "limit", slack: 0.07, ..example };
    for (name, example) in [
        ("box", prism(4)),
        ("box, triangles", triangles(prism(4))),
        ("box, limit", limit(prism(4))),
        ("box, level 1", Example { level: 1, slack: 0.3, ..prism(4) }),
        ("pentagons", prism(5)),
        ("pentagons, triangles", triangles(prism(5))),
        ("triangles and quads", prism(3)),
        ("triangles and quads, limit", limit(prism(3))),
        ("hexagons, to mesh", Example { side: "surface-to-mesh", slack: 0.3, ..prism(6) }),
        ("nine sides, from mesh", Example { side: "mesh-to-surface", ..prism(9) }),
        ("nine sides, level 1, triangles", Example { level: 1, slack: 0.3, ..triangles(prism(9)) }),
    ] {
        tampered(name, &example.propose());
    }
}

#[test]
fn open_meshes() {
    let sharp = |example| Example { boundary: "sharp", ..example };
    let none = |example| Example { boundary: "none", ..example };
    for (name, example) in [
        ("triangles, smooth", grid(4, true, bump)),
        ("triangles, sharp", sharp(grid(4, true, bump))),
        ("triangles, none", none(grid(5, true, bump))),
        ("quads, smooth", grid(4, false, bump)),
        ("quads, sharp", sharp(grid(4, false, bump))),
        ("quads, none", none(grid(5, false, bump))),
        (
            "quads, sharp, level 1, limit",
            Example { level: 1, against: "limit", slack: 0.6, ..sharp(grid(4, false, bump)) },
        ),
        ("one triangle", grid(2, true, |i, _| i)),
    ] {
        tampered(name, &example.propose());
    }
}

/// Translations of the plane: the distance is known.
fn shifted(boundary: &'static str, facets: &'static str) -> Example {
    let base = grid(4, false, |_, _| 0.0);
    let (x, y, z) = (3.0, 3.0, 0.375);
    let other = vec![[0.0, 0.0, z], [x, 0.0, z], [x, y, z], [0.0, y, z]];
    let faces = vec![vec![0, 1, 2, 3]];
    Example { boundary, facets, against: "other", other: Some((other, faces)), depth: 4, ..base }
}

fn over_a_triangle(boundary: &'static str) -> Example {
    let corners = vec![[-10.0, -10.0, 0.375], [20.0, -10.0, 0.375], [-10.0, 20.0, 0.375]];
    Example { other: Some((corners, vec![vec![0, 1, 2]])), ..shifted(boundary, "triangles") }
}

#[test]
fn another_mesh_at_a_known_distance() {
    // The surface is the square itself. Each part must be near to one triangle or segment, so the upper end is above.
    for (facets, slack) in [("triangles", 0.12), ("bilinear", 0.12)] {
        let proposal = Example { slack, ..shifted("sharp", facets) }.propose();
        let file = &proposal.file;
        assert!((proposal.distance - 0.375).abs() < 1e-12);
        assert_eq!(verdict(file), "verified");
        // A facet that is nearer, wherever it is in the list, and its vertices first or last.
        for first in [true, false] {
            let near = json!([["1", "1", "0"], ["2", "1", "0"], ["1", "2", "0"]]);
            let mut other = file["claim"]["other"].clone();
            other["vertices"].as_array_mut().unwrap().extend(near.as_array().unwrap().clone());
            let faces = other["faces"].as_array_mut().unwrap();
            faces.insert(if first { 0 } else { faces.len() }, json!([5, 6, 7]));
            let nearer = with(file, &[("/claim/other", other)]);
            assert!(["far", "near-surface", "near-mesh"].contains(&verdict(&nearer)), "{first}");
            let side = file["steps"][0]["side"].as_str().unwrap();
            let only = with(&nearer, &[("/claim/side", json!(side))]);
            let from_mesh = side == "mesh-to-surface";
            let mut steps = only["steps"].as_array().unwrap().clone();
            steps.remove(if from_mesh { 1 } else { 2 });
            // Over the corner (0, 0) the shifted square is still the nearest: take a point above the new facet.
            if !from_mesh {
                let over = (0..9).map(|face| {
                    let at = json!({"face": face, "word": "", "corner": 2});
                    let mut steps = steps.clone();
                    steps[0]["at"] = at;
                    verdict(&with(&only, &[("/steps", json!(steps))]))
                });
                assert!(over.into_iter().any(|verdict| verdict == "far"));
            }
        }
    }
    // Over one large triangle both ends are near to 3/8.
    let large = Example { side: "surface-to-mesh", slack: 1e-8, ..over_a_triangle("sharp") };
    tampered("over a triangle", &large.propose());
    // With a smooth boundary the surface does not reach the corners; without rule only the inner quad counts.
    let smooth = Example { depth: 4, slack: 0.12, ..shifted("smooth", "triangles") };
    tampered("smooth", &smooth.propose());
    let none = Example { side: "surface-to-mesh", slack: 1e-8, ..over_a_triangle("none") };
    tampered("none", &none.propose());
    // The boundary rule matters: what is proved with one is not with another.
    for (made, told) in [("sharp", "smooth"), ("smooth", "sharp")] {
        let file = Example { depth: 4, slack: 0.12, ..shifted(made, "triangles") }.propose().file;
        let other = with(&file, &[("/claim/boundary", json!(told))]);
        assert_ne!(verdict(&other), "verified", "{made} as {told}");
    }
}

/// The quadratic `i^2 + ij + j^2` (triangles) or `i^2 + j^2` (quads) in the middle of a grid: by hand, over the face at
/// the origin S - F is `1/2 + i^2 + ij + j^2 - i - j`, or `2/3 + i^2 - i + j^2 - j`, with the largest coefficient,
/// 1/2 or 2/3, at the corners and coefficients of at most half of that elsewhere.
#[test]
fn matched_parts_have_the_coefficients_known_by_hand() {
    for (triangles, largest) in [(true, 0.5), (false, 2.0 / 3.0)] {
        let f = |i: f64, j: f64| {
            let (i, j) = (i - 1.0, j - 1.0);
            i * i + j * j + if triangles { i * j } else { 0.0 }
        };
        let example = Example { boundary: "none", depth: 0, slack: 0.0, ..grid(4, triangles, f) };
        let inner: Vec<usize> = if triangles { vec![8, 9] } else { vec![4] };
        let mut file =
            Example { depth: 1, slack: 20.0, side: "surface-to-mesh", ..example }.propose().file;
        file["claim"]["side"] = json!("both");
        file["claim"]["lo"] = json!("0");
        for cells in
            [vec![""], vec!["0", "1", "2", "3"], vec!["0", "1", "20", "21", "22", "23", "3"]]
        {
            let cells = inner
                .iter()
                .flat_map(|face| cells.iter().map(move |word| json!([face, word, "match"])));
            let cells: Vec<Value> = cells.collect();
            file["steps"] = json!([file["steps"][0], {"rule": "near-mesh", "cells": cells},
                {"rule": "near-surface", "cells": cells}]);
            file["claim"]["hi"] = json!(rational(largest + 1e-15));
            assert_eq!(verdict(&file), "verified", "{:?}", check(file.to_string().as_bytes()));
            file["claim"]["hi"] = json!(rational(largest - 1e-15));
            assert_eq!(verdict(&file), "near-mesh");
            file["claim"]["side"] = json!("mesh-to-surface");
            let mut only = file.clone();
            only["steps"].as_array_mut().unwrap().remove(1);
            only["steps"][0] = json!({"rule": "far", "side": "mesh-to-surface",
                "at": {"facet": inner[0], "at": ["0", "0"]}});
            assert_eq!(verdict(&only), "near-surface");
            only["claim"]["hi"] = json!(rational(largest + 1e-15));
            assert_eq!(verdict(&only), "verified");
            file["claim"]["side"] = json!("both");
        }
    }
}

#[test]
fn the_saddle_of_valence_8() {
    let proposal = saddle().propose();
    // 0.116805871, by a search in floats of its own; its largest vertex distance there is 0.039552146.
    assert!((proposal.distance - 0.1168).abs() < 1e-3, "{}", proposal.distance);
    tampered("saddle", &proposal);
    let file = &proposal.file;
    let told = check(file.to_string().as_bytes()).claim.unwrap();
    for words in
        ["the spline over S_8 of frequency 2", "the vertex heuristic is no bound", "0.000000004"]
    {
        assert!(told.contains(words), "{told}");
    }
    let vertex = |x: &str| verdict(&with(file, &[("/claim/vertex", json!(x))]));
    assert_eq!((vertex("791/20000"), vertex("989/25000")), ("vertex", "verified"));
    // Another point, which is no farther than lo: the centre, which is on both. Another facet.
    let centre = json!({"face": 0, "word": "", "corner": 0});
    assert_eq!(verdict(&with(file, &[("/steps/0/at", centre)])), "far");
    let cells = file["steps"][1]["cells"].as_array().unwrap();
    let index = cells.iter().position(|cell| cell[2].is_u64()).unwrap();
    let opposite = json!((cells[index][2].as_u64().unwrap() + 16) % 32);
    let elsewhere = with(file, &[(&format!("/steps/1/cells/{index}/2"), opposite)]);
    assert_eq!(verdict(&elsewhere), "near-mesh");
    // Moved by more than the bound; the order of the vertices; another amplitude or frequency.
    let x = file["claim"]["vertices"][3].clone();
    for (axis, by) in (0..3).flat_map(|axis| [(axis, 3e-9), (axis, -3e-9)]) {
        let moved = saddle().points[20][axis] + by;
        let moved = [(&*format!("/claim/vertices/20/{axis}"), json!(rational(moved)))];
        assert_eq!(verdict(&with(file, &moved)), "mesh");
    }
    let mut faces = file["claim"]["faces"].as_array().unwrap().clone();
    faces.swap(0, 4);
    assert_eq!(verdict(&with(file, &[("/claim/faces", json!(faces))])), "mesh");
    let exchanged =
        [("/claim/vertices/3", file["claim"]["vertices"][4].clone()), ("/claim/vertices/4", x)];
    assert_eq!(verdict(&with(file, &exchanged)), "mesh");
    for (pointer, value, rule) in [
        ("/claim/eigen/amplitude", json!("1000001/1000000"), "mesh"),
        ("/claim/eigen/frequency", json!(3), "mesh"),
        ("/claim/eigen/frequency", json!(1), "claim"),
        ("/claim/eigen/frequency", json!(5), "claim"),
        ("/claim/eigen/valence", json!(9), "cosine"),
        ("/claim/eigen/within", json!("-1"), "claim"),
        ("/claim/eigen/within", json!("1/1000000000000000000"), "mesh"),
        ("/claim/boundary", json!("smooth"), "claim"),
    ] {
        assert_eq!(verdict(&with(file, &[(pointer, value.clone())])), rule, "{pointer} {value}");
    }
}

/// Over each face in turn there is a point, (±1, ±1, ±1), that is nearer to the surface over this face than to all others,
/// by more than a hundredth.
#[test]
fn no_face_is_left_out() {
    let example = octahedron();
    for face in &example.faces {
        let corners = [0, 1, 2].map(|i| example.points[face[i]]);
        let point = [0, 1, 2].map(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>());
        let beside = |axis: usize| {
            let mut beside = point;
            beside[axis] *= 1.0 + 1.0 / 65536.0;
            beside
        };
        let other = (vec![point, beside(0), beside(1)], vec![vec![0, 1, 2]]);
        let side = "mesh-to-surface";
        let example =
            Example { against: "other", other: Some(other), side, slack: 1.0, ..example.clone() };
        let Proposal { mut file, distance } = example.propose();
        file["steps"][0]["at"] = json!({"facet": 0, "at": ["0", "0"]});
        file["claim"]["lo"] = json!(rational(distance * 0.995));
        assert_eq!(verdict(&file), "verified", "{:?}", check(file.to_string().as_bytes()));
        file["claim"]["lo"] = json!(rational(distance * 1.005));
        assert_eq!(verdict(&file), "far");
    }
}
