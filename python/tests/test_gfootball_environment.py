"""`create_environment`: every parameter, the shapes of every representation, rewards, states, bad
input.
"""

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import same
from gfootball_env import CLOSE, FULL, SEEDED, THREE, inside, make

import setpiece
from setpiece import (
    ActionError,
    ParameterError,
    UnavailableError,
    UnknownScenarioError,
)
from setpiece.gfootball.env import create_environment, create_remote_environment
from setpiece.gfootball.env import football_action_set as actions
from setpiece.gfootball.env.config import Config
from setpiece.gfootball.env.observation_preprocessing import generate_smm
from setpiece.gfootball.env.observation_rotation import flip_observation
from setpiece.gfootball.env.wrappers import CheckpointRewardWrapper, Simple115StateWrapper


def test_an_episode_has_one_step_more_than_its_duration() -> None:
    env = make("1_vs_1_easy", representation="raw")
    env.reset()
    steps, done = 0, False
    while not done:
        observation, _, done, _ = env.step(0)
        steps += 1
    assert steps == 501
    assert observation[0]["steps_left"] == 0
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)
    env.reset()
    env.step(0)


def test_step_needs_a_reset_after_close() -> None:
    env = make()
    env.close()
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)


def test_the_sides_take_turns_to_kick_off_the_left_one_first() -> None:
    env = make(FULL, representation="raw")
    kicking = []
    for _ in range(4):
        seen = env.reset()[0]
        reach = [
            np.min(np.linalg.norm(seen[team] - seen["ball"][:2], axis=1))
            for team in ("left_team", "right_team")
        ]
        kicking.append("left" if reach[0] < reach[1] else "right")
    assert kicking == ["left", "right", "left", "right"]


def scored(env: Any) -> tuple[float, dict[str, Any]]:
    """Runs and shoots through an episode; returns the rewards and the last step's info."""
    env.reset()
    total = 0.0
    for step in range(401):
        _, reward, done, info = env.step(actions.action_right if step < 4 else actions.action_shot)
        total += reward
        if done:
            break
    return total, info


def test_scoring_pays_both_sides() -> None:
    for seed in range(20):
        env = make(CLOSE, left=1, right=1, other_config_options={"game_engine_random_seed": seed})
        env.reset()
        for step in range(100):
            _, reward, done, info = env.step([5 if step < 4 else 12, 0])
            if done:
                break
        if info["score_reward"]:
            break
    assert info["score_reward"] == 1.0
    assert reward.tolist() == [1.0, -1.0]


def test_checkpoints_add_up_to_one() -> None:
    for seed in range(20):
        env = make(
            CLOSE,
            rewards="scoring,checkpoints",
            other_config_options={"game_engine_random_seed": seed},
        )
        total, info = scored(env)
        if info["score_reward"]:
            break
    assert total == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("distance", "collected"),
    [(1.2, 0), (0.99, 1), (0.9, 2), (0.5, 6), (0.2, 9), (0.19, 10), (0.0, 10)],
)
def test_checkpoints_by_distance(distance: float, collected: int) -> None:
    wrapper = CheckpointRewardWrapper(inside(make()))
    seen = {
        "ball_owned_team": 0,
        "ball_owned_player": 3,
        "active": 3,
        "ball": np.array([1.0 - distance, 0.0, 0.0]),
    }
    assert wrapper._paid(0, seen, 0.0) == pytest.approx(0.1 * collected)
    assert wrapper._paid(0, seen, 0.0) == 0.0, "a region pays once"
    assert wrapper._paid(1, {**seen, "active": 2}, 0.0) == 0.0, (
        "only the player with the ball is paid"
    )
    assert wrapper._paid(1, {**seen, "ball_owned_team": -1}, 0.0) == 0.0
    assert wrapper._paid(0, seen, 1.0) == pytest.approx(1.0 + 0.1 * (10 - collected))
    assert wrapper._paid(0, seen, 1.0) == 1.0, "a second goal is a goal"
    assert wrapper._paid(2, seen, -1.0) == pytest.approx(-1.0 + 0.1 * collected)


