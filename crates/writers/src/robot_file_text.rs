//! Writes a robot file and its `[dh]` section as text that the reader of robot files reads back to the same values.

use std::{f64::consts::FRAC_PI_2, fmt::Write, path::Path};

use congruent_description::{
    DhRow, DhRowKind, DhTable, Joint, JointIndex, Robot, RobotDescription, Tolerance,
};
use congruent_input::{
    number::{number, numbers, short_degrees},
    rpy_fixed_xyz_rad, toml_key, toml_string,
};
use nalgebra::{Isometry3, Vector3};

/// Writes a table as the section `[dh]` of a robot file: lengths in metres, angles in degrees if a
/// short number says exactly the same, otherwise in radians with all digits.
pub fn dh_section(table: &DhTable, robot: &Robot) -> String {
    table_section(table, robot, |_| None)
}

/// The same of a robot file without a URDF: its rows have the ranges of the joints.
pub fn own_dh_section(table: &DhTable, robot: &Robot) -> String {
    table_section(table, robot, |row| range(robot.joint(row.joint)))
}

/// The space screws of a chain as the section `[poe]` of a robot file: one twist at zero for each joint, angular part first, in
/// link `base`, and the pose of link `tip` there.
///
/// | value | shape | unit | frame |
/// |---|---|---|---|
/// | `twists` | angular and linear for each joint | 1, m per unit of the joint | base, at zero |
/// | `base_from_tip_at_zero` | SE(3) | m | base |
pub fn poe_section(
    joints: &[JointIndex],
    twists: &[[Vector3<f64>; 2]],
    base_from_tip_at_zero: &Isometry3<f64>,
    robot: &Robot,
) -> String {
    /// Smaller components are rounding of a dozen products within 2 m.
    const NOISE: f64 = 1e-15;
    let vector = |of: &Vector3<f64>| {
        numbers(of.iter().map(|value| if value.abs() < NOISE { 0.0 } else { *value }), ", ")
    };
    let home = transform(base_from_tip_at_zero);
    let mut text = format!("[poe]\nframe = \"space\"\nhome = {home}\n");
    for (&joint, [angular, linear]) in joints.iter().zip(twists) {
        let joint = robot.joint(joint);
        let kind = if joint.kind.is_angular() { DhRowKind::Revolute } else { DhRowKind::Prismatic };
        let (name, kind) = (toml_string(&joint.name), kind.name());
        let _ = writeln!(text, "\n[[poe.joint]]\njoint = {name}\nkind = \"{kind}\"");
        let _ = writeln!(text, "omega = [{}]\nv_m = [{}]", vector(angular), vector(linear));
        if let Some(range) = range(joint) {
            let _ = writeln!(text, "{range}");
        }
    }
    text
}

/// A whole robot file without a URDF: its section `[dh]` or `[poe]` is the robot.
pub fn own_robot_file_text(description: &RobotDescription, section: &str) -> String {
    let is_of_model = |key: &str| !["urdf", "srdf", "packages", "tolerance"].contains(&key);
    let values = robot_file_values(description, Path::new(""), description.tolerance);
    let mut text = String::new();
    for (key, value) in values.into_iter().filter(|(key, _)| is_of_model(key)) {
        let _ = writeln!(text, "{key} = {value}");
    }
    text + "\n" + section
}

/// The key of a joint's range; none for a joint without limits.
fn range(joint: &Joint) -> Option<String> {
    let (lower, upper) = joint.position_range()?;
    let degrees = [lower, upper].map(|angle| short_degrees(angle).filter(|_| joint.kind.is_angular()));
    Some(match degrees {
        [Some(lower), Some(upper)] => format!("range_deg = [{}, {}]", number(lower), number(upper)),
        _ => format!("range_{} = [{}, {}]", joint.kind.unit(), number(lower), number(upper)),
    })
}

fn table_section(table: &DhTable, robot: &Robot, range: impl Fn(&DhRow) -> Option<String>) -> String {
    let mut text = String::from("[dh]\n");
    let _ = writeln!(text, "convention = \"{}\"", table.convention.name());
    if let Some(source) = &table.source {
        let _ = writeln!(text, "source = {}", toml_string(source));
    }
    let _ = writeln!(text, "base_from_dh0 = {}", transform(&table.base_from_dh0));
    let _ = writeln!(text, "dhn_from_tip = {}", transform(&table.dhn_from_tip));
    for row in &table.rows {
        let (joint, kind) = (toml_string(&robot.joint(row.joint).name), row.kind.name());
        let _ = writeln!(text, "\n[[dh.row]]\njoint = {joint}\nkind = \"{kind}\"");
        let _ = writeln!(text, "a_m = {}\n{}", number(row.a_m), angle("alpha", row.alpha_rad));
        let _ = writeln!(text, "d_m = {}\n{}", number(row.d_m), angle("theta", row.theta_rad));
        let _ = writeln!(text, "sign = {}", if row.sign < 0.0 { "-1" } else { "1" });
        if let Some(range) = range(row) {
            let _ = writeln!(text, "{range}");
        }
    }
    text
}

