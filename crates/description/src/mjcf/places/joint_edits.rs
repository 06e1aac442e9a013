//! Edits of losses and limits: attributes of a `<joint>`, and the range of its actuator.

use congruent_input::{TextEdit, number::significant};
use congruent_mjcf::{MjActuator, MjEffort, MjJoint, MjJointKind, MjPlace, MjWritten};
use congruent_robot::JointResistance;

use super::{
    MjcfPlaces,
    element::{NewAttribute, changed_attributes},
};

/// What a value may differ by and be the same, relative. Kind: rounding of sums and of gears.
const ROUNDING: f64 = 1e-12;

impl MjcfPlaces {
    /// The edits after which a joint has these losses; `None` if one of them is not its own, in the main file.
    pub(super) fn loss_edits(&self, name: &str, terms: &JointResistance) -> Option<Vec<TextEdit>> {
        let (index, joint) = self.joint(name)?;
        let added = |term: fn(&MjActuator) -> f64| self.actuators_of(index).map(term).sum::<f64>();
        let damping = joint.damping.clone().map(|[linear, ..]| linear);
        let losses = [
            ("damping", &damping, terms.damping - added(|of| of.damping)),
            ("frictionloss", &joint.friction_loss, terms.friction),
            ("armature", &joint.armature, terms.armature - added(|of| of.armature)),
        ];
        let mut new = Vec::new();
        for (key, written, value) in losses {
            if (value - written.value).abs() <= ROUNDING * value.abs().max(written.value.abs()) {
                continue;
            }
            // What the actuator adds is more than that already.
            if value < 0.0 || !self.is_own(written.place.as_ref()) {
                return None;
            }
            // The numbers after the first damp by powers of the speed.
            let others = written.place.as_ref().map_or("", |place| after_first_word(place.text()));
            new.push(NewAttribute::value(key, significant(value) + others));
        }
        let is_own = self.is_of_one_element(&joint.place);
        is_own.then(|| changed_attributes(&self.files[0].text, joint.place.span.start, &new, &[]))
    }

    /// The edits after which a joint has this limit; none if it is not its own, in the main file.
    pub(super) fn limit_edits(&self, name: &str, limit: &str, value: f64) -> Vec<TextEdit> {
        let Some((index, joint)) = self.joint(name) else { return Vec::new() };
        let edits = match limit {
            "lower" => self.end_of_range(joint, 0, value),
            "upper" => self.end_of_range(joint, 1, value),
            "effort" => self.effort(index, value),
            _ => None,
        };
        edits.unwrap_or_default()
    }

    /// One of the two numbers of `range`.
    fn end_of_range(&self, joint: &MjJoint, end: usize, value: f64) -> Option<Vec<TextEdit>> {
        let place = joint.range.as_ref()?.place.as_ref().filter(|place| self.is_of_one_element(place))?;
        let text = place.text();
        let [_, _] = text.split_whitespace().collect::<Vec<_>>()[..] else { return None };
        let word = text.split_whitespace().nth(end)?;
        let start = if end == 0 { text.find(word)? } else { text.rfind(word)? };
        let start = place.span.start + start;
        let is_hinge = joint.kind == MjJointKind::Hinge;
        let written = if is_hinge { joint.notation.written_angle(value) } else { value };
        Some(vec![TextEdit { span: start..start + word.len(), text: significant(written) }])
    }

    /// The limits of the forces at a joint, if one attribute has them and they are the same in both directions.
    fn effort(&self, index: usize, value: f64) -> Option<Vec<TextEdit>> {
        let joint = &self.model.joints[index];
        let MjEffort::Within { range: [low, high], .. } = joint.effort else { return None };
        if value <= 0.0 || (low + high).abs() > ROUNDING * high {
            return None;
        }
        let own = joint.actuator_force_range.as_ref();
        let actuators: Vec<&MjActuator> = self.actuators_of(index).collect();
        let (place, factor) = if own.and_then(|range| range.place.as_ref()) == self.of_effort(index) {
            // What the actuators give together must not be less.
            let given = actuators.iter().map(|of| of.effort_range().map(|range| range.value[1]));
            let given: Option<f64> = given.sum();
            let is_given = actuators.is_empty() || given.is_none_or(|given| given >= value);
            (own?.place.as_ref()?, is_given.then_some(1.0)?)
        } else {
            let [actuator] = actuators[..] else { return None };
            let is_within = own.is_none_or(|range| range.value[1] >= value && -range.value[0] >= value);
            force_per_number(actuator).filter(|_| is_within)?
        };
        let limit = significant(value / factor.abs());
        let edit = TextEdit { span: place.span.clone(), text: format!("-{limit} {limit}") };
        self.is_of_one_element(place).then(|| vec![edit])
    }

    /// Whether a value is in the element itself, or nowhere, so that a change is one of this element alone.
    fn is_own(&self, place: Option<&MjPlace>) -> bool {
        place.is_none_or(|place| self.is_of_one_element(place))
    }
}

/// The attribute that limits the force of an actuator, and the effort at the joint per number in it.
fn force_per_number(actuator: &MjActuator) -> Option<(&MjPlace, f64)> {
    let place = |range: &'_ Option<MjWritten<[f64; 2]>>, key: &str| {
        range.as_ref().and_then(|range| range.place.as_ref()).is_some_and(|place| place.key == key)
    };
    let gear = actuator.gear.value;
    let (range, factor) = match (&actuator.force_range, &actuator.control_range, actuator.gain) {
        (Some(force), ..) if place(&actuator.force_range, "forcerange") => (force, gear),
        (None, Some(control), Some(gain)) if place(&actuator.control_range, "ctrlrange") => {
            (control, gain * gear)
        }
        _ => return None,
    };
    range.place.as_ref().filter(|_| factor != 0.0).map(|place| (place, factor))
}

/// What follows the first word, with the space before it.
fn after_first_word(text: &str) -> &str {
    let text = text.trim();
    text.find(char::is_whitespace).map_or("", |end| &text[end..])
}
