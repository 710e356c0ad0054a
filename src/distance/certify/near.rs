//! Covers of the surface, or of the mesh, by parts that are near to the other: best first.

use std::collections::BinaryHeap;

use super::facet::{
    bilinear, bilinear_foot, estimate, foot_point, is_far, middles, square, to_point, to_triangle,
    triangles,
};
use super::part::{Net, quarters};
use super::setting::{P, Setting, coarse, flat_parts, matched};
use super::surface::{Corner, Length, Surface};
use super::{CertifyError, Far, With};

/// The most cells of a cover.
const CELLS: usize = 200_000;
/// How many facets are tried for a part.
const TRIED: usize = 3;

/// A part with the reason why it is near, and how near.
pub(super) struct Cell {
    /// The face, or the facet.
    pub(super) face: usize,
    pub(super) word: String,
    pub(super) with: With,
    net: Option<Net>,
    flat: Option<Vec<P>>,
    /// Corners of a part of a facet.
    corners: Vec<P>,
}

/// A cover, and what it shows.
pub(super) struct Cover {
    pub(super) cells: Vec<Cell>,
    pub(super) hi: f64,
    pub(super) lo: f64,
    pub(super) far: Option<Far>,
}

/// Splits the worst part until the bounds are close; `split` yields parts with bounds, `probe` a lower
/// bound found at a part that is better than the one given.
fn cover(
    setting: &Setting,
    gap: f64,
    first: Vec<(f64, Cell)>,
    mut split: impl FnMut(Cell) -> Vec<(f64, Cell)>,
    mut probe: impl FnMut(&Cell, f64) -> Option<(f64, Far)>,
) -> Result<Cover, CertifyError> {
    let mut cells: Vec<Option<Cell>> = Vec::new();
    let mut queue = BinaryHeap::new();
    let push =
        |queue: &mut BinaryHeap<_>, cells: &mut Vec<Option<Cell>>, (bound, cell): (f64, Cell)| {
            queue.push((Length(bound), usize::MAX - cells.len()));
            cells.push(Some(cell));
        };
    for part in first {
        push(&mut queue, &mut cells, part);
    }
    // A distance at the level of rounding errors is as good as 0.
    let tiny = 1e-12 * setting.size();
    let (mut lo, mut far) = (0.0, None);
    let hi = loop {
        let Some((Length(bound), age)) = queue.pop() else {
            break 0.0;
        };
        if bound <= tiny.max(lo * (1.0 + gap)) {
            break bound;
        }
        if queue.len() > CELLS {
            return Err(CertifyError::TooManyParts { lo, hi: bound });
        }
        let Some(cell) = cells[usize::MAX - age].take() else {
            continue;
        };
        if let Some((better, place)) = probe(&cell, lo) {
            (lo, far) = (better, Some(place));
        }
        if bound <= lo * (1.0 + gap) {
            cells[usize::MAX - age] = Some(cell);
            break bound;
        }
        for part in split(cell) {
            push(&mut queue, &mut cells, part);
        }
    };
    Ok(Cover {
        cells: cells.into_iter().flatten().collect(),
        hi,
        lo,
        far,
    })
}

