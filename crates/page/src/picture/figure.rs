//! What a picture shows, and which part of it.

use congruent_input::display::length;
use maud::{Markup, html};
use nalgebra::{Point2, Point3, Vector2, Vector3};

use super::{
    camera::FigureCamera,
    skeleton::Skeleton,
    svg::{self, Canvas, Style},
};

/// An arm, with its name in the legend.
#[derive(Debug, Clone)]
pub(crate) struct DrawnArm {
    /// Class in the style sheet: `twin` or `model`.
    pub(crate) class: &'static str,
    pub(crate) name: String,
    pub(crate) skeleton: Skeleton,
}

/// A shape around the arm, by points of its surface.
#[derive(Debug, Clone)]
pub(crate) struct PictureBody {
    /// Class in the style sheet: `shape`, `obstacle` or `zone`.
    pub(crate) class: &'static str,
    pub(crate) name: Option<String>,
    pub(crate) points: Vec<Point3<f64>>,
    /// Whether it is what a check found.
    pub(crate) is_marked: bool,
}

impl PictureBody {
    /// A shape of the arm.
    pub(crate) fn shape(points: Vec<Point3<f64>>) -> Self {
        Self { class: "shape", name: None, points, is_marked: false }
    }

    fn classes(&self) -> String {
        format!("{}{}", self.class, if self.is_marked { " marked" } else { "" })
    }
}

/// Everything that a picture shows.
#[derive(Debug, Clone, Default)]
pub(crate) struct Figure {
    pub(crate) bodies: Vec<PictureBody>,
    pub(crate) arms: Vec<DrawnArm>,
    /// Path of the tool centre point, in the root link's frame. Unit: m.
    pub(crate) path: Vec<Point3<f64>>,
}

/// Share of the picture that stays free at each side.
const MARGIN: f64 = 0.09;
/// Sides of the frames in a picture, as a share of its width.
const TRIAD: f64 = 0.07;
/// Half the length of an axis, likewise.
const AXIS: f64 = 0.035;
/// The enlarged part is this many times the difference wide.
const AROUND_DIFFERENCE: f64 = 4.0;
/// A difference of this share of the picture or more needs no enlargement, and one of less than that cannot be drawn.
const DISCERNIBLE: [f64; 2] = [1e-7, 0.15];

/// Tips that are nearer to each other are drawn as one. Unit: m.
const DRAWN_M: f64 = 1e-6;

impl Figure {
    /// The whole of it.
    pub(crate) fn whole(&self, title: &str) -> Markup {
        let camera = self.camera();
        let projected: Vec<Point2<f64>> = self.arm_points().map(|point| camera.project(&point)).collect();
        let Some(first) = projected.first() else { return html! {} };
        let (low, high) =
            projected.iter().fold((*first, *first), |(low, high), point| (low.inf(point), high.sup(point)));
        let canvas = Canvas::showing(low, high, MARGIN);
        self.drawn(&camera, &canvas, title)
    }

    /// The tips of two arms, enlarged; `None` if the whole shows their difference, or nothing can.
    pub(crate) fn enlarged(&self, title: &str) -> Option<Markup> {
        let [a, b, ..] = &self.arms[..] else { return None };
        let camera = self.camera();
        let [a, b] = [a, b].map(|arm| Point3::from(arm.skeleton.tip.translation.vector));
        let difference_m = (a - b).norm();
        let lines = self.arms[0].skeleton.links.iter();
        // The size of the arm: the sum of its links, which no configuration changes.
        let size_m: f64 = lines.map(|[from, to]| (to - from).norm()).sum();
        let [least, most] = DISCERNIBLE;
        // The whole picture shows a larger difference, and the digits of the SVG do not show a smaller one.
        if !(least..most).contains(&(difference_m / size_m)) {
            return None;
        }
        let middle = camera.project(&nalgebra::center(&a, &b));
        let half = Vector2::repeat(0.5 * AROUND_DIFFERENCE * difference_m);
        let canvas = Canvas::showing(middle - half, middle + half, 0.0);
        Some(self.drawn(&camera, &canvas, title))
    }

