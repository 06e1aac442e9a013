//! `congruent calibrate`: corrections estimated from measurements, their verdicts, and measurements that are refused.

mod estimates;
mod input;
mod same_point;
mod verdicts;
mod written_robot;
