//! The inertial parameters of one link as they are written in its file: hypotheses change these parameters.

use congruent_description::{Inertia, principal_moments};
use congruent_dynamics::{PARAMETERS, SpatialInertia};
use nalgebra::{Isometry3, Matrix3, Rotation3, SVector, Translation3, UnitQuaternion, Vector3};

/// The ten inertial parameters of a link about its origin, in the order of [`SpatialInertia::parameters`].
pub(crate) type TenNumbers = SVector<f64, PARAMETERS>;

/// The parameters of an `<inertial>` element.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | `mass_kg` | 1 | kg | |
/// | `com_m` | 3 | m | link |
/// | `link_from_axes` | 3 x 3 | | axes of the inertial frame, in the link |
/// | `tensor_kg_m2` | 3 x 3 | kg m^2 | about the centre of mass, in the axes of the inertial frame |
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertial {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass in the link, m.
    pub com_m: Vector3<f64>,
    /// Axes of the inertial frame in the link.
    pub link_from_axes: Matrix3<f64>,
    /// Inertia tensor about the centre of mass, in the axes of the inertial frame, kg m^2.
    pub tensor_kg_m2: Matrix3<f64>,
}

impl Inertial {
    /// An inertial without mass and inertia, at the link's origin.
    pub fn nothing() -> Self {
        Self {
            mass_kg: 0.0,
            com_m: Vector3::zeros(),
            link_from_axes: Matrix3::identity(),
            tensor_kg_m2: Matrix3::zeros(),
        }
    }

    /// The same as an inertia of a link.
    pub fn to_inertia(self) -> Inertia {
        let rotation = Rotation3::from_matrix_unchecked(self.link_from_axes);
        Inertia {
            mass_kg: self.mass_kg,
            link_from_inertial: Isometry3::from_parts(
                Translation3::from(self.com_m),
                UnitQuaternion::from_rotation_matrix(&rotation),
            ),
            tensor_kg_m2: self.tensor_kg_m2,
        }
    }

    /// The inertia about the link's origin, in the link's axes.
    pub fn about_origin(&self) -> SpatialInertia {
        let mut inertia = SpatialInertia::point_mass(self.mass_kg, self.com_m);
        inertia.tensor_kg_m2 += self.tensor_in_link();
        inertia
    }

    /// The tensor about the centre of mass, in the link's axes.
    pub fn tensor_in_link(&self) -> Matrix3<f64> {
        self.link_from_axes * self.tensor_kg_m2 * self.link_from_axes.transpose()
    }

    /// The parallel-axis term: the tensor about the link's origin minus that about the centre of mass, in the link's axes.
    pub fn shift(&self) -> Matrix3<f64> {
        SpatialInertia::point_mass(self.mass_kg, self.com_m).tensor_kg_m2
    }

    /// The parameters of an inertia about the link's origin, with the tensor in these axes; without mass, the centre of
    /// mass is the origin.
    pub(crate) fn from_origin(inertia: &SpatialInertia, link_from_axes: Matrix3<f64>) -> Self {
        let com_m = if inertia.mass_kg == 0.0 {
            Vector3::zeros()
        } else {
            inertia.first_moment_kg_m / inertia.mass_kg
        };
        let mut parameters =
            Self { mass_kg: inertia.mass_kg, com_m, link_from_axes, tensor_kg_m2: Matrix3::zeros() };
        // Steiner: tensor about the origin = tensor about the centre of mass + m (|c|^2 I - c c').
        let about_com = inertia.tensor_kg_m2 - parameters.shift();
        parameters.tensor_kg_m2 = link_from_axes.transpose() * about_com * link_from_axes;
        parameters
    }

    /// With the tensor in the link's axes replaced; the axes stay.
    pub(crate) fn with_tensor_in_link(&self, tensor: &Matrix3<f64>) -> Self {
        let axes = self.link_from_axes;
        Self { tensor_kg_m2: axes.transpose() * tensor * axes, ..*self }
    }

    pub(crate) fn ten_numbers(&self) -> TenNumbers {
        self.about_origin().parameters().into()
    }

