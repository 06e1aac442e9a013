//! The physics twin: a rapier multibody built from a robot description.
