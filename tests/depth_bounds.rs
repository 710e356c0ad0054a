//! The bounds of `predict::differences` against certified distances: never below, on any mesh.

use num_traits::ToPrimitive;
use proptest::prelude::*;
use subcert::bound::{Against as Constants, Constant, Prover};
use subcert::distance::measure::{Request as Measured, measure};
use subcert::distance::model::Against;
use subcert::distance::parametric::Goal;
use subcert::mesh::{Mesh, Point, Topology, io};
use subcert::predict::differences::{Bounds, Request};
use subcert::refine::refine;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const SCHEMES: [Scheme; 4] = [
    Scheme::Loop(LoopWeights::Original),
    Scheme::Loop(LoopWeights::Warren),
    Scheme::CatmullClark,
    Scheme::DooSabin,
];

/// Certified lower bounds of the distance at a level: of the mesh, and of the surface over each of its faces.
fn least(mesh: &Mesh, request: &Request, level: u32) -> Option<(f64, Vec<f64>)> {
    let measured = Measured {
        scheme: request.scheme,
        corner: request.corner,
        level,
        against: match request.against {
            Constants::Control => Against::Control,
            Constants::Limit => Against::Limit,
        },
        goal: Goal {
            gap: 0.05,
            face_gap: Some(0.05),
            ..Goal::default()
        },
    };
    let found = measure(mesh, &measured, &|_, _| ()).ok()?;
    let mut faces = vec![0.0_f64; mesh.topology.face_count() as usize];
    let all = found.face_enclosures.unwrap_or_default();
    for (face, enclosure) in all.iter().enumerate() {
        // Children of triangles are numbered four by four; of others only the mesh itself is compared.
        let parent = match request.scheme {
            Scheme::Loop(_) => face >> (2 * level),
            _ if level == 0 => face,
            _ => continue,
        };
        let lo = enclosure.map_or(0.0, |[lo, _]| lo);
        faces[parent] = faces[parent].max(lo);
    }
    Some((found.lo, faces))
}

/// No bound is below the distance at the levels given; whether the scheme applies.
fn check(mesh: &Mesh, request: &Request, levels: u32, name: &str) -> bool {
    let Ok(bounds) = Bounds::new(mesh, request) else {
        return false;
    };
    for level in 0..=levels {
        let Some((lo, of_faces)) = least(mesh, request, level) else {
            return false;
        };
        let bound = bounds.at(level);
        assert!(
            bound >= lo,
            "{name}, {request:?}, level {level}: {bound} < {lo}"
        );
        let faces = bounds.face_bounds(level);
        for (face, (own, lo)) in faces.iter().zip(&of_faces).enumerate() {
            assert!(
                own >= lo,
                "{name}, {request:?}, level {level}, face {face}: {own} < {lo}"
            );
        }
        let largest = faces.into_iter().fold(0.0, f64::max);
        assert!(
            largest >= lo,
            "{name}, {request:?}, level {level}: faces {largest} < {lo}"
        );
        // A face takes the best of its own stages: at most the mesh's bound.
        assert!(largest <= bound * 1.000_001 || request.scheme == Scheme::DooSabin);
    }
    true
}

/// Random nets of the property test: `SUBCERT_NETS` of them, or a few.
fn cases() -> u32 {
    let asked = std::env::var("SUBCERT_NETS").ok();
    asked.and_then(|text| text.parse().ok()).unwrap_or(300)
}

/// The local net of Stam's numbering as an open mesh, its heights in z; the face is the last.
fn of_local_net(n: u32, heights: &[f64]) -> Mesh {
    let mut faces: Vec<[u32; 3]> = (2..=n).map(|i| [1, i, i + 1]).collect();
    faces.extend([
        [2, n + 1, n + 2],
        [2, n + 2, n + 3],
        [2, n + 3, n + 4],
        [2, n + 4, 3],
    ]);
    faces.extend([
        [n + 1, n + 5, n + 2],
        [n + 1, n + 6, n + 5],
        [n + 1, n, n + 6],
    ]);
    faces.push([1, n + 1, 2]);
    let corners = faces.into_iter().flatten().map(|v| v - 1).collect();
    Mesh {
        topology: Topology::from_uniform(heights.len(), 3, corners).expect("a disc"),
        positions: heights.iter().map(|&z| Point([0.0, 0.0, z])).collect(),
    }
}

