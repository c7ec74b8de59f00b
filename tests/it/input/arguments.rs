//! What the command line takes: its forms, their legal ranges, and help that teaches.

use crate::common::{rheotaxis, says};
use clap::{CommandFactory, Parser};
use command::{Args, CacheCommandArgs, CampaignArgs, CampaignCommand, Command, Exit, Numbers, SegmentArgs, Speed};
use rheotaxis::registry::{Group, Registry, sections};
use rheotaxis::scenario::CATALOG;
use robots::strategy::{ColourSpec, Edges, VerifierSpec};
use robots::vehicles::SHIPPED;

fn parsed(args: &[&str]) -> Option<Command> {
    let all = ["rheotaxis"].iter().chain(args);
    Args::try_parse_from(all).ok().map(|a| a.command)
}

#[test]
fn the_command_line_is_well_formed() {
    Args::command().debug_assert();
}

/// A line for the list of commands is not the help of a command.
#[test]
fn the_help_of_every_command_says_more_than_the_list() {
    for command in Args::command().get_subcommands() {
        let [line, help] = [command.get_about(), command.get_long_about()];
        let [line, help] = [line, help].map(|t| t.map_or(0, |t| t.to_string().len()));
        assert!(line > 0 && help > 2 * line, "{}", command.get_name());
    }
}

/// What a value reads as, by the argument that takes it.
fn read(argument: &str, text: &str) -> Option<f64> {
    match argument {
        "--memory" => Args::try_parse_from(["rheotaxis", "check", "a.ron", "--memory", text]).ok().map(|a| a.memory),
        "--speed" => match text.parse() {
            Ok(Speed::Times(times)) => Some(times),
            Ok(Speed::Max) => Some(f64::INFINITY),
            Err(_) => None,
        },
        "--until-width" => match parsed(&["reproduce", "--until-width", text])? {
            Command::Reproduce(args) => args.until_width,
            other => panic!("{other:?}"),
        },
        "--max-wall" => match parsed(&["campaign", "run", "c.ron", "--out", "o", "--max-wall", text])? {
            Command::Campaign(CampaignArgs { command: CampaignCommand::Run(args) }) => {
                args.share.max_wall.map(|d| d.as_secs_f64())
            }
            other => panic!("{other:?}"),
        },
        other => panic!("{other}"),
    }
}

#[test]
fn numbers_read_with_their_units_and_within_their_range() {
    const MEMORY: [(&str, f64); 4] = [("4G", 4e9), ("500m", 5e8), ("1.5T", 1.5e12), ("2000000", 2e6)];
    const SPEED: [(&str, f64); 3] = [("max", f64::INFINITY), ("realtime", 1.0), ("2.5x", 2.5)];
    const WALL: [(&str, f64); 3] = [("55m", 3300.0), ("1h30m", 5400.0), ("1h2m3s", 3723.0)];
    for (argument, good, bad) in [
        ("--memory", &MEMORY[..], &["", "G", "-4G", "nan", "infG", "4X", "10K", "0"][..]),
        ("--speed", &SPEED, &["0", "-1", "nan", "inf", "fast", ""]),
        ("--until-width", &[("0.05", 0.05)], &["0", "0.5", "-0.1", "nan", "inf", "5%", ""]),
        ("--max-wall", &WALL, &["", "5", "m", "30m1h", "0s", "-5s", "1.5h", "5 m"]),
    ] {
        for (text, value) in good {
            assert_eq!(read(argument, text), Some(*value), "{argument} {text}");
        }
        for text in bad {
            assert_eq!(read(argument, text), None, "{argument} {text}");
        }
    }
    let usual = Args::try_parse_from(["rheotaxis", "check", "a.ron"]).unwrap();
    assert_eq!(usual.memory, rheotaxis::scenario::cost::MEMORY);
    assert_eq!("1, -2.5,3e1".parse(), Ok(Numbers([1.0, -2.5, 30.0])));
    for wrong in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,inf", "1,,3"] {
        says(&wrong.parse::<Numbers<3>>().unwrap_err(), &["3 numbers"]);
    }
}

