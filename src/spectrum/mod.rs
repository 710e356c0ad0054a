//! The subdivision matrix of a two-ring: eigenvalues, right and left eigenvectors, the
//! characteristic map.
//!
//! The matrix is that of all 1 + 3n (Loop) or 1 + 6n (Catmull-Clark) points of [`two_ring`]. It
//! commutes with the rotations, so it is treated one frequency at a time. No formula for an
//! eigenvalue is written in this room: all are computed from the masks of [`crate::scheme`].
//!
//! | file | idea |
//! |---|---|
//! | [`two_ring`] | layout; the matrix as stencils, by applying the masks to symbols |
//! | [`phase`] | the values of a Fourier mode, in Q(2 cos 2πk/n) |
//! | [`outer`] | eigenvectors that vanish on the first ring: local |
//! | [`inner`] | the others, by frequencies; Jordan blocks are found, not looked up |
//! | [`eigenvalue`] | elements of Q(2 cos 2π/n), or roots of quadratic polynomials over it |
//! | [`square`] | proof that a root does not lie in that field |
//! | [`characteristic`], [`jacobian`] | the characteristic map: regular and injective |
//! | [`table`] | what is claimed of a valence |
//! | [`loop_modes`] | Loop's modes in the normal form of papers |
//! | [`eigenspline`] | distances of the modes from their polyhedra |
//!
//! [`Spectrum`] is a basis of nets and its dual. For a member v of the basis, `A v = λ v`, unless its
//! mode is generalised: then `A v = λ v +` [`Spectrum::chain`].
//!
//! ```
//! use subcert::scalar::{Field, Rational};
//! use subcert::scheme::LoopWeights;
//! use subcert::spectrum::{Rules, Spectrum};
//!
//! // Q = Σ p_i v_i, exactly.
//! let spectrum = Spectrum::<Rational>::new(Rules::Loop(LoopWeights::Original), 4).unwrap();
//! let net: Vec<Rational> = (0..13).map(|i| Rational::ratio(i * i % 7, 3)).collect();
//! assert_eq!(spectrum.compose(&spectrum.coefficients(&net)), net);
//! ```

pub mod characteristic;
pub mod eigenspline;
pub mod eigenvalue;
pub mod inner;
pub mod jacobian;
pub mod loop_modes;
pub mod outer;
pub mod phase;
pub mod represent;
pub mod square;
pub mod table;
pub mod two_ring;

pub use eigenvalue::Eigenvalue;
pub use inner::InnerMode;
pub use outer::OuterMode;
pub use represent::Represent;
pub use two_ring::{Rules, TwoRing};

use crate::scalar::{Cyclotomic, Module};
use inner::FourierNet;
use phase::{Frequency, Phase};
use two_ring::{Point, Stencil};

/// Which of the two real nets of a complex Fourier net v, with values `w^j z`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parity {
    /// Re v: `cos(2πkj/n)` where z = 1.
    Even,
    /// Im v / sin(2πk/n): `sin(2πkj/n) / sin(2πk/n)` where z = 1. The sine is not in the field; its
    /// square is ([`Spectrum::sine_squared`]). Only for 0 < k < n/2.
    Odd,
}

/// A vector of the basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Member {
    /// The net that is 1 everywhere, of eigenvalue 1.
    Constant,
    /// A real net of an inner mode.
    Inner {
        /// Index in [`Spectrum::inner`].
        mode: usize,
        /// Which part.
        parity: Parity,
    },
    /// A local mode.
    Outer {
        /// Index in [`Spectrum::outer`].
        mode: usize,
        /// The sector that it is turned to.
        sector: u32,
    },
}

/// A basis of the nets of a two-ring in which subdivision is diagonal up to Jordan blocks.
#[derive(Clone, Debug)]
pub struct Spectrum<S> {
    ring: TwoRing<S>,
    frequencies: Vec<Frequency<S>>,
    inner: Vec<InnerMode<S>>,
    outer: Vec<OuterMode<S>>,
}

impl<S: Represent> Spectrum<S> {
    /// The spectrum of a scheme at a vertex of valence n.
    ///
    /// Everything is computed exactly first and handed out in S; only what belongs to a quadratic
    /// irrationality over Q(2 cos 2π/n) (Catmull-Clark) is computed by intervals. `f64` gets the
    /// nearest numbers, which prove nothing.
    ///
    /// `None` if and only if S lacks a number that occurs: rationals lack cosines, exact types lack
    /// the roots.
    ///
    /// # Panics
    /// If n < 3.
    pub fn new(rules: Rules, n: u32) -> Option<Self> {
        let exact = TwoRing::<Cyclotomic>::new(rules, n)?;
        let outer = outer::outer_modes(&exact);
        let (mut frequencies, mut inner) = (Vec::new(), Vec::new());
        for k in 0..=n / 2 {
            frequencies.push(Frequency::new(n, k)?);
            inner.extend(inner::inner_modes(&exact, &outer, k)?);
        }
        let outer = outer.iter().map(|mode| mode.map(S::of_exact));
        Some(Spectrum {
            ring: exact.map(S::of_exact)?,
            frequencies,
            inner,
            outer: outer.collect::<Option<_>>()?,
        })
    }

