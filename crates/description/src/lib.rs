//! What a robot is: URDF, MJCF, SRDF, `robot.toml` and meshes, read into a validated [`Robot`] or refused with
//! diagnostics that say what is wrong, at which place, and what to do.
//!
//! Parsers take text and give a value or diagnostics; only `files/` of crate `input` opens files.

mod chain;
pub mod codes;
mod description;
mod load;
mod mjcf;
mod model_file;
mod named_robot;
mod own_model;
mod parameter_places;
mod revision;
mod robot_file;
mod set_values;
mod srdf;
mod tolerance_scale;
mod urdf;

pub use chain::{ChainEnd, ChainEnds, ReportedChain};
pub use congruent_meshes::{HullPoints, Mesh, read_mesh};
pub use congruent_mjcf::codes::mjcf::LOOP as MJCF_LOOP;
pub use congruent_robot::{
    ArmQ, CarriedBody, ChainQ, DeclaredTolerances, DhConvention, DhRow, DhRowKind, DhTable,
    DrivenCoordinates, ErrorDistribution, Extent, Followers, FrameTolerances, Geometry, Inertia,
    InertiaRounding, Joint, JointIndex, JointKind, JointLimit, JointParts, JointResistance, JointRounding,
    JointTolerances, JointValueRounding, JointValues, Link, LinkIndex, MappedJoint, Mimic, Obstacle,
    ParameterTolerances, PlacedAxis, RequestedTolerance, Robot, RobotError, RobotQ, RobotQList, SPEED_MARGIN,
    Shape, SmallMotion, Tolerance, motions_of_pose, principal_moments,
};
pub use description::{NamedFiles, Places, RobotDescription};
pub use load::{load_opened_robot, load_robot, load_robot_with, parse_robot};
pub use mjcf::{MjcfPlaces, is_mjcf};
pub use named_robot::{file_of_robot, open};
pub use own_model::{OwnModelForm, OwnModelPlaces};
pub use parameter_places::{JointElement, ParameterPlace, ParameterPlaces, PlaceElsewhere};
pub use robot_file::{
    ConstantKey, ConstantPart, DeclaredInertial, DeclaredMapping, DeclaredReference, DeclaredVariable,
    DynamicsTable, InertialDigits, InertialFrame, InertialPlaces, InertialPoint, ROBOT_FILE,
    ROBOT_FILE_BYTES, RobotFilePlaces, RowKey, TableDigits, ValuePlace, WrittenIgnore, WrittenLint,
    WrittenRobot, dh_text, robot_file_schema,
};
pub use set_values::load_robot_set;
pub use tolerance_scale::ToleranceScale;
pub use urdf::{
    JointDigits, LARGEST_GYRATION_M, LargeLinks, Misspelling, Misspelt, URDF_BYTES, UrdfPlaces, misspellings,
    nearest_possible_tensor, node, parse_urdf,
};
