//! The eigenvectors that don't vanish on the first ring, one frequency at a time.
//!
//! **Reduction.** Let a net have the value x_0 at the centre and `w^j z_q` at the inner kind q. For
//! k >= 1 the centre is 0 (the sum of w^j is) and A acts by a matrix M' on z: 1 x 1 (Loop) or 2 x 2
//! (Catmull-Clark). For k = 0 constants are kept, so A acts on the differences u_q = z_q - x_0, by
//! `M'_pq = A_pq - A_0q`. An eigenvector u of M', λ != 1, belongs to
//! `x_0 = (Σ A_0q u_q) / (λ - 1)`, for `λ x_0 = x_0 + Σ A_0q u_q`. A left eigenvector l of M' is the
//! functional l(u) of A: the second ring doesn't act on the first.
//!
//! **Eigenvectors of M'** = (p q / r s): λ = p, if it is 1 x 1. Else λ runs through the roots of
//! `x^2 - (p + s) x + (p s - q r)`, with the right eigenvector (1, (λ - p) / q) and the left one
//! (λ - s, q), whose product is 2 λ - p - s: plus or minus the root of the discriminant. If q = r = 0,
//! they are the unit vectors. Coordinates are exact, so "is 0" is decided.
//!
//! **Extension.** Let v be a net with these values and 0 on the second ring, r the values of A v there,
//! and `r = Σ ρ_m u_m` in the local modes of [`super::outer`], μ_m their eigenvalues. Then
//! `v + Σ_(μ_m != λ) ρ_m / (λ - μ_m) u_m` is mapped to λ times itself, plus `Σ_(μ_m = λ) ρ_m u_m`. If
//! that sum is 0, it is an eigenvector (an eigenvalue in common has decoupled). If not, it is a
//! *generalised* eigenvector: there is a Jordan block, and this is its chain.

use num_traits::Zero;

use super::eigenvalue::{Eigenvalue, Root, discriminant};
use super::outer::OuterMode;
use super::phase::{Frequency, Phase};
use super::represent::Represent;
use super::two_ring::{Point, Stencil, TwoRing};
use crate::scalar::{Cyclotomic, Decide, Field, Interval, Rational, Ring};

/// The values of a net of frequency k: those of sector j are `w^j` times those of sector 0.
#[derive(Clone, Debug)]
pub struct FourierNet<S> {
    /// The value at the centre; 0 for k >= 1.
    pub center: Phase<S>,
    /// The values at the kinds of points of sector 0.
    pub kinds: Vec<Phase<S>>,
}

impl<S: Field> FourierNet<S> {
    /// The value of a stencil at this net.
    pub fn at(&self, frequency: &Frequency<S>, stencil: &Stencil<S>) -> Phase<S> {
        stencil.terms().fold(Phase::zero(), |sum, (point, weight)| {
            let value = match point {
                Point::Center => self.center.clone(),
                Point::Sector { kind, sector } => {
                    frequency.product(&self.kinds[kind], frequency.power(i64::from(sector)))
                }
            };
            sum + &(value * weight)
        })
    }

    fn map<T>(&self, image: impl Fn(&S) -> Option<T>) -> Option<FourierNet<T>> {
        let kinds = self.kinds.iter().map(|z| z.map(&image));
        Some(FourierNet {
            center: self.center.map(&image)?,
            kinds: kinds.collect::<Option<_>>()?,
        })
    }
}

/// An eigenvector of one frequency, with its dual.
#[derive(Clone, Debug)]
pub struct InnerMode<S> {
    /// The frequency k, 0 <= k <= n/2; for 0 < k < n/2 also that of the conjugate, n - k.
    pub frequency: u32,
    /// The eigenvalue, exactly.
    pub eigenvalue: Eigenvalue,
    /// The right eigenvector: the first inner kind that it doesn't vanish on has the value 1.
    pub right: FourierNet<S>,
    /// The left eigenvector l, on the centre and the inner kinds. For k >= 1 the coefficient of this
    /// mode in a net x is `(1/n) Σ_j Σ_q w^-j l_q x_(q,j)`; for k = 0 also l_0 times x at the centre.
    pub left: FourierNet<S>,
    /// `A v - λ v` as coefficients of the local modes; empty for an eigenvector. For a coefficient
    /// ρ of the mode m, `w^j ρ` belongs to its copy in sector j.
    pub chain: Vec<(usize, Phase<S>)>,
}

/// All inner modes of a frequency, the constant excepted; `None` if S lacks one of their numbers.
pub fn inner_modes<S: Represent>(
    ring: &TwoRing<Cyclotomic>,
    outer: &[OuterMode<Cyclotomic>],
    k: u32,
) -> Option<Vec<InnerMode<S>>> {
    let frequency = Frequency::<Cyclotomic>::new(ring.valence(), k)?;
    let matrix = reduced_matrix(ring, &frequency);
    let mut modes = Vec::new();
    for (eigenvalue, branch) in eigenvalues(&frequency, &matrix) {
        let mode = match &eigenvalue {
            Eigenvalue::Exact(value) => {
                let exact = extend(ring, outer, &frequency, &matrix, value, branch);
                exact.map(S::of_exact)
            }
            Eigenvalue::Root(root) => enclosed(ring, outer, k, &matrix, root)?.map(S::of_enclosure),
        };
        modes.push(mode?.with(k, eigenvalue));
    }
    Some(modes)
}

