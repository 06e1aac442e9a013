//! Compares masses, inertia tensors and centres of mass with each other and with the shapes of their links.

use std::iter;

use congruent_description::{Inertia, LARGEST_GYRATION_M, Link, LinkIndex};
use congruent_input::{
    display::{length, quantity},
    units::LARGEST_PLAUSIBLE_M,
};

use super::{
    UnitCheck, UnitMistake,
    features::{LinkInertiaFeatures, median},
    thresholds::{
        FARTHEST_COM, FARTHEST_COM_IN_ORIGINS, GYRATION_OUTSIDE, GYRATION_TO_DIAGONAL, LEAST_COM_M,
        LEAST_FOAM_DENSITY, LEAST_MASS_KG, MEDIAN_BOX_DENSITY, MOST_BOX_DENSITY, MOST_MASS_TO_OTHERS,
        PLACEHOLDER_GYRATION_TO_DIAGONAL, PLACEHOLDER_SPHERE_DENSITY, SPHERE_DENSITY,
    },
};
use crate::codes;

const MASS: UnitMistake = UnitMistake {
    code: codes::units::MASS,
    words: "links have an implausible mass for their size",
    element: "mass",
};
const INERTIA: UnitMistake = UnitMistake {
    code: codes::units::INERTIA,
    words: "links have an implausible inertia for their mass and size",
    element: "inertia",
};
const NO_TENSOR: UnitMistake = UnitMistake {
    code: codes::urdf::ZERO_INERTIA,
    words: "links have a mass but an inertia of zero",
    element: "inertia",
};
const COM: UnitMistake = UnitMistake {
    code: congruent_description::codes::urdf::CENTER_OF_MASS,
    words: "links have a centre of mass far from their shapes and joints",
    element: "origin",
};

fn is_within([least, most]: [f64; 2], value: f64) -> bool {
    (least..=most).contains(&value)
}

/// Medians over the links of the robot that are outside the usual range; `None` if usual. A unit mistake in the whole file
/// shifts the median, and then placeholder tensors are compared like all others.
struct UnusualMedians {
    gyration: Option<f64>,
    sphere: Option<f64>,
    density: Option<f64>,
}

impl UnusualMedians {
    fn over(bodies: &[LinkInertiaFeatures]) -> Self {
        let unusual = |values: Vec<f64>, range: [f64; 2]| {
            let middle = median(values.iter().copied()).filter(|_| values.len() >= 2);
            // A single body has no median beside itself.
            middle.filter(|middle| !is_within(range, *middle))
        };
        let bare = bodies.iter().filter(|body| body.shapes.is_none() && !body.is_placeholder);
        Self {
            gyration: unusual(
                bodies.iter().filter_map(LinkInertiaFeatures::gyration_share).collect(),
                GYRATION_TO_DIAGONAL,
            ),
            sphere: unusual(bare.map(|body| body.sphere_density).collect(), SPHERE_DENSITY),
            density: unusual(
                bodies.iter().filter_map(LinkInertiaFeatures::box_density).collect(),
                MEDIAN_BOX_DENSITY,
            ),
        }
    }
}

