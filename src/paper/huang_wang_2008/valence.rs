//! Everything that is computed for one valence; the claims only compare.

use num_traits::Zero;

use super::bound_function::{BoundFunction, Curve};
use super::needed::Depth;
use super::nets::{self, WEIGHTS};
use crate::bound::constant::{At, Proof};
use crate::bound::word::Word;
use crate::bound::{Against, Constant, Prover};
use crate::certificate::Certificate;
use crate::lp::Rows;
use crate::paper::{Counterexample, Enclosure};
use crate::scalar::{Cyclotomic, Field, Rational, Ring};
use crate::scheme::{IntegerRow, Tile, loop_scheme};

/// A proved constant.
#[derive(Clone, Debug)]
pub struct Proved {
    /// Its value.
    pub value: Enclosure,
    /// Its value in closed form, where both sides met.
    pub exact: Option<Cyclotomic>,
    /// The file of its certificate.
    pub file: String,
    /// A net with M <= 1 that attains the lower bound.
    pub net: Vec<Rational>,
    /// Where it does.
    pub at: At,
}

/// The rates r_1, r_2, .. that are computed; Table 1 has three.
pub const RATES: usize = 6;

/// The levels k of C_k and B_k that are compared, k = 0, 1, ..
pub const LEVELS: usize = 4;

/// The levels of mesh rates.
pub const MESH_LEVELS: usize = 3;

/// The steps j for which c_l is computed for every l.
pub const STEPS: usize = 3;

/// Relative gap of enclosures.
const GAP: f64 = 1e-8;

/// The same at levels where only a comparison with ε is needed.
const DEEP_GAP: f64 = 1e-2;

/// What is known of one valence.
#[derive(Clone, Debug)]
pub struct Valence {
    /// The valence n.
    pub n: u32,
    /// n b.
    pub ring_weight: Cyclotomic,
    /// r_1, r_2, ..
    pub rates: Vec<Proved>,
    /// Mesh rates of the levels 1, 2, ..
    pub mesh_rates: Vec<Proved>,
    /// C_0, C_1, ..; `None` where no proof was found.
    pub control: Vec<Option<Proved>>,
    /// B_0, B_1, ..
    pub limit: Vec<Option<Proved>>,
    /// c_1 .. c_(n+9) of j steps, j = 1, 2, ..
    pub differences: Vec<Vec<Cyclotomic>>,
    /// The largest displacement of P2 in one step, with M = 1.
    pub neighbour_displacement: Rational,
    /// The bound function of section 4.2.
    pub bound_function: Option<BoundFunction>,
    /// The certificate of β(n), if the prover has one.
    pub beta_file: Option<String>,
    /// Whether β(n) = B_0(n) exactly, because one net attains every coefficient that matters.
    pub beta_is_sharp: bool,
    /// The depths for ε: control mesh, limit mesh; `None` if not asked for or not found.
    pub depths: [Option<Depth>; 2],
    /// At valence 6: δ_1 .. δ_15 of the whole face.
    pub deltas: Option<Vec<Proved>>,
    /// Certificates by file name.
    pub certificates: Vec<(String, Certificate)>,
}

struct Examiner {
    prover: Prover,
    certificates: Vec<(String, Certificate)>,
}

impl Examiner {
    fn prove(&mut self, constant: Constant, gap: f64) -> Option<Proved> {
        let proof: Proof = self.prover.prove(constant, gap)?;
        let certificate = self.prover.certificate(&proof);
        let file = certificate.file_name()?;
        let proved = Proved {
            value: Enclosure::floats(proof.lo, proof.hi)?,
            exact: self.prover.closed_form(&proof),
            file: file.clone(),
            net: self.prover.candidate(proof.net).net_rationals(),
            at: proof.at.clone(),
        };
        match self.certificates.iter_mut().find(|(name, _)| *name == file) {
            Some(known) => known.1 = certificate,
            None => self.certificates.push((file, certificate)),
        }
        // An exact value says more than two floats.
        let value = match &proved.exact {
            Some(exact) => Enclosure::algebraic(exact),
            None => proved.value.clone(),
        };
        Some(Proved { value, ..proved })
    }

