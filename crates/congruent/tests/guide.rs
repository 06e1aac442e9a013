//! The programs of the README and the guide, line by line; `xtask/tests/guide.rs` holds the pages against this file.

#![expect(clippy::print_stdout, reason = "the programs show their result")]

use std::{env, error::Error, path::Path, sync::Once};

/// Paths in the programs are relative to the root of the project.
fn in_root() {
    static ENTERED: Once = Once::new();
    ENTERED.call_once(|| {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        env::set_current_dir(root).expect("the root of the project");
    });
}

#[test]
fn the_library_of_the_readme() -> Result<(), Box<dyn Error>> {
    in_root();
    {
        use congruent::prelude::*;

        let description = load_robot("robots/ur5e".as_ref())?;
        let report = check(&description, &CheckOptions::default())?;
        assert_eq!(report.geometry.verdict, Agreement::Agree);
    }
    Ok(())
}

#[test]
fn ten_lines_1() -> Result<(), Box<dyn Error>> {
    in_root();
    {
        use congruent::prelude::*;

        let description = load_robot("robots/ur5e/wrong_convention.toml".as_ref())?;
        let report = check(&description, &CheckOptions::default())?;
        assert_eq!(report.geometry.verdict, Agreement::Disagree);
        println!("{}", serde_json::to_string_pretty(&report)?);
    }
    Ok(())
}

#[test]
fn ten_lines_2() -> Result<(), Box<dyn Error>> {
    in_root();
    {
        use congruent::{
            description::ArmQ,
            kinematics::{IkOptions, IkSolver, IkTarget, TargetPart},
            prelude::*,
        };

        let description = load_robot("robots/ur5e".as_ref())?;
        let mut arm = Arm::from_description(&description)?;
        let q = ArmQ::from([0.3, -1.2, 1.4, -0.8, -1.5, 0.2]); // rad
        let base_from_tcp = arm.base_from_tcp(&q)?;

        let start = ArmQ::zeros(arm.joints().len());
        let target = IkTarget { base_from_tcp, part: TargetPart::Pose };
        let mut solver = IkSolver::new(arm);
        let result = solver.solve(&target, &start, &IkOptions::default(), || true)?;
        assert!(result.converged && result.residual_position_m < 1e-9);
    }
    Ok(())
}

#[test]
fn a_ratio() {
    in_root();
    {
        use congruent::agreement::diagnosis::{
            CandidateModel, Cause, Criterion, ModelPair, ReferenceModel, diagnose,
        };
        use congruent::kinematics::{Pose, ScrewChain, Twist};
        use congruent::nalgebra::{Matrix3, Vector3};

        let turntable = ScrewChain {
            twists_in_base: vec![Twist { angular: Vector3::z(), linear: Vector3::zeros() }],
            base_from_tip_at_zero: Pose::from_parts(Matrix3::identity(), Vector3::new(0.5, 0.1, 0.0)),
        };
        let mut candidate = CandidateModel::from_screws(&turntable);
        candidate.rows[0].rate = 0.98; // 0.98 rad for each radian of the joint variable
        let models = ModelPair { candidate, reference: ReferenceModel::from_screws(&turntable) };
        let criterion = Criterion { configurations: vec![[1.0].into()], ..Criterion::default() };
        assert_eq!(diagnose(&models, &criterion).explanations[0].cause(), Cause::Ratio);
    }
}

#[test]
fn a_source_of_torques() {
    in_root();
    {
        use congruent::description::load_robot;
        use congruent::dynamics::{BodyTree, DrivenState};
        use congruent::dynamics_agreement::{
            AccelerationSource, DynamicsCause, DynamicsModel, IdentificationOptions, Inertial, NamedModel,
            compare_with_source,
        };
        use congruent::nalgebra::Matrix3;

        /// Another program's dynamics: here those of a changed description.
        struct Engine(BodyTree);

        impl AccelerationSource for Engine {
            fn acceleration_into(
                &mut self,
                state: &DrivenState<'_>,
                _: f64,
                qdd: &mut [f64],
            ) -> Result<(), String> {
                self.0.forward_into(state, &mut self.0.buffer(), qdd).map_err(|error| error.to_string())
            }
        }

        let robot = load_robot("docs/examples/arm".as_ref()).expect("a robot without faults").robot;
        let file = DynamicsModel::new(&robot);
        // All names of the explanations that have the same effect on every torque.
        let named = |change: fn(&mut Inertial), resistance: f64| -> Vec<DynamicsCause> {
            let mut imported = file.clone();
            let link = imported.frames().find_link("forearm").expect("a link");
            change(imported.inertials[link].as_mut().expect("an inertial"));
            for joint in &mut imported.resistances {
                joint.damping *= resistance;
                joint.friction *= resistance;
            }
            let description = NamedModel { name: "arm.urdf", model: &file, places: None };
            let mut engine = Engine(imported.tree());
            let options = IdentificationOptions { seed: 1, step_s: 1e-4 };
            let report = compare_with_source(&description, "engine", &mut engine, options).expect("it runs");
            let explanations = report.explanations.iter().chain(&report.indistinguishable);
            explanations
                .flat_map(|found| {
                    std::iter::once(found.cause).chain(found.also_named.iter().map(|name| name.cause))
                })
                .collect()
        };
        // The engine reads no rotation of the inertial frame.
        let without_rotation = |inertial: &mut Inertial| inertial.link_from_axes = Matrix3::identity();
        assert!(named(without_rotation, 1.0).contains(&DynamicsCause::RpyMissing));
        // It omits the inertia of a link.
        let left_out = |inertial: &mut Inertial| {
            inertial.mass_kg = 0.0;
            inertial.tensor_kg_m2 = Matrix3::zeros();
        };
        assert!(named(left_out, 1.0).contains(&DynamicsCause::InertialLeftOut));
        // It reads neither damping nor friction.
        assert!(named(|_| {}, 0.0).contains(&DynamicsCause::JointTermsMissing));
    }
}