def test_agents_on_the_right_see_the_match_turned() -> None:
    env = make(left=1, right=1, representation="raw")
    left, right = env.reset()
    config = inside(env)._config
    for _ in range(30):
        turned = flip_observation(right, config)
        for key in ("left_team", "right_team", "left_team_direction", "ball", "ball_direction"):
            assert np.allclose(left[key], turned[key], atol=1e-6), key
        for key in (
            "left_team_roles",
            "right_team_active",
            "score",
            "ball_owned_team",
            "ball_owned_player",
        ):
            assert same(left[key], turned[key]), key
        assert turned["ball"][2] == right["ball"][2]
        (left, right), _, done, _ = env.step([5, 5])
        assert left["sticky_actions"].tolist() == right["sticky_actions"].tolist()
        if done:
            break


def test_directions_of_agents_on_the_right_are_turned() -> None:
    env = make(FULL, left=0, right=1, representation="raw")
    env.reset()
    for _ in range(3):
        observation = env.step(5)[0][0]
    assert observation["sticky_actions"].tolist() == [0, 0, 0, 0, 1, 0, 0, 0, 0, 0]
    whole = inside(env)._core.whole
    assert whole["right_agent_sticky_actions"][0].tolist() == [1, 0, 0, 0, 0, 0, 0, 0, 0, 0]


@pytest.mark.parametrize(
    "action",
    [
        *(
            5,
            np.int32(5),
            np.int64(5),
            [5],
            np.array([5]),
            np.array(5),
            actions.action_right,
            [actions.action_right],
        ),
        *(np.array(actions.action_right), np.array([actions.action_right])),
    ],
)
def test_action_formats(action: Any) -> None:
    env = make(representation="raw")
    env.reset()
    assert env.step(action)[0][0]["sticky_actions"][4] == 1


@pytest.mark.parametrize(
    "action", [19, -1, 1.5, "right", None, [1, 2], [], True, np.True_, np.array("right")]
)
def test_a_bad_action_leaves_the_episode_untouched(action: Any) -> None:
    env = make()
    env.reset()
    before = env.get_state()
    with pytest.raises(ActionError):
        env.step(action)
    assert env.get_state() == before
    env.step(0)


def test_any_core_action_is_taken() -> None:
    env = make()
    env.reset()
    env.step(actions.action_builtin_ai)
    env.step(actions.action_team_pressure)
    env.step(0)


def test_action_sets() -> None:
    env = make(left=2, other_config_options={"action_set": "v2"})
    assert env.action_space == gymnasium.spaces.MultiDiscrete([20, 20])
    env.reset()
    env.step([19, 19])
    with pytest.raises(ParameterError, match="did you mean `default`"):
        make(other_config_options={"action_set": "defautl"})


def test_more_slots_than_players() -> None:
    env = make("5_vs_5", left=5, right=5, representation="raw")
    observation = env.reset()
    assert [seen["active"] for seen in observation] == [1, 2, 3, 4, -1, 1, 2, 3, 4, -1]
    assert same(observation[4]["left_team"], observation[0]["left_team"])
    assert np.allclose(observation[9]["left_team"], observation[5]["left_team"], atol=1e-6)
    _, reward, _, _ = env.step([0] * 10)
    assert reward.shape == (10,)


def test_observation_shows_without_playing() -> None:
    env = make(representation="raw")
    first = env.reset()
    assert same(inside(env).observation(), first)


def test_the_designated_player_of_all(tmp_path: Path) -> None:
    script = tmp_path / "all_of_them.py"
    script.write_text(
        "from . import *\n"
        "def build_scenario(builder):\n"
        "    builder.config().control_all_players = True\n"
        "    builder.config().game_duration = 50\n"
        "    for team in (Team.e_Left, Team.e_Right):\n"
        "        builder.SetTeam(team)\n"
        "        builder.AddPlayer(-1, 0, e_PlayerRole_GK)\n"
        "        builder.AddPlayer(-0.1, 0, e_PlayerRole_CM)\n"
        "        builder.AddPlayer(-0.3, 0.1, e_PlayerRole_CM)\n"
    )
    env = make(str(script), representation="raw")
    observation = env.reset()
    assert len(observation) == 1
    assert env.action_space == gymnasium.spaces.Discrete(19)
    assert len(inside(env).observation()) == 3
    observation, reward, _, _ = env.step(5)
    assert observation[0]["active"] == observation[0]["designated"]
    assert np.shape(reward) == ()
    state = env.get_state()
    later = [env.step(5) for _ in range(5)]
    env.set_state(state)
    assert same(later, [env.step(5) for _ in range(5)])
    both = make(str(script), left=1, right=1, representation="simple115v2")
    assert both.reset().shape == (2, 115)
    assert both.action_space == gymnasium.spaces.MultiDiscrete([19, 19])
    assert both.step([5, 5])[1].shape == (2,)


