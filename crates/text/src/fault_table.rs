//! What `congruent run --faults` prints of scenarios that inject faults.

use std::fmt::Write;

use congruent_results::report::FaultTable;

/// What `congruent run --faults` prints: for each scenario what is injected, which checks detect it and after what time, and
/// what the diagnosis finds.
pub fn fault_table_text(table: &FaultTable) -> String {
    let mut text = String::new();
    for row in &table.rows {
        let _ = writeln!(text, "{} ({})", row.scenario, row.robot);
        let _ = writeln!(text, "  injected   {}", row.injected());
        let seen: Vec<String> = row
            .checks
            .iter()
            .filter(|seen| seen.fails && !seen.before_fault)
            .map(|seen| match seen.after_s {
                Some(_) => format!("{} after {}", seen.check, row.cell(seen.check)),
                None => seen.check.to_string(),
            })
            .collect();
        let seen = if seen.is_empty() { "by no check".to_owned() } else { format!("by {}", seen.join(", ")) };
        let _ = writeln!(text, "  detected   {seen}");
        let _ = writeln!(text, "  diagnosis  {} (correct: {})", row.diagnosed(), row.judged());
    }
    for remark in table.remarks() {
        let _ = writeln!(text, "{remark}");
    }
    text
}
