//! Figure of a calibration as SVG: the cost as a function of the most significant correction, and the residual of each
//! measurement.

use congruent_input::display::number;
use plotters::{
    chart::{ChartContext, LabelAreaPosition, SeriesAnno, SeriesLabelPosition},
    coord::{Shift, types::RangedCoordf64},
    prelude::*,
};

use super::calibration_report::{CalibrationReport, CostCurve, RowResidual};

/// Okabe and Ito's colours, which colour-blind readers can distinguish.
const NOMINAL: RGBColor = RGBColor(110, 110, 110);
const LEAST_SQUARES: RGBColor = RGBColor(213, 94, 0);
const ROBUST: RGBColor = RGBColor(0, 114, 178);
const GRID: RGBColor = RGBColor(228, 228, 228);

/// Height of a figure over its largest value: the legend is above all curves and bars.
const ABOVE: f64 = 1.42;

/// Width and height in points.
const SIZE: (u32, u32) = (860, 780);
/// Everything is drawn this many times larger and displayed smaller: the backend rounds to whole units, which would make
/// curves stepped.
const FINE: u32 = 8;
/// [`FINE`] as a coordinate.
const UNIT: i32 = FINE.cast_signed();
const FONT: &str = "sans-serif";
const CAPTION: u32 = 19 * FINE;
const DESCRIPTION: u32 = 15 * FINE;
const LABEL: u32 = 14 * FINE;

/// The drawing library failed; the message is its own.
#[derive(Debug, thiserror::Error)]
#[error("the plot cannot be drawn: {message}")]
pub struct CalibrationPlotError {
    message: String,
}

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for CalibrationPlotError {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self { message: error.to_string() }
    }
}

type PlotChart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The plot as an SVG document.
///
/// # Errors
/// [`CalibrationPlotError`] if a value is not finite, which no finished calibration contains.
pub fn svg(report: &CalibrationReport) -> Result<String, CalibrationPlotError> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (SIZE.0 * FINE, SIZE.1 * FINE)).into_drawing_area();
        area.fill(&WHITE)?;
        let (above, below) = if report.cost_curve.is_some() {
            area.split_vertically(400 * FINE)
        } else {
            area.split_vertically(0)
        };
        if let Some(curve) = &report.cost_curve {
            cost(&above, report, curve)?;
        }
        rows(&below, report)?;
        area.present()?;
    }
    // The size in points; the view box keeps the fine units.
    let fine = format!("width=\"{}\" height=\"{}\"", SIZE.0 * FINE, SIZE.1 * FINE);
    Ok(text.replacen(&fine, &format!("width=\"{}\" height=\"{}\"", SIZE.0, SIZE.1), 1))
}

