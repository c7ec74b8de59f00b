//! The scene as a JSON document: the attachment `scene.json` of a recording, and the live key `meta/scene`.
//!
//! SI units; east, north, up; z = 0 at the still surface. Long arrays are base64 of little-endian f32, or u32 for
//! numbers of corners, row by row. `docs/interfaces.md` describes every field.

use super::{Machine, Mesh, Scene, SensorPlace};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use nalgebra::Vector3;
use rheotaxis::topic::chunk;
use rheotaxis::topic::run::SceneMessage;
use robots::vehicles::{Form, LinkLook, Look, Mount};
use serde_json::{Map, Value, json};
use world::frames::Pose;
use world::physics::Shape;

/// Version of the document. It grows when a reader of the old form would misread the new one.
const VERSION: u32 = 2;

impl Scene {
    /// The document of a run of this scenario.
    pub fn document(&self, seed: u64) -> String {
        let centre = self.centre().push(0.0);
        let solids = self.solids.iter().map(|s| {
            let (vertices, triangles) = mesh(&s.mesh, centre);
            json!({"name": s.name, "color": s.colour, "vertices_m": vertices, "triangles": triangles})
        });
        let sources = (self.sources.iter()).map(|(name, p)| json!({"name": name, "position_m": p.as_slice()}));
        let layers =
            (self.layers.iter().enumerate()).map(|(k, z)| json!({"name": format!("interface {}", k + 1), "z_m": z}));
        let corners: Vec<&[f64]> = self.corners.iter().map(|c| c.as_slice()).collect();
        let document = SceneMessage {
            version: VERSION,
            run: format!("{}_{seed}", chunk(&self.scenario)),
            scenario: self.scenario.clone(),
            title: self.title.clone(),
            seed,
            area: fields(json!({ "corners_m": corners })),
            origin_m: centre.xy().into(),
            bed: fields(json!({
                "shape": [self.bed.rows, self.bed.columns], "points_m": points(&self.bed.points, centre),
            })),
            surface: self.surface,
            solids: solids.map(fields).collect(),
            sources: sources.map(fields).collect(),
            layers: layers.map(fields).collect(),
            machines: self.machines.iter().map(machine).collect(),
        };
        json!(document).to_string()
    }
}

fn machine(m: &Machine) -> Map<String, Value> {
    let d = &m.description;
    let drives = (d.moved.iter()).map(|d| json!({"joint": d.joint, "actuator": d.actuator, "unit": d.unit}));
    let slides = (m.slides.iter()).map(|s| json!({"joint": s, "actuator": s, "unit": "m"}));
    let mut out = fields(json!({
        "id": m.id,
        "kind": if m.base.is_some() { "gantry" } else { "robot" },
        "base": m.base.as_ref().map(pose),
        "root": d.root,
        "links": d.links.iter().map(link).collect::<Vec<_>>(),
        "joints": d.joints.iter().map(joint).collect::<Vec<_>>(),
        "drives": drives.chain(slides).collect::<Vec<_>>(),
        "sensors": m.sensors.iter().map(sensor).collect::<Vec<_>>(),
    }));
    if let Some((share, volts)) = m.threshold {
        out.insert("threshold".into(), share.into());
        out.insert("full_scale_v".into(), volts.into());
    }
    out
}

fn link(l: &LinkLook) -> Value {
    json!({"name": l.name, "shapes": l.shapes.iter().map(shape).collect::<Vec<_>>()})
}

fn shape(look: &Look) -> Value {
    let form = match &look.form {
        Form::Solid(Shape::Box { size_m }) => {
            json!({"kind": "box", "size_m": size_m.as_slice()})
        }
        Form::Solid(Shape::Cylinder { radius_m, length_m }) => {
            json!({"kind": "cylinder", "radius_m": radius_m, "length_m": length_m})
        }
        Form::Solid(Shape::Capsule { radius_m, length_m }) => {
            json!({"kind": "capsule", "radius_m": radius_m, "length_m": length_m})
        }
        Form::Solid(Shape::Sphere { radius_m }) => json!({"kind": "sphere", "radius_m": radius_m}),
        Form::Solid(Shape::Hull { points_m }) => {
            // A hull comes from a mesh file, which is drawn as a mesh: only its corners are left.
            json!({"kind": "mesh", "vertices_m": points(points_m, Vector3::zeros()), "triangles": ""})
        }
        Form::Mesh(triangles) => {
            let (vertices, triangles) = mesh(&Mesh::from_triangles(triangles), Vector3::zeros());
            json!({"kind": "mesh", "vertices_m": vertices, "triangles": triangles})
        }
    };
    let mut out = fields(form);
    out.append(&mut fields(pose(&look.pose)));
    out.insert("color".into(), json!(look.colour));
    Value::Object(out)
}

fn joint(m: &Mount) -> Value {
    let mut out = fields(json!({
        "name": m.joint, "kind": m.kind.name(), "parent": m.parent, "child": m.child,
        "axis": m.axis.as_slice(),
    }));
    out.append(&mut fields(pose(&m.pose)));
    Value::Object(out)
}

