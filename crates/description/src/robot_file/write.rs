//! The `[dh]` section of a robot file as text, which the reader of this crate gives back unchanged.

use std::fmt::Write;

use nalgebra::{Isometry3, Vector3};

use crate::{
    model::{DhTable, Robot},
    written::{
        number::{number, numbers, short_degrees},
        rpy::rpy_fixed_xyz_rad,
    },
};

/// Writes a table as the section `[dh]` of a robot file: lengths in metres, angles in degrees if a
/// short number says exactly the same, otherwise in radians with all digits.
pub fn dh_section(table: &DhTable, robot: &Robot) -> String {
    let mut text = String::from("[dh]\n");
    let _ = writeln!(text, "convention = \"{}\"", table.convention.name());
    if let Some(source) = &table.source {
        let _ = writeln!(text, "source = {}", quoted(source));
    }
    let _ = writeln!(text, "base_from_dh0 = {}", transform(&table.base_from_dh0));
    let _ = writeln!(text, "dhn_from_tip = {}", transform(&table.dhn_from_tip));
    for row in &table.rows {
        let (joint, kind) = (quoted(&robot.joint(row.joint).name), row.kind.name());
        let _ = writeln!(text, "\n[[dh.row]]\njoint = {joint}\nkind = \"{kind}\"");
        let _ = writeln!(text, "a_m = {}\n{}", number(row.a_m), angle("alpha", row.alpha_rad));
        let _ = writeln!(text, "d_m = {}\n{}", number(row.d_m), angle("theta", row.theta_rad));
        let _ = writeln!(text, "sign = {}", if row.sign < 0.0 { "-1" } else { "1" });
    }
    text
}

fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
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
    let rpy_rad = rpy_fixed_xyz_rad(pose);
    let in_degrees: Option<Vec<f64>> = rpy_rad.into_iter().map(short_degrees).collect();
    let rpy = match in_degrees {
        Some(rpy_deg) => format!("rpy_deg = [{}]", numbers(rpy_deg, ", ")),
        None => format!("rpy_rad = [{}]", numbers(rpy_rad, ", ")),
    };
    format!("{{ xyz_m = [{xyz_m}], {rpy} }}")
}

/// Whether a pose moves nothing, to the last digit.
fn is_identity(pose: &Isometry3<f64>) -> bool {
    pose.translation.vector == Vector3::zeros() && pose.rotation.angle() == 0.0
}
