//! Contact between links and with obstacles: which pair, from when to when, how deep, and with which force. Meshes are replaced by
//! their convex hulls; the depth is the smallest translation that would separate two hulls.

use congruent_input::{Quantity, SiUnit, display::length};
use congruent_proximity::{Clearance, Pair, PairNames};
use congruent_scenario::ContactCheck;

use super::{
    clearance::notes_on,
    unforced::{PairOverlap, UnforcedOverlap},
};
use crate::{
    CheckContext, Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::{Bound, Contact, ContactLoad},
    watch::Watch,
};

/// Most contacts that are listed: a chattering pair has a new one every few samples.
const MOST_CONTACTS: usize = 200;

pub(crate) struct ContactMonitor {
    names: PairNames,
    /// The distance, negative for an overlap.
    distance: Watch,
    /// The normal force, if it has a limit.
    force: Option<Watch>,
    /// The distance of pairs that overlap without a force, of which a limit of the force says nothing.
    unforced: Watch,
    /// Whether a link may touch an obstacle: a force is limited, and no depth.
    may_touch: bool,
    step_s: f64,
    /// The names of the pairs that are measured, from the first sample on: only then they are known.
    measured: Vec<[String; 2]>,
    /// The pairs that the check evaluates.
    pairs: Vec<EvaluatedPair>,
    contacts: Vec<Touch>,
    more_contacts: u64,
    samples: u64,
}

/// A pair, and whether it touches now.
struct EvaluatedPair {
    pair: usize,
    subjects: Pair,
    touch: TouchNow,
    unforced: UnforcedOverlap,
}

#[derive(Clone, Copy)]
enum TouchNow {
    None,
    /// With its number in the list of contacts.
    Listed(usize),
    /// The list was full.
    Unlisted,
}

/// A contact of a pair.
struct Touch {
    pair: usize,
    from_s: f64,
    until_s: f64,
    depth_m: f64,
    force: Option<ContactLoad>,
}

impl Touch {
    /// Counts the force of one step.
    fn push(&mut self, force_n: Option<f64>, time_s: f64, step_s: f64) {
        let Some(force_n) = force_n else { return };
        let none = ContactLoad { peak_n: 0.0, peak_s: time_s, impulse_n_s: 0.0 };
        let load = self.force.get_or_insert(none);
        if force_n > load.peak_n {
            (load.peak_n, load.peak_s) = (force_n, time_s);
        }
        load.impulse_n_s += force_n * step_s;
    }
}

impl ContactMonitor {
    pub(crate) fn new(check: &ContactCheck, context: &CheckContext<'_>) -> Self {
        let (bound, limit_m) = match check.unit_keys().value() {
            None => (Bound::Above, 0.0),
            Some(depth_m) => (Bound::AtLeast, -depth_m),
        };
        let newtons = |limit_n: f64| {
            Watch::new(Quantity::ContactForce, SiUnit::Newton, Bound::AtMost, limit_n, context.dof())
        };
        Self {
            force: check.force_n.map(newtons),
            may_touch: check.force_n.is_some() && check.limit_m().is_none(),
            step_s: context.clock.step_s,
            names: PairNames { pairs: check.pairs.clone(), ignore: check.ignore.clone() },
            distance: Watch::new(Quantity::Distance, SiUnit::Metre, bound, limit_m, context.dof()),
            unforced: Watch::new(Quantity::Distance, SiUnit::Metre, Bound::Above, 0.0, context.dof()),
            measured: Vec::new(),
            pairs: Vec::new(),
            contacts: Vec::with_capacity(MOST_CONTACTS),
            more_contacts: 0,
            samples: 0,
        }
    }

