//! What happens in a run: motions, grasps, payloads, faults and first violations, each from when to when.

use congruent_input::display::{number, quantity};
use congruent_monitors::verdict::Status;
use congruent_results::report::RunReport;
use congruent_scenario::Scenario;
use maud::{Markup, html};

use crate::series::PlotMark;

/// Rows of a kind that are shown; the report has all.
const MOST: usize = 14;

/// Something of the scenario that lasts.
#[derive(Debug, Clone, PartialEq)]
struct Event {
    /// Class in the style sheet: `motion`, `event`, `fault` or `violation`.
    class: &'static str,
    words: String,
    from_s: f64,
    /// `None` if it lasts to the end of the run.
    until_s: Option<f64>,
}

/// Grasps and payloads of a scenario; motions and faults are in the report.
#[derive(Debug, Clone, Default)]
pub(super) struct Events {
    carried: Vec<Event>,
}

impl Events {
    pub(super) fn new(scenario: &Scenario) -> Self {
        let mass = |mass_kg: Option<f64>| {
            mass_kg.map_or_else(String::new, |mass_kg| format!(", {}", quantity(mass_kg, "kg")))
        };
        let grasps = scenario.grasp.iter().map(|of| Event {
            class: "event",
            words: format!("grasp of {}{}", of.body, mass(of.mass_kg)),
            from_s: of.from_s,
            until_s: of.until_s,
        });
        let payloads = scenario.payload.iter().map(|of| Event {
            class: "event",
            words: format!("payload {}{}", of.name, mass(Some(of.mass_kg))),
            from_s: of.from_s,
            until_s: of.until_s,
        });
        Self { carried: grasps.chain(payloads).collect() }
    }

    /// Begin and end of what is carried and of faults, as marks of the plots.
    pub(super) fn marks(&self, report: &RunReport) -> Vec<PlotMark> {
        let end_s = report.simulation.duration_s;
        let events = self.carried.iter().cloned().chain(faults(report));
        let both = events.flat_map(|event| {
            let name = event.words.split([',', ':']).next().unwrap_or_default().to_owned();
            let mark = |time_s: f64, text: String| PlotMark { time_s, text, kind: event.class };
            let begin = (event.from_s > 0.0).then(|| mark(event.from_s, name.clone()));
            let end = event.until_s.filter(|&until_s| until_s < end_s);
            begin
                .into_iter()
                .chain(end.map(|until_s| mark(until_s, format!("end of {name}"))))
                .collect::<Vec<_>>()
        });
        both.filter(|mark| mark.time_s <= end_s).collect()
    }

    /// The section: a row for each event, with its time as a bar.
    pub(super) fn section(&self, report: &RunReport) -> Markup {
        let end_s = report.simulation.duration_s;
        let (motions, further) = motions(report);
        let rows: Vec<Event> = motions
            .into_iter()
            .chain(self.carried.iter().take(MOST).cloned())
            .chain(faults(report).take(MOST))
            .chain(violations(report))
            .collect();
        html! {
            @if !rows.is_empty() && end_s > 0.0 {
                section {
                    h2 { "Events" }
                    div.events {
                        @for event in &rows { (row(event, end_s)) }
                    }
                    @if further > 0 { p.small { "and " (further) " more motions in the report" } }
                }
            }
        }
    }
}

fn row(event: &Event, end_s: f64) -> Markup {
    let until_s = event.until_s.unwrap_or(end_s).clamp(event.from_s, end_s.max(event.from_s));
    let share = |time_s: f64| (100.0 * time_s / end_s).clamp(0.0, 100.0);
    let (left, width) = (share(event.from_s), share(until_s) - share(event.from_s));
    let times = match event.until_s {
        Some(until_s) if until_s > event.from_s => {
            format!("{} to {} s", number(event.from_s), number(until_s))
        }
        Some(_) => format!("{} s", number(event.from_s)),
        None => format!("{} s on", number(event.from_s)),
    };
    html! {
        span.what { (event.words) }
        span.track { i.(event.class) style=(format!("left:{left:.2}%;width:{width:.2}%")) {} }
        span.when { (times) }
    }
}

/// The motions with their numbers, and how many are left out.
fn motions(report: &RunReport) -> (Vec<Event>, usize) {
    let event = |(number, motion): (usize, &congruent_results::report::MotionTimes)| Event {
        class: "motion",
        words: format!("motion {number}: {}", motion.kind),
        from_s: motion.starts_s,
        until_s: Some(motion.starts_s + motion.duration_s),
    };
    let shown = (1..).zip(&report.motions).take(MOST).map(event).collect();
    (shown, report.motions.len().saturating_sub(MOST))
}

fn faults(report: &RunReport) -> impl Iterator<Item = Event> + '_ {
    report.faults.iter().map(|fault| Event {
        class: "fault",
        words: format!("fault, {}", fault.words()),
        from_s: fault.from_s,
        until_s: fault.until_s,
    })
}

/// The first violation of each check that failed.
fn violations(report: &RunReport) -> impl Iterator<Item = Event> + '_ {
    let failed = report.checks_failed_first().into_iter().filter(|check| check.status == Status::Fail);
    failed.filter_map(|check| {
        let times =
            check.measures.iter().filter_map(|measure| Some(measure.first_violation.as_ref()?.time_s));
        let from_s = times.min_by(f64::total_cmp)?;
        let words = format!("{} violated first", check.check);
        Some(Event { class: "violation", words, from_s, until_s: Some(from_s) })
    })
}

#[cfg(test)]
mod tests {
    use congruent_scenario::GraspSettings;

    use super::*;

    #[test]
    fn a_grasp_is_an_event_with_its_mass() {
        let grasp = GraspSettings {
            body: "part".to_owned(),
            from_s: 2.0,
            until_s: Some(5.8),
            mass_kg: Some(1.5),
            ..GraspSettings::default()
        };
        let events = Events::new(&Scenario { grasp: vec![grasp], ..Scenario::default() });
        let [event] = &events.carried[..] else { panic!("{events:?}") };
        assert_eq!((event.words.as_str(), event.until_s), ("grasp of part, 1.5 kg", Some(5.8)));
        let row = row(event, 10.0).into_string();
        assert!(row.contains("left:20.00%;width:38.00%") && row.contains("2 to 5.8 s"), "{row}");
    }
}
