//! The plots of a run that are not of single joints.

/// Plots that are not of single joints, with what they show.
pub(super) const FIGURES: [(&str, &str); 6] = [
    ("position", "Distance between model and twin, of the links where it is largest"),
    ("orientation", "Angle between model and twin, of the links where it is largest"),
    ("clearance", "Smallest distance, of pairs whose distance can change"),
    ("zones", "Smallest distance from forbidden zones"),
    ("tracking_angle", "Setpoint minus position, of joints that turn"),
    ("tracking_shift", "Setpoint minus position, of joints that slide"),
];

/// What a plot shows, by its name.
pub(super) fn caption(id: &str) -> Option<&'static str> {
    FIGURES.iter().find(|(name, _)| *name == id).map(|(_, caption)| *caption)
}