    fn choose(&mut self, clearance: &Clearance) {
        let all = 0..clearance.pairs().len();
        self.measured = all.clone().map(|pair| clearance.names(pair).map(str::to_owned)).collect();
        let chosen = all.filter(|&pair| self.names.is_evaluated(clearance.names(pair)));
        let subjects: Vec<Pair> = clearance.pairs().collect();
        let evaluated = |pair| EvaluatedPair {
            pair,
            subjects: subjects[pair],
            touch: TouchNow::None,
            unforced: UnforcedOverlap::default(),
        };
        self.pairs = chosen.map(evaluated).collect();
    }

    /// Begins or continues the contact of a pair.
    fn touches(&mut self, at: usize, depth_m: f64, sample: &Sample<'_>) {
        self.look_for_force(at, depth_m, sample);
        let EvaluatedPair { pair, subjects, touch, .. } = &mut self.pairs[at];
        let (time_s, force_n) = (sample.time_s, sample.contact_force_n(*subjects));
        match *touch {
            TouchNow::Unlisted => {}
            TouchNow::Listed(number) => {
                let contact = &mut self.contacts[number];
                contact.until_s = time_s;
                contact.depth_m = contact.depth_m.max(depth_m);
                contact.push(force_n, time_s, self.step_s);
            }
            TouchNow::None if self.contacts.len() == MOST_CONTACTS => {
                *touch = TouchNow::Unlisted;
                self.more_contacts += 1;
            }
            TouchNow::None => {
                *touch = TouchNow::Listed(self.contacts.len());
                let mut contact =
                    Touch { pair: *pair, from_s: time_s, until_s: time_s, depth_m, force: None };
                contact.push(force_n, time_s, self.step_s);
                self.contacts.push(contact);
            }
        }
    }

    /// A pair that overlaps without a force cannot be within a limit of the force.
    fn look_for_force(&mut self, at: usize, depth_m: f64, sample: &Sample<'_>) {
        let EvaluatedPair { pair, subjects, unforced, .. } = &mut self.pairs[at];
        if self.force.is_none() || subjects.b < sample.twin.len() || !sample.knows_contact_forces() {
            return;
        }
        // A body that a link carries has no force at all: it touches nothing in the physics.
        let force_n = sample.contact_force_n(*subjects).unwrap_or(0.0);
        if let Some(depth_m) = unforced.take(PairOverlap { depth_m, force_n, is_last: sample.is_last }) {
            self.unforced.observe(-depth_m, *pair, sample);
        }
    }

    /// Ends the contact of a pair, if it touched.
    fn ends_contact(&mut self, at: usize, sample: &Sample<'_>) {
        let EvaluatedPair { pair, touch, unforced, .. } = &mut self.pairs[at];
        if let Some(depth_m) = unforced.end() {
            self.unforced.observe(-depth_m, *pair, sample);
        }
        *touch = TouchNow::None;
    }

    /// Compares the forces of this instant with their limit.
    fn observe_forces(&mut self, sample: &Sample<'_>) {
        let Some(watch) = &mut self.force else { return };
        for evaluated in &self.pairs {
            if let Some(force_n) = sample.contact_force_n(evaluated.subjects) {
                watch.observe(force_n, evaluated.pair, sample);
            }
        }
    }

    /// Distance and force; no distance if all pairs may touch.
    fn measured_quantities(&self) -> impl Iterator<Item = &Watch> {
        let distance = Some(&self.distance).filter(|watch| !self.may_touch || watch.worst().is_some());
        let unforced = Some(&self.unforced).filter(|watch| watch.worst().is_some());
        // A force of 0 N beside an overlap without a force would read as a value.
        let has_force = |watch: &&Watch| unforced.is_none() || watch.worst() > Some(0.0);
        let force = self.force.as_ref().filter(has_force);
        unforced.into_iter().chain(distance).chain(force)
    }

