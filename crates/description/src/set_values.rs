//! Values of a robot that replace those of its files: keys of the robot file, and masses, losses and origins of its links and
//! joints.

use std::{path::Path, sync::Arc};

use congruent_input::{
    Diagnostic, FileAccess, Findings, Override, SourceFile, TextEdit, edited, known_names,
    rotation_from_rpy_fixed_xyz, rpy_fixed_xyz_rad, toml_text,
};
use congruent_robot::{Inertia, Joint, JointRounding, Link, Robot};
use nalgebra::Vector3;
use toml::Value;

use crate::{
    description::RobotDescription,
    load::{load_opened_robot, load_robot_with},
    named_robot::{file_of_robot, is_toml, open},
    robot_file::ROBOT_FILE_BYTES,
};

/// Keys of a link, as of `link.forearm_link.mass_kg`.
const LINK_KEYS: [&str; 2] = ["mass_kg", "com_m"];
/// Keys of a joint, as of `joint.elbow_joint.friction`.
const JOINT_KEYS: [&str; 6] = ["damping", "friction", "armature", "xyz_m", "rpy_rad", "rpy_deg"];

/// Loads a robot with other values than its files have.
///
/// A key is one of the robot file (`dh.row.elbow_joint.d_m`, `tcp.xyz_m.3`), or a value of a link or joint, whichever file it comes
/// from:
///
/// | key | value | unit |
/// |---|---|---|
/// | `link.NAME.mass_kg` | mass; the inertia tensor grows with it, as if the density changed | kg |
/// | `link.NAME.com_m` | centre of mass in the link; `com_m.1` to `com_m.3` are its coordinates | m |
/// | `joint.NAME.damping`, `friction`, `armature` | viscous damping, dry friction, inertia of motor and gear | as in URDF |
/// | `joint.NAME.xyz_m`, `rpy_rad`, `rpy_deg` | origin of the joint in its parent link; `xyz_m.1` is a coordinate | m, rad, deg |
///
/// # Errors
/// As [`load_robot_with`], or a key that the file does not have, a name that the robot does not have, or a value of another kind.
///
/// # Examples
/// ```
/// use congruent_description::load_robot_set;
/// let robot = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e");
/// let heavier = ["link.forearm_link.mass_kg=3.0".parse()?];
/// let loaded = load_robot_set(robot.as_ref(), &heavier, &Default::default())?;
/// let link = loaded.robot.find_link("forearm_link").unwrap();
/// assert_eq!(loaded.robot.link(link).inertia.as_ref().unwrap().mass_kg, 3.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn load_robot_set(
    path: &Path,
    overrides: &[Override],
    access: &FileAccess,
) -> Result<RobotDescription, Findings> {
    let is_of_model = |change: &&Override| matches!(change.path().next(), Some("link" | "joint"));
    let (of_model, of_file): (Vec<&Override>, Vec<&Override>) = overrides.iter().partition(is_of_model);
    let description = if of_file.is_empty() {
        load_robot_with(path, access)?
    } else {
        let path = file_of_robot(path)?;
        if !is_toml(&path) {
            let why = format!("{} is no robot file (robot.toml), which has such keys", path.display());
            return Err(of_file[0].refused(&why).into());
        }
        let source = open(&path, access, ROBOT_FILE_BYTES)?;
        load_opened_robot(&with_values(&source, &of_file)?, access)?
    };
    let robot =
        of_model.into_iter().try_fold(description.robot.clone(), |robot, change| set(&robot, change))?;
    Ok(RobotDescription { robot, ..description })
}

/// The file with these values in its text, so that digits and messages are those of the values.
fn with_values(source: &Arc<SourceFile>, overrides: &[&Override]) -> Result<Arc<SourceFile>, Diagnostic> {
    let mut text = source.text.clone();
    for change in overrides {
        let document = toml_text::parse_document(&text).map_err(|fault| fault.in_file(source))?;
        let place = change.find(&document)?.map(toml::Spanned::span);
        let edit = match place {
            Some(span) => TextEdit { span, text: change.written_value().to_owned() },
            None => TextEdit {
                span: 0..0,
                text: format!("{} = {}\n", change.dotted_key(), change.written_value()),
            },
        };
        let with_value = edited(&text, &[edit]);
        toml_text::parse_document(&with_value).map_err(|_| {
            change.refused("the robot file has no such key; write it there with its present value first")
        })?;
        text = with_value;
    }
    Ok(Arc::new(SourceFile { text, path: source.path.clone(), is_foreign: source.is_foreign }))
}

