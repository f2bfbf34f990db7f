"""`install()`: GRF's own imports find this package, and Gymnasium its ids."""

import importlib
import pkgutil
import sys
from types import ModuleType

import gymnasium
import pytest

import setpiece
from setpiece import InUseError, gfootball

pytestmark = pytest.mark.usefixtures("nothing_installed")


def test_imports_of_grf_work() -> None:
    gfootball.install()
    gfootball.install()
    football_env = importlib.import_module("gfootball.env")
    assert football_env is gfootball.env
    for name in [
        *(
            "config",
            "football_action_set",
            "football_env",
            "football_env_core",
            "observation_preprocessing",
        ),
        *(
            "observation_processor",
            "observation_rotation",
            "player_base",
            "scenario_builder",
            "script_helpers",
        ),
        *(
            "wrappers",
            "players.agent",
            "players.bot",
            "players.lazy",
            "players.replay",
            "players.builtin_ai",
        ),
    ]:
        alias = importlib.import_module(f"gfootball.env.{name}")
        assert alias is importlib.import_module(f"setpiece.gfootball.env.{name}")
    assert importlib.import_module("gfootball.scenarios").Team is gfootball.scenarios.Team
    env = football_env.create_environment(env_name="academy_corner", representation="simple115v2")
    assert env.reset().shape == (115,)


def test_another_gfootball_is_left_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    real = ModuleType("gfootball")
    monkeypatch.setitem(sys.modules, "gfootball", real)
    with pytest.raises(InUseError, match="already"):
        gfootball.install()
    assert sys.modules["gfootball"] is real


@pytest.mark.parametrize(
    ("suffix", "shape"),
    [
        ("SMM", (72, 96, 4)),
        ("Pixels", (72, 96, 3)),
        ("simple115", (115,)),
        ("simple115v2", (115,)),
    ],
)
def test_ids(suffix: str, shape: tuple[int, ...]) -> None:
    gfootball.install()
    for name in setpiece.list():
        assert f"GFootball-{name}-{suffix}-v0" in gymnasium.registry
    env = gymnasium.make(
        f"GFootball-academy_empty_goal_close-{suffix}-v0", rewards="scoring,checkpoints"
    )
    assert env.reset().shape == shape  # type: ignore[attr-defined]
    assert len(env.step(0)) == 4


def test_wrappers_of_gymnasium_go_around_it() -> None:
    env = gymnasium.Wrapper(gfootball.env.create_environment("academy_corner"))
    assert env.reset().shape == (72, 96, 4)  # type: ignore[attr-defined]
    assert len(env.step(0)) == 4


def test_every_module_is_imported_by_its_alias() -> None:
    gfootball.install()
    for module in pkgutil.walk_packages(gfootball.__path__, "gfootball."):
        if not module.name.rpartition(".")[2].startswith("_"):
            assert module.name in sys.modules
