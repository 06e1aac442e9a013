//! The types of the messages that are written, as `rosidl` defines them: without their texts no viewer decodes a message.
//!
//! Source: `common_interfaces`, `geometry2` and `rcl_interfaces` of ROS 2 Jazzy; names, types and order of the fields.

const TIME: &str = "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
const HEADER: &str = "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";
/// Between the definition of a type and those of the types that it uses.
const SEPARATOR: &str = "================================================================================\n";

/// A type of messages.
pub(super) struct Schema {
    pub(super) name: &'static str,
    fields: &'static str,
    uses: &'static [&'static str],
}

impl Schema {
    /// The definition with those of all types that it uses.
    pub(super) fn text(&self) -> String {
        let used = self.uses.iter().map(|used| format!("{SEPARATOR}{used}"));
        std::iter::once(self.fields.to_owned()).chain(used).collect()
    }
}

pub(super) const JOINT_STATE: Schema = Schema {
    name: "sensor_msgs/msg/JointState",
    fields: "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n",
    uses: &[HEADER, TIME],
};

pub(super) const TRANSFORMS: Schema = Schema {
    name: "tf2_msgs/msg/TFMessage",
    fields: "geometry_msgs/TransformStamped[] transforms\n",
    uses: &[
        "MSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring child_frame_id\nTransform transform\n",
        "MSG: geometry_msgs/Transform\nVector3 translation\nQuaternion rotation\n",
        "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n",
        "MSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n",
        HEADER,
        TIME,
    ],
};

pub(super) const TEXT: Schema = Schema { name: "std_msgs/msg/String", fields: "string data\n", uses: &[] };

pub(super) const DIAGNOSTICS: Schema = Schema {
    name: "diagnostic_msgs/msg/DiagnosticArray",
    fields: "std_msgs/Header header\nDiagnosticStatus[] status\n",
    uses: &[
        "MSG: diagnostic_msgs/DiagnosticStatus\nbyte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\n\
         string name\nstring message\nstring hardware_id\nKeyValue[] values\n",
        "MSG: diagnostic_msgs/KeyValue\nstring key\nstring value\n",
        HEADER,
        TIME,
    ],
};