/// The robot with one value of a link or joint.
fn set(robot: &Robot, change: &Override) -> Result<Robot, Diagnostic> {
    let path: Vec<&str> = change.path().collect();
    let (kind, name, key, entry) = match path[..] {
        [kind, name, key] => (kind, name, key, None),
        [kind, name, key, entry] => (kind, name, key, Some(entry)),
        _ => return Err(change.refused("expected link.NAME.KEY or joint.NAME.KEY")),
    };
    let value = change.value().ok_or_else(|| change.refused("the value is not TOML"))?;
    let refused = |why: String| change.refused(&why);
    let entered = |before: [f64; 3]| vector(before, entry, &value);
    if kind == "link" {
        let names = robot.links().iter().map(|link| link.name.as_str());
        let link = robot.find_link(name).ok_or_else(|| unknown(change, "link", name, names))?;
        let changed = link_with(robot.link(link), key, &value, entered).map_err(refused)?;
        return Ok(robot.clone().with_inertia(link, changed));
    }
    let names = robot.joints().iter().map(|joint| joint.name.as_str());
    let joint = robot.find_joint(name).ok_or_else(|| unknown(change, "joint", name, names))?;
    let changed = joint_with(robot.joint(joint), key, &value, entered).map_err(refused)?;
    Ok(robot.with_joints(|each| {
        if each.name == name {
            *each = changed.clone();
        }
    }))
}

/// The inertia of a link with another mass or centre of mass.
fn link_with(
    link: &Link,
    key: &str,
    value: &Value,
    entered: impl Fn([f64; 3]) -> Result<[f64; 3], String>,
) -> Result<Inertia, String> {
    let inertia = link.inertia.clone().ok_or("the link has no inertia")?;
    match key {
        "mass_kg" => {
            let mass_kg = not_negative(value)?;
            if inertia.mass_kg <= 0.0 {
                return Err("the link has no mass, so it has no inertia that could grow with it".to_owned());
            }
            let tensor_kg_m2 = inertia.tensor_kg_m2 * (mass_kg / inertia.mass_kg);
            Ok(Inertia { mass_kg, tensor_kg_m2, ..inertia })
        }
        "com_m" => {
            let mut link_from_inertial = inertia.link_from_inertial;
            let com_m = entered(link_from_inertial.translation.vector.into())?;
            link_from_inertial.translation.vector = Vector3::from(com_m);
            Ok(Inertia { link_from_inertial, ..inertia })
        }
        _ => Err(known_names(key, "keys of a link", LINK_KEYS)),
    }
}

fn joint_with(
    joint: &Joint,
    key: &str,
    value: &Value,
    entered: impl Fn([f64; 3]) -> Result<[f64; 3], String>,
) -> Result<Joint, String> {
    let mut joint = joint.clone();
    let origin = &mut joint.parent_from_joint;
    match key {
        "damping" => joint.damping = not_negative(value)?,
        "friction" => joint.friction = not_negative(value)?,
        "armature" => joint.armature = Some(not_negative(value)?),
        "xyz_m" => origin.translation.vector = entered(origin.translation.vector.into())?.into(),
        "rpy_rad" => origin.rotation = rotation_from_rpy_fixed_xyz(entered(rpy_fixed_xyz_rad(origin))?),
        "rpy_deg" => {
            let before = rpy_fixed_xyz_rad(origin).map(f64::to_degrees);
            origin.rotation = rotation_from_rpy_fixed_xyz(entered(before)?.map(f64::to_radians));
        }
        _ => return Err(known_names(key, "keys of a joint", JOINT_KEYS)),
    }
    if matches!(key, "xyz_m" | "rpy_rad" | "rpy_deg") {
        // The digits of the file say nothing about the new value.
        joint.rounding = JointRounding::default();
    }
    Ok(joint)
}

fn not_negative(value: &Value) -> Result<f64, String> {
    let number = number(value)?;
    if number >= 0.0 { Ok(number) } else { Err(format!("{number} is negative")) }
}

fn number(value: &Value) -> Result<f64, String> {
    #[expect(clippy::cast_precision_loss, reason = "no length or mass has 2^53 units")]
    let number = match value {
        Value::Float(number) => *number,
        Value::Integer(number) => *number as f64,
        other => return Err(format!("{other} is not a number")),
    };
    if number.is_finite() { Ok(number) } else { Err(format!("{number} is not finite")) }
}

