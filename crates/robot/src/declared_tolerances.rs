//! Tolerances of the parameters of a robot: how far each value may be from what is written.

/// How an error is distributed within its tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ErrorDistribution {
    /// Each error within the tolerance is as likely as any other, and none is larger.
    #[default]
    Uniform,
    /// Normal: the tolerance is this number of standard deviations.
    Normal {
        /// Standard deviations of a tolerance, above 0.
        sigmas: f64,
    },
}

impl ErrorDistribution {
    /// The standard deviation of an error with this tolerance, in its unit.
    pub fn standard_deviation(self, tolerance: f64) -> f64 {
        match self {
            // The variance of a uniform distribution of half width h is h^2 / 3.
            Self::Uniform => tolerance / 3_f64.sqrt(),
            Self::Normal { sigmas } => tolerance / sigmas,
        }
    }
}

/// Half widths: a value is within so much of what is written. What is `None` is exact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ParameterTolerances {
    /// Link length a of a row.
    pub a_m: Option<f64>,
    /// Link offset d of a row.
    pub d_m: Option<f64>,
    /// Link twist alpha of a row.
    pub alpha_rad: Option<f64>,
    /// Joint angle theta of a row.
    pub theta_rad: Option<f64>,
    /// Zero of a joint that turns: encoder and backlash.
    pub zero_rad: Option<f64>,
    /// Zero of a joint that slides.
    pub zero_m: Option<f64>,
    /// Each coordinate of a joint's origin, of a robot without a table.
    pub xyz_m: Option<f64>,
    /// Each of three turns of a joint's frame, of a robot without a table.
    pub rpy_rad: Option<f64>,
}

impl ParameterTolerances {
    /// These, with those of `general` where nothing is given.
    #[must_use]
    pub fn or(self, general: Self) -> Self {
        Self {
            a_m: self.a_m.or(general.a_m),
            d_m: self.d_m.or(general.d_m),
            alpha_rad: self.alpha_rad.or(general.alpha_rad),
            theta_rad: self.theta_rad.or(general.theta_rad),
            zero_rad: self.zero_rad.or(general.zero_rad),
            zero_m: self.zero_m.or(general.zero_m),
            xyz_m: self.xyz_m.or(general.xyz_m),
            rpy_rad: self.rpy_rad.or(general.rpy_rad),
        }
    }
}

/// Tolerances of a pose: of each of its coordinates, and of each of three turns about its axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrameTolerances {
    /// Of x, y and z.
    pub position_m: Option<f64>,
    /// Of the turns about x, y and z.
    pub orientation_rad: Option<f64>,
}

/// Tolerances of one joint and its row.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTolerances {
    /// Name of the joint.
    pub joint: String,
    /// What replaces the general tolerances.
    pub tolerances: ParameterTolerances,
}

/// All tolerances of a robot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DeclaredTolerances {
    /// Those of every row and joint.
    pub general: ParameterTolerances,
    /// Other ones of single joints.
    pub rows: Vec<JointTolerances>,
    /// Of the base of the chain.
    pub base: FrameTolerances,
    /// Of the tool centre point in the last link.
    pub tcp: FrameTolerances,
    /// How each error is distributed.
    pub distribution: ErrorDistribution,
}

impl DeclaredTolerances {
    /// The tolerances of a joint and its row.
    pub fn of_joint(&self, joint: &str) -> ParameterTolerances {
        let own = self.rows.iter().rev().find(|row| row.joint == joint);
        own.map_or(self.general, |row| row.tolerances.or(self.general))
    }
}
