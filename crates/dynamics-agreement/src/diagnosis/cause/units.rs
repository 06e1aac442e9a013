//! Mistakes with units of mass, length and inertia.

use super::common_mistake::CommonMistake;
use congruent_dynamics::JointResistance;

use crate::{
    diagnosis::{cause_names::DynamicsCause, hypothesis::FaultySide},
    model::Inertial,
    thresholds::SAME_VALUE,
};

const POUND_KG: f64 = 0.453_592_37;
const INCH_M: f64 = 0.0254;
const FOOT_M: f64 = 0.3048;
/// A pound accelerated by standard gravity, over a foot per second squared.
const SLUG_KG: f64 = POUND_KG * 9.80665 / FOOT_M;

/// Units of mass, each with its number in a kilogram.
const MASSES: [(&str, f64); 2] = [("g", 1e3), ("lb", 1.0 / POUND_KG)];
/// Units of length, each with its number in a metre.
const LENGTHS: [(&str, f64); 3] = [("mm", 1e3), ("cm", 1e2), ("in", 1.0 / INCH_M)];
/// Units of inertia, each with its number in 1 kg m^2.
const INERTIAS: [(&str, f64); 8] = [
    ("kg_mm2", 1e6),
    ("g_mm2", 1e9),
    ("kg_cm2", 1e4),
    ("g_cm2", 1e7),
    ("g_m2", 1e3),
    ("lb_in2", 1.0 / (POUND_KG * INCH_M * INCH_M)),
    ("lb_ft2", 1.0 / (POUND_KG * FOOT_M * FOOT_M)),
    ("slug_ft2", 1.0 / (SLUG_KG * FOOT_M * FOOT_M)),
];
/// Units of mass and length in which CAD programs export all parameters, each with its numbers in a kilogram and a metre.
const CAD: [(&str, f64, f64); 3] =
    [("g_mm", 1e3, 1e3), ("kg_mm", 1.0, 1e3), ("lb_in", 1.0 / POUND_KG, 1.0 / INCH_M)];
/// Relative error of a converted value with three digits. No unit; kind: digits of a file.
const ROUNDED: f64 = 5e-3;

pub(super) fn mistakes<'a>(faulty: FaultySide) -> Vec<CommonMistake<'a>> {
    let mut mistakes = Vec::new();
    for (unit, count) in MASSES {
        let factor = faulty.factor(count);
        mistakes.push(CommonMistake::new(DynamicsCause::MassUnit, unit, move |parameters| Inertial {
            mass_kg: parameters.mass_kg * factor,
            ..*parameters
        }));
    }
    for (unit, count) in LENGTHS {
        let factor = faulty.factor(count);
        mistakes.push(CommonMistake::new(DynamicsCause::ComUnit, unit, move |parameters| Inertial {
            com_m: parameters.com_m * factor,
            ..*parameters
        }));
    }
    // Metres under a key of millimetres are divided once too often.
    let factor = faulty.factor(1e-3);
    mistakes.push(CommonMistake::new(DynamicsCause::ComUnit, "m", move |parameters| Inertial {
        com_m: parameters.com_m * factor,
        ..*parameters
    }));
    for (unit, count) in INERTIAS {
        let factor = faulty.factor(count);
        mistakes.push(CommonMistake::new(DynamicsCause::InertiaUnit, unit, move |parameters| Inertial {
            tensor_kg_m2: parameters.tensor_kg_m2 * factor,
            ..*parameters
        }));
    }
    for (unit, masses, lengths) in CAD {
        let (mass, length) = (faulty.factor(masses), faulty.factor(lengths));
        mistakes.push(CommonMistake::new(DynamicsCause::CadUnits, unit, move |parameters| Inertial {
            mass_kg: parameters.mass_kg * mass,
            com_m: parameters.com_m * length,
            // A tensor is a mass times a square of a length, so one unit of each decides it.
            tensor_kg_m2: parameters.tensor_kg_m2 * (mass * length * length),
            ..*parameters
        }));
    }
    mistakes
}

/// The unit of parameters that were rounded to three digits when they were converted, so that no unit explains them exactly,
/// from the written and the right values. `None` if no unit fits.
pub(crate) fn rounded_unit(written: &Inertial, right: &Inertial) -> Option<(DynamicsCause, &'static str)> {
    let tensors = [written, right].map(Inertial::tensor_in_link);
    let mass = |count: f64| is_in_unit(count, &[written.mass_kg], &[right.mass_kg]);
    let com = |count: f64| is_in_unit(count, written.com_m.as_slice(), right.com_m.as_slice());
    let tensor = |count: f64| is_in_unit(count, tensors[0].as_slice(), tensors[1].as_slice());
    let is_equal = |found: &[f64], expected: &[f64]| {
        let size = largest(found).max(largest(expected));
        found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() <= SAME_VALUE * size)
    };
    let equal = [
        is_equal(&[written.mass_kg], &[right.mass_kg]),
        is_equal(written.com_m.as_slice(), right.com_m.as_slice()),
        is_equal(tensors[0].as_slice(), tensors[1].as_slice()),
    ];
    let named = |cause, unit: Option<&'static str>| unit.map(|unit| (cause, unit));
    let find = |units: &[(&'static str, f64)], is: &dyn Fn(f64) -> bool| {
        units.iter().find(|(_, count)| is(*count)).map(|(unit, _)| *unit)
    };
    // One part off alone: its unit is the cause only if the other two are right.
    match equal {
        [false, true, true] => named(DynamicsCause::MassUnit, find(&MASSES, &mass)),
        [true, false, true] => named(DynamicsCause::ComUnit, find(&LENGTHS, &com)),
        [true, true, false] => named(DynamicsCause::InertiaUnit, find(&INERTIAS, &tensor)),
        _ => {
            // Several values off at once: only units of a CAD program, which change all three together.
            let all = |(_, masses, lengths): &&(&str, f64, f64)| {
                mass(*masses) && com(*lengths) && tensor(masses * lengths * lengths)
            };
            named(DynamicsCause::CadUnits, CAD.iter().find(all).map(|(unit, ..)| *unit))
        }
    }
}

/// [`rounded_unit`] for damping, which may be given per degree instead of per radian, or the reverse.
pub(crate) fn rounded_damping_unit(
    written: &[JointResistance],
    right: &[JointResistance],
) -> Option<(DynamicsCause, &'static str)> {
    let differs = |a: f64, b: f64| a.total_cmp(&b).is_ne();
    let changed =
        || written.iter().zip(right).filter(|(written, right)| differs(written.damping, right.damping));
    let is_other = written.iter().zip(right).any(|(written, right)| {
        differs(written.friction, right.friction) || differs(written.armature, right.armature)
    });
    let is_in = |count: f64| {
        changed().all(|(written, right)| is_in_unit(count, &[written.damping], &[right.damping]))
    };
    if is_other || changed().next().is_none() {
        return None;
    }
    let units = [("degrees", std::f64::consts::PI / 180.0), ("radians", 180.0 / std::f64::consts::PI)];
    let unit = units.into_iter().find(|(_, count)| is_in(*count));
    unit.map(|(unit, _)| (DynamicsCause::DampingUnit, unit))
}

/// Whether the values are the expected ones in a unit of which `count` make the right one, within rounded digits.
fn is_in_unit(count: f64, found: &[f64], expected: &[f64]) -> bool {
    let size = largest(expected);
    size > 0.0
        && found
            .iter()
            .zip(expected)
            .all(|(found, expected)| (found / count - expected).abs() <= ROUNDED * size)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}