/// Draws the cost as a function of one correction, with marks at nominal and at the estimates.
fn cost(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    report: &CalibrationReport,
    curve: &CostCurve,
) -> Result<(), CalibrationPlotError> {
    let parameter = &report.parameters[curve.parameter];
    let (scale, unit) = (parameter.unit.for_people(1.0), parameter.unit.name_for_people());
    let (lower, upper) = (first(&curve.values) * scale, last(&curve.values) * scale);
    let top = |costs: &[f64]| positive(costs.iter().copied().fold(0.0, f64::max));
    let [highest, robust_highest] = [&curve.least_squares_m2, &curve.robust_m2].map(|costs| top(costs));
    // Square millimetres unless the residuals are beyond a decimetre or so; each axis has its own.
    let unit_of = |highest: f64| if highest < 1e-2 { (1e6, "mm²") } else { (1.0, "m²") };
    let [(cost_scale, cost_unit), (robust_scale, robust_unit)] = [highest, robust_highest].map(unit_of);
    let (top, robust_top) = (highest * cost_scale * ABOVE, robust_highest * robust_scale * ABOVE);
    let loss = report.loss.to_string();
    let (x, y) = (format!("{} in {unit}", parameter.name), format!("least squares, cost in {cost_unit}"));
    let mut chart = ChartBuilder::on(area)
        .margin(14 * FINE)
        .caption(format!("{}: cost over {}", report.robot, parameter.name), (FONT, CAPTION))
        .set_label_area_size(LabelAreaPosition::Left, 78 * FINE)
        .set_label_area_size(LabelAreaPosition::Right, 78 * FINE)
        .set_label_area_size(LabelAreaPosition::Bottom, 46 * FINE)
        .build_cartesian_2d(wide(lower, upper), 0.0..top)?
        // The robust loss levels off: on the axis of the squares its minimum would be flat.
        .set_secondary_coord(wide(lower, upper), 0.0..robust_top);
    mesh(&mut chart, &x, &y)?;
    chart
        .configure_secondary_axes()
        .set_all_tick_mark_size(5 * FINE)
        .axis_style(NOMINAL.stroke_width(FINE))
        .y_desc(format!("{loss}, cost in {robust_unit}"))
        .y_label_formatter(&|cost| number(*cost))
        .label_style((FONT, LABEL))
        .axis_desc_style((FONT, DESCRIPTION))
        .draw()?;
    let points = |costs: &[f64], cost_scale: f64| -> Vec<(f64, f64)> {
        curve.values.iter().zip(costs).map(|(value, cost)| (value * scale, cost * cost_scale)).collect()
    };
    let label = |name: &str, estimate: f64| format!("{name}: {:.4} {unit}", estimate * scale);
    chart
        .draw_series(LineSeries::new(
            points(&curve.least_squares_m2, cost_scale),
            LEAST_SQUARES.stroke_width(2 * FINE),
        ))?
        .label(label("least squares, left", parameter.correction))
        .legend(line(LEAST_SQUARES));
    chart
        .draw_secondary_series(LineSeries::new(
            points(&curve.robust_m2, robust_scale),
            ROBUST.stroke_width(2 * FINE),
        ))?
        .label(label(&format!("{loss}, right"), parameter.robust_correction))
        .legend(line(ROBUST));
    upright(&mut chart, parameter.correction * scale, top, LEAST_SQUARES)?;
    upright(&mut chart, parameter.robust_correction * scale, top, ROBUST)?;
    upright(&mut chart, 0.0, top, NOMINAL)?.label("nominal").legend(line(NOMINAL));
    legend(&mut chart, SeriesLabelPosition::UpperMiddle)
}

/// Draws the residual of each row with the nominal model and with each estimate.
fn rows(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    report: &CalibrationReport,
) -> Result<(), CalibrationPlotError> {
    let rows = &report.row_residuals;
    let positions =
        rows.iter().map(|row| row.nominal_m.max(row.least_squares_m).max(row.robust_m)).fold(0.0, f64::max);
    let angles = positions <= 0.0;
    let (unit, scale) = if angles { ("deg", 1_f64.to_degrees()) } else { ("mm", 1e3) };
    let pick = |metres: f64, radians: f64| scale * if angles { radians } else { metres };
    let highest = rows
        .iter()
        .map(|row| {
            pick(row.nominal_m, row.nominal_rad)
                .max(pick(row.least_squares_m, row.least_squares_rad))
                .max(pick(row.robust_m, row.robust_rad))
        })
        .fold(0.0, f64::max);
    let count = f64::from(u32::try_from(rows.len()).unwrap_or(u32::MAX));
    let top = positive(highest) * ABOVE;
    let mut chart = ChartBuilder::on(area)
        .margin(14 * FINE)
        .caption("residual of each measurement", (FONT, CAPTION))
        .set_label_area_size(LabelAreaPosition::Left, 78 * FINE)
        .set_label_area_size(LabelAreaPosition::Bottom, 46 * FINE)
        .build_cartesian_2d(0.4..count + 0.6, 0.0..top)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .set_all_tick_mark_size(5 * FINE)
        .axis_style(NOMINAL.stroke_width(FINE))
        .x_labels(rows.len().min(20) + 1)
        .x_label_formatter(&|row| {
            if (row - row.round()).abs() < 1e-6 { format!("{row:.0}") } else { String::new() }
        })
        .x_desc("measurement")
        .y_desc(format!("residual in {unit}"))
        .label_style((FONT, LABEL))
        .axis_desc_style((FONT, DESCRIPTION))
        .draw()?;
    // Three bars side by side for each row.
    let loss = report.loss.to_string();
    let bars: [(&str, RGBColor, Vec<f64>); 3] = [
        ("nominal", NOMINAL, rows.iter().map(|row| pick(row.nominal_m, row.nominal_rad)).collect()),
        (
            "least squares",
            LEAST_SQUARES,
            rows.iter().map(|row| pick(row.least_squares_m, row.least_squares_rad)).collect(),
        ),
        (loss.as_str(), ROBUST, rows.iter().map(|row| pick(row.robust_m, row.robust_rad)).collect()),
    ];
    for ((name, colour, heights), left) in bars.into_iter().zip([-0.36, -0.12, 0.12]) {
        let bar = |(row, height): (&RowResidual, f64)| {
            let middle = f64::from(u32::try_from(row.row).unwrap_or(u32::MAX));
            Rectangle::new([(middle + left, 0.0), (middle + left + 0.22, height)], colour.filled())
        };
        chart.draw_series(rows.iter().zip(heights).map(bar))?.label(name).legend(block(colour));
    }
    legend(&mut chart, SeriesLabelPosition::UpperLeft)
}

