//! A point of the tool that is at one place whenever the arm is at rest, such as a ball in a hole: how far its places are apart by the model.

use congruent_input::{Quantity, SiUnit, display::counted};
use congruent_scenario::SamePointCheck;
use nalgebra::{Isometry3, Vector3};

use crate::{
    CheckContext, Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::Bound,
    watch::Watch,
};

/// Default limit, m. Kind: as of poses of a nominal model.
pub(crate) const SPREAD_M: f64 = 2e-3;
/// Shortest stand, s. Kind: choice.
const STILL_S: f64 = 0.5;
/// An arm is at rest if no joint moves by more in that time, rad or m. Kind: choice; some steps of a coarse encoder.
const AT_REST: f64 = 1e-3;
/// Places that are kept. Kind: bound of memory.
const MOST_PLACES: usize = 10_000;

pub(crate) struct SamePointMonitor {
    tip: usize,
    tip_from_tcp: Isometry3<f64>,
    still_s: f64,
    spread: Watch,
    stand: Option<Stand>,
    places_m: Vec<Vector3<f64>>,
}

/// The arm at one configuration.
struct Stand {
    from_s: f64,
    q: Vec<f64>,
    /// Sum of the positions of the TCP, and their number.
    sum_m: Vector3<f64>,
    count: f64,
    until_s: f64,
}

impl SamePointMonitor {
    pub(crate) fn new(check: &SamePointCheck, context: &CheckContext<'_>) -> Self {
        let limit = check.limit_m().unwrap_or(SPREAD_M);
        Self {
            tip: context.description.tip.get(),
            tip_from_tcp: context.description.tip_from_tcp.unwrap_or_else(Isometry3::identity),
            still_s: check.still_s.unwrap_or(STILL_S),
            spread: Watch::new(Quantity::PointSpread, SiUnit::Metre, Bound::AtMost, limit, context.dof()),
            stand: None,
            places_m: Vec::new(),
        }
    }

    /// Keeps the place of a stand that was long enough.
    fn end_stand(&mut self) {
        let long_enough = |stand: &Stand| stand.until_s - stand.from_s >= self.still_s;
        if let Some(stand) = self.stand.take().filter(long_enough)
            && self.places_m.len() < MOST_PLACES
        {
            self.places_m.push(stand.sum_m / stand.count);
        }
    }
}

impl Monitor for SamePointMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        let q = sample.joints.measured.q;
        let tcp_m = (sample.model[self.tip].to_isometry() * self.tip_from_tcp).translation.vector;
        let moves =
            |stand: &Stand| stand.q.iter().zip(q.iter()).any(|(before, now)| (now - before).abs() > AT_REST);
        if sample.since_s.is_none() || self.stand.as_ref().is_some_and(moves) {
            self.end_stand();
        }
        let stand = self.stand.get_or_insert_with(|| Stand {
            from_s: sample.time_s,
            q: q.to_vec(),
            sum_m: Vector3::zeros(),
            count: 0.0,
            until_s: sample.time_s,
        });
        stand.sum_m += tcp_m;
        stand.count += 1.0;
        stand.until_s = sample.time_s;
        if sample.is_last {
            self.end(sample);
        }
    }

    fn end(&mut self, sample: &Sample<'_>) {
        self.end_stand();
        if self.places_m.len() < 2 {
            return;
        }
        #[expect(clippy::cast_precision_loss, reason = "there are few places")]
        let mean_m = self.places_m.iter().sum::<Vector3<f64>>() / self.places_m.len() as f64;
        let farthest_m = self.places_m.iter().map(|place_m| (place_m - mean_m).norm()).fold(0.0, f64::max);
        self.spread.observe(farthest_m, 0, sample);
    }

    fn finish(&self, names: &Names) -> Observed {
        let places = self.places_m.len();
        let note = format!("the arm stood {} for {} s or longer", counted(places, "time"), self.still_s);
        Observed {
            samples: if places < 2 { 0 } else { places as u64 },
            measures: vec![self.spread.measure(&names.joints, |_| "the TCP".to_owned())],
            notes: vec![note],
            ..Observed::default()
        }
    }

    fn has_failed(&self) -> bool {
        self.spread.is_violated()
    }
}