fn sensor(s: &SensorPlace) -> Value {
    let mut out = fields(json!({"kind": s.kind, "name": s.name, "link": s.link}));
    out.append(&mut fields(pose(&s.pose)));
    for (name, value) in [("view_rad", s.view_rad), ("height_rad", s.height_rad), ("max_m", s.max_m)] {
        if let Some(value) = value {
            out.insert(name.into(), value.into());
        }
    }
    Value::Object(out)
}

fn pose(p: &Pose) -> Value {
    json!({"position_m": p.p_WB.as_slice(), "quaternion_xyzw": p.R_WB.coords.as_slice()})
}

fn fields(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(fields) => fields,
        _ => Map::new(),
    }
}

/// Points as base64 of f32, relative to an origin.
fn points(all: &[Vector3<f64>], origin: Vector3<f64>) -> String {
    let numbers = all.iter().flat_map(|p| (p - origin).map(|v| v as f32).data.0[0]);
    STANDARD.encode(numbers.flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
}

/// Corners and triangles of a mesh as base64 of f32 and of u32.
fn mesh(mesh: &Mesh, origin: Vector3<f64>) -> (String, String) {
    let numbers = mesh.triangles.as_flattened().iter();
    let bytes: Vec<u8> = numbers.flat_map(|k| k.to_le_bytes()).collect();
    (points(&mesh.vertices, origin), STANDARD.encode(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rheotaxis::scenario::load;
    use std::path::Path;

    fn document(scenario: &str) -> Value {
        let scene = Scene::from_scenario(&load(Path::new(scenario)).unwrap()).unwrap();
        serde_json::from_str(&scene.document(7)).unwrap()
    }

    fn numbers(value: &Value) -> Vec<f32> {
        let bytes = STANDARD.decode(value.as_str().unwrap()).unwrap();
        let numbers = bytes.chunks_exact(4);
        numbers.map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
    }

    #[test]
    fn the_document_holds_bed_obstacles_sources_and_layers() {
        let scene = document("duck_survey");
        assert_eq!(scene["run"], "duck_survey_7");
        assert_eq!(scene["area"]["corners_m"].as_array().unwrap().len(), 4);
        let bed = numbers(&scene["bed"]["points_m"]);
        let (rows, columns) = (&scene["bed"]["shape"][0], &scene["bed"]["shape"][1]);
        let n = rows.as_u64().unwrap() * columns.as_u64().unwrap();
        assert_eq!(bed.len() as u64, 3 * n);
        assert!(bed.chunks(3).all(|p| (-8.0..=-4.0).contains(&p[2])));
        assert_eq!(scene["layers"][0]["z_m"], -1.0);
        // A box of 1 m by 1 m by 0.7 m, as twelve triangles of eight corners.
        let solid = &scene["solids"][0];
        assert_eq!(numbers(&solid["vertices_m"]).len(), 8 * 3);
        assert_eq!(solid["triangles"].as_str().unwrap().len(), 12 * 3 * 4 / 3 * 4);
        let source = scene["sources"][0]["position_m"][2].as_f64().unwrap();
        assert!((-8.0..-3.8).contains(&source), "{source}");
    }

    #[test]
    fn the_document_holds_shapes_joints_drives_and_sensors_of_a_robot() {
        let scene = document("duck_survey");
        let robot = &scene["machines"][0];
        assert_eq!((&robot["kind"], &robot["base"]), (&json!("robot"), &Value::Null));
        let named = |list: &Value, field: &str, name: &Value| -> Value {
            let found = list.as_array().unwrap().iter().find(|one| one[field] == *name);
            found.unwrap_or_else(|| panic!("no {name}")).clone()
        };
        let joint = |actuator: &str| {
            let drive = named(&robot["drives"], "actuator", &json!(actuator));
            named(&robot["joints"], "name", &drive["joint"])
        };
        assert_eq!(joint("rudder_rad")["axis"], json!([0.0, 0.0, 1.0]));
        // Nose down: the trailing edge goes down, so the leading edge goes up.
        assert_eq!(joint("stern_rad")["axis"], json!([0.0, -1.0, 0.0]));
        assert_eq!(joint("rpm")["kind"], "continuous");
        for link in ["base_link", "rudder", "stern_plane", "propeller"] {
            let shapes = named(&robot["links"], "name", &json!(link))["shapes"].as_array().unwrap().len();
            assert!(shapes > 0, "{link}");
        }
        let altimeter = named(&robot["sensors"], "kind", &json!("altimeter"));
        assert_eq!(altimeter["link"], robot["root"]);
        named(&robot["sensors"], "kind", &json!("chemical"));
        assert_eq!((&robot["threshold"], &robot["full_scale_v"]), (&json!(0.04), &json!(5.0)));
    }

    #[test]
    fn the_document_holds_a_gantry_with_its_slides_and_probes() {
        let scene = document("flume_crab");
        let gantry = &scene["machines"][0];
        assert_eq!(gantry["kind"], "gantry");
        assert!(gantry["base"]["position_m"].is_array());
        let drives = gantry["drives"].as_array().unwrap();
        let slides: Vec<&Value> = drives.iter().map(|d| &d["joint"]).collect();
        assert_eq!(slides, ["along_stream", "across_stream"]);
        let probes = gantry["sensors"].as_array().unwrap();
        assert!(probes.len() == 3 && probes.iter().all(|s| s["kind"] == "probe"));
        assert_eq!(scene["surface"], false);
    }
}