#[test]
fn the_cache_is_by_default_that_of_the_library_and_its_help_teaches() {
    let usual = match parsed(&["cache"]) {
        Some(Command::Cache(CacheCommandArgs { place, .. })) => place,
        other => panic!("{other:?}"),
    };
    assert_eq!(usual.size, rheotaxis::cache::MOST as f64);
    assert_eq!(usual.from, rheotaxis::cache::LEAST.as_secs_f64());
    let mut all = Args::command();
    let cache = all.find_subcommand_mut("cache").expect("a command");
    let help = cache.render_long_help().to_string().replace('\n', " ");
    says(&help, &["same, bit by bit", "--no-cache", "--key", "clear"]);
    for wrong in ["-1", "nan", "soon"] {
        assert!(parsed(&["cache", "--cache-from", wrong]).is_none(), "{wrong}");
    }
}

fn segment(args: &[&str]) -> Option<SegmentArgs> {
    let all = ["segment", "a.png"].iter().chain(args).copied();
    match parsed(&all.collect::<Vec<_>>()) {
        Some(Command::Segment(args)) => Some(args),
        _ => None,
    }
}

#[test]
fn segments_defaults_are_the_papers_and_flags_go_through() {
    let spec = |args: &[&str]| segment(args).expect("legal").colours.spec();
    assert_eq!(spec(&[]).unwrap().colours, ColourSpec::default());
    let haze = spec(&["--give-back", "--dehaze"]).unwrap();
    assert_eq!(haze, VerifierSpec::default());
    let got = spec(&["--epsilon", "60", "--give-back", "--edges", "reference"]).unwrap().colours;
    assert_eq!((got.epsilon.get(), got.give_back, got.edges), (60.0, true, Edges::Reference));
    let said = spec(&["--alpha1", "210"]).unwrap_err();
    assert_eq!(said, "--alpha1 must be below alpha2 (200), got 210");
    for bad in ["0", "-3", "nan", "x"] {
        assert!(segment(&["--epsilon", bad]).is_none(), "{bad}");
    }
}

#[test]
fn a_broken_assumption_is_an_error_to_the_shell() {
    assert_eq!(Exit::guarded(|| Exit::NotFound), Exit::NotFound);
    let broken = Exit::guarded(|| panic!("the hull is {} m long", -1));
    assert_eq!(broken, Exit::Error);
}

#[test]
fn the_version_tells_two_builds_apart() {
    let short = Args::command().render_version();
    assert_eq!(short, concat!("rheotaxis ", env!("CARGO_PKG_VERSION"), "\n"));
    let said = Args::command().render_long_version();
    let lines: Vec<&str> = said.trim_end().lines().collect();
    assert_eq!(lines[0], short.trim_end());
    let value = |name: &str| {
        let found = lines.iter().find_map(|l| l.strip_prefix(name));
        found.unwrap_or_else(|| panic!("no {name} in\n{said}")).trim()
    };
    assert!(value("features:").starts_with("live "), "{said}");
    assert!(value("target:").starts_with(std::env::consts::ARCH), "{said}");
    assert!(["debug", "release"].contains(&value("profile:")), "{said}");
    #[cfg(target_arch = "x86_64")]
    {
        let fast = std::arch::is_x86_feature_detected!("avx2");
        assert_eq!(value("processor:").contains("AVX"), fast, "{said}");
    }
}

#[test]
fn the_list_shows_everything_with_its_source() {
    let said = rheotaxis(&["list"]).with(0).out;
    for entry in sections(&Registry::default()).into_iter().flat_map(|s| s.entries) {
        says(&said, &[entry.name, entry.what, entry.source]);
    }
    for template in CATALOG {
        says(&said, &[template.name]);
    }
}

/// What `list vehicles` prints either has trials, or the error says which name to give instead.
#[test]
fn every_name_that_list_vehicles_prints_is_known() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("hull.svg").display().to_string();
    let mut names: Vec<&str> = (sections(&Registry::default()).into_iter())
        .filter(|s| s.group == Group::Vehicles)
        .flat_map(|s| s.entries.into_iter().map(|e| e.name))
        .collect();
    names.extend(SHIPPED.iter().map(|s| s.folder));
    let mut free = Vec::new();
    for name in names {
        let end = rheotaxis(&["vehicle", "check", name, "--out", &out]);
        if end.code == Some(0) {
            free.push(name);
        } else {
            assert!(!end.err.contains("no such") && end.err.contains("help:"), "{}", end.err);
        }
    }
    let listed = ["Remus100", "Kinematic"].into_iter();
    let all: Vec<&str> = listed.chain(SHIPPED.iter().map(|s| s.folder)).collect();
    assert_eq!(free, all);
    says(&rheotaxis(&["vehicle", "check", "submarine"]).with(1).err, &["no such folder"]);
}
