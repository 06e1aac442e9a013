//! The lines of a robot file that are its table: `[dh]`, its rows and its declared transforms.

/// The lines of the table, in the order of the file; the whole text if the table is written under no header of its own,
/// but with dotted keys or as an inline table.
pub fn dh_text(robot_file: &str) -> String {
    let mut sections: Vec<Vec<&str>> = Vec::new();
    let mut is_table = false;
    for line in robot_file.lines() {
        if let Some(name) = header(line) {
            is_table = name == "dh" || name.starts_with("dh.");
            if is_table {
                sections.push(Vec::new());
            }
        }
        if let Some(section) = sections.last_mut().filter(|_| is_table) {
            section.push(line);
        }
    }
    let has_dh = sections.iter().flatten().any(|line| header(line) == Some("dh".to_owned()));
    if !has_dh {
        return robot_file.to_owned();
    }
    // One empty line between the sections, however many the file has.
    let trimmed = sections.iter().map(|section| section.join("\n").trim_end().to_owned());
    trimmed.collect::<Vec<_>>().join("\n\n") + "\n"
}

/// The name of the table that a line begins, such as `dh.row`; none for the rows of a matrix, which have commas.
fn header(line: &str) -> Option<String> {
    let line = line.split('#').next().unwrap_or_default().trim();
    let name = line.strip_prefix('[')?.strip_suffix(']')?;
    let name = name.strip_prefix('[').and_then(|name| name.strip_suffix(']')).unwrap_or(name);
    let is_name = |c: char| c.is_alphanumeric() || "._-\"' ".contains(c);
    // Spaces and quotes around the parts mean nothing.
    name.chars().all(is_name).then(|| name.replace([' ', '"', '\''], ""))
}

#[cfg(test)]
mod tests {
    use super::dh_text;

    #[test]
    fn the_table_is_taken_out_of_the_file() {
        let file = "name = \"a\"\n\n[ dh ] # the table\nconvention = \"standard\"\nmatrix = [\n  [1, 0],\n  [0, 1]\n]\n\n\n\
                    [[dh.row]]\na_m = 1\n\n[limits]\nx = 1\n\n[\"dh\".base_from_dh0]\nxyz_m = [0, 0, 1]\n";
        let table = "[ dh ] # the table\nconvention = \"standard\"\nmatrix = [\n  [1, 0],\n  [0, 1]\n]\n\n\
                     [[dh.row]]\na_m = 1\n\n[\"dh\".base_from_dh0]\nxyz_m = [0, 0, 1]\n";
        assert_eq!(dh_text(file), table);
    }

    #[test]
    fn a_table_with_dotted_keys_is_the_whole_file() {
        let file = "name = \"a\"\ndh.convention = \"standard\"\n";
        assert_eq!(dh_text(file), file);
    }
}
