//! Links of large machines, such as cranes and masts: values that would be a unit mistake in an arm are plausible for them.

use congruent_input::{Diagnostic, Severity};
use congruent_robot::{Extent, Link, LinkIndex, Robot};

use crate::codes;

/// Diagonal of the shapes, m; smaller links are treated as those of arms.
const LEAST_LARGE_M: f64 = 4.0;
/// Mass over the volume of the box around the shapes, kg/m^3. A lattice mast has some 30, steel 7900; lengths that are in cm or
/// mm make it a millionth or less.
const DENSITY: [f64; 2] = [2.0, 2e4];
/// Radius of gyration in diagonals: a rod has 0.29, two masses at its ends 0.5.
const MOST_GYRATION: f64 = 0.7;
/// Largest distance of a centre of mass or a joint origin from the shapes of a large link, in diagonals.
const FARTHEST: f64 = 0.3;

/// The links whose shapes, mass, centre of mass and inertia are all consistent with a large size; for each the box around its
/// shapes.
pub struct LargeLinks(Vec<Option<Extent>>);

impl LargeLinks {
    /// Examines every link of a robot.
    pub fn find(robot: &Robot) -> Self {
        Self(robot.links().iter().map(large).collect())
    }

    /// The box around the shapes of a link, if it is large.
    pub fn get(&self, link: LinkIndex) -> Option<&Extent> {
        self.0[link.get()].as_ref()
    }

    /// The longest diagonal; 0 without large links.
    pub fn longest_m(&self) -> f64 {
        self.0.iter().flatten().map(Extent::diagonal_m).fold(0.0, f64::max)
    }
}

fn large(link: &Link) -> Option<Extent> {
    let shapes = link.visuals.iter().chain(&link.collisions);
    let extent = shapes.filter_map(Extent::of_shape).reduce(Extent::with)?;
    let (inertia, size_m) = (link.inertia.as_ref()?, extent.diagonal_m());
    // The trace of an inertia is twice that of the second moments.
    let gyration_m = (inertia.tensor_kg_m2.trace() / 2.0 / inertia.mass_kg).sqrt();
    // Size, density, gyration and centre of mass together: a unit mistake in one of them would contradict the others.
    let is_whole = size_m > LEAST_LARGE_M
        && (DENSITY[0]..DENSITY[1]).contains(&(inertia.mass_kg / extent.volume_m3()))
        && gyration_m < MOST_GYRATION * size_m
        && extent.distance_m(inertia.link_from_inertial.translation.vector) < FARTHEST * size_m;
    is_whole.then_some(extent)
}

/// The findings of the reader without the warnings of sizes that are plausible for large links.
pub(crate) fn without_large_links(robot: &Robot, found: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let of_sizes = |found: &Diagnostic| {
        [codes::urdf::MILLIMETRES, codes::urdf::CENTER_OF_MASS, codes::urdf::INERTIA_SIZE]
            .contains(&found.code)
            && found.severity == Severity::Warning
    };
    // Bounds of all shapes cost a pass over all vertices: only if a warning depends on them.
    if !found.iter().any(of_sizes) {
        return found;
    }
    let large = LargeLinks::find(robot);
    let links = robot.link_indices().filter(|&link| large.get(link).is_some());
    let links = links.flat_map(|link| {
        let name = &robot.link(link).name;
        [name.clone(), format!("link \"{name}\"")]
    });
    let joints = robot.joints().iter().filter(|joint| {
        let origin = joint.parent_from_joint.translation.vector;
        large
            .get(joint.parent)
            .is_some_and(|extent| extent.distance_m(origin) < FARTHEST * extent.diagonal_m())
    });
    let names: Vec<String> = links.chain(joints.map(|joint| format!("joint \"{}\"", joint.name))).collect();
    let remaining = |found: Diagnostic| {
        if !of_sizes(&found) {
            return Some(found);
        }
        names.iter().try_fold(found, |found, name| found.without(name))
    };
    found.into_iter().filter_map(remaining).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::load::parse_robot;
    use congruent_input::SourceFile;

    /// A lattice mast of 40 m with 8 t, and a jib on top.
    const CRANE: &str = "<robot name='crane'><link name='mast'>\
        <inertial><origin xyz='0 0 20'/><mass value='8000'/>\
        <inertia ixx='1.07e6' ixy='0' ixz='0' iyy='1.07e6' iyz='0' izz='5300'/></inertial>\
        <visual><origin xyz='0 0 20'/><geometry><box size='2 2 40'/></geometry></visual></link>\
        <link name='jib'><inertial><origin xyz='12 0 0'/><mass value='3000'/>\
        <inertia ixx='1000' ixy='0' ixz='0' iyy='2.3e5' iyz='0' izz='2.3e5'/></inertial>\
        <visual><origin xyz='12 0 0'/><geometry><box size='30 1 1'/></geometry></visual></link>\
        <joint name='slew' type='continuous'><origin xyz='0 0 40'/><parent link='mast'/><child link='jib'/>\
        <limit velocity='0.1' effort='1e5'/></joint></robot>";

    fn findings(urdf: &str) -> Vec<String> {
        let source =
            Arc::new(SourceFile { path: "crane.urdf".into(), text: urdf.to_owned(), is_foreign: false });
        parse_robot(None, &source).unwrap().warnings.into_iter().map(|found| found.message).collect()
    }

    #[test]
    fn a_large_machine_is_not_reported_and_its_mistakes_are() {
        assert_eq!(findings(CRANE), [""; 0]);
        for (from, to, what) in [
            ("xyz='0 0 40'/><parent", "xyz='0 0 40000'/><parent", "joint \"slew\""),
            ("xyz='12 0 0'/><mass", "xyz='1200 0 0'/><mass", "link \"jib\""),
            ("iyy='2.3e5' iyz='0' izz='2.3e5'", "iyy='2.3e11' iyz='0' izz='2.3e11'", "link \"jib\""),
            // In grams per length in cm: no longer one body.
            ("mass value='8000'", "mass value='8'", "link \"mast\""),
        ] {
            assert!(CRANE.contains(from), "{from}");
            let found = findings(&CRANE.replace(from, to));
            assert!(found.iter().any(|message| message.contains(what)), "{to}: {found:?}");
        }
    }
}
