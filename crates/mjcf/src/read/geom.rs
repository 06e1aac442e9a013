//! Geoms: their shapes, poses and masses.

use nalgebra::{Isometry3, Point3, Translation3, Unit, Vector3};

use super::{
    attributes::MjAttributes,
    names::MjNamed,
    orientation::{MjWrittenPose, SHORTEST, shortest_turn_to},
    reader::{MjContext, MjReader},
};
use crate::{
    codes,
    document::MjElement,
    model::{MjGeom, MjGeomMass, MjShape, MjWritten},
};

/// Density if none is given, kg/m^3. Source: MuJoCo, `geom/density`.
const WATER_KG_M3: f64 = 1000.0;

/// The pose and half the length of a shape between two points.
pub(super) struct MjFromTo {
    pub(super) pose: Isometry3<f64>,
    pub(super) half_length: f64,
}

/// z points from the first to the second point, the origin is in the middle; `None` if the points are the same.
pub(super) fn from_to(points: &[f64; 6]) -> Option<MjFromTo> {
    let (from, to) = (Vector3::from_column_slice(&points[..3]), Vector3::from_column_slice(&points[3..]));
    let (direction, length) = Unit::try_new_and_get(to - from, SHORTEST)?;
    let pose = Isometry3::from_parts(Translation3::from((from + to) / 2.0), shortest_turn_to(&direction));
    Some(MjFromTo { pose, half_length: length / 2.0 })
}

