//! The time of a certificate: single faults of arms with the lengths of a `UR5e` and of a Panda, over
//! full turns of every joint, until the bound is within 5 % of the attained value.

#[path = "../../kinematics/tests/support/mod.rs"]
mod support;

use std::f64::consts::PI;

use congruent_agreement::bound::{Budget, certify};
use congruent_kinematics::{DhChain, ScrewChain};
use divan::{Bencher, black_box};
use nalgebra::{Isometry3, Vector3};

use support::{TableFigures, panda_table, ur5e_table};

const BUDGET: Budget = Budget { relative_gap: 0.05, corners: 100_000_000 };

fn main() {
    divan::main();
}

fn chain(figures: &TableFigures) -> ScrewChain {
    let robot = figures.robot();
    let table = DhChain::new(&figures.table(&robot), &robot);
    ScrewChain::from_dh(&table, robot.dof()).expect("the table fits its robot")
}

/// One fault: its name and its change to the arm.
type NamedFault = (&'static str, fn(&mut TableFigures));

const FAULTS: [NamedFault; 8] = [
    ("none", |_| ()),
    ("alpha of row 1, 1 deg", |arm| arm.rows[0].alpha_rad += 1_f64.to_radians()),
    ("a of row 2, 1 mm", |arm| arm.rows[1].a_m += 1e-3),
    ("zero of joint 2, 1 deg", |arm| arm.rows[1].theta_rad += 1_f64.to_radians()),
    ("base, 1 mm and 1 deg", |arm| {
        arm.base_from_dh0 = Isometry3::new(Vector3::x() * 1e-3, Vector3::x() * 0.017);
    }),
    ("tool, 5 mm", |arm| arm.dhn_from_tip = Isometry3::translation(0.005, 0.0, 0.0)),
    ("base and tool, 50 mm each", |arm| {
        arm.base_from_dh0 = Isometry3::translation(0.03, 0.04, 0.0);
        arm.dhn_from_tip = Isometry3::translation(0.0, 0.03, -0.04);
    }),
    ("every parameter", |arm| {
        for row in &mut arm.rows {
            row.a_m += 1e-3;
            row.alpha_rad += 0.01;
            row.d_m -= 5e-4;
            row.theta_rad -= 0.005;
        }
    }),
];

#[divan::bench(args = FAULTS.map(|fault| fault.0))]
fn six_joints(bencher: Bencher<'_, '_>, fault: &str) {
    measure(bencher, &ur5e_table(), fault);
}

#[divan::bench(args = FAULTS.map(|fault| fault.0))]
fn seven_joints(bencher: Bencher<'_, '_>, fault: &str) {
    measure(bencher, &panda_table(), fault);
}

fn measure(bencher: Bencher<'_, '_>, arm: &TableFigures, fault: &str) {
    let mut other = arm.clone();
    let (_, change) = FAULTS.iter().find(|(name, _)| *name == fault).expect("one of the list");
    change(&mut other);
    let (a, b, ranges) = (chain(arm), chain(&other), vec![(-PI, PI); arm.rows.len()]);
    bencher.bench_local(|| certify(black_box(&a), black_box(&b), &ranges, BUDGET));
}
