//! The names of causes, in the order of the catalogue: of two causes with the same complexity the earlier one is named.

use serde::Serialize;

/// Declares [`DynamicsCause`] with the name and the sentence of each variant beside it.
macro_rules! causes {
    ($($(#[$attribute:meta])* $variant:ident = $name:literal, $text:literal;)*) => {
        /// The cause of a difference, in the order in which causes of equal complexity are named.
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, schemars::JsonSchema,
        )]
        pub enum DynamicsCause {
            $(#[doc = $text] $(#[$attribute])* #[serde(rename = $name)] $variant,)*
        }

        impl DynamicsCause {
            /// All causes.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// The name in JSON.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// The cause as a sentence about the link, joint or gravity.
            pub fn text(self) -> &'static str {
                match self {
                    $(Self::$variant => $text,)*
                }
            }
        }
    };
}

causes! {
    MassUnit = "mass_unit", "the mass is given in another unit";
    ComUnit = "com_unit", "the centre of mass is given in another unit";
    InertiaUnit = "inertia_unit", "the inertia is given in another unit";
    CadUnits = "cad_units", "masses, centres of mass and inertias are in the units of a CAD program";
    ComSign = "com_sign", "the centre of mass has a wrong sign";
    ComAxesSwapped = "com_axes_swapped", "coordinates of the centre of mass are exchanged";
    Mirrored = "mirrored", "the inertia is that of the mirrored part";
    RpyMissing = "rpy_missing", "the rotation of the inertial frame is left out";
    RpyInverted = "rpy_inverted", "the rotation of the inertial frame is inverted";
    RpyTwice = "rpy_twice", "the rotation of the inertial frame is applied twice";
    Rpy = "rpy", "the rotation of the inertial frame is off";
    ComFrame = "com_frame", "the centre of mass is given in another frame";
    ComAxes = "com_axes", "the centre of mass is given in the axes of another frame";
    InertialFrame = "inertial_frame", "centre of mass and inertia are given in another frame";
    InertialAxes = "inertial_axes", "centre of mass and inertia are given in the axes of another frame";
    InertiaAboutOrigin = "inertia_about_origin", "the inertia is given about the link's origin, not about its centre of mass";
    ProductsSign = "products_sign", "all products of inertia have the other sign";
    ProductSign = "product_sign", "one product of inertia has the other sign";
    MomentSign = "moment_sign", "a moment of inertia has the wrong sign";
    MomentsSwapped = "moments_swapped", "two moments of inertia are exchanged";
    ProductsSwapped = "products_swapped", "two products of inertia are exchanged";
    InertiaOrder = "inertia_order", "the six numbers of the inertia are in another order";
    InertiaAxes = "inertia_axes", "the inertia is given in the axes of another frame";
    CountedTwice = "counted_twice", "the inertia of one link is counted twice: that of the other link contains it";
    InertialsSwapped = "inertials_swapped", "the inertias of two links are exchanged";
    InertialLeftOut = "inertial_left_out", "the inertia of a link is left out";
    InertiaRotation = "inertia_rotation", "the inertia has the right principal moments and wrong axes";
    ComMissing = "com_missing", "the centre of mass is missing";
    ProductsMissing = "products_missing", "the products of inertia are missing";
    PrincipalAxesMissing = "principal_axes_missing", "principal moments are given without their axes";
    InertiaPlaceholder = "inertia_placeholder", "the inertia is a placeholder";
    InertiaMissing = "inertia_missing", "the inertia is missing";
    InertialMissing = "inertial_missing", "the link has no inertia";
    LinkMissing = "link_missing", "only the other description has this link and its mass";
    LinkAdded = "link_added", "only this description has this link and its mass";
    Mass = "mass", "the mass is off";
    MassScale = "mass_scale", "the masses are wrong by the same factor";
    Density = "density", "mass and inertia are wrong by the same factor";
    ComEntry = "com_entry", "one coordinate of the centre of mass is off";
    InertiaScale = "inertia_scale", "all entries of the inertia are wrong by the same factor";
    InertiaEntry = "inertia_entry", "one entry of the inertia is off";
    Com = "com", "the centre of mass is off";
    Payload = "payload", "a payload at the tip is missing or too much";
    Inertia = "inertia", "the inertia is off";
    Inertial = "inertial", "mass, centre of mass and inertia are off";
    JointTermsMissing = "joint_terms_missing", "damping, dry friction and armature are left out";
    DampingMissing = "damping_missing", "damping is left out";
    FrictionMissing = "friction_missing", "dry friction is left out";
    DampingFrictionSwapped = "damping_friction_swapped", "damping and dry friction are exchanged";
    FrictionAsDamping = "friction_as_damping", "dry friction is given as damping";
    DampingDefault = "damping_default", "damping is a default value";
    DampingUnit = "damping_unit", "damping is given per degree instead of per radian, or the reverse";
    JointsSwapped = "joints_swapped", "damping, dry friction and armature of two joints are exchanged";
    Damping = "damping", "damping is off";
    Friction = "friction", "dry friction is off";
    Armature = "armature", "armature is off";
    GravitySign = "gravity_sign", "gravity points in the opposite direction";
    GravityMissing = "gravity_missing", "gravity is left out";
    GravityDirection = "gravity_direction", "gravity has another direction";
    GravityMagnitude = "gravity_magnitude", "gravity has another magnitude";
    Several = "several", "several values are wrong";
    #[default]
    Unexplained = "unexplained", "no known cause explains the difference";
}

