//! The features that the checks of units compare: sizes of links, radii of gyration, densities, and which tensors are
//! placeholders.

use congruent_description::{Extent, Geometry, Inertia, Joint, LinkIndex, Robot, Shape};
use nalgebra::Vector3;

use super::thresholds::{LARGEST_MARKER_M, LEAST_BODY_KG};

/// Whether a shape only marks a place, such as a ball of a millimetre, and does not show the size of its link.
fn is_marker(shape: &Shape) -> bool {
    let is_mesh = matches!(shape.geometry, Geometry::Mesh(_));
    !is_mesh && diagonal_m(shape).is_some_and(|diagonal| diagonal < LARGEST_MARKER_M)
}

/// The diagonal of the box around one shape, m; `None` without vertices.
pub(super) fn diagonal_m(shape: &Shape) -> Option<f64> {
    Extent::of_geometry(&shape.geometry).map(|extent| extent.diagonal_m())
}

/// The sizes of a robot and of its links.
pub(super) struct Sizes {
    /// The box around the shapes of each link, in the link frame; `None` without shapes.
    pub(super) shapes: Vec<Option<Extent>>,
    /// Whether all shapes of a link are balls, so that its tensor is that of a ball.
    balls: Vec<bool>,
    /// Sum of the lengths of all joint origins, m.
    pub(super) origins_m: f64,
    /// Length of the longest joint origin, m.
    pub(super) longest_origin_m: f64,
    /// For each link whether a joint below it moves.
    pub(super) carries_joint: Vec<bool>,
    /// For each link an upper bound of the distance from its origin to any part below it, m.
    pub(super) below_m: Vec<f64>,
}

impl Sizes {
    pub(super) fn measure(robot: &Robot) -> Self {
        let around = |link: LinkIndex| {
            let link = robot.link(link);
            let shapes = link.visuals.iter().chain(&link.collisions).filter(|shape| !is_marker(shape));
            shapes.filter_map(Extent::of_shape).reduce(Extent::with)
        };
        let shapes: Vec<Option<Extent>> = robot.link_indices().map(around).collect();
        let balls = robot.links().iter().map(|link| {
            let mut shapes = link.visuals.iter().chain(&link.collisions).peekable();
            shapes.peek().is_some() && shapes.all(|shape| matches!(shape.geometry, Geometry::Sphere { .. }))
        });
        let balls = balls.collect();
        let lengths = || robot.joints().iter().map(|joint| joint.parent_from_joint.translation.vector.norm());
        let mut below_m: Vec<f64> =
            shapes.iter().map(|shapes| shapes.map_or(0.0, |shapes| shapes.farthest_m())).collect();
        // Parents come first, so children are complete when they are reached backwards.
        for (joint, length) in robot.joints().iter().zip(lengths()).rev() {
            let child = below_m[joint.child.get()];
            let parent = &mut below_m[joint.parent.get()];
            // The stretched path: an upper bound of what any configuration reaches.
            *parent = parent.max(length + child);
        }
        let mut carries_joint = vec![false; robot.links().len()];
        for joint in robot.joints().iter().rev() {
            carries_joint[joint.parent.get()] |= joint.kind.is_movable() || carries_joint[joint.child.get()];
        }
        Self {
            shapes,
            balls,
            carries_joint,
            origins_m: lengths().sum(),
            longest_origin_m: lengths().fold(0.0, f64::max),
            below_m,
        }
    }

    /// An upper bound of the distance from the axis of a joint to any part that the joint carries, m.
    pub(super) fn radius_m(&self, robot: &Robot, joint: &Joint) -> f64 {
        let axis = joint.axis_in_joint.into_inner();
        let from_axis_m = |point: Vector3<f64>| (point - axis * axis.dot(&point)).norm();
        let corners = self.shapes[joint.child.get()].iter().flat_map(Extent::corners);
        let carried = robot.joints().iter().filter(|other| other.parent == joint.child).map(|other| {
            from_axis_m(other.parent_from_joint.translation.vector) + self.below_m[other.child.get()]
        });
        corners.map(from_axis_m).chain(carried).fold(0.0, f64::max)
    }

