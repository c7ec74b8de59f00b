//! Reads the files that a scenario names for its vehicles. The robots open no file themselves.

use super::fault::ScenarioError;
use super::reader;
use robots::error::RobotError;
use robots::vehicles::{Files, VehicleFile};
use std::path::{Path, PathBuf};
use world::files;
use world::registry::Registry;

/// The files in a folder, usually that of the scenario file.
pub struct FolderFiles<'a>(pub &'a Path);

impl Files for FolderFiles<'_> {
    fn path(&self, name: &Path) -> PathBuf {
        self.0.join(name)
    }

    fn bytes(&self, name: &Path, most_bytes: u64) -> Result<Vec<u8>, String> {
        files::read(&self.path(name), most_bytes).map_err(|e| e.to_string())
    }

    fn vehicle(&self, path: &str, text: &str) -> Result<VehicleFile, RobotError> {
        reader::read::<VehicleFile>(&Registry::default(), path, text, |_| Vec::new()).map_err(|e| {
            let lines = match &e {
                ScenarioError::File { problem, .. } => vec![problem.clone()],
                _ => (e.lines().iter())
                    .map(|line| line.trim_start_matches(path).trim_start_matches(':').into())
                    .collect::<Vec<String>>(),
            };
            RobotError::File { path: path.into(), problem: lines.join("\n") }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use robots::vehicles::{RemusSpec, Vehicle, VehicleSpec};

    fn error(dir: &Path, name: &str) -> String {
        let spec = RemusSpec { urdf: Some(name.into()), ..RemusSpec::default() };
        let error = Vehicle::load(&VehicleSpec::Remus100(spec), &FolderFiles(dir)).expect_err("this is wrong");
        error.to_string()
    }

    #[test]
    fn files_are_found_beside_the_scenario_and_named_with_their_path() {
        assert_eq!(
            error(Path::new("/no/such/place"), "none.urdf"),
            "/no/such/place/none.urdf: No such file or directory (os error 2)"
        );
        let dir = tempfile::tempdir().unwrap();
        std::fs::create_dir(dir.path().join("hulls")).unwrap();
        let at = |name: &str| dir.path().join(name);
        std::fs::write(at("hulls/latin.urdf"), b"<robot>\n\xe9").unwrap();
        assert_eq!(
            error(dir.path(), "hulls/latin.urdf"),
            format!("{}: it is not UTF-8 text: line 2, byte 8", at("hulls/latin.urdf").display())
        );
        let mesh = include_str!("../../../../robots/vehicles/remus100/remus100.urdf")
            .replace("<capsule radius=\"0.095\" length=\"1.41\"/>", "<mesh filename=\"hull.obj\"/>");
        std::fs::write(at("hulls/mesh.urdf"), mesh).unwrap();
        std::fs::write(at("hulls/hull.obj"), "v 0 0 0\nv 1 0\n").unwrap();
        let found = error(dir.path(), "hulls/mesh.urdf");
        let place = "link \"base_link\", collision 1: mesh \"hull.obj\": at 2: ";
        assert!(found.starts_with(&format!("{}: {place}", at("hulls/mesh.urdf").display())), "{found}");
    }
}
