//! Degrees and millimetres become radians and metres here and nowhere else.

use std::ops::Range;

use toml::Spanned;

use crate::{diagnostic::Diagnostic, written_figure::fitted_in};

/// A figure that a file may give in the unit of the program or in a handier one.
#[derive(Debug, Clone, Copy)]
pub enum Unit {
    /// Keys end in `_m` or `_mm`; the value is in metres.
    Length,
    /// Keys end in `_rad` or `_deg`; the value is in radians.
    Angle,
}

/// Which of the two keys of a figure is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Metres, radians.
    Plain,
    /// Millimetres, degrees.
    Handy,
}

impl Scale {
    /// That of a figure by its two keys; of one that is not written what others have.
    pub(crate) fn of<T>(plain: Option<&T>, handy: Option<&T>, others: Self) -> Self {
        match (plain, handy) {
            (_, Some(_)) => Self::Handy,
            (Some(_), None) => Self::Plain,
            (None, None) => others,
        }
    }
}

impl Unit {
    /// The keys that may give `quantity`: in the unit of the program, then in the handier one.
    pub fn keys(self, quantity: &str) -> [String; 2] {
        let suffixes = match self {
            Self::Length => ["m", "mm"],
            Self::Angle => ["rad", "deg"],
        };
        suffixes.map(|suffix| format!("{quantity}_{suffix}"))
    }

    /// A figure in the handier unit (mm, deg) in the unit of the program (m, rad).
    pub fn convert(self, figure: f64) -> f64 {
        match self {
            // 1000 is exact in binary and 0.001 is not: dividing rounds once.
            Self::Length => figure / 1000.0,
            Self::Angle => figure.to_radians(),
        }
    }

    /// A fitted value (m, rad) as it is written: in the unit of the program, or in the handier one.
    pub fn fitted(self, value: f64, scale: Scale) -> String {
        match (scale, self) {
            (Scale::Plain, _) => fitted_in(value, 1.0),
            (Scale::Handy, Self::Length) => fitted_in(value * 1000.0, 1000.0),
            (Scale::Handy, Self::Angle) => fitted_in(value.to_degrees(), 1_f64.to_degrees()),
        }
    }

    /// A fitted vector under the key that says its unit.
    pub(crate) fn fitted_vector(self, quantity: &str, values: [f64; 3], scale: Scale) -> String {
        let [plain_key, handy_key] = self.keys(quantity);
        let key = if scale == Scale::Handy { handy_key } else { plain_key };
        format!("{key} = [{}]", values.map(|value| self.fitted(value, scale)).join(", "))
    }

    /// The value of `quantity` from its two keys, of which at most one may be given.
    ///
    /// # Errors
    /// Both keys are given, or the figure is not finite.
    pub fn value(
        self,
        quantity: &str,
        plain: Option<&Spanned<f64>>,
        handy: Option<&Spanned<f64>>,
    ) -> Result<Option<f64>, Diagnostic> {
        let vector = |figure: &Spanned<f64>| Spanned::new(figure.span(), [*figure.get_ref()]);
        let (plain, handy) = (plain.map(vector), handy.map(vector));
        Ok(self.vector(quantity, plain.as_ref(), handy.as_ref())?.map(|[value]| value))
    }

    /// The same for a vector.
    ///
    /// # Errors
    /// Both keys are given, or a figure is not finite.
    pub fn vector<const N: usize>(
        self,
        quantity: &str,
        plain: Option<&Spanned<[f64; N]>>,
        handy: Option<&Spanned<[f64; N]>>,
    ) -> Result<Option<[f64; N]>, Diagnostic> {
        let [plain_key, handy_key] = self.keys(quantity);
        match (plain, handy) {
            (None, None) => Ok(None),
            (Some(figures), None) => finite(&plain_key, figures).map(Some),
            (None, Some(figures)) => {
                Ok(Some(finite(&handy_key, figures)?.map(|figure| self.convert(figure))))
            }
            (Some(_), Some(second)) => Err(Diagnostic::error(
                "toml::both_units",
                format!("{plain_key} and {handy_key} are both given"),
            )
            .at(second.span())
            .with_help("keep exactly one of the two")),
        }
    }
}

fn finite<const N: usize>(key: &str, figures: &Spanned<[f64; N]>) -> Result<[f64; N], Diagnostic> {
    figures.get_ref().iter().try_for_each(|&figure| check_finite(key, figure, figures.span()))?;
    Ok(*figures.get_ref())
}

/// Refuses NaN and the infinities, which TOML has literals for.
///
/// # Errors
/// `figure` is not finite.
pub fn check_finite(key: &str, figure: f64, span: Range<usize>) -> Result<(), Diagnostic> {
    if figure.is_finite() {
        return Ok(());
    }
    let message = format!("{key} is {figure}, which is not a finite number");
    let help = "every comparison with NaN is false, so a check could never fail";
    Err(Diagnostic::error("toml::not_finite", message).at(span).with_help(help))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    fn given(figure: f64) -> Spanned<f64> {
        Spanned::new(3..5, figure)
    }

    #[track_caller]
    fn check(unit: Unit, plain: Option<f64>, handy: Option<f64>, expected: Result<Option<f64>, &str>) {
        let (plain, handy) = (plain.map(given), handy.map(given));
        let found = unit.value("a", plain.as_ref(), handy.as_ref());
        assert_eq!(found.as_ref().map_err(|error| error.message.as_str()), expected.as_ref().map_err(|e| *e));
    }

    #[test]
    fn one_of_two_keys_gives_the_value() {
        check(Unit::Length, None, None, Ok(None));
        check(Unit::Length, Some(0.1625), None, Ok(Some(0.1625)));
        check(Unit::Length, None, Some(162.5), Ok(Some(0.1625)));
        check(Unit::Angle, None, Some(90.0), Ok(Some(FRAC_PI_2)));
        check(Unit::Angle, Some(FRAC_PI_2), None, Ok(Some(FRAC_PI_2)));
    }

    #[test]
    fn two_keys_and_figures_that_are_no_number_are_refused() {
        check(Unit::Length, Some(1.0), Some(1.0), Err("a_m and a_mm are both given"));
        check(Unit::Angle, None, Some(f64::NAN), Err("a_deg is NaN, which is not a finite number"));
        check(Unit::Length, Some(f64::INFINITY), None, Err("a_m is inf, which is not a finite number"));
    }
}