/// Three coordinates: all of them from a list, or one that `entry` counts from 1.
fn vector(mut before: [f64; 3], entry: Option<&str>, value: &Value) -> Result<[f64; 3], String> {
    match (entry, value) {
        (Some(entry), _) => {
            let at = entry.parse::<usize>().ok().and_then(|entry| entry.checked_sub(1));
            let at = at.filter(|at| *at < 3).ok_or_else(|| format!("\"{entry}\" is no entry from 1 to 3"))?;
            before[at] = number(value)?;
            Ok(before)
        }
        (None, Value::Array(items)) if items.len() == 3 => {
            for (coordinate, item) in before.iter_mut().zip(items) {
                *coordinate = number(item)?;
            }
            Ok(before)
        }
        (None, other) => Err(format!("{other} is not a list of three numbers")),
    }
}

fn unknown<'a>(
    change: &Override,
    what: &str,
    name: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> Diagnostic {
    let names: Vec<&str> = names.into_iter().collect();
    change.refused(&format!("the robot has no {what} \"{name}\"")).with_help(known_names(
        name,
        &format!("{what}s"),
        names,
    ))
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    fn loaded(changes: &[&str]) -> Result<RobotDescription, Findings> {
        let robot = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e"));
        let changes: Vec<Override> = changes.iter().map(|change| change.parse().unwrap()).collect();
        load_robot_set(&robot, &changes, &FileAccess::default())
    }

    #[track_caller]
    fn refused(change: &str, message: &str) {
        let found = loaded(&[change]).unwrap_err();
        let text = format!("{} {}", found[0].message, found[0].help.clone().unwrap_or_default());
        assert!(text.contains(message), "{text}");
    }

    #[test]
    fn values_of_the_robot_file_are_replaced_and_added() {
        let changes = ["dh.row.elbow_joint.d_m=0.002", "dh.row.2.a_m=-0.43", "tcp.xyz_m.3=0.06"];
        let set = loaded(&changes).unwrap();
        let rows = &set.dh.as_ref().unwrap().rows;
        assert_eq!([rows[2].d_m, rows[1].a_m, set.tip_from_tcp.unwrap().translation.z], [0.002, -0.43, 0.06]);
        // A value that the file does not have yet.
        assert_eq!(loaded(&["dh.row.4.d_m=0.1334"]).unwrap().dh.unwrap().rows[3].d_m, 0.1334);
    }

    #[test]
    fn a_link_is_heavier_and_as_wide() {
        let [before, after] = [&[][..], &["link.forearm_link.mass_kg=4.532", "link.forearm_link.com_m.1=0.1"]]
            .map(|changes| loaded(changes).unwrap().robot);
        let link = before.find_link("forearm_link").unwrap();
        let [before, after] = [&before, &after].map(|robot| robot.link(link).inertia.clone().unwrap());
        assert_eq!(after.mass_kg, 4.532);
        let radius = |of: &Inertia| of.tensor_kg_m2[(0, 0)] / of.mass_kg;
        assert!((radius(&before) - radius(&after)).abs() < 1e-15);
        assert_eq!(after.link_from_inertial.translation.x, 0.1);
    }

    #[test]
    fn a_joint_has_other_losses_and_another_origin() {
        let set = loaded(&["joint.elbow_joint.friction=2", "joint.elbow_joint.rpy_deg=[0, 90, 0]"]).unwrap();
        let joint = set.robot.joint(set.robot.find_joint("elbow_joint").unwrap());
        assert_eq!(joint.friction, 2.0);
        let x = joint.parent_from_joint.rotation * Vector3::x();
        assert!((x + Vector3::z()).norm() < 1e-12, "a quarter turn about y takes x to -z: {x}");
    }

    #[test]
    fn what_cannot_be_set_is_refused_with_what_can() {
        refused("joint.elbow.friction=3", "no joint \"elbow\"");
        refused("joint.elbow.friction=3", "elbow_joint");
        refused("link.forearm_link.mass=3", "mass_kg");
        refused("link.forearm_link.mass_kg=-3", "negative");
        refused("link.forearm_link.mass_kg=heavy", "not a number");
        refused("link.forearm_link.com_m.4=1", "no entry from 1 to 3");
        refused("link.forearm_link.com_m=[0, 1]", "three numbers");
        refused("dh.row.elbow.d_m=1", "elbow_joint");
        refused("dh.rows.1.d_m=1", "no such key");
        refused("dh.row.1.d_m=nan", "NaN");
    }
}
