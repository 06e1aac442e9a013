//! Colours: the same for a link in every view, and one meaning for each of the others.

use re_sdk_types::components::Color;

/// Colours of lines on a dark background: distinct from each other and from [`OUTSIDE`].
const LINKS: [[u8; 3]; 12] = [
    [0x4e, 0x9b, 0xff],
    [0xff, 0xa9, 0x40],
    [0x4c, 0xd0, 0x7d],
    [0xb9, 0x8c, 0xff],
    [0xf7, 0xdc, 0x54],
    [0x38, 0xd6, 0xe0],
    [0xff, 0x8a, 0xd8],
    [0xa8, 0xd8, 0x4e],
    [0xc4, 0x9a, 0x6c],
    [0x9a, 0xb4, 0xd0],
    [0x8f, 0xe3, 0xc8],
    [0xe0, 0x9b, 0x83],
];

/// Lines at limits and tolerances.
pub(crate) const LIMIT: Color = rgb([0xff, 0x5c, 0x5c]);
/// Bodies and values that violate a limit: red, which is used for nothing else.
pub(crate) const OUTSIDE: Color = rgb([0xff, 0x2d, 0x2d]);
/// An obstacle that a link is too close to: darker, since it is large and the link must stand out before it.
pub(crate) const OUTSIDE_OBSTACLE: Color = rgba([0xa8, 0x24, 0x24], 0xd8);
/// A zone that a link is in.
pub(crate) const OUTSIDE_ZONE: Color = rgba([0xff, 0x2d, 0x2d], 0x40);
/// A line to something that is near without a violation.
pub(crate) const QUIET: Color = rgb([0x8c, 0xa0, 0xb8]);
/// A link whose description gives no colour: one colour for all of them.
pub(crate) const UNPAINTED: Color = rgb([0xa4, 0xae, 0xbc]);
/// The tolerances of position and orientation, each in a pale shade of its error's colour.
pub(crate) const TOLERANCES: [Color; 2] = [rgb([0xb4, 0xd4, 0xff]), rgb([0xff, 0xdc, 0xb0])];
/// The axes x, y and z of a frame.
pub(crate) const AXES: [Color; 3] =
    [rgb([0xff, 0x6b, 0x6b]), rgb([0x5f, 0xe0, 0x7a]), rgb([0x5f, 0x9d, 0xff])];
/// The model's links: translucent, in a hue that robots rarely have.
pub(crate) const MODEL: Color = rgba([0x2e, 0xe6, 0xd6], 0x48);
/// Zones: a translucent warning colour.
pub(crate) const ZONE: Color = rgba([0xff, 0x8c, 0x1a], 0x38);
/// The ball around the link with the largest error.
pub(crate) const MARKER: Color = rgba([0xff, 0x2d, 0x2d], 0x60);
/// The path of the tool.
pub(crate) const TRAIL: Color = rgb([0xff, 0xdc, 0x50]);
/// The line of the smallest distance, labels, and events without a fault.
pub(crate) const NEUTRAL: Color = rgb([0xf2, 0xf2, 0xf2]);
/// Background of the three-dimensional view.
pub(crate) const BACKGROUND: [u8; 3] = [0x1c, 0x1e, 0x24];
/// The colours of [`STATUS_WORDS`], in their order.
pub(crate) const STATUS_COLORS: [Color; 5] = [
    rgb([0x2e, 0x9e, 0x4f]),
    rgb([0xd9, 0x2d, 0x2d]),
    rgb([0xd9, 0x8a, 0x1f]),
    rgb([0x60, 0x66, 0x70]),
    rgb([0x60, 0x66, 0x70]),
];
/// The statuses of a check as the viewer names them.
pub(crate) const STATUS_WORDS: [&str; 5] = ["pass", "fail", "error", "skipped", "inconclusive"];

const OBSTACLES: [[u8; 3]; 5] =
    [[0x6b, 0x70, 0x7a], [0xb8, 0x8a, 0x5a], [0x7d, 0x8c, 0x6a], [0x8a, 0x78, 0x96], [0x6f, 0x8f, 0x99]];

/// The colour of a link or of a numbered line.
pub(crate) fn link(index: usize) -> Color {
    rgb(LINKS[index % LINKS.len()])
}

/// The same colour, mixed with as much white: a commanded value beside the true one.
pub(crate) fn pale(index: usize) -> Color {
    rgb(LINKS[index % LINKS.len()].map(|channel| channel / 2 + 0x80))
}

/// The same colour, half as bright: a measured value beside the true one.
pub(crate) fn dim(index: usize) -> Color {
    rgb(LINKS[index % LINKS.len()].map(|channel| channel / 2 + 0x18))
}

/// The colour of an obstacle.
pub(crate) fn obstacle(index: usize) -> Color {
    rgba(OBSTACLES[index % OBSTACLES.len()], 0xd8)
}

const fn rgb([r, g, b]: [u8; 3]) -> Color {
    rgba([r, g, b], 0xff)
}

const fn rgba([r, g, b]: [u8; 3], alpha: u8) -> Color {
    Color(re_sdk_types::datatypes::Rgba32(u32::from_be_bytes([r, g, b, alpha])))
}
