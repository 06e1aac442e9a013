//! Files of configurations and states of a robot, joints by name, as batch commands read them: JSON in SI units, or a table whose
//! columns have units.

mod beyond_limits;
pub mod codes;
mod live;
mod read;
mod states;
mod table;
mod unique;
mod written;

pub use self::{
    beyond_limits::{outside_limits, outside_limits_warning},
    live::{LiveEntries, LiveInput, LiveState, LiveStates},
    read::{
        Configurations, configuration, configurations_schema, read_configurations, read_configurations_from,
        read_states, read_states_from,
    },
    states::{JointState, JointStateList},
    unique::unique_names,
};
