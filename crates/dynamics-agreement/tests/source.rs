//! A source of accelerations against the description that it was built from: an engine of first order that this test
//! makes of other parameters.

#![expect(clippy::print_stdout, reason = "measured values, for --nocapture")]

#[path = "../../../tests/support/corpus.rs"]
mod corpus;

use congruent_description::{RobotQ, load_robot};
use congruent_dynamics::{BodyTree, DrivenState};
use congruent_dynamics_agreement::{
    AccelerationSource, CompareError, DynamicsCause, DynamicsModel, DynamicsReport, DynamicsVerdict,
    IdentificationOptions, NamedModel, compare_with_source,
};

/// Steps to the next state and looks at it from there, as an implicit engine does: its error is of first order.
struct Engine {
    tree: BodyTree,
    /// A spring that pulls each joint to zero, N m/rad: no rigid body chain has it.
    spring: f64,
}

impl AccelerationSource for Engine {
    fn acceleration_into(
        &mut self,
        state: &DrivenState<'_>,
        step_s: f64,
        qdd: &mut [f64],
    ) -> Result<(), String> {
        let mut next = RobotQ::zeros(qdd.len());
        for (next, (q, qd)) in next.iter_mut().zip(state.q.iter().zip(state.qd)) {
            *next = q + step_s * qd;
        }
        let tau: Vec<f64> = state.tau.iter().zip(&*next).map(|(tau, q)| tau - self.spring * q).collect();
        let state = DrivenState { q: &next, qd: state.qd, tau: &tau };
        self.tree.forward_into(&state, &mut self.tree.buffer(), qdd).map_err(|error| error.to_string())
    }
}

fn original(name: &str) -> DynamicsModel {
    let path = corpus::workspace().join("robots").join(name);
    DynamicsModel::new(&load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}")).robot)
}

fn identified(
    candidate: &DynamicsModel,
    engine: &mut dyn AccelerationSource,
) -> Result<DynamicsReport, CompareError> {
    let description = NamedModel { name: "file", model: candidate, places: None };
    compare_with_source(&description, "engine", engine, IdentificationOptions { seed: 1, step_s: 1e-4 })
}

fn compared(name: &str, change: impl Fn(&mut DynamicsModel)) -> DynamicsReport {
    let candidate = original(name);
    let mut wrong = candidate.clone();
    change(&mut wrong);
    let mut engine = Engine { tree: wrong.tree(), spring: 0.0 };
    identified(&candidate, &mut engine).expect("the engine runs")
}

#[test]
fn an_engine_that_was_built_right_agrees() {
    for name in ["ur5e", "panda"] {
        let report = compared(name, |_| {});
        assert_eq!(report.verdict, DynamicsVerdict::SameTorques, "{name}: {:?}", report.explanations);
        let held_out = report.premise.held_out_relative.expect("half of the states are held out");
        println!("{name}: {held_out:e} held out, {:e} fitted", report.premise.fit_relative);
        assert!(held_out < 1e-9, "{name}: {held_out:e}");
    }
}

#[test]
fn what_an_engine_made_of_the_file_is_named() {
    let report = compared("ur5e", |model| {
        let link = model.frames().find_link("forearm_link").expect("a link");
        model.inertials[link].as_mut().expect("an inertial").com_m *= 1e3;
    });
    assert_eq!(report.explanations[0].cause, DynamicsCause::ComUnit, "{:?}", report.explanations);
    assert_eq!(report.explanations[0].place, ["forearm_link"]);
    assert_eq!(report.explanations[0].suggestion, None, "the file is right");
    let report = compared("ur5e", |model| model.resistances.iter_mut().for_each(|of| of.damping = 0.1));
    assert_eq!(report.explanations[0].cause, DynamicsCause::DampingDefault, "{:?}", report.explanations);
    let report = compared("ur5e", |model| model.gravity_m_s2 = [0.0, -9.81, 0.0].into());
    assert_eq!(report.explanations[0].cause, DynamicsCause::GravityDirection, "{:?}", report.explanations);
    assert_eq!(report.explanations[0].detail, "-y");
    let report = compared("ur5e", |model| {
        let link = model.frames().find_link("wrist_1_link").expect("a link");
        model.inertials[link].as_mut().expect("an inertial").mass_kg *= 1.3;
        let link = model.frames().find_link("upper_arm_link").expect("a link");
        model.inertials[link].as_mut().expect("an inertial").com_m.z *= -1.0;
    });
    assert_eq!(report.explanations[0].cause, DynamicsCause::Several, "{:?}", report.explanations);
    let places = &report.explanations[0].place;
    assert!(places.iter().all(|place| place == "wrist_1_link" || place == "upper_arm_link"), "{places:?}");
}

#[test]
fn what_is_no_rigid_body_chain_breaks_the_premise() {
    let candidate = original("ur5e");
    let mut engine = Engine { tree: candidate.tree(), spring: 3.0 };
    let report = identified(&candidate, &mut engine).expect("the engine runs");
    assert_eq!(report.verdict, DynamicsVerdict::Unexplained);
    let held_out = report.premise.held_out_relative.expect("half of the states are held out");
    assert!(held_out > 1e-3, "{held_out:e}");
}

#[test]
fn a_source_that_fails_says_so() {
    struct Broken;
    impl AccelerationSource for Broken {
        fn acceleration_into(&mut self, _: &DrivenState<'_>, _: f64, _: &mut [f64]) -> Result<(), String> {
            Err("no world".to_owned())
        }
    }
    let error = identified(&original("ur5e"), &mut Broken).expect_err("it fails");
    assert_eq!(error.to_string(), "the source of accelerations failed: no world");
}
