//! Volume, area and inertia of primitives, closed forms. The mass is in the volume, or at the surface.

use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::model::MjShape;

/// Volume or area, and moments for a mass of 1 about the centre, in the axes of the geom.
pub(super) struct MjPrimitive {
    /// Volume, m^3, or area, m^2.
    pub(super) amount: f64,
    /// Moments per mass, m^2.
    pub(super) moments_per_mass: Vector3<f64>,
}

/// Where the mass of a geom is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MjFill {
    Volume,
    Surface,
}

/// `None` for what is no primitive.
pub(super) fn primitive(shape: &MjShape, fill: MjFill) -> Option<MjPrimitive> {
    let parts = match *shape {
        MjShape::Plane | MjShape::HeightField => {
            return Some(MjPrimitive { amount: 0.0, moments_per_mass: Vector3::zeros() });
        }
        MjShape::Sphere { radius } => sphere(radius, fill),
        MjShape::Capsule { radius, half_length } => capsule(radius, half_length, fill),
        MjShape::Cylinder { radius, half_length } => cylinder(radius, half_length, fill),
        MjShape::Ellipsoid { radii } => ellipsoid(radii, fill),
        MjShape::Box { half_sizes } => cuboid(half_sizes, fill),
        MjShape::Mesh { .. } | MjShape::Fitted { .. } => return None,
    };
    Some(parts)
}

/// Parts of one centre: amounts add, and moments by their amounts.
fn joined(parts: &[(f64, Vector3<f64>)]) -> MjPrimitive {
    let amount: f64 = parts.iter().map(|(amount, _)| amount).sum();
    let moments: Vector3<f64> = parts.iter().map(|(amount, moments)| moments * *amount).sum();
    MjPrimitive { amount, moments_per_mass: moments / amount }
}

fn sphere(radius: f64, fill: MjFill) -> MjPrimitive {
    let square = radius * radius;
    let (amount, moment) = if fill == MjFill::Surface {
        (4.0 * PI * square, 2.0 / 3.0)
    } else {
        (4.0 / 3.0 * PI * square * radius, 0.4)
    };
    MjPrimitive { amount, moments_per_mass: Vector3::repeat(moment * square) }
}

/// Moments of a body that is round about z.
fn round(across: f64, along: f64) -> Vector3<f64> {
    Vector3::new(across, across, along)
}

/// A cylinder and two half spheres, whose centres of mass are 3/8 of the radius (half of it for shells) above the ends.
fn capsule(radius: f64, half_length: f64, fill: MjFill) -> MjPrimitive {
    let (square, l) = (radius * radius, half_length);
    if fill == MjFill::Surface {
        let side = (4.0 * PI * radius * l, round(square / 2.0 + l * l / 3.0, square));
        let ends = round(2.0 / 3.0 * square + l * l + l * radius, 2.0 / 3.0 * square);
        return joined(&[side, (4.0 * PI * square, ends)]);
    }
    let middle = (2.0 * PI * square * l, round(square / 4.0 + l * l / 3.0, square / 2.0));
    let ends = round(0.4 * square + l * l + 0.75 * l * radius, 0.4 * square);
    joined(&[middle, (4.0 / 3.0 * PI * square * radius, ends)])
}

fn cylinder(radius: f64, half_length: f64, fill: MjFill) -> MjPrimitive {
    let (square, l) = (radius * radius, half_length);
    if fill == MjFill::Surface {
        let side = (4.0 * PI * radius * l, round(square / 2.0 + l * l / 3.0, square));
        return joined(&[side, (2.0 * PI * square, round(square / 4.0 + l * l, square / 2.0))]);
    }
    MjPrimitive {
        amount: 2.0 * PI * square * l,
        moments_per_mass: round(square / 4.0 + l * l / 3.0, square / 2.0),
    }
}

/// Moments of second moments along the three axes.
fn from_squares(squares: Vector3<f64>) -> Vector3<f64> {
    Vector3::repeat(squares.sum()) - squares
}

fn cuboid(half_sizes: [f64; 3], fill: MjFill) -> MjPrimitive {
    let half = Vector3::from(half_sizes);
    let squares = half.component_mul(&half);
    if fill == MjFill::Volume {
        return MjPrimitive { amount: 8.0 * half.product(), moments_per_mass: from_squares(squares / 3.0) };
    }
    // Two faces for each axis: spread over the other two, at half the size along their own.
    let faces = [0, 1, 2].map(|axis| {
        let mut face = squares / 3.0;
        face[axis] = squares[axis];
        (8.0 * half.product() / half[axis], from_squares(face))
    });
    joined(&faces)
}

