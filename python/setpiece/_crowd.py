"""Opponents in many matches at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece._actions import array_of, integers
from setpiece._errors import ActionError
from setpiece._opponents import Look, Table, ask
from setpiece._vocabulary import Action


class Crowd:
    """The agents of a vector of matches: the caller's, and those of opponents.

    An opponent is asked once for all matches: it sees a row for each of its agents, match by match.
    """

    def __init__(self, table: Table, num_envs: int) -> None:
        self._table, self._num_envs = table, num_envs

    def actions(
        self,
        given: Any,
        observations: NDArray[Any],
        look: Callable[[str, bool], list[Any]],
        masks: NDArray[np.int8],
        steps: Sequence[int],
    ) -> NDArray[np.int64]:
        """Returns everyone's actions, int64 `(num_envs, agents)`: the caller's and the opponents'.

        `observations` and `masks` have a row for every match and agent; `look` observes each match
        in another kind of observation; `steps` are those that each episode has played. Raises `ActionError`
        for the caller's actions, `OpponentError` if an opponent fails.
        """
        table = self._table
        actions = np.full((self._num_envs, table.n_agents), int(Action.BUILTIN_AI), np.int64)
        actions[:, table.mine] = self._read(given)
        looks: dict[Look | None, Any] = {None: observations}
        for seat in table.seats:
            kind = seat.look
            if kind is not None and kind not in looks:
                seen = look(*kind)
                # The only agent of a match has no axis of its own.
                looks[kind] = seen if table.n_agents > 1 else [_alone(one) for one in seen]
            played = [step for step in steps for _ in seat.at]
            shown = _rows(masks, seat.at) if seat.masked else None
            acts = ask(seat, _rows(looks[kind], seat.at), played, shown)
            actions[:, seat.at] = np.reshape(acts, (self._num_envs, len(seat.at)))
        return actions

    def _read(self, given: Any) -> NDArray[np.int64]:
        mine, n_actions = len(self._table.mine), self._table.n_actions
        shape = (self._num_envs,) if mine == 1 else (self._num_envs, mine)
        array = array_of(given)
        # Accepts any shape with the right number of values, as a vector without opponents does.
        actions = (
            None if array is None else integers(array.ravel(), (self._num_envs * mine,), n_actions)
        )
        if actions is None:
            raise ActionError(
                f"expected integers in 0..{n_actions - 1} of shape {shape}, found `{given!r}`"
            )
        return actions.reshape(self._num_envs, mine)


def _alone(seen: Any) -> Any:
    return seen[None] if isinstance(seen, np.ndarray) else (seen,)


def _rows(seen: Any, at: list[int]) -> Any:
    """The rows of some agents of every match: an array, or a tuple of dicts."""
    if isinstance(seen, list) and isinstance(seen[0], tuple):
        return tuple(views[one] for views in seen for one in at)
    picked = np.asarray(seen)[:, at]
    return picked.reshape(-1, *picked.shape[2:])
