//! A short summary of a description.

use std::path::Path;

use congruent_description::{DhConvention, JointKind, ReportedChain, RobotDescription};
use congruent_input::{
    Finding,
    display::{counted, quantity},
    is_standard_input, serde_name,
};
use congruent_kinematics::Pose;
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    parts::{JointSummary, LinkSummary, MeshSummary, joints, links, meshes},
    uses::{UseSummary, uses},
};
use crate::jacobians::TcpInLink;

/// The answer of `congruent describe` for one robot.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DescriptionSummary {
    /// The robot file, or the URDF if there is none.
    pub file: String,
    /// Path of the URDF or MJCF.
    pub urdf: String,
    /// Its format: `URDF` or `MJCF`.
    pub format: String,
    /// The SRDF that the robot file names.
    pub srdf: Option<String>,
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// The links at which a chain from the base might end: first the default tip, then the ends of branches of about the same
    /// length.
    pub likely_tips: Vec<LikelyTip>,
    /// The declared DH table, if there is one.
    pub table: Option<TableSummary>,
    /// The declared tool centre point.
    pub tcp: Option<TcpInLink>,
    /// Whether the robot file declares a second description of the dynamics.
    pub has_declared_dynamics: bool,
    /// Sum of the masses of all links.
    pub mass_kg: f64,
    /// Pairs of links that the SRDF disables.
    pub disabled_collisions: usize,
    /// All links, parents before children; the first is the root.
    pub links: Vec<LinkSummary>,
    /// All joints, parents before children.
    pub joints: Vec<JointSummary>,
    /// All mesh files that were read.
    pub meshes: Vec<MeshSummary>,
    /// Whether the description is complete enough for each use.
    pub uses: Vec<UseSummary>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// A link at which a chain might end.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct LikelyTip {
    /// Name of the link.
    pub link: String,
    /// The moving joints from the base to it, mimic joints included.
    pub joints: usize,
}

/// Convention and size of a declared DH table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct TableSummary {
    /// Standard or modified convention.
    pub convention: DhConvention,
    /// Number of rows.
    pub rows: usize,
}

/// The summary of a robot's files.
pub fn describe(description: &RobotDescription) -> DescriptionSummary {
    let robot = &description.robot;
    let tip = |link| {
        let joints = robot.chain(description.base, link).unwrap_or_default();
        let joints = joints.into_iter().filter(|&joint| robot.joint(joint).kind.is_movable()).count();
        LikelyTip { link: robot.link(link).name.clone(), joints }
    };
    let tcp = description.tip_from_tcp.map(|tip_from_tcp| TcpInLink {
        link: robot.link(description.tip).name.clone(),
        link_from_tcp: (&Pose::from(tip_from_tcp)).into(),
    });
    let masses = robot.links().iter().filter_map(|link| link.inertia).map(|inertia| inertia.mass_kg);
    DescriptionSummary {
        file: description.path.display().to_string(),
        urdf: description.urdf_path.display().to_string(),
        format: description.format_name().to_owned(),
        srdf: description.named_files.srdf.as_ref().map(|path| path.display().to_string()),
        robot: description.name.clone(),
        chain: description.reported_chain(),
        likely_tips: description.likely_tips().into_iter().map(tip).collect(),
        table: description
            .dh
            .as_ref()
            .map(|table| TableSummary { convention: table.convention, rows: table.rows.len() }),
        tcp,
        has_declared_dynamics: description.dynamics.is_some(),
        // The sum of nothing is -0.0.
        mass_kg: masses.sum::<f64>() + 0.0,
        disabled_collisions: description.disabled_collisions.len(),
        links: links(robot),
        joints: joints(robot),
        meshes: meshes(robot, folder_of(&description.urdf_path)),
        uses: uses(description),
        warnings: description.warnings.iter().map(Finding::from).collect(),
    }
}

impl DescriptionSummary {
    /// The answer in one line: the robot, its chain, and for what it can be used.
    pub fn answer(&self) -> String {
        let verdict = |of: &UseSummary| {
            let verdict = of.why_nothing().unwrap_or_else(|| of.readiness());
            format!("{} {verdict}", serde_name(&of.needed_for))
        };
        let uses: Vec<String> = self.uses.iter().map(verdict).collect();
        format!("{}; {}; {}; {}", self.robot, self.parts(), self.chain, uses.join(", "))
    }

    /// How many links and joints the robot has, and its mass.
    pub fn parts(&self) -> String {
        let moving = self.joints.iter().filter(|joint| joint.kind != JointKind::Fixed).count();
        format!(
            "{}, {}; {}, {moving} of them moving",
            counted(self.links.len(), "link"),
            quantity(self.mass_kg, "kg"),
            counted(self.joints.len(), "joint"),
        )
    }
}

/// The folder of the URDF; the current one for a bare name and for standard input.
fn folder_of(urdf: &Path) -> &Path {
    let folder = urdf.parent().filter(|folder| !folder.as_os_str().is_empty() && !is_standard_input(urdf));
    folder.unwrap_or(Path::new("."))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use congruent_description::parse_robot;
    use congruent_input::{Capability, SourceFile};

    use super::*;

    fn summary(body: &str) -> DescriptionSummary {
        let text = format!("<robot name='r'>{body}</robot>");
        describe(
            &parse_robot(None, &Arc::new(SourceFile { path: "r.urdf".into(), text, is_foreign: false }))
                .unwrap(),
        )
    }

    #[test]
    fn what_is_not_stated_is_named() {
        let summary = summary(
            "<link name='a'><visual><geometry><sphere radius='1'/></geometry></visual></link>\
             <link name='b'><collision><geometry><sphere radius='1'/></geometry></collision></link>\
             <joint name='j' type='revolute'><parent link='a'/><child link='b'/>\
             <limit lower='1' upper='2' effort='0' velocity='3'/></joint>",
        );
        assert_eq!((summary.joints[0].effort, summary.joints[0].velocity), (None, Some(3.0)));
        let missing = |needed_for: Capability| -> Vec<Vec<String>> {
            let found = summary.uses.iter().find(|each| each.needed_for == needed_for).unwrap();
            found.missing.iter().map(|missing| missing.names.clone()).collect()
        };
        assert_eq!(missing(Capability::Kinematics), [vec![], vec!["j".to_owned()]]);
        assert_eq!(missing(Capability::Clearance), [["a".to_owned()]]);
        let names = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<String>>();
        assert_eq!(missing(Capability::Physics), [names(&["b"]), names(&["j"]), names(&["a", "b"])]);
    }

    #[test]
    fn a_single_link_is_described_too() {
        let summary = summary("<link name='a'/>");
        assert_eq!((summary.links.len(), summary.joints.len(), summary.likely_tips.len()), (1, 0, 1));
        assert!(summary.mass_kg.is_sign_positive());
    }
}
