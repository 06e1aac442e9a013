//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    mesh {
        INVALID = "CGR-MESH-002", "mesh::invalid",
            "The mesh cannot be used: it is damaged, has no area, holds NaN, or its format is not supported. Distances and contacts need every collision mesh. Export it again as STL, OBJ or COLLADA.\n    wrong: <mesh filename=\"wrist3.step\"/>\n    right: <mesh filename=\"wrist3.stl\"/>";
        EMPTY = "CGR-MESH-003", "mesh::empty",
            "The mesh file is valid but has no triangles, so the link gets no shape from it. Distances and contacts of that link are not measured. Export the mesh again.\n    wrong: <visual_scene/> in a COLLADA file\n    right: <visual_scene> with the nodes of the part";
        MATERIAL_OUTSIDE = "CGR-MESH-009", "mesh::material_outside",
            "An OBJ file names a material library outside the project. Material libraries are never read. Remove the line, or put the library beside the mesh.\n    wrong: mtllib ../../../metal.mtl\n    right: mtllib metal.mtl";
        NO_FOLDER = "CGR-MESH-010", "mesh::no_folder",
            "The URDF was given as text without a folder, so no mesh can be found. Give the URDF as a file.\n    wrong: congruent.Robot.from_text(text)\n    right: congruent.Robot(\"ur5e.urdf\")";
    }
}
