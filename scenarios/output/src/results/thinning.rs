//! Keeps evenly spaced values of a long run: one of every few, of ever more the longer it is.

/// Which of the values of a run are kept.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Thinning {
    stride: usize,
    skip: usize,
}

impl Default for Thinning {
    fn default() -> Self {
        Self { stride: 1, skip: 0 }
    }
}

impl Thinning {
    /// Whether the next value is kept.
    pub(crate) fn keeps(&mut self) -> bool {
        if self.skip > 0 {
            self.skip -= 1;
            return false;
        }
        self.skip = self.stride - 1;
        true
    }

    /// From now on half as many are kept.
    pub(crate) fn halve(&mut self) {
        self.stride *= 2;
        self.skip = self.stride - 1;
    }

    /// Adds the next value to a list if it is kept. Of a list longer than `most`, every other value is dropped.
    pub(crate) fn push<T>(&mut self, list: &mut Vec<T>, most: usize, new: impl FnOnce() -> T) {
        if !self.keeps() {
            return;
        }
        list.push(new());
        if list.len() > most {
            let mut odd = false;
            list.retain(|_| {
                odd = !odd;
                odd
            });
            self.halve();
        }
    }
}
