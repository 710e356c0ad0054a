//! Exact distances over single faces: both bounds are one rational number.
//!
//! Derived by hand. Quadratics are reproduced by the regular schemes up to a constant: for
//! f = i^2 - j^2 on the triangle lattice S = f, and on an edge t (1 - t) has maximum 1/4; for
//! (i^2 + j^2)/2 a vertex moves by 1/6 in each direction under the bicubic rule, and by 1/8 under the
//! biquadratic one. Level k scales everything by 4^-k.

use std::path::PathBuf;

use subcert::distance::face::{Effort, Workspace};
use subcert::distance::model::{
    Against, CatmullClarkModel, DooSabinModel, LoopModel, MeshView, Model,
};
use subcert::mesh::{Mesh, io};
use subcert::patch::Exact;
use subcert::patch::quad_net::CatmullClarkRules;
use subcert::patch::quarter_net::DooSabinRules;
use subcert::patch::triangle_net::LoopRules;
use subcert::refine::refine;
use subcert::scalar::{Field, Rational};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

fn sample(name: &str, scheme: Scheme, level: u32) -> Mesh<Rational> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("examples/meshes")
        .join(name);
    let mesh = io::read_exact(path).expect("a sample").mesh;
    refine(scheme, CornerRule::Smooth, &mesh, level).expect("rational masks")
}

fn view(mesh: &Mesh<Rational>) -> MeshView<'_, Exact> {
    MeshView {
        topology: &mesh.topology,
        positions: &mesh.positions,
        compared: Against::Control.facet(),
    }
}

/// Number of faces whose bounds both equal the square.
fn count<M: Model<Exact>>(model: &M, square: &Rational) -> usize {
    let mut workspace = Workspace::<Exact, M>::default();
    let effort = Effort {
        gap: 1e-3,
        floor: 0.0,
        cells: 2000,
        close_after: u32::MAX,
    };
    (0..model.face_count())
        .filter_map(|face| workspace.enclose_face(model, face, 0.0, effort))
        .filter(|found| found.lower == *square && found.upper == *square)
        .count()
}

fn square(p: i64, q: i64, level: u32) -> Rational {
    Rational::ratio(p * p, q * q) / Rational::ratio(16i64.pow(level), 1)
}

#[test]
fn the_saddle_is_one_quarter_off_on_every_inner_triangle() {
    // 8 x 8 cells of two triangles; the 6 x 6 inner ones are untouched by the boundary rule.
    for (level, inner) in [(0, 72), (1, 4 * 72)] {
        for weights in [LoopWeights::Original, LoopWeights::Warren] {
            let mesh = sample("loop_saddle_grid.obj", Scheme::Loop(weights), level);
            let rules = LoopRules::new(weights, CornerRule::Smooth, &mesh.topology).expect("masks");
            let model = LoopModel {
                mesh: view(&mesh),
                rules,
            };
            let found = count(&model, &square(1, 4, level));
            assert!(
                found >= inner,
                "{weights}, level {level}: {found} of {inner}"
            );
        }
    }
}

#[test]
fn the_paraboloid_is_one_third_off_on_every_quad_but_the_corners() {
    for level in [0, 1] {
        let mesh = sample("paraboloid_grid.obj", Scheme::CatmullClark, level);
        let rules = CatmullClarkRules::new(CornerRule::Smooth, &mesh.topology);
        let model = CatmullClarkModel {
            mesh: view(&mesh),
            rules,
        };
        let inner = (mesh.topology.face_count() as usize) / 2;
        let found = count(&model, &square(1, 3, level));
        assert!(found >= inner, "level {level}: {found} of {inner}");
    }
}

#[test]
fn the_paraboloid_is_one_quarter_off_under_doo_sabin() {
    let mesh = sample("paraboloid_grid.obj", Scheme::DooSabin, 0);
    let rules = DooSabinRules::new(&mesh.topology).expect("masks");
    let model = DooSabinModel {
        mesh: view(&mesh),
        rules,
    };
    assert_eq!(count(&model, &square(1, 4, 0)), 64);
}