/// The dual nets of the programs have M = 1 and attain C_k: at the face the bound is C_k, and the distance too.
#[test]
fn nets_of_the_programs_attain_the_bounds() {
    for n in [5, 7, 8, 9, 12] {
        let mut prover = Prover::new(LoopWeights::Original, n);
        for k in 0..=2 {
            let proof = prover.prove(Constant::Distance(Constants::Control, k), 1e-6);
            let proof = proof.expect("a proof");
            let net = prover.candidate(proof.net).net_rationals();
            let heights: Vec<f64> = net.iter().map(|y| y.to_f64().expect("a number")).collect();
            let mesh = of_local_net(n, &heights);
            let request = Request {
                scheme: SCHEMES[0],
                corner: CornerRule::Smooth,
                against: Constants::Control,
                local_steps: 0,
            };
            assert!(check(&mesh, &request, 2, "a net of a program"));
            let bounds = Bounds::new(&mesh, &request).expect("triangles");
            let level = k as u32;
            let bound = *bounds.face_bounds(level).last().expect("faces");
            let (_, lo) = least(&mesh, &request, level).expect("a distance");
            let lo = *lo.last().expect("faces");
            assert!(lo * 1.06 >= bound, "n = {n}, k = {k}: {lo} and {bound}");
            assert!(
                bound >= proof.lo && bound <= proof.hi * 1.003,
                "{bound}, {proof:?}"
            );
        }
    }
}

/// A regular polygon of heights whose second differences along all lines of the lattice are 0: only its diameter
/// makes M, and the surface is not the mesh.
#[test]
fn a_regular_polygon_under_doo_sabin_has_a_distance() {
    for n in [3, 5, 6, 7, 9] {
        let p = |j: u32| (std::f64::consts::TAU * f64::from(j - 1) / f64::from(n)).cos();
        let mut heights: Vec<f64> = (1..=n).map(p).collect();
        // Labels of the local net: beyond P2 and Pn, P1 and the corner between.
        let after = 2.0 * p(2) - p(if n == 3 { n } else { 3 });
        let before = 2.0 * p(n) - p(n - 1);
        let [x, y] = [2.0 * p(1) - p(n), 2.0 * p(1) - p(2)];
        heights.extend([after, x, 2.0 * x - after, y, before]);
        let faces = [
            (1..=n).collect::<Vec<u32>>(),
            vec![1, n + 2, n + 1, 2],
            vec![1, n + 4, n + 3, n + 2],
            vec![1, n, n + 5, n + 4],
        ];
        let start = faces.iter().scan(0, |sum, face| {
            *sum += face.len() as u32;
            Some(*sum)
        });
        let start = std::iter::once(0).chain(start).collect();
        let corners = faces.concat().into_iter().map(|v| v - 1).collect();
        let mesh = Mesh {
            topology: Topology::from_polygons(heights.len(), start, corners).expect("a disc"),
            positions: heights.iter().map(|&z| Point([0.0, 0.0, z])).collect(),
        };
        let request = Request {
            scheme: Scheme::DooSabin,
            corner: CornerRule::Smooth,
            against: Constants::Control,
            local_steps: 0,
        };
        assert!(check(&mesh, &request, 2, "a regular polygon"));
        let (lo, _) = least(&mesh, &request, 0).expect("a distance");
        assert!(lo > 0.01, "n = {n}: {lo}");
    }
}

fn requests(scheme: Scheme) -> impl Iterator<Item = Request> {
    let against = [Constants::Control, Constants::Limit];
    let corners = [CornerRule::Smooth, CornerRule::Sharp];
    let all = against.into_iter().flat_map(move |against| {
        corners.into_iter().flat_map(move |corner| {
            (0..=2).map(move |local_steps| Request {
                scheme,
                corner,
                against,
                local_steps,
            })
        })
    });
    // Doo-Sabin has no boundary rule, and no constants for limit meshes.
    all.filter(move |r| {
        scheme != Scheme::DooSabin
            || r.corner == CornerRule::Smooth && r.against == Constants::Control
    })
}

#[test]
fn bounds_of_sample_meshes_are_not_below_certified_distances() {
    let mut checked = 0;
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/meshes");
    for entry in std::fs::read_dir(folder).expect("the sample meshes") {
        let path = entry.expect("a file").path();
        let Ok(loaded) = io::read(&path) else {
            continue;
        };
        if loaded.mesh.topology.face_count() > 600 {
            continue;
        }
        for scheme in SCHEMES {
            for request in requests(scheme) {
                let name = path.display().to_string();
                checked += u32::from(check(&loaded.mesh, &request, 2, &name));
            }
        }
    }
    assert!(checked > 100, "{checked}");
}

