//! The free corrections, chosen by groups and names.

use congruent_input::{Diagnostic, known_names};

use crate::{
    chain::NominalChain,
    codes,
    estimation::{CorrectionParameter, base_pose, dh_entries, joint_axes, tool_pose, zero_offsets},
};

/// Groups of corrections that can be freed by one word.
pub const GROUPS: [&str; 6] = ["zero-offsets", "dh", "axes", "base", "tool", "all"];

/// The corrections that `free` names and `hold` does not, each once.
///
/// # Errors
/// A name is neither a group nor a correction, `dh` is free for a robot without a table, or nothing is free.
pub(super) fn parameters(
    nominal: &NominalChain<'_>,
    free: &[String],
    hold: &[String],
) -> Result<Vec<CorrectionParameter>, Diagnostic> {
    let names = nominal.joint_names();
    let entries = dh(nominal, &names)?;
    let has_table = !entries.is_empty();
    // In the order in which the corrections of one slot compose: base, table and joints, tool.
    let groups: [(&str, Vec<CorrectionParameter>); 5] = [
        ("base", base_pose()),
        ("zero-offsets", zero_offsets(&nominal.chain, &names)),
        ("dh", entries),
        ("axes", joint_axes(&nominal.chain, &names)),
        ("tool", tool_pose(&nominal.chain)),
    ];
    let everything: &[&str] =
        if has_table { &["base", "dh", "tool"] } else { &["base", "zero-offsets", "axes", "tool"] };
    if !has_table && free.iter().any(|word| word == "dh") {
        let message = format!("robot \"{}\" has no [dh] table, so dh cannot be free", nominal.robot.name());
        return Err(Diagnostic::error(codes::calibrate::NO_TABLE, message)
            .with_help("free zero-offsets, axes, base or tool instead"));
    }
    for word in free.iter().chain(hold) {
        known(word, &groups)?;
    }
    let is_named = |group: &str, name: &str, words: &[String]| {
        words
            .iter()
            .any(|word| word == group || word == name || (word == "all" && everything.contains(&group)))
    };
    let chosen = groups.iter().flat_map(|(group, members)| members.iter().map(move |each| (*group, each)));
    let chosen: Vec<CorrectionParameter> = chosen
        .filter(|(group, each)| is_named(group, &each.name, free) && !is_named(group, &each.name, hold))
        .map(|(_, each)| each.clone())
        .collect();
    if chosen.is_empty() {
        return Err(Diagnostic::error(codes::calibrate::NOTHING_FREE, "no correction is free")
            .with_help(format!("--free accepts {}, or single corrections by name", GROUPS.join(", "))));
    }
    Ok(chosen)
}

fn dh(nominal: &NominalChain<'_>, names: &[&str]) -> Result<Vec<CorrectionParameter>, Diagnostic> {
    let Some((table, chain)) = &nominal.table else { return Ok(Vec::new()) };
    dh_entries(table, chain, names, nominal.robot.dof())
        .map_err(|error| Diagnostic::error(codes::calibrate::ROBOT, error.to_string()))
}

fn known(word: &str, groups: &[(&str, Vec<CorrectionParameter>)]) -> Result<(), Diagnostic> {
    let members = groups.iter().flat_map(|(_, members)| members).map(|each| each.name.as_str());
    let mut all = GROUPS.into_iter().chain(members);
    if all.clone().any(|known| known == word) {
        return Ok(());
    }
    let all: Vec<&str> = all.by_ref().collect();
    Err(Diagnostic::error(
        codes::calibrate::UNKNOWN_CORRECTION,
        format!("\"{word}\" is neither a group of corrections nor a correction"),
    )
    .with_help(known_names(word, "groups and corrections", all.iter().copied())))
}
