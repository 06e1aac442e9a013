//! Wrong units.

use super::slip::Slip;
use crate::{
    diagnosis::{cause_names::DynamicsCause, hypothesis::FaultySide},
    side::Inertial,
};

const POUND_KG: f64 = 0.453_592_37;
const INCH_M: f64 = 0.0254;
const FOOT_M: f64 = 0.3048;
/// A pound accelerated by standard gravity, over a foot per second squared.
const SLUG_KG: f64 = POUND_KG * 9.80665 / FOOT_M;

/// How many make a kilogram.
const MASSES: [(&str, f64); 2] = [("g", 1e3), ("lb", 1.0 / POUND_KG)];
/// How many make a metre.
const LENGTHS: [(&str, f64); 3] = [("mm", 1e3), ("cm", 1e2), ("in", 1.0 / INCH_M)];
/// How many make a kg m^2.
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
/// Units of mass and length that CAD programs write all figures in.
const CAD: [(&str, f64, f64); 2] = [("g_mm", 1e3, 1e3), ("kg_mm", 1.0, 1e3)];

pub(super) fn slips<'a>(faulty: FaultySide) -> Vec<Slip<'a>> {
    let mut slips = Vec::new();
    for (unit, count) in MASSES {
        let factor = faulty.factor(count);
        slips.push(Slip::new(DynamicsCause::MassUnit, unit, move |figures| Inertial {
            mass_kg: figures.mass_kg * factor,
            ..*figures
        }));
    }
    for (unit, count) in LENGTHS {
        let factor = faulty.factor(count);
        slips.push(Slip::new(DynamicsCause::ComUnit, unit, move |figures| Inertial {
            com_m: figures.com_m * factor,
            ..*figures
        }));
    }
    for (unit, count) in INERTIAS {
        let factor = faulty.factor(count);
        slips.push(Slip::new(DynamicsCause::InertiaUnit, unit, move |figures| Inertial {
            tensor_kg_m2: figures.tensor_kg_m2 * factor,
            ..*figures
        }));
    }
    for (unit, masses, lengths) in CAD {
        let (mass, length) = (faulty.factor(masses), faulty.factor(lengths));
        slips.push(Slip::new(DynamicsCause::CadUnits, unit, move |figures| Inertial {
            mass_kg: figures.mass_kg * mass,
            com_m: figures.com_m * length,
            tensor_kg_m2: figures.tensor_kg_m2 * (mass * length * length),
            ..*figures
        }));
    }
    slips
}
