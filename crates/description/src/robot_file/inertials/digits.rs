//! The digits that `[[inertial]]` entries are written with.

use congruent_input::{half_places_of_point, half_places_of_values};
use nalgebra::{Matrix3, Vector3};
use toml::Spanned;

use super::{
    InertialPlaces,
    written::{WrittenInertial, WrittenTensor, WrittenTerm},
};
use crate::robot_file::{halves_at, typed_vector};

/// Half of the last place of the numbers of an entry, in the frame of the entry; 0 where nothing is written or a program has written
/// all digits.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct InertialDigits {
    /// That of the mass, kg.
    pub mass_kg: f64,
    /// Those of the centre of mass, m.
    pub com_m: Vector3<f64>,
    /// Those of the tensor, kg m^2.
    pub tensor_kg_m2: Matrix3<f64>,
    /// That of the armature, kg m^2 or kg.
    pub armature: f64,
    /// That of the damping, N m s/rad or N s/m.
    pub damping: f64,
    /// That of the dry friction, N m or N.
    pub friction: f64,
}

/// Where a half place goes.
type Place = fn(&mut InertialDigits) -> &mut f64;

impl InertialPlaces {
    /// The digits of all entries; numbers of one kind are judged together.
    pub fn digits(&self) -> Vec<InertialDigits> {
        let entries: Vec<&WrittenInertial> = self.entries().collect();
        let mut digits = vec![InertialDigits::default(); entries.len()];
        self.add_points(&entries, &mut digits);
        self.add_tensors(&entries, &mut digits);
        let masses: Vec<_> = entries.iter().map(|entry| Some(&entry.mass_kg)).collect();
        self.add(&masses, &mut digits, |of| &mut of.mass_kg);
        let terms: [(WrittenTerm, Place); 3] = [
            (WrittenTerm::Armature, |of| &mut of.armature),
            (WrittenTerm::Damping, |of| &mut of.damping),
            (WrittenTerm::Friction, |of| &mut of.friction),
        ];
        for (term, place) in terms {
            let values: Vec<_> = entries.iter().map(|entry| entry.term(term)).collect();
            let values: Vec<_> = values.iter().map(|[turns, slides]| turns.1.or(slides.1)).collect();
            self.add(&values, &mut digits, place);
        }
        digits
    }

    /// One number of each entry that has it.
    fn add(&self, values: &[Option<&Spanned<f64>>], digits: &mut [InertialDigits], place: Place) {
        let written = || values.iter().enumerate().filter_map(|(entry, value)| Some((entry, (*value)?)));
        let texts: Vec<&str> = written().map(|(_, value)| &self.source().text[value.span()]).collect();
        for ((entry, _), half) in written().zip(half_places_of_values(&texts)) {
            *place(&mut digits[entry]) = half;
        }
    }

    fn add_points(&self, entries: &[&WrittenInertial], digits: &mut [InertialDigits]) {
        let of_entry = |(entry, written): (usize, &&WrittenInertial)| {
            let point = [written.com_m.as_ref(), written.com_mm.as_ref()];
            let numbers = typed_vector(point, &self.source().text).into_iter();
            numbers.map(|(at, number)| ((entry, at), number)).collect::<Vec<_>>()
        };
        let typed = entries.iter().enumerate().flat_map(of_entry).collect();
        for ((entry, at), half) in halves_at(typed, half_places_of_point) {
            digits[entry].com_m[at] = half;
        }
    }

    fn add_tensors(&self, entries: &[&WrittenInertial], digits: &mut [InertialDigits]) {
        let of_entry = |(entry, written): (usize, &&WrittenInertial)| {
            let tensor = written.inertia_kg_m2.as_ref().map(Spanned::get_ref);
            let moments = tensor.into_iter().flat_map(WrittenTensor::entries);
            moments.map(|(_, at, value)| (entry, at, value.span())).collect::<Vec<_>>()
        };
        let typed: Vec<_> = entries.iter().enumerate().flat_map(of_entry).collect();
        let texts: Vec<&str> = typed.iter().map(|(.., span)| &self.source().text[span.clone()]).collect();
        for ((entry, (row, column), _), half) in typed.iter().zip(half_places_of_values(&texts)) {
            digits[*entry].tensor_kg_m2[(*row, *column)] = half;
            digits[*entry].tensor_kg_m2[(*column, *row)] = half;
        }
    }
}
