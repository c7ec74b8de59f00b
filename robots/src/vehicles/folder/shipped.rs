//! The vehicles that come with the program: their folders, in the program itself.

use crate::vehicles::files::Files;
use std::path::{Path, PathBuf};

/// A vehicle that comes with the program.
#[derive(Clone, Copy, Debug)]
pub struct Shipped {
    /// Name of its folder.
    pub folder: &'static str,
    /// Its `vehicle.ron`.
    pub file: &'static str,
    /// Name and text of its URDF.
    pub urdf: (&'static str, &'static str),
}

macro_rules! shipped {
    ($($folder:literal),*) => {
        &[$(Shipped {
            folder: $folder,
            file: include_str!(concat!("../../../vehicles/", $folder, "/vehicle.ron")),
            urdf: (
                concat!($folder, ".urdf"),
                include_str!(concat!("../../../vehicles/", $folder, "/", $folder, ".urdf")),
            ),
        }),*]
    };
}

/// All of them.
pub const SHIPPED: &[Shipped] = shipped![
    "bluerov2",
    "bluerov2_heavy",
    "lauv",
    "glider",
    "surface_craft"
];

impl Shipped {
    /// The one of a name.
    #[must_use]
    pub fn named(folder: &str) -> Option<&'static Self> {
        SHIPPED.iter().find(|s| s.folder == folder)
    }
}

/// A shipped vehicle's folder as files, read by the reader of others.
pub(in crate::vehicles) struct BuiltIn<'a> {
    pub(in crate::vehicles) shipped: &'static Shipped,
    pub(in crate::vehicles) reader: &'a dyn Files,
}

impl Files for BuiltIn<'_> {
    fn path(&self, name: &Path) -> PathBuf {
        Path::new("built-in").join(name)
    }

    fn bytes(&self, name: &Path, _: u64) -> Result<Vec<u8>, String> {
        let folder = Path::new(self.shipped.folder);
        [("vehicle.ron", self.shipped.file), self.shipped.urdf]
            .into_iter()
            .find(|(file, _)| name == folder.join(file))
            .map(|(_, text)| text.into())
            .ok_or_else(|| "there is no such file".into())
    }

    fn text(&self, name: &Path, most_bytes: u64) -> Result<String, String> {
        let bytes = self.bytes(name, most_bytes)?;
        String::from_utf8(bytes).map_err(|e| format!("it is not UTF-8 text: {e}"))
    }

    fn vehicle(
        &self,
        path: &str,
        text: &str,
    ) -> Result<super::VehicleFile, crate::error::RobotError> {
        self.reader.vehicle(path, text)
    }
}
