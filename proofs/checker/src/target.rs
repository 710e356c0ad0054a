//! Targets: the difference of the surface and a mesh, as forms times q.

use crate::form::Form;
use crate::net::{Net, Path};
use crate::patch::{Patch, Point};
use crate::rational::ratio;
use crate::reject::{Outcome, Rejection, Rule};
use crate::scheme::Mesh;
use crate::space::Space;
use crate::word::is_regular;

/// `S - F_k`.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The vertices of F_k.
    pub mesh: Mesh,
    /// k.
    pub level: usize,
}

/// q times F_k over a word of at least k letters and the root's: affine or bilinear, by its values at the corners.
pub struct Flat {
    patch: Patch,
    corners: Vec<Form>,
}

impl Flat {
    /// F_k at a point of the word.
    pub fn at(&self, point: &Point) -> Form {
        let weights = self.patch.blend(point).into_iter();
        Form::mix(self.corners[0].size(), &weights.zip(&self.corners).collect::<Vec<_>>())
    }

    /// `form - F_k` at a point of the word.
    pub fn below(&self, form: &Form, point: &Point) -> Form {
        let mesh = self.patch.blend(point).into_iter().map(|x| -x).zip(&self.corners);
        let terms: Vec<_> = mesh.chain([(ratio(1, 1), form)]).collect();
        Form::mix(form.size(), &terms)
    }
}

impl Target {
    /// `S - F_0`, F_0 the control mesh: what lemmas are about.
    pub const FIRST: Self = Self { mesh: Mesh::Control, level: 0 };

    /// q times F_k over a word of at least k letters and the root's, from the nets along it.
    ///
    /// # Errors
    ///
    /// If and only if there is no such mesh: rule `format`.
    pub fn mesh(self, space: &Space, nets: &[Net], word: &[u8]) -> Outcome<Flat> {
        let (k, whole) = (self.level, self.level + space.scheme.root());
        let missing = || Rejection::new(Rule::Format, "the scheme has no such mesh");
        let (net, rest) = (&nets[k], &word[k..whole]);
        let masks = space.scheme.mesh(self.mesh, net.valence, rest).ok_or_else(missing)?;
        let (corners, patch) = (masks.iter().map(|mask| net.apply(space, mask)), space.patch());
        let (flat, part) = (Flat { patch, corners: corners.collect() }, patch.part(&word[whole..]));
        let corners = patch.corners().iter().map(|corner| flat.at(&part.point(corner))).collect();
        Ok(Flat { patch, corners })
    }

    /// q times the Bernstein coefficients over a regular word of at least k letters and the root's.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up, or there is no such mesh: rule `format`.
    pub fn coefficients(self, space: &Space, path: &mut Path, word: &[u8]) -> Outcome<Vec<Form>> {
        let nets = path.along(word)?;
        let net = &nets[word.len()];
        let nodes = space.patch().nodes();
        space.charge(20 * nodes.len() as u64 * net.cost())?;
        let mesh = self.mesh(space, nets, word)?;
        let rest = |(mask, node)| mesh.below(&net.apply(space, mask), node);
        Ok(space.surface.iter().zip(&nodes).map(rest).collect())
    }

    /// q times the target at a point of a word: any point of a regular one, the corner 0 of another.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up, or there is no such mesh: rule `format`.
    pub fn at_point(
        self,
        space: &Space,
        path: &mut Path,
        word: &[u8],
        point: &Point,
    ) -> Outcome<Form> {
        if is_regular(word) {
            let coefficients = self.coefficients(space, path, word)?;
            let values = space.patch().value(point).into_iter();
            return Ok(Form::mix(space.size, &values.zip(&coefficients).collect::<Vec<_>>()));
        }
        let nets = path.along(word)?;
        let net = &nets[word.len()];
        let surface = net.apply(space, &space.scheme.limit(net.valence));
        Ok(self.mesh(space, nets, word)?.below(&surface, point))
    }
}

#[cfg(test)]
mod tests;
