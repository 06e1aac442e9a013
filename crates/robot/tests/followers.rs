//! Chains of joints that follow each other.

use congruent_description::parse_urdf;

/// Four joints in a chain; all but the first follow the one before.
fn followers(mimic: &str) -> String {
    let part = |at: usize| {
        let mimic = if at > 1 { format!("<mimic joint='j{}' {mimic}/>", at - 1) } else { String::new() };
        format!(
            "<link name='l{at}'/>\n<joint name='j{at}' type='continuous'>\
             <parent link='l{}'/><child link='l{at}'/>\n{mimic}</joint>",
            at - 1
        )
    };
    format!("<robot name='r'><link name='l0'/>{}</robot>", (1..5).map(part).collect::<String>())
}

#[test]
fn what_a_chain_of_followers_multiplies_to_is_limited() {
    let check = |mimic: &str, expected: &str| {
        let found = parse_urdf(&followers(mimic)).unwrap_err();
        let fault = found.first();
        assert_eq!(found.len(), 1, "{found:#?}");
        assert_eq!((fault.code.name, fault.message.as_str()), ("urdf::number", expected));
        let place = fault.span.clone().expect("the element of the joint");
        assert!(followers(mimic)[place].starts_with("<mimic"), "{fault:#?}");
    };
    check(
        "multiplier='1e6'",
        "joint \"j3\": mimic: multiplier 1e12 with those of the joints that \"j2\" follows, limit <= 1e6",
    );
    check(
        "multiplier='-1e3' offset='900'",
        "joint \"j4\": mimic: multiplier -1e9 with those of the joints that \"j3\" follows, limit <= 1e6",
    );
    check(
        "multiplier='90' offset='1e4'",
        "joint \"j4\": mimic: offset 8.191e7 with those of the joints that \"j3\" follows, limit <= 1e6",
    );
    let robot = parse_urdf(&followers("multiplier='100'")).unwrap();
    assert_eq!(robot.joints()[3].mimic.map(|mimic| mimic.multiplier), Some(1e6));
}
