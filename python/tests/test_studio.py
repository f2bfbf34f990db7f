"""`setpiece.studio`: the page beside a running program."""

from __future__ import annotations

import base64
import json
import os
import socket
import struct
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import gymnasium
import numpy as np
import pytest
from pages import examples

import setpiece

PATIENCE_S = 20
TEXT = """
scenario two {
    param gap: length = 8m in 3m..15m
    ball at (10m, 0m)
    team left { CF at (9m, 0m) }
    team right { CB at (10m + gap, 0m) }
    end limit 12 steps
}
"""


class Tab:
    """A page's socket, as a browser opens it."""

    def __init__(self, page: setpiece.Studio) -> None:
        """Connects."""
        place = urlsplit(page.address)
        self._socket = socket.create_connection(("127.0.0.1", page.port), PATIENCE_S)
        key = base64.b64encode(os.urandom(16)).decode()
        self._socket.sendall(
            f"GET /socket?{place.query} HTTP/1.1\r\nHost: {place.netloc}\r\nUpgrade: websocket\r\n"
            f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
        )
        head = b""
        while not head.endswith(b"\r\n\r\n"):
            head += self._exactly(1)
        assert b" 101 " in head, head

    def __enter__(self) -> Tab:
        """Returns itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Disconnects."""
        self._socket.close()

    def ask(self, **request: Any) -> None:
        """Sends a request; what a page sends is masked."""
        body = json.dumps(request).encode()
        length = struct.pack(">BBH", 0x81, 0x80 | 126, len(body))
        self._socket.sendall(length + b"\0\0\0\0" + body)

    def hear(self, kind: str, wanted: Callable[[Any], bool] = lambda _: True) -> Any:
        """Returns the next message of a kind that is as wanted."""
        while True:
            _, size = self._exactly(2)
            if size == 126:
                (size,) = struct.unpack(">H", self._exactly(2))
            elif size == 127:
                (size,) = struct.unpack(">Q", self._exactly(8))
            message = json.loads(self._exactly(size))
            if message["type"] == kind and wanted(message):
                return message

    def _exactly(self, n: int) -> bytes:
        got = b""
        while len(got) < n:
            part = self._socket.recv(n - len(got))
            assert part, "the studio has ended"
            got += part
        return got


def test_it_shows_a_text_and_ends_with_its_port_free() -> None:
    with setpiece.studio(TEXT) as page, Tab(page) as tab:
        assert tab.hear("opened")["text"] == TEXT
        assert len(tab.hear("episode")["scenes"]) == 13
        with urllib.request.urlopen(page.address) as answer:
            framed = answer.headers["Content-Security-Policy"]
        assert "frame-ancestors 'self' http://localhost:*" in framed
        assert f'src="{page.address}"' in page._repr_html_()
        with pytest.raises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(page.address.split("?")[0])
        refused.value.close()
    with socket.socket() as free:
        free.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        free.bind(("127.0.0.1", page.port))
    page.close()


def test_a_policy_of_the_program_plays() -> None:
    seen: list[Any] = []

    def right(observation: Any) -> int:
        seen.append(observation.shape)
        return setpiece.Action.RIGHT

    policies = {
        "right": right,
        "raw": setpiece.Policy(lambda raws: [5] * len(raws), "raw"),
        "broken": lambda _: 1 / 0,
        "wrong": lambda _: 99,
    }
    with setpiece.studio("academy_empty_goal_close", policies=policies) as page, Tab(page) as tab:
        players = tab.hear("checked")["players"]
        assert {"bot", "right", "raw"} <= {*players}
        tab.ask(type="play", seed=3, episode=0, agent="right", beside="raw")
        first = tab.hear("episode", lambda one: one["agent"] == "right")
        beside = tab.hear("episode")
        assert first["outcome"] == "scored"
        assert beside["beside"]
        assert beside["scenes"][-1]["ball"] == first["scenes"][-1]["ball"]
        assert {*seen} == {(115,)}
        tab.ask(type="summary", episodes=5)
        assert tab.hear("summary")["outcomes"] == [["scored", 5]]
        tab.ask(type="play", seed=3, episode=0, agent="broken")
        assert "ZeroDivisionError: division by zero" in tab.hear("refused")["message"]
        tab.ask(type="play", seed=3, episode=0, agent="wrong")
        assert "0..19, found `99`" in tab.hear("refused")["message"]


