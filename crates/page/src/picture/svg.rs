//! SVG of a part of a plane: metres to the right and up become points to the right and down.

use congruent_input::display::length;
use maud::{Markup, html};
use nalgebra::{Point2, Vector2};

/// Size of a picture in points.
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 440.0;
/// Corners of an outline.
const CORNERS: u32 = 32;

/// How a line is drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Style {
    /// Between the frames of a link and of its children.
    Link,
    /// The axis of a joint.
    Axis,
    /// An axis of a frame: `x`, `y` or `z`.
    Frame(&'static str),
}

impl Style {
    fn class(self) -> &'static str {
        match self {
            Self::Link => "link",
            Self::Axis => "axis",
            Self::Frame(axis) => axis,
        }
    }
}

/// A part of the plane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Canvas {
    middle: Point2<f64>,
    points_per_m: f64,
}

impl Canvas {
    /// A rectangle with a margin around it, as a share of the picture.
    pub(crate) fn showing(low: Point2<f64>, high: Point2<f64>, margin: f64) -> Self {
        // A picture of a single point has no size to divide by.
        let size = (high - low).sup(&Vector2::repeat(f64::MIN_POSITIVE));
        let free = 1.0 - 2.0 * margin;
        // The smaller of both scales, so that the whole rectangle is in the picture and angles are kept.
        let points_per_m = (free * WIDTH / size.x).min(free * HEIGHT / size.y);
        Self { middle: nalgebra::center(&low, &high), points_per_m }
    }

    /// Width of the picture in metres.
    pub(crate) fn width_m(&self) -> f64 {
        WIDTH / self.points_per_m
    }

    /// Where a point of the plane is in the picture.
    pub(crate) fn at(&self, point: &Point2<f64>) -> Point2<f64> {
        let from_middle = (point - self.middle) * self.points_per_m;
        Point2::new(0.5 * WIDTH + from_middle.x, 0.5 * HEIGHT - from_middle.y)
    }

    /// The corners around points: the farthest in each of some directions.
    pub(crate) fn outline(&self, points: impl Iterator<Item = Point2<f64>>) -> Vec<Point2<f64>> {
        let points: Vec<Point2<f64>> = points.map(|point| self.at(&point)).collect();
        let directions = (0..CORNERS).map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(CORNERS));
        let farthest = |angle: f64| {
            let along = Vector2::new(libm::cos(angle), libm::sin(angle));
            points.iter().copied().max_by(|a, b| a.coords.dot(&along).total_cmp(&b.coords.dot(&along)))
        };
        let mut corners: Vec<Point2<f64>> = directions.filter_map(farthest).collect();
        // Neighbouring directions often find the same corner.
        corners.dedup();
        corners
    }

    /// A bar with its length.
    pub(crate) fn scale_bar(&self) -> Markup {
        let length_m = round_length(0.22 * self.width_m());
        let (left, y) = (16.0, HEIGHT - 16.0);
        let right = left + length_m * self.points_per_m;
        html! {
            g.bar {
                line x1=(left) y1=(y) x2=(tenths(right)) y2=(y) {}
                text x=(left) y=(y - 7.0) { (length(length_m)) }
            }
        }
    }
}

/// The picture around its content; what is outside is cut off.
pub(crate) fn picture(title: &str, content: &Markup) -> Markup {
    html! {
        svg role="img" viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) xmlns="http://www.w3.org/2000/svg" {
            title { (title) }
            (content)
        }
    }
}

pub(crate) fn line([from, to]: [Point2<f64>; 2], style: Style) -> Markup {
    let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(tenths);
    html! { line.(style.class()) x1=(x1) y1=(y1) x2=(x2) y2=(y2) {} }
}

pub(crate) fn circle(at: Point2<f64>) -> Markup {
    html! { circle cx=(tenths(at.x)) cy=(tenths(at.y)) r="5" {} }
}

pub(crate) fn polygon(corners: &[Point2<f64>], class: &str) -> Markup {
    html! { @if corners.len() > 2 { polygon class=(class) points=(listed(corners)) {} } }
}

pub(crate) fn polyline(points: &[Point2<f64>], class: &str) -> Markup {
    html! { @if points.len() > 1 { polyline.(class) points=(listed(points)) {} } }
}

/// The name of what has these corners, above the highest of them that is in the picture; of what has none there, at
/// the edge that is nearest to it.
pub(crate) fn label(corners: &[Point2<f64>], name: &str) -> Markup {
    let inside =
        |at: &Point2<f64>| Point2::new(at.x.clamp(12.0, WIDTH - 90.0), at.y.clamp(18.0, HEIGHT - 30.0));
    let outside = |at: &Point2<f64>| (inside(at) - at).norm();
    let nearest =
        corners.iter().min_by(|a, b| (outside(a) > 0.0).cmp(&(outside(b) > 0.0)).then(a.y.total_cmp(&b.y)));
    html! {
        @if let Some(at) = nearest {
            @let at = inside(at);
            text.name x=(tenths(at.x)) y=(tenths(at.y - 5.0)) { (name) }
        }
    }
}

fn listed(points: &[Point2<f64>]) -> String {
    let each = points.iter().map(|point| format!("{},{}", tenths(point.x), tenths(point.y)));
    each.collect::<Vec<_>>().join(" ")
}

/// Tenths of a point are finer than a screen.
fn tenths(value: f64) -> f64 {
    // Far outside of the picture, browsers lose digits.
    let value = value.clamp(-1e5, 1e5);
    (value * 10.0).round() / 10.0
}

/// The largest of 1, 2 and 5 times a power of ten that is not above a length.
fn round_length(at_most_m: f64) -> f64 {
    let power = libm::pow(10_f64, libm::log10(at_most_m).floor());
    let factor = [5.0, 2.0, 1.0].into_iter().find(|factor| factor * power <= at_most_m).unwrap_or(1.0);
    factor * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_of_what_is_shown_are_inside() {
        let (low, high) = (Point2::new(-1.0, 2.0), Point2::new(3.0, 2.5));
        let canvas = Canvas::showing(low, high, 0.1);
        let [a, b] = [low, high].map(|point| canvas.at(&point));
        assert!((a.x - 56.0).abs() < 1e-9 && (b.x - 504.0).abs() < 1e-9 && b.y < a.y, "{a} {b}");
    }

    #[test]
    fn an_outline_has_the_corners_of_a_square() {
        let canvas = Canvas::showing(Point2::origin(), Point2::new(1.0, 1.0), 0.0);
        let square = [(0.0, 0.0), (1.0, 0.0), (0.5, 0.5), (1.0, 1.0), (0.0, 1.0)];
        let outline = canvas.outline(square.into_iter().map(|(x, y)| Point2::new(x, y)));
        let mut corners = outline.clone();
        corners.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        corners.dedup();
        assert_eq!(corners.len(), 4, "{outline:?}");
    }

    #[test]
    fn bars_have_round_lengths() {
        let lengths = [0.22, 0.6, 1.0, 0.0019].map(round_length);
        let expected = [0.2, 0.5, 1.0, 0.001];
        assert!(lengths.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{lengths:?}");
    }
}
