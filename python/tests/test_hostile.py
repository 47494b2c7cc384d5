"""Arrays and values that no one should give: each ends in an exception that says what is wrong, or in the right result."""

from pathlib import Path

import numpy as np
import pytest

import robots

FILES = Path(__file__).resolve().parents[2] / "robots"


@pytest.fixture(scope="module")
def puma():
    return robots.load(FILES / "puma560.toml")


@pytest.fixture(scope="module")
def given():
    return np.random.default_rng(5).uniform(-1, 1, (3, 100, 6))


@pytest.mark.parametrize(
    "made, message",
    [
        (lambda q: q.astype(bool), "real numbers, not of bool"),
        (lambda q: q.astype(object), "real numbers, not of object"),
        (lambda q: q.astype(str), "real numbers"),
        (lambda q: q.astype([("a", float)]), "real numbers"),
        (lambda q: np.zeros(q.shape, "datetime64[s]"), "real numbers"),
        (lambda q: q.ravel(), "shape"),
        (lambda q: q[:, :0], "shape"),
        (lambda q: q[..., None], "shape"),
        (lambda q: np.float64(0.5), "shape"),
        (lambda q: float("nan"), "shape"),
        (lambda q: np.zeros((0, 7)), "shape"),
        (lambda q: [[1.0, 2.0], [1.0]], "not an array"),
        (lambda q: {"a": 1}, "real numbers"),
        (lambda q: "0", "real numbers"),
        (lambda q: None, "real numbers"),
        (lambda q: np.ma.masked_less(q, 0.0), "masked"),
    ],
)
def test_inputs_that_are_no_states(puma, given, made, message):
    q, qd, qdd = given
    for call in (lambda x: puma.inverse_dynamics(x, qd, qdd), lambda x: puma.inverse_dynamics(q[0], qd[0], qdd=x)):
        with pytest.raises(robots.RobotError, match=message):
            call(made(q))


def test_layouts_give_the_same_bits(puma, given):
    q, qd, qdd = given
    tau = puma.inverse_dynamics(q, qd, qdd)
    unaligned = np.frombuffer(b"x" + q.tobytes(), np.uint8)[1:].view(np.float64).reshape(q.shape)
    assert not unaligned.flags.aligned
    read_only = q.copy()
    read_only.flags.writeable = False
    backwards = np.ascontiguousarray(q[::-1, ::-1])[::-1, ::-1]
    for layout in (unaligned, read_only, backwards, q.astype(">f8"), q.astype(np.longdouble), np.asfortranarray(q), memoryview(q), q.tolist()):
        assert np.array_equal(puma.inverse_dynamics(layout, qd, qdd), tau)
    repeated = np.broadcast_to(q[0], q.shape)
    assert np.array_equal(puma.inverse_dynamics(repeated, qd, qdd), puma.inverse_dynamics(q[0], qd, qdd))
    whole = np.arange(12).reshape(2, 6)
    assert np.array_equal(puma.gravity(whole), puma.gravity(whole.astype(float)))


def test_nan_and_infinity_stay_in_their_rows(puma, given):
    q, qd, qdd = (array.copy() for array in given)
    tau = puma.inverse_dynamics(q, qd, qdd)
    q[3, 2], qd[50, 0], qdd[99, 5] = np.nan, np.inf, -np.inf
    found = puma.inverse_dynamics(q, qd, qdd, threads=2)
    wrong = np.zeros(100, bool)
    wrong[[3, 50, 99]] = True
    assert np.array_equal(found[~wrong], tau[~wrong])
    assert not np.isfinite(found[wrong]).all(axis=1).any()
    assert np.isfinite(puma.inverse_dynamics(1e9 * q[:1], qd[:1], qdd[:1])).all()


@pytest.mark.parametrize(
    "out, message",
    [
        (lambda: np.zeros((100, 6), np.float16), "f64 or f32"),
        (lambda: np.zeros((100, 6), ">f8"), "f64 or f32"),
        (lambda: np.zeros((100, 6), int), "f64 or f32"),
        (lambda: [[0.0] * 6] * 100, "100"),
        (lambda: np.zeros((6, 100)).T[:99], "shape"),
        (lambda: np.zeros(600), "shape"),
        (lambda: (np.zeros((100, 6)),) * 2, "1 array"),
        (lambda: np.broadcast_to(0.0, (100, 6)), "read-only"),
        (lambda: "out", "f64 or f32"),
    ],
)
def test_out_that_cannot_take_the_result(puma, given, out, message):
    with pytest.raises(robots.RobotError, match=message):
        puma.inverse_dynamics(*given, out=out())


