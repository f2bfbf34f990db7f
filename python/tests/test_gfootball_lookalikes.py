"""What Google Research Football's own tests expect, as scenes and checks of this package."""

import io
import pickle
import pickletools
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from conftest import same

from setpiece import ActionError, ParameterError
from setpiece.gfootball import _translation, install
from setpiece.gfootball.env import create_environment
from setpiece.gfootball.env import football_action_set as actions
from setpiece.gfootball.env.config import Config
from setpiece.gfootball.env.football_env import FootballEnv
from setpiece.gfootball.env.observation_processor import read_dump
from setpiece.gfootball.env.observation_rotation import (
    flip_action,
    flip_observation,
    flip_single_action,
)
from setpiece.gfootball.env.scenario_config import ScenarioConfig
from setpiece.gfootball.env.script_helpers import ScriptHelpers

CLOSE = "academy_empty_goal_close"
FULL = "11_vs_11_stochastic"
EVERYBODY = "tests.multiagent_wrapper"
SETTINGS = {"action_set": "default"}


def make(name: str, left: int = 1, right: int = 0, **kwargs: Any) -> Any:
    return create_environment(
        name,
        number_of_left_players_agent_controls=left,
        number_of_right_players_agent_controls=right,
        **kwargs,
    )


def test_whatever_lasts_can_be_ended() -> None:
    for name in ("default", "v2", "full"):
        offered = actions.action_set_dict[name]
        for action in offered:
            if action.sticky:
                assert actions.disable_action(action) in offered
            assert action.is_in_actionset({"action_set": name})
    assert not actions.action_switch.is_in_actionset(SETTINGS)


@pytest.mark.parametrize("name", [*actions.DIRECTIONS, "release_direction"])
def test_any_direction_is_ended_by_one_action(name: str) -> None:
    action = getattr(actions, f"action_{name}")
    assert actions.disable_action(action) is actions.action_release_direction


@pytest.mark.parametrize(
    "name",
    [
        *(
            "long_pass",
            "high_pass",
            "short_pass",
            "shot",
            "keeper_rush",
            "sliding",
            "pressure",
            "team_pressure",
        ),
        *("switch", "sprint", "dribble"),
    ],
)
def test_a_button_and_its_release_end_each_other(name: str) -> None:
    pressed, released = (
        getattr(actions, f"action_{name}"),
        getattr(actions, f"action_release_{name}"),
    )
    assert actions.disable_action(pressed) is released
    assert actions.disable_action(released) is pressed


@pytest.mark.parametrize("action", [actions.action_idle, actions.action_builtin_ai, 5, None])
def test_what_nothing_ends(action: Any) -> None:
    with pytest.raises(ActionError):
        actions.disable_action(action)


@pytest.mark.parametrize(("left", "right"), [(2, 0), (10, 0), (0, 2), (1, 2), (11, 1), (2, 11)])
def test_a_part_of_a_team_is_refused_where_agents_play_all(left: int, right: int) -> None:
    with pytest.raises(ParameterError, match="or for all of them") as caught:
        make(EVERYBODY, left, right)
    # The programs of GRF expect its `assert`.
    assert isinstance(caught.value, AssertionError)
    assert caught.value.help == "ask for 0 or 11 on the left, and for 0 or 11 on the right"


@pytest.mark.parametrize(
    ("left", "right", "seen"),
    [(11, 11, 22), (11, 0, 11), (0, 11, 11), (1, 1, 2), (1, 0, 1), (0, 1, 1)],
)
def test_nobody_everybody_or_one_for_the_team(left: int, right: int, seen: int) -> None:
    env = make(EVERYBODY, left, right, representation="raw", rewards="scoring,checkpoints")
    assert len(env.reset()) == seen


def test_a_script_may_ask_for_all_players(tmp_path: Path) -> None:
    script = tmp_path / "two.py"
    script.write_text(
        "from . import *\n"
        "def build_scenario(builder):\n"
        "    builder.config().control_all_players = True\n"
        "    for team in (Team.e_Left, Team.e_Right):\n"
        "        builder.SetTeam(team)\n"
        "        builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK, controllable=False)\n"
        "        for y in (-0.1, 0.0, 0.1):\n"
        "            builder.AddPlayer(-0.3, y, e_PlayerRole_CM)\n"
    )
    assert len(make(str(script), 3, 0, representation="raw").reset()) == 3
    with pytest.raises(AssertionError, match="2 of 3 on the left"):
        make(str(script), 2, 0)


