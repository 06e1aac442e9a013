//! `explain`: codes of findings, and causes of a disagreement.

use crate::support::command::{Answer, congruent};

#[test]
fn codes_are_explained_by_number_and_by_name() {
    for call in [
        &["explain", "CGR-URDF-028"][..],
        &["explain", "urdf::massless"],
        &["lint", "--explain", "urdf::massless"],
    ] {
        let answer = congruent(call);
        assert!(
            answer.code == 0 && answer.stdout.starts_with("CGR-URDF-028 urdf::massless\n"),
            "{}",
            answer.stdout
        );
    }
    let unknown = congruent(&["explain", "urdf::masless"]);
    assert_eq!(unknown.code, 2);
    assert!(unknown.stderr.contains("did you mean CGR-URDF-028, urdf::massless?"), "{}", unknown.stderr);
}

#[test]
fn causes_of_check_are_explained_like_codes() {
    let explained = |word: &str| congruent(&["explain", word]);
    let in_one_line = |answer: &Answer| answer.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    for word in ["check::axis_flipped", "axis_flipped", "CHECK::AXIS_FLIPPED"] {
        let answer = explained(word);
        assert!(answer.code == 0 && answer.stdout.starts_with("check::axis_flipped\n"), "{}", answer.stdout);
        assert!(in_one_line(&answer).contains("change `sign` of the row"), "{}", answer.stdout);
    }
    assert!(
        in_one_line(&explained("mass_unit"))
            .contains("dynamics: the mass is given in another unit. A URDF has kg")
    );
    let of_both = in_one_line(&explained("joints_swapped"));
    assert!(of_both.contains("Two rows") && of_both.contains("in dynamics: damping"), "{of_both}");
    for word in ["check::axis_fliped", "axis_fliped"] {
        let unknown = explained(word);
        assert_eq!(unknown.code, 2);
        assert!(unknown.stderr.contains("did you mean axis_flipped?"), "{}", unknown.stderr);
    }
}
