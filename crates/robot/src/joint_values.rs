//! Joint values by name, in the order of the robot: one shape in every answer.

use std::{borrow::Cow, fmt};

use congruent_input::display::position;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{MapAccess, Visitor},
};

use super::robot::Robot;

/// One value for each joint, base to tip; a map in JSON.
///
/// # Examples
/// ```
/// use congruent_description::JointValues;
/// let names = ["shoulder".to_owned(), "elbow".to_owned()];
/// let q = JointValues::new(&names, &[0.25, 1.5]);
/// assert_eq!(q.iter().next(), Some(("shoulder", 0.25)));
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointValues(Vec<(String, f64)>);

impl JointValues {
    /// Pairs names with values, in rad or m.
    pub fn new(names: &[String], values: &[f64]) -> Self {
        names.iter().cloned().zip(values.iter().copied()).collect()
    }

    /// The values of all movable joints of a robot, in its order.
    pub fn for_movable_joints(robot: &Robot, values: &[f64]) -> Self {
        robot.movable_joint_names().map(str::to_owned).zip(values.iter().copied()).collect()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Joints and values, base to tip.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.0.iter().map(|(name, value)| (name.as_str(), *value))
    }

    /// All of them in one line for people, in deg and mm to two decimals by the kind of each joint of `robot`.
    ///
    /// # Examples
    /// ```
    /// use congruent_description::{JointValues, parse_urdf};
    /// let robot = parse_urdf(
    ///     "<robot name='r'><link name='base'/><link name='tip'/>
    ///     <joint name='lift' type='prismatic'><parent link='base'/><child link='tip'/>
    ///     <limit lower='0' upper='1' velocity='1' effort='1'/></joint></robot>",
    /// )
    /// .unwrap();
    /// assert_eq!(JointValues::for_movable_joints(&robot, &[0.25]).for_people(&robot), "lift 250 mm");
    /// ```
    pub fn for_people(&self, robot: &Robot) -> String {
        let unit = |joint: &str| robot.find_joint(joint).map_or("", |joint| robot.joint(joint).kind.unit());
        let each: Vec<String> =
            self.iter().map(|(joint, value)| format!("{joint} {}", position(value, unit(joint)))).collect();
        each.join(", ")
    }
}

impl FromIterator<(String, f64)> for JointValues {
    fn from_iter<I: IntoIterator<Item = (String, f64)>>(values: I) -> Self {
        Self(values.into_iter().collect())
    }
}

impl Serialize for JointValues {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}

impl<'de> Deserialize<'de> for JointValues {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InOrder;

        impl<'de> Visitor<'de> for InOrder {
            type Value = JointValues;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("one value for each joint by name")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut values = Vec::new();
                while let Some(value) = map.next_entry()? {
                    values.push(value);
                }
                Ok(JointValues(values))
            }
        }

        deserializer.deserialize_map(InOrder)
    }
}

impl JsonSchema for JointValues {
    fn schema_name() -> Cow<'static, str> {
        "JointValues".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "object",
            "description": "One value for each joint by name, in rad or m",
            "additionalProperties": { "type": ["number", "null"] }
        })
    }
}
