"""The scenarios of GRF that the library has: their names, and how they start."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import same
from gfootball_scripts import ONE_TEAM, script_file, starts_as

import setpiece
from setpiece.gfootball.env import create_environment
from setpiece.gfootball.env.scenario_builder import all_scenarios
from setpiece.gfootball.env.scenario_config import FormationEntry, ScenarioConfig
from setpiece.gfootball.scenarios import PlayerRole


def test_all_scenarios() -> None:
    assert "academy_corner" in all_scenarios()


def test_the_level_of_the_example_of_many_agents() -> None:
    env = create_environment("test_example_multiagent", number_of_left_players_agent_controls=3)
    assert env.reset().shape == (3, 72, 96, 4)
    assert env.step([0, 0, 0])[1].shape == (3,)


def test_a_state_of_an_episode_with_other_players_to_control(tmp_path: Path) -> None:
    text = (
        ONE_TEAM
        + "    builder.AddPlayer(0, 0, e_PlayerRole_CM, controllable=builder.EpisodeNumber() % 2 == 0)\n"
    )
    env = create_environment(
        script_file(tmp_path, text), number_of_left_players_agent_controls=2, representation="raw"
    )
    assert [seen["active"] for seen in env.reset()] == [0, 1]
    state = env.get_state()
    later = env.step([5, 5])
    assert [seen["active"] for seen in env.reset()] == [0, -1]
    env.set_state(state)
    assert same(later, env.step([5, 5]))


NAMES = {
    "": (
        *(
            "11_vs_11_competition",
            "11_vs_11_easy_stochastic",
            "11_vs_11_hard_stochastic",
            "11_vs_11_kaggle",
        ),
        *(
            "11_vs_11_stochastic",
            "1_vs_1_easy",
            "5_vs_5",
            "academy_3_vs_1_with_keeper",
            "academy_corner",
        ),
        *("academy_counterattack_easy", "academy_counterattack_hard", "academy_empty_goal"),
        *(
            "academy_empty_goal_close",
            "academy_pass_and_shoot_with_keeper",
            "academy_run_pass_and_shoot_with_keeper",
        ),
        *(
            "academy_run_to_score",
            "academy_run_to_score_with_keeper",
            "academy_single_goal_versus_lazy",
        ),
        "test_example_multiagent",
    ),
    "tests.": (
        *("11_vs_11_deterministic", "11_vs_11_easy_deterministic", "11_vs_11_hard_deterministic"),
        *(
            "11_vs_11_single_goal_deterministic",
            "11_vs_11_single_goal_stochastic",
            "11_vs_4_offence_deterministic",
        ),
        *("11_vs_4_offence_stochastic", "corner_test", "goal_test", "keeper_test"),
        *(
            "kickoff_for_goal_loosing_team_test",
            "multiagent_wrapper",
            "offside_test",
            "penalty",
            "second_half",
        ),
        "symmetric",
    ),
}
"""Every scenario of GRF, by the folder's part of its name."""


def test_the_library_has_every_scenario_of_grf_and_those_of_its_suite_for_many_agents() -> None:
    of_grf = [name for names in NAMES.values() for name in names]
    of_suite = [entry.entry for entry in setpiece.suite("academy_multi").entries]
    assert sorted(of_grf + of_suite) == all_scenarios()


@pytest.mark.parametrize(
    "level", [folder + name for folder, names in NAMES.items() for name in names]
)
def test_every_scenario_of_grf_plays(level: str) -> None:
    env = create_environment(
        level, representation="simple115v2", number_of_right_players_agent_controls=1
    )
    again = create_environment(
        level.removeprefix("tests."), number_of_right_players_agent_controls=1
    )
    for _ in range(2):
        assert env.reset().shape == (2, 115)
        again.reset()
        assert np.allclose(env.unwrapped._core.whole["ball"], again.unwrapped._core.whole["ball"])
        for _ in range(10):
            if env.step([0, 0])[2]:
                break


GK, CB, CM, RM = (getattr(PlayerRole, f"e_PlayerRole_{role}") for role in ("GK", "CB", "CM", "RM"))

KEEPER = (-1.0, 0.0, GK)

STARTS: dict[str, tuple[int, tuple[Any, ...], tuple[Any, ...]]] = {
    # Steps, then ball, left and right team in even and in odd episodes; each team in its own frame.
    "test_example_multiagent": (
        100,
        *(
            (
                (0.62, 0),
                [KEEPER, (0.6, 0, CM), (0.7, 0.2, CM), (0.7, -0.2, CM)],
                [(1, 0, GK), (-0.75, 0, CB)],
            ),
        )
        * 2,
    ),
    "tests.corner_test": (
        30,
        ((-0.9, 0.3), [KEEPER, (-0.85, 0.3, RM), (0, 0, RM)], [KEEPER, (-0.85, 0.3, RM)]),
        ((0.9, -0.3), [KEEPER, (-0.85, 0.3, RM), (0, 0, RM)], [KEEPER, (-0.85, 0.3, RM)]),
    ),
    "tests.goal_test": (
        65,
        ((0.5, 0), [(0.5, 0, GK)], [(0.5, 0, GK)]),
        ((-0.5, 0), [(0.5, 0, GK)], [(0.5, 0, GK)]),
    ),
    "tests.keeper_test": (
        30,
        ((0.9, 0.3), [KEEPER, (0.85, 0.3, RM), (0, 0, RM)], [KEEPER, (0.85, 0.3, RM)]),
        ((-0.9, -0.3), [KEEPER, (0.85, 0.3, RM), (0, 0, RM)], [KEEPER, (0.85, 0.3, RM)]),
    ),
    "tests.kickoff_for_goal_loosing_team_test": (
        400,
        *(((0, 0), [(1, 0, GK), (0.8, 0, RM)], [KEEPER, (0, 0.02, RM)]),) * 2,
    ),
    "tests.offside_test": (
        50,
        ((0, 0), [(0, 0.4, GK), (0, -0.4, RM)], [(-0.05, 0, GK), (0.8, 0, RM)]),
        ((0, 0), [(-0.05, 0, GK), (0.8, 0, RM)], [(0, 0.4, GK), (0, -0.4, RM)]),
    ),
    "tests.penalty": (30, *(((-0.72, 0), [KEEPER, (-0.69, 0, RM)], [KEEPER, (0.7, 0, RM)]),) * 2),
    "tests.second_half": (10, *(((0, 0), [KEEPER, (0, 0.02, RM)], [KEEPER, (-0.5, 0, RM)]),) * 2),
}


@pytest.mark.parametrize("level", STARTS)
def test_a_scenario_of_grfs_tests_starts_as_there(level: str) -> None:
    steps, *episodes = STARTS[level]
    env = create_environment(level, representation="raw")
    for ball, left, right in episodes:
        env.reset()
        teams = [[FormationEntry((x, y), role) for x, y, role in team] for team in (left, right)]
        starts_as(env.unwrapped._core.whole, ScenarioConfig([*ball, 0.0], *teams))
        assert env.unwrapped._core.whole["steps_left"] == steps + 1


def test_the_level_of_a_whole_team_shows_one_player() -> None:
    env = create_environment("tests.multiagent_wrapper", representation="raw")
    (seen,) = env.reset()
    assert seen["active"] == seen["designated"]
    assert env.unwrapped._config.number_of_left_players() == 11
