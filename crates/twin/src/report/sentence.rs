//! One measured quantity as people read it: the value, its limit and the margin between them.

use congruent_description::display::{quantity, quantity_in_full};

use crate::{
    monitor::{ANGLE_BEYOND_LIMIT, SHIFT_BEYOND_LIMIT},
    verdict::{Bound, CheckResult, Contact, Measure, Moment, Status},
};

/// A check in lines: what was violated first, with the remarks on it. The first line says if it is a default check.
pub fn lines(check: &CheckResult) -> Vec<String> {
    let mut lines = all_lines(check);
    if let Some(first) = lines.first_mut().filter(|_| check.is_default) {
        first.push_str(" (default)");
    }
    if check.is_default && check.status == Status::Fail {
        let kind = check.check;
        lines.push(format!(
            "the scenario has no check {kind}: a [[check]] with kind = \"{kind}\" takes the place of this one"
        ));
    }
    lines
}

fn all_lines(check: &CheckResult) -> Vec<String> {
    let is_violated = |measure: &&Measure| measure.first_violation.is_some();
    let (violated, others): (Vec<_>, Vec<_>) = check.measures.iter().partition(is_violated);
    let notes: Vec<String> = contacts(&check.contacts).chain(check.notes.iter().cloned()).collect();
    let others = others.into_iter().map(sentence);
    if violated.is_empty() {
        return others.chain(notes).collect();
    }
    violated.into_iter().map(sentence).chain(notes).chain(others).collect()
}

/// Contacts that are shown; the report has all.
const SHOWN_CONTACTS: usize = 5;

/// Each contact with its time and depth.
fn contacts(contacts: &[Contact]) -> impl Iterator<Item = String> + '_ {
    let shown = contacts.iter().take(SHOWN_CONTACTS).map(|contact| {
        let Contact { pair: [a, b], from_s, until_s, depth_m } = contact;
        let (from, until) = (quantity(*from_s, "s"), quantity(*until_s, "s"));
        format!("{a}--{b} touch from {from} until {until}, at most {} deep", quantity(*depth_m, "m"))
    });
    let further = contacts.len().saturating_sub(SHOWN_CONTACTS);
    shown.chain((further > 0).then(|| format!("{further} further contacts are in the report")))
}

/// The worst value of a measure beside its limit: `distance 33.8 mm at forearm--table (1.2 s), at least 20 mm: 13.8 mm
/// left`. A violation that began at another time is told with that time.
fn sentence(measure: &Measure) -> String {
    let Some(worst) = worst_moment(measure) else {
        return format!("{}: no value, {}", quantity_words(measure.quantity), limit_words(measure));
    };
    match &measure.first_violation {
        Some(first) if first.time_s < worst.time_s => {
            format!("{}, first at {}", sentence_at(measure, worst), quantity(first.time_s, "s"))
        }
        _ => sentence_at(measure, worst),
    }
}

/// The moment that is told as the worst: rounding decides when a constant value is the worst, so its start is.
pub fn worst_moment(measure: &Measure) -> Option<&Moment> {
    let shown = |moment: &Moment| quantity(moment.value, measure.unit);
    let worst = measure.worst.as_ref()?;
    measure.first_violation.as_ref().filter(|first| shown(first) == shown(worst)).or(Some(worst))
}

/// The same for the value of one instant.
pub fn sentence_at(measure: &Measure, moment: &Moment) -> String {
    let Moment { time_s, subject, value, .. } = moment;
    let time = quantity(*time_s, "s");
    if matches!(measure.quantity, ANGLE_BEYOND_LIMIT | SHIFT_BEYOND_LIMIT) {
        return format!("{} at {subject} ({time})", beyond_joint_limit(*value, measure));
    }
    if value.is_infinite() {
        return format!(
            "{} not reached at {subject} until {time}, {}",
            quantity_words(measure.quantity),
            limit_words(measure)
        );
    }
    if measure.quantity == "distance" && *value < 0.0 {
        return format!(
            "overlap {} at {subject} ({time}), {}",
            quantity(-value, measure.unit),
            overlap(*value, measure)
        );
    }
    let (what, shown) = (quantity_words(measure.quantity), beside_limit(*value, measure));
    format!("{what} {shown} at {subject} ({time}), {}: {}", limit_words(measure), margin(*value, measure))
}

/// How far a value is from its limit, as a column of a table has it: `13.8 mm left`.
pub fn margin_words(measure: &Measure, value: f64) -> String {
    match measure.quantity {
        ANGLE_BEYOND_LIMIT | SHIFT_BEYOND_LIMIT => beyond_joint_limit(value, measure),
        _ if value.is_infinite() => "not reached".to_owned(),
        "distance" if value < 0.0 => overlap(value, measure),
        _ => margin(value, measure),
    }
}