@pytest.mark.parametrize("level", [CLOSE, EVERYBODY])
@pytest.mark.parametrize(
    "kwargs",
    [
        {"representation": "raw"},
        {"representation": "simple115v2"},
        {"rewards": "scoring,checkpoints"},
        {"representation": "extracted", "stacked": True},
        {"dump_frequency": 2},
    ],
)
def test_a_step_before_the_first_reset_plays(level: str, kwargs: dict[str, Any]) -> None:
    env = make(level, **kwargs)
    observation, reward, done, info = env.step(5)
    assert not done
    assert info["score_reward"] == 0
    # A player who starts with the ball beyond checkpoints is paid for them at once.
    assert reward == 0 or "rewards" in kwargs
    if isinstance(observation, np.ndarray):
        assert observation in env.observation_space
    env.reset()
    env.step(5)


def test_a_match_that_was_never_reset_ends_like_any_other() -> None:
    env = FootballEnv(Config({"level": "tests.second_half"}))
    assert env.observation()[0]["steps_left"] == 11
    done, steps = False, 0
    while not done:
        _, _, done, _ = env.step(actions.action_idle)
        steps += 1
    assert steps == 11


def test_the_mode_of_a_kick_off() -> None:
    def shown(**options: Any) -> int:
        return int(
            make(FULL, representation="raw", other_config_options=options).reset()[0]["game_mode"]
        )

    assert shown() == 0
    assert shown(grf_bugs=True) == 0
    assert shown(grf_bugs=False) == 1


def test_a_kick_off_is_not_hurried() -> None:
    env = make("1_vs_1_easy", representation="raw")
    env.reset()
    env.step(0)
    assert env.unwrapped._core.waiting == 0


def test_a_waiting_set_piece_has_no_owner_except_a_throw_in() -> None:
    seen: dict[int, set[bool]] = {}
    for seed in range(12):
        env = make(
            "11_vs_11_easy_stochastic",
            1,
            1,
            representation="raw",
            other_config_options={"grf_bugs": False},
        )
        env.seed(seed)
        env.reset()
        chosen = np.random.default_rng(seed)
        for _ in range(2500):
            left, right = env.step(chosen.integers(0, 19, 2))[0]
            owned = left["ball_owned_team"] != -1
            assert owned == (left["ball_owned_player"] != -1) == (right["ball_owned_team"] != -1)
            assert not owned or left["ball_owned_team"] == 1 - right["ball_owned_team"]
            seen.setdefault(int(left["game_mode"]), set()).add(owned)
        if {1, 2, 3, 4, 5} <= seen.keys():
            break
    for mode, owned_ever in seen.items():
        if mode != 0:
            assert owned_ever == {mode == 5}, mode
    assert {1, 2, 3, 4, 5} <= seen.keys()


def test_a_waiting_penalty_has_no_owner() -> None:
    env = FootballEnv(Config({"level": "tests.penalty"}))
    env.reset()
    done, waiting = False, []
    while not done:
        [seen], _, done, _ = env.step([actions.action_sliding])
        if seen["game_mode"] == 6:
            waiting.append((seen["ball_owned_team"], seen["ball_owned_player"]))
    assert waiting
    assert set(waiting) == {(-1, -1)}


@pytest.mark.parametrize(
    "level", ["tests.corner_test", "tests.keeper_test", "tests.offside_test", "tests.goal_test"]
)
@pytest.mark.parametrize("episode", [0, 1])
def test_the_order_of_teams_is_taken_and_changes_nothing(level: str, episode: int) -> None:
    def played(reverse: bool) -> list[Any]:
        settings = {
            "level": level,
            "players": ["agent:left_players=1,right_players=1"],
            "episode_number": episode,
            "game_engine_random_seed": 3,
            "reverse_team_processing": reverse,
        }
        config = Config(settings)
        env = FootballEnv(config)
        shown, done = [env.reset()], False
        assert config.ScenarioConfig().reverse_team_processing is reverse
        while not done:
            observation, _, done, _ = env.step([actions.action_right, actions.action_right])
            shown.append(observation)
        return shown

    assert same(played(True), played(False))


