//! The vertex heuristic: the vertices of the mesh, followed to level m, against their limits.
//!
//! | vertex | distance to its limit at level m |
//! |---|---|
//! | Loop, interior, valence n | `\|v - v_inf\| (5/8 - n b)^m` |
//! | boundary | `\|v - v_inf\| 4^-m`, that of a cubic B-spline curve |
//! | Catmull-Clark, interior, among quads | by (v, e, f), e the mean of the edge neighbours, f that of the diagonals |
//!
//! ```text
//! φ = (v + 2 e + f) / 4         mean of the new face points: the next f
//! e' = (v + e + 2 φ) / 4        mean of the new edge points
//! v' = ((n - 2) v + e + φ) / n
//! v_inf = (n v + 4 e + f) / (n + 5)
//! ```
//!
//! Round other polygons this starts at level 1. Nothing is bounded by it, so nothing is rounded outward:
//! vertices need not be the points farthest from the mesh, as the certificate `loop-original-saddle-n08` shows
//! (Peters & Wu, Figure 5).

use super::{Context, Found, NoDepth};
use crate::mesh::{Mesh, Point, Topology};
use crate::predict::differences::Bounds;
use crate::predict::eigen::estimators::{scaled, unscaled};
use crate::refine::{RefineError, limit_positions, refine};
use crate::scheme::{CornerRule, Scheme, loop_scheme};

/// The counterexample, a certificate of the repository.
pub const COUNTEREXAMPLE: &str = "loop-original-saddle-n08";

pub(super) fn depth(context: &Context<'_>) -> Result<Found, NoDepth> {
    let request = context.request;
    let mut vertices = Followed::new(context.mesh, request.scheme, request.corner)?;
    for depth in 0..=Bounds::DEEPEST {
        let bound = vertices.largest();
        if bound <= request.tolerance {
            return Ok(Found {
                depth,
                bound,
                safe: false,
                why: format!(
                    "vertices need not be the points farthest from the mesh: {COUNTEREXAMPLE}"
                ),
            });
        }
        vertices.step();
    }
    Err(NoDepth(format!(
        "the vertices are farther from their limits up to level {}",
        Bounds::DEEPEST
    )))
}

/// A vertex of valence n among quads, less its limit.
#[derive(Clone, Copy, Debug)]
struct AmongQuads {
    n: f64,
    v: [f64; 3],
    e: [f64; 3],
    f: [f64; 3],
}

/// The vertices of a mesh on their way to their limits.
#[derive(Clone, Debug)]
struct Followed {
    /// Lengths in the mesh's unit are 2^exponent times those here.
    exponent: i32,
    /// The largest distance of a level that comes before the others'.
    first: Option<f64>,
    /// Distances and their rates, the largest of each rate.
    geometric: Vec<(f64, f64)>,
    among_quads: Vec<AmongQuads>,
}

impl Followed {
    fn new(mesh: &Mesh, scheme: Scheme, corner: CornerRule) -> Result<Self, RefineError> {
        let (exponent, positions, _) = scaled(mesh)?;
        let mesh = Mesh {
            topology: mesh.topology.clone(),
            positions,
        };
        let limits = limit_positions::<f64, _>(scheme, corner, &mesh.topology, &mesh.positions)?;
        let off = |v: u32| length(&(mesh.positions[v as usize] - &limits[v as usize]).0);
        let count = mesh.topology.vertex_count();
        let mut found = Followed {
            exponent,
            first: None,
            geometric: Vec::new(),
            among_quads: Vec::new(),
        };
        let (boundary, interior): (Vec<u32>, Vec<u32>) = (0..count)
            .filter(|&v| mesh.topology.valence(v) > 0)
            .partition(|&v| mesh.topology.is_boundary_vertex(v));
        for v in boundary {
            found.add(off(v), 0.25);
        }
        match scheme {
            Scheme::Loop(weights) => {
                for v in interior {
                    let n = mesh.topology.valence(v);
                    let sum = loop_scheme::ring_weight_sum::<f64>(weights, n).unwrap_or(0.0);
                    found.add(off(v), 0.625 - sum);
                }
            }
            _ if mesh.topology.arity() == Some(4) => found.quads(&mesh, &interior),
            _ => {
                found.first = Some((0..count).map(off).fold(0.0, f64::max));
                found.geometric.iter_mut().for_each(|(d, rate)| *d *= *rate);
                // Vertices keep their numbers.
                found.quads(&refine::<f64>(scheme, corner, &mesh, 1)?, &interior);
            }
        }
        Ok(found)
    }

    /// A vertex whose distance falls by a rate.
    fn add(&mut self, distance: f64, rate: f64) {
        match self.geometric.iter_mut().find(|(_, known)| *known == rate) {
            Some((largest, _)) => *largest = largest.max(distance),
            None => self.geometric.push((distance, rate)),
        }
    }

