//! The topics that gantries publish.

use crate::topic::run::{E_N, E_N_U, STATE_RATE, T};
use crate::topic::{Field, FieldKind, Topic};

// Keeps each row on one line.
#[rustfmt::skip]
/// The topics of each gantry.
pub const TOPICS: &[Topic] = &[
    Topic::json("joints", "gantry/<id>/joints", STATE_RATE, "Where a gantry's head is and what its drives do; names, positions, velocities and efforts as in a ROS JointState.", &[
        T,
        Field::always("name", FieldKind::Words, "The two joints: along the stream, across it."),
        Field::always("position_m", FieldKind::Numbers, "True position of each joint, m."),
        Field::always("velocity_m_s", FieldKind::Numbers, "True speed of each joint, m/s."),
        Field::always("effort_n", FieldKind::Numbers, "Force of each drive, N."),
        Field::always("head_m", E_N_U, "The head (east, north, up), m; z = 0 is the still surface."),
        Field::always("encoder_m", FieldKind::Vector(2), "The head by its encoders, in the gantry's frame (forward, left), m."),
        Field::always("target_m", FieldKind::Vector(2), "Where the head is to go, in the gantry's frame (forward, left), m."),
        Field::always("arrived", FieldKind::Flag, "Both drives have reached the target."),
        Field::always("blocked", FieldKind::Flag, "A drive gave up against something in the way."),
        Field::sometimes("touching", FieldKind::Text, "What the gantry touches."),
    ]),
    Topic::json("probes", "gantry/<id>/probes", STATE_RATE, "Newest scan of a gantry's probes; absent until the first.", &[
        Field::always("t_s", FieldKind::Number, "Simulated time of the scan, s."),
        Field::always("position_m", FieldKind::Places, "Tip of each probe (east, north, up), m, in the order of the URDF."),
        Field::always("volts", FieldKind::Numbers, "Output of each probe, V."),
    ]),
    Topic::json("spikes", "gantry/<id>/spikes", STATE_RATE, "What a gantry's searcher makes of its probes.", &[
        T,
        Field::always("threshold_v", FieldKind::Numbers, "Spike threshold of each probe, V."),
        Field::always("spike", FieldKind::Flags, "A spike was found on the probe since the message before, superseded states included."),
        Field::always("spike_hz", FieldKind::Number, "Spikes a second lately, Hz."),
        Field::always("magnitude_v", FieldKind::Number, "Mean spike magnitude since the latest step, V above the bottom of the range."),
        Field::sometimes("predicted_v", FieldKind::Number, "Predicted magnitude of the present step, V above the bottom of the range."),
        Field::always("contrast", FieldKind::Number, "Contrast between the sides, left positive, −1 to 1."),
    ]),
    Topic::json("gantry_behaviour", "gantry/<id>/behaviour", STATE_RATE, "What a gantry's searcher is doing.", &[
        T,
        Field::always("behaviour", FieldKind::GantryBehaviour, "Its name."),
        Field::always("move", FieldKind::Count, "Number of the motion command, growing by one with each new one."),
        Field::sometimes("found", FieldKind::Flag, "There once it stopped: true when it declared a source, false when it gave up."),
    ]),
    Topic::json("gantry_declaration", "gantry/<id>/declaration", "with the state, once made", "The source a gantry's searcher declared: where it stopped.", &[
        Field::always("t_s", FieldKind::Number, "Simulated time of the declaration, s."),
        Field::always("position_m", E_N, "Where its encoders have the head (east, north), m."),
        Field::always("rule", FieldKind::Text, "By which rule."),
    ]),
];
