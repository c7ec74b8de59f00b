//! The instruments a scenario can fit.

use world::catalogue::Entry;

/// One row an instrument, named as the field of `sensors` in RON.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "fluorometer",
        what: "Dye concentration as a voltage: first-order response, noise, quantisation, saturation, detection threshold.",
        source: "Turner Designs Cyclops-7 (Sea-Bird application note 74); Pang 2009, section 6",
    },
    Entry {
        name: "dvl",
        what: "Velocity over ground by bottom track: noise, scale error, bottom lock by range.",
        source: "Teledyne RD Instruments, Workhorse Navigator 1200 kHz data sheet",
    },
    Entry {
        name: "adcp",
        what: "Water relative to the vehicle in the first cell beyond the dead zone, looking up or down.",
        source: "Pang 2009, section 6; RD Instruments, ADCP Principles of Operation (1996)",
    },
    Entry {
        name: "compass",
        what: "Heading with noise and bias, roll, pitch and rates.",
        source: "Electronic compasses of the class of PNI's TCM2",
    },
    Entry {
        name: "depth",
        what: "Depth below the still surface from pressure.",
        source: "Strain-gauge pressure sensors, 0.01 % of full scale",
    },
    Entry {
        name: "ctd",
        what: "Density of the water at the vehicle: response, noise, rate.",
        source: "Sea-Bird SBE 49 FastCAT data sheet; Pang 2009, section 7",
    },
    Entry {
        name: "altimeter",
        what: "Height above the bed by an echo along the body's down axis.",
        source: "500 kHz echo sounder class; Pang 2009, section 6",
    },
    Entry {
        name: "lbl",
        what: "Position fixes from a long acoustic baseline: period, noise, drop-outs.",
        source: "Pang 2009, sections 4 and 5.6",
    },
    Entry {
        name: "probes",
        what: "Conductivity probes of a gantry's head, scanned together: voltage with noise, quantisation, saturation.",
        source: "Webster et al. 2012, section 3",
    },
    Entry {
        name: "ranging",
        what: "Ranges ahead in a fan of beams against solids and bed: noise, range, drop-outs.",
        source: "Petillot, Tena Ruiz & Lane 2001, IEEE J. Oceanic Eng. 26, 240",
    },
    Entry {
        name: "sidescan",
        what: "Echo strength to either side by slant range: Lambert's law, shadows, water column, speckle, noise.",
        source: "Urick 1983, sections 8.2 and 8.11; Blondel 2009, The Handbook of Sidescan Sonar",
    },
    Entry {
        name: "camera",
        what: "Pictures through the water when asked for: attenuation, veil, dye, daylight or lamp, sensor noise.",
        source: "Jaffe 1990, IEEE J. Oceanic Eng. 15, 101; Williamson & Hollins 2022, Appl. Opt. 61, 9951; Zaneveld & Pegau 2003, Opt. Express 11, 2997",
    },
];