def test_people_and_policies_play_each_other() -> None:
    with (
        setpiece.studio(
            "scenario duel extends academy_3_vs_1_with_keeper { agents { left: all, right: 1 } }",
            policies={"still": lambda _: setpiece.Action.IDLE},
        ) as page,
        Tab(page) as tab,
    ):
        seats = [seat["id"] for seat in tab.hear("checked")["agents"]]
        tab.ask(type="play", seed=0, episode=0, agent="still")
        tab.hear("episode", lambda one: one["agent"] == "still")
        tab.ask(type="begin", seats=[seats[0], seats[-1]])
        tab.ask(type="hold", seat=0, keys={"way": [-1, 0], "held": []})
        start = tab.hear("step")["scenes"][0]
        later = tab.hear("step", lambda one: one["scenes"][-1]["step"] >= 8)["scenes"][-1]
        moved = [b[0] - a[0] for a, b in zip(start["players"], later["players"], strict=True)]
        tab.ask(type="stop")
        assert tab.hear("episode")["agent"] == "you"
        assert min(moved[:4]) < -0.5


@pytest.mark.parametrize("wrapped", [False, True])
def test_it_shows_the_episodes_of_an_environment(wrapped: bool) -> None:
    env: Any = setpiece.make("academy_empty_goal_close", params={"difficulty": 0.3})
    if wrapped:
        env = gymnasium.wrappers.TimeLimit(env, 30)
    with setpiece.studio(env, every_s=0) as page, Tab(page) as tab:
        shown = {one["name"]: one["value"] for one in tab.hear("checked")["params"]}
        assert shown["difficulty"] == 0.3
        for seed in range(3):
            env.reset(seed=seed)
            over = False
            while not over:
                *_, over, _, _ = env.step(setpiece.Action.RIGHT)
            watched = tab.hear("episode", lambda one: one["watched"])
            assert (watched["seed"], watched["outcome"]) == (seed, "scored")
            assert watched["scenes"][-1]["score"] == [1, 0]
    assert env.unwrapped.mirrors == []


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_it_shows_the_first_environment_of_a_vector(mode: str) -> None:
    env = setpiece.make_vec("academy_3_vs_1_with_keeper", 3, left=2, autoreset_mode=mode)
    rng = np.random.default_rng(0)
    with setpiece.studio(env, every_s=0) as page, Tab(page) as tab:
        env.reset(seed=40)
        ended: list[tuple[int, int, float]] = []
        while len(ended) < 3:
            _, _, terminated, truncated, infos = env.step(rng.integers(0, 19, (3, 2)))
            if (terminated | truncated)[0]:
                summary = infos.get("final_info", infos)["setpiece"]
                ended.append((summary["seed"][0], summary["index"][0], summary["length"][0]))
        for seed, index, length in ended:
            watched = tab.hear("episode", lambda one: one["watched"])
            assert (watched["seed"], watched["episode"]) == (seed, index)
            assert watched["scenes"][-1]["step"] == length


def test_an_episode_that_began_unwatched_is_not_shown() -> None:
    env = setpiece.make_vec("academy_empty_goal_close", 2)
    env.reset(seed=1)
    env.step([setpiece.Action.RIGHT] * 2)
    with setpiece.studio(env, every_s=0) as page, Tab(page) as tab:
        ended = 0
        while ended < 2:
            _, _, terminated, truncated, infos = env.step([setpiece.Action.RIGHT] * 2)
            if (terminated | truncated)[0]:
                ended += 1
                length = infos["setpiece"]["length"][0]
        watched = tab.hear("episode", lambda one: one["watched"])
        assert (watched["episode"], watched["scenes"][-1]["step"]) == (1, length)
        assert watched["outcome"] == "scored"


