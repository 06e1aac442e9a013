"""Torques, mass matrices and accelerations: laws between them, and a mass that a reader can weigh by hand."""

import numpy as np
import pytest

import congruent

G_M_S2 = 9.81
# Torques up to 100 N m on two paths. Kind: rounding; worst seen 2.2e-14 N m; x18.
TORQUE_N_M = 4e-13
# Accelerations of torques of accelerations, rad/s^2. Kind: rounding, times the condition of mass matrices; worst seen 9e-14; x11.
SOLVED_RAD_S2 = 1e-12


def motion(robot: congruent.Robot, rows: int, seed: int) -> list[np.ndarray]:
    random = np.random.default_rng(seed)
    return [random.uniform(-1, 1, (rows, robot.dof)) for _ in range(3)]


ROD = """<robot name="rod"><link name="base"/>
  <link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    <inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>
    <dynamics damping="0.3" friction="0.7"/></joint></robot>"""


def test_a_rod_on_a_hinge() -> None:
    rod = congruent.Robot.from_text(ROD)
    # The weight of 2 kg at 0.5 m pulls down, which turns about +y: it is held by -2 g 0.5.
    np.testing.assert_allclose(rod.inverse_dynamics([0.0], [0.0], [0.0]), [-2 * G_M_S2 * 0.5])
    # I + m d^2 = 0.2 + 2 * 0.25.
    np.testing.assert_allclose(rod.mass_matrix([0.3]), [[0.7]])
    np.testing.assert_allclose(rod.forward_dynamics([0.0], [0.0], [0.0]), [G_M_S2 / 0.7])
    # Damping and dry friction resist the speed, if they are counted.
    moving = rod.inverse_dynamics([0.0], [2.0], [0.0], friction=True) - rod.inverse_dynamics([0.0], [2.0], [0.0])
    np.testing.assert_allclose(moving, [0.3 * 2 + 0.7])


@pytest.mark.parametrize("friction", [False, True])
@pytest.mark.parametrize("name", ["ur5e", "panda"])
def test_forward_dynamics_undoes_inverse_dynamics(name: str, friction: bool, request: pytest.FixtureRequest) -> None:
    robot: congruent.Robot = request.getfixturevalue(name)
    q, qd, qdd = motion(robot, 300, 7)
    tau = robot.inverse_dynamics(q, qd, qdd, friction=friction)
    found = robot.forward_dynamics(q, qd, tau, friction=friction)
    np.testing.assert_allclose(found, qdd, rtol=0, atol=SOLVED_RAD_S2)


@pytest.mark.parametrize("name", ["ur5e", "panda"])
def test_the_mass_matrix_is_torque_for_acceleration(name: str, request: pytest.FixtureRequest) -> None:
    robot: congruent.Robot = request.getfixturevalue(name)
    q, qd, qdd = motion(robot, 40, 8)
    matrices = robot.mass_matrix(q)
    assert matrices.shape == (40, robot.dof, robot.dof)
    np.testing.assert_allclose(matrices, matrices.transpose(0, 2, 1), rtol=0, atol=TORQUE_N_M)
    bias = robot.inverse_dynamics(q, qd, np.zeros_like(qdd))
    by_matrix = np.einsum("nij,nj->ni", matrices, qdd) + bias
    np.testing.assert_allclose(robot.inverse_dynamics(q, qd, qdd), by_matrix, rtol=0, atol=TORQUE_N_M)


@pytest.mark.parametrize("name", ["ur5e", "panda"])
def test_the_regressor_gives_the_torques(name: str, request: pytest.FixtureRequest) -> None:
    robot: congruent.Robot = request.getfixturevalue(name)
    q, qd, qdd = motion(robot, 70, 9)
    regressor = robot.regressor(q, qd, qdd)
    assert regressor.shape == (70, robot.dof, len(robot.parameter_names))
    tau = robot.inverse_dynamics(q, qd, qdd)
    np.testing.assert_allclose(regressor @ robot.parameters, tau, rtol=0, atol=TORQUE_N_M)


def test_base_parameters_are_the_rank_and_give_the_torques(ur5e: congruent.Robot) -> None:
    groups = ur5e.base_parameters()
    # Mayeda, Yoshida, Osuka (1990), for n revolute joints, each parallel or perpendicular to the next, of which the first b are
    # parallel: 7 n - 4 b, and 2 less if gravity is along the first axis.
    assert len(groups) == 7 * 6 - 4 * 1 - 2
    regressor = np.vstack(list(ur5e.regressor(*motion(ur5e, 60, 10))))
    assert len(groups) == np.linalg.matrix_rank(regressor, tol=1e-9 * np.linalg.norm(regressor))
    sums = np.array([group.coefficients(ur5e.parameter_names) for group in groups])
    np.testing.assert_allclose(sums @ ur5e.parameters, [group.value for group in groups], rtol=0, atol=TORQUE_N_M)
    assert {group.unit for group in groups} <= {"kg m^2", "kg m", "kg"}
    # Parameters that change no sum change no torque.
    unseen = np.linalg.svd(sums)[2][len(groups) :].T
    np.testing.assert_allclose(regressor @ unseen, 0, atol=1e-8)


def test_a_robot_without_masses_has_poses_and_no_torques() -> None:
    bare = congruent.Robot.from_text(ROD.replace('<mass value="2"/>', ""))
    assert bare.fk([0.0]).shape == (4, 4)
    with pytest.raises(congruent.CongruentError, match="mass") as refused:
        bare.mass_matrix([0.0])
    assert refused.value.findings[0].line == 2


def test_vectors_of_one_call_are_of_the_same_rows(ur5e: congruent.Robot) -> None:
    with pytest.raises(congruent.CongruentError, match="q has 3 rows, but qd is one configuration"):
        ur5e.inverse_dynamics(np.zeros((3, 6)), np.zeros(6), np.zeros((3, 6)))


def test_numbers_that_overflow_are_refused(ur5e: congruent.Robot) -> None:
    speeds = np.zeros((400, 6))
    speeds[300, 1] = 1e200
    with pytest.raises(congruent.CongruentError, match="row 300 is not a finite number"):
        ur5e.inverse_dynamics(np.zeros((400, 6)), speeds, np.zeros((400, 6)))
