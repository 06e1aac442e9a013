//! Obstacles that are so fast on their paths that a link may be between two of their positions and never be touched.

use congruent_description::{Extent, Obstacle};
use congruent_input::{Diagnostic, display::length};
use congruent_proximity::{BodyTrack, MovingBody, PathPose};
use congruent_scenario::FilePlace;

use crate::codes;

/// A warning for each obstacle that moves farther than its size in one step.
pub(in crate::setup) fn jumps(
    moving: &[MovingBody],
    obstacles: &[Obstacle],
    step_s: f64,
    places: FilePlace<'_>,
) -> Vec<Diagnostic> {
    let jump = |body: &MovingBody| {
        let BodyTrack::Path(path) = &body.track else { return None };
        let obstacle = &obstacles[body.obstacle];
        let size_m = Extent::of_geometry(&obstacle.geometry)?.diagonal_m();
        let farthest_m = path.windows(2).map(|pair| moved_m(&pair[0], &pair[1], step_s)).fold(0.0, f64::max);
        let name = &obstacle.name;
        let message = format!(
            "obstacle \"{name}\" moves up to {} in a step of {step_s} s, but its size is {}: checks do not see what it passes between \
             two samples",
            length(farthest_m),
            length(size_m)
        );
        let warning = Diagnostic::warning(codes::scenario::OBSTACLE_JUMPS, message)
            .one_of("obstacles move farther than their size in a step", name)
            .with_help("give a shorter `step_s`, or more time between the poses of the path");
        (farthest_m > size_m).then(|| places.item(body.obstacle).key("path").mark(warning))
    };
    moving.iter().filter_map(jump).collect()
}

/// How far an obstacle moves in one step between two poses, m.
fn moved_m(from: &PathPose, to: &PathPose, step_s: f64) -> f64 {
    let [from_m, to_m] = [from, to].map(|pose| pose.world_from_obstacle.translation.vector);
    // Two poses within one step are passed at once.
    let share = (step_s / (to.at_s - from.at_s)).min(1.0);
    (to_m - from_m).norm() * share
}
