//! A bounding-volume hierarchy over boxes: which items may hold the nearest point.

use super::metric::Aabb;
use crate::patch::Lane;

/// A node; its left child follows it, its right child is `skip` further on.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    /// 0 for a leaf.
    skip: u32,
    /// The leaf's items: a range of [`Tree::items`].
    first: u32,
    count: u32,
}

/// A binary tree of boxes, split at medians along the longest side of the box of centres.
#[derive(Clone, Debug)]
pub struct Tree {
    nodes: Vec<Node>,
    items: Vec<u32>,
}

/// Items in a leaf, at most.
const LEAF: usize = 4;
/// Items above which halves are built by two threads.
const PARALLEL: usize = 1 << 12;

impl Tree {
    /// The tree of the items' boxes. Items with an empty box are left out.
    pub fn new(boxes: &[Aabb]) -> Self {
        let centre = |b: &Aabb| std::array::from_fn(|i| 0.5 * (b.low.0[i] + b.high.0[i]));
        let mut entries: Vec<(u32, [f64; 3])> = (0..)
            .zip(boxes)
            .filter(|(_, b)| b.low.0[0] <= b.high.0[0])
            .map(|(item, b)| (item, centre(b)))
            .collect();
        let nodes = build(&mut entries, 0, boxes);
        Tree {
            nodes,
            items: entries.iter().map(|(item, _)| *item).collect(),
        }
    }

    /// Visits items, nearer boxes first. `reach()` is the distance beyond which nothing matters: it
    /// may shrink while items are visited. `near(box)` is a lower bound of what an item in the box
    /// can offer; boxes with `near >= reach` are passed over.
    pub fn visit<C>(
        &self,
        context: &mut C,
        near: impl Fn(&C, &Aabb) -> f64,
        reach: impl Fn(&C) -> f64,
        mut item: impl FnMut(&mut C, u32),
    ) {
        let Some(root) = self.nodes.first() else {
            return;
        };
        let mut stack: Vec<(u32, f64)> = Vec::with_capacity(64);
        stack.push((0, near(context, &root.bounds)));
        while let Some((mut at, mut distance)) = stack.pop() {
            while distance < reach(context) {
                let node = &self.nodes[at as usize];
                if node.skip == 0 {
                    for &i in &self.items[node.first as usize..(node.first + node.count) as usize] {
                        item(context, i);
                    }
                    break;
                }
                let (left, right) = (at + 1, at + node.skip);
                let l = near(context, &self.nodes[left as usize].bounds);
                let r = near(context, &self.nodes[right as usize].bounds);
                // The nearer child now, the other later.
                if l <= r {
                    stack.push((right, r));
                    (at, distance) = (left, l);
                } else {
                    stack.push((left, l));
                    (at, distance) = (right, r);
                }
            }
        }
    }
}

fn build(entries: &mut [(u32, [f64; 3])], first: u32, boxes: &[Aabb]) -> Vec<Node> {
    if entries.is_empty() {
        return Vec::new();
    }
    if entries.len() <= LEAF {
        let bounds = entries
            .iter()
            .fold(Aabb::EMPTY, |all, (i, _)| all.join(&boxes[*i as usize]));
        return vec![Node {
            bounds,
            skip: 0,
            first,
            count: entries.len() as u32,
        }];
    }
    let mut centres = Aabb::EMPTY;
    for (_, [x, y, z]) in entries.iter() {
        centres.include(&Lane([*x, *y, *z, 0.0]));
    }
    let side = |i: usize| centres.high.0[i] - centres.low.0[i];
    let axis = (1..3).fold(0, |best, i| if side(i) > side(best) { i } else { best });
    let middle = entries.len() / 2;
    // Equal centres in the order of the items: the tree depends on the boxes only.
    entries.select_nth_unstable_by(middle, |a, b| {
        a.1[axis].total_cmp(&b.1[axis]).then(a.0.cmp(&b.0))
    });
    let parallel = entries.len() > PARALLEL;
    let (low, high) = entries.split_at_mut(middle);
    let second = first + middle as u32;
    let (left, right) = if parallel {
        rayon::join(|| build(low, first, boxes), || build(high, second, boxes))
    } else {
        (build(low, first, boxes), build(high, second, boxes))
    };
    let mut nodes = Vec::with_capacity(1 + left.len() + right.len());
    nodes.push(Node {
        bounds: left[0].bounds.join(&right[0].bounds),
        skip: 1 + left.len() as u32,
        first: 0,
        count: 0,
    });
    nodes.extend(left);
    nodes.extend(right);
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nearest of many points, by the tree and one by one.
    #[test]
    fn the_nearest_item_is_found() {
        let mut state = 20260801_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for count in [0, 1, 2, 5, 300, 10_000] {
            let boxes: Vec<Aabb> = (0..count)
                .map(|_| {
                    let p = Lane([random(), random(), random(), 0.0]);
                    Aabb { low: p, high: p }
                })
                .collect();
            let tree = Tree::new(&boxes);
            for _ in 0..50 {
                let p = Lane([random(), 2.0 * random(), random(), 0.0]);
                let mut best = (f64::INFINITY, None);
                tree.visit(
                    &mut best,
                    |_, b| b.distance_squared(&p),
                    |best| best.0,
                    |best, i| {
                        let d = boxes[i as usize].distance_squared(&p);
                        if d < best.0 {
                            *best = (d, Some(i));
                        }
                    },
                );
                let direct = boxes
                    .iter()
                    .map(|b| b.distance_squared(&p))
                    .fold(f64::INFINITY, f64::min);
                assert_eq!(best.0, direct);
                assert_eq!(best.1.is_some(), count > 0);
            }
        }
    }
}
