//! Figures of a report as SVG text: bars of named values, errors at configurations, and plane views to scale. The appearance
//! of these figures is decided in this file alone.

use congruent_input::display::number;
use plotters::{
    coord::{Shift, types::RangedCoordf64},
    prelude::*,
    style::text_anchor::{HPos, Pos, VPos},
};

/// The drawing library failed; the message is its own.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw the plot: {0}")]
pub struct PlotError(String);

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for PlotError {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self(error.to_string())
    }
}

/// Colours that can be distinguished in print and by the colour-blind (Okabe & Ito 2008).
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 114, 178), RGBColor(230, 159, 0), RGBColor(0, 158, 115), RGBColor(204, 121, 167)];
/// The planes of a view, by their axes.
pub(crate) const PLANES: [[usize; 2]; 3] = [[0, 1], [0, 2], [1, 2]];
/// Names of the axes.
pub(crate) const AXES: [&str; 3] = ["x in m", "y in m", "z in m"];
pub(crate) const GREY: RGBColor = RGBColor(90, 90, 90);
pub(crate) const FONT: &str = "sans-serif";
pub(crate) const TITLE_PX: u32 = 44;

pub(crate) type PlotArea<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A plane with coordinates in metres.
type Plane<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// One bar: its length, and a mark within it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bar {
    /// End of the bar.
    pub worst: f64,
    /// Place of the mark.
    pub mean: f64,
}

/// Bars in groups, each with one bar for each series.
#[derive(Debug, Clone, PartialEq)]
pub struct BarChart {
    /// Title above the chart.
    pub title: String,
    /// Name of the axis, with its unit.
    pub axis: String,
    /// Names of the series.
    pub series: Vec<String>,
    /// Names of the groups, each with a bar for each series.
    pub groups: Vec<(String, Vec<Bar>)>,
    /// What is not drawn, below the chart; empty if everything is.
    pub note: String,
}

/// Draws horizontal bars, the worst as the bar and the mean as a line in it.
///
/// # Errors
/// [`PlotError`] if the drawing library refuses.
pub fn bars(chart: &BarChart) -> Result<String, PlotError> {
    const BAR_PX: u32 = 17;
    let rows = chart.groups.iter().map(|(_, bars)| bars.len() + 1).sum::<usize>();
    let height = TITLE_PX + 90 + note_px(&chart.note) + u32::try_from(rows).unwrap_or(u32::MAX / 64) * BAR_PX;
    let largest =
        chart.groups.iter().flat_map(|(_, bars)| bars).fold(0.0, |most: f64, bar| most.max(bar.worst));
    let name_px = chart.groups.iter().map(|(name, _)| name.len()).max().unwrap_or(0) * 7 + 24;
    let mut svg = String::new();
    {
        let root = page(&mut svg, 860, height, &chart.title)?;
        let mut plane = ChartBuilder::on(&root)
            .margin(12)
            .margin_top(TITLE_PX + 22)
            .margin_bottom(12 + note_px(&chart.note))
            .x_label_area_size(44)
            .y_label_area_size(u32::try_from(name_px).unwrap_or(200))
            .build_cartesian_2d(0.0..(largest * 1.12).max(f64::MIN_POSITIVE), as_f64(rows)..0.0)?;
        plane
            .configure_mesh()
            .disable_y_mesh()
            .y_labels(0)
            .light_line_style(TRANSPARENT)
            .x_desc(&chart.axis)
            .label_style((FONT, 13))
            .draw()?;
        let mut row = 0.5;
        for (name, bars) in &chart.groups {
            let middle = plane.backend_coord(&(0.0, row + as_f64(bars.len()) / 2.0));
            text(&root, name, middle.0 - 8, middle.1, HPos::Right)?;
            for (series, bar) in bars.iter().enumerate() {
                let corners = [(0.0, row + 0.06), (bar.worst, row + 0.94)];
                plane.draw_series([Rectangle::new(corners, colour(series).filled())])?;
                let mark = vec![(bar.mean, row + 0.06), (bar.mean, row + 0.94)];
                plane.draw_series([PathElement::new(mark, WHITE.stroke_width(2))])?;
                let end = plane.backend_coord(&(bar.worst, row + 0.5));
                text(&root, &number(bar.worst), end.0 + 5, end.1, HPos::Left)?;
                row += 1.0;
            }
            row += 1.0;
        }
        legend(&root, &chart.series)?;
        note(&root, &chart.note)?;
    }
    Ok(svg)
}