    fn camera(&self) -> FigureCamera {
        let lines = self.arms.iter().flat_map(|arm| arm.skeleton.links.iter().copied());
        // The difference of two tips counts as much as a link, unless it is rounding.
        let tips: Vec<Point3<f64>> =
            self.arms.iter().map(|arm| arm.skeleton.tip.translation.vector.into()).collect();
        let path_segments = self.path.windows(2).map(|points| [points[0], points[1]]);
        let apart = tips.windows(2).filter_map(|tips| {
            let direction = (tips[1] - tips[0]).try_normalize(DRAWN_M)?;
            // A fixed length: the difference itself may be far too short to influence the view.
            Some([tips[0], tips[0] + direction * 0.3])
        });
        FigureCamera::showing(&lines.chain(path_segments).chain(apart).collect::<Vec<_>>())
    }

    /// Points that the picture must contain, in the root link's frame. Unit: m.
    fn arm_points(&self) -> impl Iterator<Item = Point3<f64>> {
        let arms = self.arms.iter().flat_map(|arm| arm.skeleton.links.iter().flatten().copied());
        let shapes = self.bodies.iter().filter(|body| body.class == "shape");
        arms.chain(shapes.flat_map(|body| body.points.iter().copied())).chain(self.path.iter().copied())
    }

    fn drawn(&self, camera: &FigureCamera, canvas: &Canvas, title: &str) -> Markup {
        let at = |point: &Point3<f64>| canvas.at(&camera.project(point));
        let outline =
            |points: &[Point3<f64>]| canvas.outline(points.iter().map(|point| camera.project(point)));
        // Axes and frames have a size of the picture, not of the robot.
        let unit = canvas.width_m();
        let content = html! {
            @for body in &self.bodies {
                (svg::polygon(&outline(&body.points), &body.classes()))
            }
            @for body in &self.bodies {
                @if let Some(name) = &body.name { (svg::label(&outline(&body.points), name)) }
            }
            (svg::polyline(&self.path.iter().map(at).collect::<Vec<_>>(), "trail"))
            @for arm in &self.arms {
                g.arm.(arm.class) {
                    @for [from, to] in &arm.skeleton.links { (svg::line([at(from), at(to)], Style::Link)) }
                    @for (origin, axis) in &arm.skeleton.joints {
                        @let reach = axis * (AXIS * unit);
                        (svg::line([at(&(origin - reach)), at(&(origin + reach))], Style::Axis))
                        (svg::circle(at(origin)))
                    }
                }
            }
            @for arm in &self.arms {
                @let tip = arm.skeleton.tip;
                @let origin = Point3::from(tip.translation.vector);
                g.triad.(arm.class) {
                    @for (axis, class) in [(Vector3::x(), "x"), (Vector3::y(), "y"), (Vector3::z(), "z")] {
                        @let end = origin + tip.rotation * axis * (TRIAD * unit);
                        (svg::line([at(&origin), at(&end)], Style::Frame(class)))
                    }
                }
            }
            (canvas.scale_bar())
        };
        svg::picture(title, &content)
    }
}

/// Two arms side by side in words: what the picture shows, for a caption.
#[derive(Debug, Clone)]
pub(crate) struct TwoArms {
    pub(crate) figure: Figure,
    /// Distance of the two tips.
    pub(crate) tips_apart_m: f64,
}

impl TwoArms {
    /// The picture, with the enlarged tips beside it, and the legend.
    pub(crate) fn markup(&self, caption: &Markup) -> Markup {
        let apart = length(self.tips_apart_m);
        html! {
            figure.picture {
                div.pictures {
                    (self.figure.whole("the arm"))
                    @if let Some(enlarged) = self.figure.enlarged("the tips, enlarged") {
                        div.enlarged { (enlarged) p.small { "the tips, enlarged: " (apart) " apart" } }
                    }
                }
                figcaption {
                    (caption)
                    ul.legend {
                        @for arm in &self.figure.arms { li.(arm.class) { (arm.name) } }
                        @if !self.figure.path.is_empty() { li.trail { "path of the TCP" } }
                    }
                }
            }
        }
    }
}
