//! A hypothesis about a fault: a change to the candidate or to the reference model, and the parameters to
//! fit. The catalogue of hypotheses is `cause/`.

use std::fmt;

use serde::Serialize;

use super::{
    candidate::{CandidateModel, DhEntry, ModelParameter},
    reference_model::ReferenceModel,
};

/// Declares [`Cause`] with the name, the finding code and the explanation of each variant beside it.
macro_rules! causes {
    ($($(#[$attribute:meta])* $variant:ident = $name:literal, $about:literal;)*) => {
        /// The cause of a difference, in the order in which causes of equal rank are named.
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, serde::Serialize, schemars::JsonSchema,
        )]
        pub enum Cause {
            $($(#[$attribute])* #[serde(rename = $name)] $variant,)*
        }

        impl Cause {
            /// All causes.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// The stable code of a finding with this cause: what is wrong, why, and what to try.
            pub fn code(self) -> &'static congruent_input::Code {
                match self {
                    $(Self::$variant => const {
                        &congruent_input::Code {
                            id: None,
                            name: concat!("check::", $name),
                            about: $about,
                            is_unreadable: false,
                        }
                    },)*
                }
            }
        }
    };
}

causes! {
    /// A joint moves in the opposite direction.
    AxisFlipped = "axis_flipped",
        "The positive direction of the joint in the table is the negative one in the URDF. Of the two, the one that moves as the real robot does is right: change `sign` of the row, or the sign of <axis> in the URDF.\n    wrong: sign = -1\n    right: sign = 1";
    /// The table is read under the other convention.
    ConventionSwapped = "convention_swapped",
        "The values of the table are those of the other DH convention. Standard, Rz Tz Tx Rx, and modified (Craig), Rx Tx Rz Tz, describe different robots with the same numbers, and data sheets often do not say which they use: change `convention`.\n    wrong: convention = \"modified\"\n    right: convention = \"standard\"";
    /// Two joints' rows or names are exchanged.
    JointsSwapped = "joints_swapped",
        "Two rows of the table, or the names of two joints, are exchanged. Rows follow the chain from base to tip: exchange the rows or the names.";
    /// An angle in degrees was read as radians.
    DegreesAsRadians = "degrees_as_radians",
        "Values in degrees are read as radians, so they are 57.3 times too large. Change the key to one that ends in _deg, or convert the values.\n    wrong: alpha_rad = 90.0\n    right: alpha_deg = 90.0";
    /// An angle in radians was read as degrees.
    RadiansAsDegrees = "radians_as_degrees",
        "Values in radians are read as degrees, so they are 57.3 times too small. Change the key to one that ends in _rad, or convert the values.\n    wrong: alpha_deg = 1.5707963267948966\n    right: alpha_deg = 90.0";
    /// A length is off by the factor between millimetres and metres.
    MillimetresAsMetres = "millimetres_as_metres",
        "Lengths are off by a factor of 1000: millimetres under a key that ends in _m, or metres under one that ends in _mm. Change the key or the values.\n    wrong: a_m = -425.0\n    right: a_mm = -425.0";
    /// Two entries are exchanged, or the values of a column are in the rows before or behind their own.
    ParametersExchanged = "parameters_exchanged",
        "Two values or two columns of the table are exchanged, or a column is shifted by one row: data sheets list a and d in different orders, and a modified table has a and alpha one row further down than a standard one. Write each value under its own key, in its own row.\n    wrong: a_m = 0.0997 and d_m = 0.0\n    right: a_m = 0.0 and d_m = 0.0997";
    /// Roll, pitch and yaw are in another order.
    RpyOrder = "rpy_order",
        "Roll, pitch and yaw are in another order. The order here is that of a URDF, turns about the fixed axes x, y, z: R = Rz(yaw) Ry(pitch) Rx(roll). Convert the three angles.\n    wrong: rpy_deg = [50, -35, 20]\n    right: rpy_deg = [20, -35, 50]";
    /// The model lacks a fixed joint of the reference model.
    FixedJointDropped = "fixed_joint_dropped",
        "The table omits a fixed joint of the URDF, such as a flange. Put its <origin> into base_from_dh0 or dhn_from_tip, or declare another base or tip.\n    wrong: dhn_from_tip = {}\n    right: dhn_from_tip = { xyz_m = [0.0, 0.0, 0.107] }";
    /// A joint's zero is shifted.
    ZeroOffset = "zero_offset",
        "The zero of a joint is at another position in the table than in the URDF. Add the difference to theta (to d of a prismatic joint), or correct <origin> of the joint in the URDF.\n    wrong: theta_deg = 0.0\n    right: theta_deg = 90.0";
    /// The declared transform behind the table is off.
    Tool = "tool",
        "The transform behind the last joint is wrong. Of a table correct dhn_from_tip, or declare the tip that the table ends at; of two URDFs or MJCFs correct the frame of the tip in the file that is wrong, or name the link that is the same in both: --tip.\n    wrong: dhn_from_tip = { xyz_m = [0.0, 0.0, 0.112] }\n    right: dhn_from_tip = { xyz_m = [0.0, 0.0, 0.107] }";
    /// The declared transform before the table is off.
    Base = "base",
        "The transform before the first joint is wrong. Of a table correct base_from_dh0, or declare the base that the table begins at; of two URDFs or MJCFs correct the frame of the first joint in the file that is wrong, or, if only the base is placed otherwise, write `base = \"fitted\"` under [mapping] of the robot file.\n    wrong: base_from_dh0 = { xyz_m = [0.005, 0.002, 0.003], rpy_deg = [0, 0, 180] }\n    right: base_from_dh0 = { rpy_deg = [0, 0, 180] }";
    /// One entry of one row is off, or the reference model's file has angles with too few digits.
    Parameter = "parameter",
        "One value differs, for example by a typing error, a missing minus or another edition of the data sheet. Correct it in the file that is wrong; quarter turns need all digits, 1.5707963267948966.\n    wrong: d_m = 0.1633\n    right: d_m = 0.1333";
    /// A joint moves more or less than its variable says.
    Ratio = "ratio",
        "The joint moves more or less than its variable says. Compare the gear ratio and the unit of the joint position in the program that gives the poses. Correct that program, here by the ratio of the gear.\n    wrong: q = counts * 2 * pi / 4096\n    right: q = counts * 2 * pi / (4096 * 101)";
    /// The `<mimic>` of a joint differs between two files, or only one of them has it.
    Mimic = "mimic",
        "The <mimic> of a joint differs between the two URDFs, or only one of them has it. Give both the same joint, multiplier and offset.\n    wrong: <mimic joint=\"panda_finger_joint1\" multiplier=\"2\"/>\n    right: <mimic joint=\"panda_finger_joint1\"/>";
    /// A joint of a URDF has another `<origin>` than in another URDF, or than the table wants.
    JointOrigin = "joint_origin",
        "A joint has another <origin> in one URDF than in the other; or one <origin> of the URDF explains what takes several corrections of the table. Correct xyz or rpy in the file that is wrong.\n    wrong: <origin xyz=\"-0.425 0.004 0.005\"/>\n    right: <origin xyz=\"-0.425 0 0\"/>";
    /// A joint of one URDF has another `<axis>` than in another URDF.
    JointAxis = "joint_axis",
        "A joint has another <axis> in one URDF than in the other. Correct it in the file that is wrong; a reversed axis reverses the motion.\n    wrong: <axis xyz=\"0 1 0\"/>\n    right: <axis xyz=\"0 0 1\"/>";
    /// Several of these together.
    Several = "several",
        "Several causes explain the difference together, the one with the largest effect first. Correct them in this order, and check again after each.";
    /// None of the known causes explains the difference.
    #[default]
    Unexplained = "unexplained",
        "No known cause explains the difference, alone or with others. Compare the table with the data sheet row by row; of two URDFs check a shorter chain with --tip until the two agree.";
}

impl Cause {
    /// Whether values are in a wrong unit, which a known factor corrects.
    pub(crate) fn is_unit(self) -> bool {
        matches!(self, Self::DegreesAsRadians | Self::RadiansAsDegrees | Self::MillimetresAsMetres)
    }
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
    /// Several entries of one row.
    RowEntries(Vec<DhEntry>, usize),
    /// Whole columns of the table.
    Column(Vec<DhEntry>),
    /// Columns in which each value is one row too low or too high.
    ShiftedColumn(Vec<DhEntry>, RowShift),
    /// The declared transform before the rows.
    Base,
    /// The declared transform after the rows.
    Tool,
    /// Joints of the reference model, by their number in it, fixed ones included.
    ReferenceJoints(Vec<usize>),
}

/// Where the values of a column belong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowShift {
    /// Each value belongs one row up, towards the base.
    BelongsUp,
    /// Each value belongs one row down, towards the tip.
    BelongsDown,
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
    /// Whether it is about rounded angles in the reference model's file.
    pub(super) fn is_rounding(&self) -> bool {
        self.cause == Cause::Parameter && matches!(self.place, FaultPlace::ReferenceJoints(_))
    }

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

    /// Whether one value is fitted and nothing else is changed.
    pub(super) fn is_single_value(&self) -> bool {
        self.edit.is_none() && self.free.len() == 1 && self.cause != Cause::Ratio
    }

    /// Whether it is an edit with a value that is neither in the table nor in the reference model, so that it is fitted.
    pub(super) fn is_fitted_edit(&self) -> bool {
        self.edit.is_some() && !self.free.is_empty()
    }

    /// Applies the correction, except for the fit.
    pub(super) fn apply(&self, models: &mut ModelPair) {
        if let Some(edit) = &self.edit {
            edit(models);
        }
    }
}
