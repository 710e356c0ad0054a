//! What is no certificate: ways that do not fit, meshes that are none, cosines, claims, forms.

use serde_json::{Value, json};
use subcert_check::check;

use super::proposer::Example;
use super::proposer::examples::{grid, icosahedron, octahedron, prism};
use super::{verdict, with};

#[test]
fn cosines_are_those_that_the_mesh_needs() {
    let file = icosahedron().propose().file;
    assert_eq!(file["cosine"].as_array().unwrap().len(), 1);
    let entry = |n: usize, lo: &str, hi: &str| json!([n, lo, hi]);
    for (name, cosine) in [
        ("missing", Value::Null),
        ("a pair", json!(["4/5", "9/10"])),
        ("empty", json!([])),
        ("another", json!([entry(7, "9/10", "91/100")])),
        ("one more", json!([file["cosine"][0], entry(7, "9/10", "91/100")])),
        ("not decreasing", json!([file["cosine"][0], file["cosine"][0]])),
        ("not there", json!([entry(5, "41/50", "9/10")])),
        ("not there either", json!([entry(5, "4/5", "801/1000")])),
    ] {
        assert_eq!(verdict(&with(&file, &[("/cosine", cosine)])), "cosine", "{name}");
    }
    // An enclosure that is right but wide proves less: whatever is read off its middle or one of its ends is not.
    let wide = with(&file, &[("/cosine", json!([entry(5, "7/10", "9/10")]))]);
    assert!(["far", "near-mesh"].contains(&verdict(&wide)));
    // Warren's weights need none.
    let warren = Example { weights: Some("warren"), ..icosahedron() }.propose().file;
    assert!(warren["cosine"].is_null());
    let more = with(&warren, &[("/cosine", file["cosine"].clone())]);
    assert_eq!(verdict(&more), "cosine");
}

#[test]
fn ways_that_do_not_fit() {
    // hi so large that distances do not matter.
    let whole = |example: &Example, way: Value, surface: bool| {
        let count = example.faces.len();
        let pairs = example.faces.iter().map(|face| face.len());
        let facets = match (surface, example.facets) {
            (true, "triangles") => pairs.map(|m| m - 2).sum(),
            (true, _) => pairs.map(|m| if m > 4 { m } else { 1 }).sum(),
            (false, _) => count,
        };
        let cells: Vec<Value> = (0..facets).map(|i| json!([i, "", way])).collect();
        let rule = if surface { "near-surface" } else { "near-mesh" };
        let side = if surface { "mesh-to-surface" } else { "surface-to-mesh" };
        let at = if surface {
            json!({"facet": 0, "at": ["0", "0"]})
        } else {
            json!({"face": 0, "word": "", "corner": 0})
        };
        let mut file = Example { depth: 1, slack: 20.0, side, ..example.clone() }.propose().file;
        file["claim"]["lo"] = json!("0");
        file["steps"] =
            json!([{"rule": "far", "side": side, "at": at}, {"rule": rule, "cells": cells}]);
        verdict(&file)
    };
    let (mesh, surface) = (false, true);
    let cut = |example| Example { facets: "triangles", ..example };
    for (example, way, on, expected) in [
        (octahedron(), json!("match"), mesh, "verified"),
        (octahedron(), json!("match"), surface, "verified"),
        (octahedron(), json!(7), mesh, "verified"),
        (octahedron(), json!(8), mesh, "near-mesh"),
        (octahedron(), json!([7, ["0", "0"], ["1", "0"]]), mesh, "near-mesh"),
        (octahedron(), json!([7, "012", 2]), surface, "verified"),
        (octahedron(), json!([7, "012", 3]), surface, "near-surface"),
        (octahedron(), json!([8, "", 0]), surface, "near-surface"),
        (octahedron(), json!([7, "014", 0]), surface, "near-surface"),
        (octahedron(), json!("mesh"), mesh, "format"),
        // Pentagons have quarters; a flat triangle has them on the surface's side only.
        (prism(5), json!("match"), mesh, "verified"),
        (prism(5), json!("match"), surface, "verified"),
        (prism(5), json!([0, "40", 0]), surface, "verified"),
        (prism(5), json!([0, "5", 0]), surface, "near-surface"),
        (prism(5), json!([0, "44", 0]), surface, "near-surface"),
        (cut(prism(5)), json!("match"), mesh, "near-mesh"),
        (cut(prism(5)), json!("match"), surface, "near-surface"),
        (prism(3), json!("match"), mesh, "verified"),
        (prism(3), json!("match"), surface, "near-surface"),
        (prism(3), json!([0, "3", 0]), surface, "near-surface"),
        (prism(4), json!(0), mesh, "near-mesh"),
        (prism(4), json!([5, ["0", "1/2"], ["1", "1/2"]]), mesh, "verified"),
        (prism(4), json!([5, ["0", "1/2"], ["1", "1/3"]]), mesh, "near-mesh"),
        (prism(4), json!([5, ["0", "1/2"], ["2", "1/2"]]), mesh, "near-mesh"),
        (prism(4), json!([6, ["0", "1/2"], ["1", "1/2"]]), mesh, "near-mesh"),
    ] {
        assert_eq!(whole(&example, way.clone(), on), expected, "{} {way}", example.points.len());
    }
}

