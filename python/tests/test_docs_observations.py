"""The tables of docs/observations.md match the layouts, and its examples run."""

from itertools import groupby
from typing import Any

import numpy as np
import pytest
from gymnasium import spaces
from pages import examples, hold_tables, table

import setpiece
from setpiece._spaces import OBSERVATIONS, Block, Key

PAGE = "observations.md"
NAME = "academy_3_vs_1_with_keeper"
BLOCKS = ("numbers", "meaning", "unit", "range")


def played_examples() -> dict[str, Any]:
    """Runs the examples, one after the other, and returns their names."""
    names: dict[str, Any] = {}
    for block in examples(PAGE):
        exec(compile(block, PAGE, "exec"), names)
    return names


def ranges(low: Any, high: Any, digits: int = 10) -> str:
    """Returns the ranges of numbers, one round of them if they repeat."""
    each = [
        f"{least:.{digits}g}..{most:.{digits}g}"
        for least, most in zip(np.ravel(low), np.ravel(high), strict=True)
    ]
    round_ = next(n for n in range(1, len(each) + 1) if each == each[:n] * (len(each) // n))
    runs = [(len(list(run)), one) for one, run in groupby(each[:round_])]
    return ", ".join(f"{n} times {one}" if n > 1 else one for n, one in runs)


def blocks(env: setpiece.FootballEnv) -> str:
    space = env.observation_space
    rows = []
    for block in env.observation_layout:
        assert isinstance(block, Block)
        where = slice(block.start, block.start + block.length)
        numbers = str(block.start) if block.length == 1 else f"{block.start}..{where.stop - 1}"
        bounds = ranges(space.low[..., where], space.high[..., where])
        rows.append((numbers, block.meaning, block.unit, bounds))
    return table(BLOCKS, rows)


def changed(kind: str) -> str:
    """Returns the blocks that `scale` changes; those of teammates and opponents once."""
    plain, scaled = (
        setpiece.make(NAME, observation=kind),
        setpiece.make(NAME, observation=kind, scale=True),
    )
    rows, seen = [], set()
    for before, after in zip(plain.observation_layout, scaled.observation_layout, strict=True):
        assert isinstance(before, Block)
        assert isinstance(after, Block)
        what = before.meaning.split(":")[-1]
        if before.unit == after.unit or what in seen:
            continue
        seen.add(what)
        where = slice(before.start, before.start + before.length)
        high = plain.observation_space.high[where], scaled.observation_space.high[where]
        each = [f"{factor:.6g}" for factor in high[1].astype(float) / high[0]]
        round_ = next(n for n in range(1, len(each) + 1) if each == each[:n] * (len(each) // n))
        numbers = str(before.start) if before.length == 1 else f"{before.start}..{where.stop - 1}"
        bounds = ranges(
            scaled.observation_space.low[where], scaled.observation_space.high[where], digits=5
        )
        rows.append(
            (numbers, before.meaning, before.unit, after.unit, ", ".join(each[:round_]), bounds)
        )
    return table(
        ("numbers", "meaning", "unit", "with `scale`", "multiplied by", "range with `scale`"), rows
    )


def keys(env: setpiece.FootballEnv) -> str:
    rows = []
    for key in env.observation_layout:
        assert isinstance(key, Key)
        shape = list(key.shape)
        for side, letter, players in zip(
            ("left_team", "right_team"), "mn", env._native.players, strict=True
        ):
            if key.name.startswith(side):
                assert shape[0] == players
                shape[0] = letter
        written = f"({', '.join(map(str, shape))}{',' if len(shape) == 1 else ''})"
        space = env.observation_space[key.name]
        if isinstance(space, spaces.Discrete):
            bounds = f"{space.start}..{space.start + space.n - 1}"
        else:
            bounds = ranges(space.low.astype(float), space.high.astype(float))
        rows.append(
            (
                f"`{key.name}`",
                key.dtype,
                f"`{written}`" if key.dtype != "int" else "",
                key.meaning,
                bounds,
            )
        )
    return table(("key", "dtype", "shape", "meaning", "range"), rows)


def kinds(vector: setpiece.FootballEnv) -> str:
    rows = []
    for kind in OBSERVATIONS:
        env = vector if kind == "vector" else setpiece.make(NAME, observation=kind)
        space = env.observation_space
        if kind == "raw":
            rows.append((f"`{kind}`", "a dict", "", ""))
            continue
        stacked = setpiece.make(env.scenario, observation=kind, stack=4).observation_space
        rows.append((f"`{kind}`", space.dtype, f"`{space.shape}`", f"`{stacked.shape}`"))
    return table(("observation", "dtype", "shape", "with `stack=4`"), rows)


def numbers() -> str:
    modes = {int(mode): mode.name for mode in setpiece.GameMode}
    return table(
        ("number", "`GameMode`", "`Role`"),
        ((int(role), modes.get(int(role), ""), role.name) for role in setpiece.Role),
    )


def test_the_tables_are_the_layouts() -> None:
    vector = played_examples()["env"]
    assert vector.observation == "vector"
    tables = {
        "kinds": kinds(vector),
        "numbers": numbers(),
        "raw": keys(setpiece.make(NAME, observation="raw")),
    }
    for kind in ("simple115v2", "simple115v2+sticky", "simple115", "smm", "pixels", "egocentric"):
        tables[kind.removeprefix("simple115v2+")] = blocks(setpiece.make(NAME, observation=kind))
    tables["vector"] = blocks(vector)
    for kind in ("simple115v2", "egocentric"):
        tables[f"scaled_{kind}"] = changed(kind)
    tables["stacked"] = blocks(setpiece.make(NAME, observation="smm", stack=2))
    hold_tables(PAGE, tables)


@pytest.mark.parametrize("name", ["academy_empty_goal", NAME, "5_vs_5", "11_vs_11_stochastic"])
def test_the_length_of_egocentric_is_as_documented(name: str) -> None:
    env = setpiece.make(name, observation="egocentric")
    assert env.observation_space.shape == (46 + 7 * (2 * max(env._native.players) - 1),)


@pytest.mark.parametrize("kind", ["simple115v2", "raw"])
def test_lengths_are_in_the_documented_units(kind: str) -> None:
    text = "scenario unit extends academy { ball at (54.4m, 0m) team left { GK at (-27.2m, 20.9m) } team right { } }"
    observation, _ = setpiece.make(setpiece.compile(text), observation=kind).reset(seed=0)
    own = observation["left_team"][0] if kind == "raw" else observation[:2]
    assert own == pytest.approx([-0.5, 0.25], abs=1e-5)
