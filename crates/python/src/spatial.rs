//! Transforms, Euler angles, rows of a table and twists of `congruent.spatial`, whose Python part has the documentation: the formulas
//! are those of crate `kinematics`.

use congruent::{
    codes,
    description::DhConvention,
    input::Diagnostic,
    kinematics::{
        EulerSet, ModifiedDh, NotADhTransform, Pose, StandardDh, ToolAxes, Twist, rotation_exp, rotation_log,
    },
    nalgebra::{Matrix3, Matrix6, Point3, Vector3},
};
use pyo3::prelude::*;

use crate::error::refused;

/// How far a matrix may be from a rotation: six digits that somebody has written. Kind: choice.
const ROTATION: f64 = 1e-5;

type Three = [f64; 3];
type Six = [f64; 6];
type Rotation = [[f64; 3]; 3];
type Matrix = [[f64; 4]; 4];
type Adjoint = [[f64; 6]; 6];

/// A turn about an axis in rad (`turn_x`), or a shift along it in m (`shift_x`).
#[pyfunction]
pub(crate) fn elementary(py: Python<'_>, motion: &str, value: f64) -> PyResult<Matrix> {
    let pose = match motion {
        "turn_x" => Pose::turn_x(value),
        "turn_y" => Pose::turn_y(value),
        "turn_z" => Pose::turn_z(value),
        "shift_x" => Pose::shift_x(value),
        "shift_y" => Pose::shift_y(value),
        "shift_z" => Pose::shift_z(value),
        other => return Err(wrong(py, format!("there is no motion \"{other}\""), "turn_x to shift_z")),
    };
    Ok(matrix(&pose))
}

/// The rotation of three turns, each about an axis that the one before has turned.
#[pyfunction]
pub(crate) fn euler_rotation(py: Python<'_>, set: &str, angles: Three) -> PyResult<Rotation> {
    Ok(rotation(&euler_set(py, set)?.rotation(angles)))
}

/// The angles of a rotation, those of the other solution, what the rotation determines, and how far it is from singular.
#[pyfunction]
pub(crate) fn euler_angles(
    py: Python<'_>,
    set: &str,
    matrix: Rotation,
) -> PyResult<(Three, Three, String, f64)> {
    let found = euler_set(py, set)?.angles(&checked(py, &matrix, "rotation")?);
    let determined = congruent::input::serde_name(&found.determined).to_owned();
    Ok((found.angles_rad, found.other_rad, determined, found.from_singular_rad))
}

/// The pose of a tool with these axes and this origin.
#[pyfunction]
pub(crate) fn tool_pose(
    py: Python<'_>,
    normal: Option<Three>,
    sliding: Three,
    approach: Three,
    origin: Three,
) -> PyResult<Matrix> {
    let [sliding, approach] = [sliding, approach].map(Vector3::from);
    let axes = match normal {
        Some(normal) => Ok(ToolAxes { normal: normal.into(), sliding, approach }),
        None => ToolAxes::from_approach_and_sliding(approach, sliding),
    };
    let pose = axes.and_then(|axes| axes.base_from_tool(&Point3::from(origin)));
    let help = "three perpendicular unit vectors with n x s = a, or s and a of any length without n";
    pose.map(|pose| matrix(&pose)).map_err(|error| wrong(py, error.to_string(), help))
}

/// The transform of a row: a and d in m, alpha and theta in rad.
#[pyfunction]
pub(crate) fn dh_transform(py: Python<'_>, convention: &str, row: [f64; 4]) -> PyResult<Matrix> {
    let [a_m, alpha_rad, d_m, theta_rad] = row;
    Ok(matrix(&match dh_convention(py, convention)? {
        DhConvention::Standard => StandardDh { a_m, alpha_rad, d_m, theta_rad }.transform(),
        DhConvention::Modified => ModifiedDh { a_m, alpha_rad, d_m, theta_rad }.transform(),
    }))
}

/// The row of a transform: a and d in m, alpha and theta in rad.
#[pyfunction]
pub(crate) fn dh_row(py: Python<'_>, convention: &str, transform: Matrix) -> PyResult<[f64; 4]> {
    let pose = pose(py, &transform)?;
    let row = match dh_convention(py, convention)? {
        DhConvention::Standard => {
            StandardDh::from_transform(&pose).map(|of| [of.a_m, of.alpha_rad, of.d_m, of.theta_rad])
        }
        DhConvention::Modified => {
            ModifiedDh::from_transform(&pose).map(|of| [of.a_m, of.alpha_rad, of.d_m, of.theta_rad])
        }
    };
    row.map_err(|error| wrong(py, conditions(&error), "two rows with a frame between them, or another frame"))
}