/// The matrix M' at the head of this file.
fn reduced_matrix(
    ring: &TwoRing<Cyclotomic>,
    frequency: &Frequency<Cyclotomic>,
) -> Vec<Vec<Phase<Cyclotomic>>> {
    let inner = ring.rules().inner_kinds();
    let unit = |q: usize| FourierNet {
        center: Phase::zero(),
        kinds: (0..ring.rules().kinds())
            .map(|p| Phase::real(Cyclotomic::from_integer(i64::from(p == q))))
            .collect(),
    };
    let row = |p: usize| {
        let entry = |q: usize| {
            let image = unit(q).at(frequency, ring.kind(p));
            if frequency.number() == 0 {
                image - &unit(q).at(frequency, ring.center())
            } else {
                image
            }
        };
        (0..inner).map(entry).collect()
    };
    (0..inner).map(row).collect()
}

/// Which eigenvector of M' an eigenvalue has.
#[derive(Clone, Copy)]
enum Branch {
    /// The one with first coordinate 1.
    Generic,
    /// The unit vector of a kind.
    Unit(usize),
}

fn eigenvalues(
    frequency: &Frequency<Cyclotomic>,
    matrix: &[Vec<Phase<Cyclotomic>>],
) -> Vec<(Eigenvalue, Branch)> {
    // Reflections commute with A, so these numbers are real.
    let real = |z: Phase<Cyclotomic>| {
        assert!(z.y.is_zero(), "a scheme without mirror symmetry");
        z.x
    };
    let [first, second] = match matrix {
        [row] => return vec![(Eigenvalue::Exact(real(row[0].clone())), Branch::Unit(0))],
        [first, second] => [first, second],
        _ => unreachable!("one or two inner kinds"),
    };
    if first[1].is_zero() && second[0].is_zero() {
        let entry = |q: usize| Eigenvalue::Exact(real(matrix[q][q].clone()));
        return (0..2).map(|q| (entry(q), Branch::Unit(q))).collect();
    }
    assert!(
        !first[1].is_zero(),
        "faces act on edges if edges act on faces"
    );
    let trace = real(first[0].clone() + &second[1]);
    let determinant =
        real(frequency.product(&first[0], &second[1]) - &frequency.product(&first[1], &second[0]));
    let square_root = discriminant(&trace, &determinant).to_rational();
    let square_root = square_root.and_then(|d| rational_square_root(&d));
    let value = |larger: bool| match &square_root {
        Some(root) => {
            let root = Cyclotomic::from_rational(root);
            let sum = if larger {
                trace.clone() + &root
            } else {
                trace.clone() - &root
            };
            Eigenvalue::Exact(sum * &Cyclotomic::ratio(1, 2))
        }
        None => Eigenvalue::Root(Root {
            trace: trace.clone(),
            determinant: determinant.clone(),
            larger,
        }),
    };
    [true, false]
        .map(|larger| (value(larger), Branch::Generic))
        .into()
}

/// The square root of a rational, if it is one.
fn rational_square_root(x: &Rational) -> Option<Rational> {
    let root = |a: &num_bigint::BigInt| {
        let root = (!num_traits::Signed::is_negative(a)).then(|| a.sqrt())?;
        (&root * &root == *a).then_some(root)
    };
    Some(Rational::new(root(x.numer())?, root(x.denom())?))
}

/// The parts of an inner mode that depend on the arithmetic.
struct Vectors<S> {
    right: FourierNet<S>,
    left: FourierNet<S>,
    chain: Vec<(usize, Phase<S>)>,
}

impl<S: Field> Vectors<S> {
    fn map<T>(&self, image: impl Fn(&S) -> Option<T>) -> Option<Vectors<T>> {
        let chain = self.chain.iter().map(|(m, z)| Some((*m, z.map(&image)?)));
        Some(Vectors {
            right: self.right.map(&image)?,
            left: self.left.map(&image)?,
            chain: chain.collect::<Option<_>>()?,
        })
    }

    fn with(self, frequency: u32, eigenvalue: Eigenvalue) -> InnerMode<S> {
        InnerMode {
            frequency,
            eigenvalue,
            right: self.right,
            left: self.left,
            chain: self.chain,
        }
    }
}

