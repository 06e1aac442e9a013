//! What `congruent manipulability` prints.

use std::{fmt::Write, iter::once};

use congruent_analysis::manipulability::{
    ConfigurationDexterity, DexterityStream, ManipulabilityReport, ReportedDexterity, ReportedEllipsoid,
};
use congruent_description::Robot;
use congruent_input::display::{in_column, length, number, quantity};

use crate::{TextOptions, layout::Table};

/// What `congruent manipulability` prints: for each configuration the linear and angular velocity ellipsoids and measures, in
/// parts of whole lines.
pub fn manipulability_text_parts<'a>(
    report: &'a ManipulabilityReport<DexterityStream<'_>>,
    robot: &Robot,
    options: &'a TextOptions,
) -> impl Iterator<Item = String> + 'a {
    let mut text = format!("{}: {}\n", report.robot, report.chain);
    let radian = length(report.metres_per_rad);
    let turns =
        |joint: &String| robot.find_joint(joint).is_some_and(|joint| robot.joint(joint).kind.is_angular());
    let per = if report.joints.iter().any(turns) { "rad" } else { "m" };
    if !report.sliding.is_empty() {
        let _ = writeln!(text, "{radian} of {} count as one radian", report.sliding.join(", "));
    }
    let configuration = move |(at, result): (usize, ConfigurationDexterity)| {
        let [x, y, z] = result.tcp_in_base_m.map(|value| in_column(value, "m"));
        let mut text = format!("configuration {at}: tool at {x}, {y}, {z} mm in the base\n");
        text += &ellipsoid("linear", "m", &result.linear, per, options);
        text += &ellipsoid("angular", "rad", &result.angular, per, options);
        let _ = writeln!(text, "  both, {radian} as one radian: {}", measures(&result.whole, number));
        text
    };
    once(text).chain((1..).zip(report.results.iter()).map(configuration))
}

fn ellipsoid(
    name: &str,
    unit: &str,
    ellipsoid: &ReportedEllipsoid,
    per: &str,
    options: &TextOptions,
) -> String {
    let size = |value: f64| {
        let value = if unit == per { format!("{} {unit}", number(value)) } else { quantity(value, unit) };
        format!("{value} per {per}")
    };
    let mut text = format!("  {name}: {}\n", measures(&ellipsoid.dexterity, size));
    let mut table = Table::default();
    for (semi_axis, axis) in ellipsoid.semi_axes.iter().zip(&ellipsoid.axes) {
        let along = axis.map(|value| in_column(value, ""));
        table.row([String::new(), size(*semi_axis), "along".to_owned()].into_iter().chain(along));
    }
    table.write(&mut text, options.columns);
    text
}

fn measures(found: &ReportedDexterity, size: impl Fn(f64) -> String) -> String {
    let from_singular = found.condition.map_or("singular".to_owned(), |condition| {
        format!("condition {}, {} from singular", number(condition), size(found.distance_to_singularity))
    });
    let directions = match found.directions {
        0 => return "none".to_owned(),
        1 => "1 direction".to_owned(),
        several => format!("{several} directions"),
    };
    format!("{from_singular}, Yoshikawa {}, over {directions}", number(found.yoshikawa))
}