    /// The two-ring and its subdivision.
    pub fn ring(&self) -> &TwoRing<S> {
        &self.ring
    }

    /// The modes with values on the first ring, by frequency; of one frequency, the larger eigenvalue
    /// first. The constant is not among them.
    pub fn inner(&self) -> &[InnerMode<S>] {
        &self.inner
    }

    /// The local modes, each of them n-fold.
    pub fn outer(&self) -> &[OuterMode<S>] {
        &self.outer
    }

    /// sin^2 2πk/n: what the odd net's square is to be multiplied by for an amplitude of 1.
    pub fn sine_squared(&self, k: u32) -> S {
        self.frequencies[k as usize].sine_squared()
    }

    /// The basis, in a fixed order: the constant, the inner modes (even, odd), the local modes by
    /// sectors. As many as there are points.
    pub fn members(&self) -> Vec<Member> {
        let mut members = vec![Member::Constant];
        for (mode, inner) in self.inner.iter().enumerate() {
            let parity = Parity::Even;
            members.push(Member::Inner { mode, parity });
            if !self.frequency(inner).is_real() {
                let parity = Parity::Odd;
                members.push(Member::Inner { mode, parity });
            }
        }
        let sectors = 0..self.ring.valence();
        members.extend((0..self.outer.len()).flat_map(|mode| {
            let member = move |sector| Member::Outer { mode, sector };
            sectors.clone().map(member)
        }));
        members
    }

    /// The eigenvalue of a member.
    pub fn eigenvalue(&self, member: Member) -> S {
        match member {
            Member::Constant => S::one(),
            Member::Inner { mode, .. } => {
                let value = self.inner[mode].eigenvalue.represent();
                value.expect("S has the modes, hence their eigenvalues")
            }
            Member::Outer { mode, .. } => self.outer[mode].eigenvalue.clone(),
        }
    }

    /// The control net of a member.
    pub fn net(&self, member: Member) -> Vec<S> {
        match member {
            Member::Constant => vec![S::one(); self.ring.len()],
            Member::Inner { mode, parity } => {
                let mode = &self.inner[mode];
                self.real_net(self.frequency(mode), &mode.right, parity)
            }
            Member::Outer { mode, sector } => self.dense(&self.outer[mode].vector, sector),
        }
    }

    /// `A v - λ v` for a member v: zero, unless its mode is generalised.
    pub fn chain(&self, member: Member) -> Vec<S> {
        let mut sum = vec![S::zero(); self.ring.len()];
        if let Member::Inner { mode, parity } = member {
            let mode = &self.inner[mode];
            let frequency = self.frequency(mode);
            for (outer, coefficient) in &mode.chain {
                for sector in 0..self.ring.valence() {
                    let turned = frequency.product(coefficient, frequency.power(sector.into()));
                    let weight = part(frequency, &turned, parity);
                    add_scaled(
                        &mut sum,
                        &self.dense(&self.outer[*outer].vector, sector),
                        &weight,
                    );
                }
            }
        }
        sum
    }

    /// The left eigenvector of a member: the functional that is 1 on it and 0 on the other members.
    pub fn left(&self, member: Member) -> Vec<S> {
        match member {
            Member::Constant => {
                // The constant's centre is what the other modes leave of the net's.
                let mut left = vec![S::zero(); self.ring.len()];
                left[0] = S::one();
                self.without_inner(&mut left, |net| net[0].clone());
                left
            }
            Member::Inner { mode, parity } => self.inner_left(&self.inner[mode], parity),
            Member::Outer { mode, sector } => {
                let dual = &self.outer[mode].dual;
                let n = self.ring.valence();
                let mut left = self.dense(dual, sector);
                let constant = dual.apply(n, sector.into(), &self.net(Member::Constant));
                add_scaled(&mut left, &self.left(Member::Constant), &-constant);
                self.without_inner(&mut left, |net| dual.apply(n, sector.into(), net));
                left
            }
        }
    }