/// Errors at configurations, each panel with another quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorChart {
    /// Title above the panels.
    pub title: String,
    /// Names of the series.
    pub series: Vec<String>,
    /// The panels, one below another.
    pub panels: Vec<ErrorPanel>,
}

/// One quantity at each configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorPanel {
    /// Name of the quantity.
    pub name: String,
    /// Unit of the values and the tolerance.
    pub unit: String,
    /// The values of each series, from the first configuration on.
    pub values: Vec<Vec<f64>>,
    /// The largest value that counts as agreement.
    pub tolerance: f64,
}

/// Draws a point for each configuration, and the tolerance as a line.
///
/// # Errors
/// [`PlotError`] if the drawing library refuses.
pub fn errors(chart: &ErrorChart) -> Result<String, PlotError> {
    const PANEL_PX: u32 = 260;
    let count = u32::try_from(chart.panels.len().max(1)).unwrap_or(1);
    let mut svg = String::new();
    {
        let root = page(&mut svg, 860, TITLE_PX + 24 + PANEL_PX * count, &chart.title)?;
        legend(&root, &chart.series)?;
        let (_, below) = root.split_vertically(TITLE_PX + 20);
        for (area, panel) in below.split_evenly((chart.panels.len().max(1), 1)).iter().zip(&chart.panels) {
            draw_errors(area, panel)?;
        }
    }
    Ok(svg)
}

fn draw_errors(area: &PlotArea<'_>, panel: &ErrorPanel) -> Result<(), PlotError> {
    let all = || panel.values.iter().flatten().copied().filter(|value| value.is_finite());
    let largest = all().fold(0.0, f64::max);
    // Without any error the tolerance alone gives the scale.
    let top = 1.15 * if largest > 0.0 { largest } else { panel.tolerance };
    let configurations = panel.values.iter().map(Vec::len).max().unwrap_or(0);
    let mut plane = ChartBuilder::on(area)
        .margin(14)
        .margin_top(26)
        .x_label_area_size(40)
        .y_label_area_size(76)
        .build_cartesian_2d(0.5..as_f64(configurations.max(1)) + 0.5, 0.0..top.max(f64::MIN_POSITIVE))?;
    plane
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .x_labels(configurations.clamp(1, 12))
        .x_label_formatter(&|at| format!("{at:.0}"))
        .x_desc("configuration")
        .y_desc(format!("{} in {}", panel.name, panel.unit))
        .y_labels(6)
        .y_label_formatter(&|value| number(*value))
        .label_style((FONT, 13))
        .draw()?;
    for (series, values) in panel.values.iter().enumerate() {
        let points: Vec<(f64, f64)> =
            values.iter().enumerate().map(|(at, &value)| (as_f64(at) + 1.0, value)).collect();
        let finite = points.iter().filter(|(_, value)| value.is_finite());
        plane.draw_series(
            finite.clone().map(|&(at, value)| PathElement::new(vec![(at, 0.0), (at, value)], colour(series))),
        )?;
        plane.draw_series(finite.map(|&point| Circle::new(point, 4, colour(series).filled())))?;
    }
    let is_above = panel.tolerance > top;
    if !is_above {
        let ends = vec![(0.5, panel.tolerance), (as_f64(configurations.max(1)) + 0.5, panel.tolerance)];
        plane.draw_series([PathElement::new(ends, GREY.stroke_width(2))])?;
    }
    let place = if is_above { ", above the chart" } else { " (grey line)" };
    let tolerance = format!("tolerance {} {}{place}", number(panel.tolerance), panel.unit);
    text(area, &tolerance, 80, 12, HPos::Left)
}

