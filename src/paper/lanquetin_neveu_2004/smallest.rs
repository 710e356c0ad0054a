//! Which triangulations violate Theorem 3 at all: suprema over all coordinates, and why four vertices are
//! not enough for the distance.

use super::extremal::{Extremal, Functionals, Pair};
use super::meshes::{self, Authored};
use super::theorem_3::Examined;
use crate::paper::words::{DIGITS, claim};
use crate::paper::{Claim, Enclosure, Table, Verdict};
use crate::scalar::{Field, Rational};

/// The suprema over all coordinates, for a triangulation with rational weights.
#[derive(Clone, Debug)]
pub struct Suprema {
    /// Of M_1 / M_0.
    pub recurrence: Extremal<Rational>,
    /// Of |S - F| / M_0 at the middle of an edge.
    pub middle: Extremal<Rational>,
}

impl Suprema {
    /// By one exact program for each vertex of level 1 and each edge.
    pub fn of(authored: &Authored) -> Option<Self> {
        Self::of_pair(&Pair::new(authored.topology()).ok()?)
    }

    fn of_pair(pair: &Pair) -> Option<Self> {
        let functionals = Functionals::<Rational>::new(pair).ok()?;
        let [fine, edges] = functionals.counts();
        let best = |count: usize, t: &dyn Fn(usize) -> Vec<Rational>| {
            let mut best: Option<Extremal<Rational>> = None;
            for i in 0..count {
                let found = functionals.supremum(&t(i))?;
                if best.as_ref().is_none_or(|known| found.value > known.value) {
                    best = Some(found);
                }
            }
            best
        };
        Some(Suprema {
            recurrence: best(fine, &|i| functionals.fine(i))?,
            middle: best(edges, &|e| functionals.middle(e))?,
        })
    }
}

/// Suprema over all coordinates, mesh by mesh.
pub fn table() -> Table {
    let row = |authored: &Authored| {
        let found = Suprema::of(authored);
        let text = |of: &dyn Fn(&Suprema) -> Rational| {
            found.as_ref().map_or("?".into(), |s| {
                let value = of(s);
                format!(
                    "{value} = {}",
                    Enclosure::exactly(value.clone()).decimal(DIGITS)
                )
            })
        };
        vec![
            authored.name.to_string(),
            authored.points.len().to_string(),
            text(&|s| s.recurrence.value.clone()),
            text(&|s| s.middle.value.clone()),
        ]
    };
    let all = meshes::counterexamples()
        .into_iter()
        .chain([meshes::octahedron(1)]);
    Table {
        id: "suprema",
        title: "The largest ratios over all coordinates of a triangulation".into(),
        heads: vec!["triangulation", "vertices", "sup M_1 / M_0", "sup at an edge's middle / M_0"],
        rows: all.map(|a| row(&a)).collect(),
        notes: vec![
            "Exact: weighted medians, attained by scalar nets, so also the suprema for points in space. A \
             closed mesh of triangles has at least four vertices, so the tetrahedron is a smallest \
             counterexample to the recurrence and to the rate."
                .into(),
        ],
    }
}

/// Why no tetrahedron is a counterexample to the distance.
///
/// With the centroid 0 the displacements are 4/5 P_i, so M_0 <= 1 says |P_i| <= 5/4. At each parameter
/// S - L is linear in the P_i, and its largest value over the numbers with |P_i| <= 5/4 and sum 0 is taken
/// at an extreme point of these: two of them 5/4, two -5/4. So the tetrahedron with the scalar coordinates
/// (1, 1, -1, -1) has the largest |S - L| / M_0 of all.
pub fn claim_on(examined: &[Examined]) -> Claim {
    let extreme = Authored {
        points: vec![[1, 0, 0], [1, 0, 0], [-1, 0, 0], [-1, 0, 0]],
        ..meshes::tetrahedron()
    };
    let ratio = Examined::of(extreme).and_then(|e| e.distance_ratio());
    let limit = Enclosure::exactly(Rational::ratio(1_000_000_000 + 2, 1_000_000_000));
    let none = ratio.as_ref().and_then(|r| r.at_most(&limit));
    let five = examined.iter().find(|e| e.distance_holds() == Some(false));
    let five = five.is_some_and(|e| {
        let beyond = e.distance_ratio().and_then(|r| limit.compare(&r));
        e.authored.points.len() == 5 && beyond.is_some_and(|o| o.is_lt())
    });
    claim(
        "distance-smallest",
        "in place of Theorem 3",
        "(Ours.) No tetrahedron has |S - L| > (1 + 2/10^9) M_0; five vertices suffice for |S - L| > M_0.",
        Verdict::of(none.map(|none| none && five)),
        match ratio {
            Some(r) => format!(
                "the tetrahedron with the coordinates (1, 1, -1, -1) has the largest ratio of all, [{}, 1 + 2/10^9]; \
                 lanquetin-neveu-bipyramid.obj has five vertices",
                r.decimal(DIGITS)
            ),
            None => "not measured".into(),
        },
        "closed meshes of triangles",
    )
}
