//! Edits of an `<inertial>`: mass, pos, and diaginertia in its axes or fullinertia.

use congruent_input::{
    TextEdit,
    number::{significant, significant_components},
};
use congruent_mjcf::{MjBody, MjInertial};
use congruent_robot::{Inertia, principal_moments};
use nalgebra::{Matrix3, Point3};

use super::{
    MjcfPlaces,
    element::{NewAttribute, changed_attributes},
};

/// What a value may differ by and be the same, as a share of the largest of its kind. Kind: rounding of turns into the frame of the file.
const ROUNDING: f64 = 1e-12;
/// What a product of inertia may be in axes that are kept, as a share of the largest moment. Kind: choice, below what a comparison
/// takes for one value.
const DIAGONAL: f64 = 1e-10;

/// The orientations that `<inertial>` may have.
const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

impl MjcfPlaces {
    /// The edits after which the body of a link has this inertia; `None` if its inertia is not that of an `<inertial>` of its own
    /// in the main file.
    pub(super) fn inertial_edits(&self, link: &str, inertia: &Inertia) -> Option<Vec<TextEdit>> {
        let (index, body) = self.body(link)?;
        let written = body.inertial.as_ref().filter(|of| self.is_of_one_element(&of.place))?;
        let is_as_written = self.model.total_mass_kg.is_none() && self.model.geoms_of_mass(index).is_empty();
        if !is_as_written || !is_kept(body, inertia) {
            return None;
        }
        let frame_from_inertial = written.notation.body_from_frame.inverse() * inertia.link_from_inertial;
        let turn = frame_from_inertial.rotation.to_rotation_matrix().into_inner();
        let tensor = turn * inertia.tensor_kg_m2 * turn.transpose();
        let mut new = Vec::new();
        let center = frame_from_inertial * Point3::origin();
        if is_other(&center.coords, &written.pos.value) {
            new.push(NewAttribute::value("pos", significant_components(center.coords.into()).join(" ")));
        }
        if (inertia.mass_kg - written.mass.value).abs() > ROUNDING * inertia.mass_kg {
            new.push(NewAttribute::value("mass", significant(inertia.mass_kg)));
        }
        let removed = tensor_attributes(written, &tensor, &mut new);
        let text = &self.files[0].text;
        Some(changed_attributes(text, written.place.span.start, &new, removed))
    }
}

/// Adds the moments about the written axes, or the whole tensor if it has others; returns the attributes that it makes wrong.
fn tensor_attributes(
    written: &MjInertial,
    tensor: &Matrix3<f64>,
    new: &mut Vec<NewAttribute>,
) -> &'static [&'static str] {
    let axes = written.orientation.value.to_rotation_matrix().into_inner();
    if !is_other(tensor, &(axes * written.inertia.value * axes.transpose())) {
        return &[];
    }
    let key = written.inertia.place.as_ref().map_or("diaginertia", |place| place.key.as_str());
    let in_axes = axes.transpose() * tensor * axes;
    let off = [(0, 1), (0, 2), (1, 2)].map(|at| in_axes[at].abs());
    if key == "diaginertia" && off.into_iter().all(|product| product <= DIAGONAL * in_axes.amax()) {
        let moments = significant_components(in_axes.diagonal().into());
        new.push(NewAttribute::value("diaginertia", moments.join(" ")));
        return &[];
    }
    let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| tensor[at]);
    let value = significant_components(entries).join(" ");
    new.push(NewAttribute { in_place_of: key.to_owned(), key: "fullinertia", value });
    // Its axes are those of the frame, beside which MuJoCo refuses an orientation.
    &ORIENTATIONS
}

/// Whether MuJoCo takes an inertia as it is written: above the bounds of the compiler, and of a possible body.
fn is_kept(body: &MjBody, inertia: &Inertia) -> bool {
    let [least, middle, largest] = principal_moments(&inertia.tensor_kg_m2);
    let rules = body.inertia_rules;
    let is_bounded = inertia.mass_kg >= rules.least_mass_kg && least >= rules.least_moment_kg_m2;
    is_bounded && inertia.mass_kg > 0.0 && least > 0.0 && largest <= least + middle
}

/// Whether one of the numbers differs by more than rounding.
fn is_other<const R: usize, const C: usize>(
    new: &nalgebra::SMatrix<f64, R, C>,
    written: &nalgebra::SMatrix<f64, R, C>,
) -> bool {
    (new - written).amax() > ROUNDING * new.amax().max(written.amax())
}
