//! Camera and target of a calibration, as a table.

use congruent_calibration::{CameraFrames, FrameOnLink};
use maud::{Markup, html};

use crate::parts::{Pointer, value};

/// Where camera and target are; nothing if no camera measured the rows.
pub(crate) fn camera_section(frames: Option<&CameraFrames>) -> Markup {
    let Some(frames) = frames else { return Markup::default() };
    let at = Pointer::root().key("camera");
    html! {
        section {
            h2 { "Camera and target" }
            table {
                thead { tr {
                    th { "frame" } th { "in link" } th { "x, mm" } th { "y, mm" } th { "z, mm" }
                    th { "roll, deg" } th { "pitch, deg" } th { "yaw, deg" }
                } }
                tbody {
                    (frame_row("camera", &frames.camera, &at.key("camera")))
                    (frame_row("target", &frames.target, &at.key("target")))
                }
            }
            @if !frames.has_orientation {
                p.small { "No orientations were measured, so that of the target is arbitrary." }
            }
        }
    }
}

fn frame_row(name: &str, frame: &FrameOnLink, at: &Pointer) -> Markup {
    let pose = &frame.link_from_frame;
    let translation = at.key("link_from_frame").key("translation_m");
    html! {
        tr {
            td { (name) }
            td { (frame.link) }
            @for (axis, length_m) in pose.translation_m.into_iter().enumerate() {
                td { (value(&translation.key(axis), length_m, &format!("{:.4}", length_m * 1e3))) }
            }
            @for angle_rad in pose.rpy_rad() { td { (format!("{:.4}", angle_rad.to_degrees())) } }
        }
    }
}
