//! Depths by every method, against numbers derived by hand, against measured distances, and against the verdicts
//! of the papers' examinations.

use std::path::{Path, PathBuf};

use subcert::bound::{Against, Constant, Prover};
use subcert::depth::printed::huang_wang::{Constants, LAMBDA};
use subcert::depth::printed::{cheng_yong, verdict};
use subcert::depth::{Answer, Method, Metric, Request, heuristic, predict};
use subcert::distance::measure::{self, measure};
use subcert::distance::model;
use subcert::distance::parametric::Goal;
use subcert::mesh::Mesh;
use subcert::mesh::io::{Format, parse, read};
use subcert::paper::{self, Report, Verdict};
use subcert::predict::Estimator;
use subcert::scalar::float::round_up;
use subcert::scalar::{Field, Rational, Ring};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const LOOP: Scheme = Scheme::Loop(LoopWeights::Original);

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn example(name: &str) -> Mesh {
    read(file("examples/meshes").join(name))
        .expect("a mesh")
        .mesh
}

fn octahedron() -> Mesh {
    let text = b"v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
        f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
    parse(text, Format::Obj, "octahedron").expect("a mesh").mesh
}

fn cube() -> Mesh {
    let text =
        b"v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
        f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    parse(text, Format::Obj, "cube").expect("a mesh").mesh
}

fn request(scheme: Scheme, against: Against, tolerance: f64) -> Request {
    Request {
        scheme,
        corner: CornerRule::Smooth,
        against,
        metric: Metric::Parametric,
        tolerance,
    }
}

fn one(mesh: &Mesh, request: &Request, method: Method) -> Answer {
    let answers = predict(mesh, request, &[method]).expect("the scheme takes the mesh");
    answers.into_iter().next().expect("an answer")
}

fn near(x: Option<f64>, y: f64) -> bool {
    x.is_some_and(|x| (x - y).abs() <= 1e-5 * y)
}

/// By hand. One Catmull-Clark step takes the corner (1, 1, 1) to 5/9 (1, 1, 1), edges to (3/4, 3/4, 0), faces to
/// (1, 0, 0): every face then has one vertex of valence 3. Longest first difference: two edge points of a face,
/// (0, 3/4, 3/4), G = 3 √2 / 4; longest second difference 2 (3/4, 3/4, 0) - (1, 0, 0) - (0, 1, 0), Z = √2 / 2.
///
/// ε = 1/2: 7/2 G / ε = 7.4246 lies between (4/3)^6 = 5.62 and (4/3)^7 = 7.49: n_ε = 7. (2/3)^k Z / (3 ε) =
/// 0.4714 (2/3)^k < 1, so no l_k is positive: D = 7, after the step that separates. 7/2 G (3/4)^7 = 0.49554.
#[test]
fn cheng_yong_on_a_cube() {
    let found = one(
        &cube(),
        &request(Scheme::CatmullClark, Against::Control, 0.5),
        Method::ChengYong,
    );
    assert_eq!((found.depth, found.safe), (Some(8), true), "{found:?}");
    let g = 0.75 * 2f64.sqrt();
    assert!(
        near(found.bound_at_depth, 3.5 * g * 0.75f64.powi(7)),
        "{found:?}"
    );
    assert!(
        found.why.contains("theorem-9") && found.why.contains("1 step"),
        "{}",
        found.why
    );
}

/// By hand. One step of Loop's scheme takes (1, 0, 0) to (33/64, 0, 0), edges to 3/8 (1, 1, 0). The second difference of
/// an edge between the two is (9, 24, 0) / 64, that of an edge between edge points (15, 0, 0) / 64: M = √657 / 64 =
/// 0.40050, at vertices of valence 4 and on the regular faces in the middle.
///
/// (16): 0.780397 M = 0.31255, times r_1 = 0.382813: 0.119647, times r_2 = 0.1427: 0.044601; regular M / 2 / 4 =
/// 0.050063. (14): 0.350722 M r_1 = 0.053771, r_2: 0.020044; regular M / 3 / 4 = 0.033375.
#[test]
fn huang_wang_on_an_octahedron() {
    let mesh = octahedron();
    let m = 657f64.sqrt() / 64.0;
    let of = |method, against, tolerance| one(&mesh, &request(LOOP, against, tolerance), method);
    let control = of(Method::Huang, Against::Control, 0.05);
    assert_eq!(
        (control.depth, control.safe),
        (Some(1 + 2), true),
        "{control:?}"
    );
    assert!(
        near(control.bound_at_depth, 0.780397 * m * 0.1427),
        "{control:?}"
    );
    let limit = of(Method::HuangWang, Against::Limit, 0.05);
    assert_eq!((limit.depth, limit.safe), (Some(1 + 2), true), "{limit:?}");
    let limit = of(Method::HuangWang, Against::Limit, 0.06);
    assert_eq!(limit.depth, Some(1 + 1));
    assert!(
        near(limit.bound_at_depth, 0.350722 * m * 0.382813),
        "{limit:?}"
    );
}

