//! The modes whose distances are tabulated, as nets over one sector or two.

use std::fmt;

use super::complex::Complex;
use super::lattice::Place;
use crate::scalar::Field;
use crate::scheme::LoopWeights;
use crate::spectrum::Represent;
use crate::spectrum::loop_modes::{Family, Mode, loop_modes};

/// The family of a mode in certificates and tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ModeFamily {
    /// A Fourier mode with values on the first ring.
    Ring,
    /// b alone: at one ray, or, of frequency 0, at all of them.
    Ray,
    /// `d_0 = b_0 = b_1 = 1`.
    Between,
}

impl fmt::Display for ModeFamily {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ModeFamily::Ring => "ring",
            ModeFamily::Ray => "ray",
            ModeFamily::Between => "between",
        })
    }
}

/// Which mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Label {
    /// The family.
    pub family: ModeFamily,
    /// The frequency; `None` for the modes of one sector.
    pub frequency: Option<u32>,
}

/// The mode that the chain of a generalised one leads to: all b_j = 1.
pub const CHAINED: Label = Label {
    family: ModeFamily::Ray,
    frequency: Some(0),
};

impl Label {
    /// Whether sector 0 has the same magnitudes at (p, q) and (q, p): modes with a frequency.
    pub fn is_mirror_symmetric(self) -> bool {
        self.frequency.is_some()
    }

    /// The sectors whose magnitudes differ: 0, and for `between` 1.
    pub fn sectors(self) -> usize {
        match self.family {
            ModeFamily::Between => 2,
            ModeFamily::Ring | ModeFamily::Ray => 1,
        }
    }
}

/// What continues a sector across a ray.
#[derive(Clone, Debug)]
pub enum Link<S> {
    /// Nothing but zeros.
    Zero,
    /// Sector 0 times a number of modulus 1.
    Turned(Complex<S>),
    /// A listed sector.
    Plain(usize),
    /// The mirror image of a listed sector.
    Mirrored(usize),
}

/// The two-ring of one sector.
#[derive(Clone, Debug)]
pub struct Sector<S> {
    /// The points that are not 0.
    pub points: Vec<(Place, Complex<S>)>,
    /// The sector before.
    pub before: Link<S>,
    /// The sector behind.
    pub behind: Link<S>,
}

/// The control net of a mode: what differs among its sectors.
#[derive(Clone, Debug)]
pub struct Net<S> {
    /// Which mode.
    pub label: Label,
    /// λ.
    pub eigenvalue: S,
    /// The sectors.
    pub sectors: Vec<Sector<S>>,
    /// κ, if `A y = λ y + κ f`, f the mode `ray` of frequency 0.
    pub kappa: Option<S>,
}

/// The modes of valence n whose distance from the control polyhedron is not 0, in the order of
/// [`loop_modes`]; before a generalised one (n = 3) comes the mode that its chain leads to. With them,
/// apart, the characteristic map.
///
/// `None` if and only if S lacks a number that occurs.
pub fn nets<S: Represent>(weights: LoopWeights, n: u32) -> Option<(Net<S>, Vec<Net<S>>)> {
    let (_, modes) = loop_modes::<S>(weights, n)?;
    let (mut chi, mut list) = (None, Vec::new());
    for (mode, _) in &modes {
        match (mode.family, mode.frequency) {
            (Family::Constant, _) => (),
            (Family::Ring, 1) => chi = Some(ring(mode, n)?),
            (Family::Ring, _) => {
                if mode.generalised.is_some() {
                    list.push(rays(mode.eigenvalue.clone()));
                }
                list.push(ring(mode, n)?);
            }
            (Family::Between, _) => list.push(between(mode)),
            (Family::Ray, _) => list.push(ray(mode)),
        }
    }
    Some((chi?, list))
}

/// `a_j = ring w^j`, `d_j = between (w^j + w^(j+1))`, `b_j = ray w^j`.
///
/// A generalised mode may be changed by any multiple of f, whose b_j are 1: the one with b_j = 0 is taken.
fn ring<S: Field>(mode: &Mode<S>, n: u32) -> Option<Net<S>> {
    let w = Complex::<S>::root_of_unity(mode.frequency, n)?;
    let one = Complex::real(S::one());
    let ray = match mode.generalised {
        Some(_) => S::zero(),
        None => mode.ray.clone(),
    };
    Some(Net {
        label: Label {
            family: ModeFamily::Ring,
            frequency: Some(mode.frequency),
        },
        eigenvalue: mode.eigenvalue.clone(),
        sectors: vec![Sector {
            points: vec![
                ([0, 0], Complex::real(mode.center.clone())),
                ([1, 0], one.clone() * &mode.ring),
                ([0, 1], w.clone() * &mode.ring),
                ([1, 1], (one.clone() + &w) * &mode.between),
                ([2, 0], one * &ray),
                ([0, 2], w.clone() * &ray),
            ],
            before: Link::Turned(w.conjugate()),
            behind: Link::Turned(w),
        }],
        kappa: mode.generalised.as_ref().map(|chain| chain.ray.clone()),
    })
}

/// All b_j = 1.
fn rays<S: Field>(eigenvalue: S) -> Net<S> {
    let one = || Complex::real(S::one());
    Net {
        label: CHAINED,
        eigenvalue,
        sectors: vec![Sector {
            points: vec![([2, 0], one()), ([0, 2], one())],
            before: Link::Turned(one()),
            behind: Link::Turned(one()),
        }],
        kappa: None,
    }
}

/// b_0 = 1. The sector before is the mirror image of sector 0, the one behind is 0.
fn ray<S: Field>(mode: &Mode<S>) -> Net<S> {
    Net {
        label: Label {
            family: ModeFamily::Ray,
            frequency: None,
        },
        eigenvalue: mode.eigenvalue.clone(),
        sectors: vec![Sector {
            points: vec![([2, 0], Complex::real(mode.ray.clone()))],
            before: Link::Mirrored(0),
            behind: Link::Zero,
        }],
        kappa: None,
    }
}

/// `d_0 = b_0 = b_1 = 1`. Sector 0 lies between sector 1, where b_1 is on the first ray, and its mirror
/// image; next to sector 1 all is 0.
fn between<S: Field>(mode: &Mode<S>) -> Net<S> {
    let value = |x: &S| Complex::real(x.clone());
    let (d, b) = (value(&mode.between), value(&mode.ray));
    Net {
        label: Label {
            family: ModeFamily::Between,
            frequency: None,
        },
        eigenvalue: mode.eigenvalue.clone(),
        sectors: vec![
            Sector {
                points: vec![([1, 1], d), ([2, 0], b.clone()), ([0, 2], b.clone())],
                before: Link::Mirrored(1),
                behind: Link::Plain(1),
            },
            Sector {
                points: vec![([2, 0], b)],
                before: Link::Plain(0),
                behind: Link::Zero,
            },
        ],
        kappa: None,
    }
}
