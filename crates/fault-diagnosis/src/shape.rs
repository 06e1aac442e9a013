//! The least squares fit of a shape over time that begins at one sample and ends at another, which are fitted too.

use super::fit::Window;

/// The term that a fault adds to the readings of an encoder between its beginning and its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ShapeTerm {
    /// A multiple of the series.
    Whole,
    /// A multiple of the series, counted from the value at the beginning.
    FromBegin,
    /// The series itself, counted from the value at the beginning.
    OnceFromBegin,
}

/// A fitted shape with its window and its factor.
#[derive(Debug, Clone, Copy)]
pub(super) struct FittedShape {
    pub(super) window: Window,
    /// Factor that the series is multiplied by.
    pub(super) factor: f64,
    count: ShapeTerm,
}

/// Prefix sums over the samples, so that the fit of any window costs the same few operations.
struct Sums {
    count: ShapeTerm,
    /// Of the number of samples, the error, the series, their product, and the square of the series.
    before: Vec<[f64; 5]>,
}

impl Sums {
    fn new(error: &[f64], series: &[f64], is_used: &[bool], count: ShapeTerm) -> Self {
        let mut sum = [0.0; 5];
        let mut before = Vec::with_capacity(error.len() + 1);
        before.push(sum);
        for ((&error, &series), &is_used) in error.iter().zip(series).zip(is_used) {
            if is_used {
                let terms = [1.0, error, series, error * series, series * series];
                sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            }
            before.push(sum);
        }
        Self { count, before }
    }

    /// The factor of the shape in a window, and by how much it lowers the sum of squares.
    fn fit(&self, series: &[f64], window: Window) -> (f64, f64) {
        let [samples, error, sum, product, square]: [f64; 5] =
            std::array::from_fn(|term| self.before[window.end][term] - self.before[window.first][term]);
        let from = if self.count == ShapeTerm::Whole { 0.0 } else { series[window.first] };
        // Sums of e (s - s0) and of (s - s0)^2, expanded in the prefix sums.
        let product = product - from * error;
        let square = square - 2.0 * from * sum + samples * from * from;
        match self.count {
            // Sum e^2 - sum (e - k s)^2 = 2 k sum(e s) - k^2 sum(s^2): with k = 1, or at the best k = sum(e s) / sum(s^2).
            ShapeTerm::OnceFromBegin => (1.0, 2.0 * product - square),
            _ if square > 0.0 => (product / square, product * product / square),
            _ => (0.0, 0.0),
        }
    }
}

/// The window in which a shape explains most. One that begins later, or does not end, is taken if it explains `negligible` less.
pub(super) fn fit(
    error: &[f64],
    is_used: &[bool],
    series: &[f64],
    count: ShapeTerm,
    negligible: f64,
) -> Option<FittedShape> {
    /// Beginning and end settle in two or three rounds.
    const ROUNDS: usize = 8;
    let samples = error.len();
    let sums = Sums::new(error, series, is_used, count);
    let gain = |first: usize, end: usize| sums.fit(series, Window { first, end }).1;
    let mut window =
        coarse(Window::spanning(samples, |sample| error[sample].powi(2) > negligible), samples, gain);
    for _ in 0..ROUNDS {
        let first = (0..window.end).max_by(|&a, &b| gain(a, window.end).total_cmp(&gain(b, window.end)))?;
        // Begin and end in turn: each is a pass over the samples, both together would be their square.
        let last = (first + 1..=samples).max_by(|&a, &b| gain(first, a).total_cmp(&gain(first, b)))?;
        let lasts = gain(first, samples) >= gain(first, last) - negligible;
        let next = Window { first, end: if lasts { samples } else { last } };
        if std::mem::replace(&mut window, next) == next {
            break;
        }
    }
    if count == ShapeTerm::OnceFromBegin {
        // While the joint rests the term is zero, so that the gain does not depend on the beginning: the latest one is taken,
        // which is when the fault first shows.
        let enough = gain(window.first, window.end) - negligible;
        window.first = (window.first..window.end).rev().find(|&first| gain(first, window.end) >= enough)?;
    }
    Some(FittedShape { window, factor: sums.fit(series, window).0, count })
}

/// The best window of a grid over the samples with a large error, or over the whole run if no error is large by itself. Begin and
/// end are varied together: for an axis that is flipped for a while, the best begin of a window that lasts to the end of the run
/// is not that of the fault.
fn coarse(off: Option<Window>, samples: usize, gain: impl Fn(usize, usize) -> f64) -> Window {
    /// Places of a begin or an end.
    const PLACES: usize = 128;
    let whole = Window { first: 0, end: samples };
    let range = off.unwrap_or(whole);
    let place = |index: usize| range.first + index * range.len() / PLACES;
    let windows = (0..PLACES).flat_map(|first| (first + 1..=PLACES).map(move |end| (first, end)));
    let windows = windows.map(|(first, end)| Window { first: place(first), end: place(end) });
    let better = |best: (Window, f64), window: Window| {
        let gain = gain(window.first, window.end);
        if gain > best.1 { (window, gain) } else { best }
    };
    windows.filter(|window| window.first < window.end).fold((whole, gain(0, samples)), better).0
}

impl FittedShape {
    /// What it adds to the error of a sample.
    pub(super) fn at(&self, series: &[f64], sample: usize) -> f64 {
        if !self.window.samples().contains(&sample) {
            return 0.0;
        }
        let from = if self.count == ShapeTerm::Whole { 0.0 } else { series[self.window.first] };
        self.factor * (series[sample] - from)
    }
}