impl<'s> MjReader<'s, '_> {
    pub(super) fn geom(&mut self, element: &'s MjElement, context: &MjContext<'s>, body: usize) {
        let attributes = MjAttributes::with_class(element, self.class(element, context));
        let settings = &self.scope(context.attachment).settings;
        let mut pose = MjWrittenPose::read(&attributes, settings, self.diagnostics).isometry();
        let index = self.model.geoms.len();
        let name = self.named(MjNamed::Geom, element, context, index).unwrap_or_default();
        let between = self.between(&attributes);
        if let Some(between) = &between {
            pose = between.pose;
        }
        let shape = self.shape(&attributes, context.attachment, between.as_ref());
        let mass = match attributes.find("mass") {
            // The mass of a class holds also beside a density of the element itself.
            Some(mass) => mass.array([0.0]).map(|[mass]| MjGeomMass::Mass(mass)),
            None => attributes.number("density", WATER_KG_M3).map(MjGeomMass::Density),
        };
        self.check_mass(&attributes, &mass);
        self.model.geoms.push(MjGeom {
            name,
            body,
            shape,
            body_from_geom: context.body_from_frame * pose,
            mass,
            is_shell: attributes.is_true("shellinertia"),
            group: attributes.integer("group", 0),
            contact_type: attributes.integer("contype", 1),
            contact_affinity: attributes.integer("conaffinity", 1),
            rgba: attributes.find("rgba").map(|found| found.array([0.0; 4]).value),
            material: attributes.text("material").map(str::to_owned),
            place: element.place(),
        });
    }

    /// Refuses planes and height fields in bodies that move.
    pub(super) fn check_planes(&mut self) {
        // Parents are before their children.
        let mut moves = vec![false; self.model.bodies.len()];
        for index in 1..moves.len() {
            let body = &self.model.bodies[index];
            moves[index] = !body.joints.is_empty() || body.parent.is_some_and(|parent| moves[parent]);
        }
        for geom in self.model.geoms.iter().filter(|geom| moves[geom.body]) {
            let what = match geom.shape {
                MjShape::Plane => "a plane",
                MjShape::HeightField => "a height field",
                _ => continue,
            };
            let message = format!("body \"{}\" moves and has {what}", self.model.bodies[geom.body].name);
            let help = "only the world and bodies that are fixed to it have planes and height fields; a thin box moves";
            self.diagnostics.push(geom.place.fault(codes::mjcf::GEOM, message).with_help(help));
        }
    }

    fn between(&mut self, attributes: &MjAttributes<'_>) -> Option<MjFromTo> {
        let found = attributes.find("fromto")?;
        let kind = attributes.text("type").unwrap_or("sphere");
        let fault = |message: String| {
            found.attribute.fault(codes::mjcf::GEOM, format!("{}: {message}", attributes.element.label()))
        };
        let is_allowed = ["capsule", "cylinder", "box", "ellipsoid"].contains(&kind);
        let ends = if is_allowed {
            let same = || fault("the points of fromto are the same".to_owned());
            from_to(&found.array([0.0; 6]).value).ok_or_else(same)
        } else {
            let help = "it is for capsule, cylinder, box and ellipsoid";
            Err(fault(format!("a {kind} has no fromto")).with_help(help))
        };
        self.diagnostics.keep(ends)
    }

    fn check_mass(&mut self, attributes: &MjAttributes<'_>, mass: &MjWritten<MjGeomMass>) {
        let (what, value, unit) = match mass.value {
            MjGeomMass::Mass(mass) => ("mass", mass, "kg"),
            MjGeomMass::Density(density) => ("density", density, "kg/m^3"),
        };
        if let Some(place) = mass.place.as_ref().filter(|_| value < 0.0) {
            let message =
                format!("{}: {what} is {value} {unit}, limit >= 0 {unit}", attributes.element.label());
            self.diagnostics.push(place.fault(codes::mjcf::GEOM, message));
        }
    }

    fn shape(
        &mut self,
        attributes: &MjAttributes<'_>,
        attachment: usize,
        between: Option<&MjFromTo>,
    ) -> MjShape {
        let kind = attributes.text("type").unwrap_or("sphere");
        let mesh = attributes.text("mesh").and_then(|name| self.mesh_called(name, attributes, attachment));
        if kind == "mesh" || attributes.find("mesh").is_some() || kind == "sdf" {
            return match mesh {
                Some(mesh) if kind == "mesh" => MjShape::Mesh { mesh },
                None if kind == "mesh" && attributes.find("mesh").is_none() => {
                    let message =
                        format!("{} is of the type mesh and names none", attributes.element.label());
                    self.diagnostics.push(attributes.element.fault(codes::mjcf::GEOM, message));
                    MjShape::Plane
                }
                mesh => MjShape::Fitted { kind: kind.to_owned(), mesh },
            };
        }
        let mut size = attributes.array("size", [0.0; 3]).value;
        if let Some(between) = between {
            // Across, both sizes are the first; along, it is half the distance of the points.
            let is_round = matches!(kind, "capsule" | "cylinder");
            size = if is_round {
                [size[0], between.half_length, 0.0]
            } else {
                [size[0], size[0], between.half_length]
            };
        }
        let needed = match kind {
            "sphere" => 1,
            "capsule" | "cylinder" => 2,
            "ellipsoid" | "box" => 3,
            _ => 0,
        };
        if let Some(index) = size[..needed].iter().position(|size| *size <= 0.0) {
            let message = format!(
                "{}: number {} of size is {} m, limit > 0 m",
                attributes.element.label(),
                index + 1,
                size[index]
            );
            let at = attributes.find("size");
            let fault = at.map_or_else(
                || attributes.element.fault(codes::mjcf::GEOM, &message),
                |found| found.attribute.fault(codes::mjcf::GEOM, &message),
            );
            self.diagnostics.push(fault.with_help(format!("a {kind} has {needed} sizes, all above 0")));
        }
        match kind {
            "plane" => MjShape::Plane,
            "hfield" => MjShape::HeightField,
            "capsule" => MjShape::Capsule { radius: size[0], half_length: size[1] },
            "cylinder" => MjShape::Cylinder { radius: size[0], half_length: size[1] },
            "ellipsoid" => MjShape::Ellipsoid { radii: size },
            "box" => MjShape::Box { half_sizes: size },
            _ => MjShape::Sphere { radius: size[0] },
        }
    }
}

/// Triples of numbers as points.
pub(super) fn points(numbers: &[f64]) -> Vec<Point3<f64>> {
    numbers.chunks_exact(3).map(Point3::from_slice).collect()
}