    /// Interior vertices of a mesh of quads.
    fn quads(&mut self, mesh: &Mesh, vertices: &[u32]) {
        for &vertex in vertices {
            let [v, e, f] = star(&mesh.topology, &mesh.positions, vertex);
            let n = f64::from(mesh.topology.valence(vertex));
            let limit = combine([n / (n + 5.0), 4.0 / (n + 5.0), 1.0 / (n + 5.0)], [v, e, f]);
            let [v, e, f] = [v, e, f].map(|p| combine([1.0, -1.0, 0.0], [p, limit, p]));
            self.among_quads.push(AmongQuads { n, v, e, f });
        }
    }

    /// The largest distance of this level, in the mesh's unit.
    fn largest(&self) -> f64 {
        let geometric = self.geometric.iter().map(|(distance, _)| *distance);
        let quads = self.among_quads.iter().map(|star| length(&star.v));
        let largest = || geometric.chain(quads).fold(0.0, f64::max);
        unscaled(self.first.unwrap_or_else(largest), self.exponent)
    }

    fn step(&mut self) {
        if self.first.take().is_some() {
            return;
        }
        for (distance, rate) in &mut self.geometric {
            *distance *= *rate;
        }
        for star in &mut self.among_quads {
            let AmongQuads { n, v, e, f } = *star;
            let face = combine([0.25, 0.5, 0.25], [v, e, f]);
            *star = AmongQuads {
                n,
                v: combine([(n - 2.0) / n, 1.0 / n, 1.0 / n], [v, e, face]),
                e: combine([0.25, 0.25, 0.5], [v, e, face]),
                f: face,
            };
        }
    }
}

/// A vertex among quads, the mean of its edge neighbours and that of the diagonal vertices.
fn star(topology: &Topology, positions: &[Point<f64>], vertex: u32) -> [[f64; 3]; 3] {
    let at = |v: u32| positions[v as usize].0;
    let n = f64::from(topology.valence(vertex));
    let mut sums = [[0.0; 3]; 2];
    for h in topology.fan(vertex) {
        let next = topology.next(h);
        for (sum, p) in sums
            .iter_mut()
            .zip([at(topology.target(h)), at(topology.target(next))])
        {
            *sum = combine([1.0, 1.0 / n, 0.0], [*sum, p, p]);
        }
    }
    [at(vertex), sums[0], sums[1]]
}

fn combine(weights: [f64; 3], points: [[f64; 3]; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|j| weights[j] * points[j][i]).sum())
}

fn length([x, y, z]: &[f64; 3]) -> f64 {
    x.hypot(*y).hypot(*z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::io::{Format, parse};
    use crate::scheme::LoopWeights;

    /// Another way: refine, and look at the same vertices.
    fn by_refinement(mesh: &Mesh, scheme: Scheme, levels: u32) -> f64 {
        let corner = CornerRule::Smooth;
        let fine = refine::<f64>(scheme, corner, mesh, levels).unwrap();
        let limits = limit_positions::<f64, _>(scheme, corner, &fine.topology, &fine.positions);
        let limits = limits.unwrap();
        let off = |v: usize| length(&(fine.positions[v] - &limits[v]).0);
        (0..mesh.positions.len()).map(off).fold(0.0, f64::max)
    }

    fn agree(mesh: &Mesh, scheme: Scheme) {
        let mut followed = Followed::new(mesh, scheme, CornerRule::Smooth).unwrap();
        for m in 0..4 {
            let (a, b) = (followed.largest(), by_refinement(mesh, scheme, m));
            assert!(
                (a - b).abs() <= 1e-12 * b.max(1e-3),
                "{scheme:?}, {m}: {a} {b}"
            );
            followed.step();
        }
    }

    fn example(name: &str) -> Mesh {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/meshes");
        crate::mesh::io::read(path.join(name)).unwrap().mesh
    }

    #[test]
    fn vertices_are_where_refinement_puts_them() {
        for weights in [LoopWeights::Original, LoopWeights::Warren] {
            agree(&example("valences_3_to_12.obj"), Scheme::Loop(weights));
            agree(&example("loop_saddle_grid.obj"), Scheme::Loop(weights));
        }
        for name in [
            "block_with_handle.obj",
            "mixed_patch.obj",
            "valences_3_to_12.obj",
        ] {
            agree(&example(name), Scheme::CatmullClark);
        }
    }

    /// A cube of side 2: e has the coordinates 1/3 v, f (the diagonals) -1/3 v; n = 3:
    /// v_inf = (3 + 4/3 - 1/3) / 8 v = v / 2, so the distance is √3 / 2.
    #[test]
    fn a_cube() {
        let text =
            b"v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
            f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
        let mesh = parse(text, Format::Obj, "cube").unwrap().mesh;
        let followed = Followed::new(&mesh, Scheme::CatmullClark, CornerRule::Smooth).unwrap();
        assert!((followed.largest() - 0.75f64.sqrt()).abs() < 1e-15);
        agree(&mesh, Scheme::CatmullClark);
    }
}
