//! The robot that a format can hold. What it cannot hold is changed or left out here, each with a warning, so that what is written
//! of it is exact.

use congruent_description::{
    Geometry, Joint, JointKind, JointLimit, JointParts, Link, Mesh, Robot, RobotDescription, Shape,
};
use congruent_input::{
    Code, Diagnostic, Diagnostics,
    display::{counted, position, quantity},
};

use crate::{codes, fit_inertia, format::RobotFormat, links::Parts, mjcf};

/// How far a joint slides for which a URDF must state a range and the source has none, m.
const FARTHEST_SLIDE_M: f64 = 1e6;
/// The largest number of triangles of an STL that MuJoCo 4.0 reads (`user_mesh.cc`).
const MOST_STL_TRIANGLES: usize = 200_000;

/// The robot of a description as the format can hold it.
pub(crate) fn fitted(
    description: &RobotDescription,
    format: RobotFormat,
    diagnostics: &mut Diagnostics,
) -> Result<Robot, Diagnostic> {
    let robot = &description.robot;
    let mut parts = Parts::of_robot(robot);
    if let Some(link) = parts.links.iter().find(|link| link.inertia.is_some_and(|of| of.mass_kg < 0.0)) {
        let message = format!("link \"{}\" has a negative mass, which no body has", link.name);
        return Err(Diagnostic::error(codes::write::MASS, message).with_help("correct it in the source"));
    }
    declared(description, format, diagnostics);
    for link in &mut parts.links {
        shapes(link, format, diagnostics);
    }
    for joint in &mut parts.joints {
        match format {
            RobotFormat::Urdf => joint_of_urdf(joint, diagnostics),
            RobotFormat::Mjcf => joint_of_mjcf(joint, diagnostics),
        }
    }
    if format == RobotFormat::Mjcf {
        mjcf::fit_names(robot, &mut parts, diagnostics);
        fit_inertia::possible(&mut parts.links, diagnostics);
    }
    let made = |parts: Parts| {
        let invalid = |error: congruent_description::RobotError| {
            Diagnostic::error(codes::write::READ_BACK, error.to_string())
        };
        parts.into_robot(robot.name()).map_err(invalid)
    };
    let mut fitted = made(parts)?;
    if format == RobotFormat::Mjcf {
        let mut parts = Parts::of_robot(&fitted);
        fit_inertia::massive(&fitted, &mut parts.links, diagnostics);
        fitted = made(parts)?;
    }
    Ok(fitted)
}

/// What the robot file declares and neither format has a place for.
fn declared(description: &RobotDescription, format: RobotFormat, diagnostics: &mut Diagnostics) {
    let mut stays = Vec::new();
    if description.dh.is_some() {
        stays.push("its table");
    }
    if description.dynamics.is_some() {
        stays.push("its [[inertial]] entries");
    }
    if description.tip_from_tcp.is_some() {
        stays.push("its tool centre point");
    }
    if description.accelerations.iter().any(Option::is_some) {
        stays.push("its accelerations");
    }
    if !stays.is_empty() {
        let message = format!("{} cannot be written as {}", stays.join(", "), format.name());
        let found = Diagnostic::warning(codes::write::DECLARED, message);
        diagnostics.push(
            found.with_help("this stays in the robot file, whose key `description` may name the new file"),
        );
    }
    let pairs = description.disabled_collisions.len();
    if format == RobotFormat::Urdf && pairs > 0 {
        let message = format!("excluded contacts cannot be written as URDF: {}", counted(pairs, "pair"));
        let found = Diagnostic::warning(codes::write::EXCLUDED, message);
        diagnostics.push(found.with_help("an SRDF has them: congruent clearance ROBOT --write-srdf FILE"));
    }
}

/// Leaves out shapes that the format cannot name, and colours that it has no place for.
fn shapes(link: &mut Link, format: RobotFormat, diagnostics: &mut Diagnostics) {
    let name = link.name.clone();
    let mut is_kept = |shape: &Shape| {
        let Some((code, why)) = unwritable(shape, format) else { return true };
        let message = format!("link \"{name}\": {why}, so this shape is left out");
        let kind = format!("shapes are left out: {why}");
        diagnostics.push(Diagnostic::warning(code, message).one_of(kind, &name));
        false
    };
    link.visuals.retain(&mut is_kept);
    link.collisions.retain(&mut is_kept);
    if format == RobotFormat::Urdf && link.collisions.iter().any(|shape| shape.color_rgba.is_some()) {
        link.collisions.iter_mut().for_each(|shape| shape.color_rgba = None);
        let message = format!("link \"{name}\": collision shapes of a URDF have no colour");
        let kind = "links have coloured collision shapes, which have no colour in a URDF";
        diagnostics.push(Diagnostic::warning(codes::write::COLOR, message).one_of(kind, &name));
    }
}

/// Why a shape cannot be written, with the code of the reason; `None` if it can.
fn unwritable(shape: &Shape, format: RobotFormat) -> Option<(&'static Code, String)> {
    match &shape.geometry {
        Geometry::Mesh(mesh) => unwritable_mesh(mesh, format).map(|why| (codes::write::MESH, why)),
        Geometry::Ellipsoid { .. } if format == RobotFormat::Urdf => {
            Some((codes::write::ELLIPSOID, "a URDF has no ellipsoids".to_owned()))
        }
        _ => None,
    }
}

