//! Checks `[dynamics]` and `[[inertial]]` against the robot: names, frames, units.

use congruent_input::{
    Diagnostic, Diagnostics, known_names, line_column,
    units::{Unit, check_finite},
};
use congruent_robot::{DhTable, Joint, JointIndex, Robot};
use nalgebra::{Matrix3, Vector3};
use toml::Spanned;

use super::{
    declared::{DeclaredInertial, DynamicsTable, InertialFrame, InertialPoint},
    written::{WrittenDynamics, WrittenInertial, WrittenTensor, WrittenTerm},
};
use crate::{codes, robot_file::rows::first_line};

/// The robot, its table and the text against which entries are checked.
pub(in crate::robot_file) struct InertialContext<'a> {
    pub(in crate::robot_file) robot: &'a Robot,
    pub(in crate::robot_file) dh: Option<&'a DhTable>,
    pub(in crate::robot_file) text: &'a str,
}

/// The declared dynamics; `None` if nothing is declared or an entry has a fault.
pub(in crate::robot_file) fn check(
    dynamics: Option<&WrittenDynamics>,
    written: &[Spanned<WrittenInertial>],
    context: &InertialContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<DynamicsTable> {
    let gravity = dynamics.and_then(|dynamics| dynamics.gravity_m_s2.as_ref());
    for value in gravity.iter().flat_map(|gravity| gravity.get_ref().map(|value| (value, gravity.span()))) {
        diagnostics.keep(check_finite("gravity_m_s2", value.0, value.1));
    }
    let (mut inertials, mut is_whole) = (Vec::<DeclaredInertial>::with_capacity(written.len()), true);
    for entry in written {
        let Some(inertial) = inertial(entry, context, diagnostics) else {
            is_whole = false;
            continue;
        };
        if let Some(first) = inertials.iter().position(|known| known.joint == inertial.joint) {
            let name = &entry.get_ref().joint;
            let line = line_column(context.text, written[first].span().start).0;
            let message =
                format!("joint \"{}\" already has an [[inertial]] entry, at line {line}", name.get_ref());
            diagnostics.push(Diagnostic::error(codes::robot_file::JOINT_TWICE, message).at(name.span()));
        }
        inertials.push(inertial);
    }
    if !is_whole || (dynamics.is_none() && written.is_empty()) {
        return None;
    }
    Some(DynamicsTable {
        source: dynamics.and_then(|dynamics| dynamics.source.clone()),
        gravity_in_base_m_s2: gravity.map(|gravity| Vector3::from(*gravity.get_ref())),
        inertials,
    })
}

fn inertial(
    written: &Spanned<WrittenInertial>,
    context: &InertialContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<DeclaredInertial> {
    let entry = written.get_ref();
    let at = || first_line(written.span(), context.text);
    let joint = diagnostics.keep(joint(entry, context.robot));
    let about = diagnostics.keep(entry.about.as_ref().map(|about| *about.get_ref()).ok_or_else(|| {
        missing("about", entry).at(at()).with_help(
            "about = \"com\" means an inertia about the centre of mass, about = \"frame\" about the frame's origin; there is no \
             default",
        )
    }));
    let mass_kg = diagnostics.keep(positive("mass_kg", &entry.mass_kg));
    let com = Unit::Length.vector("com", entry.com_m.as_ref(), entry.com_mm.as_ref());
    let com = diagnostics.keep(com.and_then(|com| match (com, entry.about.as_ref(), &entry.inertia_kg_m2) {
        (None, Some(about), Some(_)) if *about.get_ref() == InertialPoint::Frame => {
            Err(missing("com_m or com_mm", entry).at(about.span()).with_help(
                "an inertia about the frame's origin needs the centre of mass; with about = \"com\" the centre of mass may be \
                 left out and is then not compared",
            ))
        }
        (com, ..) => Ok(com.map(Vector3::from)),
    }));
    let tensor = entry.inertia_kg_m2.as_ref().map(|tensor| diagnostics.keep(self::tensor(tensor.get_ref())));
    let frame = diagnostics.keep(entry.frame.as_ref().ok_or_else(|| {
        missing("frame", entry).at(at()).with_help(
            "frame = \"link\" is the frame of the joint's link in the URDF, \"dhN\" that of its row in the table; \
             there is no default",
        )
    }));
    let frame =
        frame.zip(joint).and_then(|(frame, joint)| diagnostics.keep(self::frame(frame, joint, context)));
    let mut term = |term| {
        let joint = context.robot.joint(joint?);
        diagnostics.keep(self::term(entry, term, joint)).flatten()
    };
    let [armature, damping, friction] =
        [WrittenTerm::Armature, WrittenTerm::Damping, WrittenTerm::Friction].map(&mut term);
    Some(DeclaredInertial {
        joint: joint?,
        frame: frame?,
        about: about?,
        mass_kg: mass_kg?,
        com_m: com?,
        tensor_kg_m2: match tensor {
            Some(tensor) => Some(tensor?),
            None => None,
        },
        armature,
        damping,
        friction,
    })
}

fn missing(key: &str, entry: &WrittenInertial) -> Diagnostic {
    let message = format!("[[inertial]] of joint \"{}\" has no {key}", entry.joint.get_ref());
    Diagnostic::error(codes::robot_file::INERTIAL, message)
}

fn joint(entry: &WrittenInertial, robot: &Robot) -> Result<JointIndex, Diagnostic> {
    let name = entry.joint.get_ref();
    let found = robot.find_joint(name);
    found.filter(|&joint| robot.joint(joint).kind.is_movable()).ok_or_else(|| {
        let what =
            if found.is_some() { "is fixed and carries no body of its own" } else { "is not in the robot" };
        Diagnostic::error(codes::robot_file::UNKNOWN_JOINT, format!("joint \"{name}\" {what}"))
            .at(entry.joint.span())
            .with_help(known_names(name, "moving joints", robot.movable_joint_names()))
    })
}

fn positive(key: &str, value: &Spanned<f64>) -> Result<f64, Diagnostic> {
    check_finite(key, *value.get_ref(), value.span())?;
    if *value.get_ref() > 0.0 {
        return Ok(*value.get_ref());
    }
    let message = format!("{key} must be greater than 0, it is {}", value.get_ref());
    Err(Diagnostic::error(codes::robot_file::INERTIAL, message).at(value.span()))
}

/// The frame of an entry by its name; a frame of the table must be the one that moves with the joint.
fn frame(
    written: &Spanned<String>,
    joint: JointIndex,
    context: &InertialContext<'_>,
) -> Result<InertialFrame, Diagnostic> {
    let name = written.get_ref().as_str();
    let refused = |message: String, help: String| {
        Err(Diagnostic::error(codes::robot_file::INERTIAL, message).at(written.span()).with_help(help))
    };
    let joint_name = &context.robot.joint(joint).name;
    let row = context.dh.and_then(|dh| dh.rows.iter().position(|row| row.joint == joint));
    let own = row.map(|row| format!("dh{}", row + 1));
    match (name, row) {
        ("link", _) => Ok(InertialFrame::Link),
        (name, Some(row)) if own.as_deref() == Some(name) => Ok(InertialFrame::Dh(row + 1)),
        (name, _) if name.strip_prefix("dh").is_some_and(|number| number.parse::<usize>().is_ok()) => {
            match &own {
                // A warning instead of an error: the table itself may be wrong, and the check of the geometry, which can
                // find that out, must still run.
                Some(own) => {
                    let message = format!(
                        "frame \"{name}\" is not fixed to the link that joint \"{joint_name}\" moves"
                    );
                    let help = format!(
                        "write frame = \"{own}\", or add the missing [[dh.row]] if there is one; until then no [[inertial]] entry is compared"
                    );
                    let warning = Diagnostic::warning(codes::robot_file::INERTIAL, message).with_help(help);
                    Err(warning.at(written.span()))
                }
                None => refused(
                    format!("frame \"{name}\": the table has no row for joint \"{joint_name}\""),
                    "use frame = \"link\"".to_owned(),
                ),
            }
        }
        (name, _) => {
            let known = std::iter::once("link").chain(own.as_deref());
            refused(format!("unknown frame \"{name}\""), known_names(name, "frames", known))
        }
    }
}

fn tensor(written: &WrittenTensor) -> Result<Matrix3<f64>, Diagnostic> {
    let mut tensor = Matrix3::zeros();
    for (name, (row, column), value) in written.entries() {
        check_finite(name, *value.get_ref(), value.span())?;
        tensor[(row, column)] = *value.get_ref();
        tensor[(column, row)] = *value.get_ref();
    }
    Ok(tensor)
}

/// A term of a joint (armature, damping or friction) from the key that fits the kind of the joint.
fn term(entry: &WrittenInertial, term: WrittenTerm, joint: &Joint) -> Result<Option<f64>, Diagnostic> {
    let [turning, sliding] = entry.term(term);
    let [own, other] = if joint.kind.is_angular() { [turning, sliding] } else { [sliding, turning] };
    if let (key, Some(value)) = other {
        let moves = if joint.kind.is_angular() { "turns" } else { "slides" };
        let message = format!("{key} does not fit joint \"{}\", which {moves}", joint.name);
        return Err(Diagnostic::error(codes::robot_file::INERTIAL, message)
            .at(value.span())
            .with_help(format!("the key for this joint is {}", own.0)));
    }
    let (key, Some(value)) = own else { return Ok(None) };
    check_finite(key, *value.get_ref(), value.span())?;
    if *value.get_ref() < 0.0 {
        let message = format!("{key} must not be negative, it is {}", value.get_ref());
        return Err(Diagnostic::error(codes::robot_file::INERTIAL, message).at(value.span()));
    }
    Ok(Some(*value.get_ref()))
}
