//! `measure` on every mesh of the collection in `../shared/meshes`, if it is there.

use std::fs;
use std::path::PathBuf;

use subcert::distance::measure::{Request, measure};
use subcert::distance::model::Against;
use subcert::distance::parametric::Goal;
use subcert::mesh::{Mesh, io};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

/// Larger refined meshes are left to the benchmarks.
const LARGEST: u64 = 300_000;

fn schemes(mesh: &Mesh) -> Vec<Scheme> {
    let mut list = vec![Scheme::CatmullClark, Scheme::DooSabin];
    if mesh.topology.arity() == Some(3) {
        list.extend([
            Scheme::Loop(LoopWeights::Original),
            Scheme::Loop(LoopWeights::Warren),
        ]);
    }
    list
}

#[test]
fn every_mesh_is_enclosed_to_the_gap_and_distances_fall_with_the_level() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/meshes");
    if !folder.is_dir() {
        eprintln!("skipped: {} is not there", folder.display());
        return;
    }
    let mut paths: Vec<_> = fs::read_dir(&folder)
        .expect("the folder")
        .map(|e| e.expect("an entry").path())
        .collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "obj"));
    paths.sort();
    assert_eq!(paths.len(), 20);
    let mut measured = 0;
    for path in paths {
        let mesh = io::read(&path).expect("a mesh").mesh;
        for scheme in schemes(&mesh) {
            for against in [Against::Control, Against::Limit] {
                let mut before = [f64::INFINITY; 2];
                for level in 0..4 {
                    if u64::from(mesh.topology.halfedge_count()) << (2 * level) > LARGEST * 3 {
                        break;
                    }
                    let goal = Goal::default();
                    let request = Request {
                        scheme,
                        corner: CornerRule::Smooth,
                        level,
                        against,
                        goal,
                    };
                    let what = format!("{} {scheme:?} {against:?} level {level}", path.display());
                    let found = measure(&mesh, &request, &|_, _| ())
                        .unwrap_or_else(|e| panic!("{what}: {e}"));
                    assert!(
                        found.lo <= found.hi && found.hi.is_finite(),
                        "{what}: {found:?}"
                    );
                    assert!(found.met && found.gap() <= 1e-6, "{what}: {found:?}");
                    // Under Doo-Sabin level 1 of a triangle mesh can be a little further off than
                    // level 0 (its quarters are other pieces), so two levels are compared.
                    let earlier = if scheme == Scheme::DooSabin {
                        before[0]
                    } else {
                        before[1]
                    };
                    assert!(
                        found.hi < earlier,
                        "{what}: {} is not below {earlier}",
                        found.hi
                    );
                    before = [before[1], found.hi];
                    measured += 1;
                }
            }
        }
    }
    assert!(measured > 300, "{measured}");
}
