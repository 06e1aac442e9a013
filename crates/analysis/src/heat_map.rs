//! A figure of a value over a plane, to scale: cells in the colours of a scale beside it.

use congruent_input::display::number;
use plotters::{prelude::*, style::text_anchor::HPos};

use crate::plot::{GREY, PlotArea, PlotError, TITLE_PX, note, note_px, page, plane_to_scale, text};

/// A value over a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatMap {
    /// Title above the plane.
    pub title: String,
    /// Names of the axes, with units.
    pub axes: [String; 2],
    /// Where the value is known.
    pub cells: Vec<HeatCell>,
    /// Edge of each cell, m.
    pub cell_m: f64,
    /// Name of the value, with its unit.
    pub value: String,
    /// What is not drawn, below the plane.
    pub note: String,
}

/// The value of one cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatCell {
    /// The corner with the smallest coordinates, m.
    pub corner: [f64; 2],
    /// The value.
    pub value: f64,
}

/// Colours of equal steps in lightness, dark for small values (viridis, by van der Walt and Smith): distinct in print and for the
/// colour-blind.
const SCALE: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 45.0, 123.0],
    [59.0, 82.0, 139.0],
    [44.0, 114.0, 142.0],
    [33.0, 145.0, 140.0],
    [40.0, 174.0, 128.0],
    [94.0, 201.0, 98.0],
    [173.0, 220.0, 48.0],
    [253.0, 231.0, 37.0],
];

/// The colour of a share from 0 to 1 of the scale.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 8, and 0 to 255")]
fn scale_colour(share: f64) -> RGBColor {
    let place = share.clamp(0.0, 1.0) * 8.0;
    let below = (place as usize).min(7);
    let [red, green, blue] = [0, 1, 2].map(|part| {
        let (from, to) = (SCALE[below][part], SCALE[below + 1][part]);
        (from + (to - from) * (place - place.floor().min(7.0))) as u8
    });
    RGBColor(red, green, blue)
}

/// Draws the cells and the scale.
///
/// # Errors
/// [`PlotError`] if the drawing library refuses.
pub fn heat_map(map: &HeatMap) -> Result<String, PlotError> {
    const SIDE_PX: u32 = 520;
    const SCALE_PX: u32 = 130;
    let mut svg = String::new();
    {
        let root = page(&mut svg, SIDE_PX + SCALE_PX, SIDE_PX + TITLE_PX + note_px(&map.note), &map.title)?;
        note(&root, &map.note)?;
        let (_, below) = root.split_vertically(TITLE_PX);
        let (drawn, _) = below.split_vertically(SIDE_PX);
        let (plane, scale) = drawn.split_horizontally(SIDE_PX);
        let values = map.cells.iter().map(|cell| cell.value);
        let lower = values.clone().fold(f64::INFINITY, f64::min);
        let upper = values.fold(f64::NEG_INFINITY, f64::max);
        // Without a range every cell has the colour of the middle.
        let share = |value: f64| if upper > lower { (value - lower) / (upper - lower) } else { 0.5 };
        draw_cells(&plane, map, share)?;
        draw_scale(&scale, &map.value, [lower, upper])?;
    }
    Ok(svg)
}

fn draw_cells(area: &PlotArea<'_>, map: &HeatMap, share: impl Fn(f64) -> f64) -> Result<(), PlotError> {
    let (mut lower, mut upper) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for HeatCell { corner, .. } in &map.cells {
        for axis in 0..2 {
            lower[axis] = lower[axis].min(corner[axis]);
            upper[axis] = upper[axis].max(corner[axis] + map.cell_m);
        }
    }
    if map.cells.is_empty() {
        (lower, upper) = ([0.0; 2], [1.0; 2]);
    }
    let half = (0..2).map(|axis| (upper[axis] - lower[axis]) / 2.0).fold(f64::MIN_POSITIVE, f64::max) * 1.04;
    let centre = [0, 1].map(|axis| f64::midpoint(lower[axis], upper[axis]));
    let mut plane = plane_to_scale(area, centre, half, &map.axes)?;
    plane.draw_series(level_runs(map, share).into_iter().map(
        |LevelRun { corner: [left, low], cells, level }| {
            let corners = [(left, low), (left + cells * map.cell_m, low + map.cell_m)];
            Rectangle::new(corners, scale_colour(level / LEVELS).filled())
        },
    ))?;
    Ok(())
}

