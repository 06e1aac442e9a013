//! Masses, tensors and centres of mass against each other and against shapes.

use super::{
    Judge, Kind,
    features::{Body, median},
    thresholds::{
        FARTHEST_COM, FARTHEST_COM_IN_ORIGINS, GYRATION_TO_DIAGONAL, LEAST_COM_M, LEAST_MASS_KG,
        MEDIAN_BOX_DENSITY, MOST_BOX_DENSITY, PLACEHOLDER_GYRATION_TO_DIAGONAL, PLACEHOLDER_SPHERE_DENSITY,
        SPHERE_DENSITY,
    },
};
use crate::{
    Elementary as _,
    display::{length, quantity},
    model::{Inertia, LinkIndex},
    urdf::{CENTER_OF_MASS, LARGEST_GYRATION_M, LARGEST_PLAUSIBLE_M},
};

const MASS: Kind = Kind { code: "units::mass", words: "links have a mass that no body of their size has" };
const INERTIA: Kind = Kind {
    code: "units::inertia",
    words: "links have an inertia that does not belong to their mass and size",
};
const NO_TENSOR: Kind =
    Kind { code: "urdf::zero_inertia", words: "links have a mass and an inertia of zero, which no body has" };
const COM: Kind = Kind {
    code: CENTER_OF_MASS,
    words: "links have a centre of mass far from everything that belongs to them",
};

fn is_within([least, most]: [f64; 2], value: f64) -> bool {
    (least..=most).contains(&value)
}

/// Middle values of the robot that are outside of what is usual: then placeholders are judged as all others.
struct Whole {
    gyration: Option<f64>,
    sphere: Option<f64>,
    density: Option<f64>,
}

impl Whole {
    fn of(bodies: &[Body]) -> Self {
        let unusual = |values: Vec<f64>, range: [f64; 2]| {
            let middle = median(values.iter().copied()).filter(|_| values.len() >= 2);
            middle.filter(|middle| !is_within(range, *middle))
        };
        let bare = bodies.iter().filter(|body| body.shapes.is_none() && !body.is_placeholder);
        Self {
            gyration: unusual(bodies.iter().filter_map(Body::gyration_share).collect(), GYRATION_TO_DIAGONAL),
            sphere: unusual(bare.map(|body| body.sphere_density).collect(), SPHERE_DENSITY),
            density: unusual(bodies.iter().filter_map(Body::box_density).collect(), MEDIAN_BOX_DENSITY),
        }
    }
}

