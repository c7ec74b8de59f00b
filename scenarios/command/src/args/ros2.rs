//! Arguments for ROS 2 that runs take.

/// Whether and where nodes of ROS 2 see a run.
#[derive(Clone, Debug, Default, PartialEq, Eq, clap::Args)]
pub struct Ros2Args {
    /// Show the run to ROS 2 as well: to `ros2 topic`, RViz and any node with RMW_IMPLEMENTATION=rmw_zenoh_cpp.
    ///
    /// Odometry, tf, clock, readings, plume, bed and obstacles become topics of a node `rheotaxis`; `rheotaxis topics
    /// --ros2` lists them. ROS need not be installed here. Nodes expect a zenoh router at tcp/localhost:7447: this run
    /// is it, or joins the one that is there. With --zenoh-listen or --zenoh-config, tell the nodes where it is:
    /// ZENOH_CONFIG_OVERRIDE='connect/endpoints=["tcp/HOST:PORT"]'. Use --speed realtime unless your nodes follow
    /// /clock at any rate, and one scenario at a time.
    #[arg(long, conflicts_with = "no_zenoh")]
    pub ros2: bool,
    /// Domain of ROS 2.
    #[arg(
        long = "ros-domain",
        value_name = "ID",
        env = "ROS_DOMAIN_ID",
        default_value_t = 0,
        value_parser = clap::value_parser!(u32).range(0..=232)
    )]
    pub domain: u32,
}
