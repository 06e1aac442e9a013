//! Contact between links and with obstacles: which pair, from when to when, and how deep. Meshes are replaced by their convex
//! hulls; the depth is the smallest translation that would separate two hulls.

use congruent_input::{Quantity, SiUnit};
use congruent_proximity::{Clearance, PairNames};
use congruent_scenario::ContactCheck;

use super::clearance::notes_on;
use crate::{
    CheckContext, Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::{Bound, Contact},
    watch::Watch,
};

/// Most contacts that are listed: a chattering pair has a new one every few samples.
const MOST_CONTACTS: usize = 200;

pub(crate) struct ContactMonitor {
    names: PairNames,
    /// The distance, negative for an overlap.
    distance: Watch,
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
    touch: TouchNow,
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
}

impl ContactMonitor {
    pub(crate) fn new(check: &ContactCheck, context: &CheckContext<'_>) -> Self {
        let (bound, limit_m) = match check.unit_keys().value() {
            None => (Bound::Above, 0.0),
            Some(depth_m) => (Bound::AtLeast, -depth_m),
        };
        Self {
            names: PairNames { pairs: check.pairs.clone(), ignore: check.ignore.clone() },
            distance: Watch::new(Quantity::Distance, SiUnit::Metre, bound, limit_m, context.dof()),
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
        self.pairs = chosen.map(|pair| EvaluatedPair { pair, touch: TouchNow::None }).collect();
    }

    /// Begins or continues the contact of a pair.
    fn touches(&mut self, at: usize, depth_m: f64, time_s: f64) {
        let EvaluatedPair { pair, touch } = &mut self.pairs[at];
        match *touch {
            TouchNow::Unlisted => {}
            TouchNow::Listed(number) => {
                let contact = &mut self.contacts[number];
                contact.until_s = time_s;
                contact.depth_m = contact.depth_m.max(depth_m);
            }
            TouchNow::None if self.contacts.len() == MOST_CONTACTS => {
                *touch = TouchNow::Unlisted;
                self.more_contacts += 1;
            }
            TouchNow::None => {
                *touch = TouchNow::Listed(self.contacts.len());
                self.contacts.push(Touch { pair: *pair, from_s: time_s, until_s: time_s, depth_m });
            }
        }
    }
}

impl Monitor for ContactMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if self.samples == 0 {
            self.choose(sample.clearance);
        }
        self.samples += 1;
        let pairs = &self.pairs;
        let pushed = sample.kept_apart(|pair| pairs.iter().any(|looked_at| looked_at.pair == pair));
        // A pair farther than the nearest so far does not change the worst value; a touching pair always counts, hence the
        // threshold above 0.
        let mut threshold_m =
            self.distance.worst().map_or(f64::INFINITY, |worst_m| worst_m.max(f64::MIN_POSITIVE));
        for at in 0..self.pairs.len() {
            let pair = self.pairs[at].pair;
            if pushed == Some(pair) {
                // The solver keeps the two apart just before their hulls meet: contact of depth 0, although a distance of up
                // to some millimetres would be measured.
                self.distance.observe(0.0, pair, sample);
                self.touches(at, 0.0, sample.time_s);
                continue;
            }
            let Some(distance_m) = sample.clearance.measure_below(pair, threshold_m) else {
                self.pairs[at].touch = TouchNow::None;
                continue;
            };
            // The depth is costly, and only shapes that overlap have one.
            let signed_m = if distance_m > 0.0 { distance_m } else { sample.clearance.measure_signed(pair) };
            self.distance.observe(signed_m, pair, sample);
            threshold_m = threshold_m.min(distance_m.max(f64::MIN_POSITIVE));
            if distance_m > 0.0 {
                self.pairs[at].touch = TouchNow::None;
            } else {
                self.touches(at, -signed_m, sample.time_s);
            }
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let contact = |touch: &Touch| Contact {
            pair: self.measured[touch.pair].clone(),
            from_s: touch.from_s,
            until_s: touch.until_s,
            // -0.0 would print as a negative depth.
            depth_m: touch.depth_m.max(0.0),
        };
        let mut notes = notes_on(&self.names, &self.measured);
        if self.more_contacts > 0 {
            notes.push(format!("{} further contacts are not listed", self.more_contacts));
        }
        Observed {
            samples: self.samples,
            measures: vec![self.distance.measure(&names.joints, |pair| names.pairs[pair].clone())],
            contacts: self.contacts.iter().map(contact).collect(),
            notes,
            ..Observed::default()
        }
    }

    fn has_failed(&self) -> bool {
        self.distance.is_violated()
    }
}
