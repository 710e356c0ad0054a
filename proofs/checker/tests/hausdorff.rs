//! Certificates about Hausdorff distances: proposed in floats, verified; what is changed in them is rejected, by the
//! rule that it breaks.

mod proposer;

use proposer::{Example, V, rational};
use serde_json::{Value, json};
use subcert_check::check;

/// "verified", or the name of the rule that rejects.
fn verdict(file: &Value) -> &'static str {
    match check(file.to_string().as_bytes()).outcome {
        Ok(()) => "verified",
        Err(rejection) => rejection.rule.name(),
    }
}

fn plain(points: &[V], faces: &[&[usize]]) -> Example {
    Example {
        scheme: "loop",
        weights: Some("warren"),
        boundary: "smooth",
        points: points.to_vec(),
        faces: faces.iter().map(|f| f.iter().map(|i| i - 1).collect()).collect(),
        level: 0,
        against: "control",
        facets: "triangles",
        other: None,
        side: "both",
        depth: 5,
        slack: 0.004,
        vertex: None,
        eigen: None,
    }
}

fn tetrahedron() -> Example {
    plain(
        &[[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]],
        &[&[1, 2, 4], &[1, 4, 3], &[1, 3, 2], &[2, 3, 4]],
    )
}

#[test]
fn closed() {
    for example in [tetrahedron(), Example { weights: Some("original"), ..tetrahedron() }] {
        let start = std::time::Instant::now();
        let proposal = example.propose();
        println!("{} proposed in {:?}", proposal.distance, start.elapsed());
        let start = std::time::Instant::now();
        let found = check(proposal.file.to_string().as_bytes());
        println!("{found:?} in {:?}", start.elapsed());
        assert!(found.outcome.is_ok());
    }
}
