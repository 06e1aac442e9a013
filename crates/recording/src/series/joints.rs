//! Values of the joints and poses of the TCP over time, with all their digits.

use congruent_kinematics::Pose;
use congruent_monitors::{RecordingError, Sample};
use nalgebra::Isometry3;
use re_chunk::TimeColumn;

use super::scalars::write_scalars;
use crate::rrd::{paths, writer::RrdWriter};

/// Quantities that are recorded of each joint beside its position.
pub(crate) const QUANTITIES: [&str; 6] =
    ["velocity", "effort", "reference_position", "reference_velocity", "measured_position", "deviation"];
/// The coordinates of a recorded pose.
pub(crate) const COORDINATES: [&str; 7] =
    ["x_m", "y_m", "z_m", "quaternion_w", "quaternion_x", "quaternion_y", "quaternion_z"];

/// Values of all joints for each row, or none if the source does not know them.
#[derive(Debug)]
pub(super) struct JointSeries {
    /// For each quantity, the joints of one row after those of the row before.
    values: [Vec<f64>; 6],
}

impl JointSeries {
    /// No rows, with memory for this number of values of each quantity.
    pub(super) fn with_capacity(values: usize) -> Self {
        Self { values: std::array::from_fn(|_| Vec::with_capacity(values)) }
    }

    /// Adds a row with the joint values of a sample.
    pub(super) fn push(&mut self, sample: &Sample<'_>) {
        let joints = &sample.joints;
        let (reference_q, reference_qd) =
            joints.setpoint.map_or((&[][..], &[][..]), |setpoint| (&setpoint.q[..], setpoint.qd));
        let row = [joints.state().qd, joints.state().effort, reference_q, reference_qd, joints.measured.q];
        let [values @ .., deviations] = &mut self.values;
        values.iter_mut().zip(row).for_each(|(values, row)| values.extend_from_slice(row));
        deviations.extend(joints.state().q.iter().zip(reference_q).map(|(q, reference)| q - reference));
    }

    /// Writes the quantities that every row has.
    pub(super) fn write(
        &mut self,
        writer: &mut RrdWriter,
        times: &[TimeColumn],
        rows: usize,
        joints: &[String],
    ) -> Result<(), RecordingError> {
        for (quantity, values) in QUANTITIES.into_iter().zip(&mut self.values) {
            if values.len() == rows * joints.len() {
                for (index, joint) in joints.iter().enumerate() {
                    let joint_column = values.iter().skip(index).step_by(joints.len()).copied();
                    write_scalars(writer, &paths::joint_value(quantity, joint), times, joint_column)?;
                }
            }
            values.clear();
        }
        Ok(())
    }
}

/// Poses of the TCP, in the root link's frame.
#[derive(Debug)]
pub(super) struct TcpSeries {
    twin: Vec<[f64; 7]>,
    model: Vec<[f64; 7]>,
}

impl TcpSeries {
    /// No rows, with memory for this number.
    pub(super) fn with_capacity(rows: usize) -> Self {
        Self { twin: Vec::with_capacity(rows), model: Vec::with_capacity(rows) }
    }

    /// Adds a row with the poses of the TCP by twin and by model, in the root link's frame.
    pub(super) fn push(&mut self, twin: &Isometry3<f64>, model: &Isometry3<f64>) {
        self.twin.push(coordinates(twin));
        self.model.push(coordinates(model));
    }

    /// Writes all rows and removes them.
    pub(super) fn write(
        &mut self,
        writer: &mut RrdWriter,
        times: &[TimeColumn],
    ) -> Result<(), RecordingError> {
        for (source, rows) in [("twin", &mut self.twin), ("model", &mut self.model)] {
            for (index, coordinate) in COORDINATES.into_iter().enumerate() {
                let values = rows.iter().map(|row| row[index]);
                write_scalars(writer, &paths::tcp(source, coordinate), times, values)?;
            }
            rows.clear();
        }
        Ok(())
    }
}

fn coordinates(pose: &Isometry3<f64>) -> [f64; 7] {
    let pose = Pose::from(*pose);
    let [w, i, j, k] = pose.quaternion_wxyz();
    [pose.translation.x, pose.translation.y, pose.translation.z, w, i, j, k]
}
