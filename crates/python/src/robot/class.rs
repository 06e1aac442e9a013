//! The class `congruent.Robot`. `_native.pyi` repeats its documentation for editors; `tests/test_types.py` holds the two equal.

use std::path::PathBuf;

use congruent::{
    analysis::{
        base_parameters::base_parameters,
        dynamics::{DynamicsOptions, DynamicsSource, robot_with_options},
        inverse::TargetPart,
        jacobians::JacobianKind,
    },
    description::{Followers, RobotDescription},
    dynamics::BodyTree,
    input::Capability,
};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::{
    exceptions::PyValueError,
    prelude::*,
    types::{PyDict, PyList},
};

use super::{
    columns::JointColumns,
    dynamics::{forward, inverse, mass_matrices},
    frame::MovedFrame,
    inverse::{GivenOptions, TargetSearch, Targets},
    load,
    motions::{MotionRows, Third},
    parameters::{self, parameter_names, regressors},
    poses::poses,
    velocities::jacobians,
};
use crate::{
    array::{BatchShape, JointRows, same_rows},
    error::{python_findings, refused},
    options::KeywordOptions,
};

/// Seed of the motions at which the identifiable parameters are found; the result does not depend on it.
const SEED: u64 = 0;

/// A robot, read once and ready for computations. It never changes, so several threads may use it.
///
/// ``path`` is a folder with robot.toml, a robot file, a URDF or an MJCF, or ``git:REV:PATH``. ``base`` and ``tip`` are links, if
/// the chain is not the declared one.
#[pyclass(frozen, name = "Robot", module = "congruent")]
pub(crate) struct PythonRobot {
    description: RobotDescription,
    columns: JointColumns,
    tip: MovedFrame,
    /// Without damping and dry friction.
    rigid: BodyTree,
    /// With the damping and dry friction of the description.
    resisting: BodyTree,
}

/// An array as result.
type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

#[pymethods]
impl PythonRobot {
    #[new]
    #[pyo3(signature = (path, *, base=None, tip=None))]
    fn new(py: Python<'_>, path: PathBuf, base: Option<&str>, tip: Option<&str>) -> PyResult<Self> {
        let loaded = py.detach(move || load::from_path(&path));
        Self::along(py, loaded.map_err(|findings| refused(py, findings))?, base, tip)
    }

    /// The robot of the text of a URDF or an MJCF, such as a ``robot_description`` of ROS.
    #[staticmethod]
    #[pyo3(signature = (text, *, base=None, tip=None))]
    fn from_text(py: Python<'_>, text: &str, base: Option<&str>, tip: Option<&str>) -> PyResult<Self> {
        let loaded = py.detach(|| load::from_text(text));
        Self::along(py, loaded.map_err(|findings| refused(py, findings))?, base, tip)
    }

    /// The robot of a xacro file with these arguments, expanded by the Python package xacro, which must be installed.
    #[staticmethod]
    #[pyo3(signature = (path, **arguments))]
    #[expect(clippy::needless_pass_by_value, reason = "Python gives no path that could be borrowed")]
    fn from_xacro(py: Python<'_>, path: PathBuf, arguments: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::along(py, load::from_xacro(py, &path, arguments)?, None, None)
    }

    /// The name that the robot file gives, or the URDF's.
    #[getter]
    fn name(&self) -> &str {
        &self.description.name
    }

    /// The file that it was read from.
    #[getter]
    fn path(&self) -> String {
        self.description.path.display().to_string()
    }

    /// The link in whose frame poses are.
    #[getter]
    fn base(&self) -> &str {
        &self.description.robot.link(self.description.base).name
    }

    /// The link whose pose is computed if no other is named.
    #[getter]
    fn tip(&self) -> &str {
        &self.description.robot.link(self.description.tip).name
    }

    /// The joints that arrays have columns for: those that move by themselves, in the robot's order. A joint that follows another
    /// by ``<mimic>`` has none; it moves with its master, and its torque acts there.
    #[getter]
    fn joints(&self) -> Vec<String> {
        self.columns.names().to_vec()
    }

    /// All links, in the order of the file.
    #[getter]
    fn links(&self) -> Vec<String> {
        self.description.robot.links().iter().map(|link| link.name.clone()).collect()
    }

    /// Number of joints.
    #[getter]
    fn dof(&self) -> usize {
        self.columns.count()
    }

