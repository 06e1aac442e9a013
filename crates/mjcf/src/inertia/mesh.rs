//! Volume and inertia of a mesh, from its triangles: a sum over the pyramids that they make with a common point.

use congruent_input::Diagnostic;
use nalgebra::{Matrix3, Point3, Vector3};

use super::tensor::from_covariance;
use crate::{
    codes,
    model::{MjMesh, MjMeshInertia},
};

/// Smaller volumes and areas are none, m^3 and m^2. Source: `mjMINVAL` of MuJoCo 4.0.
const SMALLEST: f64 = 1e-14;

/// Amount and inertia of a mesh with the density 1.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshMass {
    /// Volume, m^3; area, m^2, if the mass is at the surface.
    pub amount: f64,
    /// Centre of mass in the frame of the mesh, m.
    pub center: Vector3<f64>,
    /// Inertia about the centre, in the axes of the mesh, for the density 1: m^5, or m^4 of a surface.
    pub inertia: Matrix3<f64>,
}

/// Moments of mass so far: amount, first and second moment about a point.
#[derive(Default)]
struct MjMoments {
    amount: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

impl MjMoments {
    /// Those of all simplices about a point, which is a corner of each pyramid.
    fn about(apex: &Vector3<f64>, mesh: &MjMesh, triangles: &[[Point3<f64>; 3]]) -> Self {
        let mirrored = mesh.scale.value.product().signum();
        let mut moments = Self::default();
        for triangle in triangles {
            let corners = triangle.map(|corner| corner.coords - apex);
            let [a, b, c] = &corners;
            let volume = mirrored * a.dot(&b.cross(c)) / 6.0;
            match mesh.inertia {
                MjMeshInertia::Shell => moments.add(&corners, area(triangle), 3.0),
                MjMeshInertia::Exact => moments.add(&corners, volume, 4.0),
                MjMeshInertia::Convex | MjMeshInertia::Legacy => moments.add(&corners, volume.abs(), 4.0),
            }
        }
        moments
    }

    /// Adds a simplex with the given corners and, if it is a pyramid, the point as one more: the integral of `x x'` over a
    /// simplex of n corners is `amount / (n (n + 1)) (sum v v' + s s')` with the sum `s` of the corners.
    fn add(&mut self, corners: &[Vector3<f64>; 3], amount: f64, corner_count: f64) {
        let sum: Vector3<f64> = corners.iter().sum();
        let squares: Matrix3<f64> = corners.iter().map(|corner| corner * corner.transpose()).sum();
        self.amount += amount;
        self.first += sum * (amount / corner_count);
        self.second += (squares + sum * sum.transpose()) * (amount / (corner_count * (corner_count + 1.0)));
    }
}

fn area([a, b, c]: &[Point3<f64>; 3]) -> f64 {
    (b - a).cross(&(c - a)).norm() / 2.0
}

/// Amount, centre and inertia of a mesh by its rule, as MuJoCo 4.0 computes them.
///
/// `triangles` are in the frame of the mesh, m ([`MjMesh::vertex`]), counter-clockwise as in the file, of a mirrored scale, too.
/// For [`MjMeshInertia::Convex`] they must be those of the convex hull.
///
/// Source: J. O'Rourke, *Computational Geometry in C* (1998), sec. 1.3.8.
///
/// # Errors
/// They enclose no volume, or, for an exact inertia, a negative one.
pub fn mesh_mass(mesh: &MjMesh, triangles: &[[Point3<f64>; 3]]) -> Result<MeshMass, Diagnostic> {
    let fault = |what: &str| {
        let message = format!("mesh \"{}\": {what}", mesh.name);
        let help = "give the body an <inertial>, or the mesh inertia=\"shell\"";
        mesh.place.fault(codes::mjcf::MESH_INERTIA, message).with_help(help)
    };
    let total_area: f64 = triangles.iter().map(area).sum();
    if total_area < SMALLEST {
        return Err(fault("its triangles have no area"));
    }
    // The common point is the centroid of the surface, as in MuJoCo: it matters where the sum is not signed.
    let weighted = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle;
        (a.coords + b.coords + c.coords) * (area(triangle) / 3.0)
    });
    let apex = weighted.sum::<Vector3<f64>>() / total_area;
    let moments = MjMoments::about(&apex, mesh, triangles);
    if moments.amount < -SMALLEST {
        return Err(fault("its volume is negative: its triangles are clockwise in an outer view"));
    }
    if moments.amount < SMALLEST {
        return Err(fault("it encloses no volume"));
    }
    let center = moments.first / moments.amount;
    if mesh.inertia == MjMeshInertia::Legacy {
        // MuJoCo first moves the mesh to this centre and then sums again. Of pyramids without sign the sum depends on their common
        // point, so the centre does not move a second time: 5e-4 of the mass of a hollow part.
        let again = MjMoments::about(&(apex + center), mesh, triangles);
        let inertia = from_covariance(&again.second);
        return Ok(MeshMass { amount: again.amount, center: apex + center, inertia });
    }
    let about_center = moments.second - center * center.transpose() * moments.amount;
    Ok(MeshMass { amount: moments.amount, center: apex + center, inertia: from_covariance(&about_center) })
}
