//! What `congruent clearance --write-srdf` prints.

use std::fmt::Write;

use congruent_input::display::{counted, length};
use congruent_proximity::{DisableReason, DisabledPairs};

use crate::layout::paragraph;

/// What `congruent clearance --write-srdf` prints below the SRDF: how many pairs have which reason, and what to examine before it is used.
pub fn disabled_pairs_text(pairs: &DisabledPairs) -> String {
    let mut text = String::new();
    let (of_links, links) = (counted(pairs.pairs, "pair"), counted(pairs.links, "link"));
    let _ = writeln!(text, "{}: {of_links} of {links} with a shape", pairs.robot);
    if pairs.pairs == 0 {
        return text + "  no pair to examine: no SRDF is written\n";
    }
    let counts = [
        (DisableReason::Adjacent, "connected by a joint".to_owned()),
        (DisableReason::Default, "touch in the default position".to_owned()),
        (DisableReason::Always, format!("touch in 95 % of {} samples, seed {}", pairs.samples, pairs.seed)),
        (DisableReason::Never, "no contact in any sample, which is no proof".to_owned()),
    ];
    for (reason, words) in counts {
        let _ = writeln!(text, "  {:4} {reason:?}: {words}", pairs.count(reason));
    }
    let _ = writeln!(
        text,
        "  {:4} touch in some configurations: keep them in collision checking",
        pairs.pairs - pairs.suggested.len()
    );
    if let Some(nearest) = pairs.nearest_never()
        && let Some(least_m) = nearest.least_m
    {
        let [a, b] = &nearest.pair;
        text += &paragraph(
            &format!("nearest pair of Never: {a} and {b}, smallest distance {}", length(least_m)),
            2,
            4,
        );
    }
    if let Some(declared) = &pairs.declared {
        let line = format!(
            "pairs that the robot's SRDF disables: {}; also suggested: {}; without a shape: {}",
            declared.pairs, declared.suggested, declared.without_shape
        );
        text += &paragraph(&line, 2, 4);
        for [a, b] in &declared.hidden {
            text += &paragraph(
                &format!("it disables {a} and {b}, which touch in some configurations and not in others"),
                2,
                4,
            );
        }
    }
    text
}
