//! Contacts of ellipsoids, whose height on a floor and beside other obstacles has a closed form.

#![expect(clippy::print_stdout, reason = "the worst values, for those who run with --nocapture")]

mod support;

use congruent_description::{Geometry, Mesh, Obstacle, Robot, RobotQ, Shape};
use congruent_simulation::WorldSettings;
use nalgebra::{Isometry3, Point3, Vector3};

use support::{at, make, run, sliding_block_of};

/// Half axes of the ellipsoid, m.
const SEMI_AXES_M: [f64; 3] = [0.1, 0.05, 0.02];

/// Height at rest against the closed form, m. Kind: physics, a contact gives way under the weight, by the same for every
/// shape; worst seen 6.9e-5. A hull of points on the surface, half a percent inside of it, would be off by up to 5e-4 more.
const RESTING_M: f64 = 1e-4;

/// The block of 2 kg with an ellipsoid in place of its box, turned in the frame of the block.
fn sliding_ellipsoid(turned: Vector3<f64>) -> Robot {
    let geometry = Geometry::Ellipsoid { semi_axes_m: SEMI_AXES_M.into() };
    let shape = Shape { link_from_shape: Isometry3::rotation(turned), geometry, color_rgba: None };
    sliding_block_of(shape)
}

fn above(geometry: Geometry, at_m: [f64; 3]) -> WorldSettings {
    let world_from_obstacle = Isometry3::translation(at_m[0], at_m[1], at_m[2]);
    let obstacles = vec![Obstacle { name: "obstacle".into(), world_from_obstacle, geometry }];
    WorldSettings { contacts: true, obstacles, contact_friction: 10.0, ..WorldSettings::default() }
}

/// Where the ellipsoid comes to rest, in z, and the force that it rests with, N.
fn at_rest(robot: &Robot, settings: &WorldSettings, start_m: f64) -> (f64, f64) {
    let mut world = at(robot, settings, &RobotQ::from([0.0, start_m]));
    run(&mut world, make("passive", 0.0, 0.0).as_mut(), &RobotQ::zeros(2), 1500);
    (world.q()[1], world.contact_forces().map(|force| force.force_n).sum())
}

#[test]
fn an_ellipsoid_rests_as_high_as_it_reaches() {
    let wide = above(Geometry::Box { size_m: Vector3::new(4.0, 4.0, 1.0) }, [0.0, 0.0, -0.5]);
    for turned in [[0.0; 3], [1.2, 0.0, 0.0], [0.0, 1.5, 0.0], [0.4, -0.7, 1.1]].map(Vector3::from) {
        let down = Isometry3::rotation(turned).inverse() * -Vector3::z();
        let reach_m = down.component_mul(&Vector3::from(SEMI_AXES_M)).norm();
        let (height_m, force_n) = at_rest(&sliding_ellipsoid(turned), &wide, reach_m + 0.01);
        println!("height: {:e}", height_m - reach_m);
        assert!((height_m - reach_m).abs() < RESTING_M, "{height_m} is not {reach_m}");
        // The body cannot turn, so that the floor carries its weight wherever it touches.
        assert!((force_n / (2.0 * 9.81) - 1.0).abs() < 1e-2, "{force_n} N");
    }
}

#[test]
fn an_ellipsoid_meets_obstacles_of_every_shape() {
    // Each has its highest point at z = 0, below the middle of the ellipsoid.
    let radius_m = 0.3;
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [x * 0.2, y * 0.2]);
    let vertices_m = [-0.1, 0.1].iter().flat_map(|z| corners.map(|[x, y]| Point3::new(x, y, *z))).collect();
    let mesh =
        Mesh { path: "block".into(), scale: Vector3::repeat(1.0), vertices_m, triangles: vec![[0, 1, 2]] };
    let shapes = [
        above(Geometry::Sphere { radius_m }, [0.0, 0.0, -radius_m]),
        above(Geometry::Cylinder { radius_m, length_m: 0.2 }, [0.0, 0.0, -0.1]),
        above(Geometry::Mesh(mesh.into()), [0.0, 0.0, -0.1]),
        above(Geometry::Ellipsoid { semi_axes_m: Vector3::new(0.2, 0.3, 0.1) }, [0.0, 0.0, -0.1]),
    ];
    for settings in &shapes {
        let (height_m, force_n) = at_rest(&sliding_ellipsoid(Vector3::zeros()), settings, 0.03);
        println!("height: {:e}", height_m - SEMI_AXES_M[2]);
        assert!((height_m - SEMI_AXES_M[2]).abs() < RESTING_M, "{height_m} on {:?}", settings.obstacles);
        assert!((force_n / (2.0 * 9.81) - 1.0).abs() < 1e-2, "{force_n} N");
    }
}
