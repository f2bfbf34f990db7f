"""Decisions that last several steps."""

from __future__ import annotations

from collections.abc import Callable, Sequence


class Held:
    """The actions of a policy's agents, which are kept until the agents decide again.

    An agent decides when its episode begins and then after every `repeat` steps.
    """

    def __init__(self, repeat: int) -> None:
        self.repeat = repeat
        self.actions: list[int] = []

    def after(
        self, steps: Sequence[int], decide: Callable[[Sequence[int]], list[int]]
    ) -> list[int]:
        """Returns an action for each agent, whose episodes have played so many `steps`.

        `decide` returns the new actions of some agents, by their places.
        """
        due: Sequence[int] = range(len(steps))
        if self.repeat > 1 and len(self.actions) == len(steps):
            due = [at for at in due if steps[at] % self.repeat == 0]
        if len(due) == len(steps):
            self.actions = decide(due)
        elif due:
            for at, action in zip(due, decide(due), strict=True):
                self.actions[at] = action
        return [*self.actions]
