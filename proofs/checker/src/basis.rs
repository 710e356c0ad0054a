//! Bases of differences, and the multipliers of a form in one.
//!
//! The elimination is only a way to find multipliers: `weight` checks them at every point.

use std::collections::BTreeMap;

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::form::Form;
use crate::reject::{Outcome, Rule, ensure};
use crate::scalar::{Scalar, add_product};
use crate::scheme::Row;
use crate::space::Space;

/// `to = own to + Σ factor from`, a register being a scalar.
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
    /// The register where the program leaves the multiplier of each difference.
    place: Vec<usize>,
    /// What the multipliers are over.
    den: BigInt,
}

/// One linear equation for each point: the coefficients of the unknown multipliers (in `rank`, of the points).
type Equation = BTreeMap<usize, BigRational>;

/// The outcome of elimination in `Σ_l x_l rows_l = t`.
struct Elimination {
    /// Equation, unknown, and the equation when it was chosen to give that unknown.
    pivots: Vec<(usize, usize, Equation)>,
    /// (to, from, factor): the equation `to` less factor times the equation `from`.
    steps: Vec<(usize, usize, BigRational)>,
}

/// Eliminates, the shortest equations first, and in them the units that occur least.
fn eliminate(rows: &[&Row], size: usize) -> Elimination {
    let mut equations = vec![Equation::new(); size];
    for (l, row) in rows.iter().enumerate() {
        for (i, c) in *row {
            equations[*i].insert(l, BigRational::from_integer(c.clone()));
        }
    }
    let (mut pivots, mut steps) = (Vec::new(), Vec::new());
    let shortest = |equations: &[Equation]| {
        let lengths = equations.iter().map(Equation::len).enumerate();
        lengths.filter(|&(_, length)| length > 0).min_by_key(|&(_, length)| length)
    };
    while let Some((from, _)) = shortest(&equations) {
        let chosen = std::mem::take(&mut equations[from]);
        let cost = |(l, c): &(&usize, &BigRational)| {
            let uses = equations.iter().filter(|equation| equation.contains_key(l)).count();
            (!c.is_integer() || !c.numer().magnitude().is_one(), uses)
        };
        let Some((&unknown, pivot)) = chosen.iter().min_by_key(cost) else {
            break;
        };
        for (to, equation) in equations.iter_mut().enumerate() {
            let Some(entry) = equation.get(&unknown) else {
                continue;
            };
            let factor = entry / pivot;
            for (&l, c) in &chosen {
                *equation.entry(l).or_insert_with(BigRational::zero) -= &factor * c;
            }
            equation.retain(|_, c| !c.is_zero());
            steps.push((to, from, factor));
        }
        pivots.push((from, unknown, chosen));
    }
    Elimination { pivots, steps }
}

/// The rank of differences of `size` points: at most size - 1, as each vanishes where all points are equal.
pub fn rank(rows: &[Row], size: usize) -> usize {
    // Each row is reduced by those that begin with other points; what is left begins with a new one.
    let mut begun = BTreeMap::<usize, Equation>::new();
    for row in rows {
        let terms = row.iter().map(|(i, c)| (*i, BigRational::from_integer(c.clone())));
        let mut rest: Equation = terms.collect();
        while let Some((&first, lead)) = rest.first_key_value() {
            let Some(other) = begun.get(&first) else {
                begun.insert(first, rest);
                break;
            };
            let factor = lead / &other[&first];
            for (&i, c) in other {
                *rest.entry(i).or_insert_with(BigRational::zero) -= &factor * c;
            }
            rest.retain(|_, c| !c.is_zero());
        }
        if begun.len() + 1 == size {
            break;
        }
    }
    begun.len()
}

impl Basis {
    /// The basis with a list of indices from 1.
    ///
    /// # Errors
    ///
    /// If and only if the list is not increasing, not within the differences, not as long as the
    /// rank, or dependent: rule `bases`; or the work allowed is used up.
    pub fn new(space: &Space, list: &[usize]) -> Outcome<Self> {
        let (rule, rank) = (Rule::Bases, space.rank);
        let within = list.iter().all(|l| (1..=space.rows.len()).contains(l));
        let increasing = list.windows(2).all(|pair| pair[0] < pair[1]);
        ensure!(within && increasing, rule, "not an increasing list of differences");
        ensure!(list.len() == rank, rule, "{} differences, but the rank is {rank}", list.len());
        let list: Vec<usize> = list.iter().map(|l| l - 1).collect();
        let rows: Vec<&Row> = list.iter().map(|&l| &space.rows[l]).collect();
        space.charge(3 * (space.size * space.size) as u64)?;
        let elimination = eliminate(&rows, space.size);
        let found = elimination.pivots.len();
        ensure!(found == rank, rule, "the differences have the rank {found}, not {rank}");
        Ok(Self::compile(list, space.size, elimination))
    }