/// A whole robot file for the chain of `description`, with a section `[dh]`, to be written into `folder`. Paths
/// are those of the description, so that `folder` and they must be absolute, or relative to the same folder.
pub fn robot_file_text(
    description: &RobotDescription,
    dh_section: &str,
    folder: &Path,
    tolerance: Tolerance,
) -> String {
    let is_default = tolerance == Tolerance::default();
    let values = robot_file_values(description, folder, tolerance);
    let values = values.into_iter().filter(|(key, _)| !(is_default && *key == "tolerance"));
    let mut text = String::new();
    for (key, value) in values {
        let _ = writeln!(text, "{key} = {value}");
    }
    text + "\n" + dh_section
}

/// The keys of a robot file above its sections, in their order, with their values as TOML. Paths as for
/// [`robot_file_text`].
pub fn robot_file_values(
    description: &RobotDescription,
    folder: &Path,
    tolerance: Tolerance,
) -> Vec<(&'static str, String)> {
    let named = |path: &Path| toml_string(&relative_path(folder, path));
    let link = |link| toml_string(&description.robot.link(link).name);
    let mut values = vec![("name", toml_string(&description.name))];
    values.extend(description.own_model().is_none().then(|| ("urdf", named(&description.urdf_path))));
    values.extend(description.named_files.srdf.as_ref().map(|srdf| ("srdf", named(srdf))));
    values.extend([("base", link(description.base)), ("tip", link(description.tip))]);
    values.extend(description.tip_from_tcp.as_ref().map(|tip_from_tcp| ("tcp", transform(tip_from_tcp))));
    let packages = description.named_files.packages.iter();
    let packages: Vec<String> =
        packages.map(|(name, path)| format!("{} = {}", toml_key(name), named(path))).collect();
    if !packages.is_empty() {
        values.push(("packages", format!("{{ {} }}", packages.join(", "))));
    }
    let Tolerance { position_m, orientation_rad } = tolerance;
    let tolerance = format!("{{ position_m = {position_m:e}, orientation_rad = {orientation_rad:e} }}");
    values.push(("tolerance", tolerance));
    values
}

/// `path` relative to `folder`, with `/` between its parts as in every robot file.
pub fn relative_path(folder: &Path, path: &Path) -> String {
    // Without a common root, as on two Windows drives, no relative path exists.
    let Some(relative) = congruent_input::relative_path(folder, path) else {
        return path.display().to_string();
    };
    let parts: Vec<_> = relative.components().map(|part| part.as_os_str().to_string_lossy()).collect();
    parts.join("/")
}

fn angle(quantity: &str, angle_rad: f64) -> String {
    match short_degrees(angle_rad) {
        Some(degrees) => format!("{quantity}_deg = {}", number(degrees)),
        None => format!("{quantity}_rad = {}", number(angle_rad)),
    }
}

fn transform(pose: &Isometry3<f64>) -> String {
    if is_identity(pose) {
        return "{}".to_owned();
    }
    let xyz_m = numbers(pose.translation.vector.iter().copied(), ", ");
    let rpy_rad = rpy_fixed_xyz_rad(pose).map(without_noise);
    let in_degrees: Option<Vec<f64>> = rpy_rad.into_iter().map(short_degrees).collect();
    let rpy = match in_degrees {
        Some(rpy_deg) => format!("rpy_deg = [{}]", numbers(rpy_deg, ", ")),
        None => format!("rpy_rad = [{}]", numbers(rpy_rad, ", ")),
    };
    format!("{{ xyz_m = [{xyz_m}], {rpy} }}")
}

/// An angle that is a quarter turn up to the rounding of a URDF that writes pi with ten digits.
fn without_noise(angle_rad: f64) -> f64 {
    /// Unit: rad. Kind: rounding; half of the last of eleven digits of pi, and a hundredth of the tolerance of a table.
    const NOISE_RAD: f64 = 1e-11;
    let quarters = (angle_rad / FRAC_PI_2).round() * FRAC_PI_2;
    if (angle_rad - quarters).abs() <= NOISE_RAD { quarters } else { angle_rad }
}

/// Whether a pose is exactly the identity.
fn is_identity(pose: &Isometry3<f64>) -> bool {
    pose.translation.vector == Vector3::zeros() && pose.rotation.angle() == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_from_the_folder_to_the_file() {
        let from = |folder: &str, path: &str| relative_path(Path::new(folder), Path::new(path));
        assert_eq!(from("/a/b", "/a/b/r.urdf"), "r.urdf");
        assert_eq!(from("/a/b/c", "/a/d/r.urdf"), "../../d/r.urdf");
        assert_eq!(from("/a", "/a"), ".");
        assert_eq!(from("a", "/b"), "/b");
    }
}
