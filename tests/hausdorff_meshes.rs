//! Hausdorff distances on every mesh of the collection in `../shared/meshes`, if it is there.

use std::fs;
use std::path::PathBuf;

use subcert::distance::hausdorff::{Facets, Goal, Request, Side, measure};
use subcert::distance::measure::{Request as Parametric, measure as measure_parametric};
use subcert::distance::model::Against;
use subcert::distance::parametric;
use subcert::mesh::{Mesh, io};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

/// Larger meshes are left to the benchmarks.
const LARGEST: u32 = 3_500;
/// Larger triangle meshes under schemes for quads too: there hardly anything is settled over common
/// parameters.
const LARGEST_FOREIGN: u32 = 300;

fn schemes(mesh: &Mesh) -> Vec<Scheme> {
    let triangles = mesh.topology.arity() == Some(3);
    let mut list = Vec::new();
    if !triangles || mesh.topology.face_count() <= LARGEST_FOREIGN {
        list.extend([Scheme::CatmullClark, Scheme::DooSabin]);
    }
    if triangles {
        list.push(Scheme::Loop(LoopWeights::Original));
    }
    list
}

/// Nearest points are no further than points at the same parameter, and both sides make the whole.
#[test]
fn every_mesh_is_enclosed_below_the_parametric_distance() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/meshes");
    if !folder.is_dir() {
        eprintln!("skipped: {} is not there", folder.display());
        return;
    }
    let entries = fs::read_dir(&folder).expect("the folder");
    let mut paths: Vec<_> = entries.map(|e| e.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "obj"));
    paths.sort();
    let mut measured = 0;
    for path in paths {
        let mesh = io::read(&path).expect("a mesh").mesh;
        if mesh.topology.face_count() > LARGEST {
            continue;
        }
        for scheme in schemes(&mesh) {
            for against in [Against::Control, Against::Limit] {
                let what = format!("{} {scheme:?} {against:?}", path.display());
                let whole = Parametric {
                    scheme,
                    corner: CornerRule::Smooth,
                    level: 0,
                    against,
                    goal: parametric::Goal::default(),
                };
                let whole = measure_parametric(&mesh, &whole, &|_, _| ()).expect("measured");
                let side = |side: Side| {
                    let request = Request {
                        scheme,
                        corner: CornerRule::Smooth,
                        level: 0,
                        against,
                        side,
                        facets: Facets::Bilinear,
                        goal: Goal::default(),
                    };
                    let found = measure(&mesh, None, &request, &|_, _| ()).expect("measured");
                    assert!(found.met && found.lo <= found.hi, "{what}: {found:?}");
                    let gap = found.hi - found.lo;
                    assert!(
                        gap <= 1e-4 * found.diagonal * (1.0 + 1e-12),
                        "{what}: {found:?}"
                    );
                    assert!(found.lo <= whole.hi, "{what}: {found:?} {}", whole.hi);
                    found
                };
                let (forward, back) = (side(Side::SurfaceToMesh), side(Side::MeshToSurface));
                let both = side(Side::Both);
                assert!(both.lo <= forward.hi.max(back.hi), "{what}: {both:?}");
                assert!(forward.lo.max(back.lo) <= both.hi, "{what}: {both:?}");
                measured += 1;
            }
        }
    }
    assert!(measured > 40, "{measured}");
}
