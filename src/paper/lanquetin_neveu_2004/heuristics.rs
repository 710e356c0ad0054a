//! What the paper says in passing: where the distance is largest, that it falls, valences, numbers of faces.

use num_traits::{Signed, Zero};

use super::catmull_clark;
use super::doo_sabin;
use super::extremal::LOOP;
use super::meshes;
use super::nets::{distance_form, integer, ratio, texts, violation};
use super::printed;
use super::theorem_3::request;
use crate::bernstein::from_net::box_spline;
use crate::bernstein::triangle::QuarticTriangle;
use crate::certificate::Certificate;
use crate::distance::measure::measure_exact;
use crate::mesh::Topology;
use crate::paper::words::{all, claim};
use crate::paper::{Claim, Counterexample, Verdict};
use crate::refine::refine_topology;
use crate::scalar::Rational;
use crate::scheme::{Scheme, loop_scheme::REGULAR_LABELS};

/// The lattice positions of p_1..p_12 of a regular Loop net, neighbours ±(1, 0), ±(0, 1), ±(1, 1): p_4 at
/// (0, 0), p_7 at (1, 0), p_8 at (1, 1); along a row the step is p_8 - p_7.
const LATTICE: [[i64; 2]; 12] = [
    [-1, -1],
    [-1, 0],
    [0, -1],
    [0, 0],
    [0, 1],
    [1, -1],
    [1, 0],
    [1, 1],
    [1, 2],
    [2, 0],
    [2, 1],
    [2, 2],
];

/// S - L on a regular face for the net `i^2 - j^2`: at the corners and at the middle of the first edge; and
/// S there, with the net.
fn loop_saddle() -> ([Rational; 4], Rational, Vec<Rational>) {
    let heights = LATTICE.map(|[i, j]| integer(i * i - j * j));
    let mut surface = box_spline::<Rational, Rational>(&heights);
    // Bernstein coefficients 0, 1, 3, 6, 10 along the edge from corner 0 to corner 1.
    let middle = |c: &[Rational; 15]| {
        (&c[0] + &c[1] * integer(4) + &c[3] * integer(6) + &c[6] * integer(4) + &c[10])
            * ratio(1, 16)
    };
    let on_surface = middle(&surface.0);
    let corners = [3, 6, 7].map(|i: usize| heights[i].clone());
    surface.subtract::<Rational>(&QuarticTriangle::from_linear::<Rational>(&corners));
    let c = &surface.0;
    let values = [middle(c), c[0].clone(), c[10].clone(), c[14].clone()];
    let mut net = vec![Rational::zero(); 12];
    for (height, label) in heights.into_iter().zip(REGULAR_LABELS) {
        net[label - 1] = height;
    }
    (values, on_surface, net)
}

/// Whether the first value is not 0 and the others are: farther between the vertices than at them.
fn farther(values: &[Rational]) -> bool {
    !values[0].is_zero() && values[1..].iter().all(Zero::is_zero)
}

fn farthest() -> (Vec<Claim>, Vec<(String, Certificate)>) {
    let (loop_values, on_surface, loop_net) = loop_saddle();
    let right = [("", [0, 0]), ("1", [1, 0]), ("3", [0, 1])];
    let right = right.map(|(word, at)| distance_form(word, 0, at)).to_vec();
    let left = distance_form("1", 0, [0, 0]);
    let place = ("loop", Some("original"), 6);
    let loop_file = violation(place, left, &integer(1_000_000), right, &loop_net, None);
    let (cc_net, cc_values, cc_file) = catmull_clark::saddle();
    let ds_values = doo_sabin::saddle();
    let names = ["loop", "catmull-clark"].map(|s| format!("lanquetin-neveu-farthest-{s}.json"));
    let statement = |scheme: &str| {
        format!(
            "The control mesh vertices are the most distant points from the limit surface ({scheme}); a \
             point inserted between two of them is nearer."
        )
    };
    let net = "the net i^2 - j^2: its vertices lie on S, the middle of an edge does not";
    let witness = |valence, net: &[Rational], value: &Rational| {
        Some(Counterexample {
            valence,
            net: texts(net),
            what: format!(
                "no displacement at the corners, |S - L| = {} at the middle of an edge",
                value.abs()
            ),
        })
    };
    let geometric = on_surface == ratio(1, 4);
    let claims = vec![
        Claim {
            counterexample: witness(6, &loop_net, &loop_values[0]),
            certificates: vec![names[0].clone()],
            ..claim(
                "farthest-loop",
                "section 3, Figure 7; proof of Theorem 3",
                statement("Loop"),
                Verdict::of(Some(!farther(&loop_values))),
                format!(
                    "{net}{}",
                    match geometric {
                        true =>
                            ". As a mesh in space, (i, j, i^2 - j^2), S is z = x^2 - y^2 itself: the \
                                 statement fails for geometric distances as for parametric ones",
                        false => "",
                    }
                ),
                "n = 6",
            )
        },
        Claim {
            counterexample: witness(4, &cc_net, &cc_values[0]),
            certificates: vec![names[1].clone()],
            ..claim(
                "farthest-catmull-clark",
                "section 3, Figure 7",
                statement("Catmull-Clark"),
                Verdict::of(Some(!farther(&cc_values))),
                net,
                "N = 4",
            )
        },
        claim(
            "farthest-doo-sabin",
            "section 3, Figure 7; proof of Theorem 5",
            statement("Doo-Sabin"),
            Verdict::of(ds_values.map(|[vertex, middle]| !farther(&[middle, vertex]))),
            format!("{net}; see theorem-5-proof-vertex"),
            "n = 4",
        ),
    ];
    let [a, b] = names;
    (claims, vec![(a, loop_file), (b, cc_file)])
}

