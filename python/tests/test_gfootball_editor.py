"""The editor's reading of a script equals what running it gives."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import IO, Any

import pytest
from gfootball_scripts import HEAD, ONE_TEAM, script_file
from test_gfootball_scenarios import (
    BALL_TAKES_TURNS,
    COMPONENTS,
    EVERYTHING,
    PLACES_TAKE_TURNS,
    PLAIN,
)

import setpiece
from setpiece.gfootball._import import import_script

STRAIGHT = {
    "plain": PLAIN,
    "everything": EVERYTHING,
    "ball_takes_turns": BALL_TAKES_TURNS,
    "places_take_turns": PLACES_TAKE_TURNS,
    "one_team": ONE_TEAM,
    "components": COMPONENTS,
}


class Client:
    """A client of `setpiece lsp`."""

    def __init__(self, folder: Path) -> None:
        root = str(Path(setpiece.__file__).parents[1])
        self.server = subprocess.Popen(
            [sys.executable, "-m", "setpiece", "lsp"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": root},
            cwd=folder,
        )
        self.asked = 0
        self.ask("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
        self.say("initialized", {})

    def _send(self, message: dict[str, Any]) -> None:
        content = json.dumps({"jsonrpc": "2.0", **message}).encode()
        pipe = self.server.stdin
        assert pipe is not None
        pipe.write(b"Content-Length: %d\r\n\r\n%b" % (len(content), content))
        pipe.flush()

    def say(self, method: str, params: dict[str, Any]) -> None:
        self._send({"method": method, "params": params})

    def ask(self, method: str, params: dict[str, Any] | None) -> Any:
        self.asked += 1
        self._send({"id": self.asked, "method": method, "params": params})
        pipe = self.server.stdout
        assert pipe is not None
        while True:
            answer = _read(pipe)
            if answer.get("id") == self.asked and "method" not in answer:
                assert "error" not in answer, answer
                return answer["result"]

    def close(self) -> None:
        self.ask("shutdown", None)
        self.say("exit", {})
        assert self.server.wait(timeout=20) == 0
        for pipe in (self.server.stdin, self.server.stdout):
            assert pipe is not None
            pipe.close()


def _read(pipe: IO[bytes]) -> dict[str, Any]:
    length = 0
    while line := pipe.readline().strip():
        name, _, value = line.partition(b":")
        if name.lower() == b"content-length":
            length = int(value)
    message: dict[str, Any] = json.loads(pipe.read(length))
    return message


@pytest.mark.parametrize("shape", STRAIGHT)
def test_a_pasted_script_becomes_the_text_that_an_import_writes(shape: str, tmp_path: Path) -> None:
    expected = import_script(script_file(tmp_path, STRAIGHT[shape], shape))
    uri = (tmp_path / f"{shape}.pitch").as_uri()
    text = HEAD + STRAIGHT[shape]
    client = Client(tmp_path)
    client.say(
        "textDocument/didOpen",
        {"textDocument": {"uri": uri, "languageId": "pitch", "version": 1, "text": text}},
    )
    here = {"line": 4, "character": 0}
    [action] = client.ask(
        "textDocument/codeAction",
        {
            "textDocument": {"uri": uri},
            "range": {"start": here, "end": here},
            "context": {"diagnostics": [], "only": ["quickfix"]},
        },
    )
    client.close()
    assert action["kind"] == "quickfix"
    [edit] = action["edit"]["changes"][uri]
    assert edit["range"]["start"] == {"line": 0, "character": 0}
    assert edit["newText"] == expected
