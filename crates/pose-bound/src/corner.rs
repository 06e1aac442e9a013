//! Corners of a polygon around the curve of a joint's features: an arc of the unit circle for a turn, a
//! segment for a shift.

use std::f64::consts::{FRAC_PI_4, PI, SQRT_2, TAU};

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
pub(super) type PositionInterval = (f64, f64);

/// Features of the turn by `rate * position`, stretched by `radius`.
pub(super) fn on_circle(rate: f64, position: f64, radius: f64) -> Corner {
    let (sin, cos) = libm::sincos(rate * position);
    Corner { features: [radius * cos, radius * sin], position }
}

/// Features of a shift: a segment is its own convex hull.
pub(super) fn on_line(position: f64) -> Corner {
    Corner { features: [position, 0.0], position }
}

/// Corners of an arc that wraps: a regular polygon with 16 corners exceeds the circle by 2 %.
const WRAPPED_CORNERS: u8 = 16;
/// Most corners that one joint has.
pub(super) const MAX_CORNERS: usize = WRAPPED_CORNERS as usize;

/// Whether an arc goes round so often that splitting it hardly reduces the bound: it gets all corners then.
pub(super) fn wraps(rate: f64, (lower, upper): PositionInterval) -> bool {
    rate * (upper - lower) > 1.5 * TAU
}

/// How many corners [`around_arc`] gives for a turn, without computing them.
pub(super) fn corner_count(rate: f64, interval: PositionInterval) -> usize {
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
pub(super) fn outermost_radius(rate: f64, (lower, upper): PositionInterval) -> f64 {
    if wraps(rate, (lower, upper)) {
        return libm::cos(PI / f64::from(WRAPPED_CORNERS)).recip();
    }
    let angle = rate * (upper - lower);
    // Tangents at two points of the unit circle that are an angle `2 b` apart meet at radius `1 / cos b`: `b` is half
    // the arc for two tangents, and a quarter of it for three.
    let between_tangents = if angle <= 2.0 * FRAC_PI_4 { angle / 2.0 } else { angle / 4.0 };
    // Beyond half a turn it is the square, whose corners are at `1 / cos(pi / 4)`, whatever the length of the arc.
    if between_tangents < FRAC_PI_4 { libm::cos(between_tangents).recip() } else { SQRT_2 }
}

/// Corners around an arc. Up to a quarter of a turn: its ends and the point where the tangents at the ends
/// meet. Up to half a turn: also the tangent in the middle. Up to one and a half turns: the square around
/// the circle. Beyond: a polygon that hardly exceeds the circle.
pub(super) fn around_arc(rate: f64, interval: PositionInterval, corners: &mut Vec<Corner>) {
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
    // Tangents at the ends of more than half a turn do not meet on the side of the arc. The square needs as few
    // corners as three tangents and covers every arc. Its corners may lie beyond the ends of the interval; the
    // position is only where a local search starts, and so has to be inside.
    if angle > PI {
        corners.extend([-3.0, -1.0, 1.0, 3.0].map(|eighths| {
            let corner = on_circle(rate, middle + eighths * FRAC_PI_4 / rate, radius);
            Corner { position: corner.position.clamp(lower, upper), ..corner }
        }));
        return;
    }
    // The hull of the ends and the tangents' intersections contains the arc: a circle is inside of its tangents.
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
pub(super) fn around_segment((lower, upper): PositionInterval) -> [Corner; 2] {
    [on_line(lower), on_line(upper)]
}