def test_a_script_may_set_the_order_of_teams(tmp_path: Path) -> None:
    script = tmp_path / "turned.py"
    script.write_text(
        "from . import *\n"
        "def build_scenario(builder):\n"
        "    builder.config().reverse_team_processing = True\n"
        "    builder.SetTeam(Team.e_Left)\n"
        "    builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)\n"
        "    builder.AddPlayer(0.0, 0.02, e_PlayerRole_CF)\n"
    )
    env = make(str(script), representation="raw")
    env.reset()
    env.step(5)
    assert env.unwrapped._config.ScenarioConfig().reverse_team_processing
    with pytest.raises(ParameterError, match="reverse_team_processing"):
        make(CLOSE, other_config_options={"reverse_team_processing": "yes"})


def test_flipping_twice_changes_no_value_and_no_type() -> None:
    """Also for observations that nobody has played: flat teams, a ball of integers, lists."""
    draw = np.random.default_rng(5)
    made: dict[str, Any] = {
        "ball": np.array([1, -1, 0]),
        "ball_direction": draw.normal(size=3).astype(np.float32),
        "ball_rotation": draw.normal(size=3),
        "ball_owned_team": 1,
        "ball_owned_player": 4,
        "game_mode": 17,
        "score": [2, 7],
        "steps_left": 9,
    }
    for side in ("left", "right"):
        for key, values in (
            ("", 22),
            ("_direction", 22),
            ("_tired_factor", 11),
            ("_roles", 11),
            ("_yellow_card", 11),
        ):
            made[f"{side}_team{key}"] = draw.normal(size=values)
        made[f"{side}_team_active"] = [True]
        made[f"{side}_team_designated_player"] = 3
        made[f"{side}_agent_controlled_player"] = [5]
        made[f"{side}_agent_sticky_actions"] = [[draw.normal(size=2) for _ in range(10)]]
    again = flip_observation(flip_observation(made, SETTINGS), SETTINGS)
    assert same(again, made)
    assert repr(sorted(again.items())) == repr(sorted(made.items()))


def test_flipping_twice_leaves_a_played_observation_as_it_was() -> None:
    env = make(FULL, 1, 1, representation="raw")
    env.reset()
    for _ in range(3):
        views, _, _, _ = env.step([3, 13])
    for shown in (*views, env.unwrapped._core.whole):
        again = flip_observation(flip_observation(shown, SETTINGS), SETTINGS)
        assert again.keys() == shown.keys()
        assert same(again, shown)


def test_flipping_actions_twice() -> None:
    for action in actions.action_set_v1:
        assert flip_single_action(flip_single_action(action, SETTINGS), SETTINGS) is action
    pressed = [actions.action_left, actions.action_shot]
    assert flip_action(pressed, SETTINGS) == [actions.action_right, actions.action_shot]
    assert flip_action(actions.action_top, SETTINGS) is actions.action_bottom
    assert flip_action(np.array([1, 12]), SETTINGS) == [5, 12]


def dumped(folder: Path) -> Path:
    env = make(
        "academy_3_vs_1_with_keeper",
        2,
        1,
        write_full_episode_dumps=True,
        logdir=str(folder),
        representation="raw",
    )
    env.reset()
    env.action_space.seed(3)
    done = False
    while not done:
        _, _, done, info = env.step(env.action_space.sample())
    return Path(info["dumps"][0]["dump"])


def test_a_dump_names_nothing_of_this_package(tmp_path: Path) -> None:
    texts: list[Any] = []
    named = set()
    with dumped(tmp_path).open("rb") as file:
        while file.peek(1):
            for opcode, argument, _ in pickletools.genops(file):
                if opcode.name == "PROTO":
                    assert argument <= 4, "GRF runs on Python 3.6, too"
                elif "UNICODE" in opcode.name:
                    texts.append(argument)
                elif opcode.name == "STACK_GLOBAL":
                    named.add(tuple(texts[-2:]))
    assert "gfootball.env.football_action_set" in texts
    assert named <= {("builtins", "getattr"), ("importlib", "import_module"), ("numpy", "array")}


