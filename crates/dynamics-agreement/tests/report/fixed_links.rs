//! Links that are fixed to each other: which of them a sentence names.

use super::*;

/// An arm of two joints; the link that the second carries has another one fixed to it, and no link has a shape.
pub(crate) fn arm_with_fixed_link(second: &str) -> DynamicsModel {
    let text = format!(
        r#"<robot name="arm"><link name="base"/>
        <link name="first"><inertial><origin xyz="0 0.01 0.1"/><mass value="4"/>
          <inertia ixx="0.02" iyy="0.03" izz="0.012" ixy="0" ixz="0.001" iyz="0"/></inertial></link>
        <link name="second">{second}</link>
        <link name="fixed"><inertial><origin xyz="0.05 0.02 0.03"/><mass value="0.8"/>
          <inertia ixx="0.003" iyy="0.002" izz="0.002" ixy="0.0001" ixz="0" iyz="0"/></inertial></link>
        <joint name="j1" type="continuous"><parent link="base"/><child link="first"/><axis xyz="0 0 1"/></joint>
        <joint name="j2" type="continuous"><parent link="first"/><child link="second"/><origin xyz="0 0 0.2"/>
          <axis xyz="0 1 0"/></joint>
        <joint name="f" type="fixed"><parent link="second"/><child link="fixed"/><origin xyz="0.3 0 0.1"/></joint>
        </robot>"#
    );
    DynamicsModel::new(&parse_urdf(&text).unwrap_or_else(|findings| panic!("{findings:#?}")))
}

pub(crate) const SECOND: &str = r#"<inertial><origin xyz="0.2 0.01 0"/><mass value="3"/>
    <inertia ixx="0.02" iyy="0.03" izz="0.025" ixy="0.001" ixz="0" iyz="0"/></inertial>"#;

#[test]
fn the_link_without_inertial_is_named_and_not_one_that_is_fixed_to_it() {
    let (without, with) = (arm_with_fixed_link(""), arm_with_fixed_link(SECOND));
    let report = compare(&unnamed(&without), &unnamed(&with), 1).expect("one chain");
    assert_eq!(causes(&report.explanations), [(DynamicsCause::InertialMissing, "second")]);
    let explanation = &report.explanations[0];
    assert!(explanation.is_a_body && !explanation.contradicted, "{explanation:?}");
    let mass =
        explanation.parameters.iter().find(|parameter| parameter.parameter == "mass").expect("the mass");
    assert_eq!((mass.found, mass.expected), (None, Some(3.0)));
}