fn unwritable_mesh(mesh: &Mesh, format: RobotFormat) -> Option<String> {
    let has_file = !mesh.path.as_os_str().is_empty();
    if format == RobotFormat::Urdf {
        return (!has_file).then(|| "a URDF has no meshes within its own text".to_owned());
    }
    let ending = mesh.path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    match ending.as_str() {
        _ if !has_file => None,
        "stl" if mesh.triangles.len() > MOST_STL_TRIANGLES => {
            Some(format!("MuJoCo reads at most {MOST_STL_TRIANGLES} triangles of an STL"))
        }
        "stl" | "obj" => None,
        other => Some(format!("MuJoCo reads no meshes of the format .{other}")),
    }
}

/// The warning that a URDF cannot hold the armature of a joint; `None` if the joint has none.
pub fn lost_armature(joint: &Joint) -> Option<Diagnostic> {
    let armature = joint.armature.filter(|armature| *armature != 0.0)?;
    let unit = if joint.kind.is_angular() { "kg m^2" } else { "kg" };
    let armature = quantity(armature, unit);
    let message =
        format!("joint \"{}\": its armature, {armature}, is not written: a URDF has none", joint.name);
    let kind = "joints have an armature, which a URDF cannot hold";
    let found = Diagnostic::warning(codes::write::ARMATURE, message).one_of(kind, &joint.name);
    Some(found.with_help("keep it in a scenario: [joints] armature = { JOINT = VALUE }"))
}

/// Terms, ranges and limits as a URDF has them.
fn joint_of_urdf(parts: &mut JointParts, diagnostics: &mut Diagnostics) {
    let joint = &mut parts.joint;
    diagnostics.extend(lost_armature(joint));
    joint.armature = None;
    if joint.kind == JointKind::Prismatic && joint.limit.is_none() {
        let (lower, upper) = (-FARTHEST_SLIDE_M, FARTHEST_SLIDE_M);
        joint.limit = Some(JointLimit { lower, upper, ..JointLimit::default() });
        let message = format!(
            "joint \"{}\" slides without a range, which a URDF must state: {lower} to {upper} m is written",
            joint.name
        );
        let kind =
            "joints slide without a range, which a URDF must state: 1e6 m in both directions are written";
        diagnostics.push(Diagnostic::warning(codes::write::RANGE, message).one_of(kind, &joint.name));
    }
    let Some(limit) = joint.limit.filter(|_| joint.kind.is_movable()) else { return };
    let missing: Vec<&str> = [("velocity", limit.velocity), ("effort", limit.effort)]
        .into_iter()
        .filter_map(|(key, value)| value.is_none().then_some(key))
        .collect();
    if !missing.is_empty() && joint.kind != JointKind::Continuous {
        let missing = missing.join(" and no largest ");
        let message =
            format!("joint \"{}\" has no largest {missing}, without which ROS refuses its limit", joint.name);
        let kind = format!("joints have no largest {missing}, without which ROS refuses their limits");
        let found = Diagnostic::warning(codes::write::ROS_LIMIT, message).one_of(kind, &joint.name);
        diagnostics.push(found.with_help("add the values of the data sheet to the <limit> of the new file"));
    }
}

/// Ranges and limits as MJCF has them.
fn joint_of_mjcf(parts: &mut JointParts, diagnostics: &mut Diagnostics) {
    let joint = &mut parts.joint;
    let name = joint.name.clone();
    let mut warn = |code, what: String, kind: &str| {
        let message = format!("joint \"{name}\": {what}");
        diagnostics.push(Diagnostic::warning(code, message).one_of(kind, &name));
    };
    if let Some((lower, upper)) = joint.position_range()
        && !(lower < upper && lower.abs() < mjcf::UNLIMITED && upper.abs() < mjcf::UNLIMITED)
    {
        let unit = joint.kind.unit();
        let range = format!("{} to {}", position(lower, unit), position(upper, unit));
        let kind = "joints have a range that MJCF cannot hold: they are written without one";
        warn(
            codes::write::RANGE,
            format!("MJCF cannot hold its range {range}, so it is written without one"),
            kind,
        );
        joint.limit =
            joint.limit.map(|limit| JointLimit { lower: f64::NEG_INFINITY, upper: f64::INFINITY, ..limit });
        if joint.kind == JointKind::Revolute {
            joint.kind = JointKind::Continuous;
        }
    }
    let Some(limit) = joint.limit.as_mut().filter(|_| joint.kind.is_movable()) else { return };
    if let Some(velocity) = limit.velocity.take() {
        let what = format!("its largest speed, {velocity} {}/s, is not written", joint.kind.unit());
        warn(codes::write::VELOCITY, what, "joints have a largest speed, which MJCF cannot hold");
    }
    let unit = joint.kind.unit();
    let rates = [
        ("acceleration", "^2", limit.acceleration.take()),
        ("deceleration", "^2", limit.deceleration.take()),
        ("jerk", "^3", limit.jerk.take()),
    ];
    let rates = rates.into_iter().filter_map(|(what, power, value)| {
        Some(format!("{what}, {}", quantity(value?, &format!("{unit}/s{power}"))))
    });
    let rates: Vec<String> = rates.collect();
    if !rates.is_empty() {
        let what = format!("not written are its largest {}", rates.join(", largest "));
        warn(codes::write::RATES, what, "joints have a largest acceleration or jerk, which MJCF cannot hold");
    }
    if limit.effort.is_some_and(|effort| effort <= 0.0) {
        limit.effort = None;
        let what = "its effort of 0 is no limit in MJCF, so it is written without an actuator".to_owned();
        warn(codes::write::EFFORT, what, "joints have an effort of 0: they are written without an actuator");
    }
}
