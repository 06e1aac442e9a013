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

// Why values become wrong, and what to try: one text for each family of causes, and below it an example.
macro_rules! advice {
    (UNITS, $example:literal) => {
        concat!(
            "A URDF has kg, m and kg m^2, and CAD programs export g, mm and g mm^2 as well: convert the values.",
            "\n    ",
            $example
        )
    };
    (CENTRE_OF_MASS, $example:literal) => {
        concat!(
            "Compare the centre of mass with the CAD program, in the axes of the link's frame; the left part of a \
             pair is the mirror image of the right one.",
            "\n    ",
            $example
        )
    };
    (INERTIAL_AXES, $example:literal) => {
        concat!(
            "The inertia is given in axes that are turned against the link's frame by rpy in <inertial><origin>: \
             compare rpy with the axes in which the CAD program gives the inertia.",
            "\n    ",
            $example
        )
    };
    (LINK_FRAME, $example:literal) => {
        concat!(
            "Centre of mass and inertia belong to the link's own frame: export them in the coordinate system of \
             the link, not in that of the assembly or of the next joint.",
            "\n    ",
            $example
        )
    };
    (REFERENCE_POINT, $example:literal) => {
        concat!(
            "A URDF has the inertia about the centre of mass. CAD programs give it about the origin of the \
             coordinate system as well: take the other one.",
            "\n    ",
            $example
        )
    };
    (SIGNS, $example:literal) => {
        concat!(
            "A URDF has the entries of the tensor, ixy = -integral of x y. Some CAD programs give the integrals \
             without the minus: change the sign.",
            "\n    ",
            $example
        )
    };
    (ORDER, $example:literal) => {
        concat!(
            "The order in a URDF is ixx, ixy, ixz, iyy, iyz, izz, and CAD programs have others: compare entry by \
             entry.",
            "\n    ",
            $example
        )
    };
    (WHOLE_LINKS, $example:literal) => {
        concat!(
            "Compare which parts belong to which link in the two files; each part counts once.",
            "\n    ",
            $example
        )
    };
    (MISSING, $example:literal) => {
        concat!(
            "A value that is left out counts as 0, and placeholders are not the robot: take mass, centre of mass \
             and inertia from the other file, or from the CAD program.",
            "\n    ",
            $example
        )
    };
    (IMPORTER, $example:literal) => {
        concat!(
            "A physics engine, or another program, omits the inertia of a link that is right in the file: correct \
             its importer, not the file.",
            "\n    ",
            $example
        )
    };
    (VALUES, $example:literal) => {
        concat!(
            "The values differ, for example by another material, another edition of the part, or a typing error: \
             correct the file that is wrong.",
            "\n    ",
            $example
        )
    };
    (PAYLOAD, $example:literal) => {
        concat!(
            "One of the two files has a tool or a load at the tip: declare it in both, or in none of them.",
            "\n    ",
            $example
        )
    };
    (JOINT_TERMS_MISSING, $example:literal) => {
        concat!(
            "<dynamics damping friction> is left out, which counts as 0: copy it from the other file.",
            "\n    ",
            $example
        )
    };
    (JOINT_TERMS, $example:literal) => {
        concat!(
            "damping is in N m s/rad (N s/m of a sliding joint), friction in N m (N): compare both with the \
             identification or the data sheet of the drive.",
            "\n    ",
            $example
        )
    };
    (ARMATURE, $example:literal) => {
        concat!(
            "armature is the inertia of the rotor times the square of the gear ratio, in kg m^2 (kg of a sliding \
             joint): compare it with the data sheet of the drive.",
            "\n    ",
            $example
        )
    };
    (GRAVITY, $example:literal) => {
        concat!(
            "Gravity is along -z of the base, 9.81 m/s^2, unless another is declared: a robot on a wall or a \
             ceiling needs its own.",
            "\n    ",
            $example
        )
    };
    (SEVERAL, $example:literal) => {
        concat!(
            "Correct one value after the other, and check again after each.",
            "\n    ",
            $example
        )
    };
    (UNEXPLAINED, $example:literal) => {
        concat!(
            "Compare <inertial> link by link with the other file; `congruent dynamics --base-parameters` lists \
             what joint torques depend on.",
            "\n    ",
            $example
        )
    };
}

/// Detail of a rotation of an inertial frame that the other file lacks.
pub(crate) const MISSING_THERE: &str = "missing in the other file";