    /// The law of rigid bodies that these parameters break; `None` if they are physically possible.
    pub fn law_broken(&self, reach_m: f64) -> Option<BodyLaw> {
        if self.mass_kg <= 0.0 {
            return Some(BodyLaw::Mass);
        }
        if !self.tensor_kg_m2.amax().is_finite() {
            return Some(BodyLaw::Size);
        }
        // Laws from the simplest to the most specific: the first broken one is the most helpful to name.
        let [least, middle, most] = principal_moments(&self.tensor_kg_m2);
        if least < -MOMENT * most.abs() || most < 0.0 {
            Some(BodyLaw::Moments)
        } else if least + middle < most * (1.0 - MOMENT) {
            Some(BodyLaw::Triangle)
        } else if most / self.mass_kg > reach_m * reach_m {
            Some(BodyLaw::Size)
        } else {
            None
        }
    }
}

/// Tolerance of the laws, relative to the largest principal moment. No unit; kind: digits of a file, as the URDF reader allows
/// them.
const MOMENT: f64 = 1e-6;

/// A law that the inertial parameters of every rigid body obey.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BodyLaw {
    /// Its mass is positive.
    Mass,
    /// Its principal moments are positive.
    Moments,
    /// Its largest principal moment is at most the sum of the others.
    Triangle,
    /// Its radius of gyration is below the reach of the arm.
    Size,
}

impl BodyLaw {
    /// The broken law of written values, as a clause about the link.
    pub fn is_broken(self) -> &'static str {
        match self {
            Self::Mass => "its mass is not positive",
            Self::Moments => "a principal moment of inertia is negative",
            Self::Triangle => "its largest principal moment of inertia exceeds the sum of the others",
            Self::Size => "its radius of gyration exceeds the reach of the arm",
        }
    }

    /// The broken law of corrected values, as a clause about the link.
    pub fn broken(self) -> &'static str {
        match self {
            Self::Mass => "its mass would not be positive",
            Self::Moments => "a principal moment of inertia would be negative",
            Self::Triangle => "its largest principal moment would exceed the sum of the others",
            Self::Size => "its radius of gyration would exceed the reach of the arm",
        }
    }
}

impl From<&Inertia> for Inertial {
    fn from(inertia: &Inertia) -> Self {
        Self {
            mass_kg: inertia.mass_kg,
            com_m: inertia.link_from_inertial.translation.vector,
            link_from_axes: inertia.link_from_inertial.rotation.to_rotation_matrix().into_inner(),
            tensor_kg_m2: inertia.tensor_kg_m2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned() -> Inertial {
        Inertial {
            mass_kg: 2.0,
            com_m: Vector3::new(0.1, -0.2, 0.3),
            link_from_axes: congruent_kinematics::rotation_exp(&Vector3::new(0.4, -0.5, 0.6)),
            tensor_kg_m2: Matrix3::new(3.0, 0.1, 0.2, 0.1, 4.0, 0.3, 0.2, 0.3, 5.0) * 1e-2,
        }
    }

    #[test]
    fn parameters_come_back_from_the_ten_numbers() {
        let parameters = turned();
        let back = Inertial::from_origin(&parameters.about_origin(), parameters.link_from_axes);
        assert!((back.tensor_kg_m2 - parameters.tensor_kg_m2).amax() < 1e-16, "{back:?}");
        assert!((back.com_m - parameters.com_m).amax() < 1e-16);
    }

    #[test]
    fn each_law_is_noticed() {
        let parameters = turned();
        let moments =
            |x, y, z| Inertial { tensor_kg_m2: Matrix3::from_diagonal(&Vector3::new(x, y, z)), ..parameters };
        assert_eq!(parameters.law_broken(1.0), None);
        assert_eq!(Inertial { mass_kg: -1.0, ..parameters }.law_broken(1.0), Some(BodyLaw::Mass));
        assert_eq!(moments(1.0, -0.1, 1.0).law_broken(1.0), Some(BodyLaw::Moments));
        assert_eq!(moments(1.0, 1.0, 2.1).law_broken(1.0), Some(BodyLaw::Triangle));
        assert_eq!(moments(3.0, 3.0, 3.0).law_broken(1.0), Some(BodyLaw::Size));
        assert_eq!(moments(0.0, 0.0, 0.0).law_broken(1.0), None);
    }
}
