//! Base parameters: the combinations of inertial parameters that are identifiable from joint torques.

use nalgebra::{DMatrix, DVector};

use crate::{
    body_tree::{BodyTree, JointMotionState},
    error::DynamicsError,
    spatial_inertia::{PARAMETER_NAMES, PARAMETERS},
};

/// One of the ten inertial parameters of one body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InertialParameter {
    /// The moving joint that carries the body.
    pub joint: usize,
    /// Its place in [`SpatialInertia::parameters`](crate::SpatialInertia::parameters).
    pub parameter: usize,
}

impl InertialParameter {
    /// Its symbol, of [`PARAMETER_NAMES`].
    pub fn name(self) -> &'static str {
        PARAMETER_NAMES[self.parameter]
    }
}

/// A sum of parameters that are identifiable only together.
#[derive(Debug, Clone, PartialEq)]
pub struct BaseParameter {
    /// The parameter that the group is named by; its coefficient is 1.
    pub parameter: InertialParameter,
    /// The parameters of later bodies that are indistinguishable from it, with their coefficients.
    pub grouped: Vec<(InertialParameter, f64)>,
    /// Value of the sum by the description; kg m^2, kg m or kg.
    pub value: f64,
}

/// All base parameters of a robot, and the parameters without an effect on torques.
#[derive(Debug, Clone, PartialEq)]
pub struct BaseParameters {
    /// The identifiable sums, from the base to the tip.
    pub groups: Vec<BaseParameter>,
    /// Parameters without an effect on any torque.
    pub without_effect: Vec<InertialParameter>,
}

/// A column depends on the others if its part outside of their span is below this share of the longest column. No unit; kind:
/// rounding of some thousand products; worst seen 3e-14, smallest share of an independent column 1e-7 (axes that are almost
/// parallel because pi/2 is rounded).
const DEPENDENT: f64 = 1e-11;
/// A coefficient below this is rounding. No unit; kind: rounding.
const NO_COEFFICIENT: f64 = 1e-9;

impl BodyTree {
    /// Groups the inertial parameters by identifiability at these motions, which have to excite every joint; some 30 random
    /// ones do.
    ///
    /// Parameters are taken from the base on, moments before masses, so that those of a later body are grouped with
    /// those of an earlier one.
    ///
    /// Source: Gautier, *Numerical calculation of the base inertial parameters of robots* (1991): the columns of the
    /// stacked regressor by a QR decomposition.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector is another robot's.
    pub fn base_parameters(&self, motions: &[JointMotionState<'_>]) -> Result<BaseParameters, DynamicsError> {
        let stacked = self.stacked_regressor(motions)?;
        let values = self.all_parameters();
        let scale = stacked.column_iter().map(|column| column.norm()).fold(0.0, f64::max);
        let mut found = BaseParameters { groups: Vec::new(), without_effect: Vec::new() };
        let mut basis = OrthonormalColumns { columns: Vec::new(), triangle: Vec::new() };
        for (index, column) in stacked.column_iter().enumerate() {
            let parameter = InertialParameter { joint: index / PARAMETERS, parameter: index % PARAMETERS };
            // Before the insertion: a column of rounding would become a direction of the basis.
            if column.norm() <= DEPENDENT * scale {
                found.without_effect.push(parameter);
                continue;
            }
            let Some(coefficients) = basis.insert(column.into_owned(), DEPENDENT * scale) else {
                found.groups.push(BaseParameter { parameter, grouped: Vec::new(), value: values[index] });
                continue;
            };
            for (group, coefficient) in found.groups.iter_mut().zip(coefficients) {
                if coefficient.abs() > NO_COEFFICIENT {
                    group.grouped.push((parameter, coefficient));
                    group.value += coefficient * values[index];
                }
            }
        }
        Ok(found)
    }

    /// The regressors of all motions, one below another: a row for each driven joint, since the torque of a joint that
    /// follows another acts on its master ([`BodyTree::with_independent_mimics`] gives each a row of its own).
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector is another robot's.
    pub fn stacked_regressor(&self, motions: &[JointMotionState<'_>]) -> Result<DMatrix<f64>, DynamicsError> {
        let n = self.dof();
        let mut buffer = self.buffer();
        let mut one = DMatrix::zeros(n, PARAMETERS * n);
        let rows = self.independent.len();
        let mut stacked = DMatrix::zeros(rows * motions.len(), PARAMETERS * n);
        for (at, motion) in motions.iter().enumerate() {
            self.regressor_into(motion, &mut buffer, &mut one)?;
            for joint in 0..n {
                let (row, ratio) = self.driver(joint);
                let mut sum = stacked.row_mut(at * rows + row);
                sum += one.row(joint) * ratio;
            }
        }
        Ok(stacked)
    }

    /// The parameters of all bodies, as the regressor multiplies them.
    pub fn all_parameters(&self) -> DVector<f64> {
        let parameters = (0..self.dof()).flat_map(|joint| self.inertia_in_link(joint).parameters());
        DVector::from_iterator(PARAMETERS * self.dof(), parameters)
    }
}

/// A QR decomposition to which columns are added one by one.
struct OrthonormalColumns {
    columns: Vec<DVector<f64>>,
    /// Column `j` of the triangle has `j + 1` entries.
    triangle: Vec<Vec<f64>>,
}

impl OrthonormalColumns {
    /// The coefficients of a column in the inserted ones; `None` if more than `least` of it is independent of them, and
    /// then it is inserted.
    fn insert(&mut self, column: DVector<f64>, least: f64) -> Option<Vec<f64>> {
        let mut rest = column;
        let mut entries = vec![0.0; self.columns.len()];
        // Twice is enough: Giraud, Langou, Rozloznik (2005).
        for _ in 0..2 {
            for (entry, direction) in entries.iter_mut().zip(&self.columns) {
                let along = direction.dot(&rest);
                rest.axpy(-along, direction, 1.0);
                *entry += along;
            }
        }
        let norm = rest.norm();
        if norm <= least {
            return Some(self.solve(entries));
        }
        entries.push(norm);
        self.triangle.push(entries);
        self.columns.push(rest / norm);
        None
    }

    /// Solves `R x = entries` by backward substitution.
    fn solve(&self, mut entries: Vec<f64>) -> Vec<f64> {
        // R x = entries, from the last row up.
        for at in (0..entries.len()).rev() {
            entries[at] /= self.triangle[at][at];
            let value = entries[at];
            for (entry, above) in entries[..at].iter_mut().zip(&self.triangle[at]) {
                *entry -= above * value;
            }
        }
        entries
    }
}
