//! Best-first branch and bound over cells with upper bounds. No geometry here.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A cell in the queue: its upper bound, its age (older first among equals) and its place.
#[derive(Clone, Debug)]
struct Entry<Q> {
    upper: Q,
    age: u32,
    slot: u32,
}

impl<Q: PartialOrd> PartialEq for Entry<Q> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<Q: PartialOrd> Eq for Entry<Q> {}

impl<Q: PartialOrd> PartialOrd for Entry<Q> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<Q: PartialOrd> Ord for Entry<Q> {
    fn cmp(&self, other: &Self) -> Ordering {
        // Bounds are never NaN; were one, the order would still be some order, and no claim rests
        // on the order: the result is a maximum over all cells.
        let by_bound = self
            .upper
            .partial_cmp(&other.upper)
            .unwrap_or(Ordering::Equal);
        by_bound.then(other.age.cmp(&self.age))
    }
}

/// The open cells, and the largest bound of all cells that were closed.
///
/// Invariant: the supremum over the whole domain is at most the larger of `closed` and the largest
/// open bound, whatever decides which cells are closed.
#[derive(Clone, Debug)]
pub struct Queue<Q, C> {
    heap: BinaryHeap<Entry<Q>>,
    cells: Vec<Option<C>>,
    free: Vec<u32>,
    age: u32,
    closed: Q,
}

impl<Q: Clone + PartialOrd, C> Queue<Q, C> {
    /// An empty queue; `zero` is a bound of nothing.
    pub fn new(zero: Q) -> Self {
        Queue {
            heap: BinaryHeap::new(),
            cells: Vec::new(),
            free: Vec::new(),
            age: 0,
            closed: zero,
        }
    }

    /// Empties the queue and keeps its memory.
    pub fn clear(&mut self, zero: Q) {
        self.heap.clear();
        self.cells.clear();
        self.free.clear();
        self.age = 0;
        self.closed = zero;
    }

    /// Adds an open cell.
    pub fn push(&mut self, upper: Q, cell: C) {
        let slot = match self.free.pop() {
            Some(slot) => {
                self.cells[slot as usize] = Some(cell);
                slot
            }
            None => {
                self.cells.push(Some(cell));
                self.cells.len() as u32 - 1
            }
        };
        self.heap.push(Entry {
            upper,
            age: self.age,
            slot,
        });
        self.age += 1;
    }

    /// Closes a cell that was not pushed: its bound is kept, the cell is not.
    pub fn close(&mut self, upper: Q) {
        if upper > self.closed {
            self.closed = upper;
        }
    }

    /// Takes the open cell with the largest bound.
    pub fn pop(&mut self) -> Option<(Q, C)> {
        let entry = self.heap.pop()?;
        self.free.push(entry.slot);
        self.cells[entry.slot as usize]
            .take()
            .map(|cell| (entry.upper, cell))
    }

    /// The largest open bound.
    pub fn top(&self) -> Option<&Q> {
        self.heap.peek().map(|entry| &entry.upper)
    }

    /// An upper bound for the supremum over all cells, open and closed.
    pub fn upper(&self) -> Q {
        match self.top() {
            Some(top) if *top > self.closed => top.clone(),
            _ => self.closed.clone(),
        }
    }

    /// Number of cells ever pushed.
    pub fn pushed(&self) -> u32 {
        self.age
    }
}
