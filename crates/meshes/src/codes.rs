//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    mesh {
        INVALID = "CGR-MESH-002", "mesh::invalid",
            "The mesh cannot be used: it is damaged, has no area, holds NaN, or its format is not supported. Distances and contacts need every collision mesh.";
        EMPTY = "CGR-MESH-003", "mesh::empty",
            "The mesh file is valid but has no triangles, so the link gets no shape from it. Distances and contacts of that link are not measured. Export the mesh again.";
        MATERIAL_OUTSIDE = "CGR-MESH-009", "mesh::material_outside",
            "An OBJ file names a material library outside the project. Material libraries are never read.";
        NO_FOLDER = "CGR-MESH-010", "mesh::no_folder",
            "The URDF was given as text without a folder, so no mesh can be found. Give the URDF as a file.";
    }
}