/// The error with the names of the conditions that fail.
fn conditions(error: &NotADhTransform) -> String {
    let failing = [("DH1", error.is_oblique()), ("DH2", error.is_apart())];
    let names: Vec<&str> = failing.into_iter().filter(|of| of.1).map(|of| of.0).collect();
    format!("{error} ({})", names.join(", "))
}

/// The matrix of a twist, which is angular before linear.
#[pyfunction]
pub(crate) fn twist_matrix(twist: Six) -> Matrix {
    let matrix = twist_of(twist).hat();
    std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)]))
}

/// The adjoint of a transform.
#[pyfunction]
pub(crate) fn adjoint(py: Python<'_>, transform: Matrix) -> PyResult<Adjoint> {
    let matrix: Matrix6<f64> = pose(py, &transform)?.adjoint();
    Ok(std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)])))
}

/// The motion along a twist.
#[pyfunction]
pub(crate) fn twist_exp(twist: Six, scalar: f64) -> Matrix {
    matrix(&twist_of(twist).exp(scalar))
}

/// The twist whose motion over 1 is the transform.
#[pyfunction]
pub(crate) fn twist_log(py: Python<'_>, transform: Matrix) -> PyResult<Six> {
    let Twist { angular, linear } = Twist::log(&pose(py, &transform)?);
    Ok([angular.x, angular.y, angular.z, linear.x, linear.y, linear.z])
}

/// The rotation by a vector: about its direction, by its length in rad.
#[pyfunction]
pub(crate) fn exp_of_rotation(turn_rad: Three) -> Rotation {
    rotation(&rotation_exp(&turn_rad.into()))
}

/// The vector of a rotation.
#[pyfunction]
pub(crate) fn log_of_rotation(py: Python<'_>, matrix: Rotation) -> PyResult<Three> {
    Ok(rotation_log(&checked(py, &matrix, "rotation")?).into())
}

fn wrong(py: Python<'_>, message: String, help: &str) -> PyErr {
    refused(py, Diagnostic::error(codes::python::SPATIAL, message).with_help(help))
}

fn euler_set(py: Python<'_>, name: &str) -> PyResult<EulerSet> {
    name.parse().map_err(|error| wrong(py, format!("{error}"), "three letters, as zyx"))
}

fn dh_convention(py: Python<'_>, name: &str) -> PyResult<DhConvention> {
    let known = [DhConvention::Standard, DhConvention::Modified];
    let found = known.into_iter().find(|of| of.name() == name);
    found.ok_or_else(|| wrong(py, format!("there is no convention \"{name}\""), "standard or modified"))
}

fn twist_of([x, y, z, u, v, w]: Six) -> Twist {
    Twist { angular: Vector3::new(x, y, z), linear: Vector3::new(u, v, w) }
}

/// The pose of a homogeneous matrix.
fn pose(py: Python<'_>, matrix: &Matrix) -> PyResult<Pose> {
    let turn: Rotation = std::array::from_fn(|row| std::array::from_fn(|column| matrix[row][column]));
    let off = matrix[3].iter().zip([0.0, 0.0, 0.0, 1.0]).map(|(of, expected)| (of - expected).abs());
    let is_last_row = off.fold(0.0, f64::max) <= ROTATION;
    let translation = Vector3::from_fn(|row, _| matrix[row][3]);
    if !is_last_row || !translation.iter().all(|of| of.is_finite()) {
        let message =
            "the matrix is no homogeneous one: its last row is not 0 0 0 1, or a value is not finite";
        return Err(wrong(py, message.to_owned(), "a rotation and a position in m"));
    }
    Ok(Pose { rotation: checked(py, &turn, "matrix")?, translation })
}

/// A rotation, refused if it is none.
fn checked(py: Python<'_>, matrix: &Rotation, what: &str) -> PyResult<Matrix3<f64>> {
    let turn = Matrix3::from_fn(|row, column| matrix[row][column]);
    let given = Pose { rotation: turn, translation: Vector3::zeros() };
    let off = given.orthonormality_error();
    // Not `>`, which a value that is not finite would pass.
    if off <= ROTATION && given.determinant() > 0.0 {
        return Ok(turn);
    }
    let message =
        format!("the {what} is no rotation: off by {off:.2e}, determinant {:.4}", given.determinant());
    Err(wrong(py, message, "three perpendicular unit vectors, right-handed"))
}

fn rotation(matrix: &Matrix3<f64>) -> Rotation {
    std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)]))
}

/// The homogeneous matrix of a pose.
pub(crate) fn matrix(pose: &Pose) -> Matrix {
    let mut matrix = [[0.0, 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4], [0.0, 0.0, 0.0, 1.0]];
    for (row, values) in matrix.iter_mut().take(3).enumerate() {
        for (column, value) in values.iter_mut().take(3).enumerate() {
            *value = pose.rotation[(row, column)];
        }
        values[3] = pose.translation[row];
    }
    matrix
}
