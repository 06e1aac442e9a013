//! One value of a link or joint in place of the present one.

use congruent_input::{
    Diagnostic, NumberAt, Override, known_names, rotation_from_rpy_fixed_xyz, rpy_fixed_xyz_rad,
};

use crate::{Inertia, Joint, JointIndex, JointKind, JointRounding, Link, LinkIndex, Robot};

/// Keys of a link, as of `link.forearm_link.mass_kg`.
const LINK_KEYS: [&str; 2] = ["mass_kg", "com_m"];
/// Keys of a joint, as of `joint.elbow_joint.friction`.
const JOINT_KEYS: [&str; 6] = ["damping", "friction", "armature", "xyz_m", "rpy_rad", "rpy_deg"];

impl Robot {
    /// Whether a value is one of a link or joint (`link.NAME.KEY`), as [`Robot::with_value`] takes it.
    pub fn has_value(change: &Override) -> bool {
        matches!(change.path().next(), Some("link" | "joint"))
    }

    /// The numbers under a key of a link or joint: one, or three coordinates, each with a key of its own.
    ///
    /// # Errors
    /// There is no such key, link or joint; the help has the nearest name.
    pub fn numbers_at(&self, key: &Override) -> Result<Vec<NumberAt>, Diagnostic> {
        let path: Vec<&str> = key.path().collect();
        let written = path.join(".");
        let (part, entry) = self.value_at(key)?;
        let numbers: Vec<f64> = match part {
            PartValue::Number(number) => vec![number],
            PartValue::Coordinates(coordinates) => coordinates.into(),
        };
        let Some(entry) = entry else {
            if let [number] = numbers[..] {
                return Ok(vec![NumberAt { key: written, value: number }]);
            }
            let entries = (1..).zip(numbers);
            return Ok(entries
                .map(|(at, value): (usize, f64)| NumberAt { key: format!("{written}.{at}"), value })
                .collect());
        };
        let at = entry.parse::<usize>().ok().and_then(|at| at.checked_sub(1));
        let value = at.and_then(|at| numbers.get(at)).filter(|_| numbers.len() > 1);
        let value = value.ok_or_else(|| key.refused(&format!("\"{entry}\" is no entry from 1 to 3")))?;
        Ok(vec![NumberAt { key: written, value: *value }])
    }

    /// The present value under a key, and the entry of it that the key names.
    fn value_at<'k>(&self, key: &'k Override) -> Result<(PartValue, Option<&'k str>), Diagnostic> {
        let PartKey { kind, name, key: of, entry } = PartKey::new(key)?;
        let found = if kind == "link" {
            let link = self.link(self.named_link(key, name)?);
            let inertia = link.inertia.as_ref().ok_or_else(|| key.refused("the link has no inertia"))?;
            match of {
                "mass_kg" => PartValue::Number(inertia.mass_kg),
                "com_m" => PartValue::Coordinates(inertia.link_from_inertial.translation.vector.into()),
                other => return Err(key.refused(&known_names(other, "keys of a link", LINK_KEYS))),
            }
        } else {
            let joint = self.joint(self.named_joint(key, name)?);
            let origin = &joint.parent_from_joint;
            match of {
                "damping" => PartValue::Number(joint.damping),
                "friction" => PartValue::Number(joint.friction),
                "armature" => PartValue::Number(joint.armature.unwrap_or(0.0)),
                "xyz_m" => PartValue::Coordinates(origin.translation.vector.into()),
                "rpy_rad" => PartValue::Coordinates(rpy_fixed_xyz_rad(origin)),
                "rpy_deg" => PartValue::Coordinates(rpy_fixed_xyz_rad(origin).map(f64::to_degrees)),
                other => return Err(key.refused(&known_names(other, "keys of a joint", JOINT_KEYS))),
            }
        };
        Ok((found, entry))
    }

    /// Refuses two values of one property of a link or joint: which of them is meant is not known.
    ///
    /// # Errors
    /// The second of the two, which names the first.
    pub fn refuse_repeated(changes: &[&Override]) -> Result<(), Diagnostic> {
        let keys = changes.iter().map(|change| Ok((*change, PartKey::new(change)?)));
        let keys: Vec<(&Override, PartKey<'_>)> = keys.collect::<Result<_, Diagnostic>>()?;
        let again = keys.iter().enumerate().find_map(|(at, (change, key))| {
            let is_same = |of: &&(&Override, PartKey<'_>)| of.1.shares_value(key) && of.0.excludes(change);
            keys[..at].iter().find(is_same).map(|(before, _)| (before, change))
        });
        again.map_or(Ok(()), |(before, change)| {
            Err(change.refused(&format!("the same value is set by {before}")))
        })
    }

    fn named_link(&self, key: &Override, name: &str) -> Result<LinkIndex, Diagnostic> {
        let names = self.links().iter().map(|link| link.name.as_str());
        self.find_link(name).ok_or_else(|| unknown(key, "link", name, names))
    }

    fn named_joint(&self, key: &Override, name: &str) -> Result<JointIndex, Diagnostic> {
        let names = self.joints().iter().map(|joint| joint.name.as_str());
        self.find_joint(name).ok_or_else(|| unknown(key, "joint", name, names))
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
        let PartKey { kind, name, key, entry } = PartKey::new(change)?;
        let set = SetValue { change, key, entry };
        if kind == "link" {
            let link = self.named_link(change, name)?;
            let changed = set.in_link(self.link(link)).map_err(|why| change.refused(&why))?;
            return Ok(self.clone().with_inertia(link, changed));
        }
        let joint = self.named_joint(change, name)?;
        let changed = set.in_joint(self.joint(joint)).map_err(|why| change.refused(&why))?;
        Ok(self.with_joints(|each| {
            if each.name == name {
                *each = changed.clone();
            }
        }))
    }
}

/// The parts of a key: `link.NAME.com_m.1`.
struct PartKey<'a> {
    kind: &'a str,
    name: &'a str,
    key: &'a str,
    /// Counts a coordinate from 1.
    entry: Option<&'a str>,
}

impl<'a> PartKey<'a> {
    fn new(key: &'a Override) -> Result<Self, Diagnostic> {
        let path: Vec<&str> = key.path().collect();
        match path[..] {
            [kind, name, of] => Ok(Self { kind, name, key: of, entry: None }),
            [kind, name, of, entry] => Ok(Self { kind, name, key: of, entry: Some(entry) }),
            _ => Err(key.refused("expected link.NAME.KEY or joint.NAME.KEY")),
        }
    }
}

impl PartKey<'_> {
    /// What the key is of, by whichever unit.
    fn property(&self) -> &str {
        if self.key.starts_with("rpy_") { "rpy" } else { self.key }
    }

    /// Whether two keys are of one value: of one property, by whichever unit, and of one entry of it or of all.
    fn shares_value(&self, other: &Self) -> bool {
        let is_one_entry = self.entry.is_none() || other.entry.is_none() || self.entry == other.entry;
        self.kind == other.kind
            && self.name == other.name
            && self.property() == other.property()
            && is_one_entry
    }
}

/// A value of a link or joint.
enum PartValue {
    Number(f64),
    Coordinates([f64; 3]),
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
        if joint.kind == JointKind::Fixed && ["damping", "friction", "armature"].contains(&self.key) {
            return Err(format!("the joint is fixed, so its {} has no effect", self.key));
        }
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
        if let Some(entry) = self.entry {
            return Err(format!("\"{}\" is one number, without an entry \"{entry}\"", self.key));
        }
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
