//! Bases of second differences, and the multipliers of a form in one.
//!
//! The elimination below is only a way to find multipliers: `weight` checks them at every point.

use std::collections::{BTreeMap, BTreeSet};

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::form::Form;
use crate::polynomial::Polynomial;
use crate::reject::{Outcome, Rule, require};
use crate::space::{Row, Space};

/// `register[to] = own register[to] + Σ factor register[from]`, each row of polynomial coefficients.
struct Instruction {
    to: usize,
    own: BigInt,
    terms: Vec<(BigInt, usize)>,
}

/// A basis, with the integer program that solves for multipliers.
pub struct Basis {
    /// The indices of its differences, from 0.
    list: Vec<usize>,
    program: Vec<Instruction>,
    /// The register that holds the multiplier of each difference.
    place: Vec<usize>,
    /// What the multipliers are over.
    den: BigInt,
}

/// A pivot: the equation, the unknown, and the equation's entries when it was chosen.
struct Pivot {
    equation: usize,
    unknown: usize,
    entries: BTreeMap<usize, BigRational>,
}

/// Eliminates in the equations `Σ_l x_l rows_l = t`, one for each point: sparsest equations first.
/// Returns the pivots and the steps (to, from, factor) `equation[to] -= factor equation[from]`.
fn eliminate(rows: &[&Row], size: usize) -> (Vec<Pivot>, Vec<(usize, usize, BigRational)>) {
    let mut equations = vec![BTreeMap::new(); size];
    let mut columns = vec![BTreeSet::new(); rows.len()];
    for (l, row) in rows.iter().enumerate() {
        for &(i, c) in *row {
            equations[i].insert(l, BigRational::from_integer(c.into()));
            columns[l].insert(i);
        }
    }
    let (mut pivots, mut steps) = (Vec::new(), Vec::new());
    let mut active: BTreeSet<usize> = (0..size).collect();
    loop {
        active.retain(|&i| !equations[i].is_empty());
        let Some(&equation) = active.iter().min_by_key(|&&i| equations[i].len()) else {
            break;
        };
        active.remove(&equation);
        let entries = std::mem::take(&mut equations[equation]);
        for l in entries.keys() {
            columns[*l].remove(&equation);
        }
        let cheapest = entries.iter().min_by_key(|(l, c)| {
            (
                !c.is_integer() || !c.numer().magnitude().is_one(),
                columns[**l].len(),
            )
        });
        let Some((&unknown, pivot)) = cheapest else {
            break;
        };
        for &to in &columns[unknown].clone() {
            let factor = &equations[to][&unknown] / pivot;
            for (&l, c) in &entries {
                let entry = equations[to].entry(l).or_insert_with(BigRational::zero);
                *entry -= &factor * c;
                if entry.is_zero() {
                    equations[to].remove(&l);
                    columns[l].remove(&to);
                } else {
                    columns[l].insert(to);
                }
            }
            steps.push((to, equation, factor));
        }
        pivots.push(Pivot {
            equation,
            unknown,
            entries,
        });
    }
    (pivots, steps)
}

/// The rank of second differences of `size` points.
pub fn rank(rows: &[Row], size: usize) -> usize {
    eliminate(&rows.iter().collect::<Vec<_>>(), size).0.len()
}

impl Basis {
    /// The basis with a list of indices from 1.
    ///
    /// # Errors
    ///
    /// If and only if the list is not increasing, not within the differences, not as long as the rank or dependent:
    /// rule `bases`; or the work allowed is used up.
    pub fn new(space: &Space, list: &[usize]) -> Outcome<Self> {
        let increasing = list.windows(2).all(|pair| pair[0] < pair[1]);
        let within = list.iter().all(|&l| (1..=space.rows.len()).contains(&l));
        require(increasing && within, Rule::Bases, || {
            "a basis is not an increasing list of second differences".into()
        })?;
        require(list.len() == space.rank, Rule::Bases, || {
            format!(
                "a basis has {} differences, the rank is {}",
                list.len(),
                space.rank
            )
        })?;
        let list: Vec<usize> = list.iter().map(|l| l - 1).collect();
        let rows: Vec<&Row> = list.iter().map(|&l| &space.rows[l]).collect();
        let (pivots, steps) = eliminate(&rows, space.size);
        require(pivots.len() == list.len(), Rule::Bases, || {
            format!("a basis has the rank {} only", pivots.len())
        })?;
        let basis = Self::compile(list, space.size, &pivots, steps);
        space.charge(100 * basis.length())?;
        Ok(basis)
    }

