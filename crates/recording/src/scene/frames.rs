//! Frames on demand: of every link by the twin, of the DH table by the model, and of the tool. They follow the recorded
//! poses, so that they cost nothing over time; the layout hides them at first.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::{DhChain, Pose, UrdfTree};
use congruent_monitors::RecordingError;
use nalgebra::{Isometry3, Vector3};
use re_log_types::EntityPath;
use re_sdk_types::archetypes::{Arrows3D, CoordinateFrame};

use super::palette;
use crate::rrd::{
    convert::vector,
    paths,
    writer::{RrdWriter, failed},
};

/// Length of the axes of a frame.
const AXIS_M: f64 = 0.1;
/// Length of the axis of a joint, which is z of a frame of the table.
const JOINT_AXIS_M: f64 = 0.25;

/// A frame that is fixed to a recorded pose.
struct AttachedFrame<'a> {
    kind: &'a str,
    name: &'a str,
    /// The entity whose pose it follows.
    to: EntityPath,
    to_from_frame: Isometry3<f64>,
    z_m: f64,
}

/// Writes the frames of all links, of the table and of the tool.
pub(crate) fn write(writer: &mut RrdWriter, description: &RobotDescription) -> Result<(), RecordingError> {
    for link in description.robot.links() {
        let to = paths::twin(&link.name);
        let (name, to_from_frame) = (link.name.as_str(), Isometry3::identity());
        AttachedFrame { kind: "link", name, to, to_from_frame, z_m: AXIS_M }.write(writer)?;
    }
    let tip = paths::twin(&description.robot.link(description.tip).name);
    let to_from_frame = description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
    AttachedFrame { kind: "tool", name: "tcp", to: tip, to_from_frame, z_m: AXIS_M }.write(writer)?;
    for (number, (link, link_from_dh)) in dh_frames(description)?.into_iter().enumerate() {
        let (name, to) = (format!("dh{number}"), paths::model(link));
        let frame = AttachedFrame {
            kind: "dh",
            name: &name,
            to,
            to_from_frame: link_from_dh.to_isometry(),
            z_m: JOINT_AXIS_M,
        };
        frame.write(writer)?;
    }
    Ok(())
}

/// Link of the model to which each frame of the table is fixed, with the pose of the frame in it.
fn dh_frames(description: &RobotDescription) -> Result<Vec<(&str, Pose)>, RecordingError> {
    let (robot, Some(table)) = (&description.robot, &description.dh) else { return Ok(Vec::new()) };
    let at_zero = RobotQ::zeros(robot.dof());
    let chain = DhChain::new(table, robot);
    let mut base_from_dh = vec![Pose::identity(); chain.joint_count() + 1];
    chain.dh_frames_into(&at_zero, &mut base_from_dh).map_err(failed)?;
    let mut root_from_links = vec![Pose::identity(); robot.links().len()];
    UrdfTree::new(robot).root_from_links_into(&at_zero, &mut root_from_links).map_err(failed)?;
    let root_from_base = root_from_links[description.base.get()];
    let moved = table.rows.iter().map(|row| robot.joint(row.joint).child);
    let links = std::iter::once(description.base).chain(moved);
    // What a row moves has one constant transform, which is fitted at zero as well.
    let fixed = links.zip(&base_from_dh).map(|(link, base_from_dh)| {
        let link_from_root = root_from_links[link.get()].inverse();
        (robot.link(link).name.as_str(), link_from_root * (root_from_base * *base_from_dh))
    });
    let mut frames: Vec<_> = fixed.collect();
    if let Some(last) = frames.last_mut() {
        // The tip is declared in the last frame.
        let tip_from_dhn = Pose::from(table.dhn_from_tip).inverse();
        *last = (robot.link(description.tip).name.as_str(), tip_from_dhn);
    }
    Ok(frames)
}

impl AttachedFrame<'_> {
    fn write(&self, writer: &mut RrdWriter) -> Result<(), RecordingError> {
        // Few components: each costs time and space in every frame.
        let axes = [Vector3::x() * AXIS_M, Vector3::y() * AXIS_M, Vector3::z() * self.z_m];
        let mut arrows = Arrows3D::from_vectors(axes.map(|axis| vector(&(self.to_from_frame * axis))))
            .with_colors(palette::AXES)
            .with_labels([self.name]);
        let origin = &self.to_from_frame.translation.vector;
        if origin.norm() > 0.0 {
            arrows = arrows.with_origins([vector(origin); 3]);
        }
        let attached = CoordinateFrame::new(format!("tf#{}", self.to));
        writer.log_static_together(&paths::frame(self.kind, self.name), &[&attached, &arrows])
    }
}

#[cfg(test)]
mod tests {
    use congruent_agreement::compare::Model;
    use congruent_description::load_robot;
    use congruent_kinematics::PoseError;

    use super::*;

    /// Kind: rounding, m and rad: products of some twenty poses at 1 m, each 2e-16 to 1e-15.
    const SAME: f64 = 2e-14;

    /// Frames that are fixed to links of the model are where the table has them, at any configuration.
    #[test]
    fn frames_of_the_table_follow_the_links_of_the_model() {
        for robot in ["ur5e", "panda"] {
            let path = format!("{}/../../robots/{robot}", env!("CARGO_MANIFEST_DIR"));
            let description = load_robot(path.as_ref()).unwrap();
            let (robot, table) = (&description.robot, description.dh.as_ref().unwrap());
            let mut q = RobotQ::zeros(robot.dof());
            q.iter_mut().zip(1_u8..).for_each(|(q, number)| *q = 0.1 + 0.2 * f64::from(number));
            let mut model = Model::new(&description).unwrap();
            let root_from_links = model.root_from_links(&q).unwrap().to_vec();
            let chain = DhChain::new(table, robot);
            let mut base_from_dh = vec![Pose::identity(); chain.joint_count() + 1];
            chain.dh_frames_into(&q, &mut base_from_dh).unwrap();
            let root_from_base = root_from_links[description.base.get()];
            let frames = dh_frames(&description).unwrap();
            assert_eq!(frames.len(), base_from_dh.len());
            for ((link, link_from_dh), base_from_dh) in frames.into_iter().zip(base_from_dh) {
                let shown = root_from_links[robot.find_link(link).unwrap().get()] * link_from_dh;
                let error = PoseError::to_isometry(&shown, &(root_from_base * base_from_dh).to_isometry());
                assert!(error.position_m < SAME && error.orientation_rad < SAME, "{link}: {error:?}");
            }
        }
    }
}