/// D and d on the counterexamples.
fn monotone() -> Claim {
    const LEVELS: u32 = 3;
    let mut decided = Vec::new();
    for authored in meshes::counterexamples() {
        let mesh = authored.mesh();
        let levels = (0..=LEVELS).map(|k| {
            measure_exact(&mesh, &request(k, 1e-3), &|_, _| ())
                .ok()?
                .squares
        });
        let levels: Vec<_> = levels.collect();
        decided.extend(levels.windows(2).map(|pair| {
            let ([lower, _], [_, upper]) = (pair[0].as_ref()?, pair[1].as_ref()?);
            (upper < lower).then_some(true)
        }));
    }
    let examples = all(decided);
    claim(
        "monotone-surfaces",
        "section 1, Figure 1",
        "The maximum distance D at a level is always larger than the distance d at the next level.",
        match examples {
            Some(false) => Verdict::Refuted,
            _ => Verdict::Undecided,
        },
        format!(
            "{}. Not strictly on flat meshes, where both are 0; neither proof nor counterexample is known here",
            match examples {
                Some(true) =>
                    format!("certified on the four counterexample meshes, levels 0 to {LEVELS}"),
                _ => "not certain on all counterexample meshes".into(),
            }
        ),
        "Loop; parametric distances",
    )
}

/// A cube, for the schemes on polygons.
fn cube() -> Option<Topology> {
    let corners = vec![
        0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7,
    ];
    Topology::from_uniform(8, 4, corners).ok()
}

fn valences() -> Vec<Claim> {
    let [of_loop, of_doo_sabin] = printed::INSERTED_VALENCE;
    let inserted = meshes::counterexamples().into_iter().map(|authored| {
        let coarse = authored.topology();
        let fine = refine_topology(LOOP, &coarse).ok()?;
        let new = coarse.vertex_count()..fine.vertex_count();
        let mut kept = 0..coarse.vertex_count();
        Some(
            kept.all(|v| fine.valence(v) == coarse.valence(v))
                && new.into_iter().all(|v| fine.valence(v) == of_loop),
        )
    });
    let inserted = all(inserted);
    let tetrahedron = meshes::tetrahedron().topology();
    let all_four = [Some(tetrahedron), cube()].into_iter().map(|mesh| {
        let fine = refine_topology(Scheme::DooSabin, &mesh?).ok()?;
        Some((0..fine.vertex_count()).all(|v| fine.valence(v) == of_doo_sabin))
    });
    let all_four = all(all_four);
    let counts = [LOOP, Scheme::CatmullClark, Scheme::DooSabin]
        .into_iter()
        .flat_map(|scheme| {
            let meshes = [
                Some(meshes::tetrahedron().topology()),
                Some(meshes::torus().topology()),
                cube(),
            ];
            meshes.into_iter().filter_map(move |mesh| {
                let mesh = mesh?;
                let [v, e, f] = [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
                let expected = match scheme {
                    Scheme::Loop(_) if mesh.arity() != Some(3) => return None,
                    Scheme::Loop(_) => 4 * f,
                    Scheme::CatmullClark => mesh.halfedge_count(),
                    Scheme::DooSabin => v + e + f,
                };
                Some(
                    refine_topology(scheme, &mesh)
                        .ok()
                        .map(|fine| fine.face_count() == expected),
                )
            })
        });
    let counts = all(counts);
    vec![
        claim(
            "inserted-valence",
            "section 3.1",
            "All vertices inserted during the subdivision have valence 6 (Loop), so the largest valence is 6 \
             at least.",
            Verdict::of(inserted),
            "a vertex inserted in an inner edge has six neighbours: two ends, four new vertices; old vertices \
             keep their valence",
            "closed meshes; 4 on boundaries",
        ),
        claim(
            "doo-sabin-valence",
            "section 4",
            "After one step of subdivision the valence of any vertex of the Doo-Sabin surface is four.",
            Verdict::of(all_four),
            "each new vertex has two neighbours in its face and one across each of two edges; what is drawn \
             from it is another matter, see not-a-restriction",
            "closed meshes",
        ),
        claim(
            "face-count",
            "section 4",
            "The initial mesh and the level are enough to compute the number of faces in the final mesh.",
            Verdict::of(counts),
            "one step: 4F (Loop), the sum of the faces' sides (Catmull-Clark), V + E + F (Doo-Sabin)",
            "closed meshes",
        ),
    ]
}

/// The claims, and certificates.
pub fn claims() -> (Vec<Claim>, Vec<(String, Certificate)>) {
    let (mut claims, files) = farthest();
    claims.push(monotone());
    claims.extend(valences());
    (claims, files)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rows of the regular patch are consistent with the rings: p_4 is the mean of its six neighbours on
    /// affine nets.
    #[test]
    fn the_lattice_of_the_regular_net() {
        let at = LATTICE;
        let (sum, four) = ([0, 1, 2, 4, 6, 7].map(|i: usize| at[i]), at[3]);
        for axis in 0..2 {
            let total: i64 = sum.iter().map(|p| p[axis]).sum();
            assert_eq!(total, 6 * four[axis]);
        }
    }
}
