//! The bounds beyond which a value is reported as probably being in another unit.
//!
//! Measured on 54 URDFs of published robots (arms of 0.4 m to 2.6 m, grippers, a torso with two arms, legs, wheels, a hand); each constant names the
//! extreme that was seen. A unit mistake is a factor of 57.3, 100 or more, so each bound lies between the extreme of published
//! robots and this extreme after a unit mistake. Where another value of the file is related, the ratio of the two is bounded.

/// Radius of gyration against the diagonal of the link's shapes, of a solid box 0.29. Seen: 0.11 to 0.96; placeholders aside, which are tensors of
/// one digit or of a ball.
pub(super) const GYRATION_TO_DIAGONAL: [f64; 2] = [0.035, 2.5];
/// The same bound for placeholder tensors. Seen: 0.0026 to 29.
pub(super) const PLACEHOLDER_GYRATION_TO_DIAGONAL: [f64; 2] = [5e-4, 200.0];
/// Density of the solid sphere with the mass and the mean moment of a link, kg/m^3: any body's own density is above it, by
/// a factor that is small for compact bodies. Seen: 6.8 to 7.3e3; steel has 7.9e3.
pub(super) const SPHERE_DENSITY: [f64; 2] = [0.5, 3e5];
/// The same bound for placeholder tensors. Seen: 6e-5 to 8e8.
pub(super) const PLACEHOLDER_SPHERE_DENSITY: [f64; 2] = [1e-7, 3e10];
/// Mass over the volume of the box around the shapes, kg/m^3. Osmium, the densest material, has 2.26e4; simplified shapes
/// are smaller than their bodies. Seen: up to 2.9e4.
pub(super) const MOST_BOX_DENSITY: f64 = 4e4;
/// The same for the median of all links of a robot, which no single simplified shape moves. Seen: 30 to 2e3.
pub(super) const MEDIAN_BOX_DENSITY: [f64; 2] = [0.5, 2e4];
/// Density of the box and radius of gyration against the diagonal of the shapes that together say that a mass is too small, of links of any
/// mass: no body of a robot is lighter than foam, and none has its mass outside of itself. In t instead of kg a mass is 1000 times too small.
/// Seen: 20 kg/m^3 and 0.96, never of one link.
pub(super) const LEAST_FOAM_DENSITY: f64 = 10.0;
pub(super) const GYRATION_OUTSIDE: f64 = 1.2;
/// Mass of a link against that of all others together, of links that another body carries: arms and hands are heaviest near their bases. Seen:
/// up to 0.77. In grams instead of kg a link that has a hundredth of the mass of its robot has ten times that of all others.
pub(super) const MOST_MASS_TO_OTHERS: f64 = 10.0;
/// Lighter links are markers and frames, whose mass means nothing. Seen: 1 g on a box of 1 mm.
pub(super) const LEAST_MASS_KG: f64 = 0.05;
/// Lighter links are frames, with an inertia that only is not zero. Seen: cameras of 10 mg; the lightest fingertips weigh 5 g.
pub(super) const LEAST_BODY_KG: f64 = 1e-3;

/// Diagonal of boxes, cylinders and balls that only mark a place, m. Seen: balls of 1 mm on a head.
pub(super) const LARGEST_MARKER_M: f64 = 5e-3;

/// Distance of a centre of mass from the box around the shapes and joints of its link, in diagonals of that box. Seen: up to 1.1.
pub(super) const FARTHEST_COM: f64 = 2.5;
/// The same without shapes, in lengths of the longest joint origin of the robot. Seen: up to 0.6.
pub(super) const FARTHEST_COM_IN_ORIGINS: f64 = 2.5;
/// Centres of mass nearer than this, m, are not reported: a plausible one cannot be distinguished from a mistake.
pub(super) const LEAST_COM_M: f64 = 0.3;

/// Distance of a joint from the shapes of the link that carries it, in their diagonals. Seen: up to 2.2.
pub(super) const FARTHEST_JOINT: f64 = 6.0;
/// The same of a joint whose origin the shapes confirm, however long it is. Kind: choice; a flange or a bearing beyond the end of a tube.
pub(super) const JOINT_AT_SHAPE: f64 = 0.1;
/// Length of a joint origin against the sum of all others. Seen: up to 1; in inches instead of metres it is 39 times as long.
pub(super) const LONGEST_ORIGIN: f64 = 1.8;
/// Joint origins shorter than this, m, are not reported.
pub(super) const LEAST_ORIGIN_M: f64 = 0.5;

