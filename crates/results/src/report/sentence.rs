//! One measured quantity as text: the value, its limit and the margin between them.

use congruent_input::{
    Quantity, SiUnit,
    display::{quantity, quantity_in_full},
};
use congruent_monitors::verdict::{Bound, CheckResult, Contact, ContactLoad, Measure, Moment, Status};

/// The lines of a check in a report: violated quantities first, then remarks, then the others. The first line marks a default
/// check.
pub fn lines(check: &CheckResult) -> Vec<String> {
    let mut lines = all_lines(check);
    if let Some(first) = lines.first_mut().filter(|_| check.is_default) {
        first.push_str(" (default)");
    }
    if check.is_default && check.status == Status::Fail {
        let kind = check.check;
        lines.push(format!(
            "this is a default check: add a [[check]] with kind = \"{kind}\" to set limits of your own"
        ));
    }
    lines
}

fn all_lines(check: &CheckResult) -> Vec<String> {
    let is_violated = |measure: &&Measure| measure.first_violation.is_some();
    let (violated, others): (Vec<_>, Vec<_>) = check.measures.iter().partition(is_violated);
    let notes: Vec<String> = contacts(&check.contacts).chain(check.notes.iter().cloned()).collect();
    let others = others.into_iter().enumerate().map(|(at, measure)| match &check.nearest_that_changes {
        Some(_) if at == 0 => constant(measure),
        _ => sentence(measure),
    });
    if check.status == Status::Inconclusive {
        // The remarks say why the values are not a result.
        return notes.into_iter().chain(others).collect();
    }
    if violated.is_empty() {
        return nearest_that_changes(check).into_iter().chain(others).chain(notes).collect();
    }
    violated.into_iter().map(sentence).chain(notes).chain(others).collect()
}

/// The nearest pair whose distance changes, with limit and margin, before the nearer one that nothing brings nearer.
fn nearest_that_changes(check: &CheckResult) -> Option<String> {
    Some(sentence_at(check.measures.first()?, check.nearest_that_changes.as_ref()?))
}

/// The distance of a pair that keeps it: `nearer, but constant in this run: 33.8 mm at wrist_1_link--wrist_3_link`.
fn constant(measure: &Measure) -> String {
    let Some(worst) = &measure.worst else { return sentence(measure) };
    let distance = quantity(worst.value, measure.unit.symbol());
    format!("nearer, but constant in this run: {distance} at {}", worst.subject)
}

/// Number of contacts that are printed; the report has all.
const SHOWN_CONTACTS: usize = 5;

/// Each contact with its time, depth and force.
fn contacts(contacts: &[Contact]) -> impl Iterator<Item = String> + '_ {
    let shown = contacts.iter().take(SHOWN_CONTACTS).map(|contact| {
        let Contact { pair: [a, b], from_s, until_s, depth_m, force } = contact;
        let (from, until) = (quantity(*from_s, "s"), quantity(*until_s, "s"));
        let force = force.map_or_else(String::new, |ContactLoad { peak_n, peak_s, impulse_n_s }| {
            let (peak, at) = (quantity(peak_n, "N"), quantity(peak_s, "s"));
            format!(", force up to {peak} ({at}), impulse {}", quantity(impulse_n_s, "N s"))
        });
        format!("{a}--{b} touch from {from} to {until}, depth up to {}{force}", quantity(*depth_m, "m"))
    });
    let further = contacts.len().saturating_sub(SHOWN_CONTACTS);
    shown.chain((further > 0).then(|| format!("{further} further contacts are in the report")))
}

/// The worst value of a measure with limit and margin: `distance 33.8 mm at forearm--table (1.2 s), limit >= 20 mm, margin
/// 13.8 mm`. If the violation began earlier, the sentence ends with that time.
fn sentence(measure: &Measure) -> String {
    let Some(worst) = &measure.worst else {
        return format!("{}: no value, {}", quantity_words(measure.quantity), limit_words(measure));
    };
    match &measure.first_violation {
        Some(first) if first.time_s < worst.time_s => {
            format!("{}, first at {}", sentence_at(measure, worst), quantity(first.time_s, "s"))
        }
        _ => sentence_at(measure, worst),
    }
}

