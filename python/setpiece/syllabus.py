"""The seam to Syllabus: its curricula choose the levels of a vector.

```python
import setpiece.syllabus
from syllabus.curricula import DomainRandomization

tasks = setpiece.syllabus.task_space("academy_corner", {"difficulty": [0.0, 0.3, 0.6, 0.9]})
levels = setpiece.syllabus.Levels(DomainRandomization(tasks), "academy_corner", seed=1)
envs = setpiece.make_vec("academy_corner", 64, levels=levels)
```

Syllabus (Sullivan et al., `pip install 'setpiece[syllabus]'`) has curricula over tasks. A task is the
parameters of a level; the seed and the index are the level's own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np

from setpiece._errors import ParameterError, UnavailableError
from setpiece._level import read_level
from setpiece._levels import LevelResult
from setpiece._optional import need
from setpiece._options import ParamValue, check_number
from setpiece._source import Source, load

__all__ = ["Levels", "task_space"]


def task_space(scenario: Source, values: Mapping[str, Sequence[ParamValue]] | None = None) -> Any:
    """Returns the tasks of a scenario as a `TaskSpace` of Syllabus.

    - `values`: the values of parameters; a task is one value of each. It is a tuple of pairs of
      name and value, in a `DiscreteTaskSpace`. Without them a task is a vector of
      `scenario.parameter_space`, in a `BoxTaskSpace`.

    Raises `ParameterError` for a parameter or value that the scenario doesn't allow,
    `MissingPackageError` without Syllabus.
    """
    tasks = need("syllabus.task_space", "syllabus", "`setpiece.syllabus`")
    loaded = load(scenario)
    if values is None:
        from gymnasium.spaces import Box

        size = len(loaded.parameter_space.spaces)
        if size == 0:
            raise ParameterError(f"`{loaded.name}` has no parameter with a range", name="scenario")
        return tasks.BoxTaskSpace(Box(0.0, 1.0, (size,), np.float64))
    if not isinstance(values, Mapping) or not values:
        raise ParameterError(
            f"expected lists of values by parameter, found `{values!r}`", name="values"
        )
    for name, listed in values.items():
        if isinstance(listed, str) or not isinstance(listed, Sequence) or not listed:
            raise ParameterError(
                f"expected a list of values of `{name}`, found `{listed!r}`", name=str(name)
            )
        for value in listed:
            loaded.with_params(**{name: value})
    pairs = [[(name, value) for value in listed] for name, listed in values.items()]
    listed_tasks = [*product(*pairs)]
    return tasks.DiscreteTaskSpace(len(listed_tasks), listed_tasks)


class Levels:
    """Levels that a curriculum of Syllabus chooses: `levels` of `setpiece.make_vec`.

    The curriculum learns of every episode its return (the mean of the agents), its length in steps
    and its progress: 1 for success, else 0.
    """

    def __init__(self, curriculum: Any, scenario: Source, *, seed: int = 0) -> None:
        """Prepares levels; level n has the seed and the index n.

        - `curriculum`: one whose tasks are those of `task_space` for this scenario.
        - `scenario`: as in `setpiece.load`, the scenario of the vector.

        Raises `UnavailableError` for a curriculum that wants to see every step,
        `MissingPackageError` without Syllabus.
        """
        core = need("syllabus.core", "syllabus", "`setpiece.syllabus`")
        if not isinstance(curriculum, core.Curriculum):
            raise ParameterError(
                f"expected a curriculum of Syllabus, found `{curriculum!r}`", name="curriculum"
            )
        if curriculum.requires_step_updates:
            raise UnavailableError(
                f"`{type(curriculum).__name__}` wants to see every step, and levels have results",
                name="curriculum",
                help="`setpiece.samplers.Prioritized` is prioritized level replay",
            )
        self.curriculum = curriculum
        self._scenario = load(scenario)
        self._seed = check_number("seed", seed)
        self._next = 0
        self._tasks: dict[int, Any] = {}

    def __call__(self, result: LevelResult | None) -> dict[str, Any]:
        """Reports to the curriculum how a level has ended, and returns the next one.

        A level that came from elsewhere, such as the one of a `reset`, is not reported.
        """
        task = None if result is None else self._task_of(result)
        if result is not None and task is not None:
            self.curriculum.update_on_episode(
                float(np.mean(result.returns)) if result.returns else 0.0,
                result.length,
                task,
                float(result.success),
            )
        task = self.curriculum.sample()[0]
        number, self._next = self._next, self._next + 1
        self._tasks[number] = task
        decoded = self.curriculum.task_space.decode(task)
        return {
            "scenario": self._scenario.name,
            "params": self._params(decoded),
            "seed": self._seed,
            "episode": number,
        }

    def _task_of(self, result: LevelResult) -> Any:
        level = read_level(result.level)
        is_own = (level.scenario, level.seed) == (self._scenario.name, self._seed)
        return self._tasks.pop(level.episode, None) if is_own else None

    def _params(self, task: Any) -> dict[str, ParamValue]:
        if isinstance(task, np.ndarray):
            return self._scenario.parameter_space.from_vector(task)
        return dict(task)
