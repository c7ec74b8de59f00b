//! Connected patches of a mask, the largest first.
//!
//! *Source*: Rosenfeld & Pfaltz, J. ACM 13 (1966) 471-494 (labelling); here by flooding.
//!
//! *Parameters*: none; pixels that share a side or a corner are connected.
//!
//! *Deviations*: none.

use image::GrayImage;
use serde::Serialize;

/// A patch of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Blob {
    /// How many.
    pub pixels: u64,
    /// Their mean place (right, down) from the middle of the top left pixel.
    pub centre_px: [f64; 2],
    /// Leftmost and uppermost pixel.
    pub low_px: [u32; 2],
    /// Rightmost and lowest pixel.
    pub high_px: [u32; 2],
}

/// The patches of the pixels above 0, largest first; of patches of equal size, the one that begins higher up and
/// farther left.
pub fn blobs(mask: &GrayImage) -> Vec<Blob> {
    let (w, h) = mask.dimensions();
    let mut open: Vec<bool> = mask.pixels().map(|p| p.0[0] > 0).collect();
    let place = |x: u32, y: u32| y as usize * w as usize + x as usize;
    let (mut found, mut stack) = (Vec::new(), Vec::new());
    for y in 0..h {
        for x in 0..w {
            if !std::mem::take(&mut open[place(x, y)]) {
                continue;
            }
            stack.push((x, y));
            let (mut n, mut sum) = (0_u64, [0_u64; 2]);
            let (mut low, mut high) = ([x, y], [x, y]);
            while let Some((x, y)) = stack.pop() {
                n += 1;
                for (k, v) in [x, y].into_iter().enumerate() {
                    sum[k] += u64::from(v);
                    low[k] = low[k].min(v);
                    high[k] = high[k].max(v);
                }
                for v in y.saturating_sub(1)..=(y + 1).min(h - 1) {
                    for u in x.saturating_sub(1)..=(x + 1).min(w - 1) {
                        if std::mem::take(&mut open[place(u, v)]) {
                            stack.push((u, v));
                        }
                    }
                }
            }
            found.push(Blob { pixels: n, centre_px: sum.map(|s| s as f64 / n as f64), low_px: low, high_px: high });
        }
    }
    found.sort_by_key(|b| std::cmp::Reverse(b.pixels));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Luma;

    fn mask(rows: &[&str]) -> GrayImage {
        let (w, h) = (rows[0].len() as u32, rows.len() as u32);
        GrayImage::from_fn(w, h, |x, y| Luma([255 * u8::from(rows[y as usize].as_bytes()[x as usize] == b'#')]))
    }

    #[test]
    fn by_hand() {
        let got = blobs(&mask(&["##..#", "#....", ".#..#", "....#"]));
        assert_eq!(got.iter().map(|b| b.pixels).collect::<Vec<_>>(), [4, 2, 1]);
        // Corner to corner is connected.
        assert_eq!(got[0].centre_px, [0.5, 0.75]);
        assert_eq!((got[0].low_px, got[0].high_px), ([0, 0], [1, 2]));
        assert_eq!(got[1].centre_px, [4.0, 2.5]);
    }

    #[test]
    fn nothing_and_everything() {
        assert!(blobs(&mask(&["...", "..."])).is_empty());
        assert!(blobs(&GrayImage::new(0, 0)).is_empty());
        assert_eq!(blobs(&mask(&["#"])).len(), 1);
        let all = blobs(&mask(&["####", "####"]));
        assert_eq!((all.len(), all[0].pixels, all[0].centre_px), (1, 8, [1.5, 0.5]));
    }
}