/// The value of one moment with limit and margin.
pub fn sentence_at(measure: &Measure, moment: &Moment) -> String {
    let Moment { time_s, subject, value, .. } = moment;
    let time = quantity(*time_s, "s");
    if measure.quantity == Quantity::NotFiniteValues {
        let place = if *value > 0.0 { format!(" at {subject} ({time})") } else { String::new() };
        return not_finite_words(*value) + &place;
    }
    if matches!(measure.quantity, Quantity::AngleBeyondLimit | Quantity::ShiftBeyondLimit) {
        return format!("{} at {subject} ({time})", beyond_joint_limit(*value, measure));
    }
    if is_not_reached(*value, measure.unit) {
        return format!(
            "{} not reached at {subject} until {time}, {}",
            quantity_words(measure.quantity),
            limit_words(measure)
        );
    }
    if measure.quantity == Quantity::Distance && *value < 0.0 {
        return format!(
            "overlap {} at {subject} ({time}), {}",
            quantity(-value, measure.unit.symbol()),
            overlap(*value, measure)
        );
    }
    let (what, shown) = (quantity_words(measure.quantity), beside_limit(*value, measure));
    format!("{what} {shown} at {subject} ({time}), {}, {}", limit_words(measure), margin(*value, measure))
}

/// The margin of a value for a column with that title: `13.8 mm`, or `16.2 mm below the limit`.
pub fn margin_words(measure: &Measure, value: f64) -> String {
    let words = match measure.quantity {
        Quantity::AngleBeyondLimit | Quantity::ShiftBeyondLimit => beyond_joint_limit(value, measure),
        Quantity::NotFiniteValues if value <= 0.0 => "none".to_owned(),
        _ if is_not_reached(value, measure.unit) => "not reached".to_owned(),
        Quantity::Distance if value < 0.0 => overlap(value, measure),
        _ => margin(value, measure),
    };
    match words.strip_prefix("margin ") {
        Some(margin) => margin.to_owned(),
        None => words,
    }
}

/// Limit and margin of an overlap, which is a distance below 0.
fn overlap(value: f64, measure: &Measure) -> String {
    let shown = |length: f64| quantity(length, measure.unit.symbol());
    let allowed = -measure.limit;
    match measure.bound {
        bound if bound.holds(value, measure.limit) => {
            format!("limit <= {}, margin {}", shown(allowed), shown(allowed + value))
        }
        Bound::AtLeast if allowed > 0.0 => {
            format!("limit <= {}, {} above the limit", shown(allowed), shown(-value - allowed))
        }
        _ => "none allowed".to_owned(),
    }
}

/// The limit: `limit <= 1 um`.
pub fn limit_words(measure: &Measure) -> String {
    if measure.quantity == Quantity::Distance && measure.limit < 0.0 {
        return format!("overlap limit <= {}", quantity(-measure.limit, measure.unit.symbol()));
    }
    format!("{} {}", measure.bound.words(), share_in_full(measure.limit, measure.unit))
}

/// The smallest distance of a joint to the end of its range: `>= 0 deg`, or the margin that the check requires.
pub fn joint_limit_words(measure: &Measure) -> String {
    // The usual tolerance is an allowance for rounding, which is none that a reader looks for.
    let least = if measure.limit.abs() <= NEGLIGIBLE { 0.0 } else { -measure.limit };
    format!(">= {}", quantity(least, measure.unit.symbol()))
}

/// A value; a ratio that is near its limit has five decimals, so that the two print differently.
fn beside_limit(value: f64, Measure { limit, unit, .. }: &Measure) -> String {
    let is_near = (value - limit).abs() < 1e-2 * limit.abs();
    if *unit == SiUnit::Ratio && is_near {
        return share_in_full((value * 1e5).round() / 1e5, *unit);
    }
    quantity(value, unit.symbol())
}

/// A value; a ratio in full if three digits would lose more than rounding: 1.001.
pub fn share_in_full(value: f64, unit: SiUnit) -> String {
    /// As a part of the value. Kind: rounding of products.
    const LOST: f64 = 1e-9;
    let shown = quantity(value, unit.symbol());
    // A limit may have an allowance for rounding, 1e-9, which the user did not write.
    let rounded = (value * 1e6).round() / 1e6;
    let is_lossy = |shown: f64| (shown - rounded).abs() > LOST * rounded.abs();
    let is_share = unit == SiUnit::Ratio && rounded > 0.1;
    if is_share && shown.parse().is_ok_and(is_lossy) {
        quantity_in_full(rounded, unit.symbol())
    } else {
        shown
    }
}

/// Distance of a value from its limit, with the side.
fn margin(value: f64, measure: &Measure) -> String {
    let margin = (value - measure.limit).abs();
    let shown = quantity(margin, measure.unit.symbol());
    match measure.bound {
        _ if value.is_nan() => "not a number".to_owned(),
        _ if measure.bound == Bound::Above && value <= measure.limit && measure.limit == 0.0 => {
            "they touch or overlap".to_owned()
        }
        _ if margin == 0.0 => "at the limit".to_owned(),
        bound if bound.holds(value, measure.limit) => format!("margin {shown}"),
        Bound::AtMost => format!("{shown} above the limit"),
        Bound::AtLeast | Bound::Above => format!("{shown} below the limit"),
    }
}

