//! Findings about files as such, XML, TOML, meshes and SRDF.

use super::Area;

pub(super) const AREAS: &[Area] = &[
    Area {
        word: "FILE",
        codes: &[
            (
                1,
                "file::not_found",
                "The file does not exist. The help names the file of the same folder whose name is most like it.",
            ),
            (2, "file::directory", "A folder is given where a file is expected."),
            (
                3,
                "file::not_regular",
                "The path is a pipe, a socket or a device. Only regular files are read, so that no reader waits for ever.",
            ),
            (
                4,
                "file::no_writer",
                "The path is a pipe, and no program writes to it: reading would wait for ever.",
            ),
            (
                5,
                "file::too_large",
                "The file is larger than any file of its kind needs to be, and is not read.",
            ),
            (6, "file::permission", "The user who runs the command may not read the file."),
            (
                7,
                "file::unreadable",
                "The operating system refuses to read the file; the message has its reason.",
            ),
            (
                8,
                "file::empty",
                "The file has no bytes. Often a program that should have written it has failed.",
            ),
            (9, "file::utf16", "The text is encoded as UTF-16. Save it as UTF-8."),
            (
                10,
                "file::nul",
                "The text has a NUL byte. Some readers stop there and lose the rest without a word, so it is refused.",
            ),
            (11, "file::not_utf8", "The text has bytes that are no UTF-8. Save it as UTF-8."),
            (
                12,
                "file::outside",
                "Another file names a file outside of the project, and such files are not opened. The project is the nearest folder at or above the given file with package.xml or .git, or else the folder above its own. Allow another folder with --allow.",
            ),
            (13, "file::allow", "--allow does not name a folder."),
            (14, "file::standard_input", "Standard input is asked for twice; it can be read once."),
            (
                15,
                "load::no_robot_file",
                "The folder has no robot.toml, so it is no robot. Give a folder that has one, a robot file or a .urdf.",
            ),
            (
                16,
                "lint::kind",
                "The file is none of those that can be linted: URDF, SRDF, robot file, scenario, table of configurations, targets or measurements. The kind is decided by the content.",
            ),
            (
                17,
                "lint::no_robot",
                "The robot of an SRDF or of a table is not known, so its names are not checked. Give both in one call, or lint the robot file that names the SRDF.\n    congruent lint robot.toml configurations.json",
            ),
        ],
    },
    Area {
        word: "XML",
        codes: &[
            (
                1,
                "xml::malformed",
                "The text is no well-formed XML: a quote or a bracket is missing, an attribute is given twice, a tag is closed that is not open.",
            ),
            (
                2,
                "xml::truncated",
                "The file ends before its elements are closed: it was cut off, or a closing tag is missing. The message names the innermost element that is open.",
            ),
            (
                3,
                "xml::dtd",
                "The file declares a document type or entities. They can read other files and grow to any size, so they are refused. Write the values out.",
            ),
            (
                4,
                "xml::depth",
                "Elements are nested deeper than in any robot, which would exhaust the stack of a reader.",
            ),
            (5, "xml::attributes", "An element has more attributes than any robot needs."),
            (
                6,
                "xml::prefix",
                "An element or attribute has a prefix (`prefix:name`) that no xmlns declares.",
            ),
            (
                7,
                "xml::encoding",
                "The file declares another encoding than it has. Readers that go by the declaration refuse it, or read other names.",
            ),
        ],
    },
    Area {
        word: "TOML",
        codes: &[
            (1, "toml::invalid", "The text is no TOML, or a value has the wrong type."),
            (
                2,
                "toml::unknown_key",
                "There is no such key here. Unknown keys are errors, since a misspelt key would otherwise have no effect without a word.",
            ),
            (3, "toml::unknown_value", "The key takes one of several words, and this is none of them."),
            (4, "toml::missing_key", "A key that has no default is missing."),
            (5, "toml::both_units", "A quantity is given twice, in two units. Keep exactly one of the keys."),
            (
                6,
                "toml::not_finite",
                "The value is NaN or infinite. Every comparison with NaN is false, so a check could never fail.",
            ),
            (
                7,
                "toml::hidden_character",
                "A name has a character that is not shown, such as a control character or a mark of writing direction. Names go into every output, so it is refused.",
            ),
            (
                8,
                "transform::conflict",
                "A transform has both a quaternion and angles, or another pair of keys that say the same. Keep exactly one.",
            ),
            (
                9,
                "transform::matrix",
                "A matrix of a transform is no rotation with a translation: its rows must be [R | t] with R orthonormal, right-handed, and [0, 0, 0, 1] last.",
            ),
            (
                10,
                "transform::quaternion_norm",
                "A quaternion is not of norm 1, so some digit of it is wrong or missing. It is not normalised silently. The scalar comes first.",
            ),
        ],
    },
    Area {
        word: "MESH",
        codes: &[
            (1, "mesh::not_found", "The mesh file does not exist at the place that the URDF names."),
            (
                2,
                "mesh::invalid",
                "The mesh cannot be used: it is damaged, has no area, holds NaN, or is of a format that is not read. Distances and contacts need every collision mesh.",
            ),
            (
                3,
                "mesh::empty",
                "The mesh file is valid and has no triangles, so its link has no shape there.",
            ),
            (
                5,
                "mesh::network",
                "The mesh is on the network, which is never used. Put it beside the URDF and name it by a relative path.",
            ),
            (
                6,
                "mesh::scheme",
                "The address of the mesh begins with a scheme that is not known. Known are package://, file:// and relative paths.",
            ),
            (
                7,
                "mesh::outside",
                "The mesh is outside of the project, and is not opened. Allow its folder with --allow, or move it.",
            ),
            (
                8,
                "mesh::package_slashes",
                "The address has three slashes after `package:`, so it names no package. The file was found all the same; other readers may not find it.\n    package://NAME/meshes/x.stl",
            ),
            (
                9,
                "mesh::material_outside",
                "An OBJ file names a material library outside of the project. Material libraries are never read.",
            ),
            (10, "mesh::no_folder", "The URDF was given as text without a folder, so no mesh can be found."),
            (
                11,
                "mesh::cut_hull",
                "The convex hull of a mesh has so many points that not all are taken. What is left out, at most, is taken off every distance.",
            ),
        ],
    },
    Area {
        word: "SRDF",
        codes: &[
            (
                1,
                "srdf::unknown_link",
                "The SRDF names a link that the robot does not have; a pair of collisions with it is not disabled. Often a link was renamed.",
            ),
            (
                2,
                "srdf::pair",
                "<disable_collisions> or <enable_collisions> lacks link1 or link2, or names one link twice: it has no effect.",
            ),
            (3, "srdf::root", "The root element of an SRDF is <robot>."),
            (
                4,
                "srdf::unknown_joint",
                "The SRDF names a joint that the robot does not have. Often a joint was renamed, or it has the prefix of another robot.",
            ),
            (5, "srdf::unknown_group", "A group is named that the SRDF does not define."),
            (
                6,
                "srdf::missing_name",
                "An element of the SRDF does not name the link, joint or group that it is about.",
            ),
            (
                7,
                "srdf::robot_name",
                "The SRDF and the URDF are of robots of different names. Motion planners refuse the two together.",
            ),
            (
                8,
                "srdf::twice",
                "Two groups, or two states of one group, have the same name. Motion planners take one of the two without a word.",
            ),
            (
                9,
                "srdf::empty_group",
                "A group has no joints, links, chains or groups: nothing can be planned for it.",
            ),
            (
                10,
                "srdf::value",
                "The position of a joint in a named state is missing or is no number, in rad or m.",
            ),
            (
                11,
                "srdf::beyond_limit",
                "A named state has a joint beyond the limits of the URDF. Motion planners refuse it as a goal. Often the position is in degrees.",
            ),
            (12, "srdf::unknown_element", "An element is misspelt, so that every reader skips it."),
            (
                13,
                "srdf::virtual_joint",
                "A virtual joint is of a type that there is not: it is fixed, planar or floating.",
            ),
        ],
    },
];
