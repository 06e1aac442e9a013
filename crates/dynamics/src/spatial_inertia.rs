//! Mass, first moment and rotational inertia of a rigid body about the origin of a frame: the ten inertial parameters, in
//! which torques are linear.

use std::ops::{Add, AddAssign};

use congruent_description::Inertia;
use congruent_kinematics::{Pose, Twist, Wrench};
use nalgebra::{Isometry3, Matrix3, UnitQuaternion, Vector3};

/// Inertia of a rigid body in a frame; unlike mass and centre of mass, these parameters add up over bodies.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | `mass_kg` | 1 | kg | |
/// | `first_moment_kg_m` | 3 | kg m | mass times centre of mass, in the named frame |
/// | `tensor_kg_m2` | 3 x 3 | kg m^2 | about the origin of the named frame, in its axes |
///
/// # Examples
/// Two balls of 1 kg on the x axis:
/// ```
/// use congruent_dynamics::SpatialInertia;
/// use nalgebra::Vector3;
/// let near = SpatialInertia::point_mass(1.0, Vector3::new(0.5, 0.0, 0.0));
/// let both = near + SpatialInertia::point_mass(1.0, Vector3::new(1.5, 0.0, 0.0));
/// assert_eq!(both.mass_kg, 2.0);
/// assert_eq!(both.first_moment_kg_m / both.mass_kg, Vector3::new(1.0, 0.0, 0.0));
/// assert_eq!(both.tensor_kg_m2[(2, 2)], 2.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialInertia {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Mass times centre of mass, kg m.
    pub first_moment_kg_m: Vector3<f64>,
    /// Rotational inertia about the frame's origin, kg m^2.
    pub tensor_kg_m2: Matrix3<f64>,
}

/// Number of inertial parameters of a body.
pub const PARAMETERS: usize = 10;

/// Symbols of [`SpatialInertia::parameters`], in their order.
pub const PARAMETER_NAMES: [&str; PARAMETERS] =
    ["ixx", "ixy", "ixz", "iyy", "iyz", "izz", "mx", "my", "mz", "m"];

impl SpatialInertia {
    /// The inertia of a body without mass.
    pub fn zero() -> Self {
        Self { mass_kg: 0.0, first_moment_kg_m: Vector3::zeros(), tensor_kg_m2: Matrix3::zeros() }
    }

    /// A mass at one point.
    pub fn point_mass(mass_kg: f64, position: Vector3<f64>) -> Self {
        Self {
            mass_kg,
            first_moment_kg_m: position * mass_kg,
            // `shift(p, m p) = 2 m (p.p 1 - p p')`, twice the inertia of the point.
            tensor_kg_m2: shift(&position, &(position * mass_kg)) / 2.0,
        }
    }

    /// The inertia of a link about the link's own origin.
    pub fn from_link(inertia: &Inertia) -> Self {
        let about_center = Self {
            mass_kg: inertia.mass_kg,
            first_moment_kg_m: Vector3::zeros(),
            tensor_kg_m2: inertia.tensor_kg_m2,
        };
        about_center.transformed_by(&inertia.link_from_inertial.into())
    }

    /// The inertia of a link with these numbers; `None` without mass, as there is then no centre of mass.
    ///
    /// # Examples
    /// ```
    /// use congruent_dynamics::SpatialInertia;
    /// use nalgebra::Vector3;
    /// let ball = SpatialInertia::point_mass(2.0, Vector3::new(0.5, 0.0, 0.0));
    /// let inertia = ball.to_link().unwrap();
    /// assert_eq!(inertia.link_from_inertial.translation.vector.x, 0.5);
    /// assert_eq!(SpatialInertia::from_link(&inertia), ball);
    /// ```
    pub fn to_link(&self) -> Option<Inertia> {
        let has_mass = self.mass_kg.is_finite() && self.mass_kg > 0.0;
        // Infinite without a mass, but then not used.
        let center = self.first_moment_kg_m / self.mass_kg;
        has_mass.then(|| Inertia {
            mass_kg: self.mass_kg,
            link_from_inertial: Isometry3::from_parts(center.into(), UnitQuaternion::identity()),
            tensor_kg_m2: self.tensor_kg_m2 - Self::point_mass(self.mass_kg, center).tensor_kg_m2,
        })
    }

    /// The same body in frame a, given in frame b.
    ///
    /// Source: Featherstone, *Rigid Body Dynamics Algorithms* (2008), eq. 2.66, with the tensor about the origin.
    ///
    /// # Examples
    /// ```
    /// use congruent_dynamics::SpatialInertia;
    /// use congruent_kinematics::Pose;
    /// use nalgebra::{Matrix3, Vector3};
    /// let ball = SpatialInertia::point_mass(2.0, Vector3::zeros());
    /// let a_from_b = Pose::from_parts(Matrix3::identity(), Vector3::new(0.0, 3.0, 0.0));
    /// assert_eq!(ball.transformed_by(&a_from_b), SpatialInertia::point_mass(2.0, a_from_b.translation));
    /// ```
    #[inline]
    #[must_use]
    pub fn transformed_by(&self, a_from_b: &Pose) -> Self {
        let (turn, origin) = (&a_from_b.rotation, &a_from_b.translation);
        let turned = turn * self.first_moment_kg_m;
        let tensor = turn * self.tensor_kg_m2 * turn.transpose();
        Self {
            mass_kg: self.mass_kg,
            first_moment_kg_m: turned + origin * self.mass_kg,
            // Steiner about any point: `-[p][b] - [b][p]` for `b = h + m p / 2`; no centre of mass is needed, so a
            // mass of zero is no special case.
            tensor_kg_m2: tensor + shift(origin, &(turned * 2.0 + origin * self.mass_kg)) / 2.0,
        }
    }

    /// Momentum of the body that moves with a twist: angular momentum about the origin, then linear momentum.
    #[inline]
    pub fn momentum(&self, twist: &Twist) -> Wrench {
        let h = &self.first_moment_kg_m;
        Wrench {
            moment: self.tensor_kg_m2 * twist.angular + h.cross(&twist.linear),
            force: twist.linear * self.mass_kg - h.cross(&twist.angular),
        }
    }

    /// The ten parameters: `ixx ixy ixz iyy iyz izz` about the origin, then the first moment, then the mass.
    pub fn parameters(&self) -> [f64; PARAMETERS] {
        let (tensor, h) = (&self.tensor_kg_m2, &self.first_moment_kg_m);
        [
            tensor[(0, 0)],
            tensor[(0, 1)],
            tensor[(0, 2)],
            tensor[(1, 1)],
            tensor[(1, 2)],
            tensor[(2, 2)],
            h.x,
            h.y,
            h.z,
            self.mass_kg,
        ]
    }

    /// The inertia with these ten parameters, in the order of [`SpatialInertia::parameters`].
    pub fn from_parameters([xx, xy, xz, yy, yz, zz, mx, my, mz, mass_kg]: [f64; PARAMETERS]) -> Self {
        Self {
            mass_kg,
            first_moment_kg_m: Vector3::new(mx, my, mz),
            tensor_kg_m2: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
        }
    }
}

/// `-[a][b] - [b][a]`; for `b = m a` this is twice the tensor of a mass `m` at `a`.
#[inline]
fn shift(a: &Vector3<f64>, b: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(2.0 * a.dot(b)) - a * b.transpose() - b * a.transpose()
}

impl Add for SpatialInertia {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl AddAssign for SpatialInertia {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.mass_kg += other.mass_kg;
        self.first_moment_kg_m += other.first_moment_kg_m;
        self.tensor_kg_m2 += other.tensor_kg_m2;
    }
}
