//! The rings near the centre, against the facet of level 0 there.

use super::case::DEPTH;
use super::{Check, Meshes, Place, is_point, number, power};
use crate::complex::Complex;
use crate::fixed::Fixed;
use crate::piece::{Spline, value};
use crate::rational::decimal;
use crate::reject::Outcome;
use crate::sector::{Quartic, Triangle, ring_zero};

impl Check<'_> {
    /// lo <= N <= hi for all cases.
    pub(super) fn check_near(&mut self) -> Outcome<()> {
        let tracks = self.tracks.iter().map(|track| Some(self.mesh(&track.first[0])));
        let meshes = Meshes { chi: self.mesh(&self.chi.first[0]), tracks: tracks.collect() };
        let deepest = self.cases.iter().map(|case| case.step.near.depth).max().unwrap_or(0);
        for i in 0..self.cases.len() {
            if self.failed[i].is_none() && !self.is_reached_near(i, &meshes) {
                let lo = decimal(&self.cases[i].step.near.lo.0, 10);
                self.fail(i, format!("near: lo = {lo} is not shown to be reached"));
            }
        }
        for r in 1..=deepest {
            for triangle in ring_zero(1) {
                let [p, q, _] = triangle;
                let tracks = self.active(|case, _| {
                    r <= case.step.near.depth && (p >= q || case.claim.frequency.is_none())
                });
                let case = |track: &usize| &self.cases[self.tracks[*track].case];
                let bounds = tracks.iter().map(|t| number(&case(t).step.near.hi)).collect();
                let mut scene = self.scene(Place::Near, &tracks, bounds, &meshes);
                let spline = |(i, t): (usize, &usize)| (i, self.over_ring(*t, r, triangle));
                let splines: Vec<Spline> = tracks.iter().enumerate().map(spline).collect();
                scene.show(&self.chi_over_ring(r, triangle), &splines, 0);
                let (failed, work) = (std::mem::take(&mut scene.failed), scene.work);
                drop(scene);
                for i in failed {
                    let case = self.tracks[tracks[i]].case;
                    let hi = decimal(&self.cases[case].step.near.hi.0, 10);
                    self.fail(case, format!("near: ring {r}, triangle {triangle:?} is not shown to stay below hi = {hi}"));
                }
                self.spend(work)?;
            }
        }
        for t in self.active(|_, _| true) {
            if !self.is_small_beyond(t, &meshes) {
                let case = self.tracks[t].case;
                self.fail(
                    case,
                    "near: the rings beyond the depth are not shown to stay below hi".into(),
                );
            }
        }
        Ok(())
    }

    fn chi_over_ring(&self, r: usize, triangle: Triangle) -> Quartic {
        let share = power(self.lambda, r);
        self.chi.first[1].patch(triangle).map(|z| z * share)
    }

    fn over_ring(&self, track: usize, r: usize, triangle: Triangle) -> Quartic {
        let track = &self.tracks[track];
        let f = track.chain.as_ref().map(|f| f.patch(triangle));
        self.cases[track.case].over_ring(r, &track.first[1].patch(triangle), f.as_ref())
    }

    fn is_reached_near(&self, i: usize, meshes: &Meshes) -> bool {
        let (case, near) = (&self.cases[i], &self.cases[i].step.near);
        let Some(at) = &near.at else {
            let centre = self.track(i, 0).and_then(|track| meshes.tracks[track].as_ref());
            let centre = centre.map_or(Complex::WHOLE, |mesh| mesh.at([0, 0]));
            return number(&near.lo).square().at_most(centre.norm());
        };
        let point = [&at.point.0.0, &at.point.1.0];
        let track = case.sector(at.sector).and_then(|sector| self.track(i, sector));
        let valid = is_point(1, at.triangle, point) && (1..=DEPTH).contains(&at.ring);
        let Some(track) = track.filter(|_| valid) else { return false };
        let scene = self.scene(Place::Near, &[track], vec![number(&near.lo)], meshes);
        let [z, e] =
            [self.chi_over_ring(at.ring, at.triangle), self.over_ring(track, at.ring, at.triangle)]
                .map(|net| value(&net, point.map(Fixed::of)));
        scene.reaches(0, z, e)
    }

    /// What remains for the rings beyond the depth.
    fn is_small_beyond(&self, t: usize, meshes: &Meshes) -> bool {
        let case = &self.cases[self.tracks[t].case];
        let (near, r) = (&case.step.near, case.step.near.depth + 1);
        let scene = self.scene(Place::Near, &[t], vec![number(&near.hi)], meshes);
        let (face, heights) = (&scene.facets[0], &scene.heights[0][0]);
        let largest = |list: &mut dyn Iterator<Item = Complex>| {
            list.fold(Fixed::ZERO, |most, z| most.max(z.norm().root()))
        };
        let (mut surface, mut mesh) = (Fixed::ZERO, heights[0].norm().root());
        for triangle in ring_zero(1) {
            let chi = self.chi_over_ring(r, triangle);
            if !face.holds_from_first(&chi) {
                return false;
            }
            mesh = mesh.max(largest(&mut chi.iter().map(|z| face.height(heights, *z))));
            let track = &self.tracks[t];
            let e = largest(&mut track.first[1].patch(triangle).into_iter());
            let mut bound = power(case.mode.lambda, r) * e;
            if let (Some((kappa, _)), Some(f)) = (&case.mode.chain, &track.chain) {
                let share = power(case.mode.lambda, r - 1) * Fixed::ratio(r as i64, 1);
                let f = largest(&mut f.patch(triangle).into_iter());
                bound = bound + share * kappa.square().root() * f;
            }
            surface = surface.max(bound);
        }
        let less = case.mode.lambda.is_positive() && case.mode.lambda.below(Fixed::ONE);
        less && (surface + mesh).at_most(number(&near.hi))
    }
}