/// A disc of triangles round a vertex of valence n, or half a disc of m triangles at a boundary vertex, with a
/// second ring where faces are to be regular, and random or extreme coordinates.
fn fan(n: usize, open: bool, quads: bool) -> (Vec<u32>, Vec<u32>, usize) {
    // The vertices: 0; ring i: 1 + i; outer ring.
    let sectors = n;
    let ring = if open { n + 1 } else { n };
    let (mut start, mut corners) = (vec![0u32], Vec::new());
    let mut face = |face: &[usize]| {
        corners.extend(face.iter().map(|&v| v as u32));
        start.push(corners.len() as u32);
    };
    let x = |i: usize| 1 + i % ring;
    if quads {
        // Quads (0, x_i, d_i, x_(i+1)), and a second ring of quads round them.
        let d = |i: usize| 1 + ring + i % sectors;
        for i in 0..sectors {
            face(&[0, x(i), d(i), x(i + 1)]);
        }
        let outer = 1 + ring + sectors;
        // Round the rim: x_0, d_0, x_1, d_1, ..
        let rim: Vec<usize> = (0..sectors).flat_map(|i| [x(i), d(i)]).collect();
        let mut rim = rim;
        if open {
            rim.push(x(sectors));
        }
        let steps = if open { rim.len() - 1 } else { rim.len() };
        for i in 0..steps {
            let j = (i + 1) % rim.len();
            face(&[rim[i], outer + i, outer + j, rim[j]]);
        }
        return (start, corners, outer + rim.len());
    }
    for i in 0..sectors {
        face(&[0, x(i), x(i + 1)]);
    }
    let outer = 1 + ring;
    let steps = if open { ring - 1 } else { ring };
    for i in 0..steps {
        let j = (i + 1) % ring;
        face(&[1 + i, outer + i, 1 + j]);
        face(&[1 + j, outer + i, outer + j]);
    }
    (start, corners, outer + ring)
}

fn nets() -> impl Strategy<Value = (Mesh, bool)> {
    let shape = (3usize..31, any::<bool>(), any::<bool>(), any::<bool>());
    shape.prop_flat_map(|(n, open, quads, extreme)| {
        let n = if open { n - 2 } else { n };
        let (start, corners, count) = fan(n, open, quads);
        let coordinate = match extreme {
            // Signs alone: nets as of the programs' duals.
            true => prop_oneof![Just(-1.0), Just(0.0), Just(1.0)].boxed(),
            false => (-1.0..1.0).boxed(),
        };
        let points =
            prop::collection::vec([coordinate.clone(), coordinate.clone(), coordinate], count);
        points.prop_map(move |points| {
            let topology = Topology::from_polygons(count, start.clone(), corners.clone());
            let mesh = Mesh {
                topology: topology.expect("a disc"),
                positions: points.into_iter().map(Point).collect(),
            };
            (mesh, quads)
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]

    #[test]
    fn bounds_of_random_nets_are_not_below_certified_distances((mesh, quads) in nets(), steps in 0u32..3, limit: bool, sharp: bool, which in 0usize..2) {
        let request = Request {
            scheme: if quads { SCHEMES[2 + which] } else { SCHEMES[which] },
            corner: if sharp && which == 0 { CornerRule::Sharp } else { CornerRule::Smooth },
            against: if limit { Constants::Limit } else { Constants::Control },
            local_steps: steps,
        };
        if request.scheme != Scheme::DooSabin || !limit {
            check(&mesh, &request, 2, "random");
        }
    }
}

proptest! {
    /// Loop's step by formula against the same step taken: the lengths are the same, whatever the valences and the
    /// boundary.
    #[test]
    fn a_step_by_formula_is_a_step((mesh, quads) in nets(), sharp: bool, which in 0usize..2) {
        prop_assume!(!quads);
        let request = |local_steps| Request {
            scheme: SCHEMES[which],
            corner: if sharp { CornerRule::Sharp } else { CornerRule::Smooth },
            against: Constants::Control,
            local_steps,
        };
        let fine = refine(request(0).scheme, request(0).corner, &mesh, 1).expect("triangles");
        let table = Bounds::new(&mesh, &request(0)).expect("bounds");
        let formula = Bounds::new(&mesh, &request(1)).expect("bounds");
        let taken = Bounds::new(&fine, &request(0)).expect("bounds");
        for k in 1..=6 {
            // Of the bounds without and with the step the less counts.
            let least = taken.at(k - 1).min(table.at(k));
            prop_assert!((formula.at(k) - least).abs() <= 1e-12 * least, "{k}: {} {least}", formula.at(k));
        }
    }
}
