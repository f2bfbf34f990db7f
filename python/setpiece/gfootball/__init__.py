"""Google Research Football's Python interface on this engine.

>>> from setpiece import gfootball
>>> gfootball.install()
>>> import gfootball.env as football_env
>>> env = football_env.create_environment("academy_3_vs_1_with_keeper", representation="simple115v2")
>>> env.reset().shape
(115,)
"""

from __future__ import annotations

import importlib
import pkgutil
import sys

import gymnasium

import setpiece
from setpiece._errors import InUseError
from setpiece.gfootball import env, scenarios
from setpiece.gfootball._dump import replay_to_dump

__all__ = ["env", "install", "replay_to_dump", "scenarios"]

ALIAS = "gfootball"
REPRESENTATIONS = {
    "SMM": "extracted",
    "Pixels": "pixels",
    "simple115": "simple115",
    "simple115v2": "simple115v2",
}


def install() -> None:
    """Lets `import gfootball` find this package, and registers GRF's ids with Gymnasium.

    `gymnasium.make("GFootball-NAME-simple115v2-v0")` makes an environment with
    `create_environment`, with the interface of old Gym. Calling it again is a no-op. Raises
    `InUseError` if the real `gfootball` is already imported.
    """
    there = sys.modules.get(ALIAS)
    if there is not None and there is not sys.modules[__name__]:
        raise InUseError(
            "another `gfootball` is imported already",
            help="call `install()` before anything imports `gfootball`",
        )
    package = sys.modules[__name__]
    sys.modules[ALIAS] = package
    for module in pkgutil.walk_packages(package.__path__, f"{__name__}."):
        if not module.name.rpartition(".")[2].startswith("_"):
            sys.modules[ALIAS + module.name.removeprefix(__name__)] = importlib.import_module(
                module.name
            )
    for name in setpiece.list():
        for suffix, representation in REPRESENTATIONS.items():
            env_id = f"GFootball-{name}-{suffix}-v0"
            if env_id not in gymnasium.registry:
                gymnasium.register(
                    env_id,
                    entry_point=f"{__name__}.env:create_environment",
                    kwargs={"env_name": name.name, "representation": representation},
                    # Both expect the current interface.
                    order_enforce=False,
                    disable_env_checker=True,
                )
