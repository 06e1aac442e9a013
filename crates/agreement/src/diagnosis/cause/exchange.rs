//! `parameters_exchanged`: `a` and `d` of a row, or `alpha` of neighbouring rows, stand in each
//! other's place.

use crate::diagnosis::{
    hypothesis::{Case, Cause, Hypothesis, Place},
    suspect::{Entry, Suspect},
};

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let suspect = &case.suspect;
    let rows = suspect.rows.len();
    let lengths = (0..rows)
        .filter(|&row| suspect.entry(row, Entry::A).is_some())
        .map(|row| exchanged(Place::Rows(vec![row]), (row, Entry::A), (row, Entry::D)));
    let twists = (1..rows).filter(|&row| suspect.entry(row, Entry::Alpha).is_some()).map(|row| {
        let place = Place::Entries(Entry::Alpha, vec![row - 1, row]);
        exchanged(place, (row - 1, Entry::Alpha), (row, Entry::Alpha))
    });
    lengths.chain(twists).collect()
}

fn exchanged(place: Place, first: (usize, Entry), second: (usize, Entry)) -> Hypothesis {
    Hypothesis::edit(Cause::ParametersExchanged, place, move |case: &mut Case| {
        swap(&mut case.suspect, first, second);
    })
}

fn swap(suspect: &mut Suspect, first: (usize, Entry), second: (usize, Entry)) {
    let (Some(at_first), Some(at_second)) =
        (suspect.entry(first.0, first.1), suspect.entry(second.0, second.1))
    else {
        return;
    };
    for ((row, entry), value) in [(first, at_second), (second, at_first)] {
        if let Some(place) = suspect.entry_mut(row, entry) {
            *place = value;
        }
    }
}