/// A curve in a plane view.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Points in the plane, m.
    pub points: Vec<[f64; 2]>,
    /// Which colour; `None` for grey.
    pub series: Option<usize>,
}

/// A plane view to scale.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneView {
    /// Names of the axes, with units.
    pub axes: [String; 2],
    /// Filled rectangles by opposite corners.
    pub areas: Vec<[[f64; 2]; 2]>,
    /// Curves, drawn over the areas.
    pub curves: Vec<Curve>,
    /// Points that are drawn as dots.
    pub marks: Vec<[f64; 2]>,
    /// Words in the plane.
    pub labels: Vec<PlaneLabel>,
}

/// Words above a point of a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneLabel {
    /// The point below the middle of the words, m.
    pub at: [f64; 2],
    /// The words.
    pub text: String,
}

/// Views side by side, all at one scale.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneViews {
    /// Title above the views.
    pub title: String,
    /// Names of the series.
    pub series: Vec<String>,
    /// The views from left to right.
    pub views: Vec<PlaneView>,
    /// What the views leave out, below them; empty if nothing.
    pub note: String,
}

/// Draws views side by side.
///
/// # Errors
/// [`PlotError`] if the drawing library refuses.
pub fn views(PlaneViews { title, series, views, note: below }: &PlaneViews) -> Result<String, PlotError> {
    const VIEW_PX: u32 = 430;
    /// Room for the title.
    const NARROWEST_PX: u32 = 620;
    let count = u32::try_from(views.len().max(1)).unwrap_or(1);
    // One scale for all views, so that they can be compared.
    let radius = views.iter().map(|view| span(view).1).fold(f64::MIN_POSITIVE, f64::max) * 1.06;
    let mut svg = String::new();
    {
        let width = (VIEW_PX * count).max(NARROWEST_PX);
        let root = page(&mut svg, width, VIEW_PX + TITLE_PX + 24 + note_px(below), title)?;
        legend(&root, series)?;
        note(&root, below)?;
        let (_, lower) = root.split_vertically(TITLE_PX + 20);
        let (drawn, _) = lower.split_vertically(VIEW_PX);
        for (area, view) in drawn.split_evenly((1, views.len().max(1))).iter().zip(views) {
            draw_view(area, view, radius)?;
        }
    }
    Ok(svg)
}

fn draw_view(area: &PlotArea<'_>, view: &PlaneView, radius: f64) -> Result<(), PlotError> {
    let (centre, _) = span(view);
    let mut plane = plane_to_scale(area, centre, radius, &view.axes)?;
    let fill = COLOURS[0].mix(0.45).filled();
    plane.draw_series(view.areas.iter().map(|[a, b]| Rectangle::new([(a[0], a[1]), (b[0], b[1])], fill)))?;
    for curve in &view.curves {
        let style = curve.series.map_or(GREY, colour).stroke_width(2);
        let points: Vec<(f64, f64)> = curve.points.iter().map(|point| (point[0], point[1])).collect();
        plane.draw_series([PathElement::new(points, style)])?;
    }
    plane.draw_series(view.marks.iter().map(|mark| Circle::new((mark[0], mark[1]), 4, GREY.filled())))?;
    for label in &view.labels {
        let (x, y) = plane.backend_coord(&(label.at[0], label.at[1]));
        let (left, top) = area.get_base_pixel();
        text(area, &label.text, x - left, y - top - 9, HPos::Center)?;
    }
    Ok(())
}