def test_out_in_any_place(puma, given):
    q, qd, qdd = given
    tau = puma.inverse_dynamics(q, qd, qdd)
    narrow = np.zeros((100, 6), np.float32)
    assert puma.inverse_dynamics(q, qd, qdd, out=narrow) is narrow and np.array_equal(narrow, tau.astype(np.float32))
    # In the memory of the inputs, also shifted by some rows in either direction, as NumPy's own functions allow it.
    for first in (0, 1, 3):
        for read, write in ((slice(first, 100 - 3 + first), slice(0, 97)), (slice(0, 97), slice(first, 100 - 3 + first))):
            place = q.copy()
            expected = puma.inverse_dynamics(q[read], qd[:97], qdd[:97])
            puma.inverse_dynamics(place[read], qd[:97], qdd[:97], out=place[write])
            assert np.array_equal(place[write], expected)
    unaligned = np.zeros(4801, np.uint8)[1:].view(np.float64).reshape(100, 6)
    assert not unaligned.flags.aligned and np.array_equal(puma.inverse_dynamics(q, qd, qdd, out=unaligned), tau)
    M, h = np.zeros((100, 6, 6)), np.zeros((6, 100)).T
    assert puma.call("mass_matrix", "bias", q=q, qd=qd, out=(M, h))[0] is M
    assert np.array_equal(M, puma.mass_matrix(q)) and np.allclose(h, puma.bias(q, qd), rtol=1e-12)
    with pytest.raises(robots.RobotError, match="overlap"):
        both = np.zeros((100, 42))
        puma.call("bias", "gravity", q=q, qd=qd, out=(both[:, :6], both[:, 3:9]))


def test_huge_and_empty(puma):
    endless = np.broadcast_to(np.zeros(6), (1 << 50, 6))
    with pytest.raises(MemoryError):
        puma.gravity(endless)
    for shape in ((0, 6), (0, 6)[::1]):
        assert puma.mass_matrix(np.zeros(shape)).shape == (0, 6, 6)
    assert puma.gravity(np.zeros((1, 6)), threads=10**9).shape == (1, 6)
    assert puma.gravity(np.zeros((1000, 6)), threads=np.int32(3)).shape == (1000, 6)
    for threads in (0, -1, 1.5, "2", None):
        with pytest.raises(robots.RobotError, match="threads"):
            puma.gravity(np.zeros((10, 6)), threads=threads)


def test_calls_from_many_threads(puma, given):
    from concurrent.futures import ThreadPoolExecutor

    tau = puma.inverse_dynamics(*given)
    planar = robots.load(FILES / "planar_2r.toml")
    masses = [float(mass) for mass in np.linspace(1, 5, 40)]
    gravity = [planar.gravity([0.3, 0.2], m2=mass) for mass in masses]
    with ThreadPoolExecutor(8) as pool:
        assert all(np.array_equal(found, tau) for found in pool.map(lambda _: puma.inverse_dynamics(*given, threads=2), range(64)))
        assert np.array_equal(list(pool.map(lambda mass: planar.gravity([0.3, 0.2], m2=mass), masses * 4)), gravity * 4)


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda r: r.gravity([0, 0], m2="heavy"), "must be one number"),
        (lambda r: r.gravity([0, 0], m2=[1.0, 2.0]), "must be one number"),
        (lambda r: r.gravity([0, 0], m2=np.nan), "finite"),
        (lambda r: r.gravity([0, 0], m2=1.0, parameters={"m2": 1.0}), "given twice"),
        (lambda r: r.gravity([0, 0], parameters=[1.0]), "by name"),
        (lambda r: r.gravity([0, 0], m9=1.0), "no such parameter"),
        (lambda r: r.gravity([0, 0], payload=robots.Payload(1.0)), r"\[payload\]"),
        (lambda r: r.gravity([0, 0], payload=1.0), "robots.Payload"),
        (lambda r: r.gravity(), "needs the input `q`"),
        (lambda r: r.inverse_dynamics(), "needs the inputs `q`, `qd`, `qdd`"),
        (lambda r: r.call(), "at least one"),
        (lambda r: r.call("gravity", "nothing", q=[0, 0]), "nothing"),
        (lambda r: r.diff("scara.toml"), "another robot"),
        (lambda r: r.document("arm.doc"), "extension must be"),
        (lambda r: r.document("arm.tex", by="latex"), "by"),
        (lambda r: r.document("arm.pdf", by="word"), "word"),
        (lambda r: r.arrow("gravity", output="rows"), "output must be"),
        (lambda r: r.simulate(1.0, q0=[0.0]), "1 entry, not 2"),
        (lambda r: r.simulate(1.0, torques={"3": "1"}), "3"),
        (lambda r: r.source("cobol"), "cobol"),
        (lambda r: r.source("cpp"), "several files"),
    ],
)
def test_what_is_wrong_is_said(call, message):
    with pytest.raises(robots.RobotError, match=message):
        call(robots.load(FILES / "planar_2r.toml"))


