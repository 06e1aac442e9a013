//! Checks a robot file against its robot: names, chain, table, values.

use std::ops::Range;

use congruent_input::{Diagnostic, Diagnostics, WrittenTransform, known_names, units::Unit};
use congruent_robot::{
    DeclaredTolerances, DhConvention, DhTable, JointIndex, LinkIndex, RequestedTolerance, Robot, Tolerance,
};
use nalgebra::Isometry3;
use toml::Spanned;

use super::{
    inertials::{self, DynamicsTable, InertialContext},
    limits,
    mapping::{self, DeclaredMapping, DeclaredReference},
    rows::{self, ChainContext, first_line},
    unit_mistakes,
    written::{WrittenDh, WrittenRobot, WrittenTolerance},
};
use crate::{
    chain::{ChainEnd, ChainEnds, choose_tip},
    codes,
};

/// The checked declarations of a robot file, with names resolved to indices.
#[derive(Debug)]
pub(crate) struct Declared {
    pub(crate) base: LinkIndex,
    pub(crate) tip: LinkIndex,
    pub(crate) chain_ends: ChainEnds,
    pub(crate) dh: Option<DhTable>,
    pub(crate) dynamics: Option<DynamicsTable>,
    pub(crate) accelerations: Vec<Option<f64>>,
    pub(crate) tip_from_tcp: Option<Isometry3<f64>>,
    pub(crate) tolerance: Tolerance,
    /// The parts of the tolerance that the file has.
    pub(crate) tolerance_parts: RequestedTolerance,
    pub(crate) tolerances: Option<DeclaredTolerances>,
    pub(crate) mapping: Option<DeclaredMapping>,
    pub(crate) references: Vec<DeclaredReference>,
}

/// Checks a parsed robot file against `robot`. `text` is the text that it was parsed from; `None` if no chain or table results.
pub(crate) fn check(
    written: &WrittenRobot,
    text: &str,
    robot: &Robot,
    diagnostics: &mut Diagnostics,
) -> Option<Declared> {
    let tolerance_parts = tolerance(written.tolerance.as_ref(), diagnostics);
    let tolerance = tolerance_parts.or(Tolerance::default());
    let joints: Vec<&str> = robot.joints().iter().map(|joint| joint.name.as_str()).collect();
    let tolerances =
        written.tolerances.as_ref().map(|of| of.declared(&joints, codes::robot_file::TOLERANCES));
    let tolerances = tolerances.and_then(|of| diagnostics.keep(of));
    let accelerations = limits::accelerations(written.limits.as_ref(), robot, diagnostics);
    let tcp = written.tcp.as_ref().map(Spanned::get_ref);
    let tip_from_tcp = tcp.and_then(|tcp| diagnostics.keep(tcp.isometry()));
    // All that follows needs the chain; what does not was checked before.
    let (base, tip, chain) = chain(written, robot, diagnostics)?;
    let size_m = unit_mistakes::size_m(robot);
    if let (Some(tcp), Some(_)) = (&written.tcp, tip_from_tcp) {
        diagnostics.extend(tcp_is_a_link(tcp.span(), robot, tip));
        diagnostics.extend(unit_mistakes::transform("the tool centre point", tcp.get_ref(), size_m));
    }
    diagnostics.extend(written.dh.iter().flat_map(|dh| unit_mistakes::table(dh.get_ref(), size_m)));
    let context = ChainContext { robot, chain: &chain, text };
    let dh = match &written.dh {
        Some(dh) => Some(table(dh, &context, diagnostics)?),
        None => None,
    };
    let context = InertialContext { robot, dh: dh.as_ref(), text };
    let dynamics = inertials::check(written.dynamics.as_ref(), &written.inertial, &context, diagnostics);
    let end = |written: &Option<_>| if written.is_some() { ChainEnd::Declared } else { ChainEnd::Chosen };
    let chain_ends = ChainEnds { base: end(&written.base), tip: end(&written.tip) };
    let declared = written.mapping.as_ref().map(|of| mapping::mapping(of, robot, diagnostics));
    let references = written.reference.iter().map(|reference| DeclaredReference {
        path: reference.file.get_ref().clone(),
        mapping: match &reference.mapping {
            Some(own) => Some(mapping::mapping(own, robot, diagnostics)),
            None => declared.clone(),
        },
    });
    let references = references.collect();
    Some(Declared {
        base,
        tip,
        chain_ends,
        dh,
        dynamics,
        accelerations,
        tip_from_tcp,
        tolerance,
        tolerance_parts,
        tolerances,
        mapping: declared,
        references,
    })
}

/// A warning if a link is called `tcp`, as the declared tool centre point usually is.
fn tcp_is_a_link(at: Range<usize>, robot: &Robot, tip: LinkIndex) -> Option<Diagnostic> {
    let name = robot.tcp_name();
    let link = robot.find_link("tcp")?;
    let message = format!(
        "the robot has a link \"{}\", so the tool centre point that is declared here (on link \"{}\") is called \"{name}\"",
        robot.link(link).name,
        robot.link(tip).name
    );
    let help = format!("`--to tcp` means the link, `--to {name}` the declared tool centre point");
    Some(Diagnostic::warning(codes::robot_file::TCP_NAME, message).at(at).with_help(help))
}

