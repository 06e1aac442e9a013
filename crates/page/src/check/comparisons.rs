//! The comparisons of poses: two sources each, with the largest difference beside the tolerance, then link by link.

use congruent_agreement::compare::{Agreement, CheckReport, Comparison, PoseSource};
use congruent_description::Tolerance;
use congruent_input::display::{angle, length};
use congruent_kinematics::PoseError;
use maud::{Markup, html};

use crate::parts::{BadgeKind, Pointer, badge, value};

/// The section on poses; `at` is the place of the report in the document.
pub(super) fn comparisons(report: &CheckReport, at: &Pointer) -> Markup {
    html! {
        section {
            h2 { "Poses" }
            table {
                thead { tr { th { "compared" } th { "result" } th { "position" } th { "orientation" } th { "largest at" } } }
                tbody {
                    @for (index, comparison) in report.comparisons.iter().enumerate() {
                        (row(comparison, &report.tolerance, &at.key("comparisons").key(index)))
                    }
                }
            }
            @for (index, comparison) in report.comparisons.iter().enumerate() {
                @let differs = comparison.verdict == Agreement::Disagree;
                details open[differs] {
                    summary { "link by link: " (comparison.title) }
                    (links(comparison, &report.tolerance, &at.key("comparisons").key(index).key("links")))
                }
            }
        }
    }
}

fn row(comparison: &Comparison, tolerance: &Tolerance, at: &Pointer) -> Markup {
    let agrees = comparison.verdict == Agreement::Agree;
    let (outcome, word) = if agrees { (BadgeKind::Good, "agree") } else { (BadgeKind::Bad, "disagree") };
    html! {
        tr {
            th scope="row" { (comparison.title) }
            td { (badge(outcome, word)) }
            (cells(&comparison.worst.error, tolerance, &at.key("worst")))
            td data-label="largest at" { (comparison.worst.link) }
        }
    }
}

fn links(comparison: &Comparison, tolerance: &Tolerance, at: &Pointer) -> Markup {
    html! {
        table {
            thead { tr { th { "link" } th { "position" } th { "orientation" } th { "pose of the first" } } }
            tbody {
                @for (index, link) in comparison.links.iter().enumerate() {
                    tr {
                        th scope="row" { (link.link) }
                        (cells(&link.error, tolerance, &at.key(index)))
                        td data-label="pose of the first" {
                            @match link.source {
                                PoseSource::Dh => "table",
                                PoseSource::DhFitted => "table (the table does not define this frame: for information only)",
                                PoseSource::Urdf => "URDF",
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Both parts of a difference, each with how much of the tolerance it uses.
fn cells(error: &PoseError, tolerance: &Tolerance, at: &Pointer) -> Markup {
    html! {
        td data-label="position" {
            (value(&at.key("position_m"), error.position_m, &length(error.position_m)))
            (bar(error.position_m, tolerance.position_m))
        }
        td data-label="orientation" {
            (value(&at.key("orientation_rad"), error.orientation_rad, &angle(error.orientation_rad)))
            (bar(error.orientation_rad, tolerance.orientation_rad))
        }
    }
}

fn bar(error: f64, tolerance: f64) -> Markup {
    let holds = error <= tolerance;
    let percent = if holds && tolerance > 0.0 {
        100.0 * error / tolerance
    } else if holds {
        0.0
    } else {
        100.0
    };
    let label =
        if holds { format!("{percent:.0} % of the tolerance") } else { "above the tolerance".to_owned() };
    html! {
        div.bar.(if holds { "good" } else { "bad" }) role="img" aria-label=(label) {
            div style=(format!("width:{percent:.1}%")) {}
        }
    }
}
