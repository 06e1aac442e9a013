//! An ellipsoid as a shape of rapier, which has none: its support points are exact, and so are its contacts.
//!
//! Contacts follow from the support points alone (the methods of Gilbert, Johnson and Keerthi, and of expanding polytopes). A
//! hull of points on the surface would lie inside of it and roll on its facets.

use rapier3d_f64::{
    parry::{
        bounding_volume::{Aabb, BoundingSphere},
        mass_properties::MassProperties,
        query::{PointProjection, PointQuery, Ray, RayCast, RayIntersection, details, gjk::VoronoiSimplex},
        shape::{FeatureId, PolygonalFeature, PolygonalFeatureMap, Shape, ShapeType, SupportMap, TypedShape},
    },
    prelude::Vector,
};

/// An ellipsoid about the origin, its axes along x, y, z.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EllipsoidShape {
    /// Half of its extent along each axis, m; each is above 0.
    pub(crate) semi_axes_m: Vector,
}

impl SupportMap for EllipsoidShape {
    /// It is the unit ball stretched by `S = diag(a, b, c)`: over unit vectors `u` the largest `(S u) . d = u . (S d)` is at
    /// `u = S d / |S d|`.
    fn local_support_point(&self, along: Vector) -> Vector {
        // Along no direction every point is the farthest.
        let on_ball = (self.semi_axes_m * along).try_normalize().unwrap_or(Vector::X);
        self.semi_axes_m * on_ball
    }
}

impl PolygonalFeatureMap for EllipsoidShape {
    /// It has no flat face or edge: a contact is at the one pair of nearest points, which rapier always takes.
    fn local_support_feature(&self, _along: Vector, feature: &mut PolygonalFeature) {
        feature.num_vertices = 0;
    }
}

impl PointQuery for EllipsoidShape {
    fn project_local_point(&self, point: Vector, solid: bool) -> PointProjection {
        details::local_point_projection_on_support_map(self, &mut VoronoiSimplex::new(), point, solid)
    }

    fn project_local_point_and_get_feature(&self, point: Vector) -> (PointProjection, FeatureId) {
        (self.project_local_point(point, false), FeatureId::Unknown)
    }
}

impl RayCast for EllipsoidShape {
    fn cast_local_ray_and_get_normal(
        &self,
        ray: &Ray,
        max_time_of_impact: f64,
        solid: bool,
    ) -> Option<RayIntersection> {
        let mut simplex = VoronoiSimplex::new();
        details::local_ray_intersection_with_support_map_with_params(
            self,
            &mut simplex,
            ray,
            max_time_of_impact,
            solid,
        )
    }
}

impl Shape for EllipsoidShape {
    fn compute_local_aabb(&self) -> Aabb {
        Aabb::new(-self.semi_axes_m, self.semi_axes_m)
    }

    fn compute_local_bounding_sphere(&self) -> BoundingSphere {
        BoundingSphere::new(Vector::ZERO, self.semi_axes_m.max_element())
    }

    fn clone_dyn(&self) -> Box<dyn Shape> {
        Box::new(*self)
    }

    fn scale_dyn(&self, scale: Vector, _subdivisions: u32) -> Option<Box<dyn Shape>> {
        Some(Box::new(Self { semi_axes_m: self.semi_axes_m * scale.abs() }))
    }

    /// None: masses are those of the description, not of shapes.
    fn mass_properties(&self, _density: f64) -> MassProperties {
        MassProperties::default()
    }

    fn shape_type(&self) -> ShapeType {
        ShapeType::Custom
    }

    fn as_typed_shape(&self) -> TypedShape<'_> {
        TypedShape::Custom(self)
    }

    fn ccd_thickness(&self) -> f64 {
        self.semi_axes_m.min_element()
    }

    fn ccd_angular_thickness(&self) -> f64 {
        std::f64::consts::FRAC_PI_2
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn as_support_map(&self) -> Option<&dyn SupportMap> {
        Some(self)
    }

    fn as_polygonal_feature_map(&self) -> Option<(&dyn PolygonalFeatureMap, f64)> {
        Some((self, 0.0))
    }
}
