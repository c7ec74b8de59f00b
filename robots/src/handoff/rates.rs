//! What is asked of a vehicle without dynamics, and how much of it the vehicle can do.

/// The rates that a kinematic vehicle takes for one step, exactly and at once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RateCommand {
    /// Turn rate, clockwise seen from above (to starboard) positive, rad/s.
    pub turn_rad_s: f64,
    /// Upward speed over ground, m/s.
    pub climb_m_s: f64,
    /// Speed ahead, through the water or over ground as the vehicle moves, m/s.
    pub speed_m_s: f64,
}

/// The limits of a kinematic vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateLimits {
    /// Greatest speed ahead, m/s.
    pub speed_m_s: f64,
    /// How tightly it turns.
    pub turn: TurnLimit,
    /// Greatest speed up and down, m/s.
    pub climb_m_s: f64,
    /// Time constant with which heading, speed and height approach what is asked, s; 0 for none.
    pub lag_s: f64,
}

/// How tightly a kinematic vehicle turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TurnLimit {
    /// Greatest turn rate, rad/s, at any speed.
    Rate(f64),
    /// Least turning radius, m, of the path along its own speed.
    Radius(f64),
}

impl TurnLimit {
    /// Greatest turn rate at a speed, rad/s.
    pub fn rate_rad_s(self, speed_m_s: f64) -> f64 {
        match self {
            Self::Rate(rad_s) => rad_s,
            Self::Radius(m) => speed_m_s / m,
        }
    }
}

impl RateLimits {
    /// The nearest rates within the limits.
    pub fn held(&self, asked: &RateCommand) -> RateCommand {
        let speed_m_s = asked.speed_m_s.clamp(0.0, self.speed_m_s);
        let most = self.turn.rate_rad_s(speed_m_s);
        RateCommand {
            turn_rad_s: asked.turn_rad_s.clamp(-most, most),
            climb_m_s: asked.climb_m_s.clamp(-self.climb_m_s, self.climb_m_s),
            speed_m_s,
        }
    }
}
