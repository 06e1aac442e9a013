//! `congruent check`: two models of a robot compared, the cause of a difference, and the change that removes it.

mod configurations;
mod corrected_file;
mod declared_digits;
mod declared_mapping;
mod diagnosis;
mod diagnosis_chains;
mod digits;
mod digits_of_two;
mod dynamics;
mod dynamics_causes;
mod fused_links;
mod joint_losses;
mod joint_origins;
mod mapping;
mod mimics;
mod mjcf_edits;
mod other_frames;
mod planted_dynamics;
mod public_pairs;
mod published_tables;
mod ranges_of_variables;
mod revisions;
mod second_source;
mod stated;
mod suggestions;
mod unranged_slides;