/// By hand: M_0 = 31/55 (8 n b / (3 + 8 n b), n b = 31/64), the rate is 1/4, that of the inserted valence 6, and the
/// print is strict: 31/55 / 16 < 1/10 < 31/55 / 4.
#[test]
fn lanquetin_neveu_on_an_octahedron() {
    let asked = request(LOOP, Against::Control, 0.1);
    let found = one(&octahedron(), &asked, Method::LanquetinNeveu);
    assert_eq!((found.depth, found.safe), (Some(2), false), "{found:?}");
    assert!(near(found.bound_at_depth, 31.0 / 55.0 / 16.0), "{found:?}");
    assert!(
        found.why.contains("lanquetin-neveu-torus.obj"),
        "{}",
        found.why
    );
}

/// On a regular mesh Corollary 2 is Theorem 4 of Cheng & Yong.
#[test]
fn the_papers_agree_on_regular_quads() {
    let mesh = example("bumpy_torus_quads.obj");
    let [valences, _] = mesh.topology.valence_histograms();
    assert_eq!(valences.into_keys().collect::<Vec<_>>(), [4]);
    for tolerance in [1e-1, 1e-2, 1e-3] {
        let asked = request(Scheme::CatmullClark, Against::Control, tolerance);
        let [a, b] = [Method::LanquetinNeveu, Method::ChengYong].map(|m| one(&mesh, &asked, m));
        assert!(a.safe && b.safe);
        assert_eq!((a.depth, a.bound_at_depth), (b.depth, b.bound_at_depth));
    }
    let asked = request(Scheme::DooSabin, Against::Control, 1e-2);
    assert!(one(&mesh, &asked, Method::LanquetinNeveu).safe);
    let irregular = one(&cube(), &asked, Method::LanquetinNeveu);
    assert!(
        !irregular.safe && irregular.depth.is_some(),
        "{irregular:?}"
    );
}

fn measured(mesh: &Mesh, asked: &Request, level: u32) -> [f64; 2] {
    let against = match asked.against {
        Against::Control => model::Against::Control,
        Against::Limit => model::Against::Limit,
    };
    let request = measure::Request {
        scheme: asked.scheme,
        corner: asked.corner,
        level,
        against,
        goal: Goal {
            gap: 1e-3,
            ..Goal::default()
        },
    };
    let found = measure(mesh, &request, &|_, _| ()).expect("a distance");
    [found.lo, found.hi]
}

