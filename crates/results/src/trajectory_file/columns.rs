//! The columns of a trajectory: names that end in the unit, and the cells of one sample.

use congruent_description::{JointKind, LinkIndex, RobotDescription};
use congruent_kinematics::{Pose, PoseError};
use congruent_monitors::{Names, Sample};
use congruent_tables::{
    run_columns::{POSITION, STEP, TIME, WORST},
    writer::{ColumnKind, TableWriter, WrittenCell, WrittenColumn},
};
use nalgebra::Isometry3;

/// The columns of a robot, in the order of [`SampleCells::write`].
pub(super) fn header(description: &RobotDescription) -> Vec<WrittenColumn> {
    let robot = &description.robot;
    let mut header = vec![number(TIME), WrittenColumn { name: STEP.to_owned(), kind: ColumnKind::Count }];
    for &joint in robot.movable_joints() {
        let joint = robot.joint(joint);
        let (position, speed, effort) = match joint.kind {
            JointKind::Prismatic => ("m", "m_s", "n"),
            _ => ("rad", "rad_s", "n_m"),
        };
        let values = [
            format!("{POSITION}_{position}"),
            format!("qd_{speed}"),
            format!("effort_{effort}"),
            format!("reference_q_{position}"),
            format!("reference_qd_{speed}"),
            format!("measured_q_{position}"),
        ];
        header.extend(values.iter().map(|value| number(&format!("{}.{value}", joint.name))));
    }
    for source in ["twin_tcp", "model_tcp"] {
        let values = ["x_m", "y_m", "z_m", "quaternion_w", "quaternion_x", "quaternion_y", "quaternion_z"];
        header.extend(values.iter().map(|value| number(&format!("{source}.{value}"))));
    }
    for [value, subject] in WORST {
        header.extend([number(value), WrittenColumn { name: subject.to_owned(), kind: ColumnKind::Name }]);
    }
    header
}

/// Writes the cells of one robot's samples.
pub(super) struct SampleCells {
    names: Names,
    tip: LinkIndex,
    tip_from_tcp: Isometry3<f64>,
}

impl SampleCells {
    pub(super) fn new(description: &RobotDescription, names: &Names) -> Self {
        let tip_from_tcp = description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
        Self { names: names.clone(), tip: description.tip, tip_from_tcp }
    }

    /// The cells of one sample.
    pub(super) fn write(&self, sample: &mut Sample<'_>, table: &mut dyn TableWriter) {
        table.cell(WrittenCell::Number(sample.time_s));
        table.cell(WrittenCell::Count(sample.step));
        let joints = &sample.joints;
        for at in 0..joints.state().q.len() {
            table.cell(WrittenCell::Number(joints.state().q[at]));
            table.cell(entry(joints.state().qd, at));
            table.cell(entry(joints.state().effort, at));
            table.cell(
                joints.setpoint.map_or(WrittenCell::Missing, |setpoint| WrittenCell::Number(setpoint.q[at])),
            );
            table.cell(joints.setpoint.map_or(WrittenCell::Missing, |setpoint| entry(setpoint.qd, at)));
            table.cell(WrittenCell::Number(joints.measured.q[at]));
        }
        let tip = self.tip.get();
        self.pose(&sample.twin[tip], table);
        self.pose(&sample.model[tip].to_isometry(), table);
        self.worst(sample.errors, |error| error.position_m, table);
        self.worst(sample.errors, |error| error.orientation_rad, table);
        match sample.clearance.nearest() {
            Some(nearest) => {
                table.cell(WrittenCell::Number(nearest.distance_m));
                table.cell(WrittenCell::Name(&self.names.pairs[nearest.pair]));
            }
            None => [WrittenCell::Missing; 2].into_iter().for_each(|cell| table.cell(cell)),
        }
    }

    fn pose(&self, root_from_tip: &Isometry3<f64>, table: &mut dyn TableWriter) {
        let root_from_tcp = Pose::from(root_from_tip * self.tip_from_tcp);
        let position = root_from_tcp.translation.iter().copied();
        position
            .chain(root_from_tcp.quaternion_wxyz())
            .for_each(|value| table.cell(WrittenCell::Number(value)));
    }

    /// The largest error of all links with its link; NaN is the largest.
    fn worst(&self, errors: &[PoseError], value: fn(&PoseError) -> f64, table: &mut dyn TableWriter) {
        let by_size = |(_, a): &(usize, f64), (_, b): &(usize, f64)| a.abs().total_cmp(&b.abs());
        match errors.iter().map(value).enumerate().max_by(by_size) {
            Some((link, error)) => {
                table.cell(WrittenCell::Number(error));
                table.cell(WrittenCell::Name(&self.names.links[link]));
            }
            None => [WrittenCell::Missing; 2].into_iter().for_each(|cell| table.cell(cell)),
        }
    }
}

fn number(name: &str) -> WrittenColumn {
    WrittenColumn { name: name.to_owned(), kind: ColumnKind::Number }
}

fn entry(values: &[f64], at: usize) -> WrittenCell<'static> {
    values.get(at).map_or(WrittenCell::Missing, |&value| WrittenCell::Number(value))
}