/// A hull of the face's own corners would prove anything here: F has them too.
#[test]
fn whole_faces_are_not_near_to_their_own_corners() {
    for example in [octahedron(), cube_like()] {
        let mut file =
            Example { side: "surface-to-mesh", slack: 1.0, ..example.clone() }.propose().file;
        file["claim"]["lo"] = json!("0");
        file["claim"]["hi"] = json!("1/100");
        let cells: Vec<Value> = (0..example.faces.len())
            .map(|i| json!([i, "", if example.scheme == "loop" { json!(i) } else { json!(2 * i) }]))
            .collect();
        file["steps"][1]["cells"] = json!(cells);
        assert_eq!(verdict(&file), "near-mesh");
    }
}

fn cube_like() -> Example {
    Example { facets: "triangles", ..prism(4) }
}

#[test]
fn meshes_that_are_none() {
    let file = octahedron().propose().file;
    let faces = |faces: Value| verdict(&with(&file, &[("/claim/faces", faces)]));
    let all = file["claim"]["faces"].as_array().unwrap();
    assert_eq!(faces(json!(all[..7])), "far", "open, but a mesh");
    assert_eq!(faces(json!([])), "mesh", "no face");
    assert_eq!(faces(json!(all[..4])), "mesh", "a vertex without a face");
    assert_eq!(faces(json!([all[0], all[2]])), "mesh", "two fans");
    assert_eq!(faces(json!([[1, 2, 3, 4], [5, 6, 1]])), "mesh", "a quad");
    assert_eq!(faces(json!([[1, 2, 7]])), "mesh", "no such vertex");
    assert_eq!(faces(json!([[1, 2, 0]])), "mesh", "vertices count from 1");
    assert_eq!(faces(json!([[1, 2, 2]])), "mesh", "a vertex twice");
    let five = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
        .map(|p| p.map(|x: i32| x.to_string()));
    let bow = with(
        &file,
        &[("/claim/faces", json!([[1, 2, 3], [1, 4, 5]])), ("/claim/vertices", json!(five))],
    );
    assert_eq!(verdict(&bow), "mesh", "two fans at one vertex");
    // Two triangles back to back have valence 2, and two pyramids joined at their tips two fans.
    let back = with(
        &file,
        &[
            ("/claim/faces", json!([[1, 2, 3], [1, 3, 2]])),
            ("/claim/vertices", json!([["0", "0", "0"], ["1", "0", "0"], ["0", "1", "0"]])),
        ],
    );
    assert_eq!(verdict(&back), "mesh");
    let nothing_inside = with(
        &file,
        &[
            ("/claim/boundary", json!("none")),
            ("/claim/faces", json!([[1, 2, 3]])),
            ("/claim/vertices", json!([["0", "0", "0"], ["1", "0", "0"], ["0", "1", "0"]])),
        ],
    );
    assert_eq!(verdict(&nothing_inside), "mesh");
}

