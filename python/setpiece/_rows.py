"""Splits observations and infos of many agents into those of some of them, or of one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Picker:
    """Takes from a value of n agents the part of one (a number) or of several (a list).

    A value of several agents has a leading axis (arrays) or a part for each (tuples, lists). A
    value of one has neither, and the part of one has neither.
    """

    n_agents: int
    who: int | list[int]

    def __call__(self, value: Any) -> Any:
        """Returns the part of the picked agents."""
        if isinstance(self.who, int):
            return value if self.n_agents == 1 else _plain(value[self.who])
        rows = _listed(value) if self.n_agents == 1 else value
        if isinstance(rows, np.ndarray):
            return rows[self.who]
        return type(rows)(rows[at] for at in self.who)


def pick_info(info: dict[str, Any], pick: Picker, n_agents: int, n_actions: int) -> dict[str, Any]:
    """Returns the info of the picked agents; masks are those of the first `n_actions` actions."""
    picked = dict(info)
    if "reward_terms" in info:
        picked["reward_terms"] = {name: pick(paid) for name, paid in info["reward_terms"].items()}
    if "action_mask" in info:
        picked["action_mask"] = pick(info["action_mask"])[..., :n_actions]
    if "bot_action" in info:
        picked["bot_action"] = pick(info["bot_action"])
    if "setpiece" in info:
        returns = {name: pick(paid) for name, paid in info["setpiece"]["return"].items()}
        picked["setpiece"] = {**info["setpiece"], "return": returns}
    if "records" in info and n_agents != 1:
        # Only what depends on the agent is a list.
        picked["records"] = {
            k: pick(v) if isinstance(v, list) else v for k, v in info["records"].items()
        }
    return picked


def split_info(info: dict[str, Any], n_agents: int) -> list[dict[str, Any]]:
    """Returns for each agent the info that it would get alone."""
    if n_agents == 1:
        return [info]
    paid = _split_terms(info["reward_terms"], n_agents)
    infos = [
        {**info, "reward_terms": paid[at], "action_mask": info["action_mask"][at]}
        for at in range(n_agents)
    ]
    if "bot_action" in info:
        for one, action in zip(infos, info["bot_action"].tolist(), strict=True):
            one["bot_action"] = action
    if "setpiece" in info:
        returns = _split_terms(info["setpiece"]["return"], n_agents)
        for at, one in enumerate(infos):
            one["setpiece"] = {**info["setpiece"], "return": returns[at]}
            one["records"] = {
                k: v[at] if isinstance(v, list) else v for k, v in info["records"].items()
            }
    return infos


def _split_terms(terms: dict[str, Any], n_agents: int) -> list[dict[str, float]]:
    columns = [values.tolist() for values in terms.values()]
    return [
        dict(zip(terms, [column[at] for column in columns], strict=True)) for at in range(n_agents)
    ]


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


def _listed(value: Any) -> Any:
    """The value of one agent, as that of a list of one."""
    return (value,) if isinstance(value, dict) else np.asarray(value)[None]
