//! Eigenvalues, and what the paper makes of them: decided exactly.

use std::cmp::Ordering;

use super::printed::{self, Fraction};
use crate::paper::words::{claim, every, exceptions, if_true, list, ranges};
use crate::paper::{Claim, Enclosure, Table, Verdict};
use crate::scalar::{Cyclotomic, Field, Rational, Ring};
use crate::scheme::LoopWeights;
use crate::spectrum::characteristic::Sign;
use crate::spectrum::table::{Row, tabulate};
use crate::spectrum::{Eigenvalue, Rules};

/// Valence at which "large" is decided.
const LARGE: u32 = 50;

/// Digits of eigenvalues.
const DIGITS: u32 = 6;

const LOOP: Rules = Rules::Loop(LoopWeights::Original);

fn exact((p, q): Fraction) -> Eigenvalue {
    Eigenvalue::Exact(Cyclotomic::ratio(p, q))
}

/// `(3 + 2 cos 4π/n) / 8` as printed.
fn printed_lambda_3(n: u32) -> Option<Eigenvalue> {
    let [three, two, turns, eight] = printed::SUBSUBDOMINANT;
    // cos(4π/n) = cos(2π (4/2)/n).
    let cosine = Cyclotomic::two_cos(turns as u32 / 2, n)? * &Cyclotomic::ratio(two, 2);
    let sum = Cyclotomic::from_integer(three) + &cosine;
    Some(Eigenvalue::Exact(sum * &Cyclotomic::ratio(1, eight)))
}

fn decimal(value: &Eigenvalue) -> String {
    match value {
        Eigenvalue::Exact(x) => match x.to_rational() {
            Some(x) => x.to_string(),
            None => Enclosure::algebraic(x).decimal(DIGITS),
        },
        Eigenvalue::Root(_) => {
            let x = value.enclose();
            Enclosure::floats(x.inf(), x.sup()).map_or("?".into(), |x| x.decimal(DIGITS))
        }
    }
}

/// Whether λ_3 of a scheme at a valence is a fraction.
fn lambda_3_is(rules: Rules, n: u32, value: Fraction) -> (Option<bool>, String) {
    let rows = tabulate(rules, &[n]);
    let Some(entry) = rows[0].subsubdominant() else {
        return (None, "no subdominant pair".into());
    };
    let truth = entry.value.compare(&exact(value)) == Ordering::Equal;
    (Some(truth), decimal(&entry.value))
}

/// The least k with `rate^k <= bound`.
fn steps(rate: &Rational, bound: &Rational) -> u32 {
    let mut power = rate.clone();
    let mut k = 1;
    while power > *bound {
        power *= rate;
        k += 1;
    }
    k
}

fn ratio((p, q): Fraction) -> Rational {
    Rational::ratio(p, q)
}

/// Spectra of Loop's weights at some valences.
pub struct Spectra {
    rows: Vec<Row>,
}

impl Spectra {
    /// At the valences asked for.
    pub fn of(valences: &[u32]) -> Self {
        Spectra {
            rows: tabulate(LOOP, valences),
        }
    }

    /// The table of λ_3.
    pub fn table(&self) -> Table {
        let row = |row: &Row| {
            let entry = row.subsubdominant();
            let frequencies = entry.map(|e| e.frequencies(row.n));
            vec![
                row.n.to_string(),
                row.subdominant().map_or("-".into(), |e| decimal(&e.value)),
                entry.map_or("-".into(), |e| decimal(&e.value)),
                frequencies.map_or("-".into(), ranges),
                printed_lambda_3(row.n).map_or("-".into(), |v| decimal(&v)),
                if row.is_defective() { "yes" } else { "no" }.into(),
            ]
        };
        Table {
            id: "subsubdominant",
            title: "λ_3 of Loop's scheme (weights of Loop 1987)".into(),
            heads: vec![
                "n",
                "λ_1",
                "λ_3",
                "its frequencies",
                "(3 + 2 cos 4π/n)/8",
                "generalised eigenvectors",
            ],
            rows: self.rows.iter().map(row).collect(),
            notes: vec!["Exact numbers of Q(cos 2π/n), compared exactly.".into()],
        }
    }