/// The limit of an overlap, which is a distance below 0, and how far it is from it.
fn overlap(value: f64, measure: &Measure) -> String {
    let shown = |length: f64| quantity(length, measure.unit);
    let allowed = -measure.limit;
    match measure.bound {
        bound if bound.holds(value, measure.limit) => {
            format!("at most {}: {} left", shown(allowed), shown(allowed + value))
        }
        Bound::AtLeast if allowed > 0.0 => {
            format!("at most {}: {} above the limit", shown(allowed), shown(-value - allowed))
        }
        _ => "none allowed".to_owned(),
    }
}

/// The limit: `at most 1 um`.
pub fn limit_words(measure: &Measure) -> String {
    if measure.quantity == "distance" && measure.limit < 0.0 {
        return format!("overlap at most {}", quantity(-measure.limit, measure.unit));
    }
    format!("{} {}", measure.bound.words(), share_in_full(measure.limit, measure.unit))
}

/// A value; one without unit that is near its limit has five decimals, which tell them apart.
fn beside_limit(value: f64, Measure { limit, unit, .. }: &Measure) -> String {
    let is_near = (value - limit).abs() < 1e-2 * limit.abs();
    if unit.is_empty() && is_near {
        return share_in_full((value * 1e5).round() / 1e5, unit);
    }
    quantity(value, unit)
}

/// A value; one without unit, of which three digits would lose more than rounding, in full: 1.001.
pub fn share_in_full(value: f64, unit: &str) -> String {
    /// As a part of the value. Kind: rounding of products.
    const LOST: f64 = 1e-9;
    let shown = quantity(value, unit);
    // The margin that a limit has for rounding was not asked for.
    let rounded = (value * 1e6).round() / 1e6;
    let is_lossy = |shown: f64| (shown - rounded).abs() > LOST * rounded.abs();
    let is_share = unit.is_empty() && rounded > 0.1;
    if is_share && shown.parse().is_ok_and(is_lossy) { quantity_in_full(rounded, unit) } else { shown }
}

/// How far a value is from its limit.
fn margin(value: f64, measure: &Measure) -> String {
    let margin = (value - measure.limit).abs();
    let shown = quantity(margin, measure.unit);
    match measure.bound {
        _ if value.is_nan() => "not a number".to_owned(),
        _ if measure.bound == Bound::Above && value <= measure.limit && measure.limit == 0.0 => {
            "they touch or overlap".to_owned()
        }
        _ if margin == 0.0 => "at the limit".to_owned(),
        bound if bound.holds(value, measure.limit) => format!("{shown} left"),
        Bound::AtMost => format!("{shown} above the limit"),
        Bound::AtLeast | Bound::Above => format!("{shown} below the limit"),
    }
}

/// Within this a joint is at its limit, m or rad. Kind: digits of files; the tolerance of a check that states none.
const NEGLIGIBLE: f64 = 1e-6;

/// The distance of a joint from the end of its range; negative values are inside it.
fn beyond_joint_limit(value: f64, measure: &Measure) -> String {
    let shown = quantity(value.abs(), measure.unit);
    match value {
        _ if value.is_nan() => "not a number".to_owned(),
        // A margin is kept from the limit.
        _ if measure.limit < 0.0 => {
            let margin = quantity(-measure.limit, measure.unit);
            match value {
                _ if value > 0.0 => format!("{shown} beyond the limit, with a margin of {margin}"),
                _ if measure.bound.holds(value, measure.limit) => format!("{shown} left, at least {margin}"),
                _ => format!("{shown} left, within the margin of {margin}"),
            }
        }
        _ if value < -measure.limit => format!("{shown} left"),
        _ if measure.bound.holds(value, measure.limit) && value.abs() <= NEGLIGIBLE => {
            "at the limit".to_owned()
        }
        _ if measure.bound.holds(value, measure.limit) => {
            let side = if value > 0.0 { "beyond" } else { "inside" };
            format!("{shown} {side} the limit, with a tolerance of {}", quantity(measure.limit, measure.unit))
        }
        _ if measure.limit > NEGLIGIBLE => {
            let tolerance = quantity(measure.limit, measure.unit);
            format!("{shown} beyond the limit, with a tolerance of {tolerance}")
        }
        _ => format!("{shown} beyond the limit"),
    }
}

/// The name of a quantity in words.
pub fn quantity_words(quantity: &str) -> String {
    quantity.replace('_', " ").replace("tcp", "TCP")
}

#[cfg(test)]
mod tests {
    use congruent_description::JointValues;

    use super::*;

    fn moment(time_s: f64, value: f64) -> Moment {
        Moment { time_s, subject: "here".to_owned(), value, q: JointValues::new(&[], &[]) }
    }

