from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import Counter, Locked, Tracker, same

import setpiece
from setpiece import Action
from setpiece._vector import FootballVectorEnv

pytest.importorskip("stable_baselines3")
pytest.importorskip("torch")

import torch
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers import TimeLimit
from stable_baselines3 import PPO
from stable_baselines3.common.logger import configure
from stable_baselines3.common.vec_env import DummyVecEnv, VecMonitor, VecVideoRecorder

from setpiece.sb3 import Sb3VecEnv, make_vec

CLOSE = "academy_empty_goal_close"
THREE = "academy_3_vs_1_with_keeper"

pytestmark = pytest.mark.filterwarnings("default")


@pytest.mark.parametrize(
    "shown",
    [
        {"observation": "simple115v2"},
        {"observation": "smm"},
        {"observation": "simple115v2+sticky", "scale": True},
        {"observation": "egocentric", "scale": True, "stack": 2},
    ],
)
def test_is_step_by_step_what_dummy_vec_env_is(shown: dict[str, Any]) -> None:
    """The reference is Stable-Baselines3's own vector environment with the same environments."""
    ours = make_vec(CLOSE, 3, **shown)
    theirs = DummyVecEnv([lambda: setpiece.make(CLOSE, **shown)] * 3)
    assert ours.observation_space == theirs.observation_space
    assert ours.action_space == theirs.action_space
    for vec in (ours, theirs):
        vec.seed(5)
    np.testing.assert_array_equal(ours.reset(), theirs.reset())
    generator, ends = np.random.default_rng(0), 0
    for _ in range(400):
        actions = generator.integers(0, 19, 3)
        mine, other = ours.step(actions), theirs.step(actions)
        assert same(mine[0], other[0])
        assert same(mine[1], other[1])
        assert same(mine[2], other[2])
        for info, expected in zip(mine[3], other[3], strict=True):
            assert info.keys() == expected.keys()
            assert info["TimeLimit.truncated"] == expected["TimeLimit.truncated"]
            np.testing.assert_array_equal(info["action_mask"], expected["action_mask"])
            if "terminal_observation" in expected:
                ends += 1
                np.testing.assert_array_equal(
                    info["terminal_observation"], expected["terminal_observation"]
                )
                assert info["setpiece"] == expected["setpiece"]
                assert info["outcome"] == expected["outcome"]
        for info, expected in zip(ours.reset_infos, theirs.reset_infos, strict=True):
            assert info.keys() == expected.keys()
    assert ends > 3


def test_a_limit_is_distinguished_from_an_ending() -> None:
    envs = [lambda: TimeLimit(setpiece.make(CLOSE), 4)] * 2
    vec = Sb3VecEnv(SyncVectorEnv(envs, autoreset_mode=AutoresetMode.SAME_STEP))
    vec.seed(1)
    vec.reset()
    for _ in range(4):
        _, _, dones, infos = vec.step(np.array([Action.IDLE] * 2))
    assert dones.all()
    assert all(info["TimeLimit.truncated"] for info in infos)
    assert vec.env_is_wrapped(TimeLimit) == [True, True]
    assert vec.env_is_wrapped(gymnasium.wrappers.FlattenObservation) == [False, False]


def test_seeds_and_options_of_the_next_reset() -> None:
    first, again = make_vec(THREE, 2, seed=3), make_vec(THREE, 2)
    assert again.seed(3) == [3, 4]
    assert same(first.reset(), again.reset())
    for wrong in (-1, 2**64, "one", 1.5, True):
        with pytest.raises(setpiece.ParameterError, match="`seed`"):
            again.seed(wrong)  # type: ignore[arg-type]
        with pytest.raises(setpiece.ParameterError, match="`seed`"):
            make_vec(THREE, 2, seed=wrong)  # type: ignore[arg-type]
    assert len(again.seed()) == 2
    again.seed(3)
    again.set_options({"params": {"difficulty": 0.9}})
    again.reset()
    again.set_options([{"params": {"difficulty": 0.9}}, {}])
    with pytest.raises(setpiece.ParameterError, match="share their reset options"):
        again.reset()


