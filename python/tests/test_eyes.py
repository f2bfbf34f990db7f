"""Noise, delays and stacks of declared observations: spaces, batches, faults, snapshots."""

import numpy as np

import setpiece

EYES = """
scenario eyes extends academy {
    agents { left: [one, two] }
    ball at (0.3, 0.05)
    team left { one: CF at (0.28, 0.05)  two: CM at (0.2, 0.1) }
    team right { CB at (0.4, 0) }
    observe vector {
        elapsed stack 3 as "time"
        ball noise normal(0, 0.3m) delayed 0.2s as "ball"
        ball - me when sees(me, ball, within: 120deg) as "way"
        1 / (elapsed / 1s - 0.2) as "fails once"
    }
    end limit 30 steps
}
"""

IDLE = [0, 0]


def test_the_space_has_the_stacks_and_the_names() -> None:
    env = setpiece.make(setpiece.compile(EYES), observation="vector")
    assert env.observation_space.shape == (2, 8)
    names = [block.meaning for block in env.observation_layout]
    assert names[:3] == ["time, 2 steps ago", "time, 1 step ago", "time"]
    observation, _ = env.reset(seed=1)
    assert env.observation_space.contains(observation)
    assert observation[:, :3].tolist() == [[0, 0, 0], [0, 0, 0]]
    for _ in range(3):
        observation, *_ = env.step(IDLE)
    np.testing.assert_allclose(observation[0, :3], [0.1, 0.2, 0.3], rtol=1e-6)
    assert observation[0, 3] != observation[1, 3], "each agent has noise of their own"


def test_what_cannot_be_observed_is_counted_by_name() -> None:
    env = setpiece.make(setpiece.compile(EYES), observation="vector")
    env.reset(seed=1)
    done = False
    while not done:
        _, _, terminated, truncated, info = env.step(IDLE)
        done = terminated or truncated
    assert info["setpiece"]["observation_faults"] == {"fails once": 2}
    assert info["setpiece"]["faults"] == 0


def test_a_batch_sees_what_single_environments_see() -> None:
    scenario = setpiece.compile(EYES)
    batch = setpiece.make_vec(scenario, 3, observation="vector", seed=5)
    seen, _ = batch.reset(seed=5)
    steps = [seen.copy()]
    for _ in range(10):
        steps.append(batch.step(np.zeros((3, 2), dtype=np.int64))[0].copy())
    single = setpiece.make(scenario, observation="vector")
    assert np.array_equal(single.reset(seed=5)[0], steps[0][0])
    for step in steps[1:]:
        assert np.array_equal(single.step(IDLE)[0], step[0])
        assert not np.array_equal(step[0], step[1]), "each environment has noise of its own"


def test_a_snapshot_shows_the_same() -> None:
    env = setpiece.make(setpiece.compile(EYES), observation="vector")
    env.reset(seed=3)
    for _ in range(5):
        env.step(IDLE)
    kept = env.snapshot()
    ahead = [env.step(IDLE)[0].copy() for _ in range(5)]
    env.restore(kept)
    for expected in ahead:
        assert np.array_equal(env.step(IDLE)[0], expected)
