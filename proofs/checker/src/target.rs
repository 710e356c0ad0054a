//! Targets: the difference of the surface and a mesh, as forms times q.

use num_rational::BigRational;

use crate::form::Form;
use crate::net::{Net, Path, REGULAR};
use crate::polynomial::Polynomial;
use crate::rational::ratio;
use crate::reject::Outcome;
use crate::space::Space;
use crate::word::{self, Triangle, barycentric};

/// 24 times the matrix from twelve points to fifteen Bernstein coefficients (HW, Appendix 1).
const T: [[i64; 12]; 15] = [
    [2, 2, 2, 12, 2, 0, 2, 2, 0, 0, 0, 0],
    [1, 0, 3, 12, 1, 0, 4, 3, 0, 0, 0, 0],
    [0, 1, 1, 12, 3, 0, 3, 4, 0, 0, 0, 0],
    [0, 0, 4, 8, 0, 0, 8, 4, 0, 0, 0, 0],
    [0, 0, 1, 10, 1, 0, 6, 6, 0, 0, 0, 0],
    [0, 0, 0, 8, 4, 0, 4, 8, 0, 0, 0, 0],
    [0, 0, 3, 4, 0, 1, 12, 3, 0, 0, 1, 0],
    [0, 0, 1, 6, 0, 0, 10, 6, 0, 0, 1, 0],
    [0, 0, 0, 6, 1, 0, 6, 10, 0, 0, 1, 0],
    [0, 0, 0, 4, 3, 0, 3, 12, 1, 0, 1, 0],
    [0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2, 0],
    [0, 0, 1, 3, 0, 0, 12, 4, 0, 1, 3, 0],
    [0, 0, 0, 4, 0, 0, 8, 8, 0, 0, 4, 0],
    [0, 0, 0, 3, 1, 0, 4, 12, 0, 0, 3, 1],
    [0, 0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2],
];

/// The vertices of a mesh: control points or points of the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mesh {
    /// Control points.
    Control,
    /// Points of the surface.
    Limit,
}

/// `S - F_k`.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The vertices of F_k.
    pub mesh: Mesh,
    /// k.
    pub level: usize,
}

/// The label of a corner of the face.
fn label(net: &Net, corner: usize) -> usize {
    [1, 2, net.valence + 1][corner]
}

/// q times S at a corner of the face of a net.
pub fn surface_corner(space: &Space, net: &Net, corner: usize) -> Form {
    if corner == 0 && !net.regular {
        let share = space.beta.value.scale(&ratio(8, space.n as i64));
        return net.star(1, &Polynomial::integer(3), &share);
    }
    let [centre, share] = [ratio(1, 2), ratio(1, 12)].map(|x| space.q.scale(&x));
    net.star(label(net, corner), &centre, &share)
}

/// q times the Bernstein coefficients of S over a net of valence 6.
pub fn surface(space: &Space, net: &Net) -> Vec<Form> {
    let coefficient = |row: &[i64; 12]| {
        let factors = row.map(|c| space.q.scale(&ratio(c, 24)));
        net.sum(&factors.iter().zip(REGULAR).collect::<Vec<_>>())
    };
    T.iter().map(coefficient).collect()
}

impl Target {
    /// q times F_k at the corners of the word of a net, the word being of length k.
    fn corners(&self, space: &Space, net: &Net) -> [Form; 3] {
        [0, 1, 2].map(|corner| match self.mesh {
            Mesh::Control => net.sum(&[(&space.q, label(net, corner))]),
            Mesh::Limit => surface_corner(space, net, corner),
        })
    }

    /// q times F_k at the point (v, w) of a word of at least k letters, from the nets along it.
    pub fn mesh_at(
        &self,
        space: &Space,
        nets: &[Net],
        word: &[u8],
        v: &BigRational,
        w: &BigRational,
    ) -> Form {
        let [v, w] = Triangle::of(&word[self.level..]).point(v, w);
        let corners = self.corners(space, &nets[self.level]);
        let terms: Vec<_> = barycentric(&v, &w).into_iter().zip(&corners).collect();
        Form::mix(space.size, &terms)
    }

