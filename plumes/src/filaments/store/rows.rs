//! A list with so many entries for each filament, from which those of the oldest are mostly removed.
//!
//! What lies before a removed filament moves up, or what lies behind it down, whichever is less, so
//! that the list does not move as a whole whenever its oldest filament leaves.

use std::fmt;
use std::ops::{Deref, DerefMut};

/// A list without the entries before a place, which are no longer used.
#[derive(Clone)]
pub(crate) struct Rows<T> {
    list: Vec<T>,
    first: usize,
}

impl<T> Default for Rows<T> {
    fn default() -> Self {
        Vec::new().into()
    }
}

impl<T> From<Vec<T>> for Rows<T> {
    fn from(list: Vec<T>) -> Self {
        Self { list, first: 0 }
    }
}

impl<T> Extend<T> for Rows<T> {
    fn extend<I: IntoIterator<Item = T>>(&mut self, more: I) {
        self.list.extend(more);
    }
}

impl<T> Deref for Rows<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.list[self.first..]
    }
}

impl<T> DerefMut for Rows<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.list[self.first..]
    }
}

impl<T: PartialEq> PartialEq for Rows<T> {
    fn eq(&self, other: &Self) -> bool {
        self[..] == other[..]
    }
}

impl<T: fmt::Debug> fmt::Debug for Rows<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self[..].fmt(f)
    }
}

impl<T: Copy> Rows<T> {
    /// Removes the rows of the filaments at sorted places, of `each` entries.
    pub(crate) fn remove(&mut self, gone: &[usize], each: usize) {
        let (Some(oldest), Some(newest)) = (gone.first(), gone.last()) else {
            return;
        };
        let len = self.len();
        let many = gone.len() * each;
        if (newest + 1) * each <= len - oldest * each {
            let mut to = (newest + 1) * each;
            for (n, row) in gone.iter().enumerate().rev() {
                let from = n.checked_sub(1).map_or(0, |before| gone[before] + 1) * each;
                let stays = from..row * each;
                to -= stays.len();
                self.copy_within(stays, to);
            }
            self.first += many;
            // So the memory is at most twice what is used, and each entry moves once for one that has left.
            if self.first > self.len() {
                self.list.drain(..self.first);
                self.first = 0;
            }
        } else {
            let mut to = oldest * each;
            for (n, row) in gone.iter().enumerate() {
                let end = gone.get(n + 1).map_or(len, |next| next * each);
                let stays = (row + 1) * each..end;
                let next = to + stays.len();
                self.copy_within(stays, to);
                to = next;
            }
            self.list.truncate(self.first + to);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_removed_by_their_places() {
        for gone in [&[][..], &[0], &[1], &[6], &[0, 1], &[2, 3], &[0, 3, 6], &[0, 1, 2, 3, 4, 5, 6]] {
            for each in [1, 3] {
                let row = |n: &usize| n / each;
                let list: Vec<usize> = (0..7 * each).collect();
                let mut rows = Rows::from(list.clone());
                let mut want = list;
                want.retain(|n| !gone.contains(&row(n)));
                rows.remove(gone, each);
                assert_eq!(rows[..], want[..], "{gone:?} of {each}");
                want.extend([70, 71]);
                rows.extend([70, 71]);
                assert_eq!(rows[..], want[..], "{gone:?} of {each}");
            }
        }
    }

    #[test]
    fn memory_is_bounded_while_the_oldest_leave() {
        let mut rows = Rows::from(vec![0; 100]);
        for n in 0..10_000 {
            rows.extend([n]);
            rows.remove(&[n % 3], 1);
            assert!(rows.list.len() <= 210, "{}", rows.list.len());
        }
        assert_eq!(rows.len(), 100);
    }
}