def test_attributes_and_methods_of_single_environments() -> None:
    vec = make_vec(THREE, 3, events=True)
    vec.seed(1)
    vec.reset()
    assert vec.get_attr("agents") == [("left_0",)] * 3
    assert vec.get_attr("agents", indices=[0]) == [("left_0",)]
    masks = vec.env_method("action_masks")
    assert same(np.stack(masks), vec.action_masks())
    assert len(vec.env_method("snapshot", indices=1)) == 1
    assert vec.has_attr("action_masks")
    assert not vec.has_attr("nothing")
    vec.set_attr("mine", 7, indices=[2])
    assert vec.get_attr("mine", indices=2) == [7]
    with pytest.raises(AttributeError):
        vec.get_attr("mine", indices=0)
    vec.close()


def test_attributes_and_methods_of_a_batch() -> None:
    vec = make_vec(THREE, 3, seed=1, threads=2)
    vec.reset()
    assert isinstance(vec.envs, FootballVectorEnv)
    assert vec.get_attr("agents") == [("left_0",)] * 3
    assert same(np.stack(vec.env_method("action_masks")), vec.action_masks())
    assert same(vec.env_method("action_masks", indices=1), [vec.action_masks()[1]])
    assert not vec.has_attr("nothing")
    with pytest.raises(AttributeError, match="one batch"):
        vec.env_method("snapshot", indices=1)
    vec.set_attr("mine", 7)
    assert vec.get_attr("mine", indices=2) == [7]
    with pytest.raises(setpiece.ParameterError, match="for all environments"):
        vec.set_attr("mine", 8, indices=[2])
    assert vec.env_is_wrapped(TimeLimit) == [False] * 3
    vec.close()


def test_what_a_batch_does_not_tell_is_played_by_single_environments() -> None:
    text = (
        "scenario s extends academy { ball at (0.9, 0)  team left { CB at (0.89, 0) }"
        "  record shots = count of shot }"
    )
    for vec, action, kind in (
        (make_vec(setpiece.compile(text), 2, seed=1), Action.SHOT, FootballVectorEnv),
        (make_vec(CLOSE, 2, seed=1, events=True), Action.RIGHT, SyncVectorEnv),
    ):
        assert isinstance(vec.envs, kind)
        vec.reset()
        dones = np.zeros(2, bool)
        while not dones.any():
            _, _, dones, infos = vec.step(np.array([action] * 2))
        assert "records" in infos[int(np.argmax(dones))]
    assert "events" in infos[0]


def test_what_it_can_not_be_made_of() -> None:
    with pytest.raises(setpiece.ParameterError, match="SAME_STEP"):
        Sb3VecEnv(SyncVectorEnv([lambda: setpiece.make(CLOSE)]))
    with pytest.raises(setpiece.ParameterError, match="`num_envs` is 0"):
        make_vec(CLOSE, 0)
    with pytest.raises(setpiece.ParameterError, match="trains one agent"):
        make_vec(THREE, 2, left=3)
    assert (
        make_vec(
            THREE, 2, left=3, right=1, opponents={"right": "bot", "left_0": "bot", "left_1": "bot"}
        ).num_envs
        == 2
    )


def test_ppo_learns_to_score(tmp_path: Path) -> None:
    """A random agent scores in one episode of five."""
    torch.set_num_threads(1)
    vec = VecMonitor(make_vec(CLOSE, 16, seed=0))
    model = PPO(
        "MlpPolicy",
        vec,
        n_steps=64,
        batch_size=256,
        n_epochs=4,
        gamma=0.98,
        ent_coef=0.01,
        learning_rate=1e-3,
        seed=0,
        device="cpu",
    )
    model.set_logger(configure(str(tmp_path), ["tensorboard"]))
    model.learn(60_000)
    assert np.mean([episode["r"] for episode in model.ep_info_buffer]) > 0.9
    assert list(tmp_path.glob("events*"))
    # What has been learnt can play as an opponent.
    env = setpiece.make(CLOSE, opponents={"left": model})
    scored = 0
    for seed in range(10):
        env.reset(seed=seed)
        done = False
        while not done:
            _, _, terminated, truncated, info = env.step([])
            done = terminated or truncated
        scored += info["score"][0]
    assert scored >= 8


def test_maskable_ppo_presses_nothing_that_is_masked() -> None:
    contrib = pytest.importorskip("sb3_contrib")
    vec = make_vec(THREE, 2, seed=0)
    model = contrib.MaskablePPO("MlpPolicy", vec, n_steps=64, batch_size=64, seed=0, device="cpu")
    model.learn(256)
    observation: Any = vec.reset()
    for _ in range(50):
        masks = vec.action_masks()
        actions, _ = model.predict(observation, action_masks=masks)
        assert masks[np.arange(2), actions].all()
        observation, *_ = vec.step(actions)


