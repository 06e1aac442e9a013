//! Runs model and physics side by side, compares, reports and records.
