//! Complex numbers x + y w, w = e^(2πi k/n), with real coordinates: the values of a Fourier mode.
//!
//! A net of frequency k has the value `w^j z` at the point of sector j whose value in sector 0 is z.
//! With `w^2 = c w - 1`, c = 2 cos 2πk/n, all of it stays in the field of c: nothing asks for
//! sin 2πk/n. For w = 1 and w = -1 the y of every [`Phase`] is 0.
//!
//! | of z = x + y w | formula |
//! |---|---|
//! | even part, Re z | `x + y c/2` |
//! | odd part, Im z / sin(2πk/n) | `y` |
//! | conj z | `(x + c y) - y w` |
//! | abs(z)^2 | `x^2 + c x y + y^2` |
//! | `w^j` | `-s_(j-1) + s_j w`, `s_j = sin(2πkj/n) / sin(2πk/n)`, `s_(j+1) = s_(j-1) + 2 cos(2πkj/n)` |

use std::ops::{Add, Mul, Sub};

use num_traits::Zero;

use crate::scalar::Field;

/// The number x + y w of a frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Phase<S> {
    /// The part along 1.
    pub x: S,
    /// The part along w; 0 if w is real.
    pub y: S,
}

impl<S: Field> Phase<S> {
    /// A real number.
    pub fn real(x: S) -> Self {
        Phase { x, y: S::zero() }
    }

    /// The same number in another arithmetic; `None` if a coordinate has no image.
    pub fn map<T>(&self, image: impl Fn(&S) -> Option<T>) -> Option<Phase<T>> {
        Some(Phase {
            x: image(&self.x)?,
            y: image(&self.y)?,
        })
    }
}

impl<S: Field> Zero for Phase<S> {
    fn zero() -> Self {
        Self::real(S::zero())
    }
    fn is_zero(&self) -> bool {
        self.x.is_zero() && self.y.is_zero()
    }
}

impl<S: Field> Add for Phase<S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self + &other
    }
}

impl<S: Field> Add<&Self> for Phase<S> {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        Phase {
            x: self.x + &other.x,
            y: self.y + &other.y,
        }
    }
}

impl<S: Field> Sub<&Self> for Phase<S> {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        Phase {
            x: self.x - &other.x,
            y: self.y - &other.y,
        }
    }
}

impl<S: Field> Mul<&S> for Phase<S> {
    type Output = Self;
    fn mul(self, factor: &S) -> Self {
        Phase {
            x: self.x * factor,
            y: self.y * factor,
        }
    }
}

/// The frequency k of valence n: what multiplies by w.
#[derive(Clone, Debug)]
pub struct Frequency<S> {
    n: u32,
    k: u32,
    /// 2 cos 2πk/n.
    c: S,
    /// The powers w^0, .., w^(n-1).
    powers: Vec<Phase<S>>,
}

impl<S: Field> Frequency<S> {
    /// The frequency k of valence n; `None` if and only if S lacks a cosine of it.
    ///
    /// # Panics
    /// If n = 0.
    pub fn new(n: u32, k: u32) -> Option<Self> {
        let k = k % n;
        let cosine = |j: u32| {
            let j = (u64::from(j) * u64::from(k) % u64::from(n)) as u32;
            S::two_cos(j, n)
        };
        let mut powers = Vec::with_capacity(n as usize);
        if (2 * k).is_multiple_of(n) {
            let half = S::ratio(1, 2);
            for j in 0..n {
                powers.push(Phase::real(cosine(j)? * &half));
            }
        } else {
            let (mut before, mut here) = (-S::one(), S::zero());
            for j in 0..n {
                powers.push(Phase {
                    x: -before.clone(),
                    y: here.clone(),
                });
                // s_(j+1) = s_(j-1) + 2 cos(2πkj/n).
                let next = before + &cosine(j)?;
                before = std::mem::replace(&mut here, next);
            }
        }
        let c = cosine(1)?;
        Some(Frequency { n, k, c, powers })
    }

    /// The frequency k, below n.
    pub fn number(&self) -> u32 {
        self.k
    }

    /// The valence n.
    pub fn valence(&self) -> u32 {
        self.n
    }

    /// 2 cos 2πk/n.
    pub fn two_cos(&self) -> &S {
        &self.c
    }

    /// sin^2 2πk/n = 1 - c^2/4.
    pub fn sine_squared(&self) -> S {
        S::one() - &(self.c.clone() * &self.c * &S::ratio(1, 4))
    }

    /// Whether w is 1 or -1: then the frequency has one real mode where others have a pair.
    pub fn is_real(&self) -> bool {
        (2 * self.k).is_multiple_of(self.n)
    }

    /// w^j.
    pub fn power(&self, j: i64) -> &Phase<S> {
        &self.powers[j.rem_euclid(i64::from(self.n)) as usize]
    }

    /// The product of two numbers: (x + y w)(u + v w) = x u - y v + (x v + y u + c y v) w.
    pub fn product(&self, a: &Phase<S>, b: &Phase<S>) -> Phase<S> {
        if self.is_real() {
            return Phase::real(a.x.clone() * &b.x);
        }
        if a.y.is_zero() {
            return b.clone() * &a.x;
        }
        if b.y.is_zero() {
            return a.clone() * &b.x;
        }
        let yv = a.y.clone() * &b.y;
        let across = a.x.clone() * &b.y + &(a.y.clone() * &b.x);
        Phase {
            x: a.x.clone() * &b.x - &yv,
            y: across + &(yv * &self.c),
        }
    }

    /// The conjugate.
    pub fn conjugate(&self, a: &Phase<S>) -> Phase<S> {
        Phase {
            x: a.x.clone() + &(a.y.clone() * &self.c),
            y: -a.y.clone(),
        }
    }

    /// 1 / a, a certainly not 0 (else a panic in exact types, the whole line in intervals).
    pub fn inverse(&self, a: &Phase<S>) -> Phase<S> {
        let norm = self.product(a, &self.conjugate(a)).x;
        self.conjugate(a) * &(S::one() / &norm)
    }

    /// Re a.
    pub fn even(&self, a: &Phase<S>) -> S {
        a.x.clone() + &(a.y.clone() * &self.c * &S::ratio(1, 2))
    }

    /// Im a / sin(2πk/n); 0 for real w.
    pub fn odd(&self, a: &Phase<S>) -> S {
        a.y.clone()
    }
}
