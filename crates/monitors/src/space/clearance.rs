//! Distance between links and to obstacles: never below a minimum. Every pair that comes below it is reported, not
//! only the nearest.

use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, Quantity, SiUnit};
use congruent_proximity::{Clearance, Nearest, ObstacleMobility, PairChoice, PairNames, measured_pairs};
use congruent_scenario::{ClearanceCheck, FilePlace, ObstacleSettings};

use crate::{
    Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::Bound,
    watch::Watch,
};

use super::nearest_that_changes::NearestThatChanges;

const BOUND: Bound = Bound::AtLeast;

pub(crate) struct ClearanceMonitor {
    names: PairNames,
    minimum_m: f64,
    /// The smallest distance of all.
    distance: Watch,
    /// The names of the pairs that are measured, from the first sample on: only then they are known.
    measured: Vec<[String; 2]>,
    /// The pairs that the check evaluates.
    pairs: Vec<EvaluatedPair>,
    /// For each measured pair its index among the evaluated ones.
    places: Vec<Option<usize>>,
    /// Pairs below the threshold at the present sample.
    found: Vec<Nearest>,
    /// The nearest of the pairs that change.
    changing: NearestThatChanges,
    samples: u64,
}

/// A pair with its distances below the minimum.
struct EvaluatedPair {
    pair: usize,
    below: Watch,
}

/// Whether a check has a distance, and one that something can come below.
pub(crate) fn examine_minimum(check: &ClearanceCheck, place: FilePlace<'_>) -> Result<(), Diagnostic> {
    let minimum = check.unit_keys();
    minimum.required(place)?;
    if minimum.value() != Some(0.0) {
        return Ok(());
    }
    let key = minimum.written_key();
    let message = format!("`{key}` = 0 is never violated: overlapping shapes have the distance 0");
    let error = Diagnostic::error(congruent_scenario::codes::scenario::NO_LIMIT, message);
    Err(place.key(key).mark(
        error.with_help("give a distance above 0, or `kind = \"contact\"`, which fails if shapes touch"),
    ))
}

/// Whether the pairs that a check names are those of the robot and of its obstacles.
pub(crate) fn examine_pairs(
    names: &PairNames,
    place: FilePlace<'_>,
    description: &RobotDescription,
    obstacles: &[ObstacleSettings],
    mobility: &[ObstacleMobility],
) -> Result<(), Diagnostic> {
    let links = description.robot.links().iter().map(|link| link.name.as_str());
    let subjects: Vec<&str> = links.chain(obstacles.iter().map(|obstacle| obstacle.name.as_str())).collect();
    let all = measured_pairs(description, mobility, PairChoice::Usual);
    let measured: Vec<[&str; 2]> = all.iter().map(|pair| [subjects[pair.a], subjects[pair.b]]).collect();
    let refused = names.examine(&subjects, &measured);
    refused.map_err(|fault| place.key(fault.key).item(fault.entry).mark(fault.diagnostic))
}

impl ClearanceMonitor {
    /// # Panics
    /// For a check that [`examine`] rejects, or without a distance.
    pub(crate) fn new(check: &ClearanceCheck, description: &RobotDescription) -> Self {
        let minimum_m = check.unit_keys().value().expect("a setup examines its checks");
        let distance = watch(minimum_m, description.robot.dof());
        Self {
            names: PairNames { pairs: check.pairs.clone(), ignore: check.ignore.clone() },
            minimum_m,
            distance,
            measured: Vec::new(),
            pairs: Vec::new(),
            places: Vec::new(),
            found: Vec::new(),
            changing: NearestThatChanges::new(watch(minimum_m, description.robot.dof())),
            samples: 0,
        }
    }

    /// Makes room for every pair, so that no sample after the first allocates.
    fn choose(&mut self, clearance: &Clearance, dof: usize) {
        let all = 0..clearance.pairs().len();
        self.measured = all.clone().map(|pair| clearance.names(pair).map(str::to_owned)).collect();
        let pairs = all.filter(|&pair| self.names.is_evaluated(clearance.names(pair)));
        self.pairs = pairs.map(|pair| EvaluatedPair { pair, below: watch(self.minimum_m, dof) }).collect();
        self.places = vec![None; self.measured.len()];
        self.found.reserve(self.pairs.len());
        for (place, EvaluatedPair { pair, .. }) in self.pairs.iter().enumerate() {
            self.places[*pair] = Some(place);
        }
    }

