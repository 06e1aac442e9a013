//! The grammar of URDF as tables: which elements and attributes there are, which of them must be
//! there, and what an attribute holds. `check.rs` reads documents against it.
//!
//! Source: the XML reference of URDF (wiki.ros.org/urdf/XML) and the schema of urdfdom, up to
//! version 1.2. Required is what `urdf-rs` cannot do without.

use AttributeValue::{Name, Numbers, Text, Word};
use Needed::{AsItsParent, For};
use congruent_input::Capability;

/// The use of the robot that needs an element or an attribute: a fault in it blocks that use and no other.
#[derive(Clone, Copy)]
pub(super) enum Needed {
    /// Needed for the same use as the element around it.
    AsItsParent,
    /// Needed for this use; `None` if no use needs it.
    For(Option<Capability>),
}

/// An element with the attributes and children that it may have.
pub(super) struct Element {
    pub(super) name: &'static str,
    pub(super) needed: Needed,
    pub(super) attributes: &'static [Attribute],
    pub(super) children: &'static [Child],
    /// Whether exactly one of the children must be there and no other element may.
    pub(super) is_choice: bool,
}

/// An attribute of an element.
pub(super) struct Attribute {
    pub(super) name: &'static str,
    pub(super) value: AttributeValue,
    pub(super) is_required: bool,
    pub(super) needed: Needed,
}

/// The kind of value that an attribute must have.
pub(super) enum AttributeValue {
    /// Any text, or none.
    Text,
    /// A name: text that is not empty.
    Name,
    /// This many numbers.
    Numbers(usize),
    /// One of these words.
    Word(&'static [&'static str]),
}

/// An element inside another.
pub(super) struct Child {
    pub(super) element: &'static Element,
    pub(super) occurs: Occurs,
}

/// How often a child occurs.
#[derive(PartialEq)]
pub(super) enum Occurs {
    Once,
    AtMostOnce,
    AnyNumber,
}

const fn element(
    name: &'static str,
    attributes: &'static [Attribute],
    children: &'static [Child],
) -> Element {
    Element { name, needed: AsItsParent, attributes, children, is_choice: false }
}

impl Element {
    const fn needed_for(self, needed: Option<Capability>) -> Self {
        Self { needed: For(needed), ..self }
    }
}

impl Attribute {
    const fn needed_for(self, needed: Option<Capability>) -> Self {
        Self { needed: For(needed), ..self }
    }
}

const fn required(name: &'static str, value: AttributeValue) -> Attribute {
    Attribute { name, value, is_required: true, needed: AsItsParent }
}

const fn optional(name: &'static str, value: AttributeValue) -> Attribute {
    Attribute { name, value, is_required: false, needed: AsItsParent }
}

const fn once(element: &'static Element) -> Child {
    Child { element, occurs: Occurs::Once }
}

const fn at_most_once(element: &'static Element) -> Child {
    Child { element, occurs: Occurs::AtMostOnce }
}

const fn any_number(element: &'static Element) -> Child {
    Child { element, occurs: Occurs::AnyNumber }
}

const NUMBER: AttributeValue = Numbers(1);

/// The types that a joint may have; which of them can be simulated is decided in `joint.rs`.
const JOINT_TYPES: &[&str] =
    &["revolute", "continuous", "prismatic", "fixed", "floating", "planar", "spherical"];

/// The root element, and with it the whole document.
pub(super) static ROBOT: Element = element(
    "robot",
    &[optional("name", Text), optional("version", Text)],
    &[any_number(&LINK), any_number(&JOINT), any_number(&MATERIAL)],
);

static LINK: Element = element(
    "link",
    &[required("name", Name), optional("type", Text)],
    &[at_most_once(&INERTIAL), any_number(&VISUAL), any_number(&COLLISION)],
);

static INERTIAL: Element = element("inertial", &[], &[at_most_once(&ORIGIN), once(&MASS), once(&INERTIA)])
    .needed_for(Some(Capability::Physics));

static MASS: Element = element("mass", &[required("value", NUMBER)], &[]);

static INERTIA: Element = element(
    "inertia",
    &[
        required("ixx", NUMBER),
        required("ixy", NUMBER),
        required("ixz", NUMBER),
        required("iyy", NUMBER),
        required("iyz", NUMBER),
        required("izz", NUMBER),
    ],
    &[],
);