    /// Turns rational elimination into integer instructions; `dens[i]` is what register i is over.
    fn compile(
        list: Vec<usize>,
        size: usize,
        pivots: &[Pivot],
        steps: Vec<(usize, usize, BigRational)>,
    ) -> Self {
        let mut program = Vec::new();
        let mut dens = vec![BigInt::one(); size];
        // register[to] / dens[to] - factor register[from] / dens[from]
        for (to, from, factor) in steps {
            let over = factor.denom() * &dens[from];
            let den = dens[to].lcm(&over);
            let terms = vec![(-factor.numer() * (&den / over), from)];
            program.push(Instruction {
                to,
                own: &den / &dens[to],
                terms,
            });
            dens[to] = den;
        }
        let mut place = vec![0; list.len()];
        for pivot in pivots {
            place[pivot.unknown] = pivot.equation;
        }
        // x = (register / dens - Σ c_l x_l) / c for the pivot's c, the last pivot first; x replaces the register.
        for pivot in pivots.iter().rev() {
            let to = pivot.equation;
            let c = &pivot.entries[&pivot.unknown];
            let own = c.recip() / &dens[to];
            let others = pivot.entries.iter().filter(|(l, _)| **l != pivot.unknown);
            let terms: Vec<_> = others
                .map(|(&l, other)| (-other / c / &dens[place[l]], place[l]))
                .collect();
            let den = terms.iter().fold(own.denom().clone(), |den, (factor, _)| {
                den.lcm(factor.denom())
            });
            let whole = |x: &BigRational| x.numer() * (&den / x.denom());
            let terms = terms
                .iter()
                .map(|(factor, from)| (whole(factor), *from))
                .collect();
            program.push(Instruction {
                to,
                own: whole(&own),
                terms,
            });
            dens[to] = den;
        }
        let den = place
            .iter()
            .fold(BigInt::one(), |den, &i| den.lcm(&dens[i]));
        program.extend(place.iter().map(|&to| Instruction {
            to,
            own: &den / &dens[to],
            terms: Vec::new(),
        }));
        Self {
            list,
            program,
            place,
            den,
        }
    }

    /// The number of the program's terms.
    pub fn length(&self) -> u64 {
        self.program
            .iter()
            .map(|instruction| 1 + instruction.terms.len() as u64)
            .sum()
    }

    /// The weight of a form given times q: a polynomial, to be divided by q.
    ///
    /// # Errors
    ///
    /// If and only if the form is not in the span: rule `bases`; or the work allowed is used up.
    pub fn weight(&self, space: &Space, form: &Form) -> Outcome<Polynomial> {
        let width = form.width;
        space.charge(
            (self.length() + 4 * self.list.len() as u64)
                * width as u64
                * (2 + form.den.bits() / 64 + self.den.bits() / 64),
        )?;
        let mut registers: Vec<Vec<BigInt>> = form
            .num
            .chunks_exact(width)
            .map(<[BigInt]>::to_vec)
            .collect();
        for Instruction { to, own, terms } in &self.program {
            let mut result = std::mem::take(&mut registers[*to]);
            if !own.is_one() {
                result.iter_mut().for_each(|x| *x *= own);
            }
            for (factor, from) in terms {
                for (x, y) in result
                    .iter_mut()
                    .zip(&registers[*from])
                    .filter(|(_, y)| !y.is_zero())
                {
                    *x += factor * y;
                }
            }
            registers[*to] = result;
        }
        self.verify(space, form, &registers)?;
        let den = &self.den * &form.den;
        let mut sum = vec![BigInt::zero(); width];
        let mut uncertain = Polynomial::integer(0);
        for &i in &self.place {
            let multiplier = Polynomial::new(registers[i].clone(), den.clone());
            match multiplier.sign(&space.beta) {
                Some(Sign::NoSign) => (),
                Some(Sign::Plus) => sum
                    .iter_mut()
                    .zip(&registers[i])
                    .for_each(|(sum, x)| *sum += x),
                Some(Sign::Minus) => sum
                    .iter_mut()
                    .zip(&registers[i])
                    .for_each(|(sum, x)| *sum -= x),
                None => {
                    uncertain =
                        &uncertain + &Polynomial::constant(&multiplier.magnitude(&space.beta))
                }
            }
        }
        Ok(&Polynomial::new(sum, den) + &uncertain)
    }

    /// Checks `Σ_l x_l alpha_l = den form` coefficient by coefficient at every point.
    fn verify(&self, space: &Space, form: &Form, registers: &[Vec<BigInt>]) -> Outcome<()> {
        let mut sums = vec![BigInt::zero(); form.num.len()];
        for (&l, &place) in self.list.iter().zip(&self.place) {
            for &(i, c) in &space.rows[l] {
                for (sum, x) in sums[i * form.width..].iter_mut().zip(&registers[place]) {
                    *sum += x * c;
                }
            }
        }
        let same = sums
            .iter()
            .zip(&form.num)
            .all(|(sum, x)| *sum == x * &self.den);
        require(same && self.den.is_positive(), Rule::Bases, || {
            "a functional is not in the span of its basis".into()
        })
    }
}