#[test]
fn claims_that_contradict_themselves_and_forms() {
    let file = Example { vertex: Some(0.51), ..octahedron() }.propose().file;
    assert_eq!(verdict(&file), "verified");
    for (pointer, value, rule) in [
        ("/claim/lo", json!("-1/8"), "claim"),
        ("/claim/boundary", json!("crease"), "format"),
        ("/claim/level", json!(9), "format"),
        ("/claim/level", json!(1), "claim"),
        ("/claim/against", json!("limit"), "claim"),
        ("/claim/against", json!("other"), "format"),
        ("/claim/scheme", json!("doo-sabin"), "format"),
        ("/claim/scheme", json!("catmull-clark"), "format"),
        ("/claim/vertex", json!("49/100"), "vertex"),
        ("/claim/vertex", Value::Null, "format"),
        ("/claim/vertices/0/0", json!("11/10"), "vertex"),
        ("/bases", json!([[1]]), "bases"),
        ("/steps/0/side", json!("both"), "far"),
        ("/steps/0/at", json!({"face": 9, "word": "", "corner": 0}), "far"),
        ("/steps/0/at", json!({"face": 0, "word": "", "corner": 3}), "far"),
        ("/steps/0/at", json!({"face": 0, "word": "7", "corner": 0}), "far"),
        ("/steps/0/at", json!({"face": 0, "word": "9", "corner": 0}), "format"),
        ("/steps/0/at", json!({"facet": 0, "at": ["1", "1"]}), "far"),
    ] {
        let found = verdict(&with(&file, &[(pointer, value.clone())]));
        assert_eq!(found, rule, "{pointer} {value}");
    }
    let told = check(file.to_string().as_bytes()).claim.unwrap();
    assert!(!told.contains("heuristic"), "{told}");
    for words in ["Loop, Warren's weights", "6 vertices, 8 faces", "triangles", "is from 0.44"] {
        assert!(told.contains(words), "{told}");
    }
}

/// One flat triangle; its corner 0 is in the middle between the others, nearly.
fn flat() -> Example {
    Example {
        points: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 0.125, 0.0]],
        faces: vec![vec![0, 1, 2]],
        depth: 1,
        slack: 20.0,
        ..octahedron()
    }
}

#[test]
fn all_corners_count() {
    let claim = |side: &'static str, hi: &str, steps: Value| {
        let file = Example { side, ..flat() }.propose().file;
        let changes = [("/claim/lo", json!("0")), ("/claim/hi", json!(hi)), ("/steps", steps)];
        verdict(&with(&file, &changes))
    };
    let near_mesh = json!([
        {"rule": "far", "side": "surface-to-mesh", "at": {"face": 0, "word": "", "corner": 0}},
        {"rule": "near-mesh", "cells": [[0, "", "match"]]},
    ]);
    let near_surface = json!([
        {"rule": "far", "side": "mesh-to-surface", "at": {"facet": 0, "at": ["0", "0"]}},
        {"rule": "near-surface", "cells": [[0, "", [0, "", 0]]]},
    ]);
    // Corner 0 is within 1.01 of the others, and these are 2.004 from each other.
    assert_eq!(claim("surface-to-mesh", "3/2", near_mesh.clone()), "near-mesh");
    assert_eq!(claim("surface-to-mesh", "201/100", near_mesh), "verified");
    // The limit of corner 0 is (0, 1/48, 0).
    assert_eq!(claim("mesh-to-surface", "1/2", near_surface.clone()), "near-surface");
    // It is 1.0054 from the last corner.
    assert_eq!(claim("mesh-to-surface", "10053/10000", near_surface.clone()), "near-surface");
    assert_eq!(claim("mesh-to-surface", "2011/2000", near_surface), "verified");
}

#[test]
fn all_vertices_are_near_to_their_limits() {
    // The last vertex is three times as far out as the others: 3 less half of the mean of its ring, 0.
    let mut example = Example { side: "surface-to-mesh", depth: 1, slack: 20.0, ..octahedron() };
    example.points[5] = [0.0, 0.0, -3.0];
    let told = |vertex: f64| {
        let mut file = Example { vertex: Some(vertex), ..example.clone() }.propose().file;
        file["claim"]["lo"] = json!("0");
        file["claim"]["hi"] = json!("100");
        verdict(&file)
    };
    assert_eq!((told(1.49), told(1.51)), ("vertex", "verified"));
}