    /// Turns the rational elimination into an integer program; register i is over `dens[i]`.
    fn compile(list: Vec<usize>, size: usize, Elimination { pivots, steps }: Elimination) -> Self {
        let mut program = Vec::new();
        let mut dens = vec![BigInt::one(); size];
        let mut assign = |to: usize, own: BigRational, terms: Vec<(BigRational, usize)>| {
            // own register[to] / dens[to] + Σ factor register[from] / dens[from]
            let over = |factor: BigRational, i: usize| factor / &dens[i];
            let own = over(own, to);
            let terms: Vec<_> = terms.into_iter().map(|(c, from)| (over(c, from), from)).collect();
            let den = terms.iter().fold(own.denom().clone(), |den, (c, _)| den.lcm(c.denom()));
            let whole = |c: &BigRational| c.numer() * (&den / c.denom());
            let terms = terms.iter().map(|(c, from)| (whole(c), *from)).collect();
            program.push(Instruction { to, own: whole(&own), terms });
            dens[to] = den;
        };
        for (to, from, factor) in steps {
            assign(to, BigRational::one(), vec![(-factor, from)]);
        }
        let mut place = vec![0; list.len()];
        for (from, unknown, _) in &pivots {
            place[*unknown] = *from;
        }
        // With the later unknowns known: x = (t - Σ c_l x_l) / c, which replaces t.
        for (from, unknown, equation) in pivots.iter().rev() {
            let c = &equation[unknown];
            let others = equation.iter().filter(|(l, _)| *l != unknown);
            assign(*from, c.recip(), others.map(|(&l, other)| (-other / c, place[l])).collect());
        }
        let den = place.iter().fold(BigInt::one(), |den, &i| den.lcm(&dens[i]));
        let scale = |&to| Instruction { to, own: &den / &dens[to], terms: Vec::new() };
        program.extend(place.iter().map(scale));
        Self { list, program, place, den }
    }

    /// The number of the program's terms.
    pub fn length(&self) -> u64 {
        self.program.iter().map(|instruction| 1 + instruction.terms.len() as u64).sum()
    }

    /// The weight of a form given times q, to be divided by q.
    ///
    /// # Errors
    ///
    /// If and only if the form is not in the span: rule `bases`; or the work allowed is used up.
    pub fn weight(&self, space: &Space, form: &Form) -> Outcome<Scalar> {
        let (width, count) = (form.width as u64, self.list.len() as u64);
        let limbs = form.limbs() + 1 + self.den.bits() / 64;
        space.charge((self.length() + 4 * count) * width * limbs + 3 * count * width * width)?;
        let registers = self.solve(form);
        ensure!(
            self.solves(space, form, &registers),
            Rule::Bases,
            "a functional is not in the span"
        );
        let den = &self.den * &form.den;
        let mut sum = vec![BigInt::zero(); form.width];
        let mut uncertain = Scalar::integer(0);
        for &i in &self.place {
            let multiplier = Scalar::new(registers[i].clone(), den.clone());
            let both = sum.iter_mut().zip(&registers[i]);
            match space.ring.sign(&multiplier) {
                Some(Sign::NoSign) => (),
                Some(Sign::Plus) => both.for_each(|(sum, x)| *sum += x),
                Some(Sign::Minus) => both.for_each(|(sum, x)| *sum -= x),
                None => {
                    let [_, most] = space.ring.magnitudes(&multiplier);
                    uncertain = &uncertain + &Scalar::constant(&most);
                }
            }
        }
        Ok(&Scalar::new(sum, den) + &uncertain)
    }

    /// Runs the program on a form's numerators.
    fn solve(&self, form: &Form) -> Vec<Vec<BigInt>> {
        let mut registers: Vec<_> = form.num.chunks(form.width).map(<[BigInt]>::to_vec).collect();
        for Instruction { to, own, terms } in &self.program {
            let mut result = std::mem::take(&mut registers[*to]);
            if !own.is_one() {
                result.iter_mut().for_each(|x| *x *= own);
            }
            for (factor, from) in terms {
                let both = result.iter_mut().zip(&registers[*from]);
                both.for_each(|(x, y)| add_product(x, factor, y));
            }
            registers[*to] = result;
        }
        registers
    }