impl UnitCheck<'_> {
    pub(super) fn bodies(&mut self) {
        let robot = self.robot;
        let bodies: Vec<LinkInertiaFeatures> = robot
            .link_indices()
            .filter_map(|link| {
                LinkInertiaFeatures::from_inertia(link, robot.link(link).inertia.as_ref()?, &self.sizes)
            })
            .collect();
        let whole = UnusualMedians::over(&bodies);
        // A density that no material has says more than the masses of other links.
        let is_dense = |link: LinkIndex| {
            let density =
                bodies.iter().find(|body| body.link == link).and_then(LinkInertiaFeatures::box_density);
            density.is_some_and(|density| density > MOST_BOX_DENSITY)
        };
        let mut reported: Vec<LinkIndex> =
            robot.link_indices().filter(|&link| self.too_light(link)).collect();
        // Beside links that are too light, those that are right are the heavy ones.
        if reported.is_empty() {
            let all_kg = robot.link_indices().map(|link| self.mass_kg(link)).sum();
            let is_reported = |link: &LinkIndex| !is_dense(*link) && self.too_heavy(*link, all_kg);
            reported = robot.link_indices().filter(is_reported).collect();
        }
        for body in bodies.iter().filter(|body| !reported.contains(&body.link)) {
            self.body(body, &whole);
        }
        for link in robot.link_indices() {
            if let Some(inertia) = &robot.link(link).inertia {
                self.center_of_mass(link, inertia);
                self.tensor(link, inertia);
                self.example(link, inertia);
            }
        }
    }

    fn body(&mut self, body: &LinkInertiaFeatures, whole: &UnusualMedians) {
        let name = &self.robot.link(body.link).name;
        let density = body.box_density();
        let is_heavy =
            density.is_some_and(|density| density > MOST_BOX_DENSITY) && body.mass_kg > LEAST_MASS_KG;
        let is_off =
            whole.density.is_some() && density.is_some_and(|density| !is_within(MEDIAN_BOX_DENSITY, density));
        if let (Some(density), true) = (density, is_heavy || is_off) {
            let what = format!(
                "its density is {} (mass {} over the volume of the box around its shapes)",
                quantity(density, "kg/m^3"),
                quantity(body.mass_kg, "kg")
            );
            let help =
                "steel has 7900 kg/m^3; is the mass in grams, or are the shapes in another unit?".to_owned();
            self.warn_link(&MASS, name, &what, help);
            // The mass is the likelier mistake: an inertia that does not fit it would be a second message about it.
            return;
        }
        if belongs(body, whole) {
            return;
        }
        let what = match body.shapes {
            Some(shapes) => format!(
                "its radius of gyration is {}, but the diagonal of its shapes is {}",
                length(body.gyration_m),
                length(shapes.diagonal_m())
            ),
            None => format!(
                "its radius of gyration is {}, as of a solid sphere of {} with a density of {}",
                length(body.gyration_m),
                quantity(body.mass_kg, "kg"),
                quantity(body.sphere_density, "kg/m^3")
            ),
        };
        self.warn_link(&INERTIA, name, &what, guess(body));
    }

    /// Reports a mass that is far too small for the shapes and for the tensor alike; whether it did.
    fn too_light(&mut self, link: LinkIndex) -> bool {
        let Link { name, inertia, .. } = self.robot.link(link);
        let features = |inertia: &Inertia| LinkInertiaFeatures::of_any_mass(link, inertia, &self.sizes);
        // A typed tensor says nothing about the mass; frames with a mass that only is not zero have one.
        let Some(body) = inertia.as_ref().and_then(features).filter(|body| !body.is_placeholder) else {
            return false;
        };
        let (Some(shapes), Some(density), Some(share)) =
            (body.shapes, body.box_density(), body.gyration_share())
        else {
            return false;
        };
        if density >= LEAST_FOAM_DENSITY || share <= GYRATION_OUTSIDE {
            return false;
        }
        let what = format!(
            "its mass is {}, a density of {} in the box around its shapes, and its radius of gyration {}, but the diagonal of its \
             shapes is {}",
            quantity(body.mass_kg, "kg"),
            quantity(density, "kg/m^3"),
            length(body.gyration_m),
            length(shapes.diagonal_m())
        );
        let help = "the mass is read in kg: is the value in tonnes, 1000 times too small?".to_owned();
        self.warn_link(&MASS, name, &what, help);
        true
    }

    fn mass_kg(&self, link: LinkIndex) -> f64 {
        self.robot.link(link).inertia.as_ref().map_or(0.0, |of| of.mass_kg)
    }

    /// Reports a link that is far heavier than all other links together; whether it did. The first body with a mass is a base,
    /// which may be a vehicle or a foundation.
    fn too_heavy(&mut self, link: LinkIndex, all_kg: f64) -> bool {
        let robot = self.robot;
        let own_kg = self.mass_kg(link);
        let others_kg = all_kg - own_kg;
        let mut above = iter::successors(robot.parent_joint(link), |&joint| {
            robot.parent_joint(robot.joint(joint).parent)
        });
        // First the mass, since few links are so heavy.
        if own_kg <= MOST_MASS_TO_OTHERS * others_kg
            || !above.any(|joint| self.mass_kg(robot.joint(joint).parent) > 0.0)
        {
            return false;
        }
        let what = format!(
            "its mass is {}, but all other links together have {}; a link that another one carries is reported above {} times \
             that",
            quantity(own_kg, "kg"),
            quantity(others_kg, "kg"),
            MOST_MASS_TO_OTHERS
        );
        let help = "the mass is read in kg: is the value in grams?".to_owned();
        self.warn_link(&MASS, &robot.link(link).name, &what, help);
        true
    }

    /// Reports the placeholder tensor of 1 kg m^2 about every axis on a link that is far too small for it.
    fn example(&mut self, link: LinkIndex, inertia: &Inertia) {
        let shapes = self.sizes.shapes[link.get()].filter(|shapes| shapes.diagonal_m() > 0.0);
        // For lighter links `urdf/inertial` has reported the radius of gyration already.
        let gyration_m = (1.0 / inertia.mass_kg).sqrt();
        if let Some(shapes) = shapes.filter(|_| inertia.is_example() && gyration_m < LARGEST_GYRATION_M)
            && gyration_m > GYRATION_TO_DIAGONAL[1] * shapes.diagonal_m()
        {
            let what = format!(
                "its inertia is the placeholder 1 kg m^2 about every axis, but the diagonal of its shapes is {}",
                length(shapes.diagonal_m())
            );
            let help = "give the inertia of a box of the link's size".to_owned();
            self.warn_link(&INERTIA, &self.robot.link(link).name, &what, help);
        }
    }

    /// Reports a tensor of zero on a link with mass. Light links are markers, for which zero is usual.
    fn tensor(&mut self, link: LinkIndex, inertia: &Inertia) {
        if inertia.mass_kg > LEAST_MASS_KG && inertia.tensor_kg_m2.amax() == 0.0 {
            let what = format!("its inertia is zero, but its mass is {}", quantity(inertia.mass_kg, "kg"));
            let help = "if the inertia is not known, give that of a box of the link's size".to_owned();
            self.warn_link(&NO_TENSOR, &self.robot.link(link).name, &what, help);
        }
    }

    fn center_of_mass(&mut self, link: LinkIndex, inertia: &Inertia) {
        let (robot, com) = (self.robot, inertia.link_from_inertial.translation.vector);
        // Larger ones were reported by `urdf/pose.rs` when the file was read.
        if inertia.mass_kg <= 0.0 || com.norm() < LEAST_COM_M || com.amax() > LARGEST_PLAUSIBLE_M {
            return;
        }
        let what = if let Some(shapes) = self.sizes.shapes[link.get()] {
            let joints = robot.joints().iter().filter(|joint| joint.parent == link);
            // The link's own joint is at its origin.
            let all = joints.fold(shapes.including(nalgebra::Vector3::zeros()), |all, joint| {
                all.including(joint.parent_from_joint.translation.vector)
            });
            let (away_m, size_m) = (all.distance_m(com), all.diagonal_m());
            (away_m > FARTHEST_COM * size_m).then(|| {
                format!(
                    "its centre of mass is {} away from its shapes and joints, which span {}",
                    length(away_m),
                    length(size_m)
                )
            })
        } else {
            let longest_m = self.sizes.longest_origin_m;
            (longest_m > 0.0 && com.norm() > FARTHEST_COM_IN_ORIGINS * longest_m).then(|| {
                format!(
                    "its centre of mass is {} away from its origin, but the longest joint origin of the robot is {}",
                    length(com.norm()),
                    length(longest_m)
                )
            })
        };
        if let Some(what) = what {
            let help = "the origin is read in metres: is the value in centimetres or millimetres?".to_owned();
            self.warn_link(&COM, &robot.link(link).name, &what, help);
        }
    }
}