@pytest.mark.usefixtures("nothing_installed")
def test_a_dump_loads_by_names_of_grf_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = dumped(tmp_path)
    records = read_dump(str(path))
    real = ModuleType("gfootball.env.football_action_set")
    for name in actions.BACKEND_NAMES:
        setattr(real, f"action_{name}", f"GRF's {name}")
    for name in ("gfootball", "gfootball.env"):
        monkeypatch.setitem(sys.modules, name, ModuleType(name))
    monkeypatch.setitem(sys.modules, real.__name__, real)
    with path.open("rb") as file:
        for record in records:
            loaded = pickle.load(file)
            assert loaded["debug"]["action"] == [
                f"GRF's {action}" for action in record["debug"]["action"]
            ]
            assert same(loaded["observation"], record["observation"])


@pytest.mark.usefixtures("nothing_installed")
def test_a_dump_loads_by_pickle_after_install(tmp_path: Path) -> None:
    path = dumped(tmp_path)
    install()
    with path.open("rb") as file:
        assert pickle.load(file)["debug"]["action"] == read_dump(str(path))[0]["debug"]["action"]


class e_BackendAction(int):  # noqa: N801  # GRF's name
    """GRF's engine numbers actions by an integer type of its own."""


def written_by_grf(records: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch) -> bytes:
    """Returns records as in GRF's pickles: with its classes, which don't exist when read."""

    class CoreAction:
        def __init__(self, action: actions.CoreAction) -> None:
            self._backend_action = e_BackendAction(action.backend_action)
            self._name, self._sticky, self._directional = (
                action.name,
                action.sticky,
                action.directional,
            )

    CoreAction.__qualname__ = "CoreAction"
    CoreAction.__module__ = "gfootball.env.football_action_set"
    engine, module = ModuleType("_gameplayfootball"), ModuleType(CoreAction.__module__)
    module.CoreAction = CoreAction  # type: ignore[attr-defined]
    engine.e_BackendAction = e_BackendAction  # type: ignore[attr-defined]
    file = io.BytesIO()
    with monkeypatch.context() as patch:
        for name in ("gfootball", "gfootball.env"):
            patch.setitem(sys.modules, name, ModuleType(name))
        patch.setitem(sys.modules, module.__name__, module)
        patch.setitem(sys.modules, engine.__name__, engine)
        patch.setattr(e_BackendAction, "__module__", engine.__name__)
        for record in records:
            debug = {
                **record["debug"],
                "action": [CoreAction(each) for each in record["debug"]["action"]],
            }
            pickle.dump({**record, "debug": debug}, file, 4)
    return file.getvalue()


@pytest.mark.usefixtures("nothing_installed")
def test_a_dump_of_grf_loads_and_plays_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ours = read_dump(str(dumped(tmp_path)))
    # Settings of GRF that this package doesn't write.
    config = {**ours[0]["debug"]["config"], "reverse_team_processing": True, "write_video": True}
    del config["grf_bugs"]
    records = [{**ours[0], "debug": {**ours[0]["debug"], "config": config}}, *ours[1:]]
    path = tmp_path / "grf.dump"
    path.write_bytes(written_by_grf(records, monkeypatch))
    helpers = ScriptHelpers()
    loaded = helpers.load_dump(str(path))
    for record, expected in zip(loaded, records, strict=True):
        assert record["debug"]["action"] == expected["debug"]["action"]
        assert {type(action) for action in record["debug"]["action"]} == {actions.CoreAction}
        assert same(record["observation"], expected["observation"])
    action = loaded[0]["debug"]["action"][0]
    assert action.backend_action == actions.BACKEND_NAMES.index(action.name)
    assert len(helpers.replay(str(path), render=False)) == len(records)


def test_an_order_of_teams_needs_no_words_in_a_text() -> None:
    env = make(CLOSE)
    recorded = env.unwrapped._config.ScenarioConfig()
    plain = _translation.to_pitch(recorded, "turned")
    turned = ScenarioConfig(**{**vars(recorded), "reverse_team_processing": True})
    assert _translation.to_pitch(turned, "turned", recorded) == plain


