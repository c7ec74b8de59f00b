//! A queue of cells by cost, for costs that are whole numbers.
//!
//! *Source*: Dial 1969, Commun. ACM 12, 632.
//!
//! *Parameters*: number of buckets, one per cost; costs that wait at the same time must differ by less.
//!
//! *Deviations*: the buckets are chains through one pool of entries, and an entry that was taken out is the next to be
//! used again: the entries in use stay together in memory. Among equal costs the last one in is the first one out.

/// No entry.
const NONE: u32 = u32::MAX;

#[derive(Clone, Copy, Debug)]
struct Entry {
    cell: u32,
    g: u32,
    next: u32,
}

/// The queue.
#[derive(Clone, Debug, Default)]
pub(super) struct Buckets {
    heads: Vec<u32>,
    pool: Vec<Entry>,
    spare: u32,
    least: usize,
    waiting: usize,
}

impl Buckets {
    /// Empties the queue and makes it ready for costs of at least `least`, in at least `count` buckets.
    pub(super) fn clear(&mut self, count: usize, least: u32) {
        self.heads.clear();
        self.heads.resize(count.next_power_of_two(), NONE);
        self.pool.clear();
        self.spare = NONE;
        self.least = least as usize;
        self.waiting = 0;
    }

    /// Puts in a cell of total cost `f`, with the cost `g` of the way to it.
    #[inline]
    pub(super) fn push(&mut self, f: u32, cell: usize, g: u32) {
        let mask = self.heads.len() - 1;
        let head = &mut self.heads[f as usize & mask];
        let entry = Entry { cell: cell as u32, g, next: *head };
        if let Some(spare) = self.pool.get_mut(self.spare as usize) {
            *head = self.spare;
            self.spare = std::mem::replace(spare, entry).next;
        } else {
            *head = self.pool.len() as u32;
            self.pool.push(entry);
        }
        self.waiting += 1;
    }

    /// Takes out a cell of the least total cost, with the cost of the way to it when it was put in.
    #[inline]
    pub(super) fn pop(&mut self) -> Option<(usize, u32)> {
        if self.waiting == 0 {
            return None;
        }
        let mask = self.heads.len() - 1;
        loop {
            let head = &mut self.heads[self.least & mask];
            if let Some(entry) = self.pool.get_mut(*head as usize) {
                let (cell, g) = (entry.cell as usize, entry.g);
                let next = std::mem::replace(&mut entry.next, self.spare);
                self.spare = std::mem::replace(head, next);
                self.waiting -= 1;
                return Some((cell, g));
            }
            self.least += 1;
        }
    }
}