/// A joint nearer to its limit than this is at the limit, m or rad. Kind: digits of files; the default tolerance of the check.
const NEGLIGIBLE: f64 = 1e-6;

/// The words of a run for a quantity that is reported by its margin alone: the position of a joint in its range. `None` for others.
pub fn value_and_margin(
    of: Quantity,
    unit: SiUnit,
    bound: Bound,
    [value, limit]: [f64; 2],
) -> Option<String> {
    let measure = Measure { quantity: of, unit, limit, bound, worst: None, first_violation: None };
    matches!(of, Quantity::AngleBeyondLimit | Quantity::ShiftBeyondLimit)
        .then(|| beyond_joint_limit(value, &measure))
}

/// Margin of a joint to the end of its range; negative values are inside the range.
fn beyond_joint_limit(value: f64, measure: &Measure) -> String {
    let shown = quantity(value.abs(), measure.unit.symbol());
    match value {
        _ if value.is_nan() => "not a number".to_owned(),
        // A negative limit is the margin that the check requires.
        _ if measure.limit < 0.0 => {
            let required = quantity(-measure.limit, measure.unit.symbol());
            let margin =
                if value > 0.0 { format!("{shown} beyond the limit") } else { format!("margin {shown}") };
            format!("{margin} (required margin >= {required})")
        }
        _ if value < -measure.limit => format!("margin {shown}"),
        _ if measure.bound.holds(value, measure.limit) && value.abs() <= NEGLIGIBLE => {
            "at the limit".to_owned()
        }
        _ if measure.bound.holds(value, measure.limit) => {
            let side = if value > 0.0 { "beyond" } else { "inside" };
            format!("{shown} {side} the limit (tolerance {})", quantity(measure.limit, measure.unit.symbol()))
        }
        _ if measure.limit > NEGLIGIBLE => {
            let tolerance = quantity(measure.limit, measure.unit.symbol());
            format!("{shown} beyond the limit (tolerance {tolerance})")
        }
        _ => format!("{shown} beyond the limit"),
    }
}

/// The name of a quantity in words.
pub fn quantity_words(quantity: Quantity) -> String {
    match quantity {
        // The one check with velocities compares those of model and twin.
        Quantity::Velocity | Quantity::AngularVelocity => {
            format!("{} error", quantity.name().replace('_', " "))
        }
        Quantity::NotFiniteValues => "values that are not finite".to_owned(),
        _ => quantity.name().replace('_', " ").replace("tcp", "TCP"),
    }
}

/// A number of values that are NaN or infinite, of which none is allowed.
pub fn not_finite_words(count: f64) -> String {
    match count {
        0.0 => "all values are finite".to_owned(),
        1.0 => "1 value that is not finite".to_owned(),
        _ => format!("{count} values that are not finite"),
    }
}

/// Whether a value is a time that has not come: it is infinite, which JSON does not know.
pub fn is_not_reached(value: f64, unit: SiUnit) -> bool {
    unit == SiUnit::Second && !value.is_finite()
}

#[cfg(test)]
mod tests {
    use congruent_description::JointValues;

    use super::*;

    fn moment(time_s: f64, value: f64) -> Moment {
        Moment { time_s, subject: "here".to_owned(), value, q: JointValues::new(&[], &[]) }
    }

    #[track_caller]
    fn reads(quantity: Quantity, (bound, limit): (Bound, f64), value: f64, expected: &str) {
        let unit = match quantity {
            Quantity::AngleBeyondLimit => SiUnit::Radian,
            Quantity::NotFiniteValues => SiUnit::Ratio,
            Quantity::Velocity => SiUnit::MetrePerSecond,
            _ => SiUnit::Metre,
        };
        let worst = Some(moment(1.0, value));
        let measure = Measure { quantity, unit, limit, bound, worst, first_violation: None };
        assert_eq!(sentence(&measure), expected);
    }