    /// The depth needed for ε, given the first levels and mesh rates.
    fn depth(
        &mut self,
        against: Against,
        known: &[Option<Proved>],
        mesh_rates: &[Proved],
        epsilon: &Enclosure,
    ) -> Option<Depth> {
        let one_of = |j: usize| match j {
            0 => Enclosure::exactly(Field::ratio(1, 1)),
            _ => (mesh_rates[j - 1].value).max(&Enclosure::exactly(Field::ratio(1, 1 << (2 * j)))),
        };
        let mesh_rate = |j: usize| {
            let most = mesh_rates.len();
            let whole = std::iter::repeat_n(one_of(most), j / most);
            whole.fold(one_of(j % most), |product, rate| product.times(&rate))
        };
        Depth::seek(against, epsilon, known.len(), &mesh_rate, &mut |k| {
            if let Some(known) = known.get(k) {
                return known.clone();
            }
            let constant = Constant::Distance(against, k);
            let rough = self.prove(constant, DEEP_GAP)?;
            match rough.value.at_most(epsilon) {
                Some(_) => Some(rough),
                None => self.prove(constant, GAP),
            }
        })
    }
}

impl Valence {
    /// Computes everything for a valence n >= 3; depths for M / ε = `ratio`, if one is given.
    ///
    /// `None` if a rate was not proved.
    pub fn examine(n: u32, ratio: Option<i64>) -> Option<Self> {
        let mut examiner = Examiner {
            prover: Prover::new(WEIGHTS, n),
            certificates: Vec::new(),
        };
        let mut levels = |against, count: usize| -> Vec<Option<Proved>> {
            let constant = |k| Constant::Distance(against, k);
            (0..count)
                .map(|k| examiner.prove(constant(k), GAP))
                .collect()
        };
        let control = levels(Against::Control, LEVELS);
        let limit = levels(Against::Limit, LEVELS);
        let mut all = |constants: &mut dyn Iterator<Item = Constant>| -> Option<Vec<Proved>> {
            constants.map(|c| examiner.prove(c, GAP)).collect()
        };
        let rates = all(&mut (1..=RATES).map(Constant::Rate))?;
        let mesh_rates = all(&mut (1..=MESH_LEVELS).map(Constant::MeshRate))?;
        let mut depth = |against, known: &[Option<Proved>]| {
            let epsilon = Enclosure::exactly(Rational::new(1.into(), ratio?.into()));
            examiner.depth(against, known, &mesh_rates, &epsilon)
        };
        let depths = [
            depth(Against::Control, &control),
            depth(Against::Limit, &limit),
        ];
        let deltas = (0..15).map(|i| {
            let whole = Constant::Coefficient(Word::EMPTY, i);
            (n == 6).then(|| examiner.prove(whole, GAP))?
        });
        let deltas = deltas.collect();
        let beta_file = examiner.prove(Constant::Beta, GAP).map(|beta| beta.file);
        let bound_function = BoundFunction::prove(&mut examiner.prover);
        let beta_is_sharp = match (&bound_function, &limit[0]) {
            (Some(function), Some(limit)) => one_net_attains(n, function, limit),
            _ => false,
        };
        let b = &examiner.prover.numbers.ring_weight();
        Some(Valence {
            n,
            ring_weight: b.clone() * &Cyclotomic::from_integer(i64::from(n)),
            rates,
            mesh_rates,
            control,
            limit,
            differences: differences(&examiner.prover.rows, n)?,
            neighbour_displacement: neighbour_displacement(&examiner.prover.rows, n)?,
            bound_function,
            beta_file,
            beta_is_sharp,
            depths,
            deltas,
            certificates: examiner.certificates,
        })
    }

    /// r_k, k >= 0.
    pub fn rate(&self, k: usize) -> Enclosure {
        match k {
            0 => Enclosure::exactly(Rational::from_integer(1.into())),
            _ => self.rates[k - 1].value.clone(),
        }
    }