def test_a_studio_that_nobody_keeps_runs_on() -> None:
    address = setpiece.studio("academy_corner").address
    with urllib.request.urlopen(address) as answer:
        assert answer.status == 200


def test_at_most_one_episode_is_shown_every_few_seconds() -> None:
    env = setpiece.make("academy_empty_goal_close")
    with setpiece.studio(env, every_s=1e6) as page, Tab(page) as tab:
        for seed in (1, 2):
            env.reset(seed=seed)
            while not env.step(setpiece.Action.RIGHT)[2]:
                pass
        tab.hear("episode", lambda one: one["watched"] and one["seed"] == 1)
        tab.ask(type="summary", episodes=1)
        # Nothing else has come.
        tab.hear("summary")


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ({"source": 3}, "scenario"),
        ({"policies": [1]}, "policies"),
        ({"policies": {"a": 3}}, "policies"),
        ({"policies": {"a": "bot"}}, "policies"),
        ({"policies": {"bot": lambda _: 5}}, "policies"),
        ({"policies": {"": lambda _: 5}}, "policies"),
        ({"policies": {"a": setpiece.Policy(lambda *_: [5], masks=True)}}, "policies"),
        ({"every_s": -1}, "every_s"),
        ({"every_s": "x"}, "every_s"),
        ({"port": 70_000}, "port"),
        ({"port": -1}, "port"),
    ],
)
def test_wrong_arguments_are_named(arguments: dict[str, Any], name: str) -> None:
    with pytest.raises(setpiece.ParameterError) as error:
        setpiece.studio(**arguments)
    assert error.value.name == name


def test_what_cannot_be_opened_is_reported_as_by_load() -> None:
    with pytest.raises(setpiece.UnknownScenarioError):
        setpiece.studio("academy_cornr")
    with pytest.raises(setpiece.CompileError):
        setpiece.studio("scenario x { ball nowhere }")
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        with pytest.raises(setpiece.ParameterError, match="can't be served"):
            setpiece.studio("academy_corner", port=taken.getsockname()[1])
    with setpiece.studio() as page, pytest.raises(setpiece.ParameterError):
        page.follow(3)
    env = setpiece.make("academy_empty_goal_close")
    with pytest.raises(setpiece.ParameterError, match="has ended"):
        page.follow(env)
    assert env.mirrors == []


def test_a_program_that_ends_without_closing_it_ends() -> None:
    code = (
        "import setpiece; env = setpiece.make('academy_empty_goal_close');"
        "page = setpiece.studio(env, policies={'a': lambda _: 5}); env.reset(seed=1); env.step(5)"
    )
    done = subprocess.run([sys.executable, "-c", code], timeout=60, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("closing", ["page.close()", "pass", "os.fork() or page.close()"])
def test_a_program_ends_while_its_policy_plays(closing: str) -> None:
    code = f"""
import os, sys, time, setpiece
sys.path.insert(0, {os.fspath(Path(__file__).parent)!r})
from test_studio import Tab
asked = []
def slow(observation):
    asked.append(1)
    time.sleep(0.05)
    return 5
page = setpiece.studio("academy_3_vs_1_with_keeper", policies={{"slow": slow}})
tab = Tab(page)
tab.ask(type="play", seed=1, episode=0, agent="slow")
while not asked:
    time.sleep(0.01)
{closing}
before = len(asked)
time.sleep(0.3)
assert {closing!r} != "page.close()" or len(asked) <= before + 1
tab.__exit__()
"""
    done = subprocess.run([sys.executable, "-c", code], timeout=60, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


def test_the_examples_of_its_page_run() -> None:
    names: dict[str, Any] = {}
    for block in examples("studio.md"):
        exec(compile(block, "studio.md", "exec"), names)
    assert names["page"].port > 0
