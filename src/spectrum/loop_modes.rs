//! Loop's modes in the normal form `a_j = ring w^j`, `d_j = between (w^j + w^(j+1))`, `b_j = ray w^j`.
//!
//! w = e^(2πi k/n), k the frequency. All amplitudes lie in Q(2 cos 2π/n).

use num_traits::Zero;

use super::inner::InnerMode;
use super::phase::Phase;
use super::{Member, Parity, Represent, Rules, Spectrum};
use crate::scheme::LoopWeights;

/// What kind of eigenvector a mode of Loop's scheme has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Family {
    /// 1 at every point, of eigenvalue 1.
    Constant,
    /// A Fourier mode with values on the first ring.
    Ring,
    /// The local mode `d_0 = between`, `b_0 = b_1 = ray`: one for each sector, eigenvalue 1/8.
    Between,
    /// The local mode `b_0 = ray`: one for each sector, eigenvalue 1/16.
    Ray,
}

/// A mode of Loop's scheme.
///
/// | field | Constant | Ring, frequency k | Between, Ray |
/// |---|---|---|---|
/// | frequency | 0 | 0 <= k <= n/2; the mode of n - k is the conjugate | 0: see [`Family`] |
/// | center | 1 | 0 for k >= 1 | 0 |
/// | ring | 1 | 1 | 0 |
/// | between | 1/2: d_j = 1 | of `w^j + w^(j+1)`; 0 at k = n/2, where this sum is 0 | value of d_0 |
/// | ray | 1 | of `w^j` | value of b_0 (and b_1) |
///
/// The largest modulus on the first ring is 1 (Ring), over all points 1 (local modes).
#[derive(Clone, Debug, PartialEq)]
pub struct Mode<S> {
    /// The kind.
    pub family: Family,
    /// The frequency k of a Fourier mode.
    pub frequency: u32,
    /// The eigenvalue.
    pub eigenvalue: S,
    /// Value at the extraordinary vertex.
    pub center: S,
    /// Amplitude on the first ring.
    pub ring: S,
    /// Amplitude between the rays.
    pub between: S,
    /// Amplitude on the rays of the second ring.
    pub ray: S,
    /// `A v - λ v`, if that is not 0: v is then a generalised eigenvector.
    pub generalised: Option<Chain<S>>,
}

/// The eigenvector `A v - λ v` of a generalised eigenvector v, in the same normal form; it vanishes
/// on the centre and the first ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain<S> {
    /// Amplitude between the rays.
    pub between: S,
    /// Amplitude on the rays of the second ring.
    pub ray: S,
}

/// A mode and the members of the [`Spectrum`] whose nets are its real nets.
pub type Listed<S> = (Mode<S>, Vec<Member>);

/// The modes of Loop's scheme in a spectrum: the constant; Ring of frequency 0, 1, .., n/2; Between;
/// Ray. With each its members: one or two parts ([`Parity`]), or n sectors.
///
/// ```
/// use subcert::scalar::{Field, Rational};
/// use subcert::scheme::LoopWeights;
/// use subcert::spectrum::loop_modes::{Family, loop_modes};
///
/// let (_, modes) = loop_modes::<Rational>(LoopWeights::Warren, 4).unwrap();
/// let eigenvalues: Vec<String> = modes.iter().map(|(m, _)| m.eigenvalue.to_string()).collect();
/// assert_eq!(eigenvalues, ["1", "1/4", "3/8", "1/8", "1/8", "1/16"]);
///
/// // n = 3: the eigenvalue of frequency 0 meets that of the rays, in a Jordan block.
/// let (_, modes) = loop_modes::<Rational>(LoopWeights::Warren, 3).unwrap();
/// assert_eq!(modes[1].0.eigenvalue, Rational::ratio(1, 16));
/// assert!(modes[1].0.generalised.is_some());
/// ```
///
/// `None` if and only if S lacks a number that occurs (rationals: unless n is 3, 4 or 6).
///
/// # Panics
/// If n < 3.
pub fn loop_modes<S: Represent>(
    weights: LoopWeights,
    n: u32,
) -> Option<(Spectrum<S>, Vec<Listed<S>>)> {
    let spectrum = Spectrum::<S>::new(Rules::Loop(weights), n)?;
    let mut modes = vec![(constant(), vec![Member::Constant])];
    for (mode, inner) in spectrum.inner().iter().enumerate() {
        let parity = [Parity::Even, Parity::Odd].map(|parity| Member::Inner { mode, parity });
        let real = inner.frequency == 0 || 2 * inner.frequency == n;
        let members = parity[..if real { 1 } else { 2 }].to_vec();
        modes.push((ring(inner, n)?, members));
    }
    for (mode, family) in [Family::Between, Family::Ray].into_iter().enumerate() {
        let vector = &spectrum.outer()[mode].vector;
        let at = |kind| vector.at(super::Point::of(n, kind, 0));
        let member = |sector| Member::Outer { mode, sector };
        let local = Mode {
            family,
            frequency: 0,
            eigenvalue: spectrum.outer()[mode].eigenvalue.clone(),
            center: S::zero(),
            ring: S::zero(),
            between: at(1),
            ray: at(2),
            generalised: None,
        };
        modes.push((local, (0..n).map(member).collect()));
    }
    Some((spectrum, modes))
}

fn constant<S: Represent>() -> Mode<S> {
    Mode {
        family: Family::Constant,
        frequency: 0,
        eigenvalue: S::one(),
        center: S::one(),
        ring: S::one(),
        between: S::ratio(1, 2),
        ray: S::one(),
        generalised: None,
    }
}

/// By reflection, real on the rays and a multiple of 1 + w between them: 2 at k = 0, 0 at k = n/2.
fn ring<S: Represent>(inner: &InnerMode<S>, n: u32) -> Option<Mode<S>> {
    let between = |d: &Phase<S>| match inner.frequency {
        0 => d.x.clone() * &S::ratio(1, 2),
        _ => d.y.clone(),
    };
    let kinds = &inner.right.kinds;
    // Between s (1 + w) also has s (1 + w)(1 + w^-1) = s (2 + c) on the rays.
    let c = S::two_cos(inner.frequency, n)?;
    let generalised = (!inner.chain.is_empty()).then(|| {
        let of = |mode| inner.chain.iter().filter(move |(m, _)| *m == mode);
        let sum = |mode| of(mode).fold(Phase::zero(), |sum: Phase<S>, (_, z)| sum + z);
        let between = between(&sum(0));
        let ray = sum(1).x + &(between.clone() * &(c + &S::from_integer(2)));
        Chain { between, ray }
    });
    Some(Mode {
        family: Family::Ring,
        frequency: inner.frequency,
        eigenvalue: inner.eigenvalue.represent()?,
        center: inner.right.center.x.clone(),
        ring: kinds[0].x.clone(),
        between: between(&kinds[1]),
        ray: kinds[2].x.clone(),
        generalised,
    })
}