fn mesh(chart: &mut PlotChart<'_, '_>, x: &str, y: &str) -> Result<(), CalibrationPlotError> {
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .set_all_tick_mark_size(5 * FINE)
        .axis_style(NOMINAL.stroke_width(FINE))
        .x_desc(x)
        .y_desc(y)
        .y_label_formatter(&|value| number(*value))
        .label_style((FONT, LABEL))
        .axis_desc_style((FONT, DESCRIPTION))
        .draw()?;
    Ok(())
}

fn legend<'a, 'b: 'a>(
    chart: &mut PlotChart<'a, 'b>,
    position: SeriesLabelPosition,
) -> Result<(), CalibrationPlotError> {
    chart
        .configure_series_labels()
        .position(position)
        .background_style(WHITE.mix(0.85))
        .border_style(GRID.stroke_width(FINE))
        .legend_area_size(30 * FINE)
        .margin(8 * FINE)
        .label_font((FONT, LABEL))
        .draw()?;
    Ok(())
}

/// A dashed line at a value.
fn upright<'c, 'a, 'b>(
    chart: &'c mut PlotChart<'a, 'b>,
    value: f64,
    top: f64,
    colour: RGBColor,
) -> Result<&'c mut SeriesAnno<'a, SVGBackend<'b>>, CalibrationPlotError> {
    let points = [(value, 0.0), (value, top)];
    Ok(chart.draw_series(DashedLineSeries::new(points, 5 * FINE, 4 * FINE, colour.stroke_width(FINE)))?)
}

fn line(colour: RGBColor) -> impl Fn((i32, i32)) -> PathElement<(i32, i32)> {
    move |(x, y)| PathElement::new([(x, y), (x + 16 * UNIT, y)], colour.stroke_width(2 * FINE))
}

fn block(colour: RGBColor) -> impl Fn((i32, i32)) -> Rectangle<(i32, i32)> {
    move |(x, y)| {
        Rectangle::new([(x + 2 * UNIT, y - 5 * UNIT), (x + 14 * UNIT, y + 5 * UNIT)], colour.filled())
    }
}

/// A range that is not empty.
fn wide(lower: f64, upper: f64) -> std::ops::Range<f64> {
    if upper > lower { lower..upper } else { lower - 1.0..upper + 1.0 }
}

fn positive(value: f64) -> f64 {
    if value > 0.0 { value } else { 1.0 }
}

fn first(values: &[f64]) -> f64 {
    values.first().copied().unwrap_or(0.0)
}

fn last(values: &[f64]) -> f64 {
    values.last().copied().unwrap_or(0.0)
}
