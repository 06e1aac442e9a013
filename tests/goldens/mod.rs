//! Numbers of single commands against independent programs and closed forms.

mod arm_studies;
mod clearance;
mod dynamics;
mod forward;
mod frames;
mod jacobian;
mod mjcf;
mod robots;
mod tolerances;