/// Travel of a sliding joint, m; linear axes of robots are shorter than this.
pub(super) const LONGEST_TRAVEL_M: f64 = 10.0;
/// The same of the first moving joint, which may be a track or a rail of a crane.
pub(super) const LONGEST_TRACK_M: f64 = 60.0;
/// Travel against the size of the robot, of a joint that may be a track and of all others. Seen: up to 0.9; tracks of arms are
/// sold up to some ten times the reach.
pub(super) const TRACK_TO_SIZE: f64 = 15.0;
pub(super) const TRAVEL_TO_SIZE: f64 = 2.0;
/// Travel against the diagonals of the two links that slide. Seen: up to 1.
pub(super) const TRAVEL_TO_SHAPES: f64 = 6.0;
/// Travels shorter than this, m, are not reported.
pub(super) const LEAST_TRAVEL_M: f64 = 1.0;
/// Speed of a sliding joint, m/s. Seen: up to 5.
pub(super) const FASTEST_SLIDE_M_S: f64 = 20.0;

/// Speed of a turning joint, rad/s: 525 revolutions a minute. Seen: up to 52.4, of the hips of four-legged robots.
pub(super) const FASTEST_TURN_RAD_S: f64 = 55.0;
/// The same of joints without limits (continuous), among them wheels and rotors, and of joints that carry no other: the last axes of
/// small and of flat arms turn fastest. Seen: 52 of 2500 deg/s and more.
pub(super) const FASTEST_CONTINUOUS_RAD_S: f64 = 120.0;
/// The same of joints that are called propeller, rotor, spindle or the like. Seen: 38,000, of a dental drill.
pub(super) const FASTEST_ROTOR_RAD_S: f64 = 6e4;
/// The same for the median of the turning joints of a robot, of any kind.
pub(super) const MEDIAN_TURN_RAD_S: f64 = 45.0;
/// Speed of a joint with a range against the median of the robot's turning joints, of the last axis and of all others. Seen: up to
/// 4.7 of last axes, 2.7 of others; revolutions per minute instead of rad/s are 9.5 times as many.
pub(super) const MOST_LAST_SPEED_TO_MEDIAN: f64 = 15.0;
pub(super) const MOST_SPEED_TO_MEDIAN: f64 = 7.0;
/// Torque times speed against the largest of the robot's usual joints, up to which a joint may be many times faster than these: a light
/// wrist has a small motor. Seen: 0.25 to 0.45 of the wrists of small arms; a speed in revolutions per minute gives 9.5 times as much.
pub(super) const MOST_POWER_OF_FAST: f64 = 0.5;
/// Slower joints, rad/s, are not compared with other values; with the median, if they carry others, from the second on.
pub(super) const LEAST_FAST_RAD_S: f64 = 20.0;
pub(super) const LEAST_ODD_RAD_S: f64 = 8.0;
/// Speed of the parts that a joint carries, m/s: the fastest industrial robots reach 10. Seen: up to 33, of a leg that is stretched, which
/// its hip never turns so fast.
pub(super) const FASTEST_TIP_M_S: f64 = 38.0;
/// Torque times speed of one joint over the mass of the robot, W/kg. Seen: up to 133; motors alone reach 1000.
pub(super) const MOST_POWER_W_KG: f64 = 250.0;

/// Torque times speed of one slow joint over the mass of the robot, W/kg, for its torque: no motor alone has more. Seen: up to 220.
/// In N mm instead of N m it is 1000 times as much.
pub(super) const MOST_TORQUE_POWER_W_KG: f64 = 1000.0;
/// Torque times speed of propellers, spindles and the like, W, from which on it is compared with the mass of the robot. Kind: choice; the
/// largest spindles of machine tools have 0.1 MW.
pub(super) const MOST_ROTOR_W: f64 = 1e6;
/// The same of torques that are probably placeholders: one digit, and 1000 or more. Seen: 500, of 2000 N m for a light arm.
pub(super) const MOST_PLACEHOLDER_POWER_W_KG: f64 = 4_000.0;
/// From here on a torque of one digit, N m, is probably a placeholder.
pub(super) const LEAST_PLACEHOLDER_N_M: f64 = 1000.0;
/// Torque against the largest of the robot's other turning joints, placeholders aside. Seen: up to 2.
pub(super) const MOST_TORQUE_TO_OTHERS: f64 = 50.0;
/// Damping times speed limit over effort limit: above 1 the joint cannot reach its speed. Seen: up to 1.4.
pub(super) const MOST_DAMPING_TO_EFFORT: f64 = 2.0;

/// Diagonal of a mesh, m: a smaller one is dust. Seen: from 24 mm.
pub(super) const LEAST_MESH_M: f64 = 3e-3;
/// Diagonal of a mesh against the median of the robot's meshes. Seen: from 1/12.
pub(super) const LEAST_MESH_TO_MEDIAN: f64 = 1.0 / 40.0;
/// Diagonal of a shape against the median of the robot's other shapes. Seen: up to 8.
pub(super) const MOST_SHAPE_TO_MEDIAN: f64 = 20.0;
/// Diagonal of a shape against the sum of all joint origins, of robots with few shapes. Seen: up to 2.2.
pub(super) const MOST_SHAPE_TO_ORIGINS: f64 = 8.0;
/// Shapes smaller than this, m, are never reported as too large.
pub(super) const LEAST_LARGE_SHAPE_M: f64 = 2.0;
