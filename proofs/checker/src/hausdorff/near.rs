//! The rules `near-mesh`, `near-surface` and `vertex`: everything on one side is within hi of the other.

use super::cells::{Named, Piece, check_cover, walk};
use super::claim::{Cut, Letters, NearFacet, NearPoint};
use super::distance::foot;
use super::facets::Patch;
use super::polygon_mesh::Vector;
use super::setting::Setting;
use crate::file::Number;
use crate::reject::{Outcome, Rejection, Rule, ensure};

/// Shows that the surface is within hi of F.
///
/// # Errors
///
/// If and only if that is not shown: rule `near-mesh`.
pub fn check_mesh(setting: &Setting, cells: &[(usize, Letters, NearFacet)]) -> Outcome<()> {
    let rule = Rule::NearMesh;
    let groups = grouped(cells, setting.mesh.faces.len(), rule, |face| {
        let corners = setting.mesh.faces[face].len();
        setting.is_inner[face].then_some(setting.rules.letters(corners).len())
    })?;
    for (face, words) in groups {
        let root = piece(setting, face, rule)?;
        walk(&root, &setting.rules, 0, &words, rule, &mut |piece: &Piece, index| {
            let near = match &cells[index].2 {
                NearFacet::Triangle(facet) => {
                    let Patch::Triangle(corners) = patch(setting, *facet, index, rule)? else {
                        let why = format!("cell {index}: the facet is no triangle");
                        return Err(Rejection::new(rule, why));
                    };
                    is_near_convex(setting, piece, corners)
                }
                NearFacet::Segment(facet, from, to) => {
                    let patch = patch(setting, *facet, index, rule)?;
                    let [a, b] = segment(patch, from, to).ok_or_else(|| {
                        Rejection::new(rule, format!("cell {index}: no segment in the facet"))
                    })?;
                    is_near_convex(setting, piece, &[a, b, b])
                }
                NearFacet::Match(_) => is_matched(setting, face, piece, index, rule)?,
            };
            ensure!(near, rule, "cell {index} is not shown to be near");
            Ok(())
        })?;
    }
    Ok(())
}

/// Shows that F is within hi of the surface.
///
/// # Errors
///
/// If and only if that is not shown: rule `near-surface`.
pub fn check_surface(setting: &Setting, cells: &[(usize, Letters, NearPoint)]) -> Outcome<()> {
    let rule = Rule::NearSurface;
    let groups = grouped(cells, setting.facets.len(), rule, |facet| {
        setting.counts(&setting.facets[facet]).then_some(4)
    })?;
    let mut patches: Vec<Option<Patch>> = vec![None; cells.len()];
    for (facet, words) in groups {
        let root = setting.facets[facet].patch;
        walk(&root, &setting.rules, 0, &words, rule, &mut |patch: &Patch, index| {
            patches[index] = Some(*patch);
            Ok(())
        })?;
    }
    // The parts of the surface that the cells name: the face, the word, the cell.
    let mut parts: Vec<(usize, Vec<u8>, usize)> = Vec::new();
    for (index, (facet, path, with)) in cells.iter().enumerate() {
        let facet = &setting.facets[*facet];
        parts.push(match with {
            NearPoint::Corner(face, word, _) => (*face, word.0.clone(), index),
            NearPoint::Match(_) => {
                // A triangle's parts are those of its face only where faces are split as triangles are.
                let triangle = matches!(facet.patch, Patch::Triangle(_));
                let fits = setting.rules.is_loop() == triangle;
                ensure!(fits, rule, "cell {index}: facet and face have no parts in common");
                let word = facet.quarter.iter().chain(&path.0).copied().collect();
                (facet.face, word, index)
            }
        });
    }
    parts.sort_unstable();
    for group in parts.chunk_by(|a, b| a.0 == b.0) {
        let face = group[0].0;
        let words: Vec<Named> = group.iter().map(|(_, word, index)| (&word[..], *index)).collect();
        let root = piece(setting, face, rule)?;
        walk(&root, &setting.rules, 0, &words, rule, &mut |piece: &Piece, index| {
            let near = match (&cells[index].2, &patches[index]) {
                (NearPoint::Corner(_, _, corner), Some(patch)) => {
                    let known = *corner < piece.part.corners();
                    let limit = known.then(|| setting.rules.limit(&piece.part.net, *corner));
                    let limit = limit.flatten().ok_or_else(|| {
                        Rejection::new(rule, format!("cell {index}: no such corner"))
                    })?;
                    patch.corners().iter().all(|corner| setting.hi.holds(corner, &limit))
                }
                _ => is_matched(setting, face, piece, index, rule)?,
            };
            ensure!(near, rule, "cell {index} is not shown to be near");
            Ok(())
        })?;
    }
    Ok(())
}

/// Shows that the vertices of the first mesh are within the bound of the claim of their limits.
///
/// # Errors
///
/// If and only if that is not shown: rule `vertex`.
pub fn check_vertices(setting: &Setting) -> Outcome<()> {
    let (rule, mesh) = (Rule::Vertex, &setting.mesh);
    let Some(bound) = &setting.vertex else { return Err(Rejection::new(rule, "no bound")) };
    let skipped = |vertex: usize| setting.interior_only && !mesh.is_interior(vertex);
    for vertex in (0..mesh.points.len()).filter(|&vertex| !skipped(vertex)) {
        let limit = setting.rules.limit(mesh, vertex);
        let near = limit.is_some_and(|limit| bound.holds(&mesh.points[vertex], &limit));
        ensure!(near, rule, "vertex {} is not shown to be as near to its limit", vertex + 1);
    }
    Ok(())
}

