//! No constant saves `|S - L| <= C M_0`: on regular tori the ratio grows without bound.
//!
//! **Theorem.** For every C there is a regular torus and a net of numbers on it with `|S - L| > C M_0` at
//! the middle of an edge.
//!
//! *Proof.* Let t be the functional S - L at the middle of the edge from (0, 0) to (1, 0) of the lattice
//! with the neighbours ±(1, 0), ±(0, 1), ±(1, 1); it is local and vanishes on affine nets, and
//! `t(h) = -1/4` for `h = i^2 - j^2`, whose displacements `d_v = (P_v - mean of the ring) / 2` all vanish.
//! Let q be the function of one variable that is 1 on [-1, 1], 0 outside [-2, 2], and between is made of
//! two parabolas, `1 - 2 (|x| - 1)^2` up to 3/2 and `2 (2 - |x|)^2` beyond: q' is continuous and q'' bounded. On the
//! lattice put `f_R(i, j) = h(i, j) q(i/R) q(j/R)`. Its displacements vanish where |i|, |j| < R and where
//! one exceeds 2R, and are bounded by a number K independent of R, because second differences are means
//! of second derivatives, and those of `R^2 (x^2 - y^2) q(x) q(y)` at x = i/R, y = j/R do not depend on R. So in
//! `f = (f_2 + f_8 + f_32 + .. ) / J`, with J terms, at most one term has a displacement at any vertex, each at
//! most K/J, while `t(f) = -1/4` (for R >= 2 all terms are h near the edge). The ratio is at least
//! `J / (4 K)`. As f vanishes for |i|, |j| > 2 · 2 · 4^(J-1), it lives on a torus. ∎
//!
//! The members of [`table`] are found by [`super::extremal`] and evaluated exactly.

use num_traits::Zero;

use super::extremal::{Functionals, Pair};
use super::meshes;
use super::nets::{integer, ratio};
use crate::paper::words::{DIGITS, claim};
use crate::paper::{Claim, Enclosure, Table, Verdict};
use crate::scalar::{Rational, Ring};

/// The tori of m x m vertices that are computed.
pub const SIZES: [u32; 6] = [3, 4, 6, 8, 12, 16];

/// Nets are rounded to multiples of `2^-BITS`.
const BITS: u32 = 24;

/// A net on a torus and its exact ratio.
#[derive(Clone, Debug)]
pub struct Member {
    /// m.
    pub size: u32,
    /// `|S - L|` at the middle of an edge over M_0, a lower bound of the supremum, near it.
    pub ratio: Rational,
}

impl Member {
    /// The best net that floats propose, evaluated exactly.
    pub fn of(size: u32) -> Option<Self> {
        let pair = Pair::new(meshes::regular_torus(size)).ok()?;
        let functionals = Functionals::<f64>::new(&pair).ok()?;
        // By translations, edges at the vertex 0 stand for all; by symmetry one edge does, as turning the
        // lattice by 60 degrees permutes them where m x m is all the torus has.
        let edges = (0..pair.coarse.edge_count()).filter(|&e| pair.ends(e).contains(&0));
        let mut best: Option<(f64, u32, Vec<f64>)> = None;
        for edge in edges {
            let found = functionals.supremum(&functionals.middle(edge as usize))?;
            if best.as_ref().is_none_or(|known| found.value > known.0) {
                best = Some((found.value, edge, found.net));
            }
        }
        let (_, edge, net) = best?;
        let scale = f64::from(1u32 << BITS);
        let exact = |x: &f64| integer((x * scale).round() as i64);
        let net: Vec<Rational> = net.iter().map(exact).collect();
        let compared = pair.compare(&net).ok()?;
        let magnitude = |x: &Rational| {
            if *x < Rational::zero() {
                -x.clone()
            } else {
                x.clone()
            }
        };
        let m_0 = compared
            .coarse
            .iter()
            .map(magnitude)
            .fold(Rational::zero(), Rational::max);
        Some(Member {
            size,
            ratio: magnitude(&compared.middles[edge as usize]) / m_0,
        })
    }
}

/// The step of the proof that is arithmetic: t(h) and the displacements of h near the edge, on a lattice
/// large enough to hold them.
fn saddle_values() -> Option<[Rational; 2]> {
    let pair = Pair::new(meshes::regular_torus(9)).ok()?;
    let h = |v: usize| {
        let (i, j) = ((v % 9) as i64 - 4, (v / 9) as i64 - 4);
        <Rational as Ring>::from_integer(i * i - j * j)
    };
    let net: Vec<Rational> = (0..81).map(h).collect();
    let compared = pair.compare(&net).ok()?;
    let [origin, next] = [40usize, 41];
    let edge = (0..pair.coarse.edge_count()).find(|&e| {
        let ends = pair.ends(e);
        ends == [origin, next] || ends == [next, origin]
    })?;
    let near = [origin, next, 31, 49, 50, 30];
    let still = near.iter().all(|&v| compared.coarse[v].is_zero());
    let d = if still { Rational::zero() } else { integer(1) };
    Some([compared.middles[edge as usize].clone(), d])
}

/// The ratios of the members.
pub fn table(members: &[Member]) -> Table {
    let row = |m: &Member| {
        vec![
            format!("{0} x {0}", m.size),
            (m.size * m.size).to_string(),
            Enclosure::exactly(m.ratio.clone()).decimal(DIGITS),
        ]
    };
    Table {
        id: "tori",
        title: "Regular tori: |S - L| / M_0 at the middle of an edge, for the net found".into(),
        heads: vec!["torus", "vertices", "ratio at least"],
        rows: members.iter().map(row).collect(),
        notes: vec![
            "The ratio grows with the logarithm of the size; each value is exact for its net."
                .into(),
        ],
    }
}

/// The members, computed.
pub fn members() -> Vec<Member> {
    SIZES.into_iter().filter_map(Member::of).collect()
}

/// The claim that some constant would do.
pub fn claims(members: &[Member]) -> Vec<Claim> {
    let values = saddle_values();
    let argument = values
        .as_ref()
        .map(|[t, d]| *t == ratio(-1, 4) && d.is_zero());
    let growing = members.len() == SIZES.len()
        && members.windows(2).all(|pair| pair[0].ratio < pair[1].ratio)
        && members.last().is_some_and(|m| m.ratio > integer(2));
    let list: Vec<String> = members
        .iter()
        .map(|m| {
            format!(
                "{0} x {0}: {1}",
                m.size,
                Enclosure::exactly(m.ratio.clone()).decimal(DIGITS)
            )
        })
        .collect();
    vec![claim(
        "theorem-3-any-constant",
        "Theorem 3, (8)",
        "|S^k(u, v) - L^k(u, v)| <= C M_k with M_k the largest vertex displacement, if not for C = 1 then \
         for another constant.",
        Verdict::of(argument.map(|a| !(a && growing))),
        format!(
            "no constant: the net i^2 - j^2 has no displacement and |S - L| = 1/4 at the middle of an edge; \
             means of it, cut off at the radii 2, 8, 32, .., make the ratio on regular tori grow like the \
             logarithm of their size (proof: src/paper/lanquetin_neveu_2004/tori.rs). Exact nets on tori of \
             m x m vertices: {}",
            list.join(", ")
        ),
        "regular meshes, n = 6",
    )]
}