    /// True if `Σ_l x_l alpha_l = den form`, coefficient by coefficient at every point.
    fn solves(&self, space: &Space, form: &Form, registers: &[Vec<BigInt>]) -> bool {
        let mut sums = vec![BigInt::zero(); form.num.len()];
        for (&l, &place) in self.list.iter().zip(&self.place) {
            for (i, c) in &space.rows[l] {
                let at = sums[*i * form.width..].iter_mut();
                at.zip(&registers[place]).for_each(|(sum, x)| add_product(sum, c, x));
            }
        }
        let same = sums.iter().zip(&form.num).all(|(sum, x)| *sum == x * &self.den);
        same && self.den.is_positive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loop_scheme::Loop;
    use crate::net::Net;
    use crate::rational::ratio;
    use crate::ring::{Interval, Ring};

    const GOOD: [usize; 12] = [1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 14, 16];

    fn with_beta(n: usize) -> Space {
        Loop::space(n, Ring::RATIONALS, Scalar::constant(&ratio(3, 8)))
    }

    fn differences(space: &Space) -> Vec<Form> {
        let net = Net::first(space);
        space.rows.iter().map(|row| net.difference(row)).collect()
    }

    fn space() -> Space {
        with_beta(7)
    }

    #[test]
    fn lists_that_are_no_bases() {
        let space = space();
        let refused =
            |list: &[usize]| Basis::new(&space, list).map(|_| ()).unwrap_err().rule == Rule::Bases;
        assert!(Basis::new(&space, &GOOD).is_ok());
        let changed = |i: usize, l: usize| {
            let mut list = GOOD;
            list[i] = l;
            refused(&list)
        };
        assert!(changed(11, 17) && changed(0, 0), "beyond the differences");
        assert!(changed(1, 1) && changed(1, 4), "twice, and not increasing");
        assert!(refused(&GOOD[1..]) && refused(&[]), "too few");
        assert!(refused(&[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 14, 16]), "too many");
        assert!(refused(&[1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 15]), "dependent");
        // Of the sets of nine at n = 6 some are bases and some are not.
        let six = with_beta(6);
        let sets = (0..1u32 << 15).filter(|set| set.count_ones() == 9).step_by(97);
        let list = |set: u32| (1..=15).filter(|l| set >> (l - 1) & 1 == 1).collect::<Vec<usize>>();
        let (mut independent, mut dependent) = (0, 0);
        for set in sets {
            let list = list(set);
            let rows: Vec<_> = list.iter().map(|l| six.rows[l - 1].clone()).collect();
            match (Basis::new(&six, &list), rank(&rows, 12)) {
                (Ok(_), 9) => independent += 1,
                (Err(_), 0..9) => dependent += 1,
                other => panic!("{list:?}: {:?}", other.1),
            }
        }
        assert!(independent > 0 && dependent > 0);
    }

    #[test]
    fn weights_of_known_combinations() {
        let space = space();
        let differences = differences(&space);
        let basis = Basis::new(&space, &GOOD).unwrap();
        // 2/3 alpha_5 - 3/4 alpha_9 + 1/5 alpha_16: the weight is 2/3 + 3/4 + 1/5.
        let terms = [(ratio(2, 3), 5), (ratio(-3, 4), 9), (ratio(1, 5), 16)];
        let terms: Vec<_> = terms.iter().map(|(c, l)| (c.clone(), &differences[l - 1])).collect();
        let form = Form::mix(space.size, &terms);
        let weight = basis.weight(&space, &form).unwrap();
        assert!((&weight - &Scalar::constant(&ratio(97, 60))).is_zero());
        // A difference outside of the basis has some weight; a single point is not in the span.
        assert!(basis.weight(&space, &differences[7]).is_ok());
        let fault = basis.weight(&space, &Form::point(3, space.size)).unwrap_err();
        assert_eq!(fault.rule, Rule::Bases);
    }

    #[test]
    fn a_multiplier_of_unknown_sign_counts_with_its_magnitude() {
        let space = Loop::space(
            7,
            Ring::Powers(Interval::outward(&ratio(1, 4), &ratio(1, 2))),
            Scalar::generator(1),
        );
        let differences = differences(&space);
        let basis = Basis::new(&space, &GOOD).unwrap();
        // beta alpha_5 - (3/8 - beta) alpha_6: the second is within 1/8, of either sign.
        let (first, second) =
            (Scalar::generator(1), &Scalar::generator(1) - &Scalar::constant(&ratio(3, 8)));
        let form = Form::sum(
            &space.ring,
            space.size,
            &[(&first, &differences[4]), (&second, &differences[5])],
        );
        let weight = basis.weight(&space, &form).unwrap();
        assert!((&weight - &(&first + &Scalar::constant(&ratio(1, 8)))).is_zero());
    }
}
