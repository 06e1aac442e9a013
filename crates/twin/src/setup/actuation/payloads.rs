//! `[[payload]]` checked against its robot.

use congruent_description::{CarriedBody, Inertia, LinkIndex, RobotDescription};
use congruent_input::{
    Diagnostic, Findings, known_names,
    units::{Unit, both_given},
};
use congruent_monitors::{HEAVIEST_KG, RunPayload, too_heavy};
use congruent_scenario::{FilePlace, PayloadInertia, PayloadSettings};
use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};

use crate::{codes, setup::surroundings::LARGEST_M};

/// The payloads of a run, in the order of the scenario.
///
/// # Errors
/// Every fault of each of them.
pub(in crate::setup) fn payloads(
    all: &[PayloadSettings],
    places: FilePlace<'_>,
    description: &RobotDescription,
) -> Result<Vec<RunPayload>, Findings> {
    let mut errors = Vec::new();
    let mut payloads: Vec<RunPayload> = Vec::new();
    for (index, settings) in all.iter().enumerate() {
        let place = places.item(index);
        match payload(settings, place, description) {
            Ok(payload) if payloads.iter().any(|known| known.name == payload.name) => {
                let message = format!("two payloads are named \"{}\"", payload.name);
                errors
                    .push(place.key("name").mark(Diagnostic::error(codes::scenario::PAYLOAD_TWICE, message)));
            }
            Ok(payload) => payloads.push(payload),
            Err(error) => errors.push(error),
        }
    }
    if errors.is_empty() { Ok(payloads) } else { Err(errors.into()) }
}

fn payload(
    settings: &PayloadSettings,
    place: FilePlace<'_>,
    description: &RobotDescription,
) -> Result<RunPayload, Diagnostic> {
    let wrong = |key: &str, message: String| {
        place.key(key).mark(Diagnostic::error(
            codes::scenario::PAYLOAD,
            format!("payload \"{}\": {message}", settings.name),
        ))
    };
    if settings.name.trim().is_empty() {
        return Err(wrong("name", "the name is empty".to_owned()));
    }
    if settings.mass_kg > HEAVIEST_KG {
        return Err(wrong("mass_kg", too_heavy(settings.mass_kg)));
    }
    let until_s = settings.until_s.unwrap_or(f64::INFINITY);
    if until_s <= settings.from_s {
        let message = format!("until_s = {until_s} s must be later than from_s = {} s", settings.from_s);
        return Err(wrong("until_s", message));
    }
    let (link, link_from_frame) = carrier(settings, place, description)?;
    if settings.com_m.is_some() && settings.com_mm.is_some() {
        return Err(place.key("com_mm").mark(both_given(["com_m", "com_mm"])));
    }
    let com_in_frame = centre_of_mass(settings).map_err(|message| wrong("com_mm", message))?;
    let tensor_kg_m2 = settings.inertia_kg_m2.map_or(Ok(Matrix3::zeros()), tensor);
    let tensor_kg_m2 = tensor_kg_m2.map_err(|message| wrong("inertia_kg_m2", message))?;
    // The tensor is given in the axes of that frame, so the inertial frame is only shifted.
    let frame_from_com = Isometry3::from_parts(Translation3::from(com_in_frame), UnitQuaternion::identity());
    let link_from_inertial = link_from_frame * frame_from_com;
    let inertia = Inertia { mass_kg: settings.mass_kg, link_from_inertial, tensor_kg_m2 };
    let carried = CarriedBody { link, inertia };
    Ok(RunPayload { name: settings.name.clone(), carried, from_s: settings.from_s, until_s })
}

/// The link that carries the payload, and the frame in it in which the payload is given.
fn carrier(
    settings: &PayloadSettings,
    place: FilePlace<'_>,
    description: &RobotDescription,
) -> Result<(LinkIndex, Isometry3<f64>), Diagnostic> {
    let robot = &description.robot;
    let Some(name) = &settings.link else {
        let tip_from_tcp = description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
        return Ok((description.tip, tip_from_tcp));
    };
    let link = robot.find_link(name).ok_or_else(|| {
        let message = format!("robot \"{}\" has no link \"{name}\"", robot.name());
        let names = robot.links().iter().map(|link| link.name.as_str());
        let error = Diagnostic::error(codes::scenario::UNKNOWN_LINK, message);
        place.key("link").mark(error.with_help(known_names(name, "links", names)))
    })?;
    Ok((link, Isometry3::identity()))
}

fn centre_of_mass(settings: &PayloadSettings) -> Result<Vector3<f64>, String> {
    let from_mm = |com_mm: [f64; 3]| com_mm.map(|value| Unit::Length.convert(value));
    let com_m = settings.com_m.or(settings.com_mm.map(from_mm)).unwrap_or_default();
    if com_m.iter().all(|value| value.abs() <= LARGEST_M) {
        Ok(com_m.into())
    } else {
        Err(format!("a coordinate of the centre of mass is not finite, or beyond the limit of {LARGEST_M} m"))
    }
}

/// The tensor, if a body can have it: each principal moment is at most the sum of the other two.
fn tensor(entries: PayloadInertia) -> Result<Matrix3<f64>, String> {
    let PayloadInertia { xx, yy, zz, xy, xz, yz } = entries;
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    if !tensor.iter().all(|entry| entry.is_finite()) {
        return Err("the inertia is not finite".to_owned());
    }
    let principal = tensor.symmetric_eigenvalues();
    let (smallest, largest) = (principal.min(), principal.max());
    // Entries of a file have few digits, so that a plate, whose largest moment is the sum of the others, may miss it.
    let allowance = 1e-6 * largest.abs();
    if smallest < -allowance || 2.0 * largest > principal.sum() + allowance {
        let [a, b, c]: [f64; 3] = principal.into();
        return Err(format!(
            "no body has the principal moments of inertia {a:.3e}, {b:.3e} and {c:.3e} kg m^2: each must be at most the sum \
             of the other two"
        ));
    }
    Ok(tensor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inertia_that_no_body_has() {
        let entries = |xx, yy, zz, xy| PayloadInertia { xx, yy, zz, xy, ..PayloadInertia::default() };
        assert!(tensor(entries(1.0, 1.0, 1.9, 0.0)).is_ok() && tensor(entries(1.0, 1.0, 2.0, 0.0)).is_ok());
        for wrong in [entries(1.0, 1.0, 2.1, 0.0), entries(1.0, 1.0, 1.0, 1.1), entries(-1.0, 1.0, 1.0, 0.0)]
        {
            assert!(tensor(wrong).unwrap_err().contains("no body"), "{wrong:?}");
        }
        assert!(tensor(entries(f64::NAN, 1.0, 1.0, 0.0)).is_err());
    }
}
