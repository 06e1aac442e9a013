//! Shapes of links that are far from every obstacle are balls for rapier, which bounds every shape anew in every step:
//! a ball costs it nothing, a cylinder six support points. They get their own shapes before they come near.

use rapier3d_f64::prelude::{
    Aabb, ColliderHandle, ColliderSet, RigidBodyHandle, RigidBodySet, SharedShape, Vector,
};

/// A link gets its real shape if it may be nearer than this to an obstacle; rapier's contacts begin to act at 2 mm.
const MARGIN_M: f64 = 0.02;

/// Shortest displacement of a shape after which its distances are measured again: a shape that stays near is measured once
/// in each 20 mm, however many obstacles there are.
const LOOK_M: f64 = 0.02;

/// The shapes of the links, and the bounds of the obstacles at rest.
#[derive(Clone, Default)]
pub(crate) struct NearShapes {
    shapes: Vec<LinkShape>,
    obstacles: Vec<Aabb>,
}

/// A shape of a link, in a ball about the origin of its frame.
#[derive(Clone)]
struct LinkShape {
    collider: ColliderHandle,
    body: RigidBodyHandle,
    center_in_body: Vector,
    radius_m: f64,
    own: SharedShape,
    ball: SharedShape,
    is_far: bool,
    /// Position of the ball's centre when distances were last measured.
    center_then: Vector,
    /// Displacement from there within which the choice of the shape cannot change.
    path_m: f64,
}

impl NearShapes {
    /// The shapes of complete colliders, all real at first.
    pub(crate) fn new(
        colliders: &ColliderSet,
        links: &[ColliderHandle],
        obstacles: &[ColliderHandle],
    ) -> Self {
        let of_link = |&handle: &ColliderHandle| {
            let collider = colliders.get(handle)?;
            let bounds = collider.shape().compute_local_bounding_sphere();
            let radius_m = bounds.center.length() + bounds.radius;
            Some(LinkShape {
                collider: handle,
                body: collider.parent()?,
                center_in_body: collider.position_wrt_parent()?.translation,
                radius_m,
                own: collider.shared_shape().clone(),
                ball: SharedShape::ball(radius_m),
                is_far: false,
                center_then: Vector::ZERO,
                // Less than any displacement: distances have not been measured.
                path_m: -1.0,
            })
        };
        let of_obstacle = |&collider: &ColliderHandle| Some(colliders.get(collider)?.compute_aabb());
        Self {
            shapes: links.iter().filter_map(of_link).collect(),
            obstacles: obstacles.iter().filter_map(of_obstacle).collect(),
        }
    }

    /// Gives links that came near an obstacle their real shapes, and links that moved away their balls.
    ///
    /// Disabled colliders would cost less still, but rapier sums masses over those that are enabled, and the last bits
    /// of a motion would depend on what is near.
    pub(crate) fn set_shapes(&mut self, colliders: &mut ColliderSet, bodies: &RigidBodySet) {
        for shape in &mut self.shapes {
            let body = bodies.get(shape.body).expect("the body exists");
            let center = body.position().transform_point(shape.center_in_body);
            // False for NaN, too: the shape then becomes real, so that rapier finds the state that is not finite.
            if center.distance(shape.center_then) <= shape.path_m {
                continue;
            }
            let distances = self.obstacles.iter().map(|bounds| {
                // Distance to the box around the obstacle, a lower bound of that to the obstacle.
                let nearest = center.max(bounds.mins).min(bounds.maxs);
                center.distance(nearest) - shape.radius_m
            });
            let free_m = distances.fold(f64::INFINITY, f64::min) - MARGIN_M;
            // Nearer than `LOOK_M` a ball could not move far before the next look: the real shape stays.
            let is_far = center.is_finite() && free_m > LOOK_M;
            (shape.center_then, shape.path_m) = (center, if is_far { free_m } else { LOOK_M });
            if shape.is_far != is_far {
                shape.is_far = is_far;
                let collider = colliders.get_mut(shape.collider).expect("the collider exists");
                collider.set_shape(if is_far { shape.ball.clone() } else { shape.own.clone() });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::{ColliderBuilder, RigidBodyBuilder};

    use super::*;

    /// Whether a cube in a ball of 0.1 m has its own shape when the ball is at each of these heights above a floor.
    fn own_at(heights_m: &[f64]) -> Vec<bool> {
        let (mut colliders, mut bodies) = (ColliderSet::new(), RigidBodySet::new());
        let link = bodies.insert(RigidBodyBuilder::dynamic());
        let half_m = 0.1 / f64::sqrt(3.0);
        let cube = ColliderBuilder::cuboid(half_m, half_m, half_m).translation(Vector::new(0.0, 0.0, 0.1));
        let cube = colliders.insert_with_parent(cube, link, &mut bodies);
        let floor = ColliderBuilder::cuboid(1.0, 1.0, 0.5).translation(Vector::new(0.0, 0.0, -0.5));
        let floor = colliders.insert(floor);
        let mut near = NearShapes::new(&colliders, &[cube], &[floor]);
        let own = heights_m.iter().map(|height_m| {
            bodies[link].set_translation(Vector::new(0.3, 0.2, *height_m), true);
            near.set_shapes(&mut colliders, &bodies);
            colliders[cube].shape().as_cuboid().is_some()
        });
        own.collect()
    }

    #[test]
    fn a_shape_is_its_own_before_it_touches_and_a_ball_when_it_has_left() {
        let heights_m = [1.0, 0.5, 0.05, 0.019, 0.0, 0.03, 0.1, 1.0];
        assert_eq!(own_at(&heights_m), [false, false, false, true, true, true, false, false]);
    }

    #[test]
    fn a_jump_is_not_missed() {
        assert_eq!(own_at(&[5.0, 0.001, 5.0]), [false, true, false]);
    }

    #[test]
    fn in_a_slow_approach_it_is_its_own_everywhere_within_the_margin() {
        let heights_m: Vec<f64> = (0..=300).rev().map(|millimetres| f64::from(millimetres) * 1e-3).collect();
        let own = own_at(&heights_m);
        let within = heights_m.iter().position(|&height_m| height_m < MARGIN_M).expect("it arrives");
        assert!(own[within..].iter().all(|&is_own| is_own));
        assert!(!own[..within / 2].iter().any(|&is_own| is_own), "far away");
    }

    #[test]
    fn what_is_not_a_number_stays_for_rapier_to_see() {
        assert_eq!(own_at(&[1.0, f64::NAN, 1.0]), [false, true, false]);
    }
}