/// The words of cells, by what they are parts of; they must cover each of these for which `first` knows the number of
/// its children, and there may be no others.
fn grouped<'a, W>(
    cells: &'a [(usize, Letters, W)],
    count: usize,
    rule: Rule,
    first: impl Fn(usize) -> Option<usize>,
) -> Outcome<Vec<(usize, Vec<Named<'a>>)>> {
    let mut groups: Vec<Vec<Named>> = vec![Vec::new(); count];
    for (index, (whole, word, _)) in cells.iter().enumerate() {
        let known = *whole < count && first(*whole).is_some();
        ensure!(known, rule, "cell {index}: there is no {whole}, or it does not count");
        groups[*whole].push((&word.0, index));
    }
    let mut covered = Vec::new();
    for (whole, mut words) in groups.into_iter().enumerate() {
        let Some(first) = first(whole) else { continue };
        words.sort_unstable();
        check_cover(&words, 0, first, rule)
            .map_err(|r| Rejection { why: format!("of {whole}: {}", r.why), ..r })?;
        covered.push((whole, words));
    }
    Ok(covered)
}

/// A face of the surface, with F over it.
fn piece(setting: &Setting, face: usize, rule: Rule) -> Outcome<Piece> {
    let missing = || Rejection::new(rule, format!("there is no surface over a face {face}"));
    let part = setting.part(face).ok_or_else(missing)?;
    let corners = &setting.mesh.faces[face];
    let own = setting.own.as_ref().map(|own| corners.iter().map(|&i| own[i]).collect());
    Ok(Piece { part, own })
}

fn patch(setting: &Setting, facet: usize, index: usize, rule: Rule) -> Outcome<&Patch> {
    let missing = || Rejection::new(rule, format!("cell {index}: no such facet"));
    setting.facets.get(facet).map(|facet| &facet.patch).ok_or_else(missing)
}

/// The ends of a segment in a bilinear facet: one parameter is constant.
fn segment(patch: &Patch, from: &[Number; 2], to: &[Number; 2]) -> Option<[Vector; 2]> {
    let straight = from[0].0 == to[0].0 || from[1].0 == to[1].0;
    let bilinear = matches!(patch, Patch::Bilinear(_));
    let point = |at: &[Number; 2]| patch.point([&at[0].0, &at[1].0]);
    if straight && bilinear { Some([point(from)?, point(to)?]) } else { None }
}

/// True if each point whose hull the surface is in is shown to be near to the triangle.
fn is_near_convex(setting: &Setting, piece: &Piece, corners: &[Vector; 3]) -> bool {
    let hull = piece.part.hull(&setting.rules);
    hull.points.iter().all(|point| setting.hi.holds(point, &foot(point, corners)))
}

/// True if S and F over the part are shown to be near to each other.
fn is_matched(
    setting: &Setting,
    face: usize,
    piece: &Piece,
    index: usize,
    rule: Rule,
) -> Outcome<bool> {
    let shared = setting.cut == Cut::Bilinear || setting.mesh.faces[face].len() == 3;
    let own = piece.own.as_deref().filter(|_| shared);
    let none = || Rejection::new(rule, format!("cell {index}: F has no part to match"));
    let own = own.ok_or_else(none)?;
    let hull = piece.part.hull(&setting.rules);
    if !hull.is_regular {
        let near = |point: &Vector| own.iter().all(|corner| setting.hi.holds(point, corner));
        return Ok(hull.points.iter().all(near));
    }
    let patch = match *own {
        [a, b, c] => Patch::Triangle([a, b, c]),
        [a, b, c, d] => Patch::Bilinear([a, b, c, d]),
        _ => return Err(none()),
    };
    let pairs = hull.points.iter().zip(patch.raised());
    Ok(pairs.into_iter().all(|(point, of_mesh)| setting.hi.holds(point, &of_mesh)))
}

#[cfg(test)]
mod tests {
    use super::super::distance::between;
    use super::*;
    use crate::fixed::Fixed;
    use crate::rational::ratio;

    #[test]
    fn segments_in_bilinear_facets_only() {
        let corner = |x: i64, y: i64, z: i64| [x, y, z].map(|x| Fixed::ratio(x, 8));
        let square = [corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 1), corner(0, 1, 0)];
        let at = |v: i64, w: i64| [v, w].map(|x| Number(ratio(x, 2)));
        let patch = Patch::Bilinear(square);
        let [a, b] = segment(&patch, &at(1, 0), &at(1, 2)).unwrap();
        assert_eq!(a, between(&square[0], &square[1], &ratio(1, 2)));
        assert_eq!(b, between(&square[3], &square[2], &ratio(1, 2)));
        assert!(segment(&patch, &at(0, 0), &at(2, 2)).is_none());
        assert!(segment(&patch, &at(0, 0), &at(3, 0)).is_none());
        let triangle = Patch::Triangle([square[0], square[1], square[2]]);
        assert!(segment(&triangle, &at(0, 0), &at(1, 0)).is_none());
    }
}