/// The axes of a plane with as many metres per pixel along both; `half` is the least extent to each side of the centre.
pub(crate) fn plane_to_scale<'a>(
    area: &PlotArea<'a>,
    [x, y]: [f64; 2],
    half: f64,
    axes: &[String; 2],
) -> Result<Plane<'a>, PlotError> {
    let mut builder = ChartBuilder::on(area);
    builder.margin(14).x_label_area_size(44).y_label_area_size(56);
    let (width, height) = builder.build_cartesian_2d(0.0..1.0, 0.0..1.0)?.plotting_area().dim_in_pixel();
    let per_pixel = 2.0 * half / f64::from(width.min(height));
    let [half_x, half_y] = [width, height].map(|pixels| per_pixel * f64::from(pixels) / 2.0);
    let mut plane = builder.build_cartesian_2d(x - half_x..x + half_x, y - half_y..y + half_y)?;
    plane
        .configure_mesh()
        .x_desc(&axes[0])
        .y_desc(&axes[1])
        .light_line_style(TRANSPARENT)
        .x_labels(7)
        .y_labels(7)
        .x_label_formatter(&|at| tick(*at))
        .y_label_formatter(&|at| tick(*at))
        .label_style((FONT, 13))
        .draw()?;
    Ok(plane)
}

/// A tick of an axis in metres; steps of the axis add up to nearly 0, which must not read -0.0.
fn tick(value: f64) -> String {
    number((value * 1e9).round() / 1e9 + 0.0)
}

/// Middle and half extent of the contents of a view.
fn span(view: &PlaneView) -> ([f64; 2], f64) {
    let corners = view.areas.iter().flatten();
    let all = corners.chain(view.curves.iter().flat_map(|curve| &curve.points)).chain(&view.marks);
    let (mut lower, mut upper) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in all {
        for axis in 0..2 {
            lower[axis] = lower[axis].min(point[axis]);
            upper[axis] = upper[axis].max(point[axis]);
        }
    }
    if lower[0] > upper[0] {
        return ([0.0; 2], 1.0);
    }
    let half = (0..2).map(|axis| (upper[axis] - lower[axis]) / 2.0).fold(0.0, f64::max);
    ([0, 1].map(|axis| f64::midpoint(lower[axis], upper[axis])), half)
}

pub(crate) fn page<'a>(
    svg: &'a mut String,
    width: u32,
    height: u32,
    title: &str,
) -> Result<PlotArea<'a>, PlotError> {
    let root = SVGBackend::with_string(svg, (width, height)).into_drawing_area();
    root.fill(&WHITE)?;
    let style = (FONT, 18).into_font().color(&BLACK);
    root.draw(&Text::new(title.to_owned(), (16, 14), style))?;
    Ok(root)
}

/// Height of a line below the chart.
pub(crate) fn note_px(words: &str) -> u32 {
    if words.is_empty() { 0 } else { 24 }
}

pub(crate) fn note(root: &PlotArea<'_>, words: &str) -> Result<(), PlotError> {
    let bottom = i32::try_from(root.dim_in_pixel().1).unwrap_or(i32::MAX);
    if words.is_empty() { Ok(()) } else { text(root, words, 16, bottom - 14, HPos::Left) }
}

fn legend(root: &PlotArea<'_>, series: &[String]) -> Result<(), PlotError> {
    let mut left = 16;
    for (index, name) in series.iter().enumerate() {
        root.draw(&Rectangle::new([(left, 44), (left + 12, 56)], colour(index).filled()))?;
        text(root, name, left + 18, 50, HPos::Left)?;
        left += 40 + 7 * i32::try_from(name.len()).unwrap_or(0);
    }
    Ok(())
}

pub(crate) fn text(root: &PlotArea<'_>, words: &str, x: i32, y: i32, side: HPos) -> Result<(), PlotError> {
    let style = TextStyle::from((FONT, 13).into_font()).color(&BLACK).pos(Pos::new(side, VPos::Center));
    root.draw(&Text::new(words.to_owned(), (x, y), style))?;
    Ok(())
}

fn colour(series: usize) -> RGBColor {
    COLOURS[series % COLOURS.len()]
}

#[expect(clippy::cast_precision_loss, reason = "a plot has few rows")]
fn as_f64(rows: usize) -> f64 {
    rows as f64
}