fn ellipsoid(radii: [f64; 3], fill: MjFill) -> MjPrimitive {
    /// Exponent of Thomsen's approximation of the area, within 1.1 %. MuJoCo uses the same.
    const THOMSEN: f64 = 1.6075;
    /// Thickness of the layer whose inertia is that of a shell, m. MuJoCo uses the same.
    const LAYER_M: f64 = 1e-6;
    let radii = Vector3::from(radii);
    let volume = |radii: &Vector3<f64>| 4.0 / 3.0 * PI * radii.product();
    let moments = |radii: &Vector3<f64>| from_squares(radii.component_mul(radii) / 5.0);
    if fill == MjFill::Volume {
        return MjPrimitive { amount: volume(&radii), moments_per_mass: moments(&radii) };
    }
    let power = |product: f64| libm::pow(product, THOMSEN);
    let mean = (power(radii.x * radii.y) + power(radii.x * radii.z) + power(radii.y * radii.z)) / 3.0;
    let outer = radii.add_scalar(LAYER_M);
    let layer = volume(&outer) - volume(&radii);
    MjPrimitive {
        amount: 4.0 * PI * libm::pow(mean, 1.0 / THOMSEN),
        moments_per_mass: (moments(&outer) * volume(&outer) - moments(&radii) * volume(&radii)) / layer,
    }
}

#[cfg(test)]
mod tests {
    use super::{MjFill::*, *};

    /// Mass and moments of shapes of the sizes 0.1, 0.2, 0.3 with the density 7, by MuJoCo 4.0.0.
    #[test]
    fn primitives_are_those_of_mujoco() {
        let half_sizes = [0.1, 0.2, 0.3];
        let capsule = MjShape::Capsule { radius: 0.1, half_length: 0.2 };
        let cylinder = MjShape::Cylinder { radius: 0.1, half_length: 0.2 };
        let cuboid = MjShape::Box { half_sizes };
        let ellipsoid = MjShape::Ellipsoid { radii: half_sizes };
        let sphere = MjShape::Sphere { radius: 0.1 };
        for (shape, fill, mass, moments) in [
            (&sphere, Surface, 0.879_645_94, [5.864_306_29e-3; 3]),
            (&sphere, Volume, 0.029_321_531_4, [1.172_861_257e-4; 3]),
            (&capsule, Surface, 2.638_937_83, [0.090_896_747_4, 0.090_896_747_4, 0.023_457_225_1]),
            (&capsule, Volume, 0.117_286_126, [3.122_743_10e-3, 3.122_743_10e-3, 5.571_090_97e-4]),
            (&cylinder, Surface, 2.199_114_86, [0.050_946_160_9, 0.050_946_160_9, 0.019_792_033_7]),
            (&cylinder, Volume, 0.087_964_594_3, [1.392_772_743e-3, 1.392_772_743e-3, 4.398_229_715e-4]),
            (&cuboid, Surface, 6.16, [0.378_933_333_3, 0.294_933_333_3, 0.169_866_666_7]),
            (&cuboid, Volume, 0.336, [0.014_56, 0.0112, 0.0056]),
            (&ellipsoid, Surface, 3.428_035_33, [0.126_526_224, 0.098_478_566_0, 0.056_718_766_6]),
            (&ellipsoid, Volume, 0.175_929_189, [4.574_158_904e-3, 3.518_583_772e-3, 1.759_291_886e-3]),
        ] {
            /// Relative. Kind: golden digits, nine; for the layer of a shell also cancellation, 1e-16 / 1e-5.
            const DIGITS: f64 = 5e-8;
            let found = primitive(shape, fill).unwrap();
            let near = |found: f64, expected: f64| (found / expected - 1.0).abs() < DIGITS;
            let found_mass = 7.0 * found.amount;
            assert!(near(found_mass, mass), "{shape:?}: {found_mass} instead of {mass}");
            for (found, expected) in (found.moments_per_mass * found_mass).iter().zip(moments) {
                assert!(near(*found, expected), "{shape:?}, {fill:?}: {found} instead of {expected}");
            }
        }
    }
}
