//! An obstacle on a path against a link that cannot yield: nothing explodes, and the obstacle passes into the link.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use congruent_description::{Geometry, Obstacle, RobotQ};
use congruent_simulation::{Setpoint, Touches, World, WorldSettings};
use nalgebra::{Isometry3, Vector3};

use support::{at, make, swinging_bar};

/// Largest speed that a contact gives in a step, and what the servo adds. Unit: rad/s; worst seen 0.0 along the axis, 21 beside it.
const LARGEST_SPEED: f64 = 60.0;
/// The bar has 1 kg: 10 kg m/s in 1 ms. Unit: N.
const LARGEST_FORCE_N: f64 = 1e4 * (1.0 + 1e-9);

/// Steps of a world in which a cart of 20 mm moves along x from the free end of the bar towards its hinge at 0.15 m/s, this far
/// beside the axis of the bar; gives the largest speed and the largest force.
fn pushed(beside_m: f64, friction: f64) -> (f64, f64) {
    let path = |step: u32| Isometry3::translation(1.02 - 0.15e-3 * f64::from(step), 0.0, beside_m);
    let cart = Obstacle {
        name: "cart".into(),
        world_from_obstacle: path(0),
        geometry: Geometry::Box { size_m: Vector3::new(0.02, 0.02, 0.02) },
    };
    let settings = WorldSettings {
        contacts: true,
        contact_friction: friction,
        obstacles: vec![cart],
        moving_obstacles: vec![0],
        ..WorldSettings::default()
    };
    let mut world: World = at(&swinging_bar(), &settings, &RobotQ::zeros(1));
    let mut servo = make("pd", 400.0, 40.0);
    let (q, zero) = (RobotQ::zeros(1), [0.0]);
    let (mut speed, mut force_n) = (0.0_f64, 0.0_f64);
    for step in 1..2000 {
        world.move_obstacle(0, &path(step), Touches::Links);
        world.step(servo.as_mut(), &Setpoint { q: &q, qd: &zero, qdd: &zero }).unwrap();
        speed = speed.max(world.qd()[0].abs());
        force_n = world.contact_forces().map(|force| force.force_n).fold(force_n, f64::max);
    }
    (speed, force_n)
}

#[test]
fn an_obstacle_that_a_link_cannot_yield_to_passes_into_it() {
    for (beside_m, friction) in [(0.0, 0.5), (0.0, 0.0), (1e-9, 0.5), (1e-3, 0.5), (0.01, 0.0), (0.02, 0.5)] {
        let (speed, force_n) = pushed(beside_m, friction);
        let values = format!("{beside_m} m, friction {friction}: {speed:e} rad/s, {force_n:e} N");
        assert!(speed < LARGEST_SPEED && force_n < LARGEST_FORCE_N, "{values}");
    }
}
