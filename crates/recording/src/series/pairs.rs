//! Pairs of bodies that are too close: both turn red, and a line between their nearest points has the distance for a
//! label. A quiet line leads to a zone that is near without a violation.

use congruent_input::display::length;
use congruent_monitors::{Names, RecordingError, Sample};
use congruent_proximity::{Clearance, Pair, PairNames};
use congruent_scenario::Check;
use re_sdk_types::{
    SerializedComponentColumn,
    archetypes::{LineStrips3D, Points3D},
    components::{Color, Radius},
};

use super::samples::MAX_ROWS;
use crate::{
    rrd::{
        convert::vector,
        paths,
        times::{SampleTime, SampleTimes},
        writer::{RrdWriter, failed},
    },
    scene::palette,
};

/// The most lines of one instant; all violating pairs turn red.
const MAX_LINES: usize = 4;
/// Below this distance, a zone has a line without a violation, and an obstacle a curve of its own.
pub(super) const NEAR_M: f64 = 0.1;
/// Distance between two labels.
const LABEL_M: f32 = 0.07;
/// Thickness of a line on the screen.
const LINE_UI_POINTS: f32 = 2.5;

/// A check of distances between bodies.
#[derive(Debug)]
struct DistanceRule {
    names: PairNames,
    limit: DistanceLimit,
    /// Whether the check measures a pair; known from the first sample on.
    looks_at: Vec<bool>,
}

/// What a check of distances allows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum DistanceLimit {
    /// A distance of at least this.
    Minimum(f64),
    /// An overlap of at most this depth; without one, no touch.
    Depth(Option<f64>),
}

/// The list of pairs that a pair is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PairKind {
    Bodies,
    Zones,
}

/// A pair with a line.
#[derive(Debug, Clone, Copy)]
struct DrawnPair {
    kind: PairKind,
    pair: usize,
    /// Negative for an overlap.
    distance_m: f64,
    points: [[f32; 3]; 2],
    label: [f32; 3],
    is_violating: bool,
}

/// A pair at the present instant, before it is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
struct FoundPair {
    kind: PairKind,
    pair: usize,
    distance_m: f64,
    is_violating: bool,
}

/// The pairs of one run until they are written.
#[derive(Debug)]
pub(crate) struct PairSeries {
    rules: Vec<DistanceRule>,
    found: Vec<FoundPair>,
    times: SampleTimes,
    /// Number of pairs at each time.
    counts: Vec<u32>,
    pairs: Vec<DrawnPair>,
    /// Whether there was a line at the time before.
    had_lines: bool,
}

impl PairSeries {
    /// A series without rows, for the distances that these checks limit.
    pub(crate) fn new(checks: &[Check]) -> Self {
        let rule = |check: &Check| {
            let (pairs, ignore, limit) = match check {
                Check::Clearance(check) => {
                    (&check.pairs, &check.ignore, DistanceLimit::Minimum(check.limit_m()?))
                }
                Check::Contact(check) => (&check.pairs, &check.ignore, DistanceLimit::Depth(check.limit_m())),
                _ => return None,
            };
            let names = PairNames { pairs: pairs.clone(), ignore: ignore.clone() };
            Some(DistanceRule { names, limit, looks_at: Vec::new() })
        };
        Self {
            rules: checks.iter().filter_map(rule).collect(),
            found: Vec::with_capacity(MAX_ROWS),
            times: SampleTimes::with_capacity(MAX_ROWS),
            counts: Vec::with_capacity(MAX_ROWS),
            pairs: Vec::with_capacity(MAX_ROWS),
            had_lines: false,
        }
    }