    #[test]
    fn value_limit_and_margin_stand_side_by_side() {
        reads(
            Quantity::Position,
            (Bound::AtMost, 1e-9),
            0.005,
            "position 5 mm at here (1 s), limit <= 1 nm, 5 mm above the limit",
        );
        reads(
            Quantity::Distance,
            (Bound::AtLeast, 0.02),
            0.0338,
            "distance 33.8 mm at here (1 s), limit >= 20 mm, margin 13.8 mm",
        );
        reads(
            Quantity::Distance,
            (Bound::AtLeast, 0.05),
            0.0338,
            "distance 33.8 mm at here (1 s), limit >= 50 mm, 16.2 mm below the limit",
        );
        reads(
            Quantity::Distance,
            (Bound::Above, 0.0),
            0.0,
            "distance 0 mm at here (1 s), limit > 0 mm, they touch or overlap",
        );
        reads(
            Quantity::Position,
            (Bound::AtMost, 0.1),
            f64::NAN,
            "position NaN m at here (1 s), limit <= 100 mm, not a number",
        );
    }

    #[test]
    fn the_words_of_a_quantity_say_what_is_limited() {
        let none = (Bound::AtMost, 0.0);
        reads(Quantity::NotFiniteValues, none, 0.0, "all values are finite");
        reads(Quantity::NotFiniteValues, none, 1.0, "1 value that is not finite at here (1 s)");
        let error = "velocity error 5 mm/s at here (1 s), limit <= 6 mm/s, margin 1 mm/s";
        reads(Quantity::Velocity, (Bound::AtMost, 0.006), 0.005, error);
    }

    #[test]
    fn an_overlap_is_no_negative_distance() {
        let deep = (Bound::AtLeast, -0.005);
        reads(Quantity::Distance, (Bound::Above, 0.0), -0.003, "overlap 3 mm at here (1 s), none allowed");
        reads(Quantity::Distance, deep, -0.003, "overlap 3 mm at here (1 s), limit <= 5 mm, margin 2 mm");
        reads(
            Quantity::Distance,
            deep,
            -0.007,
            "overlap 7 mm at here (1 s), limit <= 5 mm, 2 mm above the limit",
        );
        reads(
            Quantity::Distance,
            deep,
            0.015,
            "distance 15 mm at here (1 s), overlap limit <= 5 mm, margin 20 mm",
        );
    }

    #[test]
    fn an_end_that_is_not_reached_is_reported() {
        let worst = Some(moment(4.0, f64::INFINITY));
        let measure = Measure {
            quantity: Quantity::CycleTime,
            unit: SiUnit::Second,
            limit: 3.0,
            bound: Bound::AtMost,
            worst,
            first_violation: None,
        };
        assert_eq!(sentence(&measure), "cycle time not reached at here until 4 s, limit <= 3 s");
    }

    #[test]
    fn a_joint_is_left_at_or_beyond_its_limit() {
        let limit = (Bound::AtMost, 1e-9);
        reads(Quantity::AngleBeyondLimit, limit, -1.0663, "margin 61.1 deg at here (1 s)");
        reads(Quantity::AngleBeyondLimit, limit, 5e-10, "at the limit at here (1 s)");
        reads(Quantity::ShiftBeyondLimit, limit, 0.002, "2 mm beyond the limit at here (1 s)");
        let wide = (Bound::AtMost, 0.005);
        let tolerance = "the limit (tolerance 5 mm) at here (1 s)";
        reads(Quantity::ShiftBeyondLimit, wide, 0.002, &format!("2 mm beyond {tolerance}"));
        reads(Quantity::ShiftBeyondLimit, wide, -0.002, &format!("2 mm inside {tolerance}"));
        reads(Quantity::ShiftBeyondLimit, wide, 0.02, &format!("20 mm beyond {tolerance}"));
        let margin = (Bound::AtMost, -0.01);
        let required = "(required margin >= 10 mm) at here (1 s)";
        reads(Quantity::ShiftBeyondLimit, margin, -0.02, &format!("margin 20 mm {required}"));
        reads(Quantity::ShiftBeyondLimit, margin, -0.002, &format!("margin 2 mm {required}"));
        reads(Quantity::ShiftBeyondLimit, margin, 0.002, &format!("2 mm beyond the limit {required}"));
    }

    #[test]
    fn a_violation_that_grows_is_reported_with_its_start() {
        let measure = Measure {
            quantity: Quantity::Distance,
            unit: SiUnit::Metre,
            limit: 0.02,
            bound: Bound::AtLeast,
            worst: Some(moment(1.7, 0.0)),
            first_violation: Some(moment(1.5, 0.019)),
        };
        assert!(
            sentence(&measure).ends_with(", 20 mm below the limit, first at 1.5 s"),
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
            "distance 100 nm at here (1.7 s), limit >= 20 mm, 20 mm below the limit, first at 0.5 s"
        );
        let unseen = Measure { worst: None, first_violation: None, ..measure };
        assert_eq!(sentence(&unseen), "distance: no value, limit >= 20 mm");
    }
}
