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
