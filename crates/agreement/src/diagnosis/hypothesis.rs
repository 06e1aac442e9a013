//! A hypothesis about a fault: a change to the candidate or to the reference model, and the parameters to
//! fit. The catalogue of hypotheses is `cause/`.

use std::fmt;

use serde::Serialize;

use super::{
    candidate::{CandidateModel, DhEntry, ModelParameter},
    reference_model::ReferenceModel,
};

/// Declares [`Cause`] with the name and the finding code of each variant beside it.
macro_rules! causes {
    ($($(#[$attribute:meta])* $variant:ident = $name:literal,)*) => {
        /// The cause of a difference, in the order in which causes of equal rank are named.
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, serde::Serialize, schemars::JsonSchema,
        )]
        pub enum Cause {
            $($(#[$attribute])* #[serde(rename = $name)] $variant,)*
        }

        impl Cause {
            /// The stable code of a finding with this cause.
            pub fn code(self) -> &'static str {
                match self {
                    $(Self::$variant => concat!("check::", $name),)*
                }
            }
        }
    };
}

causes! {
    /// A joint moves in the opposite direction.
    AxisFlipped = "axis_flipped",
    /// The table is read under the other convention.
    ConventionSwapped = "convention_swapped",
    /// Two joints' rows or names are exchanged.
    JointsSwapped = "joints_swapped",
    /// An angle in degrees was read as radians.
    DegreesAsRadians = "degrees_as_radians",
    /// An angle in radians was read as degrees.
    RadiansAsDegrees = "radians_as_degrees",
    /// A length is off by the factor between millimetres and metres.
    MillimetresAsMetres = "millimetres_as_metres",
    /// Two entries are exchanged.
    ParametersExchanged = "parameters_exchanged",
    /// Roll, pitch and yaw are in another order.
    RpyOrder = "rpy_order",
    /// The model lacks a fixed joint of the reference model.
    FixedJointDropped = "fixed_joint_dropped",
    /// A joint's zero is shifted.
    ZeroOffset = "zero_offset",
    /// The declared transform behind the table is off.
    Tool = "tool",
    /// The declared transform before the table is off.
    Base = "base",
    /// One entry of one row is off, or the reference model's file has angles with too few digits.
    Parameter = "parameter",
    /// A joint moves more or less than its variable says.
    Ratio = "ratio",
    /// The `<mimic>` of a joint differs between two files, or only one of them has it.
    Mimic = "mimic",
    /// A joint of one URDF has another `<origin>` than in another URDF.
    JointOrigin = "joint_origin",
    /// A joint of one URDF has another `<axis>` than in another URDF.
    JointAxis = "joint_axis",
    /// Several of these together.
    Several = "several",
    /// None of the known causes explains the difference.
    #[default]
    Unexplained = "unexplained",
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// The place of a fault in the two models.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FaultPlace {
    /// The table as a whole.
    Model,
    /// Rows of the candidate, by number from 0.
    Rows(Vec<usize>),
    /// One entry of some rows.
    Entries(DhEntry, Vec<usize>),
    /// Whole columns of the table.
    Column(Vec<DhEntry>),
    /// The declared transform before the rows.
    Base,
    /// The declared transform after the rows.
    Tool,
    /// Joints of the reference model, by their number in it, fixed ones included.
    ReferenceJoints(Vec<usize>),
}

/// Both models; hypotheses change them.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelPair {
    /// The model whose faults are searched.
    pub candidate: CandidateModel,
    /// The model that counts as correct.
    pub reference: ReferenceModel,
}

/// One possible fault: what is wrong, where, and how it is undone.
pub(super) struct PoseHypothesis {
    pub(super) cause: Cause,
    pub(super) place: FaultPlace,
    /// The correction without free parameters, applied before the fit.
    pub(super) edit: Option<Edit>,
    /// The parameters that are fitted.
    pub(super) free: Vec<ModelParameter>,
}

/// A change to the models.
pub(super) type Edit = Box<dyn Fn(&mut ModelPair) + Send + Sync>;

impl PoseHypothesis {
    /// A correction without free parameters.
    pub(super) fn edit(
        cause: Cause,
        place: FaultPlace,
        edit: impl Fn(&mut ModelPair) + Send + Sync + 'static,
    ) -> Self {
        Self { cause, place, edit: Some(Box::new(edit)), free: Vec::new() }
    }

    /// A correction that is a fit only.
    pub(super) fn fit(cause: Cause, place: FaultPlace, free: Vec<ModelParameter>) -> Self {
        Self { cause, place, edit: None, free }
    }

    /// Applies the correction, except for the fit.
    pub(super) fn apply(&self, models: &mut ModelPair) {
        if let Some(edit) = &self.edit {
            edit(models);
        }
    }
}
