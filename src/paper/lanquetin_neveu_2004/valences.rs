//! Theorem 3, valence by valence: closed meshes with a vertex of valence n, local nets, and the true rate.

use num_traits::Zero;

use super::extremal::{Compared, Functionals, Pair};
use super::lengths::rate;
use super::meshes;
use super::nets::{distance_form, integer, integers, texts, violation};
use crate::bound::cosine_of_loop;
use crate::certificate::Certificate;
use crate::paper::words::{DIGITS, all, claim, exceptions, failures, ranges};
use crate::paper::{Claim, Counterexample, Enclosure, Table, Verdict};
use crate::scalar::{Cyclotomic, Field, Interval, Rational};
use crate::scheme::{LoopWeights, loop_scheme};

/// Nets are rounded to multiples of `2^-BITS`.
const BITS: u32 = 30;

/// What is known of Theorem 3 at a valence.
#[derive(Clone, Debug)]
pub struct ValenceFindings {
    /// n.
    pub n: u32,
    /// The largest of `5/8 - nβ` at n, at 6 and at 4: the printed rate of the mesh.
    pub rate: Enclosure,
    /// M_1 / M_0 of a net on the split bipyramid over an n-gon.
    pub recurrence: Enclosure,
    /// |S - L| / M_0 at the middle of an edge, of another net there.
    pub distance: Enclosure,
    /// `3/8 + cos(2π/n)/4`, the rate of M_k for n > 3.
    pub true_rate: Enclosure,
    /// Whether the true rate exceeds the printed one, and the characteristic net has a displacement.
    pub slower: Option<bool>,
}

/// `|x|` at the largest and at the smallest.
fn magnitudes(x: &Interval) -> [f64; 2] {
    let low = x.inf().max(-x.sup()).max(0.0);
    [low, x.mag()]
}

/// An enclosure of |left| / max |right|, from below and above; `None` unless max |right| > 0, certainly.
fn quotient(left: &Interval, right: &[Interval]) -> Option<Enclosure> {
    let bounds = right.iter().map(magnitudes);
    let [low, high] = bounds.fold([0f64; 2], |m, x| [m[0].max(x[0]), m[1].max(x[1])]);
    let exact = Rational::from_float;
    let [l, r] = [magnitudes(left), [low, high]];
    let (l0, l1, r0, r1) = (exact(l[0])?, exact(l[1])?, exact(r[0])?, exact(r[1])?);
    (!r0.is_zero()).then(|| Enclosure::new(l0 / r1, l1 / r0))
}

impl ValenceFindings {
    /// The best nets that floats propose, in certified arithmetic.
    pub fn of(n: u32) -> Option<Self> {
        let pair = Pair::new(meshes::split_bipyramid(n)).ok()?;
        let functionals = Functionals::<f64>::new(&pair).ok()?;
        let apex = n as usize;
        let first = pair.coarse.vertex_count() as usize;
        let spoke = (0..pair.coarse.edge_count()).find(|&e| pair.ends(e).contains(&apex))?;
        let [a, b] = pair.ends(spoke);
        let neighbour = if a == apex { b } else { a };
        // Edges at the apex and at its neighbour stand for those near the vertex.
        let near = (0..pair.coarse.edge_count()).filter(|&e| pair.ends(e).contains(&neighbour));
        let mut recurrence: Option<Enclosure> = None;
        for edge in near {
            let at = first + edge as usize;
            let found = functionals.supremum(&functionals.fine(at))?;
            let compared = exactly(&pair, &found.net)?;
            let ratio = quotient(&compared.fine[at], &compared.coarse)?;
            if recurrence
                .as_ref()
                .is_none_or(|known| ratio.float() > known.float())
            {
                recurrence = Some(ratio);
            }
        }
        let found = functionals.supremum(&functionals.middle(spoke as usize))?;
        let compared = exactly(&pair, &found.net)?;
        let distance = quotient(&compared.middles[spoke as usize], &compared.coarse)?;
        let rates = [n, 6, 4].map(super::loop_masks::rate_enclosure);
        let [Some(r), Some(s), Some(t)] = rates else {
            return None;
        };
        let rate = r.max(&s).max(&t);
        let slow = subdominant(n)?;
        let true_rate = Enclosure::algebraic(&slow);
        let displaced = characteristic_displacement(n)?.signum() != 0;
        let slower = true_rate.compare(&rate).map(|o| o.is_gt() && displaced);
        Some(ValenceFindings {
            n,
            rate,
            recurrence: recurrence?,
            distance,
            true_rate,
            slower,
        })
    }

    /// Whether `M_1 <= rate M_0` for the net found.
    fn recurrence_holds(&self) -> Option<bool> {
        self.recurrence.at_most(&self.rate)
    }

    /// Whether `|S - L| <= M_0` for the net found.
    fn distance_holds(&self) -> Option<bool> {
        self.distance.at_most(&Enclosure::exactly(integer(1)))
    }
}

