//! Shapes of links that are far from every obstacle, which rapier need not bound and sort in every step: they are
//! disabled there until they come near. Nothing touches in between, so that no motion depends on it.

use rapier3d_f64::prelude::{Aabb, ColliderHandle, ColliderSet, RigidBodyHandle, RigidBodySet, Vector};

/// A shape is enabled if it may be nearer than this to an obstacle; rapier's contacts begin to act at 2 mm.
const MARGIN_M: f64 = 0.02;

/// Way of a shape after which its distances are measured again, at least: a shape that stays near costs one look in
/// each 20 mm, however many obstacles there are.
const LOOK_M: f64 = 0.02;

/// The shapes of the links, and where obstacles stand still.
#[derive(Debug, Clone, Default)]
pub(crate) struct NearShapes {
    shapes: Vec<LinkShape>,
    obstacles: Vec<Aabb>,
}

/// A shape of a link in its bounding sphere.
#[derive(Debug, Clone)]
struct LinkShape {
    collider: ColliderHandle,
    body: RigidBodyHandle,
    center_in_body: Vector,
    radius_m: f64,
    is_enabled: bool,
    /// Where the sphere's centre was when distances were measured last.
    center_then: Vector,
    /// How far from there nothing changes.
    way_m: f64,
}

impl NearShapes {
    /// Of colliders that are complete. Obstacles that move would have to be followed: beside one, all shapes stay enabled.
    pub(crate) fn new(
        colliders: &ColliderSet,
        links: &[ColliderHandle],
        obstacles: &[ColliderHandle],
    ) -> Self {
        let of_link = |&collider: &ColliderHandle| {
            let shape = colliders.get(collider)?;
            let bounds = shape.shape().compute_local_bounding_sphere();
            Some(LinkShape {
                collider,
                body: shape.parent()?,
                center_in_body: shape.position_wrt_parent()?.transform_point(bounds.center),
                radius_m: bounds.radius,
                is_enabled: true,
                center_then: Vector::ZERO,
                // Less than any way: distances have not been measured.
                way_m: -1.0,
            })
        };
        let of_obstacle = |&collider: &ColliderHandle| Some(colliders.get(collider)?.compute_aabb());
        Self {
            shapes: links.iter().filter_map(of_link).collect(),
            obstacles: obstacles.iter().filter_map(of_obstacle).collect(),
        }
    }

    /// Enables the shapes that are near an obstacle where they stand now, and disables the others.
    pub(crate) fn enable_in(&mut self, colliders: &mut ColliderSet, bodies: &RigidBodySet) {
        for shape in &mut self.shapes {
            let body = bodies.get(shape.body).expect("the body exists");
            let center = body.position().transform_point(shape.center_in_body);
            // False as well if a number is none: then rapier is to see the shape.
            if center.distance(shape.center_then) <= shape.way_m {
                continue;
            }
            let distances = self.obstacles.iter().map(|bounds| {
                let nearest = center.max(bounds.mins).min(bounds.maxs);
                center.distance(nearest) - shape.radius_m
            });
            let free_m = distances.fold(f64::INFINITY, f64::min) - MARGIN_M;
            let is_far = center.is_finite() && free_m > LOOK_M;
            (shape.center_then, shape.way_m) = (center, if is_far { free_m } else { LOOK_M });
            if shape.is_enabled == is_far {
                shape.is_enabled = !is_far;
                let collider = colliders.get_mut(shape.collider).expect("the collider exists");
                collider.set_enabled(!is_far);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::{ColliderBuilder, RigidBodyBuilder};

    use super::*;

    /// Whether a ball of 0.1 m is enabled when its surface is at each of these heights above a floor.
    fn enabled_at(heights_m: &[f64]) -> Vec<bool> {
        let (mut colliders, mut bodies) = (ColliderSet::new(), RigidBodySet::new());
        let link = bodies.insert(RigidBodyBuilder::dynamic());
        let ball = ColliderBuilder::ball(0.1).translation(Vector::new(0.0, 0.0, 0.1));
        let ball = colliders.insert_with_parent(ball, link, &mut bodies);
        let floor = ColliderBuilder::cuboid(1.0, 1.0, 0.5).translation(Vector::new(0.0, 0.0, -0.5));
        let floor = colliders.insert(floor);
        let mut near = NearShapes::new(&colliders, &[ball], &[floor]);
        let enabled = heights_m.iter().map(|height_m| {
            bodies[link].set_translation(Vector::new(0.3, 0.2, *height_m), true);
            near.enable_in(&mut colliders, &bodies);
            colliders[ball].is_enabled()
        });
        enabled.collect()
    }

    #[test]
    fn a_shape_is_enabled_before_it_touches_and_disabled_when_it_has_left() {
        let heights_m = [1.0, 0.5, 0.05, 0.019, 0.0, 0.03, 0.1, 1.0];
        assert_eq!(enabled_at(&heights_m), [false, false, false, true, true, true, false, false]);
    }

    #[test]
    fn a_jump_is_not_missed() {
        assert_eq!(enabled_at(&[5.0, 0.001, 5.0]), [false, true, false]);
    }

    #[test]
    fn in_a_slow_approach_all_within_the_margin_are_enabled() {
        let heights_m: Vec<f64> = (0..=300).rev().map(|millimetres| f64::from(millimetres) * 1e-3).collect();
        let enabled = enabled_at(&heights_m);
        let within = heights_m.iter().position(|&height_m| height_m <= MARGIN_M).expect("it arrives");
        assert!(enabled[within..].iter().all(|&is_enabled| is_enabled));
        assert!(!enabled[..within / 2].iter().any(|&is_enabled| is_enabled), "far away");
    }

    #[test]
    fn what_is_not_a_number_stays_for_rapier_to_see() {
        assert_eq!(enabled_at(&[1.0, f64::NAN, 1.0]), [false, true, false]);
    }
}
