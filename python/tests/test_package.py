import doctest
import importlib
import json
import pkgutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from types import ModuleType

import pytest

import setpiece

MODULES = [
    "setpiece",
    *(f"setpiece.{module.name}" for module in pkgutil.iter_modules(setpiece.__path__)),
]


@pytest.mark.parametrize(
    "name", [name for name in MODULES if not name.endswith(("__main__", "_native"))]
)
def test_examples_of_docstrings(name: str) -> None:
    try:
        module: ModuleType = importlib.import_module(name)
    except setpiece.MissingPackageError as missing:
        pytest.skip(str(missing))
    assert doctest.testmod(module).failed == 0


def test_public_names_are_documented() -> None:
    for name in setpiece.__all__:
        if name != "__version__":
            assert getattr(setpiece, name).__doc__, name


def test_words_agree_with_the_engine() -> None:
    assert [action.name.lower() for action in setpiece.Action] == [
        name for name, _ in setpiece._native.ACTIONS
    ]
    assert all(action.doc for action in setpiece.Action)


def command(*arguments: str, program: str | None = None) -> subprocess.CompletedProcess[str]:
    start = [program] if program else [sys.executable, "-m", "setpiece"]
    return subprocess.run(
        [*start, *arguments], capture_output=True, text=True, check=False, timeout=300
    )


def test_command_of_the_module() -> None:
    listed = command("list")
    assert listed.returncode == 0
    assert "academy_corner" in listed.stdout
    ran = command(
        "run", "academy_empty_goal_close", "--episodes", "2", "--seed", "1", "--format", "json"
    )
    assert json.loads(ran.stdout)["episodes"] == 2


def test_exit_codes() -> None:
    assert command("run", "academy_cornr").returncode == 1
    assert command("run", "academy_corner", "--episodes", "0").returncode == 2
    assert command("--version").stdout.split() == ["setpiece", setpiece.__version__]


def test_installed_command() -> None:
    script = Path(
        sysconfig.get_path("scripts"), "setpiece.exe" if sys.platform == "win32" else "setpiece"
    )
    assert "academy_corner" in command("list", program=str(script)).stdout
