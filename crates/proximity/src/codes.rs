//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    mesh {
        CUT_HULL = "CGR-MESH-011", "mesh::cut_hull",
            "The convex hull of a mesh has too many points, so a smaller hull is used. The largest distance between the two hulls is subtracted from every distance. A mesh with fewer vertices is measured exactly, and faster. Reduce the vertices of the mesh, then measure again.\n    congruent clearance ROBOT --at elbow_joint=90deg";
    }
    clearance {
        UNKNOWN_NAME = "CGR-SCENARIO-083", "clearance::unknown_name",
            "A pair names something that is neither a link nor an obstacle. The help has the most similar name and the known ones.\n    wrong: pairs = [[\"forearm\", \"table\"]]\n    right: pairs = [[\"forearm_link\", \"table\"]]";
        NO_PAIR = "CGR-SCENARIO-084", "clearance::no_pair",
            "A check of distances has no pair to measure, so it would always pass. Ignore fewer pairs, or remove the check.\n    wrong: ignore = [[\"*\", \"*\"]]\n    right: ignore = [[\"base_link_inertia\", \"table\"]]";
        PAIR_IN_BOTH = "CGR-SCENARIO-085", "clearance::pair_in_both",
            "A pair is listed both as measured and as ignored. The two contradict each other. Remove it from one of the lists.\n    wrong: ignore = [[\"forearm_link\", \"table\"]]\n    right: ignore = [[\"base_link_inertia\", \"table\"]]";
        PAIR_NOT_MEASURED = "CGR-SCENARIO-086", "clearance::pair_not_measured",
            "The distance of a pair is not measured: the two cannot move relative to each other, or have no shape. Remove the pair from `pairs`. A pair that the SRDF disables is not measured, either.\n    wrong: pairs = [[\"wrist_3_link\", \"tool0\"]]\n    right: pairs = [[\"wrist_3_link\", \"table\"]]";
    }
}
