//! Heights on a regular grid from an ESRI ASCII grid file (.asc), as triangles of a closed surface.
//!
//! *Source*: Esri, ArcGIS documentation, "Esri ASCII raster format": the lines `ncols`, `nrows`, `xllcorner` or
//! `xllcenter`, `yllcorner` or `yllcenter`, `cellsize`, optionally `NODATA_value`, then the rows from north to south.
//!
//! *Parameters*: none; the solid reaches [`SKIRT_M`] below the lowest height, in units of the file.
//!
//! *Deviations*: heights stand at the centres of the raster's cells and are joined by triangles, so the surface is one
//! cell smaller than the raster. The position in the file is ignored: the scenario places the surface by its centre. A
//! missing height is an error, not a hole; without the line `NODATA_value` it is the format's own, -9999.

use super::mesh_file::{MeshProblem, Triangle};
use crate::error::WorldError;
use crate::files;
use std::path::Path;

/// How far the solid reaches below its lowest height, so that even a flat field encloses a volume.
pub(super) const SKIRT_M: f64 = 1.0;
/// Largest number of heights.
const MOST: usize = 500_000;
/// Longest file read, bytes: enough for that many heights with all their digits.
const LONGEST: u64 = 32 << 20;

/// What stands for a missing height in a file that does not say.
const MISSING: f64 = -9999.0;

/// Heights on a grid.
#[derive(Debug, PartialEq)]
pub(super) struct Heights {
    columns: usize,
    rows: usize,
    cell: f64,
    // Rows from north to south, each from west to east.
    z: Vec<f64>,
}

/// Reads a file; its ending determines the format.
pub(super) fn read(path: &Path) -> Result<Heights, WorldError> {
    let fail = |(place, problem)| WorldError::File { path: path.display().to_string(), place, problem };
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    if ending.to_lowercase() != "asc" {
        let problem = format!("height fields end in .asc (Esri ASCII grid), not \".{ending}\"");
        return Err(fail((String::new(), problem)));
    }
    let text = files::read_text(path, LONGEST).map_err(|e| fail((String::new(), e.to_string())))?;
    parse(&text).map_err(fail)
}

fn parse(text: &str) -> Result<Heights, MeshProblem> {
    let mut header = Header::default();
    let mut z = Vec::new();
    for (n, line) in text.lines().enumerate() {
        let here = format!(":{}", n + 1);
        let mut words = line.split_whitespace().peekable();
        let named = |w: &&str| w.starts_with(|c: char| c.is_ascii_alphabetic()) && w.parse::<f64>().is_err();
        if let Some(name) = words.next_if(named) {
            let value = words.next().unwrap_or_default();
            header.set(&name.to_lowercase(), value, z.is_empty()).map_err(|p| (here, p))?;
            continue;
        }
        for word in words {
            match word.parse::<f64>() {
                Ok(v) if v == header.missing.unwrap_or(MISSING) => {
                    let at = z.len().checked_rem(header.columns).unwrap_or(0) + 1;
                    let by = match header.missing {
                        Some(v) => format!("NODATA_value {v}"),
                        None => format!("{v}, which is the format's NODATA_value if no line says another"),
                    };
                    let problem = format!("height {at} of the row is missing ({by}): fill the gap first");
                    return Err((here, problem));
                }
                Ok(v) if v.is_finite() => z.push(v),
                _ => return Err((here, format!("height \"{word}\" is not a finite number"))),
            }
        }
    }
    header.grid(z)
}

#[derive(Default)]
struct Header {
    columns: usize,
    rows: usize,
    cell: f64,
    missing: Option<f64>,
}

impl Header {
    fn set(&mut self, name: &str, value: &str, early: bool) -> Result<(), String> {
        if !early {
            return Err(format!("\"{name}\" stands among the heights"));
        }
        let number = || match value.parse::<f64>() {
            Ok(v) if v.is_finite() => Ok(v),
            _ => Err(format!("{name} \"{value}\" is not a finite number")),
        };
        let count = || match value.parse::<usize>() {
            Ok(n) if n >= 2 => Ok(n),
            _ => Err(format!("{name} must be a whole number from 2, got \"{value}\"")),
        };
        match name {
            "ncols" => self.columns = count()?,
            "nrows" => self.rows = count()?,
            "cellsize" => self.cell = number()?,
            "nodata_value" => self.missing = Some(number()?),
            "xllcorner" | "xllcenter" | "yllcorner" | "yllcenter" => {
                number()?;
            }
            _ => return Err(format!("\"{name}\" is no line of an Esri ASCII grid")),
        }
        Ok(())
    }