def test_a_waiting_set_piece_is_taken_for_the_agents() -> None:
    env = make(FULL, representation="raw")
    core = inside(env)._core
    env.reset()
    core.waiting = 20
    assert core._hurried([actions.action_idle]) == [actions.action_short_pass]
    core.slots = [
        {**core.slots[0], "ball_owned_team": 0, "ball_owned_player": core.slots[0]["active"]}
    ]
    core.waiting = 21
    assert core._hurried([actions.action_top]) == [actions.action_right]
    core.waiting = 30
    assert core._hurried([actions.action_top]) == [actions.action_left]
    core.slots[0]["ball_owned_team"] = 1
    assert core._hurried([actions.action_top]) == [actions.action_idle]


def test_grf_bugs() -> None:
    def first(bugs: Any) -> Any:
        return make(FULL, representation="raw", other_config_options={"grf_bugs": bugs}).reset()[0]

    assert first(False)["game_mode"] == 1
    assert first(["kick_off_mode"])["game_mode"] == 0
    assert first(["first_active"])["active"] == 6
    assert first(True)["active"] == 6
    assert (
        make(THREE, representation="raw", other_config_options={"grf_bugs": True}).reset()[0][
            "active"
        ]
        == 0
    )
    with pytest.raises(ParameterError, match="did you mean `first_active`"):
        first(["first_activ"])
    with pytest.raises(ParameterError):
        first(3)


def test_players_who_were_sent_off() -> None:
    raw = make(representation="raw").reset()[0]
    raw["left_team_active"] = np.array([True, True, False, True])
    numbers = Simple115StateWrapper.convert_observation([raw], fixed_positions=True)[0]
    assert numbers[4:6].tolist() == numbers[26:28].tolist() == [-1, -1]
    kept = Simple115StateWrapper.convert_observation(
        [raw], fixed_positions=True, sent_off_stay=True
    )[0]
    assert np.allclose(kept[4:6], raw["left_team"][2])
    assert np.count_nonzero(generate_smm([raw])[0, :, :, 0]) == 3
    config = Config({"level": THREE, "grf_bugs": ["sent_off"]})
    assert np.count_nonzero(generate_smm([raw], config)[0, :, :, 0]) == 4


def test_real_time_paces_the_steps() -> None:
    import time

    env = make(CLOSE, other_config_options={"real_time": True})
    env.reset()
    begun = time.monotonic()
    for _ in range(4):
        env.step(0)
    assert time.monotonic() - begun >= 0.3


@pytest.mark.parametrize(
    "kwargs",
    [
        {"extra_players": ["ppo2_cnn:right_players=1,checkpoint=x"]},
        {"other_config_options": {"physics_steps_per_frame": 5}},
    ],
)
def test_what_is_not_here_says_so(kwargs: dict[str, Any]) -> None:
    with pytest.raises(UnavailableError, match="not in this version") as caught:
        make(**kwargs)
    assert isinstance(caught.value, NotImplementedError)
    assert caught.value.name
    assert caught.value.help


def test_what_is_not_here_says_so_later() -> None:
    env = make()
    env.tracker_setup(0, 1)
    with pytest.raises(UnavailableError):
        create_remote_environment("me", "token")
    assert env.disable_render()
    env.close()
    env.reset()


