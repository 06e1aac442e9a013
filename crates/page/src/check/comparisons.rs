//! The comparisons of poses: two sources each, with the largest difference beside the tolerance, then link by link.

use congruent_agreement::compare::{Agreement, CheckReport, Comparison, LinkDifference, PoseSource};
use congruent_description::Tolerance;
use congruent_kinematics::PoseError;
use maud::{Markup, html};

use crate::parts::{BadgeKind, BarScale, Pointer, UnitColumn, UsedShare, badge, value};

/// Units and scale of the bars of a table of pose errors.
struct Columns<'a> {
    position: UnitColumn,
    orientation: UnitColumn,
    tolerance: &'a Tolerance,
    scale: BarScale,
}

impl<'a> Columns<'a> {
    fn new(errors: &[PoseError], tolerance: &'a Tolerance) -> Self {
        let shares = errors.iter().flat_map(|of| {
            [of.position_m / tolerance.position_m, of.orientation_rad / tolerance.orientation_rad]
        });
        Self {
            position: UnitColumn::of_lengths(errors.iter().map(|of| of.position_m)),
            orientation: UnitColumn::of_angles(errors.iter().map(|of| of.orientation_rad)),
            tolerance,
            scale: BarScale::for_shares(shares),
        }
    }

    /// The headings of both parts.
    fn headings(&self) -> Markup {
        html! { th { "position, " (self.position.unit) } th { "orientation, " (self.orientation.unit) } }
    }

    /// Both parts of a difference, each with how much of the tolerance it uses. What agrees beyond the tolerance does so within the
    /// digits of its files, and has no bar.
    fn cells(&self, error: &PoseError, verdict: Agreement, at: &Pointer) -> Markup {
        let Tolerance { position_m, orientation_rad } = *self.tolerance;
        let cell = |name: &str, key: &str, error: f64, tolerance: f64, column: &UnitColumn| {
            let holds = error <= tolerance;
            let has_bar = tolerance > 0.0 && (holds || verdict != Agreement::Agree);
            html! {
                td data-label=(format!("{name}, {}", column.unit)) {
                    (value(&at.key(key), error, &column.words(error)))
                    @if has_bar { (self.scale.bar(UsedShare { share: error / tolerance, holds })) }
                }
            }
        };
        html! {
            (cell("position", "position_m", error.position_m, position_m, &self.position))
            (cell("orientation", "orientation_rad", error.orientation_rad, orientation_rad, &self.orientation))
        }
    }
}

/// The section on poses; `at` is the place of the report in the document.
pub(super) fn comparisons(report: &CheckReport, at: &Pointer) -> Markup {
    let errors: Vec<PoseError> = report.comparisons.iter().map(|of| of.worst.error).collect();
    let columns = Columns::new(&errors, &report.tolerance);
    html! {
        section {
            h2 { "Poses" }
            table {
                thead { tr { th { "compared" } th { "result" } (columns.headings()) th { "largest at" } } }
                tbody {
                    @for (index, comparison) in report.comparisons.iter().enumerate() {
                        (row(comparison, &columns, &at.key("comparisons").key(index)))
                    }
                }
            }
            (BarScale::words())
            @for (index, comparison) in report.comparisons.iter().enumerate() {
                @let differs = comparison.verdict == Agreement::Disagree;
                details open[differs] {
                    summary { "Difference at each link: " (comparison.title) }
                    (links(comparison, &report.tolerance, &at.key("comparisons").key(index).key("links")))
                }
            }
        }
    }
}

fn row(comparison: &Comparison, columns: &Columns<'_>, at: &Pointer) -> Markup {
    let agrees = comparison.verdict == Agreement::Agree;
    let (outcome, word) = if agrees { (BadgeKind::Good, "agree") } else { (BadgeKind::Bad, "disagree") };
    html! {
        tr {
            th scope="row" { (comparison.title) }
            td { (badge(outcome, word)) }
            (columns.cells(&comparison.worst.error, comparison.verdict, &at.key("worst")))
            td data-label="largest at" { (comparison.worst.link) }
        }
    }
}

/// The links whose frames both sources define, then, folded, those behind the tip or between joints whose frames a table does
/// not define: their differences decide nothing and may be larger.
fn links(comparison: &Comparison, tolerance: &Tolerance, at: &Pointer) -> Markup {
    let all = comparison.links.iter().enumerate();
    let (fitted, defined): (Vec<_>, Vec<_>) = all.partition(|(_, of)| of.source == PoseSource::DhFitted);
    html! {
        (link_table(&defined, comparison.verdict, tolerance, at))
        @if !fitted.is_empty() {
            details {
                summary { "for information only: frames that the table does not define (" (fitted.len()) ")" }
                (link_table(&fitted, comparison.verdict, tolerance, at))
            }
        }
    }
}

/// A table of links, each with its place in the report.
fn link_table(
    links: &[(usize, &LinkDifference)],
    verdict: Agreement,
    tolerance: &Tolerance,
    at: &Pointer,
) -> Markup {
    let errors: Vec<PoseError> = links.iter().map(|(_, of)| of.error).collect();
    let columns = Columns::new(&errors, tolerance);
    html! {
        table {
            thead { tr { th { "link" } (columns.headings()) th { "pose of the first" } } }
            tbody {
                @for (index, link) in links {
                    tr {
                        th scope="row" { (link.link) }
                        (columns.cells(&link.error, verdict, &at.key(*index)))
                        td data-label="pose of the first" {
                            @match link.source {
                                PoseSource::Dh | PoseSource::DhFitted => "table",
                                PoseSource::Urdf => "URDF",
                            }
                        }
                    }
                }
            }
        }
    }
}
