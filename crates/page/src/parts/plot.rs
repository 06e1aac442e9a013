//! The place of a plot, which the script of the page draws.

use maud::{Markup, html};

/// The place of the plot of this name, with what it shows.
pub(crate) fn plot(id: &str, caption: &str) -> Markup {
    html! { figure.plot data-chart=(id) { figcaption { (caption) } div.chart {} } }
}
