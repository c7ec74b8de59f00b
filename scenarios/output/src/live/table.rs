//! The table of topics, one row for each field.

use super::topics::{Field, FieldKind, Payload, Topic};

const STATE_RATE: &str = "with the state, at most 20 a second";
const ONCE: &str = "once, kept for those who come later";

const fn always(name: &'static str, kind: FieldKind, what: &'static str) -> Field {
    Field {
        name,
        kind,
        required: true,
        what,
    }
}

const fn sometimes(name: &'static str, kind: FieldKind, what: &'static str) -> Field {
    Field {
        name,
        kind,
        required: false,
        what,
    }
}

const fn json(
    name: &'static str,
    key: &'static str,
    rate: &'static str,
    what: &'static str,
    fields: &'static [Field],
) -> Topic {
    Topic {
        name,
        key,
        what,
        rate,
        payload: Payload::Json,
        fields,
    }
}

const T: Field = always(
    "t_s",
    FieldKind::Number,
    "Simulated time, s; zero is the start of the mission.",
);
const E_N: FieldKind = FieldKind::Vector(2);
const E_N_U: FieldKind = FieldKind::Vector(3);

// A field a row; longer texts go on in the next line.
#[rustfmt::skip]
pub(super) const TOPICS: &[Topic] = &[
    json("clock", "clock", STATE_RATE, "Simulated time, and what became of the states.", &[
        T,
        always("step", FieldKind::Count, "Step of the mission."),
        always("ended", FieldKind::Flag, "True in the last message of a run that came to its end."),
        always("sent", FieldKind::Count, "States published so far, this one included."),
        always("superseded", FieldKind::Count, "States replaced by a newer one before they were sent."),
    ]),
    json("truth", "auv/<id>/truth", STATE_RATE, "Where the vehicle is.", &[
        T,
        always("position_m", E_N_U, "Origin of the body frame (east, north, up), m; z = 0 is the still surface."),
        always("quaternion_xyzw", FieldKind::Vector(4), "Rotation taking body axes (forward, left, up) to world axes \
            (ENU)."),
        always("heading_rad", FieldKind::Number, "Compass heading, clockwise from north, rad."),
        always("velocity_m_s", E_N_U, "Velocity over ground (east, north, up), m/s."),
        always("rates_rad_s", FieldKind::Vector(3), "Angular velocity in body axes (forward, left, up), rad/s."),
        always("altitude_m", FieldKind::Number, "Height above the bed, m."),
    ]),
    json("estimate", "auv/<id>/estimate", STATE_RATE, "Where the vehicle believes it is.", &[
        T,
        always("position_m", E_N, "Believed position (east, north), m."),
        always("depth_m", FieldKind::Number, "Believed depth below the still surface, m."),
        sometimes("altitude_m", FieldKind::Number, "Believed height above the bed, m; absent until the altimeter \
            first heard the bed."),
        always("heading_rad", FieldKind::Number, "Believed compass heading, clockwise from north, rad."),
        always("roll_rad", FieldKind::Number, "Believed roll, right side down positive, rad."),
        always("pitch_rad", FieldKind::Number, "Believed pitch, nose up positive, rad."),
        always("velocity_m_s", E_N, "Believed velocity over ground (east, north), m/s."),
        always("fix_jump_m", FieldKind::Number, "How far the newest position fix moved the estimate, m, in the step \
            in which it came; else zero."),
    ]),
    json("goal", "auv/<id>/goal", STATE_RATE, "What the strategy asks of the guidance.", &[
        T,
        always("id", FieldKind::Count, "Number of the goal, growing by one with each new one."),
        always("manoeuvre", FieldKind::Word(&["go_to_point", "follow_line", "go_to_point_with_heading", "course",
            "direct"]), "Horizontal part."),
        sometimes("point_m", E_N, "Destination, or end of the line (east, north), m."),
        sometimes("from_m", E_N, "Start of the line (east, north), m."),
        sometimes("radius_m", FieldKind::Number, "Arrival radius, m."),
        sometimes("heading_rad", FieldKind::Number, "Heading on arrival, or course over ground, clockwise from north, \
            rad."),
        always("vertical", FieldKind::Word(&["altitude", "depth"]), "What the vertical part keeps."),
        always("vertical_m", FieldKind::Number, "Height above the bed or depth to keep, m."),
        always("speed_m_s", FieldKind::Number, "Speed over ground wished for, m/s."),
    ]),
    json("command", "auv/<id>/command", STATE_RATE, "What the guidance asks of the autopilot, and the autopilot of \
        the actuators.", &[
        T,
        always("kind", FieldKind::Word(&["steer", "direct"]), "Through the autopilot, or straight to the actuators."),
        sometimes("heading_rad", FieldKind::Number, "Heading to steer, clockwise from north, rad."),
        sometimes("water_speed_m_s", FieldKind::Number, "Speed through the water, m/s."),
        sometimes("vertical", FieldKind::Word(&["altitude", "depth"]), "What the vertical part keeps."),
        sometimes("vertical_m", FieldKind::Number, "Height above the bed or depth to keep, m."),
        always("rudder_rad", FieldKind::Number, "Rudder asked for, positive turns to starboard, rad."),
        always("stern_rad", FieldKind::Number, "Stern plane asked for, positive pitches the nose down, rad."),
        always("rpm", FieldKind::Number, "Propeller speed asked for, 1/min."),
    ]),
    json("chemical", "auv/<id>/chemical", STATE_RATE, "Newest reading of the chemical sensor.", &[
        T,
        always("volts", FieldKind::Number, "Output, V."),
        always("of_full_scale", FieldKind::Number, "Output as a share of full scale, 0 to 1."),
        always("above_threshold", FieldKind::Flag, "The newest reading is above the detection threshold."),
        always("detected", FieldKind::Flag, "A detection happened since the message before, superseded states \
            included."),
    ]),
    json("flow", "auv/<id>/flow", STATE_RATE, "Flow at the vehicle, as it believes; absent until first measured.", &[
        T,
        always("velocity_m_s", E_N, "Velocity of the water over ground (east, north), m/s; where it goes."),
        always("heading_rad", FieldKind::Number, "Where the water goes, clockwise from north, rad."),
        always("age_s", FieldKind::Number, "Age of the newest measurement in it, s."),
    ]),
    json("behaviour", "auv/<id>/behaviour", STATE_RATE, "What the vehicle is doing.", &[
        T,
        always("behaviour", FieldKind::Behaviour, "Its name."),
        always("lost_points_m", FieldKind::Points, "Where it lost the plume, as it believes (east, north), m."),
        sometimes("region", FieldKind::Count, "Subregion it searches, from 0; absent in transits and where the area \
            is one."),
        sometimes("region_name", FieldKind::Text, "Its name on maps and in tables: a letter, in the order of search."),
        sometimes("region_m", FieldKind::Points, "The corners of that subregion (east, north), m."),
        sometimes("abnormal", FieldKind::Words, "What is wrong now: left the area, no bottom lock, no altitude, no \
            flow, touched the bed or an obstacle; absent where nothing is."),
    ]),
    json("layers", "auv/<id>/layers", STATE_RATE, "Who holds the vehicle among the layers of its planner; absent for \
        a strategy without layers.", &[
        T,
        always("layers", FieldKind::Words, "Their names, lowest first."),
        always("states", FieldKind::Words, "How each stands: silent, holds (the vehicle), suppressed (its command is \
            replaced by a higher layer's) or inhibited (its input is taken away)."),
        sometimes("holds", FieldKind::Text, "Name of the one that holds."),
    ]),
    json("declaration", "auv/<id>/declaration/<number>", "with the state, once made", "A source the vehicle declared, \
        or (rule up_flow_edge) where it traced a plume out of a subregion; said again under the same number when it \
        was looked at.", &[
        always("t_s", FieldKind::Number, "Simulated time of the declaration, s."),
        always("number", FieldKind::Count, "Its number among the vehicle's declarations, from 0."),
        always("position_m", E_N, "Where, as the vehicle believes (east, north), m."),
        always("rule", FieldKind::Text, "By which rule."),
        always("verdict", FieldKind::Word(&["unchecked", "verified", "rejected"]), "What a look at it said."),
        sometimes("region", FieldKind::Count, "Subregion in which it was made, from 0; absent where the area is one."),
        sometimes("region_name", FieldKind::Text, "The subregion's name: a letter, in the order of search."),
        sometimes("surveyed_m", E_N, "Where the sidescan has the source, as the vehicle believes (east, north), m."),
    ]),
    Topic {
        name: "picture",
        key: "auv/<id>/picture",
        what: "Newest picture of the vehicle's camera, as JPEG; halved in size until it fits into a message.",
        rate: "at most 2 a second, of a vehicle with a camera; as PNG, without loss, in the recording",
        payload: Payload::Jpeg,
        fields: &[
            always("t_s", FieldKind::Number, "Simulated time at which it was taken, s."),
            always("taken", FieldKind::Count, "Pictures the vehicle has taken so far, this one and those superseded \
                included."),
            always("width", FieldKind::Count, "Its width, pixels."),
            always("height", FieldKind::Count, "Its height, pixels."),
            always("view_rad", FieldKind::Number, "Full horizontal angle of view, rad."),
            always("position_m", E_N_U, "The camera, as the vehicle believes (east, north, up), m."),
            always("quaternion_xyzw", FieldKind::Vector(4), "Rotation taking camera axes (right in the picture, down, \
                into the scene) to world axes (ENU), as the vehicle believes."),
        ],
    },
    Topic {
        name: "sidescan",
        key: "auv/<id>/sidescan",
        what: "Newest ping of the vehicle's sidescan sonar: strength of the echo (dB above the noise floor's \
            reference), nearest first, to port and then to starboard, packed little-endian f32.",
        rate: "at most 20 a second, of a vehicle with a sidescan",
        payload: Payload::PackedF32,
        fields: &[
            always("t_s", FieldKind::Number, "Simulated time of the ping, s."),
            always("taken", FieldKind::Count, "Pings so far, this one and those superseded included."),
            always("port", FieldKind::Count, "Samples to port."),
            always("starboard", FieldKind::Count, "Samples to starboard."),
            always("max_m", FieldKind::Number, "Slant range of the last sample's far end, m; the samples of a side \
                divide it evenly."),
            always("position_m", E_N_U, "The sonar, as the vehicle believes (east, north, up), m."),
            always("heading_rad", FieldKind::Number, "Believed compass heading, clockwise from north, rad; port lies \
                to its left."),
            sometimes("altitude_m", FieldKind::Number, "Believed height of the vehicle above the bed, m; absent until \
                the altimeter first heard the bed."),
            always("dtype", FieldKind::Word(&["<f4"]), "How a number is packed."),
        ],
    },
    json("joints", "gantry/<id>/joints", STATE_RATE, "Where a gantry's head is and what its drives do; names, \
        positions, velocities and efforts as in a ROS JointState.", &[
        T,
        always("name", FieldKind::Words, "The two joints: along the stream, across it."),
        always("position_m", FieldKind::Numbers, "True position of each joint, m."),
        always("velocity_m_s", FieldKind::Numbers, "True speed of each joint, m/s."),
        always("effort_n", FieldKind::Numbers, "Force of each drive, N."),
        always("head_m", E_N_U, "The head (east, north, up), m; z = 0 is the still surface."),
        always("encoder_m", FieldKind::Vector(2), "The head by its encoders, in the gantry's frame (forward, left), \
            m."),
        always("target_m", FieldKind::Vector(2), "Where the head is to go, in the gantry's frame (forward, left), m."),
        always("arrived", FieldKind::Flag, "Both drives have reached the target."),
        always("blocked", FieldKind::Flag, "A drive gave up against something in the way."),
        sometimes("touching", FieldKind::Text, "What the gantry touches."),
    ]),
    json("probes", "gantry/<id>/probes", STATE_RATE, "Newest scan of a gantry's probes; absent until the first.", &[
        always("t_s", FieldKind::Number, "Simulated time of the scan, s."),
        always("position_m", FieldKind::Places, "Tip of each probe (east, north, up), m, in the order of the URDF."),
        always("volts", FieldKind::Numbers, "Output of each probe, V."),
    ]),
    json("spikes", "gantry/<id>/spikes", STATE_RATE, "What a gantry's searcher makes of its probes.", &[
        T,
        always("threshold_v", FieldKind::Numbers, "Spike threshold of each probe, V."),
        always("spike", FieldKind::Flags, "A spike was found on the probe since the message before, superseded states \
            included."),
        always("spike_hz", FieldKind::Number, "Spikes a second lately, Hz."),
        always("magnitude_v", FieldKind::Number, "Mean spike magnitude since the latest step, V above the bottom of \
            the range."),
        sometimes("predicted_v", FieldKind::Number, "Predicted magnitude of the present step, V above the bottom of \
            the range."),
        always("contrast", FieldKind::Number, "Contrast between the sides, left positive, −1 to 1."),
    ]),
    json("gantry_behaviour", "gantry/<id>/behaviour", STATE_RATE, "What a gantry's searcher is doing.", &[
        T,
        always("behaviour", FieldKind::GantryBehaviour, "Its name."),
        always("move", FieldKind::Count, "Number of the motion command, growing by one with each new one."),
        sometimes("found", FieldKind::Flag, "There once it stopped: true when it declared a source, false when it \
            gave up."),
    ]),
    json("gantry_declaration", "gantry/<id>/declaration", "with the state, once made", "The source a gantry's \
        searcher declared: where it stopped.", &[
        always("t_s", FieldKind::Number, "Simulated time of the declaration, s."),
        always("position_m", E_N, "Where its encoders have the head (east, north), m."),
        always("rule", FieldKind::Text, "By which rule."),
    ]),
    Topic {
        name: "plume",
        key: "plume",
        what: "Some of the plume's filaments: of each x y z (m, ENU), size (m), mass (kg) of all filaments it stands \
            for, how many those are; packed little-endian f32. The masses sum to what is in the water.",
        rate: "at most 2 a second",
        payload: Payload::PackedF32,
        fields: &[
            T,
            always("total", FieldKind::Count, "How many filaments there are in all."),
            always("shown", FieldKind::Count, "How many are in the payload."),
            always("fields", FieldKind::Words, "What the numbers of a filament are, in their order."),
            always("dtype", FieldKind::Word(&["<f4"]), "How a number is packed."),
        ],
    },
    Topic {
        name: "map",
        key: "map/<id>",
        what: "Where a robot believes the source may be: the probability of each cell, first axis fastest, then the \
            second, then upwards, packed little-endian f32.",
        rate: "at most 2 a second, of a robot that keeps a map",
        payload: Payload::PackedF32,
        fields: &[
            always("t_s", FieldKind::Number, "Simulated time of its last update, s."),
            always("updates", FieldKind::Count, "Updates so far."),
            always("informed", FieldKind::Flag, "A detection went into it."),
            always("cells", FieldKind::Vector(3), "Cells along the first and the second axis, and upwards; 1 in the \
                third for a map of the plane."),
            always("cell_m", FieldKind::Vector(3), "Size of a cell along them, m; larger than the robot's own where \
                the map would not fit into a message."),
            always("corner_m", E_N_U, "Lowest corner of the first cell (east, north, up), m."),
            always("axis_heading_rad", FieldKind::Number, "Direction of the first axis, clockwise from north, rad; \
                the second lies to its left."),
            always("best_m", E_N_U, "Middle of the most probable cell (east, north, up), m."),
            always("entropy_nat", FieldKind::Number, "Entropy, nat."),
            always("credible_95", FieldKind::Number, "Size of the smallest set of cells with 95 % of the probability, \
                m²; m³ for a map of the space."),
            always("dtype", FieldKind::Word(&["<f4"]), "How a number is packed."),
        ],
    },
    json("scenario", "meta/scenario", ONCE, "What is run.", &[
        always("name", FieldKind::Text, "Name of the scenario."),
        always("seed", FieldKind::Count, "The seed."),
        always("ron", FieldKind::Text, "The scenario as written (RON)."),
    ]),
    json("version", "meta/version", ONCE, "By what it is run.", &[
        always("program", FieldKind::Text, "The program."),
        always("version", FieldKind::Text, "Its version."),
    ]),
    json("digest", "meta/digest", "once, at the end", "Digest over the whole state sequence: equal digests, equal \
        runs.", &[
        always("digest", FieldKind::Text, "The digest."),
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
