//! The bodies whose parameters are estimated, and how well they are known before.

use congruent_dynamics::{PARAMETERS, SpatialInertia};
use nalgebra::{Matrix3, SMatrix, Vector3};

use crate::{
    equations::RecordedEquations,
    pseudo_inertia::{Parameters, is_body, metric},
    unknowns::{FreeGroup, FreeUnknowns, PayloadPlace, UnknownOrder},
};

/// A payload is thought to be a ball of this mass and radius, times ten: what nothing in the recording says stays near none. kg and m;
/// kind: choice.
const PAYLOAD_KG: f64 = 1.0;
const PAYLOAD_RADIUS_M: f64 = 0.1;
const PAYLOAD_IS_KNOWN: f64 = 0.01;

/// A body whose parameters are free.
pub(crate) struct FreeBody {
    /// The body, in the order of the unknowns.
    pub(crate) body: usize,
    /// The parameters that the unknowns are added to.
    pub(crate) added_to: Parameters,
    /// One that can exist, where a search begins.
    pub(crate) begin: Parameters,
    /// How well it is known.
    pub(crate) metric: SMatrix<f64, PARAMETERS, PARAMETERS>,
}

/// The bodies whose parameters are free. A body that the description gives no mass, or one that cannot exist, is not.
pub(crate) fn free_bodies(equations: &RecordedEquations, parameters: &FreeUnknowns) -> Vec<FreeBody> {
    let nominal = |body: usize| {
        Parameters::from_column_slice(equations.nominal.rows_range(UnknownOrder::body(body)).as_slice())
    };
    if parameters.has_group(FreeGroup::Links) {
        let all = (0..equations.layout.bodies).filter(|body| is_body(&nominal(*body)));
        let free = all.filter_map(|body| {
            let about = nominal(body);
            Some(FreeBody { body, added_to: about, begin: about, metric: metric(&about)? })
        });
        return free.collect();
    }
    let payload = parameters.payload_alone().and_then(|place| {
        let ball = payload_ball(&place);
        let metric = metric(&ball)? * PAYLOAD_IS_KNOWN;
        Some(FreeBody { body: place.joint, added_to: Parameters::zeros(), begin: ball, metric })
    });
    payload.into_iter().collect()
}

/// A ball at the place of the payload, in the frame of the link of the joint.
fn payload_ball(place: &PayloadPlace) -> Parameters {
    let moment = 0.4 * PAYLOAD_KG * PAYLOAD_RADIUS_M * PAYLOAD_RADIUS_M;
    let ball = SpatialInertia {
        mass_kg: PAYLOAD_KG,
        first_moment_kg_m: Vector3::zeros(),
        tensor_kg_m2: Matrix3::identity() * moment,
    };
    ball.transformed_by(&place.link_from_payload).parameters().into()
}
