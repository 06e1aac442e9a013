//! Several mistakes together, without a fit to begin with: edits of the table, alone and in pairs, and behind each the
//! table that agrees and has the fewest values changed (`fewest_changes/`).

use crate::diagnosis::{
    candidate::{CandidateModel, ModelParameter},
    fewest_changes::{CHANGE, ChangedTable, SameWithin, WantedAxes},
    fit::hypothesis_fit::{HypothesisFit, moved},
    hypothesis::{Cause, FaultPlace, PoseHypothesis},
    thresholds::{MAX_CHANGES, MAX_EDITED, MAX_TABLES},
};

use super::ExplanationSearch;

/// A table that an edit has corrected in part.
struct EditedTable {
    /// The edits.
    hypotheses: Vec<usize>,
    candidate: CandidateModel,
}

/// Edits, and the table with the fewest values changed behind them.
struct EditedAndChanged<'a> {
    edited: &'a EditedTable,
    changed: ChangedTable,
}

/// Hypotheses that correct a table together.
struct Changes {
    hypotheses: Vec<usize>,
    /// The change of each free parameter, to begin a fit with.
    start: Vec<f64>,
    /// How many of the hypotheses are edits of several values.
    edits: usize,
}

impl ExplanationSearch<'_> {
    /// The explanations with the fewest changes of the table, as far as they reach the tolerance.
    pub(super) fn fewest_changes(&self) -> Vec<HypothesisFit> {
        let edited = self.edited_tables();
        let length_m = self.context.evaluation_point.length_m;
        let searches: Vec<WantedAxes> = SameWithin::by_digits(&self.criterion.digits, length_m)
            .into_iter()
            .filter_map(|same| WantedAxes::new(&self.context.models.reference, same))
            .collect();
        for changes in 1..=MAX_CHANGES {
            // All that cost less than one change more.
            let most = (changes + 1) * CHANGE - 1;
            // A mistake that is small for one may have been made up for by more changes: the others decide, too.
            let fits: Vec<HypothesisFit> =
                searches.iter().flat_map(|wanted| self.with_changes(&edited, wanted, most)).collect();
            if !fits.is_empty() {
                return fits;
            }
        }
        Vec::new()
    }

    /// The explanations with changes that cost at most this much.
    fn with_changes(&self, edited: &[EditedTable], wanted: &WantedAxes, most: usize) -> Vec<HypothesisFit> {
        let mut found: Vec<EditedAndChanged<'_>> = Vec::new();
        for edited in edited {
            let of_edits = edited.hypotheses.len() * CHANGE;
            let Some(rest) = most.checked_sub(of_edits) else { continue };
            let tables = wanted.tables(&edited.candidate, rest).into_iter();
            found.extend(tables.map(|table| EditedAndChanged {
                edited,
                changed: ChangedTable { cost: table.cost + of_edits, ..table },
            }));
        }
        found.sort_by_key(|found| found.changed.cost);
        let mut tried: Vec<Vec<usize>> = Vec::new();
        let mut fits: Vec<HypothesisFit> = Vec::new();
        for changes in found.iter().filter_map(|found| self.changes(found, wanted.same)) {
            if tried.len() < MAX_TABLES && !tried.contains(&changes.hypotheses) {
                tried.push(changes.hypotheses.clone());
                fits.extend(self.fitted(changes));
            }
        }
        fits
    }

    /// The table as given, with each edit, and with each edit of the whole table and another one.
    fn edited_tables(&self) -> Vec<EditedTable> {
        let models = self.context.models;
        let hypotheses = self.context.hypotheses;
        let edited = |chosen: &[usize]| {
            let mut edited = models.clone();
            for &at in chosen {
                hypotheses[at].apply(&mut edited);
            }
            let is_new = edited.candidate != models.candidate && edited.reference == models.reference;
            is_new.then(|| EditedTable { hypotheses: chosen.to_vec(), candidate: edited.candidate })
        };
        let edits: Vec<usize> = (0..hypotheses.len())
            .filter(|&at| is_edit_of_table(&hypotheses[at]) && edited(&[at]).is_some())
            .collect();
        let given = EditedTable { hypotheses: Vec::new(), candidate: models.candidate.clone() };
        let mut tables: Vec<EditedTable> =
            [given].into_iter().chain(edits.iter().filter_map(|&at| edited(&[at]))).collect();
        // The number of pairs is the square of that of the rows.
        if models.candidate.rows.len() > MAX_EDITED {
            return tables;
        }
        let whole = edits.iter().filter(|&&at| self.is_of_table(at));
        for &first in whole {
            let others = edits.iter().filter(|&&at| at != first && (at > first || !self.is_of_table(at)));
            tables.extend(others.filter_map(|&second| edited(&[first, second])));
        }
        tables
    }

    /// The hypotheses of edits and changed values; `None` if there is none of some value.
    fn changes(&self, found: &EditedAndChanged<'_>, same: SameWithin) -> Option<Changes> {
        let EditedAndChanged { edited, changed: ChangedTable { candidate, .. } } = found;
        let mut hypotheses = edited.hypotheses.clone();
        let kept = hypotheses.len();
        let mut changes: Vec<f64> = Vec::new();
        for (row, (from, to)) in edited.candidate.rows.iter().zip(&candidate.rows).enumerate() {
            if from.rate * to.rate < 0.0 {
                let place = FaultPlace::Rows(vec![row]);
                let is_flip = |it: &PoseHypothesis| it.cause == Cause::AxisFlipped && it.place == place;
                hypotheses.push(self.context.hypotheses.iter().position(is_flip)?);
            }
        }
        let mut known: Vec<ModelParameter> = Vec::new();
        for (at, hypothesis) in self.context.hypotheses.iter().enumerate() {
            let (true, &[parameter]) = (hypothesis.is_single_value(), &hypothesis.free[..]) else { continue };
            let by = moved(&edited.candidate, candidate, parameter);
            if by == 0.0 || known.contains(&parameter) {
                continue;
            }
            known.push(parameter);
            if let Some(edit) = self.edit_to(parameter, edited, candidate, same) {
                hypotheses.push(edit);
            } else {
                hypotheses.push(at);
                changes.push(by);
            }
        }
        Some(Changes { hypotheses, start: changes, edits: kept })
    }

    /// The fit of changes, if it reaches the tolerance.
    fn fitted(&self, Changes { hypotheses, start, edits }: Changes) -> Option<HypothesisFit> {
        let fit = self.context.fit(hypotheses, &[start]);
        self.accepts(&fit).then(|| self.pruned(fit, edits))
    }

    /// The edit of one value, of its sign or its unit, that gives the changed value.
    fn edit_to(
        &self,
        parameter: ModelParameter,
        edited: &EditedTable,
        changed: &CandidateModel,
        same: SameWithin,
    ) -> Option<usize> {
        let ModelParameter::Row(row, entry) = parameter else { return None };
        // Anything small is almost zero in a smaller unit.
        if changed.entry(row, entry).is_some_and(|value| same.is_same(entry, 0.0, value)) {
            return None;
        }
        let place = FaultPlace::Entries(entry, vec![row]);
        let gives_it = |hypothesis: &PoseHypothesis| {
            let mut models = self.context.models.clone();
            models.candidate = edited.candidate.clone();
            hypothesis.apply(&mut models);
            let values = models.candidate.entry(row, entry).zip(changed.entry(row, entry));
            values.is_some_and(|(edited, changed)| same.is_same(entry, edited, changed))
        };
        let is_edit = |it: &&PoseHypothesis| it.free.is_empty() && it.edit.is_some() && it.place == place;
        let mut edits = self.context.hypotheses.iter().enumerate().filter(|(_, it)| is_edit(it));
        edits.find(|(_, hypothesis)| gives_it(hypothesis)).map(|(at, _)| at)
    }
}

/// Whether a hypothesis is an edit of several values of the table. Those of one value, and of one joint's direction, are
/// among the changes.
fn is_edit_of_table(hypothesis: &PoseHypothesis) -> bool {
    let is_single = matches!(&hypothesis.place, FaultPlace::Entries(_, rows) if rows.len() == 1);
    let is_of_motion = hypothesis.cause == Cause::AxisFlipped
        || (hypothesis.cause.is_unit() && matches!(hypothesis.place, FaultPlace::Rows(_)));
    hypothesis.edit.is_some() && hypothesis.free.is_empty() && !is_single && !is_of_motion
}
