//! Orientations in the five notations of MJCF, as MuJoCo 4.0 resolves them.

use congruent_input::{Diagnostic, Diagnostics};
use nalgebra::{Isometry3, Matrix3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};

use super::attributes::{MjAttributes, MjFound};
use crate::{
    codes,
    document::MjElement,
    grammar::ORIENTATIONS,
    model::{MjNotation, MjWritten},
    settings::MjSettings,
};

/// Shorter vectors have no direction. Source: `mjMINVAL` of MuJoCo 4.0.
pub(super) const SHORTEST: f64 = 1e-14;

/// Position and orientation as they are written.
pub(super) struct MjWrittenPose {
    pub(super) pos: MjWritten<Vector3<f64>>,
    pub(super) orientation: MjWritten<UnitQuaternion<f64>>,
}

impl MjWrittenPose {
    pub(super) fn read(
        attributes: &MjAttributes<'_>,
        settings: &MjSettings,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        Self {
            pos: attributes.array("pos", [0.0; 3]).map(Vector3::from),
            orientation: orientation(attributes, settings, diagnostics),
        }
    }

    pub(super) fn isometry(&self) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::from(self.pos.value), self.orientation.value)
    }
}

/// The orientation of an element: its own, in whatever notation, or else that of its class.
pub(super) fn orientation(
    attributes: &MjAttributes<'_>,
    settings: &MjSettings,
    diagnostics: &mut Diagnostics,
) -> MjWritten<UnitQuaternion<f64>> {
    let element = attributes.element;
    let own = ORIENTATIONS.into_iter().find(|key| element.text(key).is_some());
    let found = own.or_else(|| ORIENTATIONS.into_iter().find(|key| attributes.find(key).is_some()));
    let Some(found) = found.and_then(|key| attributes.find(key)) else {
        return MjWritten::unwritten(UnitQuaternion::identity());
    };
    let value = diagnostics.keep(resolved(&found, element, settings)).unwrap_or_default();
    MjWritten { value, place: Some(found.place()) }
}

fn resolved(
    found: &MjFound<'_>,
    element: &MjElement,
    settings: &MjSettings,
) -> Result<UnitQuaternion<f64>, Diagnostic> {
    let key = found.attribute.key.as_str();
    let notation = settings.notation(Isometry3::identity());
    orientation_of(key, found.array([0.0; 6]).value, &notation).map_err(|what| {
        let message = format!("{}: {what} of {key} has the length 0", element.label());
        found.attribute.fault(codes::mjcf::ORIENTATION, message)
    })
}

/// The orientation that the numbers of an attribute mean.
///
/// # Errors
/// What has the length 0.
pub(crate) fn orientation_of(
    key: &str,
    numbers: [f64; 6],
    notation: &MjNotation,
) -> Result<UnitQuaternion<f64>, &'static str> {
    let unit = |vector: Vector3<f64>, what| Unit::try_new(vector, SHORTEST).ok_or(what);
    let [a, b, c, d, ..] = numbers;
    Ok(match key {
        "quat" => UnitQuaternion::try_new(Quaternion::new(a, b, c, d), SHORTEST).ok_or("the quaternion")?,
        "axisangle" => {
            UnitQuaternion::from_axis_angle(&unit(Vector3::new(a, b, c), "the axis")?, notation.angle_rad(d))
        }
        "euler" => from_euler([a, b, c].map(|angle| notation.angle_rad(angle)), notation.euler_sequence),
        "xyaxes" => {
            let x = unit(Vector3::new(a, b, c), "the x axis")?;
            let y = Vector3::new(numbers[3], numbers[4], numbers[5]);
            let y = unit(y - x.into_inner() * x.dot(&y), "the part of the y axis normal to x")?;
            let axes = Matrix3::from_columns(&[x.into_inner(), y.into_inner(), x.cross(&y)]);
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes))
        }
        _ => shortest_turn_to(&unit(Vector3::new(a, b, c), "the z axis")?),
    })
}

/// The turns in their order: lower case about axes that turn along, upper case about fixed ones.
pub(super) fn from_euler(angles_rad: [f64; 3], sequence: [u8; 3]) -> UnitQuaternion<f64> {
    let turns = sequence.into_iter().zip(angles_rad);
    turns.fold(UnitQuaternion::identity(), |before, (letter, angle)| {
        let axis = match letter.to_ascii_lowercase() {
            b'x' => Vector3::x_axis(),
            b'y' => Vector3::y_axis(),
            _ => Vector3::z_axis(),
        };
        let turn = UnitQuaternion::from_axis_angle(&axis, angle);
        if letter.is_ascii_lowercase() { before * turn } else { turn * before }
    })
}

/// The smallest turn of z to a direction; to -z, half a turn about x.
pub(super) fn shortest_turn_to(direction: &Unit<Vector3<f64>>) -> UnitQuaternion<f64> {
    /// Below this sine the axis of the turn is taken as x. Source: `mjuu_z2quat`.
    const SMALLEST_SINE: f64 = 1e-10;
    let axis = Vector3::z().cross(direction);
    let sine = axis.norm();
    let axis = if sine < SMALLEST_SINE { Vector3::x_axis() } else { Unit::new_unchecked(axis / sine) };
    UnitQuaternion::from_axis_angle(&axis, libm::atan2(sine, direction.z))
}