causes! {
    MassUnit = "mass_unit", "the mass is given in another unit", advice!(UNITS, "wrong: <mass value=\"8058\"/>\n    right: <mass value=\"8.058\"/>");
    ComUnit = "com_unit", "the centre of mass is given in another unit", advice!(UNITS, "wrong: <origin xyz=\"-212.5 0 113.36\" .../>\n    right: <origin xyz=\"-0.2125 0 0.11336\" .../>");
    InertiaUnit = "inertia_unit", "the inertia is given in another unit", advice!(UNITS, "wrong: <inertia ixx=\"35549\" ixy=\"-2117\" ixz=\"-4037\" iyy=\"29474\" .../>\n    right: <inertia ixx=\"0.035549\" ixy=\"-0.002117\" ixz=\"-0.004037\" iyy=\"0.029474\" .../>");
    CadUnits = "cad_units", "masses, centres of mass and inertias are in the units of a CAD program", advice!(UNITS, "wrong: <mass value=\"3761\"/> and xyz=\"0 -1.93 -25.61\"\n    right: <mass value=\"3.761\"/> and xyz=\"0 -0.00193 -0.02561\"");
    ComSign = "com_sign", "the centre of mass has a wrong sign", advice!(CENTRE_OF_MASS, "wrong: <origin xyz=\"0.2125 0 0.11336\" .../>\n    right: <origin xyz=\"-0.2125 0 0.11336\" .../>");
    ComAxesSwapped = "com_axes_swapped", "coordinates of the centre of mass are exchanged", advice!(CENTRE_OF_MASS, "wrong: <origin xyz=\"0 -0.2422 0.0265\" .../>\n    right: <origin xyz=\"-0.2422 0 0.0265\" .../>");
    Mirrored = "mirrored", "the inertia is that of the mirrored part", advice!(CENTRE_OF_MASS, "wrong: <origin xyz=\"-0.011953 -0.041065 -0.038437\"/>\n    right: <origin xyz=\"-0.011953 0.041065 -0.038437\"/>");
    RpyMissing = "rpy_missing", "the rotation of the inertial frame is left out", advice!(INERTIAL_AXES, "wrong: <origin xyz=\"-0.2422 0 0.0265\"/>\n    right: <origin xyz=\"-0.2422 0 0.0265\" rpy=\"0 1.5707963267948966 0\"/>");
    RpyInverted = "rpy_inverted", "the rotation of the inertial frame is inverted", advice!(INERTIAL_AXES, "wrong: <origin xyz=\"-0.05317 0.104419 0.027454\" rpy=\"0 0 -0.7854\"/>\n    right: <origin xyz=\"-0.05317 0.104419 0.027454\" rpy=\"0 0 0.7854\"/>");
    RpyTwice = "rpy_twice", "the rotation of the inertial frame is applied twice", advice!(INERTIAL_AXES, "wrong: <origin xyz=\"-0.05317 0.104419 0.027454\" rpy=\"0 0 1.5708\"/>\n    right: <origin xyz=\"-0.05317 0.104419 0.027454\" rpy=\"0 0 0.7854\"/>");
    Rpy = "rpy", "the rotation of the inertial frame is off", advice!(INERTIAL_AXES, "wrong: <origin xyz=\"-0.2422 0 0.0265\" rpy=\"0 1.2 0\"/>\n    right: <origin xyz=\"-0.2422 0 0.0265\" rpy=\"0 1.5707963267948966 0\"/>");
    ComFrame = "com_frame", "the centre of mass is given in another frame", advice!(LINK_FRAME, "wrong: <origin xyz=\"-0.6672 0 0.0265\" .../>\n    right: <origin xyz=\"-0.2422 0 0.0265\" .../>");
    ComAxes = "com_axes", "the centre of mass is given in the axes of another frame", advice!(LINK_FRAME, "wrong: <origin xyz=\"0 0.0018 0.01634\"/>\n    right: <origin xyz=\"0 0.01634 -0.0018\"/>");
    InertialFrame = "inertial_frame", "centre of mass and inertia are given in another frame", advice!(LINK_FRAME, "wrong: <origin xyz=\"0 -0.0979 0.01634\"/> and izz=\"0.0025599\"\n    right: <origin xyz=\"0 0.01634 -0.0018\"/> and izz=\"0.0021942\"");
    InertialAxes = "inertial_axes", "centre of mass and inertia are given in the axes of another frame", advice!(LINK_FRAME, "wrong: <origin xyz=\"0 0.0018 0.01634\"/> and izz=\"0.0025599\"\n    right: <origin xyz=\"0 0.01634 -0.0018\"/> and izz=\"0.0021942\"");
    InertiaAboutOrigin = "inertia_about_origin", "the inertia is given about the link's origin, not about its centre of mass", advice!(REFERENCE_POINT, "wrong: <inertia ixx=\"0.067677\" iyy=\"0.032399\" izz=\"0.077586\" .../>\n    right: <inertia ixx=\"0.025853\" iyy=\"0.019552\" izz=\"0.028323\" .../>");
    ProductsSign = "products_sign", "all products of inertia have the other sign", advice!(SIGNS, "wrong: <inertia ixy=\"0.002117\" ixz=\"0.004037\" iyz=\"-0.000229\" .../>\n    right: <inertia ixy=\"-0.002117\" ixz=\"-0.004037\" iyz=\"0.000229\" .../>");
    ProductSign = "product_sign", "one product of inertia has the other sign", advice!(SIGNS, "wrong: <inertia ixz=\"0.004037\" .../>\n    right: <inertia ixz=\"-0.004037\" .../>");
    MomentSign = "moment_sign", "a moment of inertia has the wrong sign", advice!(SIGNS, "wrong: <inertia iyy=\"-0.029474\" .../>\n    right: <inertia iyy=\"0.029474\" .../>");
    MomentsSwapped = "moments_swapped", "two moments of inertia are exchanged", advice!(ORDER, "wrong: <inertia ixx=\"0.008627\" izz=\"0.035549\" .../>\n    right: <inertia ixx=\"0.035549\" izz=\"0.008627\" .../>");
    ProductsSwapped = "products_swapped", "two products of inertia are exchanged", advice!(ORDER, "wrong: <inertia ixy=\"-0.004037\" ixz=\"-0.002117\" .../>\n    right: <inertia ixy=\"-0.002117\" ixz=\"-0.004037\" .../>");
    InertiaOrder = "inertia_order", "the six numbers of the inertia are in another order", advice!(ORDER, "wrong: <inertia ixx=\"0.035549\" ixy=\"0.029474\" ixz=\"0.008627\" iyy=\"-0.002117\" .../>\n    right: <inertia ixx=\"0.035549\" ixy=\"-0.002117\" ixz=\"-0.004037\" iyy=\"0.029474\" .../>");
    InertiaAxes = "inertia_axes", "the inertia is given in the axes of another frame", advice!(LINK_FRAME, "wrong: <inertia iyy=\"0.008627\" izz=\"0.029474\" .../>\n    right: <inertia iyy=\"0.029474\" izz=\"0.008627\" .../>");
    CountedTwice = "counted_twice", "the inertia of one link is counted twice: that of the other link contains it", advice!(WHOLE_LINKS, "wrong: <mass value=\"1.665\"/> in wrist_2_link\n    right: <mass value=\"1.3\"/> in wrist_2_link");
    InertialsSwapped = "inertials_swapped", "the inertias of two links are exchanged", advice!(WHOLE_LINKS, "wrong: <mass value=\"2.846\"/> in upper_arm_link\n    right: <mass value=\"8.058\"/> in upper_arm_link");
    MassesSwapped = "masses_swapped", "the masses of two links are exchanged", advice!(WHOLE_LINKS, "wrong: <mass value=\"2.846\"/> in upper_arm_link\n    right: <mass value=\"8.058\"/> in upper_arm_link");
    InertialLeftOut = "inertial_left_out", "the inertia of a link is left out", advice!(IMPORTER, "wrong: <link name=\"wrist_3_link\"/> in that program\n    right: <link name=\"wrist_3_link\"> with <mass value=\"0.365\"/>");
    PrincipalAxesMissing = "principal_axes_missing", "principal moments are given without their axes", advice!(INERTIAL_AXES, "wrong: <inertia ixx=\"0.010620\" ixy=\"0\" ixz=\"0\" iyy=\"0.028148\" .../>\n    right: <inertia ixx=\"0.025853\" ixy=\"0.007796\" ixz=\"-0.001332\" iyy=\"0.019552\" .../>");
    InertiaRotation = "inertia_rotation", "the inertia has the right principal moments and wrong axes", advice!(INERTIAL_AXES, "wrong: <inertia ixx=\"0.017845\" ixy=\"0.006863\" iyy=\"0.027560\" .../>\n    right: <inertia ixx=\"0.025853\" ixy=\"0.007796\" iyy=\"0.019552\" .../>");
    ComMissing = "com_missing", "the centre of mass is missing", advice!(MISSING, "wrong: <origin xyz=\"0 0 0\"/>\n    right: <origin xyz=\"0 -0.00193 -0.02561\"/>");
    ProductsMissing = "products_missing", "the products of inertia are missing", advice!(MISSING, "wrong: <inertia ixy=\"0\" ixz=\"0\" iyz=\"0\" .../>\n    right: <inertia ixy=\"-0.002117\" ixz=\"-0.004037\" iyz=\"0.000229\" .../>");
    InertiaPlaceholder = "inertia_placeholder", "the inertia is a placeholder", advice!(MISSING, "wrong: <inertia ixx=\"0.001\" ixy=\"0\" ixz=\"0\" iyy=\"0.001\" .../>\n    right: <inertia ixx=\"0.035549\" ixy=\"-0.002117\" ixz=\"-0.004037\" iyy=\"0.029474\" .../>");
    InertiaMissing = "inertia_missing", "the inertia is missing", advice!(MISSING, "wrong: <inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" .../>\n    right: <inertia ixx=\"0.035549\" ixy=\"-0.002117\" ixz=\"-0.004037\" iyy=\"0.029474\" .../>");
    InertialMissing = "inertial_missing", "the link has no inertia", advice!(MISSING, "wrong: <link name=\"upper_arm_link\"/>\n    right: <link name=\"upper_arm_link\"><inertial> ... <mass value=\"8.058\"/>");
    LinkMissing = "link_missing", "only the other description has this link and its mass", advice!(WHOLE_LINKS, "wrong: a file without <link name=\"gripper\">\n    right: <link name=\"gripper\"> with <mass value=\"0.73\"/>");
    LinkAdded = "link_added", "only this description has this link and its mass", advice!(WHOLE_LINKS, "wrong: <link name=\"gripper\"> with <mass value=\"0.73\"/>\n    right: no such link");
    Mass = "mass", "the mass is off", advice!(VALUES, "wrong: <mass value=\"8.393\"/>\n    right: <mass value=\"8.058\"/>");
    MassScale = "mass_scale", "the masses are wrong by the same factor", advice!(VALUES, "wrong: <mass value=\"4.137\"/>\n    right: <mass value=\"3.761\"/>");
    Density = "density", "mass and inertia are wrong by the same factor", advice!(VALUES, "wrong: <mass value=\"3.4152\"/> and izz=\"0.004914\"\n    right: <mass value=\"2.846\"/> and izz=\"0.004095\"");
    ComEntry = "com_entry", "one coordinate of the centre of mass is off", advice!(VALUES, "wrong: <origin xyz=\"-0.2422 0 0.0365\" .../>\n    right: <origin xyz=\"-0.2422 0 0.0265\" .../>");
    InertiaScale = "inertia_scale", "all entries of the inertia are wrong by the same factor", advice!(VALUES, "wrong: <inertia ixx=\"0.0462137\" iyy=\"0.0383162\" izz=\"0.0112151\" .../>\n    right: <inertia ixx=\"0.035549\" iyy=\"0.029474\" izz=\"0.008627\" .../>");
    InertiaEntry = "inertia_entry", "one entry of the inertia is off", advice!(VALUES, "wrong: <inertia izz=\"0.009627\" .../>\n    right: <inertia izz=\"0.008627\" .../>");
    Com = "com", "the centre of mass is off", advice!(VALUES, "wrong: <origin xyz=\"-0.2322 0.011 0.0365\" .../>\n    right: <origin xyz=\"-0.2422 0 0.0265\" .../>");
    Payload = "payload", "a payload at the tip is missing or too much", advice!(PAYLOAD, "wrong: <mass value=\"1.365\"/>\n    right: <mass value=\"0.365\"/>");
    Inertia = "inertia", "the inertia is off", advice!(VALUES, "wrong: <inertia ixx=\"0.0411\" iyy=\"0.0322\" izz=\"0.0104\" .../>\n    right: <inertia ixx=\"0.035549\" iyy=\"0.029474\" izz=\"0.008627\" .../>");
    Inertial = "inertial", "mass, centre of mass and inertia are off", advice!(VALUES, "wrong: <origin xyz=\"-0.23 0.01 0.03\" .../> and <mass value=\"3.1\"/>\n    right: <origin xyz=\"-0.2422 0 0.0265\" .../> and <mass value=\"2.846\"/>");
    JointTermsMissing = "joint_terms_missing", "damping and dry friction are left out", advice!(JOINT_TERMS_MISSING, "wrong: <dynamics/>\n    right: <dynamics damping=\"0.003\" friction=\"0.2\"/>");
    DampingMissing = "damping_missing", "damping is left out", advice!(JOINT_TERMS_MISSING, "wrong: <dynamics friction=\"0.2\"/>\n    right: <dynamics damping=\"0.003\" friction=\"0.2\"/>");
    FrictionMissing = "friction_missing", "dry friction is left out", advice!(JOINT_TERMS_MISSING, "wrong: <dynamics damping=\"0.003\"/>\n    right: <dynamics damping=\"0.003\" friction=\"0.2\"/>");
    DampingFrictionSwapped = "damping_friction_swapped", "damping and dry friction are exchanged", advice!(JOINT_TERMS, "wrong: <dynamics damping=\"0.2\" friction=\"0.003\"/>\n    right: <dynamics damping=\"0.003\" friction=\"0.2\"/>");
    FrictionAsDamping = "friction_as_damping", "dry friction is given as damping", advice!(JOINT_TERMS, "wrong: <dynamics damping=\"0.2\"/>\n    right: <dynamics friction=\"0.2\"/>");
    DampingDefault = "damping_default", "damping is a default value", advice!(JOINT_TERMS, "wrong: <dynamics damping=\"0.1\" friction=\"0.2\"/>\n    right: <dynamics damping=\"0.003\" friction=\"0.2\"/>");
    DampingUnit = "damping_unit", "damping is given per degree instead of per radian, or the reverse", advice!(JOINT_TERMS, "wrong: <dynamics damping=\"0.00005236\" .../>\n    right: <dynamics damping=\"0.003\" .../>");
    JointsSwapped = "joints_swapped", "damping, dry friction and armature of two joints are exchanged", advice!(JOINT_TERMS, "wrong: joint = \"wrist_2_joint\"\n    right: joint = \"wrist_1_joint\"\n    wrong: <dynamics damping=\"0.005\" friction=\"0.3\"/>\n    right: <dynamics damping=\"0.003\" friction=\"0.2\"/>");
    Damping = "damping", "damping is off", advice!(JOINT_TERMS, "wrong: <dynamics damping=\"0.004\" friction=\"0.2\"/>\n    right: <dynamics damping=\"0.003\" friction=\"0.2\"/>");
    Friction = "friction", "dry friction is off", advice!(JOINT_TERMS, "wrong: <dynamics damping=\"0.003\" friction=\"0.3\"/>\n    right: <dynamics damping=\"0.003\" friction=\"0.2\"/>");
    Armature = "armature", "armature is off", advice!(ARMATURE, "wrong: <joint armature=\"0.00001\" .../>\n    right: <joint armature=\"0.102\" .../>");
    GravitySign = "gravity_sign", "gravity points in the opposite direction", advice!(GRAVITY, "wrong: gravity_m_s2 = [0, 0, 9.81]\n    right: gravity_m_s2 = [0, 0, -9.81]");
    GravityMissing = "gravity_missing", "gravity is left out", advice!(GRAVITY, "wrong: gravity_m_s2 = [0, 0, 0]\n    right: gravity_m_s2 = [0, 0, -9.81]");
    GravityDirection = "gravity_direction", "gravity has another direction", advice!(GRAVITY, "wrong: gravity_m_s2 = [0, -9.81, 0]\n    right: gravity_m_s2 = [0, 0, -9.81]");
    GravityMagnitude = "gravity_magnitude", "gravity has another magnitude", advice!(GRAVITY, "wrong: gravity_m_s2 = [0, 0, -9.80665]\n    right: gravity_m_s2 = [0, 0, -9.81]");
    Several = "several", "several values are wrong", advice!(SEVERAL, "wrong: a_m = 0.425 and d_m = 0.1633\n    right: a_m = -0.425 and d_m = 0.1333\n    wrong: <mass value=\"8.393\"/> and xyz=\"0 0.01634 0.0018\"\n    right: <mass value=\"8.058\"/> and xyz=\"0 0.01634 -0.0018\"");
    #[default]
    Unexplained = "unexplained", "no known cause explains the difference", advice!(UNEXPLAINED, "congruent check robots/ur5e --basics\n    congruent check wrong.urdf --against right.urdf --tip forearm_link");
}
