//! How many elements have their value from one place: those of a class of defaults, of a replica, of a model that is attached twice.

use std::{collections::BTreeMap, path::PathBuf};

use congruent_mjcf::{MjActuator, MjBody, MjGeom, MjJoint, MjModel, MjPlace};

/// How many elements have a value from a place, by file and start.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct PlaceUsers(BTreeMap<PathBuf, BTreeMap<usize, usize>>);

impl PlaceUsers {
    pub(super) fn of(model: &MjModel) -> Self {
        let mut users = Self::default();
        model.bodies.iter().for_each(|body| users.add_body(body));
        model.joints.iter().for_each(|joint| users.add_joint(joint));
        model.geoms.iter().for_each(|geom| users.add_geom(geom));
        model.actuators.iter().for_each(|actuator| users.add_actuator(actuator));
        users
    }

    /// Whether a change at this place changes more than one element.
    pub(super) fn are_several(&self, place: &MjPlace) -> bool {
        let count = self.0.get(&place.source.path).and_then(|file| file.get(&place.span.start));
        count.is_some_and(|count| *count > 1)
    }

    fn add_body(&mut self, body: &MjBody) {
        self.add([Some(&body.place), body.pos.place.as_ref(), body.orientation.place.as_ref()]);
        if let Some(inertial) = &body.inertial {
            let [mass, pos] = [&inertial.mass.place, &inertial.pos.place].map(Option::as_ref);
            let turn = inertial.orientation.place.as_ref();
            self.add([Some(&inertial.place), mass, pos, turn, inertial.inertia.place.as_ref()]);
        }
    }

    fn add_joint(&mut self, joint: &MjJoint) {
        let [range, effort] =
            [&joint.range, &joint.actuator_force_range].map(|of| of.as_ref()?.place.as_ref());
        let [friction, armature] = [&joint.friction_loss, &joint.armature].map(|of| of.place.as_ref());
        let [point, axis] = [joint.pos_in_body.place.as_ref(), joint.axis_in_body.place.as_ref()];
        self.add([Some(&joint.place), range, effort, joint.damping.place.as_ref(), friction, armature]);
        self.add([point, axis]);
    }

    fn add_geom(&mut self, geom: &MjGeom) {
        self.add([Some(&geom.place), geom.mass.place.as_ref()]);
    }

    fn add_actuator(&mut self, actuator: &MjActuator) {
        let [force, control] =
            [&actuator.force_range, &actuator.control_range].map(|of| of.as_ref()?.place.as_ref());
        // With `inheritrange` it is the range of the joint.
        let control = control.filter(|place| place.key == "ctrlrange");
        self.add([Some(&actuator.place), force, control]);
    }

    fn add<'a>(&mut self, places: impl IntoIterator<Item = Option<&'a MjPlace>>) {
        for place in places.into_iter().flatten() {
            if !self.0.contains_key(&place.source.path) {
                self.0.insert(place.source.path.clone(), BTreeMap::new());
            }
            if let Some(file) = self.0.get_mut(&place.source.path) {
                *file.entry(place.span.start).or_default() += 1;
            }
        }
    }
}
