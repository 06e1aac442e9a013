//! Inverse kinematics: joint positions that bring a frame to target poses.

use congruent::{
    analysis::inverse::{IkMethod, IkOptions, TargetPart},
    codes,
    description::{ArmQ, RobotDescription},
    input::Diagnostic,
    kinematics::{Arm, IkSolver, IkTarget, KinematicsError, Pose},
    nalgebra::{Matrix3, Vector3},
};
use pyo3::prelude::*;

use super::{columns::JointColumns, frame::MovedFrame, poses::wrong_count};
use crate::{
    array::{ArrayArgument, BatchShape, JointRows, RowBlocks, array_of_rows, fill_rows, refused_array},
    error::refused,
};

/// The Python module of the classes of results.
const MODULE: &str = "congruent._results";

/// Largest entry of `R'R - I` of a target, and of `det R - 1`. No unit; kind: digits of matrices that are written with seven.
const NOT_A_ROTATION: f64 = 1e-6;

/// Results of a row behind its positions: whether it converged, both residuals, and the number of steps.
const FURTHER: usize = 4;

/// Most steps of one target. Kind: choice; a second, after which Ctrl-C is seen.
const MOST_ITERATIONS: usize = 1_000_000;

/// Target poses, one or many.
pub(super) struct Targets {
    pub(super) targets: Vec<IkTarget>,
    pub(super) batch: BatchShape,
}

impl Targets {
    /// Homogeneous matrices (4, 4) or (n, 4, 4), or positions (3,) or (n, 3).
    ///
    /// # Errors
    /// `CongruentError` for another shape, a value that is not finite, or a matrix that is no pose.
    pub(super) fn new(argument: &Bound<'_, PyAny>, part: TargetPart) -> PyResult<Self> {
        let py = argument.py();
        let array = ArrayArgument::new(argument, "target")?;
        let (batch, width) = match *array.shape() {
            [4, 4] => (BatchShape::One, 16),
            [rows, 4, 4] => (BatchShape::Rows(rows), 16),
            [3] => (BatchShape::One, 3),
            [rows, 3] => (BatchShape::Rows(rows), 3),
            _ => {
                let message = format!("target has the shape {}", array.shape_in_words());
                let help = "give homogeneous matrices (4, 4) or (n, 4, 4), or positions (3,) or (n, 3) in m";
                return Err(refused_array(py, message, help));
            }
        };
        let mut targets = Vec::with_capacity(batch.rows());
        for (row, numbers) in array.values().chunks(width).enumerate() {
            let target = if width == 3 { position(numbers) } else { pose(numbers, part) };
            let place = |why: &str| match batch {
                BatchShape::One => format!("target {why}"),
                BatchShape::Rows(_) => format!("target {row} {why}"),
            };
            let help = "a pose is [[R, p], [0, 1]] with an orthonormal R of determinant 1 and p in m";
            let refuse =
                |why: &str| refused(py, Diagnostic::error(codes::python::TARGET, place(why)).with_help(help));
            targets.push(target.map_err(refuse)?);
        }
        Ok(Self { targets, batch })
    }
}

fn position(numbers: &[f64]) -> Result<IkTarget, &'static str> {
    if numbers.iter().any(|value| !value.is_finite()) {
        return Err("has a value that is not a finite number");
    }
    let base_from_tcp = Pose::from_parts(Matrix3::identity(), Vector3::from_column_slice(numbers));
    Ok(IkTarget { base_from_tcp, part: TargetPart::Position })
}

fn pose(numbers: &[f64], part: TargetPart) -> Result<IkTarget, &'static str> {
    if numbers.iter().any(|value| !value.is_finite()) {
        return Err("has a value that is not a finite number");
    }
    let (rows, _) = numbers.as_chunks::<4>();
    let rotation = Matrix3::from_fn(|row, column| rows[row][column]);
    let translation = Vector3::from_fn(|row, _| rows[row][3]);
    let is_last_row = rows[3].iter().zip([0.0, 0.0, 0.0, 1.0]).all(|(a, b)| (a - b).abs() < NOT_A_ROTATION);
    let excess = rotation.transpose() * rotation - Matrix3::identity();
    if !is_last_row {
        return Err("has a last row other than 0, 0, 0, 1");
    }
    // The product alone would accept a mirror.
    if excess.amax() > NOT_A_ROTATION || rotation.determinant() < 0.0 {
        return Err("has no rotation matrix");
    }
    Ok(IkTarget { base_from_tcp: Pose::from_parts(rotation, translation), part })
}

/// The search of one call.
pub(super) struct TargetSearch<'a> {
    pub(super) description: &'a RobotDescription,
    pub(super) columns: &'a JointColumns,
    pub(super) frame: &'a MovedFrame,
    pub(super) options: IkOptions,
}

