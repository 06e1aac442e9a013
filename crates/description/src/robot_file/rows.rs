//! Checks the rows of a Denavit-Hartenberg table against the chain that they describe.

use std::{f64::consts::TAU, ops::Range};

use congruent_input::{Diagnostic, Diagnostics, display::counted, known_names, line_column, units::Unit};
use congruent_robot::{DhRow, DhRowKind, Joint, JointIndex, Robot};
use toml::Spanned;

use super::{
    other_names::other_names,
    written::{WrittenDh, WrittenRow},
};
use crate::codes;

/// The chain and the text against which the rows of a table are checked.
pub(super) struct ChainContext<'a> {
    pub(super) robot: &'a Robot,
    /// The moving joints from base to tip.
    pub(super) chain: &'a [JointIndex],
    pub(super) text: &'a str,
}

pub(super) fn check(
    dh: &Spanned<WrittenDh>,
    context: &ChainContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<DhRow>> {
    let written = &dh.get_ref().row;
    if let Some(found) = other_names(written, context.robot, context.chain) {
        diagnostics.push(found);
        return None;
    }
    let rows: Vec<Option<DhRow>> =
        (0..written.len()).map(|index| row(index, written, context, diagnostics)).collect();
    // All or none: a row with a fault would be reported a second time, as missing.
    let rows: Vec<DhRow> = rows.into_iter().collect::<Option<_>>()?;
    if !joints_twice(written, &rows, context, diagnostics) {
        every_joint_has_a_row(dh, &rows, context, diagnostics);
    }
    order(written, &rows, context, diagnostics);
    (!rows.is_empty()).then_some(rows)
}

/// Whether a finding is about this quantity: under a key without a unit, in another unit (`d_cm`), or under a misspelt one.
fn is_under_another_key(found: &Diagnostic, quantity: &str, unit: Unit) -> bool {
    let is_without_unit = found.code == congruent_input::codes::toml::UNKNOWN_KEY
        && found.message.starts_with(&format!("\"{quantity}\" needs a unit"));
    let is_in_other_unit = found.code == congruent_input::codes::toml::UNKNOWN_KEY
        && found.message.starts_with(&format!("unknown key \"{quantity}_"));
    is_without_unit || is_in_other_unit || unit.keys(quantity).iter().any(|key| found.is_misspelt(key))
}

fn row(
    index: usize,
    all: &[Spanned<WrittenRow>],
    context: &ChainContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<DhRow> {
    let written = &all[index];
    let row = written.get_ref();
    let next = all.get(index + 1).map_or(context.text.len(), |next| next.span().start);
    let is_in_row = |found: &Diagnostic| {
        found.span.as_ref().is_some_and(|span| (written.span().start..next).contains(&span.start))
    };
    let at = || first_line(written.span(), context.text);
    let mut value = |quantity, unit: Unit, si: &Option<Spanned<f64>>, engineering: &Option<Spanned<f64>>| {
        diagnostics.keep(unit.value(quantity, si.as_ref(), engineering.as_ref()))
    };
    let a_m = value("a", Unit::Length, &row.a_m, &row.a_mm);
    let alpha_rad = value("alpha", Unit::Angle, &row.alpha_rad, &row.alpha_deg);
    let d_m = value("d", Unit::Length, &row.d_m, &row.d_mm);
    let theta_rad = value("theta", Unit::Angle, &row.theta_rad, &row.theta_deg);
    let mut needed = |quantity, unit: Unit, value: Option<Option<f64>>| {
        // It is written under another key, which is reported already.
        if value == Some(None)
            && diagnostics.any(|found| is_in_row(found) && is_under_another_key(found, quantity, unit))
        {
            return None;
        }
        diagnostics.keep(value?.ok_or_else(|| {
            let [si, engineering] = unit.keys(quantity);
            let message =
                format!("row of joint \"{}\" has neither {si} nor {engineering}", row.joint.get_ref());
            Diagnostic::error(codes::robot_file::MISSING_FIGURE, message)
                .at(at())
                .with_help(format!("write {engineering} = 0 if the data sheet has 0"))
        }))
    };
    let a_m = needed("a", Unit::Length, a_m);
    let alpha_rad = needed("alpha", Unit::Angle, alpha_rad);
    let d_m = needed("d", Unit::Length, d_m);
    more_than_a_turn(row, [alpha_rad, theta_rad.flatten()], diagnostics);
    let sign = sign(row, diagnostics);
    let joint = joint(row, context, diagnostics);
    Some(DhRow {
        joint: joint?,
        kind: *row.kind.get_ref(),
        a_m: a_m?,
        alpha_rad: alpha_rad?,
        d_m: d_m?,
        theta_rad: theta_rad?.unwrap_or(0.0),
        sign: sign?,
        line: line_column(context.text, written.span().start).0,
    })
}

/// Warns of angles in radians that are probably in degrees.
fn more_than_a_turn(
    row: &WrittenRow,
    [alpha_rad, theta_rad]: [Option<f64>; 2],
    diagnostics: &mut Diagnostics,
) {
    // Only under the keys in radians: in degrees such values are usual.
    for (quantity, value, span) in [
        ("alpha", alpha_rad, row.alpha_rad.as_ref().map(Spanned::span)),
        ("theta", theta_rad, row.theta_rad.as_ref().map(Spanned::span)),
    ] {
        if let (Some(value), Some(span)) = (value, span)
            && value.abs() > TAU
        {
            let message = format!("{quantity}_rad = {value} is more than a full turn");
            diagnostics.push(
                Diagnostic::warning(codes::robot_file::DEGREES, message)
                    .at(span)
                    .with_help(format!("if the value is in degrees, the key is {quantity}_deg")),
            );
        }
    }
}

fn sign(row: &WrittenRow, diagnostics: &mut Diagnostics) -> Option<f64> {
    let Some(sign) = &row.sign else { return Some(1.0) };
    match *sign.get_ref() {
        value @ (1.0 | -1.0) => Some(value),
        value => {
            let message = format!("sign must be 1 or -1, it is {value}");
            diagnostics.push(Diagnostic::error(codes::robot_file::SIGN, message).at(sign.span()));
            None
        }
    }
}

/// What to declare for a moving joint to be in the chain.
fn chain_with(robot: &Robot, chain: &[JointIndex], joint: JointIndex) -> String {
    let carried = &robot.link(robot.joint(joint).child).name;
    let before = &robot.link(robot.joint(joint).parent).name;
    let is_behind = |link, joints: &[JointIndex]| {
        robot.chain(robot.root(), link).is_some_and(|path| joints.iter().all(|of| path.contains(of)))
    };
    let first = chain.first().map(|&first| robot.joint(first).parent);
    if is_behind(robot.joint(joint).child, chain) {
        format!("the joint is behind the tip: declare tip = \"{carried}\", or a link behind it")
    } else if first.is_some_and(|first| is_behind(first, &[joint])) {
        format!("the joint is before the base: declare base = \"{before}\", or a link before it")
    } else {
        format!(
            "the joint is on another branch of the robot: declare tip = \"{carried}\" for a table of that branch"
        )
    }
}

/// The joint of a row, which must be a moving one of the chain.
fn joint(row: &WrittenRow, context: &ChainContext<'_>, diagnostics: &mut Diagnostics) -> Option<JointIndex> {
    let (name, robot) = (row.joint.get_ref(), context.robot);
    let names = || context.chain.iter().map(|&joint| robot.joint(joint).name.as_str());
    let found = robot.find_joint(name).filter(|joint| context.chain.contains(joint));
    let Some(joint) = found else {
        let what = match robot.find_joint(name) {
            Some(joint) if !robot.joint(joint).kind.is_movable() => "is fixed, so it cannot have a row",
            Some(_) => "is not in the chain from base to tip",
            None => "is not in the robot",
        };
        let message = format!("joint \"{name}\" {what}");
        let help = match robot.find_joint(name).filter(|&joint| robot.joint(joint).kind.is_movable()) {
            Some(joint) => chain_with(robot, context.chain, joint),
            None => known_names(name, "moving joints of the chain", names().collect::<Vec<_>>()),
        };
        diagnostics.push(
            Diagnostic::error(codes::robot_file::UNKNOWN_JOINT, message).at(row.joint.span()).with_help(help),
        );
        return None;
    };
    let kind = *row.kind.get_ref();
    let is_angular = robot.joint(joint).kind.is_angular();
    if is_angular != (kind == DhRowKind::Revolute) {
        let unit = if is_angular { "radians" } else { "metres" };
        let message = format!("the row is {}, but joint \"{name}\" of the URDF moves in {unit}", kind.name());
        diagnostics.push(Diagnostic::warning(codes::robot_file::ROW_KIND, message).at(row.kind.span()));
    }
    Some(joint)
}

/// Rows of one joint whose lines are listed. Kind: choice.
const MOST_LINES: usize = 8;

/// Reports the joints that have several rows, with the joints that have none: usually one name is wrong. Whether there are
/// any.
fn joints_twice(
    written: &[Spanned<WrittenRow>],
    rows: &[DhRow],
    context: &ChainContext<'_>,
    diagnostics: &mut Diagnostics,
) -> bool {
    let robot = context.robot;
    let lines_of = |joint: JointIndex| -> Vec<String> {
        rows.iter().filter(|row| row.joint == joint).map(|row| row.line.to_string()).collect()
    };
    let without_row = context.chain.iter().map(|&joint| (joint, robot.joint(joint)));
    let without_row: Vec<&str> = without_row
        .filter(|(joint, of)| of.mimic.is_none() && lines_of(*joint).is_empty())
        .map(|(_, of)| of.name.as_str())
        .collect();
    let is_second = |index: usize| {
        let same = rows[..index].iter().filter(|first| first.joint == rows[index].joint);
        same.count() == 1
    };
    let twice: Vec<usize> = (0..rows.len()).filter(|&index| is_second(index)).collect();
    for (number, &index) in twice.iter().enumerate() {
        let (name, lines) = (&written[index].get_ref().joint, lines_of(rows[index].joint));
        let count = if lines.len() == 2 { "two".to_owned() } else { lines.len().to_string() };
        let listed = lines[..lines.len().min(MOST_LINES)].join(", ");
        let listed = if lines.len() > MOST_LINES { listed + ", ..." } else { listed };
        // Once, however many joints have several rows.
        let none = match &without_row[..] {
            [] => String::new(),
            _ if number > 0 => String::new(),
            [only] => format!(", joint \"{only}\" has none"),
            several => format!(", these joints have none: {}", several.join(", ")),
        };
        let message = format!("joint \"{}\" has {count} rows (lines {listed}){none}", name.get_ref());
        let found = Diagnostic::error(codes::robot_file::JOINT_TWICE, message).at(name.span());
        diagnostics.push(match without_row[..] {
            [only] if twice.len() == 1 => {
                found.with_help(format!("is one of them the row of \"{only}\"? each joint has one row"))
            }
            _ => found.with_help("each joint has one row"),
        });
    }
    !twice.is_empty()
}

fn every_joint_has_a_row(
    dh: &Spanned<WrittenDh>,
    rows: &[DhRow],
    context: &ChainContext<'_>,
    diagnostics: &mut Diagnostics,
) {
    let robot = context.robot;
    let without_row = context.chain.iter().filter(|&&joint| rows.iter().all(|row| row.joint != joint));
    // A mimic joint is driven by its master, in the model as in the machine.
    let (following, missing): (Vec<&Joint>, Vec<&Joint>) =
        without_row.map(|&joint| robot.joint(joint)).partition(|joint| joint.mimic.is_some());
    if rows.is_empty() && diagnostics.has_misspelt("row") {
        return;
    }
    if missing.is_empty() && !rows.is_empty() {
        followers_have_rows(dh, &following, context, diagnostics);
        return;
    }
    let missing: Vec<&str> = missing.into_iter().map(|joint| joint.name.as_str()).collect();
    let message = format!(
        "the table has {}, but the chain from base to tip has {}: no row for {}",
        counted(rows.len(), "row"),
        counted(context.chain.len(), "moving joint"),
        if missing.is_empty() { "any".to_owned() } else { missing.join(", ") }
    );
    diagnostics.push(
        Diagnostic::error(codes::robot_file::MISSING_ROW, message)
            .at(first_line(dh.span(), context.text))
            .with_help(
                "add a row for each of them, or name another `base` or `tip` if the chain is too long",
            ),
    );
}

/// Warns of mimic joints without a row: they move the tip like any other joint.
fn followers_have_rows(
    dh: &Spanned<WrittenDh>,
    without_row: &[&Joint],
    context: &ChainContext<'_>,
    diagnostics: &mut Diagnostics,
) {
    let follows = |joint: &&Joint| {
        let master = joint.mimic.map(|mimic| context.robot.joint(mimic.master).name.as_str());
        format!("\"{}\" (follows \"{}\")", joint.name, master.unwrap_or_default())
    };
    if without_row.is_empty() {
        return;
    }
    let joints: Vec<String> = without_row.iter().map(follows).collect();
    let message = format!(
        "rows are missing for joints with <mimic>, which do not move in the table then: {}",
        joints.join(", ")
    );
    diagnostics.push(
        Diagnostic::warning(codes::robot_file::MISSING_ROW, message)
            .at(first_line(dh.span(), context.text))
            .with_help("add a row for each of them, at its place in the chain"),
    );
}

fn order(
    written: &[Spanned<WrittenRow>],
    rows: &[DhRow],
    context: &ChainContext<'_>,
    diagnostics: &mut Diagnostics,
) {
    let place = |row: &DhRow| context.chain.iter().position(|&joint| joint == row.joint);
    if let Some(later) = rows.windows(2).position(|pair| place(&pair[0]) > place(&pair[1])) {
        let name = &written[later + 1].get_ref().joint;
        let message = format!(
            "the row of joint \"{}\" is not in the order of the chain from base to tip",
            name.get_ref()
        );
        diagnostics.push(Diagnostic::warning(codes::robot_file::ROW_ORDER, message).at(name.span()));
    }
}

/// The first line of a table, for messages: its whole range may be a hundred lines.
pub(super) fn first_line(span: Range<usize>, text: &str) -> Range<usize> {
    let end = text[span.clone()].find('\n').map_or(span.end, |newline| span.start + newline);
    span.start..end
}