/// What to write if a joint is named where a link is expected; empty if the robot has no joint of this name.
pub(crate) fn joint_for_link(robot: &Robot, name: &str) -> String {
    let Some(joint) = robot.find_joint(name) else { return String::new() };
    format!("{name} is a joint; its child link is {}; ", robot.link(robot.joint(joint).child).name)
}

fn chain(
    written: &WrittenRobot,
    robot: &Robot,
    diagnostics: &mut Diagnostics,
) -> Option<(LinkIndex, LinkIndex, Vec<JointIndex>)> {
    let mut link = |key: &str, name: &Spanned<String>| {
        diagnostics.keep(robot.find_link(name.get_ref()).ok_or_else(|| {
            let message = format!("{key} = \"{}\": the robot has no such link", name.get_ref());
            let links = robot.links().iter().map(|link| link.name.as_str());
            Diagnostic::error(codes::robot_file::UNKNOWN_LINK, message).at(name.span()).with_help(
                joint_for_link(robot, name.get_ref()) + &known_names(name.get_ref(), "links", links),
            )
        }))
    };
    // Both are looked up before either's absence ends the check.
    let base = written.base.as_ref().map_or(Some(robot.root()), |name| link("base", name));
    let tip = written.tip.as_ref().map(|name| link("tip", name));
    let base = base?;
    let tip = tip.unwrap_or_else(|| Some(choose_tip(robot, base).tip))?;
    let Some(joints) = robot.chain(base, tip) else {
        let (base, tip) = (&robot.link(base).name, &robot.link(tip).name);
        let message = format!("tip \"{tip}\" is not a descendant of base \"{base}\"");
        let at = written.tip.as_ref().or(written.base.as_ref()).map_or(0..0, Spanned::span);
        diagnostics.push(
            Diagnostic::error(codes::robot_file::CHAIN, message)
                .at(at)
                .with_help("the tip must be a link below the base: choose another --tip or --base, or other keys tip and base"),
        );
        return None;
    };
    let moving = joints.into_iter().filter(|&joint| robot.joint(joint).kind.is_movable()).collect();
    Some((base, tip, moving))
}

fn table(
    written: &Spanned<WrittenDh>,
    context: &ChainContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<DhTable> {
    let dh = written.get_ref();
    let transform = |written: &Option<Spanned<WrittenTransform>>, diagnostics: &mut Diagnostics| match written
    {
        Some(written) => diagnostics.keep(written.get_ref().isometry()),
        None => Some(Isometry3::identity()),
    };
    let base_from_dh0 = transform(&dh.base_from_dh0, diagnostics);
    let dhn_from_tip = transform(&dh.dhn_from_tip, diagnostics);
    let rows = rows::check(written, context, diagnostics);
    if dh.convention.is_none() && diagnostics.has_misspelt("convention") {
        return None;
    }
    let convention =
        diagnostics.keep(dh.convention.as_ref().map(|written| *written.get_ref()).ok_or_else(|| {
            Diagnostic::error(codes::robot_file::CONVENTION, "[dh] has no convention")
                .at(first_line(written.span(), context.text))
                .with_help(format!(
                    "convention = \"standard\" is {}; \"modified\" (Craig) is {}; the same values describe a different robot in the other convention",
                    DhConvention::Standard.equation(),
                    DhConvention::Modified.equation()
                ))
        }));
    Some(DhTable {
        convention: convention?,
        source: dh.source.clone(),
        base_from_dh0: base_from_dh0?,
        dhn_from_tip: dhn_from_tip?,
        rows: rows?,
    })
}

fn tolerance(written: Option<&WrittenTolerance>, diagnostics: &mut Diagnostics) -> RequestedTolerance {
    let Some(written) = written else { return RequestedTolerance::default() };
    let mut positive =
        |quantity, unit: Unit, si: &Option<Spanned<f64>>, engineering: &Option<Spanned<f64>>| {
            let value =
                diagnostics.keep(unit.value(quantity, si.as_ref(), engineering.as_ref())).flatten()?;
            let span = si.as_ref().or(engineering.as_ref()).map_or(0..0, Spanned::span);
            if value <= 0.0 {
                let message = format!(
                    "the tolerance of {quantity} must be greater than 0, it is {value} {}",
                    unit.names()[0]
                );
                diagnostics.push(Diagnostic::error(codes::robot_file::TOLERANCE, message).at(span));
            }
            Some(value)
        };
    let position_m = positive("position", Unit::Length, &written.position_m, &written.position_mm);
    let orientation_rad =
        positive("orientation", Unit::Angle, &written.orientation_rad, &written.orientation_deg);
    RequestedTolerance { position_m, orientation_rad }
}

#[cfg(test)]
mod tests;
