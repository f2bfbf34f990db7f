"""Football scenarios from text files, and the engine that runs them.

>>> import setpiece
>>> env = setpiece.make("academy_empty_goal_close")
>>> observation, info = env.reset(seed=1)
>>> observation.shape, info["score"]
((115,), [0, 0])

Importing the package registers every scenario of the library with Gymnasium:

>>> import gymnasium
>>> env = gymnasium.make("setpiece/academy_3_vs_1_with_keeper-v0")
"""

from setpiece._environment import FootballEnv, make
from setpiece._errors import (
    ActionError,
    CompileError,
    Diagnostic,
    DrawError,
    FileError,
    FormatError,
    InUseError,
    Label,
    ParameterError,
    RewardError,
    ScriptError,
    SetpieceError,
    SnapshotError,
    UnavailableError,
    UnknownScenarioError,
)
from setpiece._library import Entry, list, register_envs
from setpiece._native import Param, Scenario, __version__, compile, load
from setpiece._reload import Reload
from setpiece._vocabulary import Action, GameMode, Role

__all__ = [
    "Action",
    "ActionError",
    "CompileError",
    "Diagnostic",
    "DrawError",
    "Entry",
    "FileError",
    "FootballEnv",
    "FormatError",
    "GameMode",
    "InUseError",
    "Label",
    "Param",
    "ParameterError",
    "Reload",
    "RewardError",
    "Role",
    "Scenario",
    "ScriptError",
    "SetpieceError",
    "SnapshotError",
    "UnavailableError",
    "UnknownScenarioError",
    "__version__",
    "compile",
    "list",
    "load",
    "make",
    "register_envs",
]

register_envs()