@pytest.mark.parametrize(
    ("kwargs", "words"),
    [
        ({"env_name": ""}, "`env_name` is empty"),
        ({"env_name": 3}, "`env_name` is 3"),
        ({"other_config_options": 3}, "other_config_options"),
        ({"representation": "simple115v3"}, "did you mean `simple115v2`"),
        ({"rewards": "checkpoints"}, "lacks `scoring`"),
        ({"rewards": "scoring,checkpoint"}, "did you mean `checkpoints`"),
        ({"representation": "raw", "stacked": True}, "stacked"),
        ({"number_of_left_players_agent_controls": -1}, "number_of_left"),
        ({"number_of_right_players_agent_controls": 12}, "at most 11"),
        ({"dump_frequency": 0}, "dump_frequency"),
        ({"channel_dimensions": (0, 5)}, "channel_dimensions"),
        ({"channel_dimensions": (10,), "representation": "simple115v2"}, "channel_dimensions"),
        ({"channel_dimensions": (9.5, 9), "representation": "raw"}, "channel_dimensions"),
        ({"logdir": 5}, "`logdir` is 5"),
        ({"number_of_left_players_agent_controls": True}, "number_of_left"),
        ({"number_of_left_players_agent_controls": 1.0}, "number_of_left"),
        ({"extra_players": 5}, "`extra_players` is a list"),
        ({"other_config_options": {"tracesdir": 5}}, "`tracesdir` is 5"),
        ({"other_config_options": {"episode_number": "x"}}, "episode_number"),
        ({"other_config_options": {"render_resolution_x": "x"}}, "render_resolution_x"),
        ({"other_config_options": {"game_engine_random_seed": -1}}, "from 0 on"),
        ({"extra_players": "lazy"}, "extra_players"),
        ({"extra_players": ["bott:right_players=1"]}, "did you mean `bot`"),
        ({"extra_players": ["agent:right_players=1"]}, "at most one `agent`"),
        ({"extra_players": ["lazy:right_players=many"]}, "no count"),
        ({"extra_players": ["lazy:right_players"]}, "not a setting"),
        ({"extra_players": ["replay:right_players=1"]}, "needs a dump"),
        ({"other_config_options": {"action_sett": "v2"}}, "did you mean `action_set`"),
        ({"other_config_options": {"game_engine_random_seed": "x"}}, "game_engine_random_seed"),
        ({"other_config_options": {"video_format": "mp4"}}, "no video format `mp4`"),
    ],
)
def test_bad_input(kwargs: dict[str, Any], words: str) -> None:
    with pytest.raises(ParameterError, match=words) as caught:
        create_environment(**{"env_name": CLOSE, **kwargs})
    assert isinstance(caught.value, ValueError)


def test_numbers_of_numpy_are_numbers(tmp_path: Path) -> None:
    env = create_environment(
        THREE,
        representation="raw",
        logdir=tmp_path,
        dump_frequency=np.int64(2),
        number_of_left_players_agent_controls=np.int64(2),
        number_of_right_players_agent_controls=np.uint8(1),
        channel_dimensions=np.array([10, 20]),
        other_config_options={
            "game_engine_random_seed": np.int64(7),
            "episode_number": np.int32(2),
        },
    )
    assert same(env.reset()[0], make(representation="raw", left=2, right=1).reset()[0])
    config = inside(env)._config
    assert type(config["game_engine_random_seed"]) is int
    assert config["tracesdir"] == str(tmp_path)


def test_unknown_scenario() -> None:
    with pytest.raises(UnknownScenarioError, match="did you mean `academy_corner`"):
        create_environment("academy_cornr")
    with pytest.raises(UnknownScenarioError):
        create_environment("no.such.module")


@pytest.mark.parametrize("arguments", [{"seed": 3}, {"options": {}}])
def test_reset_takes_nothing(arguments: dict[str, Any]) -> None:
    env = make()
    with pytest.raises(ParameterError, match="game_engine_random_seed"):
        env.reset(**arguments)


def test_config() -> None:
    config = Config({"level": THREE, **SEEDED})
    assert (config["level"], config.get("render_resolution_y"), config.get("nothing", 3)) == (
        THREE,
        720,
        3,
    )
    assert config["episode_number"] == 1
    config.NewScenario()
    assert config["episode_number"] == 2
    recorded = config.ScenarioConfig()
    assert (recorded.game_duration, recorded.controllable_left_players, recorded.left_agents) == (
        400,
        4,
        1,
    )
    assert recorded.dynamic_player_selection
    assert config["game_engine_random_seed"] == 7
    twin = Config({"level": THREE, **SEEDED})
    assert config != twin
    twin.NewScenario()
    assert config == twin
    assert config.serialize()["level"] == THREE
    with pytest.raises(ParameterError, match="did you mean `level`"):
        config["levell"]
    with pytest.raises(ParameterError, match="did you mean `game_duration`"):
        recorded.game_durations = 3


@pytest.mark.parametrize("name", setpiece.list())
def test_every_level_of_the_library(name: str) -> None:
    env = create_environment(name, representation="simple115v2", rewards="scoring,checkpoints")
    for _ in range(2):
        env.reset()
        for _ in range(10):
            if env.step(env.action_space.sample())[2]:
                break
