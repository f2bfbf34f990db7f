"""The built-in bot: its choice for agents, and matches among bots."""

import pickle
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import play, same
from environment_texts import SEVERAL
from gymnasium.utils.env_checker import check_env

import setpiece
from setpiece import Action

THREE = "academy_3_vs_1_with_keeper"


def test_an_action_of_the_bots_is_asked_for_by_its_set() -> None:
    default, v2 = setpiece.make(THREE), setpiece.make(THREE, action_set="v2")
    assert default.action_space == gymnasium.spaces.Discrete(19)
    assert v2.action_space == gymnasium.spaces.Discrete(20)
    assert setpiece.make(setpiece.compile(SEVERAL), action_set="v2").action_space.shape == (4,)
    assert v2.reset(seed=1)[1]["action_mask"].shape == (20,)
    assert v2.action_masks()[Action.BUILTIN_AI] == 1
    assert same(
        play(default, 1, lambda: 5)[-1][4]["setpiece"], play(v2, 1, lambda: 5)[-1][4]["setpiece"]
    )
    with pytest.raises(setpiece.ParameterError, match="did you mean `default`") as caught:
        setpiece.make(THREE, action_set="defalt")
    assert caught.value.name == "action_set"
    default.reset(seed=1)
    with pytest.raises(setpiece.ActionError, match=r"0\.\.18") as refused:
        default.step(Action.BUILTIN_AI)
    assert 'action_set="v2"' in (refused.value.help or "")
    with pytest.raises(setpiece.ActionError, match=r"0\.\.19") as beyond:
        play(v2, 1, lambda: 20)
    assert 'action_set="full"' in (beyond.value.help or "")
    check_env(setpiece.make(THREE, action_set="v2", bot_action=True))


def test_the_bots_action_clears_what_is_held() -> None:
    env = setpiece.make("academy_empty_goal", action_set="v2", observation="raw")
    env.reset(seed=1)
    for action in (Action.RIGHT, Action.SPRINT):
        held = env.step(action)[0]["sticky_actions"]
    assert list(np.flatnonzero(held)) == [4, 8]
    assert not env.step(Action.BUILTIN_AI)[0]["sticky_actions"].any()


def test_who_follows_the_bots_choice_scores() -> None:
    env = setpiece.make("academy_empty_goal", bot_action=True)
    goals = 0
    for seed in range(10):
        _, info = env.reset(seed=seed)
        over = False
        while not over:
            assert isinstance(info["bot_action"], int)
            assert info["bot_action"] in env.action_space
            _, _, terminated, truncated, info = env.step(info["bot_action"])
            over = terminated or truncated
        goals += info["score"][0]
    assert goals >= 8


def test_asking_the_bot_changes_nothing() -> None:
    def digest(**options: Any) -> str:
        return play(setpiece.make("11_vs_11_stochastic", **options), 3, steps=4000)[-1][4][
            "setpiece"
        ]["digest"]

    assert digest() == digest(bot_action=True)


def test_the_bots_choice_of_several_agents() -> None:
    env = setpiece.make(setpiece.compile(SEVERAL), bot_action=True)
    for *_, info in play(env, 1, lambda: [5, 0, 5, 5], steps=20):
        assert info["bot_action"].dtype == np.int64
        assert info["bot_action"].shape == (4,)
        assert info["bot_action"] in env.action_space


def test_what_everyone_pressed() -> None:
    env = setpiece.make(THREE)
    env.reset(seed=1)
    assert env.played() == {}
    env.step(Action.SPRINT)
    played = env.played()
    assert len(played) == 6
    assert all(Action(action) != Action.BUILTIN_AI for action in played.values())
    assert Action.SPRINT in played.values()


NOBODY = """import "std/academy/academy_3_vs_1_with_keeper.pitch"

scenario nobody extends academy_3_vs_1_with_keeper {
    agents { left: 0 }
}
"""


@pytest.mark.parametrize("observation", ["simple115v2", "smm", "raw"])
def test_bots_among_themselves(observation: str) -> None:
    env = setpiece.make(
        setpiece.compile(NOBODY), observation=observation, events=True, bot_action=True
    )
    assert env.agents == ()
    trajectory = play(env, 1, lambda: [])
    for observed, reward, _, _, info in trajectory[1:]:
        assert env.observation_space.contains(observed)
        assert reward.shape == info["bot_action"].shape == (0,)
        assert info["action_mask"].shape == (0, 19)
    assert trajectory[-1][4]["outcome"]
    assert len(env.played()) == 6
    assert same(trajectory, play(env, 1, env.action_space.sample))
    env.reset(seed=1)
    with pytest.raises(setpiece.ActionError, match="nobody acts"):
        env.step(5)
    assert pickle.loads(pickle.dumps(env)).step([])[4]["score"] == [0, 0]
