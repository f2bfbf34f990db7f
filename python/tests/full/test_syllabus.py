"""Curricula of Syllabus choose the levels of a vector."""

from typing import Any

import numpy as np
import pytest

import setpiece

pytest.importorskip("syllabus")

pytestmark = pytest.mark.filterwarnings("default")

from syllabus.core import Curriculum
from syllabus.curricula import DomainRandomization, SimulatedAnnealing

import setpiece.syllabus

CORNER = "academy_corner"
GOAL = "academy_empty_goal_close"


class Noted(DomainRandomization):
    """Keeps what it is informed of."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.noted: list[Any] = []

    def update_on_episode(self, *args: Any, **kwargs: Any) -> None:
        super().update_on_episode(*args, **kwargs)
        self.noted.append(args)


def test_a_curriculum_of_syllabus_chooses_tasks_and_learns_results() -> None:
    np.random.seed(1)  # noqa: NPY002  # Syllabus draws from it.
    tasks = setpiece.syllabus.task_space(GOAL, {"difficulty": [0.1, 0.9]})
    assert tasks.tasks == [(("difficulty", 0.1),), (("difficulty", 0.9),)]
    curriculum = Noted(tasks)
    envs = setpiece.make_vec(GOAL, 4, levels=setpiece.syllabus.Levels(curriculum, GOAL, seed=7))
    envs.reset()
    assert [level.split("#")[1] for level in envs.levels] == ["7", "7:1", "7:2", "7:3"]
    played: dict[str, int] = {}
    for _ in range(150):
        for level in envs.levels:
            played[level.split("#")[1]] = 0 if "difficulty=0.1" in level else 1
        envs.step(np.full(4, setpiece.Action.RIGHT))
    assert set(played.values()) == {0, 1}
    # Environments end in their order, and each level has been reported with its task.
    assert len(curriculum.noted) == len(played) - 4
    assert sum(task for _, _, task, _ in curriculum.noted) == sum(
        task
        for key, task in played.items()
        if key not in {one.split("#")[1] for one in envs.levels}
    )
    assert all((paid, progress) == (1.0, 1.0) for paid, _, _, progress in curriculum.noted)
    assert all(length > 5 for _, length, _, _ in curriculum.noted)


def test_a_task_may_be_a_vector_of_the_parameter_space() -> None:
    tasks = setpiece.syllabus.task_space(CORNER)
    size = len(setpiece.load(CORNER).parameter_space.spaces)
    curriculum = SimulatedAnnealing(
        tasks, start_values=[0.25] * size, end_values=[1.0] * size, total_steps=10
    )
    envs = setpiece.make_vec(CORNER, 2, levels=setpiece.syllabus.Levels(curriculum, CORNER))
    envs.reset()
    assert envs.levels[0] == f"{CORNER}{{difficulty=0.25,left_difficulty=0.25}}#0"


def test_what_does_not_fit_is_refused() -> None:
    class EveryStep(DomainRandomization):
        requires_step_updates = True

    tasks = setpiece.syllabus.task_space(CORNER, {"difficulty": [0.1]})
    assert issubclass(EveryStep, Curriculum)
    with pytest.raises(setpiece.UnavailableError, match="`EveryStep` wants to see every step"):
        setpiece.syllabus.Levels(EveryStep(tasks), CORNER)
    with pytest.raises(setpiece.ParameterError, match="a curriculum of Syllabus"):
        setpiece.syllabus.Levels("learn_3_vs_1", CORNER)
    for values in (
        {"difficult": [1]},
        {"difficulty": [2.0]},
        {"difficulty": 1},
        {},
        {"difficulty": []},
    ):
        with pytest.raises(setpiece.ParameterError):
            setpiece.syllabus.task_space(CORNER, values)  # type: ignore[arg-type]
