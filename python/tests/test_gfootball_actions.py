"""Actions as objects, their sets, and turning them."""

import numpy as np
import pytest

import setpiece
from setpiece import ActionError, ParameterError
from setpiece.gfootball.env import football_action_set as actions
from setpiece.gfootball.env import observation_preprocessing as preprocessing
from setpiece.gfootball.env.observation_rotation import flip_single_action, rotate_sticky_actions

DEFAULT = {"action_set": "default"}
FULL = {"action_set": "full"}


def test_the_sets_grow() -> None:
    sets = actions.action_set_dict
    assert [len(sets[name]) for name in ("default", "v2", "full")] == [19, 20, 33]
    assert sets["v2"][:19] == sets["default"] == actions.action_set_v1
    assert sets["full"][:20] == sets["v2"] == actions.action_set_v2
    assert sets["v2"][19] is actions.action_builtin_ai
    assert len(set(sets["full"])) == 33


def test_numbers_and_names() -> None:
    default = actions.action_set_dict["default"]
    assert [action.name for action in default[9:]] == [
        *(
            "long_pass",
            "high_pass",
            "short_pass",
            "shot",
            "sprint",
            "release_direction",
            "release_sprint",
            "sliding",
        ),
        *("dribble", "release_dribble"),
    ]
    assert actions.action_set_dict["full"][23] is actions.action_switch
    assert (actions.action_sprint.backend_action, actions.action_builtin_ai.backend_action) == (
        18,
        32,
    )
    assert str(actions.action_short_pass) == "short_pass"
    assert actions.action_shot == actions.CoreAction(12, "shot")
    assert actions.action_shot != actions.action_sliding
    assert actions.action_left.directional
    assert not actions.action_shot.sticky


def test_sticky_actions_by_set() -> None:
    names = [action.name for action in actions.get_sticky_actions(FULL)]
    assert names[:10] == [action.name for action in actions.get_sticky_actions(DEFAULT)]
    assert names[8:] == ["sprint", "dribble", "keeper_rush", "pressure", "team_pressure"]


def test_an_action_by_its_number() -> None:
    default = actions.get_action_set(DEFAULT)
    assert actions.named_action_from_action_set(default, np.int32(12)) is actions.action_shot
    assert (
        actions.named_action_from_action_set(default, actions.action_switch)
        is actions.action_switch
    )
    assert (
        actions.named_action_from_action_set(default, np.array(actions.action_shot))
        is actions.action_shot
    )
    with pytest.raises(ActionError, match="found `array"):
        actions.named_action_from_action_set(default, np.array([1, 2]))
    with pytest.raises(ActionError, match=r"outside 0\.\.18"):
        actions.named_action_from_action_set(default, 19)
    with pytest.raises(ParameterError, match="did you mean `full`"):
        actions.get_action_set({"action_set": "ful"})


@pytest.mark.parametrize(
    ("number", "turned"), [(0, 0), (1, 5), (2, 6), (3, 7), (4, 8), (5, 1), (8, 4), (9, 9), (18, 18)]
)
def test_only_directions_turn(number: int, turned: int) -> None:
    assert flip_single_action(number, DEFAULT) == turned
    named = actions.get_action_set(DEFAULT)
    assert flip_single_action(named[number], DEFAULT) is named[turned]
    assert flip_single_action(np.array(named[number]), DEFAULT) is named[turned]


def test_sticky_directions_turn() -> None:
    held = np.zeros(13, np.uint8)
    held[[2, 8, 11]] = 1
    assert np.flatnonzero(rotate_sticky_actions(held, FULL)).tolist() == [6, 8, 11]
    assert len(rotate_sticky_actions([], DEFAULT)) == 0


def test_minimap_edges() -> None:
    frame = np.zeros((72, 96), np.uint8)
    preprocessing.mark_points(frame, [(-1.0, -1 / 2.25), (1.0, 1 / 2.25), (3.0, -3.0)])
    assert np.argwhere(frame).tolist() == [[0, 0], [0, 95], [71, 95]]
    assert (preprocessing.SMM_WIDTH, preprocessing.SMM_HEIGHT) == (96, 72)
    assert preprocessing.get_smm_layers() == ["left_team", "right_team", "ball", "active"]


def test_the_engines_actions_have_the_same_numbers() -> None:
    native = [name for name, _ in setpiece._native.ACTIONS]
    assert native == [action.name for action in actions.action_set_full]
