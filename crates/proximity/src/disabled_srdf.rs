//! A suggestion of pairs to disable as the text of an SRDF.

use std::fmt::Write;

use congruent_input::serde_name;

use super::disabled_pairs::{DisabledPairs, SuggestedPair};

/// The suggestion as the text of an SRDF, with the samples that it is based on in a comment.
pub fn srdf_text(pairs: &DisabledPairs) -> String {
    let mut text = String::from("<?xml version=\"1.0\"?>\n");
    // "--" must not occur in a comment (XML 1.0, section 2.5), and a path may have it.
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
    let mut text = format!("Suggested by `congruent clearance --write-srdf` from {urdf}:\n");
    let _ = writeln!(
        text,
        "{samples} random configurations within the limits, seed {seed}; meshes as convex hulls."
    );
    let _ = writeln!(
        text,
        "Reason Never: no contact was found in these samples, which is no proof. Review these pairs before use."
    );
    text
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    // A parser normalises these three to spaces in an attribute (XML 1.0, section 3.3.3), which would change the name.
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