#[test]
fn facets_that_do_not_count_are_no_place() {
    let example = Example {
        boundary: "none",
        side: "mesh-to-surface",
        depth: 1,
        slack: 20.0,
        ..grid(4, false, |_, _| 0.0)
    };
    let mut file = example.propose().file;
    file["claim"]["lo"] = json!("0");
    let at = |facet: usize| json!({"facet": facet, "at": ["1/2", "1/2"]});
    assert_eq!(verdict(&with(&file, &[("/steps/0/at", at(4))])), "verified");
    assert_eq!(verdict(&with(&file, &[("/steps/0/at", at(3))])), "far");
    assert_eq!(verdict(&with(&file, &[("/steps/0/at", at(9))])), "far");
}

/// Regular nets in the plane z = 0 but for one more vertex that is not: it is a neighbour of the third corner, so that its
/// valence is 7, or it makes a pentagon of a quad beside the face. Without it there would be nothing above the plane.
#[test]
fn nets_with_one_more_vertex_are_not_regular() {
    let place = |p: [i32; 2]| [f64::from(p[0]), f64::from(p[1]), 0.0];
    let lattice = [
        [0, -1],
        [-1, 0],
        [1, -1],
        [0, 0],
        [-1, 1],
        [2, -1],
        [1, 0],
        [0, 1],
        [-1, 2],
        [2, 0],
        [1, 1],
        [0, 2],
    ];
    let mut triangles = octahedron();
    triangles.points = lattice.map(place).to_vec();
    triangles.points.push([-2.0, 2.0, 1.0]);
    let faces = [
        [4, 7, 8],
        [4, 8, 5],
        [4, 5, 2],
        [4, 2, 1],
        [4, 1, 3],
        [4, 3, 7],
        [7, 3, 6],
        [7, 6, 10],
        [7, 10, 11],
        [7, 11, 8],
        [8, 11, 12],
        [8, 12, 9],
        [8, 9, 13],
        [8, 13, 5],
    ];
    triangles.faces = faces.map(|face| face.map(|i| i - 1).to_vec()).to_vec();
    let mut quads = grid(4, false, |_, _| 0.0);
    quads.points.push([-1.0, 0.5, 1.0]);
    quads.faces[0].push(16);
    for (example, face) in [(triangles, 0), (quads, 4)] {
        let large = vec![[-20.0, -20.0, 0.0], [50.0, -20.0, 0.0], [-20.0, 50.0, 0.0]];
        let example = Example {
            boundary: "none",
            side: "surface-to-mesh",
            against: "other",
            other: Some((large, vec![vec![0, 1, 2]])),
            depth: 1,
            slack: 20.0,
            ..example
        };
        let mut file = example.propose().file;
        file["claim"]["lo"] = json!("0");
        file["steps"] = json!([
            {"rule": "far", "side": "surface-to-mesh", "at": {"face": face, "word": "", "corner": 0}},
            {"rule": "near-mesh", "cells": [[face, "", 0]]},
        ]);
        let told = |hi: &str| verdict(&with(&file, &[("/claim/hi", json!(hi))]));
        assert_eq!((told("1/1000"), told("1001/1000")), ("near-mesh", "verified"));
    }
}

/// The limit of (1, 1), flat but for one edge neighbour at height 1, is at `(2 + 4 (1/4 + 1/4))/36 = 1/9` for quads and at
/// `1/12` for triangles; refinement does not move it.
#[test]
fn limits_known_by_hand_are_those_of_all_levels() {
    let spike = |i: f64, j: f64| if (i, j) == (1.0, 0.0) { 1.0 } else { 0.0 };
    let below = vec![[-20.0, -20.0, -1.0], [50.0, -20.0, -1.0], [-20.0, 50.0, -1.0]];
    for (triangles, face, lo, above) in
        [(false, 4, "1111/1000", "139/125"), (true, 8, "1083/1000", "271/250")]
    {
        let example = Example {
            boundary: "none",
            side: "surface-to-mesh",
            against: "other",
            other: Some((below.clone(), vec![vec![0, 1, 2]])),
            depth: 1,
            slack: 20.0,
            ..grid(4, triangles, spike)
        };
        let file = example.propose().file;
        for word in ["", "0", "000"] {
            let at = json!({"face": face, "word": word, "corner": 0});
            let told = |lo: &str| {
                verdict(&with(&file, &[("/steps/0/at", at.clone()), ("/claim/lo", json!(lo))]))
            };
            assert_eq!((told(lo), told(above)), ("verified", "far"), "{word:?}");
        }
    }
}