/// Covers the surface by parts that are near to the mesh.
pub(super) fn surface_to_mesh(setting: &Setting, gap: f64) -> Result<Cover, CertifyError> {
    let cell = |face: usize, word: String, net: Net, flat: Option<Vec<P>>| {
        let (bound, with) = nearest_facet(setting, &net, flat.as_deref());
        let cell = Cell {
            face,
            word,
            with,
            net: Some(net),
            flat,
            corners: Vec::new(),
        };
        (bound, cell)
    };
    let first = setting.faces.iter().map(|face| {
        let net = Net::of_face(&setting.mesh, *face);
        cell(*face as usize, String::new(), net, setting.flat(*face))
    });
    let split = |old: Cell| -> Vec<(f64, Cell)> {
        let nets = old.net.iter().flat_map(|net| net.children(&setting.rules));
        let flats = old
            .flat
            .as_ref()
            .map(|flat| flat_parts(flat, setting.is_loop()));
        let make = |(i, net): (usize, Net)| {
            let flat = flats.as_ref().map(|flats| flats[i].clone());
            cell(old.face, format!("{}{i}", old.word), net, flat)
        };
        nets.enumerate().map(make).collect()
    };
    let probe = |cell: &Cell, lo: f64| {
        let net = cell.net.as_ref()?;
        let at = |corner: usize| {
            let point = net.limit(&setting.rules, corner);
            let distances = setting.facets.iter().map(|f| estimate(&point, &f.corners));
            let wanted = distances.fold(f64::INFINITY, f64::min) * (1.0 - 0.2 * gap);
            if wanted <= lo
                || !setting
                    .facets
                    .iter()
                    .all(|f| is_far(&point, &f.corners, wanted))
            {
                return None;
            }
            let place = Far::Surface {
                face: cell.face,
                word: cell.word.clone(),
                corner,
            };
            Some((wanted, place))
        };
        (0..net.size())
            .filter_map(at)
            .max_by(|x, y| x.0.total_cmp(&y.0))
    };
    cover(setting, gap, first.collect(), split, probe)
}

/// The best way to show that a part is near to the mesh, and how near.
fn nearest_facet(setting: &Setting, net: &Net, flat: Option<&[P]>) -> (f64, With) {
    let hull = net.hull(&setting.rules);
    let count = 1.0 / hull.len() as f64;
    let mut center = [0.0; 3];
    for p in hull.iter().map(middles) {
        for i in 0..3 {
            center[i] += count * p[i];
        }
    }
    let center = crate::mesh::Point(center.map(crate::scalar::Interval::point));
    let mut best = flat.map_or((f64::INFINITY, With::Match), |flat| {
        (matched(net, &setting.rules, flat), With::Match)
    });
    // The facets nearest to the centre, by their triangles.
    let mut nearest: Vec<(f64, usize)> = Vec::with_capacity(TRIED + 1);
    for (i, facet) in setting.facets.iter().enumerate() {
        let distances =
            triangles(&facet.corners).map(|t| square(&center, &foot_point(&center, &t)).mid());
        let distance = distances.fold(f64::INFINITY, f64::min);
        nearest.push((distance, i));
        nearest.sort_by(|x, y| x.0.total_cmp(&y.0));
        nearest.truncate(TRIED);
    }
    for (_, i) in nearest {
        let facet = &setting.facets[i];
        let mut offer = |bound: f64, with: With| {
            if bound < best.0 {
                best = (bound, with);
            }
        };
        if let Some(triangle) = facet.triangle() {
            offer(to_triangle(&hull, triangle), With::Facet(i));
        } else {
            let [(v, at_v), (w, at_w)] = bilinear_foot(&center, &facet.corners).map(coarse);
            for (ends, place) in [
                ([[0.0, at_w], [1.0, at_w]], [[0, w], [4096, w]]),
                ([[at_v, 0.0], [at_v, 1.0]], [[v, 0], [v, 4096]]),
            ] {
                let [a, b] = ends.map(|end| bilinear(&facet.corners, end));
                offer(to_triangle(&hull, &[a, b, b]), With::Segment(i, place));
            }
        }
    }
    best
}

