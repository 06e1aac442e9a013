//! Findings about files as such, XML, TOML, meshes and SRDF.

use super::Area;

pub(super) const AREAS: &[Area] = &[
    Area {
        word: "FILE",
        codes: &[
            (
                1,
                "file::not_found",
                "The file does not exist. The help names the most similar file name in the same folder.",
            ),
            (2, "file::directory", "A folder is given where a file is expected. Give a file in this folder."),
            (
                3,
                "file::not_regular",
                "The path is a pipe, a socket or a device. Only regular files are read, because reading the others may never end. Save its content as a file and give that.",
            ),
            (
                4,
                "file::no_writer",
                "The path is a pipe that no program writes to, so reading would never end. Start the program that writes to it, or give a file.",
            ),
            (
                5,
                "file::too_large",
                "The file exceeds the size limit of its kind, and is not read, so that a wrong or hostile file cannot fill the memory. The message has size and limit.",
            ),
            (
                6,
                "file::permission",
                "The user who runs the command may not read the file. Change the permissions of the file, or run the command as another user.",
            ),
            (
                7,
                "file::unreadable",
                "The operating system refuses to read the file; the message has its reason.",
            ),
            (
                8,
                "file::empty",
                "The file has no content. Often the program that should have written it has failed. Run that program again and read its messages.",
            ),
            (9, "file::utf16", "The text is encoded as UTF-16. Save it as UTF-8."),
            (
                10,
                "file::nul",
                "The text has a NUL byte. Some readers stop there and silently lose the rest, so the file is refused. Save the file again as plain text in UTF-8.",
            ),
            (11, "file::not_utf8", "The text has bytes that are not UTF-8. Save it as UTF-8."),
            (
                12,
                "file::outside",
                "Another file names a file outside the project, which is not opened. The project is the nearest folder, at or above the given file, that holds package.xml or .git; without one it is the parent of the folder of that file. Allow another folder with --allow.",
            ),
            (
                13,
                "file::allow",
                "--allow does not name a folder. Give a folder that exists and whose files may be opened.",
            ),
            (
                14,
                "file::standard_input",
                "Two arguments are standard input (-), which can be read only once. Give one of them as a file.",
            ),
            (
                15,
                "load::no_robot_file",
                "The folder has no robot.toml, so it is not a robot. Give a folder with a robot.toml, a robot file or a .urdf.",
            ),
            (
                16,
                "lint::kind",
                "The file is not of a kind that can be linted. These kinds are URDF, SRDF, robot file, scenario, and tables of configurations, targets or measurements; the content decides the kind.",
            ),
            (
                17,
                "lint::no_robot",
                "The robot of an SRDF or of a table is not known, so the names in the file are not checked. Give both files in one call, or lint the robot file that names the SRDF.\n    congruent lint robot.toml configurations.json",
            ),
        ],
    },
    Area {
        word: "XML",
        codes: &[
            (
                1,
                "xml::malformed",
                "The text is not well-formed XML: for example a quote or a bracket is missing, an attribute is given twice, or a closing tag has no opening tag.",
            ),
            (
                2,
                "xml::truncated",
                "The file ends inside an element: it was cut off, or a closing tag is missing. The message names the innermost open element. Copy the file again, or close that element.",
            ),
            (
                3,
                "xml::dtd",
                "The file declares a document type or entities. Entities can read other files and expand to any size, so they are refused. Write the values out.",
            ),
            (
                4,
                "xml::depth",
                "Elements are nested deeper than in any robot, which would overflow the stack of a reader. Remove the nesting; such a file is damaged or was made to do harm.",
            ),
            (
                5,
                "xml::attributes",
                "An element has more attributes than any robot needs. Remove those that a URDF does not have.",
            ),
            (
                6,
                "xml::prefix",
                "An element or attribute has a prefix (`prefix:name`) that no xmlns attribute declares. Declare the prefix on the root element, or remove it.\n    <robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">",
            ),
            (
                7,
                "xml::encoding",
                "The encoding that the file declares is not the encoding it has. Readers that follow the declaration refuse the file, or read other names. Save the file as UTF-8 and declare that.\n    <?xml version=\"1.0\" encoding=\"UTF-8\"?>",
            ),
        ],
    },
    Area {
        word: "TOML",
        codes: &[
            (
                1,
                "toml::invalid",
                "The text is not valid TOML, or a value has the wrong type. The message says where, and what was expected.",
            ),
            (
                2,
                "toml::unknown_key",
                "No such key is known here. Unknown keys are errors, because a misspelt key would otherwise be silently ignored. The help has the most similar key and the known ones.",
            ),
            (
                3,
                "toml::unknown_value",
                "The key takes one of several words; this value is not one of them. The help lists the known words.",
            ),
            (4, "toml::missing_key", "A required key is missing. The message names it."),
            (5, "toml::both_units", "A quantity is given twice, in two units. Keep exactly one of the keys."),
            (
                6,
                "toml::not_finite",
                "The value is NaN or infinite. Every comparison with NaN is false, so a check could never fail. Write a finite number, or leave the key out if it is optional.",
            ),
            (
                7,
                "toml::hidden_character",
                "A name has an invisible character, such as a control character or a mark of writing direction. Names are copied into every output, so it is refused. Type the name again.",
            ),
            (
                8,
                "transform::conflict",
                "A transform gives its rotation or its translation by two keys, such as a quaternion and angles. Keep exactly one.",
            ),
            (
                9,
                "transform::matrix",
                "The matrix of a transform is not a rotation with a translation. Its first three rows must be [R | t] with R orthonormal and right-handed, its last row [0, 0, 0, 1].",
            ),
            (
                10,
                "transform::quaternion_norm",
                "The norm of a quaternion is not 1, so a digit is wrong or missing. It is not silently normalised. The order is w, x, y, z.",
            ),
        ],
    },
    Area {
        word: "MESH",
        codes: &[
            (
                1,
                "mesh::not_found",
                "The mesh file that the URDF names does not exist. Distances and contacts need every collision mesh.",
            ),
            (
                2,
                "mesh::invalid",
                "The mesh cannot be used: it is damaged, has no area, holds NaN, or its format is not supported. Distances and contacts need every collision mesh.",
            ),
            (
                3,
                "mesh::empty",
                "The mesh file is valid but has no triangles, so the link gets no shape from it. Distances and contacts of that link are not measured. Export the mesh again.",
            ),
            (
                5,
                "mesh::network",
                "The mesh has a network address; the network is never used. Put the mesh beside the URDF and name it by a relative path.",
            ),
            (
                6,
                "mesh::scheme",
                "The scheme of the mesh address is not known. Known are package://, file:// and relative paths. Write one of these.",
            ),
            (
                7,
                "mesh::outside",
                "The mesh is outside the project, and is not opened. Allow its folder with --allow, or move the mesh.",
            ),
            (
                8,
                "mesh::package_slashes",
                "The address has three slashes after `package:`, so it names no package. The file was found, but other readers may not find it.\n    package://NAME/meshes/x.stl",
            ),
            (
                9,
                "mesh::material_outside",
                "An OBJ file names a material library outside the project. Material libraries are never read.",
            ),
            (
                10,
                "mesh::no_folder",
                "The URDF was given as text without a folder, so no mesh can be found. Give the URDF as a file.",
            ),
            (
                11,
                "mesh::cut_hull",
                "The convex hull of a mesh has too many points, so a smaller hull is used. The largest distance between the two hulls is subtracted from every distance. A mesh with fewer vertices is measured exactly, and faster.",
            ),
        ],
    },
    Area {
        word: "SRDF",
        codes: &[
            (
                1,
                "srdf::unknown_link",
                "The SRDF names a link that the robot does not have; a disabled collision pair with this link has no effect. Often the link was renamed.",
            ),
            (
                2,
                "srdf::pair",
                "<disable_collisions> or <enable_collisions> lacks link1 or link2, or names the same link twice, so it has no effect. Give two different links.\n    <disable_collisions link1=\"base_link\" link2=\"shoulder_link\"/>",
            ),
            (
                3,
                "srdf::root",
                "The root element of an SRDF must be <robot>, and the file must not be a URDF. Give the SRDF, which begins like this.\n    <robot name=\"my_arm\">",
            ),
            (
                4,
                "srdf::unknown_joint",
                "The SRDF names a joint that the robot does not have. Often the joint was renamed, or has the prefix of another robot.",
            ),
            (
                5,
                "srdf::unknown_group",
                "The SRDF names a group that it does not define. Often the group was renamed.",
            ),
            (
                6,
                "srdf::missing_name",
                "An element of the SRDF lacks the name of its link, joint or group. Without it the element has no effect.",
            ),
            (
                7,
                "srdf::robot_name",
                "The SRDF and the URDF have different robot names. Motion planners refuse to load the two together. Give the SRDF the name of the URDF.",
            ),
            (
                8,
                "srdf::twice",
                "Two groups, or two states of one group, have the same name. Motion planners silently use one of the two. Rename or remove one.",
            ),
            (
                9,
                "srdf::empty_group",
                "A group has no joints, links, chains or groups, so nothing can be planned for it. Add what belongs to it, or remove the group.",
            ),
            (
                10,
                "srdf::value",
                "The position of a joint in a named state is missing or is not a number (in rad or m). Write a number.\n    <joint name=\"elbow_joint\" value=\"1.57\"/>",
            ),
            (
                11,
                "srdf::beyond_limit",
                "A named state puts a joint beyond its limits in the URDF. Motion planners refuse it as a goal. Often the position is in degrees.",
            ),
            (12, "srdf::unknown_element", "An element is misspelt, so readers ignore it. Correct its name."),
            (
                13,
                "srdf::virtual_joint",
                "The type of a virtual joint is unknown; it must be fixed, planar or floating.",
            ),
        ],
    },
];