    fn formula(&self) -> Vec<(u32, Option<bool>)> {
        let truth = |row: &Row| {
            let value = row.subsubdominant()?;
            Some(value.value.compare(&printed_lambda_3(row.n)?) == Ordering::Equal)
        };
        self.rows.iter().map(|row| (row.n, truth(row))).collect()
    }

    /// The claims.
    pub fn claims(&self) -> Vec<Claim> {
        let asked = format!("Loop, n = {}", ranges(self.rows.iter().map(|r| r.n)));
        let formula = self.formula();
        let instead = self
            .rows
            .iter()
            .zip(&formula)
            .filter(|(_, f)| f.1 == Some(false));
        let instead = instead.filter_map(|(row, _)| {
            let own = row.subsubdominant()?;
            Some((
                row.n,
                format!(
                    "{} against {}",
                    decimal(&own.value),
                    decimal(&printed_lambda_3(row.n)?)
                ),
            ))
        });
        let instead = list(instead);
        let quarter = exact(printed::REGULAR_RATE);
        let low: Vec<u32> = (self.rows.iter())
            .filter(|row| {
                let value = row.subsubdominant();
                value.is_some_and(|e| e.value.compare(&quarter) == Ordering::Less)
            })
            .map(|row| row.n)
            .collect();
        let far = tabulate(LOOP, &[LARGE]);
        let large = far[0].subsubdominant().map(|e| e.value.enclose());
        let limit = ratio(printed::HIGH_VALENCE_RATE);
        let near = large.map(|x| {
            let hundredth = Rational::ratio(1, 100);
            let low = Rational::from_float(x.inf());
            low.is_some_and(|low| low <= limit && &limit - low < hundredth)
        });
        let (four, twelve) = printed::STEPS;
        let goal = ratio(printed::REGULAR_RATE).pow(four as i32);
        let counted = steps(&limit, &goal);
        let (n, decrease, zc_steps) = printed::ZENG_CHEN;
        let tenth = ratio(printed::TENTH);
        let zc = steps(&decrease.exact(), &tenth);
        let (half, few) = printed::FOUR_STEPS;
        let halves = steps(&half.exact(), &tenth);
        let (value, quads, triangles) = printed::HALF;
        let catmull_clark = lambda_3_is(Rules::CatmullClark, quads, value);
        let of_loop = lambda_3_is(LOOP, triangles, value);
        let regular = [(LOOP, 6), (Rules::CatmullClark, 4)]
            .map(|(rules, n)| lambda_3_is(rules, n, printed::REGULAR_RATE));
        let defective: Vec<(u32, Option<bool>)> = (self.rows.iter())
            .map(|row| (row.n, Some(!row.is_defective())))
            .collect();
        let embedding: Vec<(u32, Option<bool>)> = (self.rows.iter())
            .map(|row| (row.n, (row.map.injective == Sign::Positive).then_some(true)))
            .collect();
        vec![
            claim(
                "subsubdominant-formula",
                "introduction, (i)",
                "The subsubdominant eigenvalue of Loop's scheme is λ_3 = (3 + 2 cos 4π/n) / 8.",
                Verdict::of(every(formula.iter().map(|f| f.1))),
                match instead.is_empty() {
                    true => "the eigenvalue of frequency 2, exactly".into(),
                    false => format!("{}: λ_3 is {instead}", exceptions(&formula)),
                },
                asked.clone(),
            ),
            claim(
                "subsubdominant-large",
                "introduction, (i)",
                "λ_3 is close to 5/8 for large valence n.",
                Verdict::of(near),
                format!(
                    "at n = {LARGE}: {}, less than 1/100 below; the formula tends to 5/8",
                    far[0]
                        .subsubdominant()
                        .map_or("-".into(), |e| decimal(&e.value))
                ),
                format!("Loop, n = {LARGE}"),
            ),
            claim(
                "low-valences",
                "section 3, after Corollary 1",
                "For low valences and Loop subdivision λ_3 < 1/4.",
                Verdict::of(Some(!low.is_empty())),
                format!("at n = {}", ranges(low)),
                asked.clone(),
            ),
            claim(
                "lambda-3-half",
                "section 6",
                format!(
                    "λ_3 = 1/2 for Catmull-Clark when n = {quads}, for Loop when n = {triangles}."
                ),
                Verdict::of(every([catmull_clark.0, of_loop.0])),
                format!("Catmull-Clark {}, Loop {}", catmull_clark.1, of_loop.1),
                format!("n = {quads}, {triangles}"),
            ),
            claim(
                "lambda-3-regular",
                "introduction, section 6",
                "At regular points the subsubdominant eigenvalue is 1/4.",
                Verdict::of(every(regular.iter().map(|r| r.0))),
                format!(
                    "Loop, n = 6: {}; Catmull-Clark, n = 4: {}",
                    regular[0].1, regular[1].1
                ),
                "regular valences",
            ),
            claim(
                "steps-high-valence",
                "introduction, (i)",
                format!(
                    "Where {four} steps suffice for the regular polyhedron, close to {twelve} are necessary near \
                     high-valence vertices: (5/8)^{twelve} ≈ (1/4)^{four}."
                ),
                Verdict::of(Some(counted == twelve)),
                format!("the least k with (5/8)^k <= (1/4)^{four} is {counted}"),
                "the limit rate 5/8",
            ),
            claim(
                "steps-first-order",
                "section 1.2, of [ZC06]",
                format!(
                    "With a decrease by {decrease} per step (n = {n}) {zc_steps} steps cut the distance to 10 %."
                ),
                Verdict::of(Some(zc == zc_steps)),
                format!(
                    "the least k with {decrease}^k <= 1/10 is {zc}; the rate itself is [ZC06]'s"
                ),
                "arithmetic",
            ),
            claim(
                "steps-half",
                "section 1.2",
                format!("With λ_3 = {half} (n = {n}) {few} steps do."),
                Verdict::of(Some(halves == few)),
                format!("the least k with {half}^k <= 1/10 is {halves}"),
                "arithmetic",
            ),
            claim(
                "loose-and-sharp",
                "introduction",
                format!(
                    "{} steps where {} suffice mean millions instead of thousands of facets for each facet.",
                    printed::LOOSE_AND_SHARP.0,
                    printed::LOOSE_AND_SHARP.1
                ),
                {
                    let facets = |k: u32| 4u64.pow(k);
                    let (loose, sharp) = printed::LOOSE_AND_SHARP;
                    let right = facets(loose) / 1_000_000 >= 1 && facets(sharp) / 1000 >= 1;
                    Verdict::of(Some(right))
                },
                format!(
                    "4^{} = {}, 4^{} = {}",
                    printed::LOOSE_AND_SHARP.0,
                    4u64.pow(printed::LOOSE_AND_SHARP.0),
                    printed::LOOSE_AND_SHARP.1,
                    4u64.pow(printed::LOOSE_AND_SHARP.1)
                ),
                "arithmetic",
            ),
            claim(
                "no-generalised-eigenvectors",
                "Theorem 1, Corollaries 1 to 3; tables for n = 3..30",
                "The theory asks for a scheme without generalised eigenvectors, and is used for Loop at all valences \
                 from 3 on.",
                Verdict::of(every(defective.iter().map(|d| d.1))),
                if_true(&defective, "diagonal over its eigenvectors"),
                asked.clone(),
            ),
            claim(
                "characteristic-map",
                "section 1.1",
                "The characteristic spline is an embedding.",
                match every(embedding.iter().map(|e| e.1)) {
                    Some(true) => Verdict::True,
                    _ => Verdict::Undecided,
                },
                if_true(
                    &embedding,
                    "regular and injective, by Bernstein coefficients",
                ),
                asked,
            ),
        ]
    }
}
