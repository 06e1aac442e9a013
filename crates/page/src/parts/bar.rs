//! How much of its limit a value uses, as a bar on a logarithmic scale with the limit marked: values far below and far above it
//! are all in the picture.

use maud::{Markup, html};

/// Decades below the limit at which a bar begins. Kind: choice.
const BELOW: f64 = 3.0;
/// Fewest and most decades above the limit. Kind: choice.
const ABOVE: (f64, f64) = (1.0, 15.0);

/// How much of its limit a value uses, and whether it is within.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UsedShare {
    pub(crate) share: f64,
    pub(crate) holds: bool,
}

/// The scale of the bars of one table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BarScale {
    above: f64,
}

impl BarScale {
    /// A scale for these shares of their limits.
    pub(crate) fn for_shares(shares: impl Iterator<Item = f64>) -> Self {
        let largest = shares.filter(|share| share.is_finite()).fold(1.0, f64::max);
        let above = libm::log10(largest).ceil();
        Self { above: if largest > 1.0 { above.clamp(ABOVE.0, ABOVE.1) } else { ABOVE.0 / 2.0 } }
    }

    fn percent(self, share: f64) -> f64 {
        if share <= 0.0 {
            return 0.0;
        }
        // What is not finite is beyond every scale.
        let decades = if share.is_finite() { libm::log10(share) } else { self.above };
        (100.0 * (decades + BELOW) / (BELOW + self.above)).clamp(0.0, 100.0)
    }

    /// The bar of a value that uses this share of its limit; outside of it for a share above 1.
    pub(crate) fn bar(self, UsedShare { share, holds }: UsedShare) -> Markup {
        let label = if holds {
            format!("{:.0} % of the limit", 100.0 * share)
        } else {
            "outside the limit".to_owned()
        };
        html! {
            span.bar.(if holds { "good" } else { "bad" }) role="img" aria-label=(label) {
                i style=(format!("width:{:.1}%", self.percent(share))) {}
                b style=(format!("left:{:.1}%", self.percent(1.0))) {}
            }
        }
    }

    /// What the bars of a table mean.
    pub(crate) fn words() -> Markup {
        html! {
            p.small {
                "Bars show how much of its limit a value uses (limit over value, if the limit is a least one), logarithmic from 1/1000; \
                 the mark is the limit."
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_logarithmic_and_marks_the_limit() {
        let scale = BarScale::for_shares([0.5, 100.0].into_iter());
        for (share, percent) in [
            (0.0, 0.0),
            (1e-9, 0.0),
            (1e-3, 0.0),
            (1.0, 60.0),
            (10.0, 80.0),
            (100.0, 100.0),
            (f64::INFINITY, 100.0),
        ] {
            assert!((scale.percent(share) - percent).abs() < 1e-9, "{share}: {}", scale.percent(share));
        }
        let bar = scale.bar(UsedShare { share: 10.0, holds: false }).into_string();
        assert!(
            bar.contains("width:80.0%") && bar.contains("left:60.0%") && bar.contains("outside"),
            "{bar}"
        );
        // Without a violation there is still room beyond the mark.
        assert!(BarScale::for_shares([0.5].into_iter()).percent(1.0) < 90.0);
    }
}
