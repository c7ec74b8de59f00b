//! A picture from a file: 8 bits per colour, on white where it is transparent; or the reason why it cannot be used.

use image::{DynamicImage, ImageError, ImageFormat, ImageReader, Limits, Rgb, RgbImage};
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use world::files;

/// Greatest width and height, px.
pub const MOST_SIDE: u32 = 32_768;
/// Largest number of pixels.
pub const MOST_PIXELS: u64 = 64_000_000;
/// Longest file, bytes.
const MOST_BYTES: u64 = 512 << 20;
/// Most memory for decoding, bytes: a whole picture of 16 bits with alpha, and the same again.
const MOST_MEMORY: u64 = 16 * MOST_PIXELS;

/// Why a picture cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// It cannot be opened or read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's message.
        source: std::io::Error,
    },
    /// Its format is unknown.
    #[error("{}: not a picture that can be read here", path.display())]
    NotAPicture {
        /// The file.
        path: PathBuf,
    },
    /// It is a picture, but incomplete or damaged.
    #[error("{}: a broken {format} file: {problem}", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// The format with which it begins.
        format: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// It is too large.
    #[error("{}: too large: {what}; at most {MOST_SIDE} pixels on a side and {} million in all", path.display(), MOST_PIXELS / 1_000_000)]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size, in words.
        what: String,
    },
}

impl PictureError {
    /// How to solve the problem.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            PictureError::NotAPicture { .. } => {
                Some("PNG, JPEG, BMP, PNM, TIFF and WebP are read, by their content, whatever the file's name")
            }
            PictureError::Broken { .. } => Some("copy or export it again: only whole files are judged"),
            PictureError::TooLarge { .. } => Some("scale it down or cut it first"),
            PictureError::Read { .. } => None,
        }
    }
}

/// Reads a picture of any format and colour depth.
///
/// Grey becomes three equal colours, 16 bits are rounded to 8, and floating-point levels are limited to 0 to 1.
/// Transparent parts show white, which means "nothing" to the extractor. A rotation in the file's metadata is ignored.
///
/// # Errors
/// If the file cannot be read, is no picture, is not whole, or is too large.
pub fn read_picture(path: &Path) -> Result<RgbImage, PictureError> {
    let unreadable = |source| PictureError::Read { path: path.to_owned(), source };
    let too_large = |what: String| PictureError::TooLarge { path: path.to_owned(), what };
    let mut bytes = Vec::new();
    let file = files::open(path).map_err(unreadable)?;
    (file.take(MOST_BYTES + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(too_large(format!("more than {} MB", MOST_BYTES >> 20)));
    }
    let Ok(format) = image::guess_format(&bytes) else {
        return Err(PictureError::NotAPicture { path: path.to_owned() });
    };
    let wrong = |error: ImageError| match error {
        ImageError::Limits(_) => too_large("more memory than allowed".to_string()),
        ImageError::Unsupported(_) if name(format).is_none() => PictureError::NotAPicture { path: path.to_owned() },
        other => broken(path, format, other.to_string()),
    };
    let reader = |limits: Limits| {
        let mut reader = ImageReader::with_format(Cursor::new(&bytes), format);
        reader.limits(limits);
        reader
    };
    let (w, h) = (reader(Limits::default()).into_dimensions()).map_err(wrong)?;
    if w.max(h) > MOST_SIDE || u64::from(w) * u64::from(h) > MOST_PIXELS {
        return Err(too_large(format!("{w} x {h} pixels")));
    }
    if w == 0 || h == 0 {
        return Err(broken(path, format, format!("{w} x {h} pixels")));
    }
    if format == ImageFormat::Jpeg && !jpeg_ends(&bytes) {
        let problem = "it ends before its end marker".to_string();
        return Err(broken(path, format, problem));
    }
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_MEMORY);
    Ok(on_white(reader(limits).decode().map_err(wrong)?))
}

fn broken(path: &Path, format: ImageFormat, problem: String) -> PictureError {
    PictureError::Broken { path: path.to_owned(), format: name(format).unwrap_or("picture"), problem }
}

fn name(format: ImageFormat) -> Option<&'static str> {
    match format {
        ImageFormat::Png => Some("PNG"),
        ImageFormat::Jpeg => Some("JPEG"),
        ImageFormat::Bmp => Some("BMP"),
        ImageFormat::Pnm => Some("PNM"),
        ImageFormat::Tiff => Some("TIFF"),
        ImageFormat::WebP => Some("WebP"),
        _ => None,
    }
}

/// Whether an end marker follows the last scan of a JPEG; the decoder would fill missing parts with grey. Neither
/// marker can occur inside a scan, where 0xFF is followed by 0 or a restart marker.
fn jpeg_ends(bytes: &[u8]) -> bool {
    let last = |marker: u8| bytes.windows(2).rposition(|w| w == [0xff, marker]);
    match (last(0xda), last(0xd9)) {
        (Some(scan), Some(end)) => end > scan,
        _ => false,
    }
}

