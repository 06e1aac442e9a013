//! Plots as data for the script of the page: JSON, in which numbers of a line are 32 bit floats in base64.

use base64::{Engine, prelude::BASE64_STANDARD};
use serde::{Serialize, Serializer};

/// All plots of a page.
#[derive(Debug, Serialize)]
pub(crate) struct Plots {
    /// Times of every line that has none of its own.
    pub(crate) times_s: Floats,
    pub(crate) charts: Vec<Chart>,
    /// Instants that every plot marks.
    pub(crate) marks: Vec<PlotMark>,
}

/// One plot: lines over time in one unit, with limits drawn across.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Chart {
    /// Name of the figure in the page.
    pub(crate) id: String,
    /// Unit on the axis.
    pub(crate) unit: &'static str,
    /// Units on the axis for one SI unit.
    pub(crate) scale: f64,
    /// Whether the axis is logarithmic.
    pub(crate) log: bool,
    pub(crate) lines: Vec<PlotLine>,
    pub(crate) limits: Vec<PlotLimit>,
    /// Whether the axis reaches to the limits, however far they are.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(crate) has_all_limits: bool,
    /// Points that are marked and named, such as the first violation.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) points: Vec<PlotPoint>,
    /// Lines that were left out, since others are worse.
    #[serde(skip_serializing_if = "is_zero")]
    pub(crate) others: usize,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde gives a reference")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// A line of a plot.
#[derive(Debug, Default, Serialize)]
pub(crate) struct PlotLine {
    pub(crate) name: String,
    pub(crate) values: Floats,
    /// Whether it is hidden until it is chosen in the legend.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(crate) hidden: bool,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(crate) dashed: bool,
    /// Times of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) times_s: Option<Floats>,
    /// What each value is about, as the index of a name.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) subjects: Vec<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) subject_names: Vec<String>,
}

/// A limit, drawn across.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct PlotLimit {
    pub(crate) name: String,
    /// Value of the limit, in SI units.
    pub(crate) value: f64,
}

/// A point of a plot that is marked.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct PlotPoint {
    pub(crate) time_s: f64,
    /// In SI units.
    pub(crate) value: f64,
    pub(crate) text: String,
}

/// An instant to mark.
#[derive(Debug, Serialize)]
pub(crate) struct PlotMark {
    pub(crate) time_s: f64,
    pub(crate) text: String,
    /// `violation`, `stop`, `motion`, `event` or `fault`.
    pub(crate) kind: &'static str,
}

/// Numbers of a line, written as little-endian 32 bit floats in base64.
#[derive(Debug, Clone, Default)]
pub(crate) struct Floats(pub(crate) Vec<f32>);

impl Serialize for Floats {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let bytes: Vec<u8> = self.0.iter().flat_map(|value| value.to_le_bytes()).collect();
        serializer.serialize_str(&BASE64_STANDARD.encode(bytes))
    }
}

impl Plots {
    /// The JSON, in which no text of a file can end the script element around it.
    pub(crate) fn json(&self) -> String {
        let json = serde_json::to_string(self).expect("names are text and numbers are numbers");
        json.replace('<', "\\u003c")
    }
}