    /// The nearest pair at the first sample: from then on only smaller distances count.
    fn begin(&mut self, sample: &mut Sample<'_>) {
        self.choose(sample.clearance, sample.joints.state().q.len());
        let places = &self.places;
        // Once with an infinite threshold: a run in which all pairs stay far apart has a least distance, too.
        let nearest = sample.clearance.nearest_of(f64::INFINITY, |pair, _| places[pair].is_some());
        if let Some(Nearest { distance_m, pair }) = nearest {
            self.distance.observe(distance_m, pair, sample);
        }
        self.changing.begin(self.pairs.iter().map(|evaluated| evaluated.pair), sample);
    }

    /// Only a smaller distance than this changes the report: touching is reported although no distance is below
    /// zero.
    fn threshold_m(&self) -> f64 {
        // As long as nothing is violated, only what is nearer than the nearest so far changes the result. Then every
        // pair below the limit gets an own measure.
        let worst_m = self.distance.worst().unwrap_or(f64::INFINITY);
        if self.distance.is_violated() { self.minimum_m } else { worst_m.max(self.minimum_m) }
    }
}

/// Remarks on pairs that are ignored or chosen by name.
pub(super) fn notes_on(names: &PairNames, measured: &[[String; 2]]) -> Vec<String> {
    let all: Vec<[&str; 2]> = measured.iter().map(|pair| pair.each_ref().map(String::as_str)).collect();
    let listed = |chosen: &dyn Fn([&str; 2]) -> bool| {
        let chosen = all.iter().filter(|&&pair| chosen(pair));
        chosen.map(|pair| pair.join("--")).collect::<Vec<_>>().join(", ")
    };
    let mut notes = Vec::new();
    if all.is_empty() {
        notes.push(
            "no pair to check: all pairs are on neighbouring bodies or disabled by the SRDF".to_owned(),
        );
    }
    if !names.pairs.is_empty() {
        notes.push(format!("only these pairs are checked: {}", listed(&|pair| names.is_evaluated(pair))));
    }
    let ignored = listed(&|pair| names.is_ignored(pair));
    if !ignored.is_empty() {
        notes.push(format!("ignored, as the scenario says: {ignored}"));
    }
    for [a, b] in names.without_effect(all.iter().copied()) {
        notes.push(format!("`ignore` of {a}--{b} has no effect: the pair is never measured"));
    }
    notes
}

fn watch(minimum_m: f64, dof: usize) -> Watch {
    Watch::new(Quantity::Distance, SiUnit::Metre, BOUND, minimum_m, dof)
}

impl Monitor for ClearanceMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if self.samples == 0 {
            self.begin(sample);
        }
        self.samples += 1;
        let (threshold_m, is_violated) = (self.threshold_m(), self.distance.is_violated());
        let limit_m = |pair: usize| {
            let Some(place) = self.places[pair] else { return f64::NEG_INFINITY };
            let worst_m = self.pairs[place].below.worst();
            // After a violation a pair matters only if it becomes worse than its own worst.
            worst_m.filter(|_| is_violated).unwrap_or(threshold_m)
        };
        self.found.clear();
        let found = &mut self.found;
        sample.clearance.below(threshold_m, limit_m, |pair, distance_m| {
            found.push(Nearest { distance_m, pair });
        });
        for &Nearest { distance_m, pair } in &self.found {
            if let Some(place) = self.places[pair].filter(|_| !BOUND.holds(distance_m, self.minimum_m)) {
                self.pairs[place].below.observe(distance_m, pair, sample);
            }
        }
        // Of pairs at the same distance the first counts, so that the reported name does not depend on the search.
        let by_distance = |a: &&Nearest, b: &&Nearest| a.distance_m.total_cmp(&b.distance_m);
        if let Some(nearest) = self.found.iter().min_by(by_distance) {
            self.distance.observe(nearest.distance_m, nearest.pair, sample);
        }
        self.changing.observe(self.distance.worst_subject(), sample);
    }

    /// The smallest distance, and then that of each further pair below the minimum.
    fn finish(&self, names: &Names) -> Observed {
        let nearest = self.distance.worst_subject();
        let further = self.pairs.iter().filter(|looked_at| Some(looked_at.pair) != nearest);
        let mut below: Vec<(f64, &Watch)> =
            further.filter_map(|EvaluatedPair { below, .. }| Some((below.worst()?, below))).collect();
        below.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let watches = std::iter::once(&self.distance).chain(below.into_iter().map(|(_, watch)| watch));
        let measures =
            watches.map(|watch| watch.measure(&names.joints, |pair| names.pairs[pair].clone())).collect();
        let name = |pair: usize| names.pairs[pair].clone();
        let changing = self.changing.moment(nearest, &names.joints, name);
        Observed {
            samples: self.samples,
            measures,
            nearest_that_changes: changing.filter(|_| !self.has_failed()),
            notes: notes_on(&self.names, &self.measured),
            ..Observed::default()
        }
    }

    fn has_failed(&self) -> bool {
        self.distance.is_violated()
    }
}