/// Steps of the scale that are drawn: neighbours of one step are one rectangle, so that the file is a third as long.
const LEVELS: f64 = 32.0;

/// Neighbours in a row with one colour.
struct LevelRun {
    corner: [f64; 2],
    /// How many.
    cells: f64,
    /// From 0 to [`LEVELS`].
    level: f64,
}

fn level_runs(map: &HeatMap, share: impl Fn(f64) -> f64) -> Vec<LevelRun> {
    let mut sorted: Vec<&HeatCell> = map.cells.iter().collect();
    let place = |cell: &HeatCell| cell.corner.map(|along| (along / map.cell_m).round());
    sorted.sort_by(|a, b| {
        let ([x_a, y_a], [x_b, y_b]) = (place(a), place(b));
        y_a.total_cmp(&y_b).then(x_a.total_cmp(&x_b))
    });
    let mut runs: Vec<LevelRun> = Vec::new();
    for cell in sorted {
        let level = (share(cell.value) * LEVELS).round();
        let [x, y] = place(cell);
        let follows = |run: &&mut LevelRun| {
            let [first, row] = run.corner.map(|along| (along / map.cell_m).round());
            let is_next = (first + run.cells - x).abs() < 0.5 && (row - y).abs() < 0.5;
            is_next && (run.level - level).abs() < 0.5
        };
        match runs.last_mut().filter(follows) {
            Some(run) => run.cells += 1.0,
            None => runs.push(LevelRun { corner: cell.corner, cells: 1.0, level }),
        }
    }
    runs
}

fn draw_scale(area: &PlotArea<'_>, name: &str, [lower, upper]: [f64; 2]) -> Result<(), PlotError> {
    const STEPS: i32 = 64;
    const TOP_PX: i32 = 60;
    const STEP_PX: i32 = 6;
    text(area, name, 4, TOP_PX - 28, HPos::Left)?;
    for step in 0..STEPS {
        let bottom = TOP_PX + (STEPS - step) * STEP_PX;
        let share = f64::from(step) / f64::from(STEPS - 1);
        area.draw(&Rectangle::new([(4, bottom - STEP_PX), (24, bottom)], scale_colour(share).filled()))?;
    }
    area.draw(&Rectangle::new([(4, TOP_PX), (24, TOP_PX + STEPS * STEP_PX)], GREY.stroke_width(1)))?;
    for quarter in 0..=4 {
        let value = lower + (upper - lower) * f64::from(quarter) / 4.0;
        let at = TOP_PX + STEPS * STEP_PX * (4 - quarter) / 4;
        if value.is_finite() {
            text(area, &number(value), 30, at, HPos::Left)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_the_scale_are_its_colours() {
        assert_eq!([scale_colour(0.0), scale_colour(1.0)], [RGBColor(68, 1, 84), RGBColor(253, 231, 37)]);
        let cell = |at: f64, value: f64| HeatCell { corner: [at, 0.0], value };
        let map = HeatMap {
            title: "arm".to_owned(),
            axes: ["r in m".to_owned(), "z in m".to_owned()],
            cells: vec![cell(0.0, 1.0), cell(0.1, 2.0)],
            cell_m: 0.1,
            value: "rms in mm".to_owned(),
            note: String::new(),
        };
        let svg = heat_map(&map).unwrap();
        assert!(svg.contains("#440154") && svg.contains("#FDE725"), "{svg}");
    }
}
