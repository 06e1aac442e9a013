//! Colours: one for each link wherever it appears, one meaning for each of the others.

use re_sdk_types::components::Color;

/// Lines on a dark background, told apart also side by side; none is close to [`OUTSIDE`].
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

/// Limits and tolerances.
pub(super) const LIMIT: Color = rgb([0xff, 0x5c, 0x5c]);
/// Outside a limit: red, and nothing else is.
pub(super) const OUTSIDE: Color = rgb([0xff, 0x2d, 0x2d]);
/// The model's ghost: a hue that robots rarely have, see-through.
pub(super) const GHOST: Color = rgba([0x2e, 0xe6, 0xd6], 0x48);
/// Where links may not be: a warning that hides nothing.
pub(super) const ZONE: Color = rgba([0xff, 0x8c, 0x1a], 0x38);
/// Around the link that is off most.
pub(super) const HALO: Color = rgba([0xff, 0x2d, 0x2d], 0x60);
/// Where the tool has been.
pub(super) const TRAIL: Color = rgb([0xff, 0xdc, 0x50]);
/// The smallest of all distances.
pub(super) const MINIMUM: Color = rgb([0xf2, 0xf2, 0xf2]);
/// Behind everything.
pub(super) const BACKGROUND: [u8; 3] = [0x1c, 0x1e, 0x24];
/// The lanes of [`LANES`], in its order.
pub(super) const LANE_COLORS: [Color; 4] =
    [rgb([0x2e, 0x9e, 0x4f]), rgb([0xd9, 0x2d, 0x2d]), rgb([0xd9, 0x8a, 0x1f]), rgb([0x60, 0x66, 0x70])];
/// The words of the status lanes.
pub(super) const LANES: [&str; 4] = ["pass", "fail", "error", "skipped"];

const OBSTACLES: [[u8; 3]; 5] =
    [[0x6b, 0x70, 0x7a], [0xb8, 0x8a, 0x5a], [0x7d, 0x8c, 0x6a], [0x8a, 0x78, 0x96], [0x6f, 0x8f, 0x99]];

/// The colour of a link, or of anything else that is numbered.
pub(super) fn link(index: usize) -> Color {
    rgb(LINKS[index % LINKS.len()])
}

/// The colour of an obstacle.
pub(super) fn obstacle(index: usize) -> Color {
    rgba(OBSTACLES[index % OBSTACLES.len()], 0xd8)
}

const fn rgb([r, g, b]: [u8; 3]) -> Color {
    rgba([r, g, b], 0xff)
}

const fn rgba([r, g, b]: [u8; 3], alpha: u8) -> Color {
    Color(re_sdk_types::datatypes::Rgba32(u32::from_be_bytes([r, g, b, alpha])))
}