    fn grid(self, z: Vec<f64>) -> Result<Heights, MeshProblem> {
        let whole = |problem: String| Err((String::new(), problem));
        let Self { columns, rows, cell, .. } = self;
        if columns == 0 || rows == 0 || cell <= 0.0 {
            return whole("must say ncols, nrows (2 or more) and cellsize (> 0) before the heights".into());
        }
        let Some(count) = columns.checked_mul(rows).filter(|n| *n <= MOST) else {
            return whole(format!("{columns} x {rows} heights are more than {MOST}: thin it out"));
        };
        if z.len() != count {
            return whole(format!("{} heights, not the {columns} x {rows} = {count} announced", z.len()));
        }
        Ok(Heights { columns, rows, cell, z })
    }
}

impl Heights {
    /// A closed surface about the grid's centre: x points east, y north, and the lowest height is at 0.
    pub(super) fn triangles(&self) -> Vec<Triangle> {
        let (nx, ny) = (self.columns, self.rows);
        let lowest = self.z.iter().copied().fold(f64::INFINITY, f64::min);
        let place = |i: usize, j: usize| {
            let x = (i as f64 - 0.5 * (nx - 1) as f64) * self.cell;
            let y = (0.5 * (ny - 1) as f64 - j as f64) * self.cell;
            [x, y, self.z[j * nx + i] - lowest]
        };
        let foot = |[x, y, _]: [f64; 3]| [x, y, -SKIRT_M];
        let mut all = Vec::with_capacity(2 * nx * ny + 6 * (nx + ny));
        for j in 0..ny - 1 {
            for i in 0..nx - 1 {
                let (nw, ne) = (place(i, j), place(i + 1, j));
                let (sw, se) = (place(i, j + 1), place(i + 1, j + 1));
                all.extend([[nw, sw, se], [nw, se, ne]]);
            }
        }
        // Round the rim anticlockwise as seen from above: south, east, north, west.
        let south = (0..nx - 1).map(|i| (i, ny - 1));
        let east = (1..ny).rev().map(|j| (nx - 1, j));
        let north = (1..nx).rev().map(|i| (i, 0));
        let west = (0..ny - 1).map(|j| (0, j));
        let rim: Vec<[f64; 3]> = south.chain(east).chain(north).chain(west).map(|(i, j)| place(i, j)).collect();
        let middle = [0.0, 0.0, -SKIRT_M];
        for (n, a) in rim.iter().enumerate() {
            let b = rim[(n + 1) % rim.len()];
            all.extend([[*a, foot(*a), foot(b)], [*a, foot(b), b], [middle, foot(b), foot(*a)]]);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\nNODATA_value -9999\n";

    #[test]
    fn reads_rows_from_north_to_south() {
        let got = parse(&format!("{HEAD}1 2 3\n4 5 6e0\n")).unwrap();
        let z = vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        assert_eq!(got, Heights { columns: 3, rows: 2, cell: 2.0, z });
        let north_west = got.triangles()[0][0];
        assert_eq!(north_west, [-2.0, 1.0, 0.0]);
    }

    #[test]
    fn broken_files_say_where() {
        let unsaid = HEAD.replace("NODATA_value -9999\n", "");
        for (text, said) in [
            (format!("{HEAD}1 2 3\n4 5\n"), ": 5 heights, not the 3 x 2 = 6"),
            (format!("{HEAD}1 2 nan\n4 5 6\n"), ":7: height \"nan\""),
            (format!("{HEAD}1 2 3\n4 -9999 6\n"), ":8: height 2 of the row is missing (NODATA_value -9999)"),
            (
                format!("{unsaid}1 2 3\n4 5 -9999.0\n"),
                ":7: height 3 of the row is missing (-9999, which is the format's",
            ),
            (HEAD.replace('3', "1"), ":1: ncols must be a whole number from 2"),
            (HEAD.replace("cellsize 2", "cellsize x"), ":5: cellsize \"x\""),
            ("hello\n".into(), ":1: \"hello\" is no line"),
            (String::new(), ": must say ncols"),
            (HEAD.replace('3', "900000"), ": 900000 x 2 heights are more than 500000"),
        ] {
            let (place, problem) = parse(&text).expect_err(said);
            assert!(format!("{place}: {problem}").starts_with(said), "{place}: {problem}");
        }
        let other = format!("{unsaid}NODATA_value 0\n1 2 3\n4 5 -9999\n");
        assert!(parse(&other).is_ok(), "a height where another number stands for gaps");
    }
}
