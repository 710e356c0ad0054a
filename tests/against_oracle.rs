//! The certified enclosures against an independent dense evaluation of the limit surface.
//!
//! `tests/oracle` was written from the definitions alone, by someone who had not seen this library:
//! it subdivides the whole mesh and pushes vertices to their limits. On every net of its catalogue
//! (valences 2 to 20, several extraordinary vertices on a face, boundaries, lone polygons, tori) and
//! on random ones, no sample may lie further out than `hi` of its face, and the samples must come
//! near `lo`.

mod oracle;

use num_bigint::BigInt;
use num_rational::BigRational;
use oracle::nets::{self, Net};
use oracle::{Against as OracleAgainst, Corner, Question, Scheme as OracleScheme};
use subcert::distance::measure::{Measurement, Request, measure, measure_enclosing, measure_exact};
use subcert::distance::model::Against;
use subcert::distance::parametric::Goal;
use subcert::mesh::{Mesh, Point, Topology};
use subcert::scalar::Rational;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const SEED: u64 = 20260731;
const SCHEMES: [(OracleScheme, Scheme); 4] = [
    (
        OracleScheme::LoopOriginal,
        Scheme::Loop(LoopWeights::Original),
    ),
    (OracleScheme::LoopWarren, Scheme::Loop(LoopWeights::Warren)),
    (OracleScheme::CatmullClark, Scheme::CatmullClark),
    (OracleScheme::DooSabin, Scheme::DooSabin),
];

fn topology(net: &Net) -> Topology {
    let mut start = vec![0];
    let mut corners = Vec::new();
    for face in &net.faces {
        corners.extend(face.iter().map(|&v| v as u32));
        start.push(corners.len() as u32);
    }
    Topology::from_polygons(net.points.len(), start, corners).expect("an oriented manifold")
}

fn request(scheme: Scheme, corner: Corner, against: OracleAgainst, level: u32) -> Request {
    Request {
        scheme,
        corner: if corner == Corner::Sharp {
            CornerRule::Sharp
        } else {
            CornerRule::Smooth
        },
        level,
        against: if against == OracleAgainst::Control {
            Against::Control
        } else {
            Against::Limit
        },
        goal: Goal {
            gap: 1e-6,
            face_gap: Some(1e-2),
            ..Goal::default()
        },
    }
}

/// Every scheme, corner rule and kind of mesh that applies to a net.
fn questions(net: &Net, level: usize, depth: usize) -> Vec<(Question, Scheme)> {
    let mut list = Vec::new();
    for (scheme, ours) in SCHEMES {
        if !nets::applicable(&net.faces, scheme) {
            continue;
        }
        for corner in [Corner::Smooth, Corner::Sharp] {
            if corner == Corner::Sharp && scheme == OracleScheme::DooSabin {
                continue;
            }
            for against in [OracleAgainst::Control, OracleAgainst::Limit] {
                list.push((
                    Question {
                        scheme,
                        corner,
                        level,
                        against,
                        depth,
                    },
                    ours,
                ));
            }
        }
    }
    list
}

fn integer(x: i64) -> f64 {
    x as f64
}

/// No sample beyond hi, per face; the samples come within `tolerance` of lo, over the mesh.
fn compare(net: &Net, question: Question, found: &Measurement, tolerance: f64) {
    let mesh = oracle::Mesh {
        points: net.points.iter().map(|p| p.map(integer)).collect(),
        faces: net.faces.clone(),
    };
    let what = format!("{} {question:?}", net.name);
    let (largest, faces) = oracle::max_distance(&mesh, question);
    let largest = largest.sqrt();
    // The oracle runs in f64 here: its own errors are far below 1e-9 of coordinates up to 999.
    let noise = 1e-9;
    assert!(
        largest <= found.hi + noise,
        "{what}: sample {largest} beyond hi {}",
        found.hi
    );
    assert!(
        largest >= found.lo * (1.0 - tolerance) - noise,
        "{what}: samples reach {largest}, far from lo {}",
        found.lo
    );
    assert!(found.lo <= found.hi && found.met, "{what}: {found:?}");
    assert!(
        found.gap() <= 1e-6 || found.rounding_level,
        "{what}: gap {}",
        found.gap()
    );
    let enclosures = found
        .face_enclosures
        .as_ref()
        .expect("faces were asked for");
    assert_eq!(enclosures.len(), faces.len(), "{what}");
    // The oracle orders the faces that Doo-Sabin makes of edges and vertices in its own way.
    let common = match question.scheme {
        OracleScheme::DooSabin if question.level > 0 => net.faces.len(),
        _ => faces.len(),
    };
    for (face, (enclosure, sample)) in enclosures.iter().zip(&faces).enumerate().take(common) {
        match (enclosure, sample) {
            (None, None) => {}
            (Some([lo, hi]), Some((square, _))) => {
                assert!(lo <= hi, "{what}, face {face}");
                let distance = square.sqrt();
                assert!(
                    distance <= hi + noise,
                    "{what}, face {face}: {distance} beyond {hi}"
                );
                assert!(
                    distance >= lo * (1.0 - 3.0 * tolerance) - noise,
                    "{what}, face {face}: {distance} of {lo}"
                );
            }
            other => panic!("{what}, face {face}: surface or not? {other:?}"),
        }
    }
}

