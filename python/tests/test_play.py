from typing import Any

import numpy as np
import pytest

import setpiece
from setpiece import Action, Policy

DUEL = "1_vs_1_easy"


def runner(observation: Any) -> list[int]:
    return [Action.RIGHT] * observation.controlled_players


def striker(observation: Any) -> list[int]:
    """Runs at goal and shoots when near."""
    raw = observation["players_raw"][0]
    x = raw["left_team"][raw["active"]][0]
    if raw["ball_owned_team"] == 0 and x > 0.6:
        return [Action.SHOT]
    return [Action.SPRINT if x < -0.9 else Action.RIGHT]


def loser(_observation: Any) -> int:
    """Takes the ball to their own goal."""
    return Action.LEFT


def test_both_sides_are_shown_what_kaggle_shows() -> None:
    seen: dict[str, list[Any]] = {"left": [], "right": []}

    def agent(side: str) -> Any:
        def act(observation: Any) -> list[int]:
            seen[side].append(observation)
            return [0]

        return act

    played = setpiece.play(DUEL, agent("left"), agent("right"), seed=1)
    assert len(seen["left"]) == len(seen["right"]) == played.length
    left, right = seen["left"][0], seen["right"][0]
    assert set(left) == {"players_raw", "controlled_players", "step"}
    assert left.controlled_players == 1
    assert [one.step for one in seen["right"]] == list(range(played.length))
    mine, theirs = left["players_raw"][0], right["players_raw"][0]
    assert isinstance(mine["left_team"], list)
    assert isinstance(mine["steps_left"], int)
    np.testing.assert_allclose(mine["left_team"], -np.array(theirs["right_team"]))
    assert mine["ball"][0] == pytest.approx(-theirs["ball"][0])
    raw = setpiece.make(DUEL, observation="raw")
    assert set(mine) == set(raw.reset(seed=1)[0])


def test_a_match_can_be_played_again_from_its_seed_and_from_its_actions() -> None:
    played = setpiece.play(DUEL, striker, "bot", seed=4)
    again = setpiece.play(DUEL, striker, "bot", seed=4)
    assert played.digest == again.digest
    np.testing.assert_array_equal(played.actions, again.actions)
    assert setpiece.play(DUEL, striker, "bot", seed=5).digest != played.digest
    env = setpiece.make(DUEL, left=1, right=1, action_set="v2")
    env.reset(seed=4)
    for actions in played.actions:
        *_, info = env.step(actions)
    assert info["setpiece"]["digest"] == played.digest
    assert info["score"] == list(played.score)


def test_who_wins() -> None:
    matches = [setpiece.play(DUEL, striker, loser, seed=seed) for seed in range(3)]
    mirrored = [setpiece.play(DUEL, loser, striker, seed=seed) for seed in range(3)]
    assert "left" in [match.winner for match in matches]
    assert "right" in [match.winner for match in mirrored]
    for match in [*matches, *mirrored]:
        left, right = match.score
        assert match.winner == ("left" if left > right else "right" if right > left else None)
        assert match.rewards == (left - right, right - left)
        assert match.outcome is not None
        assert match.length == len(match.actions)
        assert match.errors == {}


def test_several_players_on_a_side() -> None:
    counted = []

    def team(observation: Any) -> list[int]:
        counted.append((observation["controlled_players"], len(observation["players_raw"])))
        return [Action.RIGHT, Action.IDLE, Action.IDLE]

    played = setpiece.play("academy_3_vs_1_with_keeper", team, "bot", left=3, right=1)
    assert set(counted) == {(3, 3)}
    assert played.slots == ("left_0", "left_1", "left_2", "right_0")
    assert set(played.actions[:, 0]) == {Action.RIGHT}


def test_kaggles_match_has_one_player_on_each_side_who_changes() -> None:
    played = setpiece.play("11_vs_11_kaggle", runner, runner, seed=1)
    assert played.slots == ("left_0", "right_0")
    assert played.length == 3000


def test_other_agents() -> None:
    bots = setpiece.play(DUEL, "bot", "lazy", seed=1)
    assert bots.length > 0
    shapes = set()

    def policy(observation: Any) -> Any:
        shapes.add(observation.shape)
        return np.full(len(observation), Action.RIGHT)

    setpiece.play(DUEL, Policy(policy), Policy(policy, observation="smm"), seed=1)
    assert shapes == {(1, 115), (1, 72, 96, 4)}


def broken(observation: Any) -> list[int]:
    return [0] if observation.step < 7 else observation.nothing


@pytest.mark.parametrize("bad", [broken, lambda _: [0, 0], lambda _: "right", lambda _: [25]])
def test_an_agent_that_fails_loses_or_raises(bad: Any) -> None:
    with pytest.raises(setpiece.OpponentError, match="of `right_GK_1`"):
        setpiece.play(DUEL, runner, bad)
    for agents, loser, winner in (
        ((runner, bad), "right", "left"),
        ((bad, runner), "left", "right"),
    ):
        played = setpiece.play(DUEL, *agents, on_error="lose")
        assert played.winner == winner
        assert list(played.errors) == [loser]
        assert played.errors[loser].side == loser
        assert (played.outcome, played.digest) == (None, None)
        assert played.length == len(played.actions) == (7 if bad is broken else 0)


def test_options_that_are_not_there() -> None:
    with pytest.raises(setpiece.ParameterError, match="`on_error` is 'win'"):
        setpiece.play(DUEL, runner, runner, on_error="win")  # type: ignore[arg-type]
    with pytest.raises(setpiece.ParameterError, match="opponents"):
        setpiece.play(DUEL, runner, 7)
    assert setpiece.play(setpiece.load(DUEL), runner, runner).length > 0
    with pytest.raises(setpiece.UnknownScenarioError):
        setpiece.play("1_vs_1_eazy", runner, runner)


def test_who_tells_one_side_alone_meets_one_of_the_other() -> None:
    def still(observation: dict[str, Any]) -> list[int]:
        return [0] * observation["controlled_players"]

    played = setpiece.play("academy_corner", still, still, left="all")
    assert [slot.split("_")[0] for slot in played.slots].count("right") == 1
    nobody = setpiece.play("academy_empty_goal_close", "bot", "bot", left=1, right=0)
    assert nobody.rewards[1] == 0.0
