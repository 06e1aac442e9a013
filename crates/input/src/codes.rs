//! The codes of the messages of this crate, with what `congruent explain` says about them.

crate::codes! {
    file {
        NOT_FOUND = "CGR-FILE-001", "file::not_found" unreadable,
            "The file does not exist. The help names the most similar file name in the same folder.\n    wrong: congruent check robots/ur5/robot.toml\n    right: congruent check robots/ur5e/robot.toml";
        DIRECTORY = "CGR-FILE-002", "file::directory" unreadable,
            "A folder is given where a file is expected. Give a file in this folder.\n    wrong: congruent ik robots/ur5e --targets robots\n    right: congruent ik robots/ur5e --targets targets.csv";
        NOT_REGULAR = "CGR-FILE-003", "file::not_regular" unreadable,
            "The path is a pipe, a socket or a device, or a file of /proc, /sys or /dev. Only regular files are read, because reading the others may never end. Save its content as a file and give that.\n    wrong: congruent ik robots/ur5e --targets /dev/zero\n    right: congruent ik robots/ur5e --targets targets.csv";
        NO_WRITER = "CGR-FILE-004", "file::no_writer" unreadable,
            "The path is a pipe that no program writes to, so reading would never end. Start the program that writes to it, or give a file.\n    mkfifo pose.jsonl; tracker > pose.jsonl & congruent fk robots/ur5e --configurations pose.jsonl";
        TOO_LARGE = "CGR-FILE-005", "file::too_large" unreadable,
            "The file exceeds the size limit of its kind, and is not read, so that a wrong or hostile file cannot fill the memory. The message has size and limit. Give the file that is meant, or split it.\n    wrong: congruent check recording.urdf\n    right: congruent check ur5e.urdf";
        PERMISSION = "CGR-FILE-006", "file::permission" unreadable,
            "The user who runs the command may not read the file. Change the permissions of the file, or run the command as another user.\n    chmod u+r arm.urdf";
        UNREADABLE = "CGR-FILE-007", "file::unreadable" unreadable,
            "The operating system refuses to read the file; the message has its reason. Copy the file to another disk, and give the copy.\n    cp arm.urdf /tmp/arm.urdf";
        EMPTY = "CGR-FILE-008", "file::empty" unreadable,
            "The file has no content. Often the program that should have written it has failed. Run that program again and read its messages.\n    xacro arm.urdf.xacro > arm.urdf";
        UTF16 = "CGR-FILE-009", "file::utf16" unreadable,
            "The text is encoded as UTF-16. Save it as UTF-8.\n    iconv -f UTF-16 -t UTF-8 arm.urdf > arm_utf8.urdf";
        NUL = "CGR-FILE-010", "file::nul" unreadable,
            "The text has a NUL byte. Some readers stop there and silently lose the rest, so the file is refused. Save the file again as plain text in UTF-8.\n    tr -d '\\000' < arm.urdf > arm_clean.urdf";
        NOT_UTF8 = "CGR-FILE-011", "file::not_utf8" unreadable,
            "The text has bytes that are not UTF-8. Save it as UTF-8.\n    iconv -f ISO-8859-1 -t UTF-8 arm.urdf > arm_utf8.urdf";
        OUTSIDE = "CGR-FILE-012", "file::outside" unreadable,
            "With --fence, a file that another file names is not opened outside the project. The project is the nearest folder, at or above the given file, that holds package.xml or .git; without one it is the parent of the folder of that file. Allow another folder with --allow, or leave out --fence.\n    congruent run scenarios/pick.toml --fence --allow ../meshes";
        ALLOW = "CGR-FILE-013", "file::allow" unreadable,
            "--allow or --package does not name a folder. Give a folder that exists: --allow DIR, --package NAME=DIR.\n    wrong: --package ur_description=meshes.zip\n    right: --package ur_description=ur_description";
        REVISION = "CGR-FILE-021", "file::revision" unreadable,
            "A robot is named as git:REV:PATH, and git does not give it: there is no repository, no such revision, or no such file in it. The message has the reason. A clone of a CI often has only the newest commit; then fetch the other one.\n    congruent check robots/arm --against git:main";
        STANDARD_INPUT = "CGR-FILE-014", "file::standard_input" unreadable,
            "Two arguments are standard input (-), which can be read only once. Give one of them as a file.\n    wrong: congruent check - --against -\n    right: congruent check - --against arm.urdf";
        KIND = "CGR-FILE-018", "file::kind" unreadable,
            "A file names another file outside its project, which is not of the kind that is expected there: a URDF or SRDF, a robot file, a table of numbers. Nothing of it is shown. Correct the path, or count its folder as the project with --allow to see what is wrong.\n    wrong: urdf = \"../../notes.txt\"\n    right: urdf = \"ur5e.urdf\"";
    }
    xml {
        MALFORMED = "CGR-XML-001", "xml::malformed",
            "The text is not well-formed XML: for example a quote or a bracket is missing, an attribute is given twice, or a closing tag has no opening tag. Correct the place that the message names.\n    wrong: <link name=tool0/>\n    right: <link name=\"tool0\"/>";
        TRUNCATED = "CGR-XML-002", "xml::truncated",
            "The file ends inside an element: it was cut off, or a closing tag is missing. The message names the innermost open element. Copy the file again, or close that element.\n    wrong: <link name=\"tool0\">\n    right: <link name=\"tool0\"/>";
        DTD = "CGR-XML-003", "xml::dtd",
            "The file declares a document type or entities. Entities can read other files and expand to any size, so they are refused. Write the values out.\n    wrong: <!DOCTYPE robot [<!ENTITY r \"0.058\">]> ... radius=\"&r;\"\n    right: radius=\"0.058\"";
        DEPTH = "CGR-XML-004", "xml::depth",
            "Elements are nested deeper than in any robot, which would overflow the stack of a reader. Remove the nesting; such a file is damaged or was made to do harm.\n    wrong: <link><link><link> ... nested 100 times\n    right: <link name=\"forearm_link\"/> beside the other links";
        ATTRIBUTES = "CGR-XML-005", "xml::attributes",
            "An element has more attributes than any robot needs. Remove those that a URDF does not have.\n    wrong: <link a1=\"0\" a2=\"0\" a3=\"0\" ... a300=\"0\"/>\n    right: <link name=\"tool0\"/>";
        ELEMENTS = "CGR-XML-008", "xml::elements",
            "The file has more elements or attributes than any robot, whose tree would fill the memory. Remove what is no part of the robot; such a file is damaged or was made to do harm.\n    congruent describe ur5e.urdf";
        PREFIX = "CGR-XML-006", "xml::prefix",
            "An element or attribute has a prefix (`prefix:name`) that no xmlns attribute declares. Declare the prefix on the root element, or remove it.\n    <robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">";
    }
    toml {
        INVALID = "CGR-TOML-001", "toml::invalid",
            "The text is not valid TOML, or a value has the wrong type. The message says where, and what was expected. Correct that place.\n    wrong: theta_deg = 0,5\n    right: theta_deg = 0.5";
        UNKNOWN_KEY = "CGR-TOML-002", "toml::unknown_key",
            "No such key is known here. Unknown keys are errors, because a misspelt key would otherwise be silently ignored. The help has the most similar key and the known ones.\n    wrong: alfa_deg = 90.0\n    right: alpha_deg = 90.0";
        UNKNOWN_VALUE = "CGR-TOML-003", "toml::unknown_value",
            "The key takes one of several words; this value is not one of them. The help lists the known words.\n    wrong: kind = \"rotary\"\n    right: kind = \"revolute\"";
        MISSING_KEY = "CGR-TOML-004", "toml::missing_key",
            "A required key is missing. The message names it. Add it.\n    wrong: a [[dh.row]] without kind = \"revolute\"\n    right: kind = \"revolute\"";
        BOTH_UNITS = "CGR-TOML-005", "toml::both_units",
            "A quantity is given twice, in two units. Keep exactly one of the keys.\n    wrong: d_m = 0.1625 and d_mm = 162.5\n    right: d_m = 0.1625";
        NOT_FINITE = "CGR-TOML-006", "toml::not_finite",
            "The value is NaN or infinite. Every comparison with NaN is false, so a check could never fail. Write a finite number, or leave the key out if it is optional.\n    wrong: d_m = nan\n    right: d_m = 0.1625";
        TOO_LARGE = "CGR-TOML-011", "toml::too_large",
            "A length or an angle is so large that its last digits are larger than the tolerances of a robot: above 1e6 m or 1e6 rad. Results would be infinite or without meaning. Often the exponent or the unit is wrong. Correct it.\n    wrong: d_m = 1625e10\n    right: d_m = 0.1625";
        HIDDEN_CHARACTER = "CGR-TOML-007", "toml::hidden_character",
            "A name has an invisible character, such as a control character or a mark of writing direction. Names are copied into every output, so it is refused. Type the name again.\n    wrong: joint = \"elbow_joint\\u200b\"\n    right: joint = \"elbow_joint\"";
    }
    cli {
        SET = "CGR-COMMAND-004", "cli::set",
            "--set is not of the form KEY=VALUE, or its key is none of the file. A key is the keys of the file joined by dots; an entry of a list has its number, from 1, or its kind, name or joint. In a scenario, a key that begins with robot. is one of the robot.\n    --set controller.stiffness=500";
    }
    transform {
        CONFLICT = "CGR-TOML-008", "transform::conflict",
            "A transform gives its rotation or its translation by two keys, such as a quaternion and angles. Keep exactly one.\n    wrong: { rpy_deg = [0, 0, 180], quaternion_wxyz = [0, 0, 0, 1] }\n    right: { rpy_deg = [0, 0, 180] }";
        MATRIX = "CGR-TOML-009", "transform::matrix",
            "The matrix of a transform is not a rotation with a translation. Its first three rows must be [R | t] with R orthonormal and right-handed, its last row [0, 0, 0, 1].\n    wrong: matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1]]\n    right: matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";
        QUATERNION_NORM = "CGR-TOML-010", "transform::quaternion_norm",
            "The norm of a quaternion is not 1, so a digit is wrong or missing. It is not silently normalised. The order is w, x, y, z.\n    wrong: quaternion_wxyz = [0.7, 0, 0, 0.7]\n    right: quaternion_wxyz = [0.70710678, 0, 0, 0.70710678]";
    }
    mesh {
        NOT_FOUND = "CGR-MESH-001", "mesh::not_found",
            "The mesh file that the URDF names does not exist. Distances and contacts need every collision mesh; the kinematics do not. Put the file there, correct the path, or name the folder of its package: `--package NAME=DIR` in a call, or packages = { NAME = \"DIR\" } in robot.toml.\n    wrong: <mesh filename=\"wirst3.stl\"/>\n    right: <mesh filename=\"wrist3.stl\"/>";
        NETWORK = "CGR-MESH-005", "mesh::network",
            "The mesh has a network address; the network is never used. Put the mesh beside the URDF and name it by a relative path.\n    wrong: <mesh filename=\"https://example.com/wrist3.stl\"/>\n    right: <mesh filename=\"wrist3.stl\"/>";
        SCHEME = "CGR-MESH-006", "mesh::scheme",
            "The scheme of the mesh address is not known. Known are package://, file:// and relative paths. Write one of these.\n    wrong: <mesh filename=\"model://wrist3.stl\"/>\n    right: <mesh filename=\"package://ur_description/wrist3.stl\"/>";
        OUTSIDE = "CGR-MESH-007", "mesh::outside",
            "With --fence, a mesh outside the project is not opened. Allow its folder with --allow, move the mesh, or leave out --fence.\n    congruent lint robots/ur5e --fence --allow ../ur_description";
        PACKAGE_SLASHES = "CGR-MESH-008", "mesh::package_slashes",
            "The address has three slashes after `package:`, so it names no package. The file was found, but other readers may not find it.\n    package://NAME/meshes/x.stl";
    }
}