    /// q times the fifteen Bernstein coefficients over a word of at least k letters whose net has valence 6.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up.
    pub fn coefficients(&self, space: &Space, path: &mut Path, word: &[u8]) -> Outcome<Vec<Form>> {
        let nets = path.along(word)?;
        let net = &nets[word.len()];
        space.charge(15 * 20 * net.point(1).cost())?;
        let corners = self.corners(space, &nets[self.level]);
        let part = Triangle::of(&word[self.level..]);
        let rest = |([_, j, k], surface): ([usize; 3], Form)| {
            let [v, w] = part.point(&ratio(j as i64, 4), &ratio(k as i64, 4));
            let mesh = barycentric(&v, &w).into_iter().map(|x| -x).zip(&corners);
            Form::mix(space.size, &mesh.chain([(ratio(1, 1), &surface)]).collect::<Vec<_>>())
        };
        Ok(word::exponents(4).into_iter().zip(surface(space, net)).map(rest).collect())
    }

    /// q times the target at the point (v, w) of a word: any point of a regular one, the corner 0 of another.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up.
    pub fn at_point(
        &self,
        space: &Space,
        path: &mut Path,
        word: &[u8],
        v: &BigRational,
        w: &BigRational,
    ) -> Outcome<Form> {
        if word::is_regular(word) {
            let coefficients = self.coefficients(space, path, word)?;
            let values = word::bernstein(4, v, w).into_iter();
            return Ok(Form::mix(space.size, &values.zip(&coefficients).collect::<Vec<_>>()));
        }
        let nets = path.along(word)?;
        let surface = surface_corner(space, &nets[word.len()], 0);
        let mesh = self.mesh_at(space, nets, word, v, w);
        Ok(Form::mix(space.size, &[(ratio(1, 1), &surface), (ratio(-1, 1), &mesh)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial::Beta;

    /// beta as a variable: what holds for it holds for both weights.
    fn space(n: usize) -> Space {
        Space::of(n, Beta::between(&ratio(1, 4), &ratio(3, 4)))
    }

    fn assert_same(a: &Form, b: &Form, what: &str) {
        let rest = Form::mix(a.size(), &[(ratio(1, 1), a), (ratio(-1, 1), b)]);
        assert!(rest.num.iter().all(num_traits::Zero::is_zero), "{what}");
    }

    fn value(space: &Space, coefficients: &[Form], v: &BigRational, w: &BigRational) -> Form {
        let values = word::bernstein(4, v, w).into_iter();
        Form::mix(space.size, &values.zip(coefficients).collect::<Vec<_>>())
    }

    #[test]
    fn regular_refinement_splits_the_quartic() {
        // T, the masks of valence 6, the tiles and the corners of the parts, all at once.
        let space = space(5);
        let net = Net::first(&space).child(1);
        let whole = surface(&space, &net);
        for letter in 0..4 {
            let part = surface(&space, &net.child(letter));
            for [_, j, k] in word::exponents(4) {
                let (v, w) = (ratio(j as i64, 4), ratio(k as i64, 4));
                let [x, y] = Triangle::of(&[letter]).point(&v, &w);
                let (a, b) = (value(&space, &part, &v, &w), value(&space, &whole, &x, &y));
                assert_same(&a, &b, &format!("letter {letter}, node {j} {k}"));
            }
        }
    }

    #[test]
    fn the_surface_is_continuous_between_words() {
        for n in [3, 4, 5, 6, 7, 12] {
            let space = space(n);
            let at = |word: &[u8], v: &BigRational, w: &BigRational| {
                let mut path = Path::new(&space);
                let net = path.along(word).unwrap()[word.len()].clone();
                (Triangle::of(word).point(v, w), value(&space, &surface(&space, &net), v, w))
            };
            for t in (0..=4).map(|i| ratio(i, 4)) {
                let (zero, back, half) = (ratio(0, 1), ratio(1, 1) - &t, &t / ratio(2, 1));
                let rest = ratio(1, 1) - &half;
                let pairs = [
                    (at(&[1], &zero, &t), at(&[2], &zero, &back)),
                    (at(&[3], &t, &zero), at(&[2], &back, &zero)),
                    (at(&[2], &half, &rest), at(&[0, 1], &back, &t)),
                    (at(&[2], &rest, &half), at(&[0, 3], &t, &back)),
                    (at(&[0, 1], &zero, &t), at(&[0, 2], &zero, &back)),
                ];
                for ((place, a), (same, b)) in &pairs {
                    assert_eq!(place, same);
                    assert_same(a, b, &format!("n = {n}, t = {t}, {place:?}"));
                }
            }
        }
    }

    #[test]
    fn limit_masks_are_kept_by_refinement() {
        for n in [3, 4, 5, 6, 7, 12] {
            let space = space(n);
            let net = Net::first(&space);
            let zero = net.child(0);
            let [first, third] = [1, 3].map(|letter| surface(&space, &net.child(letter)));
            let corner = |net, c| surface_corner(&space, net, c);
            assert_same(&corner(&net, 0), &corner(&zero, 0), "the extraordinary point");
            assert_same(&corner(&net, 1), &first[10], "corner 1 of the face");
            assert_same(&corner(&net, 2), &third[14], "corner 2 of the face");
            assert_same(&corner(&zero, 1), &first[0], "corner 1 of the word 0");
            assert_same(&corner(&net.child(2), 0), &first[14], "a corner of a regular word");
        }
    }

    /// The label that the mirror exchanges with this one.
    fn mirror(n: usize, label: usize) -> usize {
        match label {
            1 => 1,
            _ if label <= n + 1 => n + 3 - label,
            _ => n + [2, 5, 6, 3, 4][label - n - 2],
        }
    }

    fn mirrored(n: usize, form: &Form) -> Form {
        let place = |label| &form.num[(mirror(n, label) - 1) * form.width..][..form.width];
        Form { num: (1..=n + 6).flat_map(place).cloned().collect(), ..form.clone() }
    }

    #[test]
    fn the_mirror_keeps_second_differences() {
        for n in 3..=14 {
            let space = space(n);
            let differences = Net::first(&space).differences();
            for form in &differences {
                let image = mirrored(n, form);
                assert_eq!(differences.iter().filter(|other| other.num == image.num).count(), 1);
            }
        }
    }

    #[test]
    fn the_mirror_exchanges_words_and_parameters() {
        for n in [3, 4, 5, 6, 9] {
            let space = space(n);
            for (mesh, level) in
                [(Mesh::Control, 0), (Mesh::Limit, 0), (Mesh::Control, 1), (Mesh::Limit, 2)]
            {
                let target = Target { mesh, level };
                for word in [&[1, 0][..], &[2, 1], &[0, 1], &[0, 2, 3], &[2, 2, 0], &[1, 3, 2]] {
                    let coefficients = |word: &[u8]| {
                        target.coefficients(&space, &mut Path::new(&space), word).unwrap()
                    };
                    let (forms, images) = (coefficients(word), coefficients(&word::mirrored(word)));
                    for [_, j, k] in word::exponents(4) {
                        let image = mirrored(n, &images[word::index(k, j)]);
                        assert_same(
                            &forms[word::index(j, k)],
                            &image,
                            &format!("n = {n}, word {word:?}, {j} {k}"),
                        );
                    }
                }
            }
            // The tail's nets, and its displacements through them.
            let net = Net::first(&space).child(0).child(0);
            for label in 1..=n + 6 {
                assert_same(
                    net.point(label),
                    &mirrored(n, net.point(mirror(n, label))),
                    "a tail's net",
                );
            }
        }
    }

    #[test]
    fn affine_nets_are_reproduced_at_valence_6() {
        // Lattice points of the twelve labels, the face at (0, 0), (1, 0), (0, 1).
        let lattice = [
            (0, 0),
            (1, 0),
            (1, -1),
            (0, -1),
            (-1, 0),
            (-1, 1),
            (0, 1),
            (1, 1),
            (2, 0),
            (2, -1),
            (0, 2),
            (-1, 2),
        ];
        let space = Space::of(6, Beta::exact(&ratio(3, 8)));
        let net: Vec<_> = lattice.iter().map(|&(v, w)| (2 * v + 5 * w + 7).into()).collect();
        for form in Net::first(&space).differences() {
            assert!(form.at(&net, &1.into()).is_zero());
        }
        for mesh in [Mesh::Control, Mesh::Limit] {
            let target = Target { mesh, level: 0 };
            for word in [&[1][..], &[2], &[3], &[0, 2], &[2, 3]] {
                for form in target.coefficients(&space, &mut Path::new(&space), word).unwrap() {
                    assert!(form.at(&net, &1.into()).is_zero());
                }
            }
        }
    }

    #[test]
    fn the_rank_is_n_plus_5_or_3() {
        for n in 3..=40 {
            let expected = if n % 6 == 0 { n + 3 } else { n + 5 };
            assert_eq!(space(n).rank, expected);
        }
    }
}