impl Judge<'_> {
    pub(super) fn bodies(&mut self) {
        let robot = self.robot;
        let bodies: Vec<Body> = robot
            .link_indices()
            .filter_map(|link| Body::of(link, robot.link(link).inertia.as_ref()?, &self.sizes))
            .collect();
        let whole = Whole::of(&bodies);
        for body in &bodies {
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

    fn body(&mut self, body: &Body, whole: &Whole) {
        let name = &self.robot.link(body.link).name;
        let density = body.box_density();
        let is_heavy =
            density.is_some_and(|density| density > MOST_BOX_DENSITY) && body.mass_kg > LEAST_MASS_KG;
        let is_off =
            whole.density.is_some() && density.is_some_and(|density| !is_within(MEDIAN_BOX_DENSITY, density));
        if let (Some(density), true) = (density, is_heavy || is_off) {
            let what = format!(
                "its mass of {} in the box around its shapes is {}",
                quantity(body.mass_kg, "kg"),
                quantity(density, "kg/m^3")
            );
            let help =
                "steel has 7900 kg/m^3: is the mass in grams, or are the shapes in another unit?".to_owned();
            self.warn_link(&MASS, name, &what, ("mass", help));
            return;
        }
        if belongs(body, whole) {
            return;
        }
        let what = match body.shapes {
            Some(shapes) => format!(
                "its radius of gyration is {}, and its shapes are {} large",
                length(body.gyration_m),
                length(shapes.diagonal_m())
            ),
            None => format!(
                "its radius of gyration is {}, that of a ball of {} with {}",
                length(body.gyration_m),
                quantity(body.mass_kg, "kg"),
                quantity(body.sphere_density, "kg/m^3")
            ),
        };
        self.warn_link(&INERTIA, name, &what, ("inertia", guess(body)));
    }

    /// The inertia of examples on a link that is far smaller.
    fn example(&mut self, link: LinkIndex, inertia: &Inertia) {
        let shapes = self.sizes.shapes[link.get()].filter(|shapes| shapes.diagonal_m() > 0.0);
        // Of lighter links it is told when they are read.
        let gyration_m = (1.0 / inertia.mass_kg).sqrt();
        if let Some(shapes) = shapes.filter(|_| inertia.is_example() && gyration_m < LARGEST_GYRATION_M)
            && gyration_m > GYRATION_TO_DIAGONAL[1] * shapes.diagonal_m()
        {
            let what = format!(
                "its inertia is 1 kg m^2 about every axis, as in examples, and its shapes are {} large",
                length(shapes.diagonal_m())
            );
            let help = "give the inertia of a box of the link's size".to_owned();
            self.warn_link(&INERTIA, &self.robot.link(link).name, &what, ("inertia", help));
        }
    }

    /// A mass without extent; markers have none either.
    fn tensor(&mut self, link: LinkIndex, inertia: &Inertia) {
        if inertia.mass_kg > LEAST_MASS_KG && inertia.tensor_kg_m2.amax() == 0.0 {
            let what = format!("its inertia is zero, and its mass {}", quantity(inertia.mass_kg, "kg"));
            let help = "a body with mass has an inertia: that of a box of its size, if nothing else is known"
                .to_owned();
            self.warn_link(&NO_TENSOR, &self.robot.link(link).name, &what, ("inertia", help));
        }
    }

    fn center_of_mass(&mut self, link: LinkIndex, inertia: &Inertia) {
        let (robot, com) = (self.robot, inertia.link_from_inertial.translation.vector);
        // Larger ones are told when they are read.
        if inertia.mass_kg <= 0.0 || com.norm() < LEAST_COM_M || com.amax() > LARGEST_PLAUSIBLE_M {
            return;
        }
        let what = if let Some(shapes) = self.sizes.shapes[link.get()] {
            let joints = robot.joints().iter().filter(|joint| joint.parent == link);
            let all = joints.fold(shapes.including(nalgebra::Vector3::zeros()), |all, joint| {
                all.including(joint.parent_from_joint.translation.vector)
            });
            let (away_m, size_m) = (all.distance_m(com), all.diagonal_m());
            (away_m > FARTHEST_COM * size_m).then(|| {
                format!(
                    "its centre of mass is {} outside of what belongs to it, which is {} large",
                    length(away_m),
                    length(size_m)
                )
            })
        } else {
            let longest_m = self.sizes.longest_origin_m;
            (longest_m > 0.0 && com.norm() > FARTHEST_COM_IN_ORIGINS * longest_m).then(|| {
                format!(
                    "its centre of mass is {} away, and no joint is farther than {} from the one before",
                    length(com.norm()),
                    length(longest_m)
                )
            })
        };
        if let Some(what) = what {
            let help = "its origin is in metres: is it in centimetres or millimetres?".to_owned();
            self.warn_link(&COM, &robot.link(link).name, &what, ("origin", help));
        }
    }
}

/// Whether mass, tensor and shapes can belong to one body.
fn belongs(body: &Body, whole: &Whole) -> bool {
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

/// The unit that is most likely, by the density that would follow.
fn guess(body: &Body) -> String {
    // As plastics and hollow castings of aluminium.
    const USUAL_DENSITY: f64 = 800.0;
    let after = [
        (1e-3, 1.0, "the mass is in kg: is it in grams?"),
        (1.0, 1e3, "the inertia is in kg m^2: is it a thousandth of that?"),
        (1.0, 1e6, "the inertia is in kg m^2: is it a millionth of that, converted twice?"),
        (1.0, 1e-3, "the inertia is in kg m^2: is it in g m^2?"),
        (1.0, 1e-4, "the inertia is in kg m^2: is it in kg cm^2?"),
        (1.0, 1e-6, "the inertia is in kg m^2: is it in kg mm^2?"),
        (1.0, 1e-9, "the inertia is in kg m^2: is it in g mm^2?"),
    ];
    let off = |(mass, inertia, _): &(f64, f64, &str)| {
        let density = body.sphere_density * mass * (mass / inertia).to_power(1.5);
        (density / USUAL_DENSITY).logarithm().abs()
    };
    let best = after.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    best.map_or_else(String::new, |(_, _, words)| (*words).to_owned())
}
