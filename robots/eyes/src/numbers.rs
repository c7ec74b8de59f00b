//! Sums over rectangles of a table, and the middle one of some numbers.
//!
//! *Source*: tables of sums: Crow 1984, Computer Graphics 18(3), 207.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

/// Sums of a quantity over all rectangles of a table from its first corner.
pub(crate) struct Sums {
    width: usize,
    height: usize,
    sums: Vec<f64>,
}

impl Sums {
    /// Of a table whose cell number `n`, row by row, holds `value(n)`.
    pub(crate) fn new(width: usize, height: usize, value: impl Fn(usize) -> f64) -> Self {
        let mut sums = vec![0.0; (width + 1) * (height + 1)];
        for y in 0..height {
            let mut row = 0.0;
            for x in 0..width {
                row += value(y * width + x);
                sums[(y + 1) * (width + 1) + x + 1] = sums[y * (width + 1) + x + 1] + row;
            }
        }
        Self { width, height, sums }
    }

    /// The sum over columns and rows, each without its end.
    pub(crate) fn over(&self, (left, right): (usize, usize), (top, bottom): (usize, usize)) -> f64 {
        let sum = |x: usize, y: usize| self.sums[y * (self.width + 1) + x];
        sum(right, bottom) - sum(right, top) - sum(left, bottom) + sum(left, top)
    }

    /// The sum over the square that reaches so far to all sides of cell number `at`, without what is outside the table,
    /// and its number of cells.
    pub(crate) fn about(&self, at: usize, reach: usize) -> (f64, usize) {
        let side = |v: usize, end: usize| (v.saturating_sub(reach), (v + reach + 1).min(end));
        let (columns, rows) = (side(at % self.width, self.width), side(at / self.width, self.height));
        (self.over(columns, rows), (columns.1 - columns.0) * (rows.1 - rows.0))
    }
}

/// The middle one of some numbers, of two the greater; `None` of none.
pub(crate) fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut all: Vec<f64> = values.collect();
    let middle = all.len() / 2;
    (!all.is_empty()).then(|| *all.select_nth_unstable_by(middle, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_by_hand() {
        // 0 1 2
        // 3 4 5
        let sums = Sums::new(3, 2, |n| n as f64);
        assert_eq!(sums.over((0, 3), (0, 2)), 15.0);
        assert_eq!(sums.over((1, 3), (1, 2)), 9.0);
        assert_eq!(sums.over((2, 2), (0, 2)), 0.0);
        assert_eq!(sums.about(4, 1), (15.0, 6));
        assert_eq!(sums.about(0, 1), (0.0 + 1.0 + 3.0 + 4.0, 4));
    }

    #[test]
    fn the_middle_one_of_an_even_number_is_the_greater_of_two() {
        let of = |values: &[f64]| median(values.iter().copied());
        assert_eq!((of(&[]), of(&[7.0])), (None, Some(7.0)));
        assert_eq!((of(&[3.0, 1.0, 2.0]), of(&[4.0, 1.0, 3.0, 2.0])), (Some(2.0), Some(3.0)));
    }
}
