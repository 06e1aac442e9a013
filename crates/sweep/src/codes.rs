//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    sweep {
        VERSION = "CGR-SWEEP-001", "sweep::version",
            "The plan is of a version that this program does not read. This program reads version 1.\n    schema_version = 1";
        NAME = "CGR-SWEEP-002", "sweep::name",
            "The sweep has no name. Results are listed under it.\n    name = \"ur5e_payload\"";
        NOTHING_VARIES = "CGR-SWEEP-003", "sweep::nothing_varies",
            "Nothing varies in the plan, so all cases would be one. Add a [[vary]] with a key and a distribution.\n    wrong: no [[vary]]\n    right: [[vary]], key = \"payload.1.mass_kg\" and uniform = [0.5, 3.0]";
        DISTRIBUTION = "CGR-SWEEP-004", "sweep::distribution",
            "A [[vary]] of a plan, or an [[uncertainty.vary]] of a scenario, has no distribution, more than one, or one that has no values: give exactly one of plus_minus, percent, uniform, log_uniform, normal, triangular and values, with numbers in ascending order. On a grid, a range needs steps.\n    wrong: uniform = [3.0, 0.5]\n    right: uniform = [0.5, 3.0]";
        CASES = "CGR-SWEEP-005", "sweep::cases",
            "The number of cases is missing, zero, or another than a grid gives. A grid has as many cases as its values have combinations; every other sampling needs the number.\n    cases = 1000";
        KEY = "CGR-SWEEP-006", "sweep::key",
            "A key of a plan or of [uncertainty] is not one of --set, is there twice, or cannot vary, as the name. Keys are those of the scenario joined by dots; a key that begins with robot. is of the robot.\n    wrong: key = \"payload[1].mass_kg\"\n    right: key = \"payload.1.mass_kg\"";
        OTHER_PLAN = "CGR-SWEEP-007", "sweep::other_plan",
            "The folder has cases of another plan, of other files, or of another version of this program, whose rows are not those of this one. Use another folder, or remove this one.\n    congruent sweep run plan.sweep.toml --out another_folder";
        RANGE = "CGR-SWEEP-008", "sweep::range",
            "The cases that were asked for are none of the plan. Cases count from 0; --cases A..B is without B, --shard I/N counts from 1.\n    wrong: --shard 0/4\n    right: --shard 1/4";
        ROWS = "CGR-SWEEP-009", "sweep::rows",
            "A file of rows cannot be read, or two files have different rows of one case. Rows of one plan are the same on every machine, so a file is damaged, or of another program.\n    congruent sweep status results";
        WRITE = "CGR-SWEEP-011", "sweep::write",
            "A file of the sweep cannot be written. The message has the reason of the system: often the disk is full, or the folder belongs to another user.\n    congruent sweep run plan.sweep.toml --out results";
        REQUIREMENT = "CGR-SWEEP-012", "sweep::requirement",
            "[require] asks for what no sample shows: a share or a confidence that is not between 0 and 1, or a share of a grid, whose cases are chosen and not drawn.\n    wrong: passing = 1.0\n    right: passing = 0.99";
        NO_FILE = "CGR-SWEEP-013", "sweep::no_file",
            "A scenario with [uncertainty] is read once for each case, and came from standard input or was made in code.\n    congruent run uncertain.toml";
        MISSING = "CGR-SWEEP-010", "sweep::missing",
            "Not all cases of the plan have a row, so there is no table of all. Run the missing ones, or merge what there is with --partial.\n    congruent sweep run plan.sweep.toml --out results --resume";
    }
}