/// Whether mass, tensor and shapes can belong to one body: by the radius of gyration against the shapes, or without shapes by
/// the density of the equivalent solid sphere.
fn belongs(body: &LinkInertiaFeatures, whole: &UnusualMedians) -> bool {
    match body.gyration_share() {
        Some(ratio) if body.is_placeholder && whole.gyration.is_none() => {
            is_within(PLACEHOLDER_GYRATION_TO_DIAGONAL, ratio)
        }
        Some(ratio) => is_within(GYRATION_TO_DIAGONAL, ratio),
        None if body.is_placeholder && whole.sphere.is_none() => {
            is_within(PLACEHOLDER_SPHERE_DENSITY, body.sphere_density)
        }
        None => is_within(SPHERE_DENSITY, body.sphere_density),
    }
}

/// The most likely correction of the unit: the one after which the density of the equivalent sphere is nearest to a usual
/// density, in orders of magnitude.
fn guess(body: &LinkInertiaFeatures) -> String {
    // kg/m^3, as of plastics and hollow castings of aluminium.
    const USUAL_DENSITY: f64 = 800.0;
    let after = [
        (1e-3, 1.0, "the mass is read in kg: is the value in grams?"),
        (1.0, 1e3, "the inertia is read in kg m^2: is the value too small by a factor of 1000?"),
        (
            1.0,
            1e6,
            "the inertia is read in kg m^2: is the value too small by a factor of 10^6, converted twice?",
        ),
        (1.0, 1e-3, "the inertia is read in kg m^2: is the value in g m^2?"),
        (1.0, 1e-4, "the inertia is read in kg m^2: is the value in kg cm^2?"),
        (1.0, 1e-6, "the inertia is read in kg m^2: is the value in kg mm^2?"),
        (1.0, 1e-9, "the inertia is read in kg m^2: is the value in g mm^2?"),
    ];
    let off = |(mass, inertia, _): &(f64, f64, &str)| {
        // A sphere of mass m and moment I has r^2 = 5 I / (2 m), so its density goes with m / r^3 = m (m / I)^(3/2).
        let density = body.sphere_density * mass * libm::pow(mass / inertia, 1.5);
        libm::log(density / USUAL_DENSITY).abs()
    };
    // In the logarithm, since a factor too large is as bad as one too small.
    let best = after.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    best.map_or_else(String::new, |(_, _, words)| (*words).to_owned())
}
