//! One value of a link or joint in place of the present one.

use congruent_input::{Diagnostic, Override, known_names, rotation_from_rpy_fixed_xyz, rpy_fixed_xyz_rad};

use crate::{Inertia, Joint, JointRounding, Link, Robot};

/// Keys of a link, as of `link.forearm_link.mass_kg`.
const LINK_KEYS: [&str; 2] = ["mass_kg", "com_m"];
/// Keys of a joint, as of `joint.elbow_joint.friction`.
const JOINT_KEYS: [&str; 6] = ["damping", "friction", "armature", "xyz_m", "rpy_rad", "rpy_deg"];

impl Robot {
    /// Whether a value is one of a link or joint (`link.NAME.KEY`), as [`Robot::with_value`] takes it.
    pub fn has_value(change: &Override) -> bool {
        matches!(change.path().next(), Some("link" | "joint"))
    }

    /// The robot with one value of a link or joint replaced.
    ///
    /// | key | value | unit |
    /// |---|---|---|
    /// | `link.NAME.mass_kg` | mass; the inertia tensor grows with it, as if the density changed | kg |
    /// | `link.NAME.com_m` | centre of mass in the link; `com_m.1` to `com_m.3` are its coordinates | m |
    /// | `joint.NAME.damping`, `friction`, `armature` | viscous damping, dry friction, inertia of motor and gear | as in URDF |
    /// | `joint.NAME.xyz_m`, `rpy_rad`, `rpy_deg` | origin of the joint in its parent link; `xyz_m.1` is a coordinate | m, rad, deg |
    ///
    /// # Errors
    /// There is no such key, link or joint, or the value is of another kind; the help has the nearest name.
    pub fn with_value(&self, change: &Override) -> Result<Self, Diagnostic> {
        let path: Vec<&str> = change.path().collect();
        let (kind, name, key, entry) = match path[..] {
            [kind, name, key] => (kind, name, key, None),
            [kind, name, key, entry] => (kind, name, key, Some(entry)),
            _ => return Err(change.refused("expected link.NAME.KEY or joint.NAME.KEY")),
        };
        let set = SetValue { change, key, entry };
        if kind == "link" {
            let names = self.links().iter().map(|link| link.name.as_str());
            let link = self.find_link(name).ok_or_else(|| unknown(change, "link", name, names))?;
            let changed = set.in_link(self.link(link)).map_err(|why| change.refused(&why))?;
            return Ok(self.clone().with_inertia(link, changed));
        }
        let names = self.joints().iter().map(|joint| joint.name.as_str());
        let joint = self.find_joint(name).ok_or_else(|| unknown(change, "joint", name, names))?;
        let changed = set.in_joint(self.joint(joint)).map_err(|why| change.refused(&why))?;
        Ok(self.with_joints(|each| {
            if each.name == name {
                *each = changed.clone();
            }
        }))
    }
}

/// A value for a key of a link or joint; `entry` counts a coordinate from 1.
struct SetValue<'a> {
    change: &'a Override,
    key: &'a str,
    entry: Option<&'a str>,
}

impl SetValue<'_> {
    /// The inertia of a link with another mass or centre of mass.
    fn in_link(&self, link: &Link) -> Result<Inertia, String> {
        let mut inertia = link.inertia.ok_or("the link has no inertia")?;
        match self.key {
            "mass_kg" => {
                let mass_kg = self.not_negative()?;
                if inertia.mass_kg <= 0.0 {
                    return Err(
                        "the link has no mass, so it has no inertia that could grow with it".to_owned()
                    );
                }
                inertia.tensor_kg_m2 *= mass_kg / inertia.mass_kg;
                inertia.mass_kg = mass_kg;
            }
            "com_m" => {
                let com_m = &mut inertia.link_from_inertial.translation.vector;
                *com_m = self.change.coordinates((*com_m).into(), self.entry)?.into();
            }
            other => return Err(known_names(other, "keys of a link", LINK_KEYS)),
        }
        Ok(inertia)
    }

    fn in_joint(&self, joint: &Joint) -> Result<Joint, String> {
        let mut joint = joint.clone();
        match self.key {
            "damping" => joint.damping = self.not_negative()?,
            "friction" => joint.friction = self.not_negative()?,
            "armature" => joint.armature = Some(self.not_negative()?),
            "xyz_m" | "rpy_rad" | "rpy_deg" => self.in_origin(&mut joint)?,
            other => return Err(known_names(other, "keys of a joint", JOINT_KEYS)),
        }
        Ok(joint)
    }

    fn in_origin(&self, joint: &mut Joint) -> Result<(), String> {
        let origin = &mut joint.parent_from_joint;
        let coordinates = |before: [f64; 3]| self.change.coordinates(before, self.entry);
        let rpy_rad = rpy_fixed_xyz_rad(origin);
        match self.key {
            "xyz_m" => origin.translation.vector = coordinates(origin.translation.vector.into())?.into(),
            "rpy_rad" => origin.rotation = rotation_from_rpy_fixed_xyz(coordinates(rpy_rad)?),
            _ => {
                let rpy_deg = coordinates(rpy_rad.map(f64::to_degrees))?;
                origin.rotation = rotation_from_rpy_fixed_xyz(rpy_deg.map(f64::to_radians));
            }
        }
        // The digits of the file say nothing about the new value.
        joint.rounding = JointRounding::default();
        Ok(())
    }

    fn not_negative(&self) -> Result<f64, String> {
        let number = self.change.number()?;
        if number >= 0.0 { Ok(number) } else { Err(format!("{number} is negative")) }
    }
}

fn unknown<'a>(
    change: &Override,
    what: &str,
    name: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> Diagnostic {
    let names: Vec<&str> = names.into_iter().collect();
    change.refused(&format!("the robot has no {what} \"{name}\"")).with_help(known_names(
        name,
        &format!("{what}s"),
        names,
    ))
}
