//! Resolves a checked tree of elements: what each value is, in which frame and unit, and where it comes from.

mod actuator;
mod attach;
mod attributes;
mod constraint;
mod geom;
mod inertial;
mod joint;
mod keyframe;
mod mesh;
mod names;
mod orientation;
mod reader;
mod scope;
mod site;
mod tree;

use std::sync::Arc;

use congruent_input::{Diagnostics, SourceFile};

use crate::{ReadFile, document::Assembly, inertia::moving_body_without_mass, model::MjModel};
pub(crate) use orientation::orientation_of;
use reader::MjReader;
use scope::MjScope;

/// Reads a model and what it names; a model that is returned beside an error may be incomplete.
pub(crate) fn model(
    main: &Arc<SourceFile>,
    include: &mut ReadFile<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<MjModel> {
    let mut files = vec![Arc::clone(main)];
    let mut recorded = |path: &str| {
        let file = include(path)?;
        files.push(Arc::clone(&file));
        Ok(file)
    };
    let mut assembly = Assembly::new(&mut recorded, diagnostics);
    let scope = MjScope::load(main, "", &mut assembly, 0)?;
    if diagnostics.has_error() {
        return None;
    }
    let model = MjReader::read(&scope, diagnostics)?;
    if !diagnostics.has_error() {
        for body in moving_body_without_mass(&model) {
            diagnostics.push(inertial::massless(&model.bodies[body]));
        }
    }
    Some(MjModel { files, ..model })
}