impl TargetSearch<'_> {
    /// The positions of each target, as `congruent.IkResult`; the search begins at `start`, or in the middle of the joint ranges.
    pub(super) fn solve<'py>(
        &self,
        py: Python<'py>,
        targets: &Targets,
        start: Option<&JointRows<'py>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (n, batch) = (self.columns.count(), targets.batch);
        if let Some(start) = start.filter(|start| start.batch() != BatchShape::One && start.batch() != batch)
        {
            let message =
                format!("start {}, but there are {} targets", start.batch().in_words(), batch.rows());
            return Err(refused_array(py, message, "give one start, or one for each target"));
        }
        let arm = self
            .arm()
            .map_err(|error| refused(py, Diagnostic::error(codes::python::TARGET, error.to_string())))?;
        let values = start.map(JointRows::values);
        let from = |row: usize| -> Option<&[f64]> {
            let values = values?;
            Some(&values[if values.len() == n { 0 } else { n * row }..][..n])
        };
        let width = n + FURTHER;
        let mut found = vec![0.0; width * batch.rows()];
        // One target a block: a search takes long enough for Ctrl-C.
        fill_rows(py, RowBlocks { out: &mut found, width, rows: 1 }, || {
            let mut solver = IkSolver::new(arm.clone());
            move |rows, out| {
                let at = |error: KinematicsError| wrong_count(&error);
                self.solve_one(&mut solver, &targets.targets[rows.start], from(rows.start), out).map_err(at)
            }
        })?;
        self.result(py, &found, batch)
    }

    fn arm(&self) -> Result<Arm, KinematicsError> {
        let tip_from_tcp = self.frame.link_from_frame.unwrap_or_else(Pose::identity);
        Arm::new(&self.description.robot, self.description.base, self.frame.link, tip_from_tcp)
    }

    fn solve_one(
        &self,
        solver: &mut IkSolver,
        target: &IkTarget,
        start: Option<&[f64]>,
        out: &mut [f64],
    ) -> Result<(), KinematicsError> {
        let n = self.columns.count();
        let column = |coordinate: usize| self.columns.follows()[coordinate].column;
        let columns: Vec<usize> =
            solver.arm().joints().iter().map(|joint| column(joint.coordinate)).collect();
        let begin: ArmQ = match start {
            Some(start) => columns.iter().map(|&column| start[column]).collect(),
            None => solver.arm().middle(),
        };
        let result = solver.solve(target, &begin, &self.options, || true)?;
        // Joints that do not move the frame stay where they are.
        out[..n].copy_from_slice(start.unwrap_or(&vec![0.0; n]));
        for (&column, &q) in columns.iter().zip(result.q) {
            out[column] = q;
        }
        let converged = if result.converged { 1.0 } else { 0.0 };
        #[expect(clippy::cast_precision_loss, reason = "a number of steps is far below 2^53")]
        let iterations = result.iterations as f64;
        out[n..].copy_from_slice(&[
            converged,
            result.residual_position_m,
            result.residual_orientation_rad,
            iterations,
        ]);
        Ok(())
    }

    fn result<'py>(&self, py: Python<'py>, found: &[f64], batch: BatchShape) -> PyResult<Bound<'py, PyAny>> {
        let n = self.columns.count();
        let rows = || found.chunks(n + FURTHER);
        let q = rows().flat_map(|row| row[..n].iter().copied()).collect();
        let further = |at: usize| rows().map(move |row| row[n + at]);
        let converged: Vec<bool> = further(0).map(|converged| converged > 0.0).collect();
        #[expect(clippy::cast_possible_truncation, reason = "a number of steps")]
        let iterations: Vec<i64> = further(3).map(|iterations| iterations as i64).collect();
        py.import(MODULE)?.getattr("IkResult")?.call1((
            array_of_rows(py, q, batch, &[n])?,
            array_of_rows(py, converged, batch, &[])?,
            array_of_rows(py, further(1).collect(), batch, &[])?,
            array_of_rows(py, further(2).collect(), batch, &[])?,
            array_of_rows(py, iterations, batch, &[])?,
        ))
    }
}

/// Options as Python gives them.
#[derive(Debug, Default)]
pub(super) struct GivenOptions {
    pub(super) tolerance_m: Option<f64>,
    pub(super) tolerance_rad: Option<f64>,
    pub(super) max_iterations: Option<usize>,
    pub(super) seed: Option<u64>,
}

impl GivenOptions {
    /// The options of the library.
    ///
    /// # Errors
    /// A tolerance that is not above 0, within which no pose or every pose would count as reached, or too many steps.
    pub(super) fn checked(self, py: Python<'_>) -> PyResult<IkOptions> {
        let usual = IkOptions::default();
        let positive = |name: &str, given: Option<f64>, usual: f64| match given.unwrap_or(usual) {
            value if value > 0.0 && value.is_finite() => Ok(value),
            value => {
                let message = format!("{name} = {value} is not greater than 0 and finite");
                Err(refused_array(py, message, "give tolerance_m in m and tolerance_rad in rad"))
            }
        };
        let max_iterations = self.max_iterations.unwrap_or(usual.max_iterations);
        if max_iterations > MOST_ITERATIONS {
            let message = format!("max_iterations = {max_iterations} is more than {MOST_ITERATIONS}");
            return Err(refused_array(py, message, "give another start or another seed instead"));
        }
        Ok(IkOptions {
            method: IkMethod::default(),
            tolerance_m: positive("tolerance_m", self.tolerance_m, usual.tolerance_m)?,
            tolerance_rad: positive("tolerance_rad", self.tolerance_rad, usual.tolerance_rad)?,
            max_iterations,
            seed: self.seed.unwrap_or(usual.seed),
        })
    }
}