    /// Adds a row if there is a line, or was one in the row before, and marks the bodies that violate: links, then
    /// obstacles, then zones.
    pub(crate) fn push(&mut self, time: SampleTime, sample: &mut Sample<'_>, are_violating: &mut [bool]) {
        self.found.clear();
        self.find_bodies(sample);
        self.find_zones(sample.zones);
        let (links, zones) = (sample.twin.len(), sample.zones.subjects().len() - sample.twin.len());
        let obstacles = are_violating.len() - links - zones;
        for found in self.found.iter().filter(|found| found.is_violating) {
            for body in match found.kind {
                PairKind::Bodies => subjects(sample.clearance, found.pair),
                PairKind::Zones => subjects(sample.zones, found.pair)
                    .map(|subject| if subject < links { subject } else { subject + obstacles }),
            } {
                are_violating[body] = true;
            }
        }
        // Violations first, then the nearest: of more pairs than lines, those that matter are drawn.
        self.found.sort_unstable_by(|a, b| {
            let by_distance = || a.distance_m.total_cmp(&b.distance_m).then(a.pair.cmp(&b.pair));
            b.is_violating.cmp(&a.is_violating).then_with(by_distance)
        });
        let first = self.pairs.len();
        for FoundPair { kind, pair, distance_m, is_violating } in self.found.iter().take(MAX_LINES).copied() {
            let clearance = if kind == PairKind::Bodies { &*sample.clearance } else { &*sample.zones };
            if let Some(points) = clearance.nearest_points(pair) {
                let points = points.map(|point| vector(&point.coords));
                let label = free_place(middle(points), &self.pairs[first..]);
                self.pairs.push(DrawnPair { kind, pair, distance_m, points, label, is_violating });
            }
        }
        let count = u32::try_from(self.pairs.len() - first).unwrap_or(u32::MAX);
        // One empty row after the last line: the viewer shows the latest row, and lines would otherwise remain.
        if count > 0 || self.had_lines {
            self.times.push(time);
            self.counts.push(count);
        }
        self.had_lines = count > 0;
    }

    /// Finds the pairs that violate a check.
    fn find_bodies(&mut self, sample: &mut Sample<'_>) {
        let found = &mut self.found;
        for DistanceRule { names, limit, looks_at } in &mut self.rules {
            if looks_at.is_empty() {
                let pairs = 0..sample.clearance.pairs().len();
                looks_at.extend(pairs.map(|pair| names.is_evaluated(sample.clearance.names(pair))));
            }
            let kept_apart = match limit {
                DistanceLimit::Depth(None) => sample.kept_apart(|pair| looks_at[pair]),
                _ => None,
            };
            if let Some(pair) = kept_apart {
                // The physics stops them just before their hulls meet: the check takes that as touch.
                add(found, FoundPair { kind: PairKind::Bodies, pair, distance_m: 0.0, is_violating: true });
            }
            // Contact: a distance of exactly 0 is below the smallest positive number.
            let below_m = match limit {
                DistanceLimit::Minimum(minimum_m) => *minimum_m,
                DistanceLimit::Depth(_) => f64::MIN_POSITIVE,
            };
            let limit_m = |pair: usize| if looks_at[pair] { below_m } else { f64::NEG_INFINITY };
            let before = found.len();
            sample.clearance.below(below_m, limit_m, |pair, distance_m| {
                add(found, FoundPair { kind: PairKind::Bodies, pair, distance_m, is_violating: true });
            });
            found.iter_mut().skip(before).for_each(|found| sign(found, sample.clearance));
            // Touching pairs were measured; an overlap up to the allowed depth is no violation. Only pairs of this
            // rule are tested, from `before` on.
            if let DistanceLimit::Depth(Some(depth_m)) = limit {
                let mut at = 0;
                found.retain(|found| {
                    at += 1;
                    at <= before || found.distance_m < -*depth_m
                });
            }
        }
    }

    /// Finds the links in zones, and a zone that is near.
    fn find_zones(&mut self, zones: &mut Clearance) {
        let kind = PairKind::Zones;
        let (found, touching_m) = (&mut self.found, f64::MIN_POSITIVE);
        let before = found.len();
        zones.below(
            touching_m,
            |_| touching_m,
            |pair, distance_m| {
                add(found, FoundPair { kind, pair, distance_m, is_violating: true });
            },
        );
        found.iter_mut().skip(before).for_each(|found| sign(found, zones));
        if let Some(near) = zones.nearest_below(NEAR_M) {
            let (pair, distance_m) = (near.pair, near.distance_m);
            add(found, FoundPair { kind, pair, distance_m, is_violating: false });
        }
    }