impl DynamicsCause {
    /// Why values become wrong like this, and what to try.
    pub fn advice(self) -> &'static str {
        match self {
            Self::MassUnit | Self::ComUnit | Self::InertiaUnit | Self::CadUnits => {
                "A URDF has kg, m and kg m^2, and CAD programs export g, mm and g mm^2 as well: convert the values."
            }
            Self::ComSign | Self::ComAxesSwapped | Self::Mirrored => {
                "Compare the centre of mass with the CAD program, in the axes of the link's frame; the left part of a pair \
                 is the mirror image of the right one."
            }
            Self::RpyMissing
            | Self::RpyInverted
            | Self::RpyTwice
            | Self::Rpy
            | Self::PrincipalAxesMissing
            | Self::InertiaRotation => {
                "The inertia is given in axes that are turned against the link's frame by rpy in <inertial><origin>: \
                 compare rpy with the axes in which the CAD program gives the inertia."
            }
            Self::ComFrame | Self::ComAxes | Self::InertialFrame | Self::InertialAxes | Self::InertiaAxes => {
                "Centre of mass and inertia belong to the link's own frame: export them in the coordinate system of the \
                 link, not in that of the assembly or of the next joint."
            }
            Self::InertiaAboutOrigin => {
                "A URDF has the inertia about the centre of mass. CAD programs give it about the origin of the \
                 coordinate system as well: take the other one."
            }
            Self::ProductsSign | Self::ProductSign | Self::MomentSign => {
                "A URDF has the entries of the tensor, ixy = -integral of x y. Some CAD programs give the integrals \
                 without the minus: change the sign."
            }
            Self::MomentsSwapped | Self::ProductsSwapped | Self::InertiaOrder => {
                "The order in a URDF is ixx, ixy, ixz, iyy, iyz, izz, and CAD programs have others: compare entry by entry."
            }
            Self::CountedTwice | Self::InertialsSwapped | Self::LinkMissing | Self::LinkAdded => {
                "Compare which parts belong to which link in the two files; each part counts once."
            }
            Self::InertialLeftOut
            | Self::InertialMissing
            | Self::ComMissing
            | Self::ProductsMissing
            | Self::InertiaPlaceholder
            | Self::InertiaMissing => {
                "A value that is left out counts as 0, and placeholders are not the robot: take mass, centre of mass and \
                 inertia from the other file, or from the CAD program."
            }
            Self::Mass
            | Self::MassScale
            | Self::Density
            | Self::ComEntry
            | Self::InertiaScale
            | Self::InertiaEntry
            | Self::Com
            | Self::Inertia
            | Self::Inertial => {
                "The values differ, for example by another material, another edition of the part, or a typing error: \
                 correct the file that is wrong."
            }
            Self::Payload => {
                "One of the two files has a tool or a load at the tip: declare it in both, or in none of them."
            }
            Self::JointTermsMissing | Self::DampingMissing | Self::FrictionMissing => {
                "<dynamics damping friction> is left out, which counts as 0: copy it from the other file."
            }
            Self::DampingFrictionSwapped
            | Self::FrictionAsDamping
            | Self::DampingDefault
            | Self::DampingUnit
            | Self::JointsSwapped
            | Self::Damping
            | Self::Friction
            | Self::Armature => {
                "damping is in N m s/rad (N s/m of a sliding joint), friction in N m (N): compare both with the \
                 identification or the data sheet of the drive."
            }
            Self::GravitySign | Self::GravityMissing | Self::GravityDirection | Self::GravityMagnitude => {
                "Gravity is along -z of the base, 9.81 m/s^2, unless another is declared: a robot on a wall or a \
                 ceiling needs its own."
            }
            Self::Several => "Correct one value after the other, and check again after each.",
            Self::Unexplained => {
                "Compare <inertial> link by link with the other file; `congruent derive --base-parameters` lists what joint \
                 torques depend on."
            }
        }
    }
}