    #[track_caller]
    fn reads(quantity: &'static str, (bound, limit): (Bound, f64), value: f64, expected: &str) {
        let unit = if quantity.starts_with("angle") { "rad" } else { "m" };
        let worst = Some(moment(1.0, value));
        let measure = Measure { quantity, unit, limit, bound, worst, first_violation: None };
        assert_eq!(sentence(&measure), expected);
    }

    #[test]
    fn value_limit_and_margin_stand_side_by_side() {
        reads(
            "position",
            (Bound::AtMost, 1e-9),
            0.005,
            "position 5 mm at here (1 s), at most 1 nm: 5 mm above the limit",
        );
        reads(
            "distance",
            (Bound::AtLeast, 0.02),
            0.0338,
            "distance 33.8 mm at here (1 s), at least 20 mm: 13.8 mm left",
        );
        reads(
            "distance",
            (Bound::AtLeast, 0.05),
            0.0338,
            "distance 33.8 mm at here (1 s), at least 50 mm: 16.2 mm below the limit",
        );
        reads(
            "distance",
            (Bound::Above, 0.0),
            0.0,
            "distance 0 mm at here (1 s), above 0 mm: they touch or overlap",
        );
        reads(
            "position",
            (Bound::AtMost, 0.1),
            f64::NAN,
            "position NaN m at here (1 s), at most 100 mm: not a number",
        );
    }

    #[test]
    fn an_overlap_is_no_negative_distance() {
        let deep = (Bound::AtLeast, -0.005);
        reads("distance", (Bound::Above, 0.0), -0.003, "overlap 3 mm at here (1 s), none allowed");
        reads("distance", deep, -0.003, "overlap 3 mm at here (1 s), at most 5 mm: 2 mm left");
        reads("distance", deep, -0.007, "overlap 7 mm at here (1 s), at most 5 mm: 2 mm above the limit");
        reads("distance", deep, 0.015, "distance 15 mm at here (1 s), overlap at most 5 mm: 20 mm left");
    }

    #[test]
    fn an_end_that_is_not_reached_is_told_so() {
        let worst = Some(moment(4.0, f64::INFINITY));
        let measure = Measure {
            quantity: "cycle_time",
            unit: "s",
            limit: 3.0,
            bound: Bound::AtMost,
            worst,
            first_violation: None,
        };
        assert_eq!(sentence(&measure), "cycle time not reached at here until 4 s, at most 3 s");
    }

    #[test]
    fn a_joint_is_left_at_or_beyond_its_limit() {
        let limit = (Bound::AtMost, 1e-9);
        reads(ANGLE_BEYOND_LIMIT, limit, -1.0663, "61.1 deg left at here (1 s)");
        reads(ANGLE_BEYOND_LIMIT, limit, 5e-10, "at the limit at here (1 s)");
        reads(SHIFT_BEYOND_LIMIT, limit, 0.002, "2 mm beyond the limit at here (1 s)");
        let wide = (Bound::AtMost, 0.005);
        let tolerance = "the limit, with a tolerance of 5 mm at here (1 s)";
        reads(SHIFT_BEYOND_LIMIT, wide, 0.002, &format!("2 mm beyond {tolerance}"));
        reads(SHIFT_BEYOND_LIMIT, wide, -0.002, &format!("2 mm inside {tolerance}"));
        reads(SHIFT_BEYOND_LIMIT, wide, 0.02, &format!("20 mm beyond {tolerance}"));
        let margin = (Bound::AtMost, -0.01);
        reads(SHIFT_BEYOND_LIMIT, margin, -0.02, "20 mm left, at least 10 mm at here (1 s)");
        reads(SHIFT_BEYOND_LIMIT, margin, -0.002, "2 mm left, within the margin of 10 mm at here (1 s)");
        reads(
            SHIFT_BEYOND_LIMIT,
            margin,
            0.002,
            "2 mm beyond the limit, with a margin of 10 mm at here (1 s)",
        );
    }

    #[test]
    fn a_violation_that_grows_is_told_with_its_start() {
        let measure = Measure {
            quantity: "distance",
            unit: "m",
            limit: 0.02,
            bound: Bound::AtLeast,
            worst: Some(moment(1.7, 0.0)),
            first_violation: Some(moment(1.5, 0.019)),
        };
        assert!(
            sentence(&measure).ends_with(": 20 mm below the limit, first at 1.5 s"),
            "{}",
            sentence(&measure)
        );
        let constant = Measure {
            first_violation: Some(moment(0.5, 1e-7)),
            worst: Some(moment(1.7, 1.001e-7)),
            ..measure.clone()
        };
        assert_eq!(
            sentence(&constant),
            "distance 100 nm at here (0.5 s), at least 20 mm: 20 mm below the limit"
        );
        let unseen = Measure { worst: None, first_violation: None, ..measure };
        assert_eq!(sentence(&unseen), "distance: no value, at least 20 mm");
    }
}
