//! The commands in fenced blocks of README and docs, and what holds each of them.

/// What holds a command of the docs.
pub(super) enum Told {
    /// It is run here: exit code, parts of what it says, and files that it leaves.
    Ends { code: i32, says: &'static [&'static str], leaves: &'static [&'static str] },
    /// `.ci/run` runs it, in the line with these words.
    Ci(&'static str),
    /// A test or a script of the workspace does the same: the file, and a part of it.
    In(&'static str, &'static str),
    /// It is not run, and why.
    No(&'static str),
}

use Told::{Ci, Ends, In, No};

/// Those that are run come in the order in which a reader meets them; later ones use what earlier ones left.
pub(super) const COMMANDS: &[(&str, Told)] = &[
    (
        "cargo run --release -- run scenarios/catalog/uniform_channel.ron",
        Ends {
            code: 0,
            says: &["uniform_channel"],
            leaves: &[
                "runs/uniform_channel-1/report.html",
                "runs/uniform_channel-1/summary.json",
                "runs/uniform_channel-1/map.svg",
                "runs/uniform_channel-1/map.png",
                "runs/uniform_channel-1/track.csv",
                "runs/uniform_channel-1/plume.csv",
                "runs/uniform_channel-1/run.mcap",
                "runs/uniform_channel-1/series-auv0.png",
            ],
        },
    ),
    ("rheotaxis campaign run crab_identify --out round1", No("it takes half an hour")),
    (
        "rheotaxis campaign identify round1 --out found1",
        In("scenarios/studies/src/identify/tests.rs", "fn a_folder_gets_tables_a_picture_and_the_next_campaign"),
    ),
    ("rheotaxis campaign run found1/next.ron --out round2", No("it takes a quarter of an hour")),
    (
        "rheotaxis campaign identify round1 round2 --out found",
        In("scenarios/studies/src/identify/tests.rs", "fn a_further_round_takes_fresh_runs_of_what_remains"),
    ),
    ("rheotaxis arena --quick", No("it takes some minutes")),
    (
        "rheotaxis arena --family uniform --searcher surge-cast --searcher infotaxis --seeds 40",
        In("tests/it/campaign/arena.rs", "--seeds 4 --out out"),
    ),
    (
        "rheotaxis list searchers",
        Ends { code: 0, says: &["space-aware infotaxis", "Loisy & Eloy 2022", "tide_waves", "duck_st"], leaves: &[] },
    ),
    (
        "rheotaxis vehicle init lauv my_auv",
        Ends { code: 0, says: &[], leaves: &["my_auv/vehicle.ron", "my_auv/lauv.urdf"] },
    ),
    (
        "rheotaxis vehicle check my_auv --out my_auv.png",
        Ends { code: 0, says: &["no doubts", "hovers no"], leaves: &["my_auv.png"] },
    ),
    (
        "rheotaxis vehicle trials my_auv --out my_auv_trials",
        Ends {
            code: 0,
            says: &["speed", "turning circle", "zigzag", "dive", "stop"],
            leaves: &[
                "my_auv_trials/trials.csv",
                "my_auv_trials/steering.csv",
                "my_auv_trials/trials.svg",
                "my_auv_trials/trials.png",
            ],
        },
    ),
    (
        "rheotaxis campaign plan duck_beta",
        Ends { code: 0, says: &["200 runs", "seeds 1 to 100", "blocks", "the first run took"], leaves: &[] },
    ),
    ("cargo run --release -- run scenarios/catalog/duck_st.ron", Ci("run scenarios/catalog/duck_st.ron")),
    ("cargo test --release", Ci("cargo test --release")),
    (".ci/run", Ci("set -euo pipefail")),
    ("pip install \"./scenarios/python[look]\"", Ci("$wheel[test,look]")),
    ("pip install ./scenarios/python", Ci("$wheel[test,look]")),
    ("pip install -r scenarios/clients/requirements.txt", Ci("-r scenarios/clients/requirements.txt")),
    ("python -m rheotaxis.look runs/duck_st-1", In("scenarios/python/tests/test_look_page.py", "chromium")),
    ("python -m rheotaxis.look", In("scenarios/python/tests/test_look_page.py", "live")),
    ("rheotaxis run duck_st --speed 20 &", No("it takes 90 s at that speed")),
    ("rheotaxis listen clock", In("tests/it/wire/outside/listen.rs", "at(&[\"clock\"])")),
    (
        "rheotaxis listen clock --zenoh-config docs/zenoh/as_user.json5",
        In("tests/it/wire/outside/listen.rs", "docs/zenoh/as_user.json5"),
    ),
    ("cargo run --release -- run duck_external --allow-control &", Ci("run duck_external --allow-control")),
    ("python scenarios/clients/controller.py", Ci("scenarios/clients/controller.py")),
    ("cargo run --release -- rerun runs/duck_external-1", Ci("rerun \"$scratch/external\"")),
    (
        "rheotaxis run duck_external --allow-control --zenoh-config docs/zenoh/users.json5",
        In("tests/it/wire/outside/security.rs", "users.json5"),
    ),
    (
        "python scenarios/clients/subscribe.py docs/zenoh/as_user.json5",
        No("it ends at Ctrl-C; tests/it/wire/outside/security.rs connects with the same file"),
    ),
    (
        "openssl req -x509 -newkey ed25519 -noenc -days 3650 -subj \"/CN=rheotaxis authority\" -keyout authority.key \
         -out authority.pem",
        No("needs OpenSSL 3"),
    ),
    (
        "for name in run pilot watcher; do openssl req -new -newkey ed25519 -noenc -subj \"/CN=$name\" -addext \
         \"subjectAltName=DNS:localhost,IP:127.0.0.1\" -keyout $name.key -out $name.csr openssl x509 -req -in $name.csr \
         -CA authority.pem -CAkey authority.key -CAcreateserial -copy_extensions copy -days 365 -out $name.pem done",
        No("needs OpenSSL 3"),
    ),
    ("chmod 600 *.key", No("only with the certificates above")),
    (
        "rheotaxis run duck_st --speed realtime --ros2",
        No("it takes half an hour at that speed; tests/it/wire/live/ros2.rs"),
    ),
    ("cargo run --release -- run duck_external --ros2 --allow-control", In("tests/it/wire/outside/ros.rs", "cmd")),
    ("export RMW_IMPLEMENTATION=rmw_zenoh_cpp", No("needs ROS")),
    ("ros2 topic list -t", No("needs ROS")),
    ("ros2 topic echo /auv0/odom", No("needs ROS")),
    ("ros2 run rviz2 rviz2 --ros-args -p use_sim_time:=true", No("needs ROS")),
    ("ros2 topic pub -r 10 /auv0/cmd geometry_msgs/msg/TwistStamped \"{twist: {linear: {x: 1.5}}}\"", No("needs ROS")),
    ("rheotaxis reproduce duck_st --seeds 20", No("it takes longer than a minute")),
    ("rheotaxis reproduce duck_st --seeds 100 --first-seed 1001", No("it takes longer than a minute")),
    (
        "rheotaxis reproduce duck_st --keep docs/rows/kept --no-runs",
        Ends { code: 0, says: &["400 runs, seeds 1 to 400", "declared a source"], leaves: &[] },
    ),
    (
        "rheotaxis campaign run duck_beta --out DIR --shard 3/64 --jobs 2 --max-wall 15m",
        In("tests/it/campaign/cut_off.rs", "--max-wall"),
    ),
    ("rheotaxis campaign status DIR", In("tests/it/campaign/seeds.rs", "\"status\"")),
    ("docs/cluster/gnu_parallel.sh duck_beta /shared/beta 64 -j 2", In("tools/check_cluster.sh", "gnu_parallel.sh")),
    ("docs/cluster/gnu_parallel.sh duck_beta /shared/beta 64 --sshloginfile hosts", No("needs other machines")),
    ("#!/bin/sh", No("needs Slurm")),
    (
        "hq submit --array 1-64 --cpus 2 --time-limit 20m --env RHEOTAXIS_SHARDS=64 -- rheotaxis campaign run duck_beta \
         --out /shared/beta --jobs 2 --max-wall 15m --quiet",
        No("needs HyperQueue"),
    ),
    ("pip install ray", No("needs a network")),
    (
        "python docs/cluster/ray_campaign.py duck_beta --out /shared/beta --shards 64 --cpus 2 --address auto",
        In("tools/check_cluster.sh", "ray_campaign.py"),
    ),
    ("sudo apt-get install parallel; pip install ray duckdb polars", No("needs a network")),
    ("cargo build --release && tools/check_cluster.sh", No("needs GNU parallel and Ray")),
];