fn measure_net(net: &Net, question: Question, scheme: Scheme) -> Measurement {
    let positions = net.points.iter().map(|p| Point(p.map(integer))).collect();
    let mesh = Mesh {
        topology: topology(net),
        positions,
    };
    let request = request(
        scheme,
        question.corner,
        question.against,
        question.level as u32,
    );
    measure(&mesh, &request, &|_, _| ())
        .unwrap_or_else(|e| panic!("{} {question:?}: {e}", net.name))
}

#[test]
fn dense_samples_lie_within_the_enclosures_at_level_0() {
    for net in nets::catalogue(SEED) {
        for (question, scheme) in questions(&net, 0, 4) {
            compare(&net, question, &measure_net(&net, question, scheme), 0.1);
        }
    }
}

#[test]
fn dense_samples_lie_within_the_enclosures_at_level_1() {
    for net in nets::catalogue(SEED + 1).iter().step_by(3) {
        for (question, scheme) in questions(net, 1, 3) {
            compare(net, question, &measure_net(net, question, scheme), 0.2);
        }
    }
}

/// In exact arithmetic: samples are exact, lo^2 and hi^2 are rationals, and every comparison is
/// decided. The exact and the float enclosures must meet, and so must the interval ones.
#[test]
fn exact_samples_lie_within_exact_enclosures() {
    let rational = |x: i64| BigRational::from_integer(BigInt::from(x));
    let mut decided = 0;
    for net in nets::catalogue(SEED + 2)
        .iter()
        .filter(|net| net.faces.len() <= 8)
        .step_by(2)
    {
        for (question, scheme) in questions(net, 0, 2) {
            if !nets::is_exact(&net.faces, question.scheme) {
                continue;
            }
            let mut request = request(scheme, question.corner, question.against, 0);
            request.goal = Goal {
                gap: 1e-2,
                face_gap: None,
                ..Goal::default()
            };
            let positions: Vec<Point<Rational>> =
                net.points.iter().map(|p| Point(p.map(rational))).collect();
            let exact_mesh = Mesh {
                topology: topology(net),
                positions,
            };
            let exact = measure_exact(&exact_mesh, &request, &|_, _| ()).expect("exact masks");
            let [lower, upper] = exact.squares.as_ref().expect("squares");
            let mesh = oracle::Mesh {
                points: net.points.iter().map(|p| p.map(rational)).collect(),
                faces: net.faces.clone(),
            };
            let (largest, _) = oracle::max_distance(&mesh, question);
            let what = format!("{} {question:?}", net.name);
            assert!(largest <= *upper, "{what}: {largest} beyond {upper}");
            assert!(lower <= upper, "{what}");
            let positions = net.points.iter().map(|p| Point(p.map(integer))).collect();
            let mesh = Mesh {
                topology: topology(net),
                positions,
            };
            let float = measure(&mesh, &request, &|_, _| ()).expect("measured");
            let interval = measure_enclosing(&mesh, &request, &|_, _| ()).expect("measured");
            for other in [&float, &interval] {
                assert!(
                    exact.lo <= other.hi && other.lo <= exact.hi,
                    "{what}: disjoint enclosures"
                );
            }
            decided += 1;
        }
    }
    assert!(decided > 25, "only {decided} nets were decided exactly");
}
