//! The table of topics, one row for each field.

use super::topics::{Field, Kind, Payload, Topic};

const STATE_RATE: &str = "with the state, at most 20 a second";
const ONCE: &str = "once, kept for those who come later";

const fn always(name: &'static str, kind: Kind, what: &'static str) -> Field {
    Field {
        name,
        kind,
        required: true,
        what,
    }
}

const fn sometimes(name: &'static str, kind: Kind, what: &'static str) -> Field {
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
    Kind::Number,
    "Simulated time, s; zero is the start of the mission.",
);
const E_N: Kind = Kind::Vector(2);
const E_N_U: Kind = Kind::Vector(3);

// Keeps each row on one line.
#[rustfmt::skip]
pub(super) const TOPICS: &[Topic] = &[
    json("clock", "clock", STATE_RATE, "Simulated time, and what became of the states.", &[
        T,
        always("step", Kind::Count, "Step of the mission."),
        always("ended", Kind::Flag, "True in the last message of a run that came to its end."),
        always("sent", Kind::Count, "States published so far, this one included."),
        always("superseded", Kind::Count, "States replaced by a newer one before they were sent."),
    ]),
    json("truth", "auv/<id>/truth", STATE_RATE, "Where the vehicle is.", &[
        T,
        always("position_m", E_N_U, "Origin of the body frame (east, north, up), m; z = 0 is the still surface."),
        always("quaternion_xyzw", Kind::Vector(4), "Rotation taking body axes (forward, left, up) to world axes (ENU)."),
        always("heading_rad", Kind::Number, "Compass heading, clockwise from north, rad."),
        always("velocity_m_s", E_N_U, "Velocity over ground (east, north, up), m/s."),
        always("rates_rad_s", Kind::Vector(3), "Angular velocity in body axes (forward, left, up), rad/s."),
        always("altitude_m", Kind::Number, "Height above the bed, m."),
    ]),
    json("estimate", "auv/<id>/estimate", STATE_RATE, "Where the vehicle believes it is.", &[
        T,
        always("position_m", E_N, "Believed position (east, north), m."),
        always("depth_m", Kind::Number, "Believed depth below the still surface, m."),
        sometimes("altitude_m", Kind::Number, "Believed height above the bed, m; absent until the altimeter first heard the bed."),
        always("heading_rad", Kind::Number, "Believed compass heading, clockwise from north, rad."),
        always("roll_rad", Kind::Number, "Believed roll, right side down positive, rad."),
        always("pitch_rad", Kind::Number, "Believed pitch, nose up positive, rad."),
        always("velocity_m_s", E_N, "Believed velocity over ground (east, north), m/s."),
        always("fix_jump_m", Kind::Number, "How far the newest position fix moved the estimate, m, in the step in which it came; else zero."),
    ]),
    json("goal", "auv/<id>/goal", STATE_RATE, "What the strategy asks of the guidance.", &[
        T,
        always("id", Kind::Count, "Number of the goal, growing by one with each new one."),
        always("manoeuvre", Kind::Word(&["go_to_point", "follow_line", "go_to_point_with_heading", "course", "direct"]), "Horizontal part."),
        sometimes("point_m", E_N, "Destination, or end of the line (east, north), m."),
        sometimes("from_m", E_N, "Start of the line (east, north), m."),
        sometimes("radius_m", Kind::Number, "Arrival radius, m."),
        sometimes("heading_rad", Kind::Number, "Heading on arrival, or course over ground, clockwise from north, rad."),
        always("vertical", Kind::Word(&["altitude", "depth"]), "What the vertical part keeps."),
        always("vertical_m", Kind::Number, "Height above the bed or depth to keep, m."),
        always("speed_m_s", Kind::Number, "Speed over ground wished for, m/s."),
    ]),
    json("command", "auv/<id>/command", STATE_RATE, "What the guidance asks of the autopilot, and the autopilot of the actuators.", &[
        T,
        always("kind", Kind::Word(&["steer", "direct"]), "Through the autopilot, or straight to the actuators."),
        sometimes("heading_rad", Kind::Number, "Heading to steer, clockwise from north, rad."),
        sometimes("water_speed_m_s", Kind::Number, "Speed through the water, m/s."),
        sometimes("vertical", Kind::Word(&["altitude", "depth"]), "What the vertical part keeps."),
        sometimes("vertical_m", Kind::Number, "Height above the bed or depth to keep, m."),
        always("rudder_rad", Kind::Number, "Rudder asked for, positive turns to starboard, rad."),
        always("stern_rad", Kind::Number, "Stern plane asked for, positive pitches the nose down, rad."),
        always("rpm", Kind::Number, "Propeller speed asked for, 1/min."),
    ]),
    json("chemical", "auv/<id>/chemical", STATE_RATE, "Newest reading of the chemical sensor.", &[
        T,
        always("volts", Kind::Number, "Output, V."),
        always("of_full_scale", Kind::Number, "Output as a share of full scale, 0 to 1."),
        always("above_threshold", Kind::Flag, "The newest reading is above the detection threshold."),
        always("detected", Kind::Flag, "A detection happened since the message before, superseded states included."),
    ]),
    json("flow", "auv/<id>/flow", STATE_RATE, "Flow at the vehicle, as it believes; absent until first measured.", &[
        T,
        always("velocity_m_s", E_N, "Velocity of the water over ground (east, north), m/s; where it goes."),
        always("heading_rad", Kind::Number, "Where the water goes, clockwise from north, rad."),
        always("age_s", Kind::Number, "Age of the newest measurement in it, s."),
    ]),
    json("behaviour", "auv/<id>/behaviour", STATE_RATE, "What the vehicle is doing.", &[
        T,
        always("behaviour", Kind::Behaviour, "Its name."),
        always("lost_points_m", Kind::Points, "Where it lost the plume, as it believes (east, north), m."),
        sometimes("region", Kind::Count, "Subregion it searches, from 0; absent in transits and where the area is one."),
        sometimes("region_name", Kind::Text, "Its name on maps and in tables: a letter, in the order of search."),
        sometimes("region_m", Kind::Points, "The corners of that subregion (east, north), m."),
        sometimes("abnormal", Kind::Words, "What is wrong now: left the area, no bottom lock, no altitude, no flow, touched the bed or an obstacle; absent where nothing is."),
    ]),
    json("layers", "auv/<id>/layers", STATE_RATE, "Who holds the vehicle among the layers of its planner; absent for a strategy without layers.", &[
        T,
        always("layers", Kind::Words, "Their names, lowest first."),
        always("states", Kind::Words, "How each stands: silent, holds (the vehicle), suppressed (its command is replaced by a higher layer's) or inhibited (its input is taken away)."),
        sometimes("holds", Kind::Text, "Name of the one that holds."),
    ]),
    json("declaration", "auv/<id>/declaration/<number>", "with the state, once made", "A source the vehicle declared, or (rule up_flow_edge) where it traced a plume out of a subregion; said again under the same number when it was looked at.", &[
        always("t_s", Kind::Number, "Simulated time of the declaration, s."),
        always("number", Kind::Count, "Its number among the vehicle's declarations, from 0."),
        always("position_m", E_N, "Where, as the vehicle believes (east, north), m."),
        always("rule", Kind::Text, "By which rule."),
        always("verdict", Kind::Word(&["unchecked", "verified", "rejected"]), "What a look at it said."),
        sometimes("region", Kind::Count, "Subregion in which it was made, from 0; absent where the area is one."),
        sometimes("region_name", Kind::Text, "The subregion's name: a letter, in the order of search."),
        sometimes("surveyed_m", E_N, "Where the sidescan has the source, as the vehicle believes (east, north), m."),
    ]),
    Topic {
        name: "picture",
        key: "auv/<id>/picture",
        what: "Newest picture of the vehicle's camera, as JPEG; halved in size until it fits into a message.",
        rate: "at most 2 a second, of a vehicle with a camera; as PNG, without loss, in the recording",
        payload: Payload::Jpeg,
        fields: &[
            always("t_s", Kind::Number, "Simulated time at which it was taken, s."),
            always("taken", Kind::Count, "Pictures the vehicle has taken so far, this one and those superseded included."),
            always("width", Kind::Count, "Its width, pixels."),
            always("height", Kind::Count, "Its height, pixels."),
            always("view_rad", Kind::Number, "Full horizontal angle of view, rad."),
            always("position_m", E_N_U, "The camera, as the vehicle believes (east, north, up), m."),
            always("quaternion_xyzw", Kind::Vector(4), "Rotation taking camera axes (right in the picture, down, into the scene) to world axes (ENU), as the vehicle believes."),
        ],
    },
    Topic {
        name: "sidescan",
        key: "auv/<id>/sidescan",
        what: "Newest ping of the vehicle's sidescan sonar: strength of the echo (dB above the noise floor's reference), nearest first, to port and then to starboard, packed little-endian f32.",
        rate: "at most 20 a second, of a vehicle with a sidescan",
        payload: Payload::PackedF32,
        fields: &[
            always("t_s", Kind::Number, "Simulated time of the ping, s."),
            always("taken", Kind::Count, "Pings so far, this one and those superseded included."),
            always("port", Kind::Count, "Samples to port."),
            always("starboard", Kind::Count, "Samples to starboard."),
            always("max_m", Kind::Number, "Slant range of the last sample's far end, m; the samples of a side divide it evenly."),
            always("position_m", E_N_U, "The sonar, as the vehicle believes (east, north, up), m."),
            always("heading_rad", Kind::Number, "Believed compass heading, clockwise from north, rad; port lies to its left."),
            sometimes("altitude_m", Kind::Number, "Believed height of the vehicle above the bed, m; absent until the altimeter first heard the bed."),
            always("dtype", Kind::Word(&["<f4"]), "How a number is packed."),
        ],
    },
    json("joints", "gantry/<id>/joints", STATE_RATE, "Where a gantry's head is and what its drives do; names, positions, velocities and efforts as in a ROS JointState.", &[
        T,
        always("name", Kind::Words, "The two joints: along the stream, across it."),
        always("position_m", Kind::Numbers, "True position of each joint, m."),
        always("velocity_m_s", Kind::Numbers, "True speed of each joint, m/s."),
        always("effort_n", Kind::Numbers, "Force of each drive, N."),
        always("head_m", E_N_U, "The head (east, north, up), m; z = 0 is the still surface."),
        always("encoder_m", Kind::Vector(2), "The head by its encoders, in the gantry's frame (forward, left), m."),
        always("target_m", Kind::Vector(2), "Where the head is to go, in the gantry's frame (forward, left), m."),
        always("arrived", Kind::Flag, "Both drives have reached the target."),
        always("blocked", Kind::Flag, "A drive gave up against something in the way."),
        sometimes("touching", Kind::Text, "What the gantry touches."),
    ]),
    json("probes", "gantry/<id>/probes", STATE_RATE, "Newest scan of a gantry's probes; absent until the first.", &[
        always("t_s", Kind::Number, "Simulated time of the scan, s."),
        always("position_m", Kind::Places, "Tip of each probe (east, north, up), m, in the order of the URDF."),
        always("volts", Kind::Numbers, "Output of each probe, V."),
    ]),
    json("spikes", "gantry/<id>/spikes", STATE_RATE, "What a gantry's searcher makes of its probes.", &[
        T,
        always("threshold_v", Kind::Numbers, "Spike threshold of each probe, V."),
        always("spike", Kind::Flags, "A spike was found on the probe since the message before, superseded states included."),
        always("spike_hz", Kind::Number, "Spikes a second lately, Hz."),
        always("magnitude_v", Kind::Number, "Mean spike magnitude since the latest step, V above the bottom of the range."),
        sometimes("predicted_v", Kind::Number, "Predicted magnitude of the present step, V above the bottom of the range."),
        always("contrast", Kind::Number, "Contrast between the sides, left positive, −1 to 1."),
    ]),
    json("gantry_behaviour", "gantry/<id>/behaviour", STATE_RATE, "What a gantry's searcher is doing.", &[
        T,
        always("behaviour", Kind::GantryBehaviour, "Its name."),
        always("move", Kind::Count, "Number of the motion command, growing by one with each new one."),
        sometimes("found", Kind::Flag, "There once it stopped: true when it declared a source, false when it gave up."),
    ]),
    json("gantry_declaration", "gantry/<id>/declaration", "with the state, once made", "The source a gantry's searcher declared: where it stopped.", &[
        always("t_s", Kind::Number, "Simulated time of the declaration, s."),
        always("position_m", E_N, "Where its encoders have the head (east, north), m."),
        always("rule", Kind::Text, "By which rule."),
    ]),
    Topic {
        name: "plume",
        key: "plume",
        what: "Some of the plume's filaments: of each x y z (m, ENU), size (m), mass (kg) of all filaments it stands for, how many those are; packed little-endian f32. The masses sum to what is in the water.",
        rate: "at most 2 a second",
        payload: Payload::PackedF32,
        fields: &[
            T,
            always("total", Kind::Count, "How many filaments there are in all."),
            always("shown", Kind::Count, "How many are in the payload."),
            always("fields", Kind::Words, "What the numbers of a filament are, in their order."),
            always("dtype", Kind::Word(&["<f4"]), "How a number is packed."),
        ],
    },
    Topic {
        name: "map",
        key: "map/<id>",
        what: "Where a robot believes the source may be: the probability of each cell, first axis fastest, then the second, then upwards, packed little-endian f32.",
        rate: "at most 2 a second, of a robot that keeps a map",
        payload: Payload::PackedF32,
        fields: &[
            always("t_s", Kind::Number, "Simulated time of its last update, s."),
            always("updates", Kind::Count, "Updates so far."),
            always("informed", Kind::Flag, "A detection went into it."),
            always("cells", Kind::Vector(3), "Cells along the first and the second axis, and upwards; 1 in the third for a map of the plane."),
            always("cell_m", Kind::Vector(3), "Size of a cell along them, m; larger than the robot's own where the map would not fit into a message."),
            always("corner_m", E_N_U, "Lowest corner of the first cell (east, north, up), m."),
            always("axis_heading_rad", Kind::Number, "Direction of the first axis, clockwise from north, rad; the second lies to its left."),
            always("best_m", E_N_U, "Middle of the most probable cell (east, north, up), m."),
            always("entropy_nat", Kind::Number, "Entropy, nat."),
            always("credible_95", Kind::Number, "Size of the smallest set of cells with 95 % of the probability, m²; m³ for a map of the space."),
            always("dtype", Kind::Word(&["<f4"]), "How a number is packed."),
        ],
    },
    json("scenario", "meta/scenario", ONCE, "What is run.", &[
        always("name", Kind::Text, "Name of the scenario."),
        always("seed", Kind::Count, "The seed."),
        always("ron", Kind::Text, "The scenario as written (RON)."),
    ]),
    json("version", "meta/version", ONCE, "By what it is run.", &[
        always("program", Kind::Text, "The program."),
        always("version", Kind::Text, "Its version."),
    ]),
    json("digest", "meta/digest", "once, at the end", "Digest over the whole state sequence: equal digests, equal runs.", &[
        always("digest", Kind::Text, "The digest."),
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