@pytest.mark.parametrize(
    "given, message",
    [
        (("heavy",), "mass"),
        (([1.0],), "mass must be a number"),
        ((1.0, [0.0, 0.0]), "center_of_mass must be 3 numbers"),
        ((1.0, [0.0] * 3, [0.0] * 5), "inertia must be 6 numbers or 3 rows of 3"),
        ((1.0, [0.0] * 3, [[1.0, 0.1, 0], [0.2, 1, 0], [0, 0, 1]]), "not symmetric"),
        ((np.nan,), "finite"),
    ],
)
def test_payloads_that_are_none(tmp_path, given, message):
    with pytest.raises(robots.RobotError, match=message):
        carrying(tmp_path).gravity([0.0, 0.0], payload=robots.Payload(*given))


def carrying(folder):
    file = folder / "carrying.toml"
    file.write_text((FILES / "planar_2r.toml").read_text() + '\n[payload]\nparent = "2"\n')
    return robots.load(file)


def test_a_payload_is_a_body(tmp_path):
    robot = carrying(tmp_path)
    mass, x, zz, q = 2.0, 0.8, 0.05, np.array([0.4, -0.2])
    payload = robots.Payload(mass, [x, 0, 0], [0, 0, zz, 0, 0, 0])
    g, l1 = robot.parameters["g"], robot.parameters["l1"]
    weight = mass * g * np.array([l1 * np.cos(q[0]) + x * np.cos(q.sum()), x * np.cos(q.sum())])
    assert np.allclose(robot.gravity(q, payload=payload) - robot.gravity(q), weight, rtol=1e-12)
    M = robot.mass_matrix(q, payload=payload) - robot.mass_matrix(q)
    assert np.isclose(M[1, 1], mass * x**2 + zz, rtol=1e-12)
    tensor = robots.Payload(mass, [x, 0, 0], [[0, 0, 0], [0, 0, 0], [0, 0, zz]])
    assert np.array_equal(robot.mass_matrix(q, payload=tensor), robot.mass_matrix(q, payload=payload))
    assert np.array_equal(robot.gravity(q, payload_mass=mass, payload_x=x, m2=1.0), robot.gravity(q, payload=robots.Payload(mass, [x, 0, 0]), m2=1.0))


def test_a_tensor_is_six_numbers_or_three_rows(tmp_path):
    file = tmp_path / "carrying.toml"
    file.write_text((FILES / "puma560.toml").read_text() + "\n[payload]\n")
    robot, q = robots.load(file), np.linspace(-1, 1, 6)
    xx, yy, zz, xy, xz, yz = 0.3, 0.4, 0.5, 0.01, 0.02, 0.03
    rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    as_rows, as_numbers = (robot.mass_matrix(q, payload=robots.Payload(1.0, [0, 0, 0.1], tensor)) for tensor in (rows, [xx, yy, zz, xy, xz, yz]))
    by_name = robot.mass_matrix(q, payload_mass=1.0, payload_z=0.1, payload_xx=xx, payload_yy=yy, payload_zz=zz, payload_xy=xy, payload_xz=xz, payload_yz=yz)
    assert np.array_equal(as_rows, by_name) and np.array_equal(as_numbers, by_name)