/// Covers the facets by parts that are near to the surface.
pub(super) fn mesh_to_surface(setting: &Setting, gap: f64) -> Result<Cover, CertifyError> {
    let surface = std::cell::RefCell::new(Surface::new(setting));
    let cell =
        |face: usize, word: String, net: Option<Net>, flat: Option<Vec<P>>, corners: Vec<P>| {
            let count = 1.0 / corners.len() as f64;
            let sum = corners
                .iter()
                .fold(num_traits::Zero::zero(), |sum: P, p| sum + p);
            let center = sum * &crate::scalar::Interval::point(count);
            let Corner {
                face: f,
                word: w,
                corner,
                point,
            } = surface.borrow_mut().nearest(&center);
            let mut best = (to_point(&corners, &point), With::Point(f, w, corner));
            if let (Some(net), Some(flat)) = (&net, &flat) {
                let bound = matched(net, &setting.rules, flat);
                if bound < best.0 {
                    best = (bound, With::Match);
                }
            }
            let cell = Cell {
                face,
                word,
                with: best.1,
                net,
                flat,
                corners,
            };
            (best.0, cell)
        };
    let counted = setting
        .facets
        .iter()
        .enumerate()
        .filter(|(_, facet)| facet.counts);
    let first = counted.map(|(i, facet)| {
        let own = facet.own.and_then(|(face, letter)| {
            let net = Net::of_face(&setting.mesh, face);
            let flat = setting.flat(face)?;
            let Some(letter) = letter.map(usize::from) else {
                return Some((net, flat));
            };
            let net = net.children(&setting.rules).swap_remove(letter);
            Some((
                net,
                flat_parts(&flat, setting.is_loop()).swap_remove(letter),
            ))
        });
        let (net, flat) = own.unzip();
        cell(i, String::new(), net, flat, facet.corners.clone())
    });
    let first: Vec<(f64, Cell)> = first.collect();
    let split = |old: Cell| -> Vec<(f64, Cell)> {
        let mut nets = old.net.iter().flat_map(|net| net.children(&setting.rules));
        let mut flats = old
            .flat
            .iter()
            .flat_map(|flat| flat_parts(flat, setting.is_loop()));
        let make = |(i, corners): (usize, Vec<P>)| {
            cell(
                old.face,
                format!("{}{i}", old.word),
                nets.next(),
                flats.next(),
                corners,
            )
        };
        quarters(&old.corners)
            .into_iter()
            .enumerate()
            .map(make)
            .collect()
    };
    let probe = |cell: &Cell, lo: f64| {
        let mut best: Option<(f64, Far)> = None;
        for (corner, p) in cell.corners.iter().enumerate() {
            let mut surface = surface.borrow_mut();
            let near = surface.nearest(p).point;
            let wanted = square(p, &near).mid().sqrt() * (1.0 - 0.3 * gap);
            if wanted > best.as_ref().map_or(lo, |b| b.0) && surface.is_far(p, wanted) {
                let place = Far::Mesh {
                    facet: cell.face,
                    at: place(&cell.word, corner, cell.corners.len()),
                };
                best = Some((wanted, place));
            }
        }
        best
    };
    cover(setting, gap, first, split, probe)
}

/// The parameters, in the facet, of a corner of its part: numerators and a common denominator.
fn place(word: &str, corner: usize, size: usize) -> ([i64; 2], i64) {
    // Corners as they are in the facet's parameters times 2^letters.
    let mut corners: Vec<[i64; 2]> = match size {
        3 => vec![[0, 0], [1, 0], [0, 1]],
        _ => vec![[0, 0], [1, 0], [1, 1], [0, 1]],
    };
    let mut scale = 1;
    for letter in word.bytes().map(|b| usize::from(b - b'0')) {
        scale *= 2;
        let twice: Vec<[i64; 2]> = corners.iter().map(|c| c.map(|x| 2 * x)).collect();
        let mid =
            |i: usize, j: usize| [0, 1].map(|k| (twice[i % size][k] + twice[j % size][k]) / 2);
        corners = match (size, letter) {
            (3, 3) => vec![mid(0, 1), mid(1, 2), mid(2, 0)],
            (3, i) => vec![twice[i], mid(i, i + 1), mid(i + 2, i)],
            (_, i) => vec![twice[i], mid(i, i + 1), mid(0, 2), mid(i + 3, i)],
        };
    }
    (corners[corner], scale)
}