    /// The size of the robot, m: the sum of all joint origins, or the diagonal of its largest link if that is more.
    pub(super) fn robot_m(&self) -> f64 {
        let shapes = self.shapes.iter().flatten().map(Extent::diagonal_m);
        shapes.fold(self.origins_m, f64::max)
    }
}

/// The radius of gyration and the density that follow from the mass and the tensor of a link.
#[derive(Debug, Clone, Copy)]
pub(super) struct LinkInertiaFeatures {
    pub(super) link: LinkIndex,
    pub(super) mass_kg: f64,
    /// Radius of gyration of the mean principal moment, m.
    pub(super) gyration_m: f64,
    /// Density of the solid sphere with this mass and this mean moment, kg/m^3.
    pub(super) sphere_density: f64,
    /// Whether the tensor is a placeholder: equal moments on a link that is no ball, or entries of one digit.
    pub(super) is_placeholder: bool,
    /// The box around the shapes of the link; `None` without extent.
    pub(super) shapes: Option<Extent>,
}

impl LinkInertiaFeatures {
    /// `None` for a link that is too light for a body, for a tensor of zero, and for the placeholder of 1 kg m^2, which is no
    /// mistake of a unit and is reported separately.
    pub(super) fn from_inertia(link: LinkIndex, inertia: &Inertia, sizes: &Sizes) -> Option<Self> {
        Self::of_any_mass(link, inertia, sizes).filter(|_| inertia.mass_kg >= LEAST_BODY_KG)
    }

    /// The same of any link with a mass, also of one that is too light for a body.
    pub(super) fn of_any_mass(link: LinkIndex, inertia: &Inertia, sizes: &Sizes) -> Option<Self> {
        let trace = inertia.tensor_kg_m2.trace();
        if !(inertia.mass_kg > 0.0 && trace > 0.0) || inertia.is_example() {
            return None;
        }
        let gyration_m = (trace / 3.0 / inertia.mass_kg).sqrt();
        // A solid sphere has I = 2/5 m r^2.
        let radius_m = gyration_m * 2.5_f64.sqrt();
        let sphere_density = inertia.mass_kg / (4.0 / 3.0 * std::f64::consts::PI * radius_m.powi(3));
        let tensor = &inertia.tensor_kg_m2;
        let is_ball = *tensor == nalgebra::Matrix3::from_diagonal_element(tensor[(0, 0)]);
        // Equal moments without products, or one digit in each entry: typed in, not computed.
        let is_placeholder =
            (is_ball && !sizes.balls[link.get()]) || tensor.iter().all(|entry| has_one_digit(*entry));
        let shapes = sizes.shapes[link.get()].filter(|shapes| shapes.diagonal_m() > 0.0);
        Some(Self { link, mass_kg: inertia.mass_kg, gyration_m, sphere_density, is_placeholder, shapes })
    }

    /// Radius of gyration over the diagonal of the shapes; 0.29 for a solid rod.
    pub(super) fn gyration_share(&self) -> Option<f64> {
        Some(self.gyration_m / self.shapes?.diagonal_m())
    }

    /// Mass over the volume of the box around the shapes, kg/m^3.
    pub(super) fn box_density(&self) -> Option<f64> {
        Some(self.mass_kg / self.shapes?.volume_m3())
    }
}

/// Whether a value is zero or has one significant digit, as in 0.001.
pub(super) fn has_one_digit(value: f64) -> bool {
    let text = format!("{:e}", value.abs());
    value == 0.0 || text.split('e').next().is_some_and(|digits| digits.len() == 1)
}

/// The median; of an even number of values the lower of the two middle ones, so that it is a value that occurs.
pub(super) fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    // The lower of two middle ones, so that it is one of the values.
    values.get(values.len().checked_sub(1)? / 2).copied()
}