/// A float net, rounded, compared in intervals.
fn exactly(pair: &Pair, net: &[f64]) -> Option<Compared<Interval>> {
    let scale = f64::from(1u32 << BITS);
    let net: Vec<Interval> = net
        .iter()
        .map(|x| Interval::point((x * scale).round() / scale))
        .collect();
    pair.compare(&net).ok()
}

/// `3/8 + cos(2π/n)/4`, the eigenvalue of frequency 1.
fn subdominant(n: u32) -> Option<Cyclotomic> {
    Some(Cyclotomic::ratio(3, 8) + &(Cyclotomic::two_cos(1, n)? * &Cyclotomic::ratio(1, 8)))
}

/// The displacement of a ring vertex in the net of the eigenvalue λ of frequency 1, as a multiple of that
/// vertex.
///
/// With the centre 0 and the ring `e_j`, `e_(j-1) + e_(j+1) = s e_j`, s = 2 cos(2π/n), λ = 3/8 + s/8. The
/// outer vertex between `e_j` and `e_(j+1)` is the edge point of its parent: `λ o = 3/8 (e_j + e_(j+1)) + o/8`. The one
/// behind `e_j` is a vertex point: `λ a = 5/8 e_j + (e_(j-1) + e_(j+1) + o + o' + a) / 16`.
fn characteristic_displacement(n: u32) -> Option<Cyclotomic> {
    let ratio = Cyclotomic::ratio;
    let s = Cyclotomic::two_cos(1, n)?;
    let lambda = subdominant(n)?;
    let outer = ratio(3, 8) / (lambda.clone() - &ratio(1, 8));
    let both = outer * &(ratio(2, 1) + &s);
    let sides = s + &both;
    let behind = (ratio(5, 8) + &(sides.clone() * &ratio(1, 16))) / (lambda - &ratio(1, 16));
    let mean = (sides + &behind) * &ratio(1, 6);
    Some((ratio(1, 1) - &mean) * &ratio(1, 2))
}

/// A local net whose three corners have no displacement: P_1 = 0, P_2 = 1, P_(n+1) = -1, and P_(n+3),
/// P_(n+5) what the rings of P_2 and P_(n+1) need.
pub fn still_net(n: u32) -> Vec<Rational> {
    let size = n as usize;
    let mut net = vec![0; size + 6];
    net[1] = 1;
    net[size] = -1;
    net[size + 2] = 7;
    net[size + 4] = -7;
    integers(&net)
}

/// At the middle of the edge from P_1 to P_2 of the net: the displacement of the level-1 vertex, and S less
/// the edge's middle. No displacement at P_1 makes the ring weight irrelevant.
fn still_values(n: u32) -> Option<[Rational; 2]> {
    let net = still_net(n);
    let size = n as usize;
    let still = |label: usize| {
        let ring = loop_scheme::ring(n, label)?;
        let sum = ring
            .iter()
            .fold(Rational::zero(), |sum, &i| sum + &net[i - 1]);
        Some(sum == &net[label - 1] * integer(ring.len() as i64))
    };
    if !(still(1)? && still(2)? && still(size + 1)?) {
        return None;
    }
    let fine = loop_scheme::refine_local_net::<Rational, Rational>(LoopWeights::Warren, n, &net)?;
    let mask = loop_scheme::limit_mask::<Rational>(LoopWeights::Warren, 6)?;
    let ring = loop_scheme::ring(n, 2)?;
    let sum = ring
        .iter()
        .fold(Rational::zero(), |sum, &i| sum + &fine[i - 1]);
    let limit = mask.apply_ring(&fine[1], &sum);
    let middle = (&net[0] + &net[1]) / integer(2);
    Some([&fine[1] - &limit, limit - middle])
}

/// The certificates of the still net: of the recurrence and of the distance.
fn certificates(n: u32) -> Vec<(String, Certificate)> {
    let right = || {
        let corners = [("", [0, 0]), ("1", [1, 0]), ("3", [0, 1])];
        corners
            .map(|(word, at)| distance_form(word, 0, at))
            .to_vec()
    };
    let lefts = [
        ("recurrence", distance_form("01", 1, [1, 0])),
        ("distance", distance_form("1", 0, [0, 0])),
    ];
    let make = |(name, left)| {
        let place = ("loop", Some("original"), n);
        let cosine = cosine_of_loop(LoopWeights::Original, n);
        let file = violation(
            place,
            left,
            &integer(1_000_000),
            right(),
            &still_net(n),
            cosine,
        );
        (format!("lanquetin-neveu-local-{name}-n{n:02}.json"), file)
    };
    lefts.map(make).to_vec()
}

