//! Mimic joints that never move.

use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, Diagnostics};

use crate::codes;

/// Warnings of mimic joints whose multiplier is 0: they never move, whatever the mimicked joint does.
pub fn still_mimics(description: &RobotDescription) -> Vec<Diagnostic> {
    let Some(places) = &description.places.urdf else { return Vec::new() };
    let robot = &description.robot;
    let mut found = Diagnostics::default();
    for joint in robot.joints() {
        let Some(mimic) = joint.mimic.filter(|mimic| mimic.multiplier == 0.0) else { continue };
        let master = &robot.joint(mimic.master).name;
        let message =
            format!("joint \"{}\" mimics \"{master}\" with a multiplier of 0: it never moves", joint.name);
        let warning = Diagnostic::warning(codes::urdf::STILL_MIMIC, message)
            .one_of("joints mimic another with a multiplier of 0: they never move", joint.name.as_str())
            .with_help("give another multiplier (the default is 1), or make the joint fixed");
        let place = places.joint_mimic(&joint.name);
        found.push(place.into_iter().fold(warning, Diagnostic::at));
    }
    found.in_file(places.source())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use congruent_description::parse_robot;
    use congruent_input::SourceFile;

    #[test]
    fn a_multiplier_of_zero_is_reported() {
        let findings = |multiplier: &str| {
            let joint = |name: &str, child: &str, mimic: &str| {
                format!(
                    "<link name='{child}'/><joint name='{name}' type='prismatic'><parent link='a'/><child link='{child}'/>\
                     <limit lower='0' upper='1' velocity='1' effort='1'/>{mimic}</joint>"
                )
            };
            let mimic = format!("<mimic joint='j'{multiplier}/>");
            let joints = joint("j", "b", "") + &joint("k", "c", &mimic);
            let text = format!("<robot name='r'><link name='a'/>{joints}</robot>");
            let source = Arc::new(SourceFile { path: "r.urdf".into(), text, is_foreign: false });
            let found = still_mimics(&parse_robot(None, &source).unwrap());
            found.into_iter().map(|found| found.message).collect::<Vec<_>>()
        };
        assert_eq!([findings(""), findings(" multiplier='-1'")], [[""; 0], [""; 0]]);
        assert_eq!(
            findings(" multiplier='0'"),
            ["joint \"k\" mimics \"j\" with a multiplier of 0: it never moves"]
        );
    }
}
