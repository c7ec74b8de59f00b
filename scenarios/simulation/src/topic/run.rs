//! The topics of a run itself, and what the tables of topics have in common.

use super::{Field, FieldKind, Payload, Topic};

/// Rate of what is published with each state.
pub const STATE_RATE: &str = "with the state, at most 20 a second";
/// Rate of what never changes.
pub const ONCE: &str = "once, kept for those who come later";

/// The time of a message.
pub const T: Field = Field::always("t_s", FieldKind::Number, "Simulated time, s; zero is the start of the mission.");
/// A place or vector in the plane (east, north).
pub const E_N: FieldKind = FieldKind::Vector(2);
/// A place or vector in space (east, north, up).
pub const E_N_U: FieldKind = FieldKind::Vector(3);

// Keeps each row on one line.
#[rustfmt::skip]
/// Time; it is published last, so that whoever has it also has the state that belongs to it.
pub const CLOCK: &[Topic] = &[
    Topic::json("clock", "clock", STATE_RATE, "Simulated time, and what became of the states.", &[
        T,
        Field::always("step", FieldKind::Count, "Step of the mission."),
        Field::always("ended", FieldKind::Flag, "True in the last message of a run that came to its end."),
        Field::always("sent", FieldKind::Count, "States published so far, this one included."),
        Field::always("superseded", FieldKind::Count, "States replaced by a newer one before they were sent."),
    ]),
];

#[rustfmt::skip]
/// The plume, the maps and what is published once.
pub const RUN: &[Topic] = &[
    Topic {
        name: "plume",
        key: "plume",
        what: "Some of the plume's filaments: of each x y z (m, ENU, x and y from origin_m), size (m), mass (kg) of all filaments it stands for, how many those are; packed little-endian f32. The masses sum to what is in the water.",
        rate: "at most 2 a second",
        payload: Payload::PackedF32,
        fields: &[
            T,
            Field::always("total", FieldKind::Count, "How many filaments there are in all."),
            Field::always("shown", FieldKind::Count, "How many are in the payload."),
            Field::always("origin_m", FieldKind::Vector(2), "Centre of the area (east, north), m; x and y are relative to it."),
            Field::always("fields", FieldKind::Words, "What the numbers of a filament are, in their order."),
            Field::always("dtype", FieldKind::Word(&["<f4"]), "How a number is packed."),
        ],
    },
    Topic {
        name: "water",
        key: "water",
        what: "Flow of the water on a coarse grid at three heights: of each place x y z (m, ENU, x and y from origin_m) and velocity east, north, up (m/s), packed little-endian f32.",
        rate: "with the plume; once if the flow is steady",
        payload: Payload::PackedF32,
        fields: &[
            T,
            Field::always("shown", FieldKind::Count, "How many places are in the payload."),
            Field::always("origin_m", FieldKind::Vector(2), "Centre of the area (east, north), m; x and y are relative to it."),
            Field::always("fields", FieldKind::Words, "What the numbers of a place are, in their order."),
            Field::always("dtype", FieldKind::Word(&["<f4"]), "How a number is packed."),
        ],
    },
    Topic {
        name: "map",
        key: "map/<id>",
        what: "Where a robot believes the source may be: the probability of each cell, first axis fastest, then the second, then upwards, packed little-endian f32.",
        rate: "at most 2 a second, of a robot that keeps a map",
        payload: Payload::PackedF32,
        fields: &[
            Field::always("t_s", FieldKind::Number, "Simulated time of its last update, s."),
            Field::always("updates", FieldKind::Count, "Updates so far."),
            Field::always("informed", FieldKind::Flag, "A detection went into it."),
            Field::always("cells", FieldKind::Vector(3), "Cells along the first and the second axis, and upwards; 1 in the third for a map of the plane."),
            Field::always("cell_m", FieldKind::Vector(3), "Size of a cell along them, m; larger than the robot's own where the map would not fit into a message."),
            Field::always("corner_m", E_N_U, "Lowest corner of the first cell (east, north, up), m."),
            Field::always("axis_heading_rad", FieldKind::Number, "Direction of the first axis, clockwise from north, rad; the second lies to its left."),
            Field::always("best_m", E_N_U, "Middle of the most probable cell (east, north, up), m."),
            Field::always("entropy_nat", FieldKind::Number, "Entropy, nat."),
            Field::always("credible_95", FieldKind::Number, "Size of the smallest set of cells with 95 % of the probability, m²; m³ for a map of the space."),
            Field::always("dtype", FieldKind::Word(&["<f4"]), "How a number is packed."),
        ],
    },
    Topic::json("scenario", "meta/scenario", ONCE, "What is run.", &[
        Field::always("name", FieldKind::Text, "Name of the scenario."),
        Field::always("seed", FieldKind::Count, "The seed."),
        Field::always("ron", FieldKind::Text, "The scenario as written (RON)."),
    ]),
    Topic::json("scene", "meta/scene", ONCE, "What is there before the run, to be drawn; scene.json in the recording. See docs/scene.md.", &[
        Field::always("version", FieldKind::Count, "Version of the form of this document."),
        Field::always("run", FieldKind::Text, "Id of the run in keys."),
        Field::always("scenario", FieldKind::Text, "Name of the scenario."),
        Field::always("title", FieldKind::Text, "Its title."),
        Field::always("seed", FieldKind::Count, "The seed."),
        Field::always("area", FieldKind::Object, "Operating area: corners_m (east, north), m."),
        Field::always("origin_m", FieldKind::Vector(2), "Its centre (east, north), m; bed and solids are placed from there."),
        Field::always("bed", FieldKind::Object, "Bed as a grid: shape [rows, columns]; points_m, base64 of f32 (east, north, up), m."),
        Field::always("surface", FieldKind::Flag, "Whether the surface of the water is worth drawing."),
        Field::always("solids", FieldKind::Objects, "Obstacles: name, color, vertices_m (base64 of f32), triangles (base64 of u32)."),
        Field::always("sources", FieldKind::Objects, "True sources: name, position_m."),
        Field::always("layers", FieldKind::Objects, "Interfaces between layers of the water: name, z_m."),
        Field::always("machines", FieldKind::Objects, "Robots and gantries: links with shapes, joints, drives, sensors."),
    ]),
    Topic::json("version", "meta/version", ONCE, "By what it is run.", &[
        Field::always("program", FieldKind::Text, "The program."),
        Field::always("version", FieldKind::Text, "Its version."),
    ]),
    Topic::json("digest", "meta/digest", "once, at the end", "Digest of all states, declarations and the outcome: equal digests, equal runs.", &[
        Field::always("digest", FieldKind::Text, "The digest."),
    ]),
    Topic {
        name: "schema",
        key: "meta/schema/<name>",
        what: "JSON Schema of a topic.",
        rate: ONCE,
        payload: Payload::Schema,
        fields: &[],
    },
];