def test_the_second_half_begins_after_five_steps() -> None:
    """The left player begins at the ball, and in the second half in the right one's place."""
    env = FootballEnv(Config({"level": "tests.second_half"}))
    env.reset()
    done, across = False, []
    while not done:
        [seen], _, done, _ = env.step(actions.action_idle)
        across.append(float(seen["left_team"][1][0]))
    assert np.allclose(across, [0.0] * 5 + [-0.5] * 6, atol=0.1)


def test_the_second_half_of_a_script_begins_as_late(tmp_path: Path) -> None:
    script = tmp_path / "halves.py"
    script.write_text(
        "from . import *\n"
        "def build_scenario(builder):\n"
        "    builder.config().game_duration = 30\n"
        "    builder.config().second_half = 20\n"
        "    for team, x in ((Team.e_Left, 0.0), (Team.e_Right, -0.5)):\n"
        "        builder.SetTeam(team)\n"
        "        builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK, lazy=True)\n"
        "        builder.AddPlayer(x, 0.02, e_PlayerRole_CM, lazy=True)\n"
    )
    env = FootballEnv(Config({"level": str(script)}))
    env.reset()
    done, across = False, []
    while not done:
        [seen], _, done, _ = env.step(actions.action_idle)
        across.append(float(seen["left_team"][1][0]))
    assert np.allclose(across, [0.0] * 20 + [-0.5] * 11, atol=0.1)
    assert env.unwrapped._config.ScenarioConfig().second_half == 20


def test_the_library_knows_when_a_second_half_begins() -> None:
    for level, begins in (("11_vs_11_kaggle", 1500), ("tests.second_half", 5), (FULL, 999_999_999)):
        assert Config({"level": level}).ScenarioConfig().second_half == begins


def ended(level: str, episode: int, pressed: list[Any], *, reverse: bool = False) -> dict[str, Any]:
    """Returns the first slot's last observation if every slot always presses one action."""
    sides = ("left", "right")[: len(pressed)]
    settings = {
        "level": f"tests.{level}",
        "players": [f"agent:{','.join(f'{side}_players=1' for side in sides)}"],
        "episode_number": episode,
        "reverse_team_processing": reverse,
    }
    env = FootballEnv(Config(settings))
    [seen, *_], done = env.reset(), False
    while not done:
        [seen, *_], _, done, _ = env.step(pressed)
    return seen


ORDERS = pytest.mark.parametrize("reverse", [False, True])


def near(place: Any, expected: tuple[float, float], within: float) -> bool:
    return bool(np.allclose(np.asarray(place)[:2], expected, atol=within))


@ORDERS
@pytest.mark.parametrize(("episode", "side"), [(0, 1.0), (1, -1.0)])
def test_the_places_at_a_corner(episode: int, side: float, reverse: bool) -> None:
    """Leading the ball over the own line gives a corner away, and lazy players don't take it."""
    seen = ended("corner_test", episode, [actions.action_left] * 2, reverse=reverse)
    assert seen["game_mode"] == 4
    assert near(seen["ball"], (-1.011 * side, 0.431 * side), 0.01)
    taker, defender = ("right", "left") if side > 0 else ("left", "right")
    assert near(seen[f"{taker}_team"][1], (-1.046 * side, 0.446 * side), 0.01)
    assert near(seen[f"{defender}_team"][1], (-0.95 * side, -0.084 * side), 0.01)
    assert near(seen["left_team"][2], (-0.959, 0.013) if side > 0 else (0.354, -0.04), 0.01)
    assert near(seen["left_team"][0], (-0.991, 0.0), 0.01)
    assert near(seen["right_team"][0], (0.991, 0.0), 0.01)
    assert seen["active"] == (2 if side > 0 else 1)