def test_episodes_are_recorded(tmp_path: Path) -> None:
    vec = make_vec(CLOSE, 2, seed=1, record=tmp_path)
    vec.reset()
    paths: list[str] = []
    for _ in range(100):
        infos = vec.step(np.array([Action.SHOT] * 2))[3]
        paths += [info["setpiece"]["replay"] for info in infos if "setpiece" in info]
    assert paths
    assert all(setpiece.Replay(path).length > 0 for path in paths)


def test_rewards_and_endings_in_python_are_played_by_single_environments() -> None:
    def kept(_step: setpiece.Step) -> float:
        return 0.25

    def deep(step: setpiece.Step) -> bool:
        return bool(step.now["ball"][0] > 0.8)

    vec = make_vec(CLOSE, 2, rewards=["scoring", kept], ends=[deep], seed=0)
    vec.reset()
    outcomes = set()
    for step in range(300):
        # One reaches the ending in Python, the other waits for the file's limit or a lost ball.
        _, rewards, dones, infos = vec.step(np.array([Action.RIGHT, Action.IDLE]))
        assert rewards.tolist() == [0.25, 0.25] or dones.any(), step
        outcomes |= {info["outcome"] for info in infos if "outcome" in info}
        ended = [info["setpiece"] for info in infos if "setpiece" in info]
        assert all(summary["return"]["kept"] == 0.25 * summary["length"] for summary in ended)
    assert "deep" in outcomes


def test_each_environment_has_rewards_of_its_own() -> None:
    vec = make_vec("5_vs_5", 3, rewards=["none", Counter()], seed=0)
    vec.reset()
    for step in range(1, 4):
        assert vec.step(np.zeros(3, int))[1].tolist() == [step] * 3


def test_rewards_and_endings_of_an_environment_share_what_they_shared() -> None:
    tracker = Tracker()
    vec = make_vec("5_vs_5", 2, rewards=tracker.paid, ends=tracker.tired, seed=0)
    vec.reset()
    dones = [vec.step(np.zeros(2, int))[2].tolist() for _ in range(4)]
    assert dones == [[False, False]] * 3 + [[True, True]]
    with pytest.raises(setpiece.CallbackError, match="`Locked` can't be copied"):
        make_vec("5_vs_5", 2, rewards=Locked())


def test_opponents_play_in_a_batch() -> None:
    seen: list[int] = []

    def forward(observations: Any) -> list[Action]:
        seen.append(len(observations))
        return [Action.RIGHT] * len(observations)

    vec = make_vec("5_vs_5", 3, right=2, opponents={"right": setpiece.Policy(forward)}, seed=0)
    assert isinstance(vec.envs, FootballVectorEnv)
    vec.reset()
    vec.step(np.zeros(3, int))
    assert seen == [6]


def test_behaviours_play_a_side(tmp_path: Path) -> None:
    path = tmp_path / "deserted.pitch"
    path.write_text(
        """
        behavior homesick() { repeat { do move_to(right.goal) } }
        scenario deserted {
            ball at centre
            team left { CF at (-5m, 0m) }
            team right { CB at (20m, 0m) }
            reward scoring
            end limit 20 steps
        }
        """,
        encoding="utf-8",
    )
    vec = make_vec(path, 1, opponents={"right": "homesick"}, events=True, seed=1)
    vec.reset()
    vec.step(np.array([Action.IDLE]))
    assert vec.env_method("played")[0]["right_CB_1"] == Action.LEFT


def test_its_recorder_makes_a_video(tmp_path: Path) -> None:
    pytest.importorskip("moviepy")
    envs = VecVideoRecorder(
        make_vec(CLOSE, 2, render_mode="rgb_array", render_size=(160, 96)),
        str(tmp_path / "videos"),
        record_video_trigger=lambda step: step == 0,
        video_length=20,
    )
    envs.seed(1)
    envs.reset()
    for _ in range(21):
        envs.step(np.full(2, Action.RIGHT))
    envs.close()
    (video,) = tmp_path.glob("videos/*.mp4")
    assert video.stat().st_size > 1000


def test_it_learns_from_pictures() -> None:
    envs = make_vec(CLOSE, 4, observation="pixels_gray", stack=2)
    policy = PPO("CnnPolicy", envs, n_steps=16, batch_size=32, n_epochs=1, device="cpu")
    policy.learn(128)
    assert policy.predict(envs.reset())[0].shape == (4,)
