//! Decides whether a rigid body can have a given mass and inertia tensor.

use congruent_input::{
    Code,
    display::{length, quantity},
};
use congruent_robot::{Inertia, principal_moments};

use crate::codes;

/// Rounding in files: principal moments may miss a bound by so much of the largest one. Real
/// robots miss by up to 1e-4 if inertias are written with four digits.
const MOMENT: f64 = 1e-3;
/// Largest plausible radius of gyration of a link, m; a larger one suggests a tensor in kg mm^2.
pub const LARGEST_GYRATION_M: f64 = 3.0;

/// The unit of a tensor, as messages print it.
pub(super) const UNIT: &str = "kg m2";

/// Why no rigid body has an inertia.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Impossible {
    /// The mass is negative, kg.
    Mass(f64),
    /// The smallest principal moment is negative, kg m^2.
    NotDefinite(f64),
    /// The largest principal moment, and by how much it exceeds the sum of the others, kg m^2.
    Triangle(f64, f64),
}

impl Impossible {
    /// What is impossible about an inertia; `None` if a rigid body can have it.
    pub(super) fn find(inertia: &Inertia) -> Option<Self> {
        if inertia.mass_kg < 0.0 {
            return Some(Self::Mass(inertia.mass_kg));
        }
        let [least, middle, most] = principal_moments(&inertia.tensor_kg_m2);
        // Necessary and sufficient for a rigid body: principal moments that are not negative and obey the triangle inequality
        // (each is at most the sum of the other two). Sorted, only the least and the largest need a test.
        let slack = MOMENT * most.abs();
        if least < -slack || most < 0.0 {
            return Some(Self::NotDefinite(least));
        }
        (least + middle < most - slack).then_some(Self::Triangle(most, most - least - middle))
    }

    /// The code of its diagnostic.
    pub(super) fn code(self) -> &'static Code {
        match self {
            Self::Mass(_) => codes::urdf::MASS,
            Self::NotDefinite(_) | Self::Triangle(..) => codes::urdf::INERTIA,
        }
    }

    /// The element that holds the value.
    pub(super) fn element(self) -> &'static str {
        match self {
            Self::Mass(_) => "mass",
            Self::NotDefinite(_) | Self::Triangle(..) => "inertia",
        }
    }

    /// The words of a joined message, after the number of links.
    pub(super) fn kind(self) -> &'static str {
        match self {
            Self::Mass(_) => "links have a negative mass",
            Self::NotDefinite(_) => "links have an inertia that is not positive definite",
            Self::Triangle(..) => "links have an inertia that breaks the triangle inequality",
        }
    }

    /// What is wrong, with the values.
    pub(super) fn message(self) -> String {
        match self {
            Self::Mass(mass_kg) => format!("mass {mass_kg} is negative"),
            Self::NotDefinite(least) => format!(
                "inertia is not positive definite: its smallest principal moment is {}",
                quantity(least, UNIT)
            ),
            Self::Triangle(most, excess) => format!(
                "inertia breaks the triangle inequality: its largest principal moment, {}, exceeds the sum of \
                 the others by {}",
                quantity(most, UNIT),
                quantity(excess, UNIT)
            ),
        }
    }
}

/// The message about a tensor that is too large for its mass; `None` if the radius of gyration is plausible.
pub(super) fn suspicious_size(inertia: &Inertia) -> Option<String> {
    let [.., most] = principal_moments(&inertia.tensor_kg_m2);
    let gyration_m = (most / inertia.mass_kg).sqrt();
    (inertia.mass_kg > 0.0 && gyration_m > LARGEST_GYRATION_M).then(|| {
        format!(
            "inertia is too large for the mass: radius of gyration {} (limit {})",
            length(gyration_m),
            length(LARGEST_GYRATION_M)
        )
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Matrix3, Vector3};

    use super::*;

    #[track_caller]
    fn check(mass_kg: f64, moments: [f64; 3], expected: Option<&str>) {
        // Turned, so that no check can lean on a diagonal tensor.
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.2, 0.9);
        let tensor_kg_m2 = turn * Matrix3::from_diagonal(&Vector3::from(moments)) * turn.inverse();
        let inertia = Inertia { mass_kg, link_from_inertial: Isometry3::identity(), tensor_kg_m2 };
        let size = suspicious_size(&inertia).map(|_| "size");
        assert_eq!(Impossible::find(&inertia).map(Impossible::element).or(size), expected);
    }

    #[test]
    fn a_tensor_must_be_that_of_a_body() {
        check(1.0, [0.01, 0.01, 0.0004], None);
        check(1.0, [1.0, 1.0, 1.0], None);
        check(0.0001, [0.0, 0.0, 0.0], None);
        // A thin plate has equality, and files round.
        check(1.0, [0.010, 0.010, 0.020_001], None);
        check(1.0, [-0.04, 0.01, 0.05], Some("inertia"));
        check(1.0, [-0.01, -0.01, -0.01], Some("inertia"));
        check(1.0, [0.05, 0.01, 0.01], Some("inertia"));
        check(-1.0, [1.0, 1.0, 1.0], Some("mass"));
        check(1.0, [1e-310, 1e-310, 1e-310], None);
        check(1.0, [1e307, 1e307, 1e307], Some("size"));
        check(1.3, [10_000.0, 10_000.0, 400.0], Some("size"));
    }
}