fn on_white(decoded: DynamicImage) -> RgbImage {
    if !decoded.color().has_alpha() {
        return decoded.into_rgb8();
    }
    let rgba = decoded.into_rgba8();
    RgbImage::from_fn(rgba.width(), rgba.height(), |x, y| {
        let [r, g, b, a] = rgba.get_pixel(x, y).0.map(u32::from);
        Rgb([r, g, b].map(|c| ((c * a + 255 * (255 - a) + 127) / 255) as u8))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, ImageBuffer, Luma, LumaA, Rgba};

    fn round_trip(picture: impl Into<DynamicImage>, format: ImageFormat) -> RgbImage {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.any");
        picture.into().save_with_format(&path, format).unwrap();
        read_picture(&path).unwrap()
    }

    #[test]
    fn grey_alpha_and_16_bits_become_three_colours_of_8() {
        let all = [ImageFormat::Png, ImageFormat::Tiff];
        for format in all.into_iter().chain([ImageFormat::Bmp, ImageFormat::Pnm]) {
            let grey = GrayImage::from_pixel(1, 1, Luma([77]));
            assert_eq!(round_trip(grey, format).get_pixel(0, 0).0, [77; 3], "{format:?}");
        }
        let rgba = |p: [u8; 4]| round_trip(image::RgbaImage::from_pixel(1, 1, Rgba(p)), ImageFormat::Png);
        assert_eq!(rgba([10, 20, 30, 255]).get_pixel(0, 0).0, [10, 20, 30]);
        assert_eq!(rgba([10, 20, 30, 0]).get_pixel(0, 0).0, [255; 3]);
        assert_eq!(rgba([0, 100, 255, 128]).get_pixel(0, 0).0, [127, 177, 255]);
        let deep: ImageBuffer<Rgb<u16>, Vec<u16>> = ImageBuffer::from_pixel(2, 1, Rgb([0, 257 * 100, 65_535]));
        assert_eq!(round_trip(deep, ImageFormat::Png).get_pixel(1, 0).0, [0, 100, 255]);
        let grey: ImageBuffer<LumaA<u16>, Vec<u16>> = ImageBuffer::from_pixel(1, 1, LumaA([0, 0]));
        assert_eq!(round_trip(grey, ImageFormat::Png).get_pixel(0, 0).0, [255; 3]);
    }

    /// Every beginning of a file is refused or, if only bytes after the picture are missing, gives the picture.
    #[test]
    fn no_beginning_of_a_file_gives_another_picture() {
        let whole = RgbImage::from_fn(23, 17, |x, y| Rgb([(11 * x) as u8, (15 * y) as u8, ((x * y) % 251) as u8]));
        let folder = tempfile::tempdir().unwrap();
        let exact = [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Pnm, ImageFormat::Tiff, ImageFormat::WebP];
        for format in exact.into_iter().chain([ImageFormat::Jpeg]) {
            let mut bytes = Cursor::new(Vec::new());
            whole.write_to(&mut bytes, format).unwrap();
            let bytes = bytes.into_inner();
            let path = folder.path().join("picture");
            std::fs::write(&path, &bytes).unwrap();
            let want = read_picture(&path).unwrap();
            if format != ImageFormat::Jpeg {
                assert_eq!(want, whole, "{format:?}");
            }
            for n in 0..bytes.len() {
                // A file that is replaced in place is waited for by some file systems; a new one is not.
                std::fs::remove_file(&path).unwrap();
                std::fs::write(&path, &bytes[..n]).unwrap();
                match read_picture(&path) {
                    Ok(got) => assert_eq!(got, want, "{format:?}: {n} of {} bytes", bytes.len()),
                    Err(error) => assert!(!matches!(error, PictureError::Read { .. }), "{error}"),
                }
            }
        }
    }

    #[test]
    fn what_is_no_picture_or_not_there_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let said = |path: &Path| read_picture(path).unwrap_err().to_string();
        let missing = folder.path().join("nowhere.png");
        assert!(said(&missing).contains("cannot read") && said(&missing).contains("nowhere.png"));
        assert!(said(folder.path()).contains("cannot read"));
        let file = folder.path().join("text.png");
        for (bytes, says) in [
            (b"this is no picture".as_slice(), "not a picture"),
            (b"GIF89a\x01\x00\x01\x00\x00\x00\x00;", "not a picture"),
            (b"P6 100000 100000 255\n", "too large: 100000 x 100000"),
            (b"P6 10000 10000 255\n", "too large"),
        ] {
            std::fs::write(&file, bytes).unwrap();
            assert!(said(&file).contains(says), "{}", said(&file));
        }
    }
}
