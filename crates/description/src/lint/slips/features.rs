//! What the judgements compare: how large links are, and which values are placeholders.

use nalgebra::Vector3;

use super::thresholds::{LARGEST_MARKER_M, LEAST_BODY_KG};
use crate::model::{Extent, Geometry, Inertia, Joint, LinkIndex, Robot, Shape};

/// Whether a shape only marks a place, such as a ball of a millimetre: it says nothing of the size of its link.
fn is_marker(shape: &Shape) -> bool {
    let is_mesh = matches!(shape.geometry, Geometry::Mesh(_));
    !is_mesh && diagonal_m(shape).is_some_and(|diagonal| diagonal < LARGEST_MARKER_M)
}

/// The diagonal of one shape.
pub(super) fn diagonal_m(shape: &Shape) -> Option<f64> {
    Extent::of_geometry(&shape.geometry).map(|extent| extent.diagonal_m())
}

/// The sizes of a robot and of its links.
pub(super) struct Sizes {
    /// Around the shapes of each link; `None` without shapes.
    pub(super) shapes: Vec<Option<Extent>>,
    /// Whether all shapes of a link are balls, so that its tensor is that of a ball.
    balls: Vec<bool>,
    /// Sum of the lengths of all joint origins.
    pub(super) origins_m: f64,
    /// The longest joint origin.
    pub(super) longest_origin_m: f64,
    /// An upper bound of how far what hangs on each link is from the link's origin.
    pub(super) below_m: Vec<f64>,
}

impl Sizes {
    pub(super) fn of(robot: &Robot) -> Self {
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
            *parent = parent.max(length + child);
        }
        Self {
            shapes,
            balls,
            origins_m: lengths().sum(),
            longest_origin_m: lengths().fold(0.0, f64::max),
            below_m,
        }
    }

    /// An upper bound of how far what a joint carries is from its axis.
    pub(super) fn radius_m(&self, robot: &Robot, joint: &Joint) -> f64 {
        let axis = joint.axis_in_joint.into_inner();
        let from_axis_m = |point: Vector3<f64>| (point - axis * axis.dot(&point)).norm();
        let corners = self.shapes[joint.child.get()].iter().flat_map(Extent::corners);
        let carried = robot.joints().iter().filter(|other| other.parent == joint.child).map(|other| {
            from_axis_m(other.parent_from_joint.translation.vector) + self.below_m[other.child.get()]
        });
        corners.map(from_axis_m).chain(carried).fold(0.0, f64::max)
    }

    /// The size of the robot: what all joint origins make in a row, or its largest link.
    pub(super) fn robot_m(&self) -> f64 {
        let shapes = self.shapes.iter().flatten().map(Extent::diagonal_m);
        shapes.fold(self.origins_m, f64::max)
    }
}

/// What the mass and the tensor of a link imply.
#[derive(Debug, Clone, Copy)]
pub(super) struct Body {
    pub(super) link: LinkIndex,
    pub(super) mass_kg: f64,
    /// Of the mean principal moment.
    pub(super) gyration_m: f64,
    /// Of the solid sphere with this mass and this mean moment.
    pub(super) sphere_density: f64,
    /// Whether the tensor is one that people write when they know none.
    pub(super) is_placeholder: bool,
    /// The box around its shapes.
    pub(super) shapes: Option<Extent>,
}

impl Body {
    /// `None` without the mass of a body or a tensor other than zero, and of that of examples, which is no slip of a unit.
    pub(super) fn of(link: LinkIndex, inertia: &Inertia, sizes: &Sizes) -> Option<Self> {
        let trace = inertia.tensor_kg_m2.trace();
        if !(inertia.mass_kg >= LEAST_BODY_KG && trace > 0.0) || inertia.is_example() {
            return None;
        }
        let gyration_m = (trace / 3.0 / inertia.mass_kg).sqrt();
        let radius_m = gyration_m * 2.5_f64.sqrt();
        let sphere_density = inertia.mass_kg / (4.0 / 3.0 * std::f64::consts::PI * radius_m.powi(3));
        let tensor = &inertia.tensor_kg_m2;
        let is_ball = *tensor == nalgebra::Matrix3::from_diagonal_element(tensor[(0, 0)]);
        let is_placeholder =
            (is_ball && !sizes.balls[link.get()]) || tensor.iter().all(|entry| has_one_digit(*entry));
        let shapes = sizes.shapes[link.get()].filter(|shapes| shapes.diagonal_m() > 0.0);
        Some(Self { link, mass_kg: inertia.mass_kg, gyration_m, sphere_density, is_placeholder, shapes })
    }

    /// Radius of gyration against the diagonal of the shapes.
    pub(super) fn gyration_share(&self) -> Option<f64> {
        Some(self.gyration_m / self.shapes?.diagonal_m())
    }

    /// Mass over the volume of the box around the shapes.
    pub(super) fn box_density(&self) -> Option<f64> {
        Some(self.mass_kg / self.shapes?.volume_m3())
    }
}

/// Whether a value is zero or has one significant digit, as in 0.001.
fn has_one_digit(value: f64) -> bool {
    let text = format!("{:e}", value.abs());
    value == 0.0 || text.split('e').next().is_some_and(|digits| digits.len() == 1)
}

/// The middle value; of an even number the lower one.
pub(super) fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len().checked_sub(1)? / 2).copied()
}
