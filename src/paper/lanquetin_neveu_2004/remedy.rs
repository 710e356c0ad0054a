//! What is true in place of Theorem 3: the second-order norm M takes the place of the displacements.
//!
//! **Theorem.** If at most one corner of a face has a valence n other than 6, then
//! `|S - L^k| <= C_k(n) M` over the face, L^k the control mesh of level k over it and M the largest mixed
//! second difference of the n + 6 control points of the face. `C_0(n) = max(1/2, 8β/(3 + 8β))` with β the
//! sum of the ring weights, n β in the paper; `C_k(6) = 4^-k / 2`. These are the best constants (certificates).

use num_traits::Zero;

use crate::bound::{Against, Constant, Prover};
use crate::certificate::Certificate;
use crate::mesh::Mesh;
use crate::paper::words::{DIGITS, all, claim, ranges};
use crate::paper::{Claim, Enclosure, Table, Verdict};
use crate::scalar::{Cyclotomic, Field, Rational, Ring};
use crate::scheme::{LoopWeights, loop_scheme};

/// Levels k of C_k.
pub const LEVELS: usize = 4;

/// Relative gap of constants.
const GAP: f64 = 1e-6;

/// C_0, C_1, .. of a valence, with certificates.
#[derive(Clone, Debug)]
pub struct Constants {
    /// n.
    pub n: u32,
    /// C_k.
    pub values: Vec<Enclosure>,
    /// `max(1/2, 8β/(3 + 8β))`.
    pub formula: Enclosure,
    /// Certificates by file.
    pub certificates: Vec<(String, Certificate)>,
}

impl Constants {
    /// By the prover; `None` if a proof is not found.
    pub fn of(n: u32) -> Option<Self> {
        let mut prover = Prover::new(LoopWeights::Original, n);
        let mut values = Vec::new();
        let mut certificates = Vec::new();
        for k in 0..LEVELS {
            let proof = prover.prove(Constant::Distance(Against::Control, k), GAP)?;
            let certificate = prover.certificate(&proof);
            certificates.push((certificate.file_name()?, certificate));
            values.push(match prover.closed_form(&proof) {
                Some(exact) => Enclosure::algebraic(&exact),
                None => Enclosure::floats(proof.lo, proof.hi)?,
            });
        }
        let eight = loop_scheme::ring_weight_sum::<Cyclotomic>(LoopWeights::Original, n)?
            * &Cyclotomic::from_integer(8);
        let vertex = eight.clone() / &(Cyclotomic::from_integer(3) + &eight);
        let half = Enclosure::exactly(Rational::ratio(1, 2));
        Some(Constants {
            n,
            values,
            formula: half.max(&Enclosure::algebraic(&vertex)),
            certificates,
        })
    }

    /// Whether C_0 is the formula, as far as enclosures tell.
    fn agrees(&self) -> bool {
        let (a, b) = (&self.values[0], &self.formula);
        a.compare(b).is_none_or(|o| o.is_eq())
    }
}

/// The square of the largest mixed second difference of a closed triangle mesh: of the sum of an edge's
/// ends less the sum of the opposite vertices.
pub fn second_order_square(mesh: &Mesh<Rational>) -> Rational {
    let topology = &mesh.topology;
    let mut largest = Rational::zero();
    for edge in 0..topology.edge_count() {
        let [h, twin] = topology.edge_halfedges(edge);
        let at = |v: u32| &mesh.positions[v as usize];
        let [c, d] = [h, twin].map(|h| topology.target(topology.next(h)));
        let ends = at(topology.origin(h)).clone() + at(topology.target(h));
        let square = (ends - at(c) - at(d)).norm_squared();
        if square > largest {
            largest = square;
        }
    }
    largest
}

/// The least k with `4^-k M / 2 <= ε`, for a mesh of valences 6; M by its square.
pub fn regular_depth(m_square: &Rational, epsilon: &Rational) -> Option<u32> {
    let four = <Rational as Ring>::from_integer(4);
    let [m, bound] = [m_square.clone(), four * epsilon * epsilon].map(Enclosure::exactly);
    let rate = Enclosure::exactly(Rational::ratio(1, 16));
    super::depth::least(&m, &rate, &bound, false)
}

/// The table of constants.
pub fn table(found: &[Constants]) -> Table {
    let row = |c: &Constants| {
        let values = c.values.iter().map(|v| v.decimal(DIGITS));
        let first = [c.n.to_string(), c.formula.decimal(DIGITS)];
        let files: Vec<&str> = c
            .certificates
            .iter()
            .map(|(name, _)| name.as_str())
            .collect();
        first
            .into_iter()
            .chain(values)
            .chain([files.join(" ")])
            .collect()
    };
    Table {
        id: "true-constants",
        title: "What is true: |S - L^k| <= C_k(n) M, M the second-order norm".into(),
        heads: vec!["n", "max(1/2, 8nβ/(3+8nβ))", "C_0", "C_1", "C_2", "C_3", "certificates"],
        rows: found.iter().map(row).collect(),
        notes: vec![
            "Best constants, two-sided. A face with several extraordinary vertices needs one step first."
                .into(),
        ],
    }
}

/// The claim in place of Theorem 3, and certificates.
pub fn claims(found: &[Constants]) -> (Vec<Claim>, Vec<(String, Certificate)>) {
    let files: Vec<_> = found.iter().flat_map(|c| c.certificates.clone()).collect();
    let agree = found.iter().all(Constants::agrees);
    let regular = found.iter().find(|c| c.n == 6).map(|c| {
        (0..LEVELS).all(|k| c.values[k] == Enclosure::exactly(Rational::ratio(1, 2 << (2 * k))))
    });
    let truth = all([Some(agree), regular]);
    let claim = Claim {
        certificates: files.iter().map(|(name, _)| name.clone()).collect(),
        ..claim(
            "in-place-of-theorem-3",
            "in place of Theorem 3",
            "(Ours.) |S^k - L^k| <= C_k(n) M with M the largest mixed second difference of the control points \
             of a face; C_0(n) = max(1/2, 8nβ/(3 + 8nβ)) and C_k(6) = 4^-k / 2.",
            match truth {
                Some(true) => Verdict::Sharp,
                other => Verdict::of(other),
            },
            "two-sided proofs of C_0 .. C_3 for each valence. On a regular mesh k >= log_4(M / 2ε) steps \
             suffice",
            format!("n = {}", ranges(found.iter().map(|c| c.n))),
        )
    };
    (vec![claim], files)
}