/// The table by valence.
pub fn table(found: &[ValenceFindings]) -> Table {
    let row = |v: &ValenceFindings| {
        let judge = |truth: Option<bool>| Verdict::of(truth).to_string();
        vec![
            v.n.to_string(),
            v.rate.decimal(DIGITS),
            v.recurrence.decimal(DIGITS),
            judge(v.recurrence_holds()),
            v.true_rate.decimal(DIGITS),
            judge(v.slower.map(|slower| !slower)),
            v.distance.decimal(DIGITS),
            judge(v.distance_holds()),
        ]
    };
    Table {
        id: "theorem-3-valences",
        title: "Theorem 3 on the split bipyramid over an n-gon, 4n + 2 vertices".into(),
        heads: vec![
            "n",
            "printed rate",
            "M_1 / M_0",
            "recurrence",
            "true rate",
            "rate",
            "|S - L| / M_0",
            "distance",
        ],
        rows: found.iter().map(row).collect(),
        notes: vec![
            "The printed rate is the largest 5/8 - nβ over the valences n, 4 and 6 of the mesh. Ratios are \
             those of nets found, certified in interval arithmetic. The true rate 3/8 + cos(2π/n)/4, the \
             square root of the printed one for n > 6, is that of M_k as k grows: near a vertex of valence n \
             other than 3 and 6 the characteristic net has displacements. Where M_k does fall like 4^-k \
             (n = 3, 6), the factor M_0 is too small."
                .into(),
        ],
    }
}

/// The claims by valence, and certificates.
pub fn claims(found: &[ValenceFindings]) -> (Vec<Claim>, Vec<(String, Certificate)>) {
    let valences: Vec<u32> = found.iter().map(|v| v.n).collect();
    let scope = format!("n = {}", ranges(valences.iter().copied()));
    let truths = |of: &dyn Fn(&ValenceFindings) -> Option<bool>| -> Vec<(u32, Option<bool>)> {
        found.iter().map(|v| (v.n, of(v))).collect()
    };
    let statement = |id, place, text: &str, truths: &[(u32, Option<bool>)], more: &str| {
        claim(
            id,
            place,
            text,
            Verdict::of(all(truths.iter().map(|t| t.1))),
            format!("{}; {more}", exceptions(truths)),
            scope.clone(),
        )
    };
    let recurrence = truths(&|v| v.recurrence_holds());
    let distance = truths(&|v| v.distance_holds());
    let rates = truths(&|v| v.slower.map(|s| !s));
    let local: Vec<(u32, Option<bool>)> = valences
        .iter()
        .map(|&n| (n, still_values(n).map(|v| v.iter().any(Zero::is_zero))))
        .collect();
    let files: Vec<_> = failures(&local)
        .into_iter()
        .flat_map(certificates)
        .collect();
    let witness = failures(&local).first().map(|&n| Counterexample {
        valence: n,
        net: texts(&still_net(n)),
        what:
            "no displacement at the three corners of the face; at the middle of its first edge the \
               level-1 vertex has one, and S is not on the edge"
                .into(),
    });
    let claims = vec![
        statement(
            "recurrence-by-valence",
            "Theorem 3",
            "M_(k+1) <= (5/8 - nβ) M_k on closed meshes with a vertex of valence n.",
            &recurrence,
            "at vertices inserted near the vertex of valence n, by certified nets",
        ),
        statement(
            "rate-by-valence",
            "Theorem 3, (8)",
            "M_k falls at least like (5/8 - nβ)^k, apart from a constant.",
            &rates,
            "there M_k falls like (3/8 + cos(2π/n)/4)^k unless the net is special",
        ),
        statement(
            "distance-by-valence",
            "Theorem 3, (8)",
            "|S - L| <= M_0 on closed meshes with a vertex of valence n.",
            &distance,
            "at the middle of an edge at the vertex of valence n, by certified nets",
        ),
        Claim {
            counterexample: witness,
            certificates: files.iter().map(|(name, _)| name.clone()).collect(),
            ..statement(
                "theorem-3-local",
                "proof of Theorem 3",
                "The displacements of the corners of a face bound the displacement of the vertex inserted in \
                 its edge, and the distance there.",
                &local,
                "no multiple of them does: a net without displacements at the corners has both",
            )
        },
    ];
    (claims, files)
}

/// Whether the rates agree with the printed one for the plot: (n, printed, true).
pub fn rates(found: &[ValenceFindings]) -> Vec<(f64, f64, f64)> {
    let own = |n: u32| rate::<f64>(n).unwrap_or(0.0);
    let row = |v: &ValenceFindings| (f64::from(v.n), own(v.n).max(0.25), v.true_rate.float());
    found.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand at n = 4: s = 0, λ = 3/8, o = 3/2, a = (5/8 + 3/16) / (5/16) = 13/5, (1 - 28/5/6) / 2.
    #[test]
    fn the_characteristic_displacement() {
        let at = |n| characteristic_displacement(n).expect("a cosine");
        assert_eq!(at(4), Cyclotomic::ratio(1, 30));
        assert_eq!(at(6).signum(), 0);
        assert_eq!(at(3).signum(), 0);
    }
}