static ORIGIN: Element = element(
    "origin",
    &[optional("xyz", Numbers(3)), optional("rpy", Numbers(3)), optional("quat_xyzw", Numbers(4))],
    &[],
);

static VISUAL: Element = element(
    "visual",
    &[optional("name", Text)],
    &[at_most_once(&ORIGIN), once(&GEOMETRY), at_most_once(&MATERIAL)],
)
.needed_for(None);

static COLLISION: Element = element(
    "collision",
    &[optional("name", Text)],
    // urdf-rs does not read a collision's material, so nothing in it is checked.
    &[at_most_once(&ORIGIN), once(&GEOMETRY), any_number(&UNREAD_MATERIAL)],
)
.needed_for(Some(Capability::Clearance));

static GEOMETRY: Element = Element {
    name: "geometry",
    needed: AsItsParent,
    attributes: &[],
    children: &[
        at_most_once(&BOX),
        at_most_once(&CYLINDER),
        at_most_once(&SPHERE),
        at_most_once(&MESH),
        at_most_once(&CAPSULE),
    ],
    is_choice: true,
};

static BOX: Element = element("box", &[required("size", Numbers(3))], &[]);

static CYLINDER: Element =
    element("cylinder", &[required("radius", NUMBER), required("length", NUMBER)], &[]);

static CAPSULE: Element = element("capsule", &[required("radius", NUMBER), required("length", NUMBER)], &[]);

static SPHERE: Element = element("sphere", &[required("radius", NUMBER)], &[]);

static MESH: Element = element("mesh", &[required("filename", Name), optional("scale", Numbers(3))], &[]);

static MATERIAL: Element =
    element("material", &[required("name", Text)], &[at_most_once(&COLOR), at_most_once(&TEXTURE)])
        .needed_for(None);

static UNREAD_MATERIAL: Element = element("material", &[], &[]);

static COLOR: Element = element("color", &[required("rgba", Numbers(4))], &[]).needed_for(None);

static TEXTURE: Element = element("texture", &[required("filename", Text)], &[]).needed_for(None);

static JOINT: Element = element(
    "joint",
    &[required("name", Name), required("type", Word(JOINT_TYPES))],
    &[
        at_most_once(&ORIGIN),
        once(&PARENT),
        once(&CHILD),
        at_most_once(&AXIS),
        at_most_once(&LIMIT),
        at_most_once(&DYNAMICS),
        at_most_once(&MIMIC),
        at_most_once(&CALIBRATION),
        at_most_once(&SAFETY_CONTROLLER),
    ],
);

static PARENT: Element = element("parent", &[required("link", Name)], &[]);

static CHILD: Element = element("child", &[required("link", Name)], &[]);

static AXIS: Element = element("axis", &[required("xyz", Numbers(3))], &[]);

static LIMIT: Element = element(
    "limit",
    &[
        optional("lower", NUMBER),
        optional("upper", NUMBER),
        optional("effort", NUMBER).needed_for(Some(Capability::Physics)),
        optional("velocity", NUMBER).needed_for(Some(Capability::Physics)),
        optional("acceleration", NUMBER).needed_for(None),
        optional("deceleration", NUMBER).needed_for(None),
        optional("jerk", NUMBER).needed_for(None),
    ],
    &[],
);

static DYNAMICS: Element =
    element("dynamics", &[optional("damping", NUMBER), optional("friction", NUMBER)], &[])
        .needed_for(Some(Capability::Physics));

static MIMIC: Element = element(
    "mimic",
    &[required("joint", Name), optional("multiplier", NUMBER), optional("offset", NUMBER)],
    &[],
);

static CALIBRATION: Element = element(
    "calibration",
    &[optional("rising", NUMBER), optional("falling", NUMBER), optional("reference_position", NUMBER)],
    &[],
)
.needed_for(None);

static SAFETY_CONTROLLER: Element = element(
    "safety_controller",
    &[
        required("k_velocity", NUMBER),
        optional("k_position", NUMBER),
        optional("soft_lower_limit", NUMBER),
        optional("soft_upper_limit", NUMBER),
    ],
    &[],
)
.needed_for(None);