    /// Lower and upper limit of each joint, (joints, 2), rad or m; infinite without a limit.
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let robot = &self.description.robot;
        let joints = self.columns.driven().iter().map(|&at| robot.joint(robot.movable_joints()[at]));
        let unlimited = (f64::NEG_INFINITY, f64::INFINITY);
        let range = joints.map(|joint| joint.position_range().unwrap_or(unlimited));
        let values: Vec<f64> = range.flat_map(|(lower, upper)| [lower, upper]).collect();
        numpy::PyArrayMethods::reshape(&PyArray1::from_vec(py, values), vec![self.columns.count(), 2])
    }

    /// What is suspicious in its files.
    #[getter]
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        python_findings(py, self.description.warnings.iter())
    }

    fn __repr__(&self) -> String {
        let (name, path) = (self.name(), self.path());
        format!("Robot({name:?}, {} joints, {} to {}, from {path:?})", self.dof(), self.base(), self.tip())
    }

    /// Poses as homogeneous matrices ``base_from_tip``: (4, 4), or (n, 4, 4).
    ///
    /// ``link`` is another link, or ``"tcp"`` for the declared tool centre point.
    #[pyo3(signature = (q, link=None))]
    fn fk<'py>(&self, q: &Bound<'py, PyAny>, link: Option<&str>) -> PyResult<Array<'py>> {
        let rows = self.rows(q, "q")?;
        match link {
            None => poses(q.py(), &self.tip, &self.columns, &rows),
            Some(_) => poses(q.py(), &self.frame(q.py(), link)?, &self.columns, &rows),
        }
    }

    /// Velocity of the tip for a unit velocity of each joint: (6, joints), or (n, 6, joints).
    ///
    /// Rows 0 to 2 are the angular velocity in rad/s, rows 3 to 5 the linear one in m/s. ``geometric`` has the axes of the base and
    /// the velocity of the origin of the link, ``body`` the axes of the link and the same point, ``space`` the axes of the base and
    /// the point of the body that passes its origin.
    #[pyo3(signature = (q, link=None, *, kind="geometric"))]
    fn jacobian<'py>(&self, q: &Bound<'py, PyAny>, link: Option<&str>, kind: &str) -> PyResult<Array<'py>> {
        let py = q.py();
        let kind = match kind {
            "geometric" => JacobianKind::Geometric,
            "space" => JacobianKind::Space,
            "body" => JacobianKind::Body,
            other => {
                let message = format!("kind is {other:?}, not \"geometric\", \"space\" or \"body\"");
                return Err(PyValueError::new_err(message));
            }
        };
        jacobians(py, &self.frame(py, link)?, &self.columns, kind, &self.rows(q, "q")?)
    }

    /// Joint positions that bring the tip to target poses, (4, 4) or (n, 4, 4), or its origin to positions, (3,) or (n, 3), in m.
    ///
    /// A target that is not reached is a result, with ``converged`` false and the residuals, and no error. The search starts at
    /// ``start``, one for all targets or one for each, or in the middle of the joint ranges.
    #[pyo3(signature = (target, start=None, **options))]
    #[pyo3(
        text_signature = "($self, target, start=None, *, link=None, position_only=False, tolerance_m=1e-9, tolerance_rad=1e-9, max_iterations=5000, seed=0)"
    )]
    fn ik<'py>(
        &self,
        target: &Bound<'py, PyAny>,
        start: Option<&Bound<'py, PyAny>>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = target.py();
        let mut keywords = KeywordOptions::new("ik", options);
        let link: Option<String> = keywords.take("link")?;
        let is_position_only: Option<bool> = keywords.take("position_only")?;
        let given = GivenOptions {
            tolerance_m: keywords.take("tolerance_m")?,
            tolerance_rad: keywords.take("tolerance_rad")?,
            max_iterations: keywords.take("max_iterations")?,
            seed: keywords.take("seed")?,
        };
        keywords.finish()?;
        let part = if is_position_only == Some(true) { TargetPart::Position } else { TargetPart::Pose };
        let targets = Targets::new(target, part)?;
        let start = start.map(|start| self.rows(start, "start")).transpose()?;
        let (frame, options) = (self.frame(py, link.as_deref())?, given.checked(py)?);
        let search =
            TargetSearch { description: &self.description, columns: &self.columns, frame: &frame, options };
        search.solve(py, &targets, start.as_ref())
    }

    /// Torques of motions: positions, speeds and accelerations to (joints,), or (n, joints), in N m or N.
    ///
    /// Gravity is 9.81 m/s^2 against z of the root link, armature counts; ``friction`` adds damping and dry friction.
    #[pyo3(signature = (q, qd, qdd, *, friction=WithFriction(false)))]
    #[pyo3(text_signature = "($self, q, qd, qdd, *, friction=False)")]
    fn inverse_dynamics<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
        qdd: &Bound<'py, PyAny>,
        friction: WithFriction,
    ) -> PyResult<Array<'py>> {
        let py = q.py();
        let tree = self.bodies(py, friction)?;
        let ([q, qd, qdd], batch) = self.rows_of_motion([(q, "q"), (qd, "qd"), (qdd, "qdd")])?;
        let motions = MotionRows::new(&self.columns, Third::Accelerations, [&q, &qd, &qdd]);
        inverse(py, tree, &self.columns, motions, batch)
    }

    /// The mass matrix with armature on its diagonal: (joints, joints), or (n, joints, joints).
    fn mass_matrix<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Array<'py>> {
        let tree = self.bodies(q.py(), WithFriction(false))?;
        mass_matrices(q.py(), tree, &self.columns, &self.rows(q, "q")?)
    }

    /// Accelerations under torques of the actuators: (joints,), or (n, joints), in rad/s^2 or m/s^2.
    #[pyo3(signature = (q, qd, tau, *, friction=WithFriction(false)))]
    #[pyo3(text_signature = "($self, q, qd, tau, *, friction=False)")]
    fn forward_dynamics<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
        tau: &Bound<'py, PyAny>,
        friction: WithFriction,
    ) -> PyResult<Array<'py>> {
        let py = q.py();
        let tree = self.bodies(py, friction)?;
        let ([q, qd, tau], batch) = self.rows_of_motion([(q, "q"), (qd, "qd"), (tau, "tau")])?;
        let motions = MotionRows::new(&self.columns, Third::Torques, [&q, &qd, &tau]);
        forward(py, tree, &self.columns, motions, batch)
    }

    /// The matrix that gives the torques of the bodies from ``parameters``: (joints, parameters), or (n, joints, parameters).
    ///
    /// Armature, damping and dry friction are not in it.
    fn regressor<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
        qdd: &Bound<'py, PyAny>,
    ) -> PyResult<Array<'py>> {
        let py = q.py();
        let tree = self.bodies(py, WithFriction(false))?;
        let ([q, qd, qdd], batch) = self.rows_of_motion([(q, "q"), (qd, "qd"), (qdd, "qdd")])?;
        let motions = MotionRows::new(&self.columns, Third::Accelerations, [&q, &qd, &qdd]);
        regressors(py, tree, &self.columns, motions, batch)
    }

    /// Names of ``parameters``: ``joint.ixx`` to ``joint.izz``, ``joint.mx`` to ``joint.mz``, ``joint.m`` of each moving joint.
    #[getter]
    fn parameter_names(&self) -> Vec<String> {
        parameter_names(&self.description.robot)
    }

    /// Inertias about the origin of the link of each moving joint, first moments and masses of the body that it carries:
    /// (parameters,), kg m^2, kg m and kg.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let tree = self.bodies(py, WithFriction(false))?;
        Ok(PyArray1::from_vec(py, tree.all_parameters().as_slice().to_vec()))
    }

    /// The sums of parameters that are identifiable from joint torques, from the base to the tip.
    fn base_parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        self.bodies(py, WithFriction(false))?;
        let report = py.detach(|| base_parameters(&self.description, Followers::Folded, SEED));
        let report = report.map_err(|error| refused(py, congruent::analysis::dynamics::refused(&error)))?;
        parameters::base_parameters(py, &report)
    }
}

