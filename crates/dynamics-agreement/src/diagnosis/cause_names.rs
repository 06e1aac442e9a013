//! The names of causes, in the order of the catalogue: of two causes with the same complexity the earlier one is named.

use serde::Serialize;

/// Declares [`DynamicsCause`] with the name, the sentence and the advice of each variant beside it.
macro_rules! causes {
    ($($(#[$attribute:meta])* $variant:ident = $name:literal, $text:literal, $advice:expr;)*) => {
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

            /// Why values become wrong like this, and what to try.
            pub fn advice(self) -> &'static str {
                match self {
                    $(Self::$variant => $advice,)*
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

// Why values become wrong, and what to try: one text for each family of causes.
const UNITS: &str =
    "A URDF has kg, m and kg m^2, and CAD programs export g, mm and g mm^2 as well: convert the values.";
const CENTRE_OF_MASS: &str = "Compare the centre of mass with the CAD program, in the axes of the link's frame; the left part of a pair \
    is the mirror image of the right one.";
const INERTIAL_AXES: &str = "The inertia is given in axes that are turned against the link's frame by rpy in <inertial><origin>: \
    compare rpy with the axes in which the CAD program gives the inertia.";
const LINK_FRAME: &str = "Centre of mass and inertia belong to the link's own frame: export them in the coordinate system of the \
    link, not in that of the assembly or of the next joint.";
const REFERENCE_POINT: &str = "A URDF has the inertia about the centre of mass. CAD programs give it about the origin of the \
    coordinate system as well: take the other one.";
const SIGNS: &str = "A URDF has the entries of the tensor, ixy = -integral of x y. Some CAD programs give the integrals \
    without the minus: change the sign.";
const ORDER: &str = "The order in a URDF is ixx, ixy, ixz, iyy, iyz, izz, and CAD programs have others: compare entry by entry.";
const WHOLE_LINKS: &str = "Compare which parts belong to which link in the two files; each part counts once.";
const MISSING: &str = "A value that is left out counts as 0, and placeholders are not the robot: take mass, centre of mass and \
    inertia from the other file, or from the CAD program.";
const VALUES: &str = "The values differ, for example by another material, another edition of the part, or a typing error: \
    correct the file that is wrong.";
const PAYLOAD: &str =
    "One of the two files has a tool or a load at the tip: declare it in both, or in none of them.";
const JOINT_TERMS_MISSING: &str =
    "<dynamics damping friction> is left out, which counts as 0: copy it from the other file.";
const JOINT_TERMS: &str = "damping is in N m s/rad (N s/m of a sliding joint), friction in N m (N): compare both with the \
    identification or the data sheet of the drive.";
const GRAVITY: &str = "Gravity is along -z of the base, 9.81 m/s^2, unless another is declared: a robot on a wall or a \
    ceiling needs its own.";
const SEVERAL: &str = "Correct one value after the other, and check again after each.";
const UNEXPLAINED: &str = "Compare <inertial> link by link with the other file; `congruent dynamics --base-parameters` lists what joint \
    torques depend on.";

/// Detail of a rotation of an inertial frame that the other file lacks.
pub(crate) const MISSING_THERE: &str = "missing in the other file";

causes! {
    MassUnit = "mass_unit", "the mass is given in another unit", UNITS;
    ComUnit = "com_unit", "the centre of mass is given in another unit", UNITS;
    InertiaUnit = "inertia_unit", "the inertia is given in another unit", UNITS;
    CadUnits = "cad_units", "masses, centres of mass and inertias are in the units of a CAD program", UNITS;
    ComSign = "com_sign", "the centre of mass has a wrong sign", CENTRE_OF_MASS;
    ComAxesSwapped = "com_axes_swapped", "coordinates of the centre of mass are exchanged", CENTRE_OF_MASS;
    Mirrored = "mirrored", "the inertia is that of the mirrored part", CENTRE_OF_MASS;
    RpyMissing = "rpy_missing", "the rotation of the inertial frame is left out", INERTIAL_AXES;
    RpyInverted = "rpy_inverted", "the rotation of the inertial frame is inverted", INERTIAL_AXES;
    RpyTwice = "rpy_twice", "the rotation of the inertial frame is applied twice", INERTIAL_AXES;
    Rpy = "rpy", "the rotation of the inertial frame is off", INERTIAL_AXES;
    ComFrame = "com_frame", "the centre of mass is given in another frame", LINK_FRAME;
    ComAxes = "com_axes", "the centre of mass is given in the axes of another frame", LINK_FRAME;
    InertialFrame = "inertial_frame", "centre of mass and inertia are given in another frame", LINK_FRAME;
    InertialAxes = "inertial_axes", "centre of mass and inertia are given in the axes of another frame", LINK_FRAME;
    InertiaAboutOrigin = "inertia_about_origin", "the inertia is given about the link's origin, not about its centre of mass", REFERENCE_POINT;
    ProductsSign = "products_sign", "all products of inertia have the other sign", SIGNS;
    ProductSign = "product_sign", "one product of inertia has the other sign", SIGNS;
    MomentSign = "moment_sign", "a moment of inertia has the wrong sign", SIGNS;
    MomentsSwapped = "moments_swapped", "two moments of inertia are exchanged", ORDER;
    ProductsSwapped = "products_swapped", "two products of inertia are exchanged", ORDER;
    InertiaOrder = "inertia_order", "the six numbers of the inertia are in another order", ORDER;
    InertiaAxes = "inertia_axes", "the inertia is given in the axes of another frame", LINK_FRAME;
    CountedTwice = "counted_twice", "the inertia of one link is counted twice: that of the other link contains it", WHOLE_LINKS;
    InertialsSwapped = "inertials_swapped", "the inertias of two links are exchanged", WHOLE_LINKS;
    MassesSwapped = "masses_swapped", "the masses of two links are exchanged", WHOLE_LINKS;
    InertialLeftOut = "inertial_left_out", "the inertia of a link is left out", MISSING;
    PrincipalAxesMissing = "principal_axes_missing", "principal moments are given without their axes", INERTIAL_AXES;
    InertiaRotation = "inertia_rotation", "the inertia has the right principal moments and wrong axes", INERTIAL_AXES;
    ComMissing = "com_missing", "the centre of mass is missing", MISSING;
    ProductsMissing = "products_missing", "the products of inertia are missing", MISSING;
    InertiaPlaceholder = "inertia_placeholder", "the inertia is a placeholder", MISSING;
    InertiaMissing = "inertia_missing", "the inertia is missing", MISSING;
    InertialMissing = "inertial_missing", "the link has no inertia", MISSING;
    LinkMissing = "link_missing", "only the other description has this link and its mass", WHOLE_LINKS;
    LinkAdded = "link_added", "only this description has this link and its mass", WHOLE_LINKS;
    Mass = "mass", "the mass is off", VALUES;
    MassScale = "mass_scale", "the masses are wrong by the same factor", VALUES;
    Density = "density", "mass and inertia are wrong by the same factor", VALUES;
    ComEntry = "com_entry", "one coordinate of the centre of mass is off", VALUES;
    InertiaScale = "inertia_scale", "all entries of the inertia are wrong by the same factor", VALUES;
    InertiaEntry = "inertia_entry", "one entry of the inertia is off", VALUES;
    Com = "com", "the centre of mass is off", VALUES;
    Payload = "payload", "a payload at the tip is missing or too much", PAYLOAD;
    Inertia = "inertia", "the inertia is off", VALUES;
    Inertial = "inertial", "mass, centre of mass and inertia are off", VALUES;
    JointTermsMissing = "joint_terms_missing", "damping and dry friction are left out", JOINT_TERMS_MISSING;
    DampingMissing = "damping_missing", "damping is left out", JOINT_TERMS_MISSING;
    FrictionMissing = "friction_missing", "dry friction is left out", JOINT_TERMS_MISSING;
    DampingFrictionSwapped = "damping_friction_swapped", "damping and dry friction are exchanged", JOINT_TERMS;
    FrictionAsDamping = "friction_as_damping", "dry friction is given as damping", JOINT_TERMS;
    DampingDefault = "damping_default", "damping is a default value", JOINT_TERMS;
    DampingUnit = "damping_unit", "damping is given per degree instead of per radian, or the reverse", JOINT_TERMS;
    JointsSwapped = "joints_swapped", "damping, dry friction and armature of two joints are exchanged", JOINT_TERMS;
    Damping = "damping", "damping is off", JOINT_TERMS;
    Friction = "friction", "dry friction is off", JOINT_TERMS;
    Armature = "armature", "armature is off", JOINT_TERMS;
    GravitySign = "gravity_sign", "gravity points in the opposite direction", GRAVITY;
    GravityMissing = "gravity_missing", "gravity is left out", GRAVITY;
    GravityDirection = "gravity_direction", "gravity has another direction", GRAVITY;
    GravityMagnitude = "gravity_magnitude", "gravity has another magnitude", GRAVITY;
    Several = "several", "several values are wrong", SEVERAL;
    #[default]
    Unexplained = "unexplained", "no known cause explains the difference", UNEXPLAINED;
}