@ORDERS
@pytest.mark.parametrize(("episode", "side"), [(0, 1.0), (1, -1.0)])
def test_the_places_at_a_goal_kick(episode: int, side: float, reverse: bool) -> None:
    seen = ended("keeper_test", episode, [actions.action_right] * 2, reverse=reverse)
    assert seen["game_mode"] == 2
    assert near(seen["ball"], (0.93 * side, 0.0), 0.01)
    own, other = ("right", "left") if side > 0 else ("left", "right")
    assert near(seen[f"{own}_team"][0], (0.972 * side, 0.0), 0.01)
    assert near(seen[f"{own}_team"][1], (0.414 * side, 0.232 * side), 0.01)
    assert near(seen[f"{other}_team"][0], (-0.991 * side, 0.0), 0.01)
    assert near(seen[f"{other}_team"][1], (-0.339 * side, -0.232 * side), 0.01)
    assert near(seen["left_team"][2], (-0.404, -0.045) if side > 0 else (-0.506, -0.045), 0.01)
    assert seen["active"] == (1 if side > 0 else 0)


def test_a_lazy_player_never_takes_a_penalty() -> None:
    seen = ended("penalty", 1, [actions.action_sliding])
    assert seen["game_mode"] == 6
    assert near(seen["ball"], (-0.809, 0.0), 0.01)
    assert near(seen["left_team"][0], (-0.991, 0.0), 0.01)
    assert near(seen["left_team"][1], (-0.699, -0.233), 0.01)
    assert near(seen["right_team"][0], (0.991, 0.0), 0.01)
    assert near(seen["right_team"][1], (-0.754, 0.0), 0.01)
    assert seen["active"] == 0


@ORDERS
@pytest.mark.parametrize(("episode", "side"), [(0, "left"), (1, "right")])
def test_a_goal_in_either_net(episode: int, side: str, reverse: bool) -> None:
    seen = ended("goal_test", episode, [actions.action_right] * 2, reverse=reverse)
    assert list(seen["score"]) == ([1, 0] if side == "left" else [0, 1])
    assert near(seen["ball"], (0.0, 0.0), 0.1)


@ORDERS
@pytest.mark.parametrize(("episode", "side"), [(1, "left"), (0, "right")])
def test_a_keepers_pass_to_an_offside_mate(episode: int, side: str, reverse: bool) -> None:
    """The agent begins with the keeper, nearest to the ball, and passes to an offside teammate."""
    settings = {
        "level": "tests.offside_test",
        "players": [f"agent:{side}_players=1"],
        "episode_number": episode,
        "reverse_team_processing": reverse,
    }
    env = FootballEnv(Config(settings))
    assert env.reset()[0]["active"] == 0
    [seen], _, done, _ = env.step(actions.action_long_pass)
    assert seen["active"] == 0
    while not done and seen["game_mode"] != 3:
        [seen], _, done, _ = env.step(actions.action_idle)
    assert seen["game_mode"] == 3
    assert 0.6 < seen["ball"][0] < 1.0
    assert near(seen["left_team"][0], (-0.991, 0.0), 0.01)
    assert near(seen["left_team"][1], (-0.37, -0.22), 0.1)
    assert near(seen["right_team"][1], (0.64, 0.1), 0.15)
    for _ in range(8):
        if not done:
            [seen], _, done, _ = env.step(actions.action_idle)
            assert seen["game_mode"] == 3, "the lazy never take it"


@pytest.mark.parametrize(
    "sides", ["left_players=1,right_players=1", "left_players=1", "right_players=2"]
)
def test_a_symmetric_match_in_the_other_order_is_the_turned_match(sides: str) -> None:
    """Each agent sees what the other one saw: both press the same, in their own frames."""

    def played(reverse: bool, sides: str) -> list[list[dict[str, Any]]]:
        settings = {
            "level": "tests.symmetric",
            "players": [f"agent:{sides}"],
            "game_engine_random_seed": 4,
            "reverse_team_processing": reverse,
        }
        env = FootballEnv(Config(settings))
        shown = [env.reset()]
        env.tracker_setup(0, 400)
        draw = np.random.default_rng(6)
        for _ in range(400):
            action = actions.action_set_v1[int(draw.integers(19))]
            observation, _, _, _ = env.step([action] * len(shown[0]))
            shown.append(observation)
        return shown

    turned = sides.replace("left", "no").replace("right", "left").replace("no", "right")
    for one, other in zip(played(False, sides), played(True, turned), strict=True):
        assert len(one) == len(other)
        # The slots of the left team come first.
        half = len(one) // 2 if "," in sides else 0
        for seen, expected in zip(one, [*other[half:], *other[:half]], strict=True):
            assert same(seen, expected)
