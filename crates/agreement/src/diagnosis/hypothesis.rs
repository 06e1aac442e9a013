//! A hypothesis about what is wrong: what to change in the candidate or in the reference, and which
//! numbers to leave free. The catalogue of them is `cause/`.

use std::fmt;

use super::{
    candidate::{Candidate, DhEntry, ModelParameter},
    reference_model::ReferenceModel,
};

/// What can be wrong, by its stable name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// A joint turns the other way.
    AxisFlipped,
    /// The table is read under the other convention.
    ConventionSwapped,
    /// Two joints' rows or names are exchanged.
    JointsSwapped,
    /// An angle in degrees was read as radians.
    DegreesAsRadians,
    /// An angle in radians was read as degrees.
    RadiansAsDegrees,
    /// A length is off by the factor between millimetres and metres.
    MillimetresAsMetres,
    /// Two entries stand in each other's place.
    ParametersExchanged,
    /// Roll, pitch and yaw in another order.
    RpyOrder,
    /// The model leaves out a fixed joint of the reference.
    FixedJointDropped,
    /// A joint's zero is elsewhere.
    ZeroOffset,
    /// The declared transform behind the table.
    Tool,
    /// The declared transform before the table.
    Base,
    /// One entry of one row, or angles that the reference writes with too few digits.
    Parameter,
    /// A joint moves more or less than its variable says.
    Ratio,
    /// Several of these together.
    Several,
    /// None of these.
    Unexplained,
}

impl Cause {
    /// The name that programs read.
    pub fn name(self) -> &'static str {
        match self {
            Self::AxisFlipped => "axis_flipped",
            Self::ConventionSwapped => "convention_swapped",
            Self::JointsSwapped => "joints_swapped",
            Self::DegreesAsRadians => "degrees_as_radians",
            Self::RadiansAsDegrees => "radians_as_degrees",
            Self::MillimetresAsMetres => "millimetres_as_metres",
            Self::ParametersExchanged => "parameters_exchanged",
            Self::RpyOrder => "rpy_order",
            Self::FixedJointDropped => "fixed_joint_dropped",
            Self::ZeroOffset => "zero_offset",
            Self::Tool => "tool",
            Self::Base => "base",
            Self::Parameter => "parameter",
            Self::Ratio => "ratio",
            Self::Several => "several",
            Self::Unexplained => "unexplained",
        }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Where in the two models a cause lies.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// The table as a whole.
    Model,
    /// Rows of the candidate, by number from 0.
    Rows(Vec<usize>),
    /// One entry of some rows.
    Entries(DhEntry, Vec<usize>),
    /// All entries of a kind: a column, lengths, angles.
    Column(Vec<DhEntry>),
    /// The declared transform before the rows.
    Base,
    /// The declared transform after the rows.
    Tool,
    /// Joints of the reference, by their number in it, fixed ones included.
    ReferenceJoints(Vec<usize>),
}

/// Both models, as hypotheses change them.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelPair {
    /// The model under suspicion.
    pub candidate: Candidate,
    /// What it is held against.
    pub reference: ReferenceModel,
}

/// One way in which the candidate may be wrong.
pub(super) struct Hypothesis {
    pub(super) cause: Cause,
    pub(super) place: Place,
    /// What is undone before anything is fitted.
    pub(super) edit: Option<Edit>,
    /// The numbers that are fitted.
    pub(super) free: Vec<ModelParameter>,
}

/// A change to the models.
pub(super) type Edit = Box<dyn Fn(&mut ModelPair) + Send + Sync>;

impl Hypothesis {
    /// A change without a free number.
    pub(super) fn edit(
        cause: Cause,
        place: Place,
        edit: impl Fn(&mut ModelPair) + Send + Sync + 'static,
    ) -> Self {
        Self { cause, place, edit: Some(Box::new(edit)), free: Vec::new() }
    }

    /// Free numbers and no other change.
    pub(super) fn fit(cause: Cause, place: Place, free: Vec<ModelParameter>) -> Self {
        Self { cause, place, edit: None, free }
    }

    /// Undoes what the hypothesis says went wrong, except for its free numbers.
    pub(super) fn apply(&self, models: &mut ModelPair) {
        if let Some(edit) = &self.edit {
            edit(models);
        }
    }
}