/// After a safe depth by a paper the measured distance is within the tolerance.
#[test]
fn safe_depths_of_the_papers_are_enough() {
    let methods = [
        Method::LanquetinNeveu,
        Method::ChengYong,
        Method::Huang,
        Method::HuangWang,
    ];
    let mut seen = 0;
    for (mesh, scheme) in [
        (octahedron(), LOOP),
        (example("bumpy_torus_tri.obj"), LOOP),
        (example("bumpy_torus_quads.obj"), Scheme::CatmullClark),
        (example("bumpy_torus_quads.obj"), Scheme::DooSabin),
        (cube(), Scheme::CatmullClark),
    ] {
        for against in [Against::Control, Against::Limit] {
            for tolerance in [1.5, 0.2, 0.04, 0.008] {
                let asked = request(scheme, against, tolerance);
                for answer in predict(&mesh, &asked, &methods).expect("depths") {
                    let Some(depth) = answer.depth.filter(|&k| answer.safe && k <= 3) else {
                        continue;
                    };
                    let [lo, hi] = measured(&mesh, &asked, depth);
                    let bound = answer.bound_at_depth.expect("a bound");
                    assert!(
                        lo <= bound && bound <= tolerance,
                        "{asked:?} {answer:?} {lo}"
                    );
                    assert!(hi <= tolerance * 1.001, "{asked:?} {answer:?} {hi}");
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 20, "{seen}");
}

/// Corollary 3 is refuted by the torus that its answer names.
#[test]
fn the_counterexamples_do_what_is_said_of_them() {
    let mesh = read(file("proofs/counterexamples/lanquetin-neveu-torus.obj"))
        .expect("a mesh")
        .mesh;
    let m_0 = one(
        &mesh,
        &request(LOOP, Against::Control, 1e9),
        Method::LanquetinNeveu,
    );
    let m_0 = m_0.bound_at_depth.expect("M_0");
    let fails = [3.9, 15.5].iter().any(|ratio| {
        let asked = request(LOOP, Against::Control, m_0 / ratio);
        let found = one(&mesh, &asked, Method::LanquetinNeveu);
        assert!(!found.safe);
        measured(&mesh, &asked, found.depth.expect("a depth"))[0] > asked.tolerance
    });
    assert!(fails);
    let certificate = format!("proofs/certificates/{}.json", heuristic::COUNTEREXAMPLE);
    assert!(file(&certificate).exists());
    for basis in verdict::ALL {
        if let Some(name) = basis.counterexample {
            assert!(file("proofs/counterexamples").join(name).exists(), "{name}");
        }
    }
}

/// What is said of every formula is what the examination of its paper finds.
#[test]
fn verdicts_are_those_of_the_examinations() {
    let silent = |_: u32, _: u32| ();
    let reports: [Report; 3] = [
        paper::lanquetin_neveu_2004::examine(&[3, 4, 5, 6], &silent),
        paper::cheng_yong::examine(&[3, 4, 5, 6, cheng_yong::JUDGED], &silent),
        paper::huang_wang_2008::examine(&[3, 7], &silent).expect("rates"),
    ];
    for basis in verdict::ALL {
        let report = reports
            .iter()
            .find(|report| report.id == basis.paper)
            .expect(basis.paper);
        let harmless = |verdict| !matches!(verdict, Verdict::Refuted | Verdict::Undecided);
        for id in basis.claims {
            let claim = report.claim(id).unwrap_or_else(|| panic!("no claim {id}"));
            assert_eq!(harmless(claim.verdict), basis.holds, "{id}");
            let method = claim.method.as_deref().unwrap_or_default();
            let said = format!("{} {method}", claim.found);
            assert!(
                !said.contains("no bounds") && !said.contains("not a bound"),
                "{id}: {said}"
            );
        }
    }
}

/// The induction in the documentation of `depth::printed::huang_wang`, number by number; at n = 6 all is equality
/// and exact (claims regular-depth-control, -limit).
#[test]
fn huang_wang_holds_at_all_levels() {
    // Prints have six digits, and some bounds are met exactly.
    const GAP: f64 = 1e-8;
    let rational = |x: f64| Rational::from_float(x).expect("finite");
    for n in (3..=10).filter(|&n| n != 6) {
        let mut prover = Prover::new(LoopWeights::Original, n);
        let mut upper = |constant| rational(prover.prove(constant, GAP).expect("a proof").hi);
        let mesh_rates: Vec<Rational> =
            (1..=LAMBDA).map(|s| upper(Constant::MeshRate(s))).collect();
        assert!(
            mesh_rates
                .iter()
                .all(|m| *m <= <Rational as Ring>::from_integer(1))
        );
        for against in [Against::Control, Against::Limit] {
            let constants = Constants::of(n, against).expect("printed for these valences");
            let regular = Constants::of(6, against).expect("printed").c;
            assert!(constants.rates[LAMBDA] >= Rational::ratio(1, 64), "n = {n}");
            for k in 0..3 * LAMBDA as u32 {
                let bound = constants.at(k);
                let tile = |s: usize| {
                    let power = Rational::ratio(1, 1 << (2 * (k - s as u32)));
                    &regular * power * &mesh_rates[s - 1] <= bound
                };
                let tiles = k >= LAMBDA as u32 && (1..=LAMBDA).all(tile);

                let directly = k == 3 && n == 3 && against == Against::Limit;
                match k < LAMBDA as u32 || directly {
                    true => {
                        let proved = upper(Constant::Distance(against, k as usize));
                        assert!(proved <= bound, "n = {n}, k = {k}: {}", round_up(&proved));
                    }
                    false => assert!(tiles, "n = {n}, k = {k}"),
                }
            }
        }
    }
}

/// What bounds only the distance from the surface to the mesh is not safe for the other metrics.
/// Methods that `best` leaves out by the connectivity are not safe when they are asked; and none of the papers' is
/// left out everywhere.
#[test]
fn candidates_are_all_that_can_be_safe() {
    let mut meshes = vec![octahedron(), cube()];
    let files = std::fs::read_dir(file("examples/meshes")).expect("examples");
    let files = files.map(|entry| entry.expect("an entry").path());
    meshes.extend(files.map(|path| read(&path).expect("a mesh").mesh));
    let mut safe = std::collections::BTreeSet::new();
    for mesh in &meshes {
        for scheme in [LOOP, Scheme::CatmullClark, Scheme::DooSabin] {
            for against in [Against::Control, Against::Limit] {
                let mut asked = request(scheme, against, 0.125);
                for metric in [Metric::Parametric, Metric::SurfaceToMesh, Metric::Hausdorff] {
                    asked.metric = metric;
                    let candidates = Method::candidates(&asked, &mesh.topology);
                    for method in Method::all()
                        .into_iter()
                        .filter(|m| !matches!(m, Method::Tabulated(..)))
                    {
                        let Ok(answers) = predict(mesh, &asked, &[method]) else {
                            continue;
                        };
                        if answers[0].safe && answers[0].depth.is_some() {
                            assert!(candidates.contains(&method), "{method}, {asked:?}");
                            safe.insert(method.to_string());
                        }
                    }
                }
            }
        }
    }
    for method in [
        "lanquetin-neveu",
        "cheng-yong",
        "huang",
        "huang-wang",
        "subcert-2",
    ] {
        assert!(safe.contains(method), "{method}: {safe:?}");
    }
}

#[test]
fn metrics_decide_what_is_safe() {
    let mesh = octahedron();
    for metric in [Metric::Parametric, Metric::SurfaceToMesh, Metric::Hausdorff] {
        let asked = Request {
            metric,
            ..request(LOOP, Against::Control, 0.2)
        };
        let tabulated = one(&mesh, &asked, Method::Tabulated(Estimator::TabApprox, 1));
        assert!(tabulated.depth.is_some(), "{tabulated:?}");
        assert_eq!(tabulated.safe, metric == Metric::SurfaceToMesh);
        assert!(
            tabulated.safe || tabulated.why.contains(metric.name()),
            "{tabulated:?}"
        );
        assert!(one(&mesh, &asked, Method::Huang).safe);
        assert!(!one(&mesh, &asked, Method::Heuristic).safe);
    }
}

/// Where nothing is printed there is no depth, and a sentence.
#[test]
fn formulas_are_not_stretched() {
    let asked = |scheme| request(scheme, Against::Control, 0.1);
    let none = |mesh: &Mesh, scheme, method, part: &str| {
        let found = one(mesh, &asked(scheme), method);
        assert!(found.depth.is_none() && !found.safe, "{found:?}");
        assert!(found.why.contains(part), "{}", found.why);
    };
    let valences = example("valences_3_to_12.obj");
    none(&valences, LOOP, Method::Huang, "valence 1");
    none(
        &example("loop_saddle_grid.obj"),
        LOOP,
        Method::Huang,
        "boundary",
    );
    none(
        &example("loop_saddle_grid.obj"),
        LOOP,
        Method::LanquetinNeveu,
        "boundary",
    );
    none(
        &example("mixed_patch.obj"),
        Scheme::CatmullClark,
        Method::ChengYong,
        "boundary",
    );
    none(
        &octahedron(),
        LOOP,
        Method::Tabulated(Estimator::TabApprox, 0),
        "not isolated",
    );
    none(
        &octahedron(),
        Scheme::Loop(LoopWeights::Warren),
        Method::Huang,
        "Loop 1987",
    );
    none(&octahedron(), LOOP, Method::HuangWang, "limit meshes");
    none(&cube(), Scheme::DooSabin, Method::Heuristic, "Doo-Sabin");
    let tiny = request(LOOP, Against::Control, 1e-200);
    let found = one(&octahedron(), &tiny, Method::Huang);
    assert!(
        found.depth.is_none() && found.why.contains("2^100"),
        "{found:?}"
    );
}

/// Depths depend on lengths over the tolerance alone, at any size.
#[test]
fn sizes_at_the_ends_of_the_range() {
    let methods = [Method::ChengYong, Method::LanquetinNeveu, Method::Heuristic];
    let plain = predict(
        &cube(),
        &request(Scheme::CatmullClark, Against::Control, 0.25),
        &methods,
    );
    let plain = plain.expect("depths");
    for exponent in [-900, 900] {
        let mut mesh = cube();
        let factor = 2f64.powi(exponent);
        for p in &mut mesh.positions {
            p.0 = p.0.map(|x| x * factor);
        }
        let asked = request(Scheme::CatmullClark, Against::Control, 0.25 * factor);
        let scaled = predict(&mesh, &asked, &methods).expect("depths");
        for (a, b) in plain.iter().zip(&scaled) {
            assert_eq!(
                (a.depth, a.safe),
                (b.depth, b.safe),
                "{exponent}: {a:?} {b:?}"
            );
            let ratio =
                b.bound_at_depth.expect("a bound") / factor / a.bound_at_depth.expect("a bound");
            assert!((ratio - 1.0).abs() < 1e-12, "{exponent}: {ratio}");
        }
    }
}
