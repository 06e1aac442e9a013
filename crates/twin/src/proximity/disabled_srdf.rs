//! A suggestion of pairs to disable as the text of an SRDF.

use std::fmt::Write;

use congruent_description::serde_name;

use super::disabled_pairs::{DisabledPairs, SuggestedPair};

/// The suggestion as an SRDF; what it rests on is a comment.
pub fn srdf_text(pairs: &DisabledPairs) -> String {
    let mut text = String::from("<?xml version=\"1.0\"?>\n");
    let _ = writeln!(text, "<!--\n{}-->", comment(pairs).replace("--", "- -"));
    let _ = writeln!(text, "<robot name=\"{}\">", escaped(&pairs.robot));
    for SuggestedPair { pair: [a, b], reason, .. } in &pairs.suggested {
        let (a, b) = (escaped(a), escaped(b));
        let _ = writeln!(
            text,
            "    <disable_collisions link1=\"{a}\" link2=\"{b}\" reason=\"{}\"/>",
            serde_name(reason)
        );
    }
    text + "</robot>\n"
}

fn comment(pairs: &DisabledPairs) -> String {
    let DisabledPairs { urdf, samples, seed, .. } = pairs;
    let mut text = format!("Suggested by `congruent acm suggest` from {urdf}:\n");
    let _ = writeln!(
        text,
        "{samples} random configurations within the limits, seed {seed}; meshes as convex hulls."
    );
    let _ = writeln!(
        text,
        "Never is what was found from these samples, and no proof: read it before you use it."
    );
    text
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    // What an attribute would turn into a space.
    let text = text.replace('\n', "&#10;").replace('\r', "&#13;").replace('\t', "&#9;");
    text.replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_escaped() {
        assert_eq!(escaped("a<\"&\nb"), "a&lt;&quot;&amp;&#10;b");
    }
}
