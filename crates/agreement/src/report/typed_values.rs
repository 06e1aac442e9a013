//! The values that the robot file and the URDF of a chain are typed with.

use congruent_description::{JointDigits, TableDigits};

use super::names::ModelNames;
use crate::diagnosis::{
    Criterion, DhEntry, ModelPair, TransformPart, TypedPlace, TypedValue, WrittenDigits, tie_written_alike,
};

impl ModelNames<'_> {
    /// The digits of the files that both models were read from. A model in screws is computed, so it has none.
    pub(super) fn digits(&self, models: &ModelPair, criterion: &Criterion) -> WrittenDigits {
        let mut values = Vec::new();
        if let (Some(places), Some(_)) = (self.places, models.candidate.convention) {
            table(&places.digits(), &mut values);
        }
        if let (Some(urdf), true) = (self.urdf, models.reference.joints.iter().all(|joint| joint.is_written))
        {
            let name = |&joint| self.description.robot.joint(joint).name.as_str();
            let names: Vec<&str> = self.chain.iter().map(name).collect();
            for (joint, digits) in urdf.joint_digits(&names).iter().enumerate() {
                joint_values(joint, digits, &mut values);
            }
        }
        tie_written_alike(&mut values, models);
        WrittenDigits::new(values, models, &criterion.configurations)
    }
}

fn table(TableDigits { rows, base, tool }: &TableDigits, values: &mut Vec<TypedValue>) {
    for (row, halves) in rows.iter().enumerate() {
        let place = |entry| TypedPlace::Row(row, entry);
        let typed = DhEntry::ALL.into_iter().zip(*halves);
        values.extend(typed.map(|(entry, half_place)| TypedValue { place: place(entry), half_place }));
    }
    transform(TypedPlace::Base, base, values);
    transform(TypedPlace::Tool, tool, values);
}

fn joint_values(joint: usize, JointDigits { origin, axis }: &JointDigits, values: &mut Vec<TypedValue>) {
    transform(|part| TypedPlace::Origin(joint, part), origin, values);
    let components = axis.iter().enumerate();
    values.extend(components.map(|(component, &half_place)| TypedValue {
        place: TypedPlace::Axis(joint, component),
        half_place,
    }));
}

fn transform(place: impl Fn(TransformPart) -> TypedPlace, halves: &[f64; 6], values: &mut Vec<TypedValue>) {
    let typed = TransformPart::ALL.into_iter().zip(*halves);
    values.extend(typed.map(|(part, half_place)| TypedValue { place: place(part), half_place }));
}