/// The vectors of a root, by intervals. The root is certainly none of the local eigenvalues, which
/// are rational and which its polynomial is not 0 at.
fn enclosed(
    ring: &TwoRing<Cyclotomic>,
    outer: &[OuterMode<Cyclotomic>],
    k: u32,
    matrix: &[Vec<Phase<Cyclotomic>>],
    root: &Root,
) -> Option<Vectors<Interval>> {
    let ring = ring.map(Interval::of_exact)?;
    let outer: Option<Vec<OuterMode<Interval>>> = outer
        .iter()
        .map(|mode| mode.map(Interval::of_exact))
        .collect();
    let matrix: Vec<Vec<Phase<Interval>>> = (matrix.iter())
        .map(|row| row.iter().map(|z| z.map(Interval::of_exact)).collect())
        .collect::<Option<_>>()?;
    let frequency = Frequency::<Interval>::new(ring.valence(), k)?;
    Some(extend(
        &ring,
        &outer?,
        &frequency,
        &matrix,
        &root.enclose(),
        Branch::Generic,
    ))
}

/// The vectors of an eigenvalue of M', extended to the two-ring as the head of this file has it.
///
/// Over intervals λ must be apart from every local eigenvalue.
fn extend<S: Decide>(
    ring: &TwoRing<S>,
    outer: &[OuterMode<S>],
    frequency: &Frequency<S>,
    matrix: &[Vec<Phase<S>>],
    eigenvalue: &S,
    branch: Branch,
) -> Vectors<S> {
    let inner = ring.rules().inner_kinds();
    let lambda = Phase::real(eigenvalue.clone());
    let unit = |kind: usize| {
        let entry = |q| Phase::real(S::from_integer(i64::from(q == kind)));
        (0..inner).map(entry).collect::<Vec<_>>()
    };
    let (u, l) = match branch {
        Branch::Unit(kind) => (unit(kind), unit(kind)),
        Branch::Generic => {
            let over_edge = lambda.clone() - &matrix[0][0];
            let over_face = lambda - &matrix[1][1];
            let across = &matrix[0][1];
            let face = frequency.product(&over_edge, &frequency.inverse(across));
            let edge = Phase::real(S::one());
            (vec![edge, face], vec![over_face, across.clone()])
        }
    };
    let pairing =
        (u.iter().zip(&l)).fold(Phase::zero(), |sum, (a, b)| sum + &frequency.product(a, b));
    let scale = frequency.inverse(&pairing);
    let l: Vec<Phase<S>> = l.iter().map(|b| frequency.product(b, &scale)).collect();
    let padded = |values: Vec<Phase<S>>| {
        let outer = ring.rules().kinds() - inner;
        let zeros = std::iter::repeat_n(Phase::zero(), outer);
        values.into_iter().chain(zeros).collect::<Vec<_>>()
    };

    let mut right = FourierNet {
        center: Phase::zero(),
        kinds: padded(u),
    };
    let mut left = FourierNet {
        center: Phase::zero(),
        kinds: padded(l),
    };
    if frequency.number() == 0 {
        let pull = right.at(frequency, ring.center()).x;
        right.center = Phase::real(pull / &(eigenvalue.clone() - &S::one()));
        for z in &mut right.kinds[..inner] {
            *z = z.clone() + &right.center;
        }
        left.center = (left.kinds.iter()).fold(Phase::zero(), |sum, b| sum - b);
        normalise(&mut right, &mut left, inner);
    }

    let images: Vec<Phase<S>> = (0..ring.rules().kinds())
        .map(|kind| match kind {
            kind if kind < inner => Phase::zero(),
            kind => right.at(frequency, ring.kind(kind)),
        })
        .collect();
    let image = FourierNet {
        center: Phase::zero(),
        kinds: images,
    };
    let mut chain = Vec::new();
    for (m, mode) in outer.iter().enumerate() {
        let coefficient = image.at(frequency, &mode.dual);
        let gap = eigenvalue.clone() - &mode.eigenvalue;
        if gap.is_zero() {
            if !coefficient.is_zero() {
                chain.push((m, coefficient));
            }
            continue;
        }
        let coefficient = coefficient * &(S::one() / &gap);
        for (point, weight) in mode.vector.terms() {
            let Point::Sector { kind, sector } = point else {
                unreachable!("local modes vanish at the centre")
            };
            // The copy in sector -o has its point o in sector 0.
            let turned = frequency.product(&coefficient, frequency.power(-i64::from(sector)));
            right.kinds[kind] = right.kinds[kind].clone() + &(turned * weight);
        }
    }
    Vectors { right, left, chain }
}

/// Scales a real pair so that the right net has the value 1 at the first inner kind where it is
/// certainly not 0.
fn normalise<S: Decide>(right: &mut FourierNet<S>, left: &mut FourierNet<S>, inner: usize) {
    let mut values = right.kinds[..inner].iter().map(|z| z.x.clone());
    let not_zero = |x: &S| matches!(x.decide(&S::zero()), Some(order) if order.is_ne());
    let Some(value) = values.find(not_zero) else {
        return;
    };
    let scale = |net: &mut FourierNet<S>, factor: &S| {
        net.center = net.center.clone() * factor;
        net.kinds.iter_mut().for_each(|z| *z = z.clone() * factor);
    };
    scale(right, &(S::one() / &value));
    scale(left, &value);
}