    /// The pairs that overlap without a force, with the deepest overlap.
    fn note_on_unforced(&self, names: &Names) -> Option<String> {
        let deepest = |pair: &EvaluatedPair| {
            let depth_m = pair.unforced.deepest_m()?;
            Some(format!("{}, {} deep", names.pairs[pair.pair], length(depth_m)))
        };
        let pairs: Vec<String> = self.pairs.iter().filter_map(deepest).collect();
        (!pairs.is_empty()).then(|| {
            format!(
                "the physics has no force for this overlap ({}): a link yields to a push only where its joints let it, a fixed link \
                 and a carried body never, and what is inside another body at once is not pushed out. `force_n` cannot be judged",
                pairs.join(", ")
            )
        })
    }

    /// Compares the distance of a pair with its limit, if it may not simply touch.
    fn observe_distance(&mut self, at: usize, distance_m: f64, sample: &Sample<'_>) {
        let EvaluatedPair { pair, subjects, .. } = self.pairs[at];
        let is_obstacle = subjects.b >= sample.twin.len();
        if !(self.may_touch && is_obstacle) {
            self.distance.observe(distance_m, pair, sample);
        }
    }
}

impl Monitor for ContactMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if self.samples == 0 {
            self.choose(sample.clearance);
        }
        self.samples += 1;
        self.observe_forces(sample);
        let pairs = &self.pairs;
        let pushed = sample.kept_apart(|pair| pairs.iter().any(|looked_at| looked_at.pair == pair));
        // A pair farther than the nearest so far does not change the worst value; a touching pair always counts, hence the
        // threshold above 0.
        let mut threshold_m =
            self.distance.worst().map_or(f64::INFINITY, |worst_m| worst_m.max(f64::MIN_POSITIVE));
        for at in 0..self.pairs.len() {
            let EvaluatedPair { pair, subjects, .. } = self.pairs[at];
            let acts = sample.contact_force_n(subjects).is_some_and(|force_n| force_n > 0.0);
            if pushed == Some(pair) || (acts && sample.clearance.measure(pair) > 0.0) {
                // The solver keeps the two apart just before their hulls meet: contact of depth 0, although a distance of up
                // to some millimetres would be measured.
                self.observe_distance(at, 0.0, sample);
                self.touches(at, 0.0, sample);
                continue;
            }
            let Some(distance_m) = sample.clearance.measure_below(pair, threshold_m) else {
                self.ends_contact(at, sample);
                continue;
            };
            // The depth is costly, and only shapes that overlap have one.
            let signed_m = if distance_m > 0.0 { distance_m } else { sample.clearance.measure_signed(pair) };
            self.observe_distance(at, signed_m, sample);
            threshold_m = threshold_m.min(distance_m.max(f64::MIN_POSITIVE));
            if distance_m > 0.0 {
                self.ends_contact(at, sample);
            } else {
                self.touches(at, -signed_m, sample);
            }
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let is_unforced = |pair: usize| {
            self.pairs.iter().any(|known| known.pair == pair && known.unforced.deepest_m().is_some())
        };
        let contact = |touch: &Touch| Contact {
            pair: self.measured[touch.pair].clone(),
            from_s: touch.from_s,
            until_s: touch.until_s,
            // -0.0 would print as a negative depth.
            depth_m: touch.depth_m.max(0.0),
            // A force that the physics does not have is not one of 0 N.
            force: touch.force.filter(|load| load.peak_n > 0.0 || !is_unforced(touch.pair)),
        };
        let name = |pair: usize| names.pairs[pair].clone();
        let mut notes: Vec<String> = self.note_on_unforced(names).into_iter().collect();
        notes.extend(notes_on(&self.names, &self.measured));
        if self.more_contacts > 0 {
            notes.push(format!("{} further contacts are not listed", self.more_contacts));
        }
        Observed {
            samples: self.samples,
            measures: self.measured_quantities().map(|watch| watch.measure(&names.joints, name)).collect(),
            contacts: self.contacts.iter().map(contact).collect(),
            notes,
            ..Observed::default()
        }
    }

    fn has_failed(&self) -> bool {
        self.measured_quantities().any(Watch::is_violated)
    }
}