    /// Writes what does not change.
    pub(crate) fn write_static(writer: &mut RrdWriter) -> Result<(), RecordingError> {
        let lines = LineStrips3D::update_fields().with_radii([Radius::new_ui_points(LINE_UI_POINTS)]);
        let labels =
            Points3D::update_fields().with_radii([Radius::new_ui_points(0.0)]).with_show_labels(true);
        writer.log_static_together(&paths::nearest(), &[&lines, &labels])
    }

    /// Writes all rows and removes them.
    pub(crate) fn write(&mut self, writer: &mut RrdWriter, names: &Names) -> Result<(), RecordingError> {
        if !self.times.is_empty() {
            writer.columns(&paths::nearest(), &self.times.columns(), self.columns(names)?)?;
        }
        self.times.clear();
        self.counts.clear();
        self.pairs.clear();
        Ok(())
    }

    fn columns(
        &self,
        names: &Names,
    ) -> Result<impl Iterator<Item = SerializedComponentColumn>, RecordingError> {
        let counts = || self.counts.iter().map(|&count| count as usize);
        let lines = LineStrips3D::update_fields()
            .with_strips(self.pairs.iter().map(|drawn| drawn.points))
            .with_colors(self.pairs.iter().map(color));
        let labels = Points3D::update_fields()
            .with_positions(self.pairs.iter().map(|drawn| drawn.label))
            .with_colors(self.pairs.iter().map(|_| palette::NEUTRAL))
            .with_labels(self.pairs.iter().map(|drawn| label(drawn, names)));
        let lines = lines.columns(counts()).map_err(failed)?;
        Ok(lines.chain(labels.columns(counts()).map_err(failed)?))
    }
}

/// Adds a pair unless it is there already.
fn add(found: &mut Vec<FoundPair>, new: FoundPair) {
    if !found.iter().any(|known| (known.kind, known.pair) == (new.kind, new.pair)) {
        found.push(new);
    }
}

/// Replaces the distance 0 by minus the depth.
fn sign(found: &mut FoundPair, clearance: &Clearance) {
    if found.distance_m <= 0.0 {
        found.distance_m = clearance.measure_signed(found.pair).min(0.0);
    }
}

fn subjects(clearance: &Clearance, pair: usize) -> [usize; 2] {
    clearance.pairs().nth(pair).map_or([0, 0], |Pair { a, b }| [a, b])
}

fn color(drawn: &DrawnPair) -> Color {
    // The bodies are red then; a red line between them would not be seen.
    if drawn.is_violating { palette::NEUTRAL } else { palette::QUIET }
}

fn middle([a, b]: [[f32; 3]; 2]) -> [f32; 3] {
    [0, 1, 2].map(|axis| f32::midpoint(a[axis], b[axis]))
}

/// A place for a label at this point, or above those of other pairs there.
fn free_place(at: [f32; 3], others: &[DrawnPair]) -> [f32; 3] {
    let is_taken = |place: [f32; 3]| {
        let is_near =
            |other: &DrawnPair| (0..3).all(|axis| (other.label[axis] - place[axis]).abs() < LABEL_M);
        others.iter().any(is_near)
    };
    let mut place = at;
    // Each step up can pass one label, so that as many steps as labels are enough.
    for _ in others {
        if is_taken(place) {
            place[2] += LABEL_M;
        }
    }
    place
}

/// The two with their distance as reports have it.
fn label(drawn: &DrawnPair, names: &Names) -> String {
    let name = match drawn.kind {
        PairKind::Bodies => &names.pairs[drawn.pair],
        PairKind::Zones => &names.zones[drawn.pair],
    };
    match drawn.distance_m {
        distance_m if distance_m < 0.0 => format!("{name}: overlap {}", length(-distance_m)),
        distance_m if distance_m > 0.0 => format!("{name}: {}", length(distance_m)),
        _ => format!("{name}: touch"),
    }
}