    /// The coefficients of a net of points in the basis, in the order of [`Spectrum::members`].
    ///
    /// Exact in exact types, enclosures in intervals.
    ///
    /// # Panics
    /// If the net has not [`TwoRing::len`] points.
    pub fn coefficients<V: Module<S>>(&self, net: &[V]) -> Vec<V> {
        assert_eq!(net.len(), self.ring.len(), "points of a two-ring");
        let (mut rest, mut coefficients) = (net.to_vec(), Vec::new());
        let members = self.members();
        for &member in members
            .iter()
            .filter(|m| !matches!(m, Member::Outer { .. }))
        {
            let left = self.left(member);
            let terms = left.iter().zip(net).filter(|(a, _)| !a.is_zero());
            let coefficient = terms.fold(V::zero(), |sum, (a, p)| sum + &(p.clone() * a));
            for (point, value) in rest.iter_mut().zip(self.net(member)) {
                *point = point.clone() - &(coefficient.clone() * &value);
            }
            coefficients.push(coefficient);
        }
        for member in members {
            if let Member::Outer { mode, sector } = member {
                let dual = &self.outer[mode].dual;
                coefficients.push(dual.apply(self.ring.valence(), sector.into(), &rest));
            }
        }
        coefficients
    }

    /// The net `Σ p_i v_i` of coefficients in the order of [`Spectrum::members`].
    pub fn compose<V: Module<S>>(&self, coefficients: &[V]) -> Vec<V> {
        let mut net = vec![V::zero(); self.ring.len()];
        for (member, coefficient) in self.members().into_iter().zip(coefficients) {
            for (point, value) in net.iter_mut().zip(self.net(member)) {
                if !value.is_zero() {
                    *point = point.clone() + &(coefficient.clone() * &value);
                }
            }
        }
        net
    }

    fn frequency(&self, mode: &InnerMode<S>) -> &Frequency<S> {
        &self.frequencies[mode.frequency as usize]
    }

    fn real_net(&self, frequency: &Frequency<S>, net: &FourierNet<S>, parity: Parity) -> Vec<S> {
        let mut values = vec![part(frequency, &net.center, parity)];
        for z in &net.kinds {
            values.extend((0..i64::from(self.ring.valence())).map(|j| {
                let turned = frequency.product(z, frequency.power(j));
                part(frequency, &turned, parity)
            }));
        }
        values
    }

    /// For a pair of frequencies the net is 2 Re(p v) = 2 Re p Re v - 2 Im p Im v, and
    /// p = (1/n) Σ w^-j l_q x: with m = conj l the coefficients are those of (2/n) Re(w^j m) and of
    /// (2/n) sin^2 Im(w^j m) / sin.
    fn inner_left(&self, mode: &InnerMode<S>, parity: Parity) -> Vec<S> {
        let frequency = self.frequency(mode);
        let conjugate = FourierNet {
            center: frequency.conjugate(&mode.left.center),
            kinds: mode
                .left
                .kinds
                .iter()
                .map(|z| frequency.conjugate(z))
                .collect(),
        };
        let n = i64::from(self.ring.valence());
        let scale = match parity {
            _ if frequency.is_real() => S::ratio(1, n),
            Parity::Even => S::ratio(2, n),
            Parity::Odd => frequency.sine_squared() * &S::ratio(2, n),
        };
        let mut left = self.real_net(frequency, &conjugate, parity);
        left[1..].iter_mut().for_each(|a| *a *= scale.clone());
        left
    }

    fn dense(&self, stencil: &Stencil<S>, sector: u32) -> Vec<S> {
        let n = self.ring.valence();
        let mut net = vec![S::zero(); self.ring.len()];
        for (point, value) in stencil.terms() {
            net[point.turned(n, sector.into()).index(n)] = value.clone();
        }
        net
    }

    /// Subtracts from a functional f the left vectors of the inner members, times f of their nets:
    /// it then vanishes on these.
    fn without_inner(&self, functional: &mut [S], value: impl Fn(&[S]) -> S) {
        for member in self.members() {
            if matches!(member, Member::Inner { .. }) {
                let weight = value(&self.net(member));
                if !weight.is_zero() {
                    add_scaled(functional, &self.left(member), &-weight);
                }
            }
        }
    }
}

fn part<S: Represent>(frequency: &Frequency<S>, z: &Phase<S>, parity: Parity) -> S {
    match parity {
        Parity::Even => frequency.even(z),
        Parity::Odd => frequency.odd(z),
    }
}

fn add_scaled<S: Represent>(sum: &mut [S], net: &[S], factor: &S) {
    for (a, b) in sum.iter_mut().zip(net).filter(|(_, b)| !b.is_zero()) {
        *a += b.clone() * factor;
    }
}
