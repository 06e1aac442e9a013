//! Corners of a polygon around the curve of a joint's features: an arc of the unit circle for a turn, a
//! segment for a shift.

use std::f64::consts::{FRAC_PI_4, PI, SQRT_2, TAU};

use congruent_description::Elementary as _;

/// One corner: a pair of features on the curve or outside of it.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `features` | 1, or m | `(cos, sin)` of the turn, or `(q, 0)` of the shift, on or off the curve |
/// | `position` | rad or m | a joint position whose features are near |
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    pub(super) features: [f64; 2],
    pub(super) position: f64,
}

/// A closed interval of joint positions, rad or m.
pub(super) type Interval = (f64, f64);

/// Features of the turn by `rate * position`, stretched by `radius`.
pub(super) fn on_circle(rate: f64, position: f64, radius: f64) -> Corner {
    let (sin, cos) = (rate * position).sine_cosine();
    Corner { features: [radius * cos, radius * sin], position }
}

/// Features of a shift: a segment is its own convex hull.
pub(super) fn on_line(position: f64) -> Corner {
    Corner { features: [position, 0.0], position }
}

/// Corners of an arc that wraps: a regular polygon with so many exceeds the circle by 2 %.
const WRAPPED_CORNERS: u8 = 16;
/// Most corners that one joint has.
pub(super) const MAX_CORNERS: usize = WRAPPED_CORNERS as usize;

/// Whether an arc goes round so often that splitting it hardly reduces the bound: it gets all corners then.
pub(super) fn wraps(rate: f64, (lower, upper): Interval) -> bool {
    rate * (upper - lower) > 1.5 * TAU
}

/// Number of corners of a turn.
pub(super) fn corner_count(rate: f64, interval: Interval) -> usize {
    let angle = rate * (interval.1 - interval.0);
    if wraps(rate, interval) {
        MAX_CORNERS
    } else if angle > 2.0 * FRAC_PI_4 {
        4
    } else {
        3
    }
}

/// Largest distance of the corners of [`around_arc`] from the centre: 1 for an arc of no length, at most
/// the square root of 2.
pub(super) fn outermost_radius(rate: f64, (lower, upper): Interval) -> f64 {
    if wraps(rate, (lower, upper)) {
        return (PI / f64::from(WRAPPED_CORNERS)).cosine().recip();
    }
    let angle = rate * (upper - lower);
    let between_tangents = if angle <= 2.0 * FRAC_PI_4 { angle / 2.0 } else { angle / 4.0 };
    if between_tangents < FRAC_PI_4 { between_tangents.cosine().recip() } else { SQRT_2 }
}

/// Corners around an arc. Up to a quarter of a turn: its ends and the point where the tangents at the ends
/// meet. Up to half a turn: also the tangent in the middle. Up to one and a half turns: the square around
/// the circle. Beyond: a polygon that hardly exceeds the circle.
pub(super) fn around_arc(rate: f64, interval: Interval, corners: &mut Vec<Corner>) {
    let (lower, upper) = interval;
    let middle = f64::midpoint(lower, upper);
    let radius = outermost_radius(rate, interval);
    let angle = rate * (upper - lower);
    if wraps(rate, interval) {
        let turn = |corner: u8| (f64::from(corner) / f64::from(WRAPPED_CORNERS) - 0.5) * TAU;
        corners
            .extend((0..WRAPPED_CORNERS).map(|corner| on_circle(rate, middle + turn(corner) / rate, radius)));
        return;
    }
    if angle > PI {
        corners.extend([-3.0, -1.0, 1.0, 3.0].map(|eighths| {
            let corner = on_circle(rate, middle + eighths * FRAC_PI_4 / rate, radius);
            Corner { position: corner.position.clamp(lower, upper), ..corner }
        }));
        return;
    }
    corners.push(on_circle(rate, lower, 1.0));
    if angle <= 2.0 * FRAC_PI_4 {
        corners.push(on_circle(rate, middle, radius));
    } else {
        let quarter = (upper - lower) / 4.0;
        corners.extend([middle - quarter, middle + quarter].map(|at| on_circle(rate, at, radius)));
    }
    corners.push(on_circle(rate, upper, 1.0));
}

/// Both ends of the segment of a shift.
pub(super) fn around_segment((lower, upper): Interval) -> [Corner; 2] {
    [on_line(lower), on_line(upper)]
}