/// Whether damping and dry friction of the description count.
#[derive(Debug, Clone, Copy, FromPyObject)]
#[pyo3(transparent)]
struct WithFriction(bool);

impl PythonRobot {
    /// What was read, for a check of this robot.
    pub(crate) fn description(&self) -> &RobotDescription {
        &self.description
    }

    pub(crate) fn along(
        py: Python<'_>,
        description: RobotDescription,
        base: Option<&str>,
        tip: Option<&str>,
    ) -> PyResult<Self> {
        let built = Self::build(description, base, tip);
        built.map_err(|finding| refused(py, finding))
    }

    fn build(
        description: RobotDescription,
        base: Option<&str>,
        tip: Option<&str>,
    ) -> Result<Self, congruent::input::Diagnostic> {
        let description = description.with_chain(base, tip)?;
        let columns = JointColumns::new(&description.robot);
        let tip = MovedFrame::named(&description, &columns, None)?;
        let options = |friction| DynamicsOptions {
            source: DynamicsSource::Model,
            friction,
            payload: None,
            followers: Followers::Folded,
        };
        let rigid = BodyTree::new(&robot_with_options(&description, &options(false))?);
        let resisting = BodyTree::new(&description.robot);
        Ok(Self { description, columns, tip, rigid, resisting })
    }

    fn rows<'py>(&self, argument: &Bound<'py, PyAny>, name: &'static str) -> PyResult<JointRows<'py>> {
        JointRows::new(argument, name, self.columns.names())
    }

    /// Three vectors of each row of a motion, and how many rows all of them have.
    fn rows_of_motion<'py>(
        &self,
        arguments: [(&Bound<'py, PyAny>, &'static str); 3],
    ) -> PyResult<([JointRows<'py>; 3], BatchShape)> {
        let [q, qd, third] = arguments.map(|(argument, name)| self.rows(argument, name));
        let rows = [q?, qd?, third?];
        let batch = same_rows(arguments[0].0.py(), &rows.each_ref())?;
        Ok((rows, batch))
    }

    fn frame(&self, py: Python<'_>, link: Option<&str>) -> PyResult<MovedFrame> {
        let frame = MovedFrame::named(&self.description, &self.columns, link);
        frame.map_err(|finding| refused(py, finding))
    }

    /// The bodies, if the description has what physics needs.
    fn bodies(&self, py: Python<'_>, WithFriction(friction): WithFriction) -> PyResult<&BodyTree> {
        let complete = self.description.check_capability(Capability::Physics);
        complete.map_err(|findings| refused(py, findings))?;
        Ok(if friction { &self.resisting } else { &self.rigid })
    }
}
