//! The surface as a tree of parts, grown where it is asked for.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::facet::{hull_below, middles};
use super::part::Net;
use super::setting::{P, Setting};

/// How often a part is split at most when a point is shown to be far from it.
const FAR_SPLITS: u32 = 11;
/// How often a part is split at most when the nearest point is looked for.
const NEAR_SPLITS: usize = 14;

struct Node {
    net: Net,
    face: u32,
    word: String,
    children: Option<(usize, usize)>,
    /// Points whose hull contains it, and the box of their middles.
    hull: Vec<P>,
    low: [f64; 3],
    high: [f64; 3],
    /// The points of the surface at its corners.
    limits: Vec<P>,
}

/// A corner of a part.
#[derive(Clone, Debug)]
pub(super) struct Corner {
    pub(super) face: u32,
    pub(super) word: String,
    pub(super) corner: usize,
    pub(super) point: P,
}

/// A tree of parts.
pub(super) struct Surface<'a> {
    setting: &'a Setting,
    nodes: Vec<Node>,
    roots: usize,
}

/// A nonnegative length that orders a queue.
#[derive(PartialEq)]
pub(super) struct Length(pub(super) f64);

impl Eq for Length {}
impl PartialOrd for Length {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Length {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl<'a> Surface<'a> {
    pub(super) fn new(setting: &'a Setting) -> Self {
        let mut surface = Surface {
            setting,
            nodes: Vec::new(),
            roots: setting.faces.len(),
        };
        for face in &setting.faces {
            surface.add(Net::of_face(&setting.mesh, *face), *face, String::new());
        }
        surface
    }

    fn add(&mut self, net: Net, face: u32, word: String) {
        let hull = net.hull(&self.setting.rules);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in hull.iter().map(middles) {
            for i in 0..3 {
                low[i] = low[i].min(p[i]);
                high[i] = high[i].max(p[i]);
            }
        }
        let limits = (0..net.size())
            .map(|i| net.limit(&self.setting.rules, i))
            .collect();
        self.nodes.push(Node {
            net,
            face,
            word,
            children: None,
            hull,
            low,
            high,
            limits,
        });
    }

    fn children(&mut self, node: usize) -> (usize, usize) {
        if let Some(range) = self.nodes[node].children {
            return range;
        }
        let start = self.nodes.len();
        let (face, word) = (self.nodes[node].face, self.nodes[node].word.clone());
        for (letter, net) in self.nodes[node]
            .net
            .children(&self.setting.rules)
            .into_iter()
            .enumerate()
        {
            self.add(net, face, format!("{word}{letter}"));
        }
        let range = (start, self.nodes.len());
        self.nodes[node].children = Some(range);
        range
    }

    /// A point of the surface near to p, to one part in a thousand or so; nothing is claimed.
    pub(super) fn nearest(&mut self, p: &P) -> Corner {
        let x = middles(p);
        let box_distance = |node: &Node| {
            let out = |i: usize| (node.low[i] - x[i]).max(x[i] - node.high[i]).max(0.0);
            out(0).hypot(out(1)).hypot(out(2))
        };
        let mut queue: BinaryHeap<(Reverse<Length>, usize)> = BinaryHeap::new();
        queue.extend((0..self.roots).map(|i| (Reverse(Length(box_distance(&self.nodes[i]))), i)));
        let (mut best, mut found) = (f64::INFINITY, (0, 0));
        while let Some((Reverse(Length(least)), i)) = queue.pop() {
            if least >= best * (1.0 - 1e-3) {
                break;
            }
            for (corner, limit) in self.nodes[i].limits.iter().enumerate() {
                let q = middles(limit);
                let distance = (q[0] - x[0]).hypot(q[1] - x[1]).hypot(q[2] - x[2]);
                if distance < best {
                    (best, found) = (distance, (i, corner));
                }
            }
            let node = &self.nodes[i];
            let size = (0..3)
                .map(|k| node.high[k] - node.low[k])
                .fold(0.0, f64::max);
            // A corner's distance is off by about size^2 / (2 d) of the nearest point's.
            if node.word.len() < NEAR_SPLITS && size > 0.02 * best {
                let (start, end) = self.children(i);
                queue.extend(
                    (start..end).map(|i| (Reverse(Length(box_distance(&self.nodes[i]))), i)),
                );
            }
        }
        let node = &self.nodes[found.0];
        Corner {
            face: node.face,
            word: node.word.clone(),
            corner: found.1,
            point: node.limits[found.1],
        }
    }

    /// Whether every point of the surface is shown to be at least as far from p.
    pub(super) fn is_far(&mut self, p: &P, length: f64) -> bool {
        (0..self.roots).all(|root| self.part_is_far(root, p, length, FAR_SPLITS))
    }

    fn part_is_far(&mut self, i: usize, p: &P, length: f64, splits: u32) -> bool {
        let node = &self.nodes[i];
        let center = [0, 1, 2].map(|k| 0.5 * (node.low[k] + node.high[k]));
        if hull_below(p, center, &node.hull) >= length {
            return true;
        }
        if splits == 0 {
            return false;
        }
        let (start, end) = self.children(i);
        (start..end).all(|child| self.part_is_far(child, p, length, splits - 1))
    }
}