    /// A net as the witness of something.
    pub fn counterexample(&self, proved: &Proved, what: String) -> Counterexample {
        Counterexample {
            valence: self.n,
            net: proved.net.iter().map(Rational::to_string).collect(),
            what,
        }
    }
}

/// Where a net attains its value, in words.
pub fn place(at: &At) -> String {
    let part = |word: &Word| match word.is_empty() {
        true => "the face".to_string(),
        false => format!("part {word}"),
    };
    match at {
        At::Point(word, v, w) => format!("at ({v}, {w}) of {}", part(word)),
        At::Difference(word, l) => format!("in difference {} of {}", l + 1, part(word)),
        At::Claimed => "in the coefficient".into(),
        At::Tile { word, v, w, .. } => format!("at ({v}, {w}) of {}", part(word)),
    }
}

/// The norms of the second differences after j = 1..=STEPS steps, by exact linear programs.
fn differences(rows: &Rows, n: u32) -> Option<Vec<Vec<Cyclotomic>>> {
    let size = loop_scheme::local_net_size(n);
    let unit = |i: usize| {
        let mut net = vec![Cyclotomic::zero(); size];
        net[i] = Cyclotomic::from_integer(1);
        net
    };
    let mut images: Vec<Vec<Cyclotomic>> = (0..size).map(unit).collect();
    let mut found = Vec::new();
    for _ in 0..STEPS {
        for image in &mut images {
            *image = loop_scheme::refine_local_net::<Cyclotomic, Cyclotomic>(WEIGHTS, n, image)?;
        }
        let norm = |row: &IntegerRow| {
            let t: Vec<Cyclotomic> = images.iter().map(|image| row.apply(image)).collect();
            let float: Vec<f64> = t.iter().map(|x| x.enclose().mid()).collect();
            let (near, _) = rows.propose(&float, rows.start())?;
            Some(rows.minimise(&t, &near)?.value)
        };
        found.push(rows.rows().iter().map(norm).collect::<Option<_>>()?);
    }
    Some(found)
}

/// The norm of P2' - P2, by an exact linear program.
fn neighbour_displacement(rows: &Rows, n: u32) -> Option<Rational> {
    let mask = loop_scheme::vertex_mask::<Rational>(WEIGHTS, 6)?;
    let mut t = vec![Rational::zero(); loop_scheme::local_net_size(n)];
    t[1] += mask.center - <Rational as Ring>::from_integer(1);
    for label in loop_scheme::ring(n, 2)? {
        t[label - 1] += &mask.edge;
    }
    Some(rows.minimise(&t, rows.start())?.value)
}

/// Whether the net that attains B_0 attains, with one sign, every δ_i that B has on the curve of its
/// maximum: then β = max B = max |S - F̄| of that net <= B_0 <= β.
fn one_net_attains(n: u32, function: &BoundFunction, limit: &Proved) -> bool {
    let Some((tile, curve)) = function.place() else {
        return false;
    };
    let net: Vec<Cyclotomic> = limit.net.iter().map(Cyclotomic::from_rational).collect();
    let Some(values) = nets::coefficients(n, &net, tile.ring, tile.tile) else {
        return false;
    };
    // On w = 0 only the coefficients (i, j, 0) count: 0, 1, 3, 6, 10.
    let on_curve = |i: &usize| match curve {
        Curve::Diagonal => true,
        Curve::Border => tile.tile == Tile::First && [0, 1, 3, 6, 10].contains(i),
    };
    let indices: Vec<usize> = (0..15).filter(on_curve).collect();
    let attains = |sign: i64| {
        let sign = Cyclotomic::from_integer(sign);
        let same = |&i: &usize| {
            tile.exact[i]
                .as_ref()
                .is_some_and(|delta| *delta == values[i].clone() * &sign)
        };
        !indices.is_empty() && indices.iter().all(same)
    };
    attains(1) || attains(-1)
}
