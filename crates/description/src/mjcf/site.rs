//! Sites to links: frames that are fixed to the link of their body.

use congruent_input::{Diagnostic, Diagnostics, units::LARGEST};
use congruent_mjcf::{MjModel, codes::mjcf::NUMBER};

use super::{placed::placed, tree::RobotParts};

/// Adds the sites of all bodies. One without a name is left out, since nothing can refer to it.
pub(super) fn add(model: &MjModel, parts: &mut RobotParts, diagnostics: &mut Diagnostics) {
    for site in model.sites.iter().filter(|site| site.name.is_written) {
        let far_m = site.body_from_site.translation.vector.amax();
        if far_m <= LARGEST {
            let parent = parts.body_links[site.body].clone();
            parts.push_frame(&parent, &site.name.text, site.body_from_site);
        } else {
            let message = format!("site \"{}\" is {far_m:e} m away, limit <= {LARGEST:e} m", site.name);
            diagnostics.push(placed(Diagnostic::error(NUMBER, message), &site.place));
        }
    }
}
