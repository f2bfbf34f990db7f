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

from setpiece import samplers
from setpiece._callbacks import Step
from setpiece._environment import FootballEnv
from setpiece._errors import (
    ActionError,
    CallbackError,
    CompileError,
    Diagnostic,
    DrawError,
    FileError,
    FormatError,
    GrfScriptError,
    InUseError,
    Label,
    LevelError,
    MissingPackageError,
    OpponentError,
    ParameterError,
    ReplayError,
    RewardError,
    ScriptError,
    SetpieceError,
    SnapshotError,
    UnavailableError,
    UnknownScenarioError,
)
from setpiece._evaluate import evaluate
from setpiece._groups import FootballGroups, make_groups
from setpiece._level import Level
from setpiece._levels import Curriculum, LevelResult, curriculum
from setpiece._library import Entry, list, register_envs
from setpiece._make import make
from setpiece._native import Param, Scenario, __version__, compile
from setpiece._onnx import onnx_policy
from setpiece._opponents import Policy
from setpiece._pettingzoo import parallel_env, register_pettingzoo
from setpiece._play import Played, play
from setpiece._reload import Reload
from setpiece._replay import Moment, Replay
from setpiece._scenario_dict import ScenarioDict, pitch_text
from setpiece._source import load
from setpiece._studio import Studio, studio
from setpiece._suite import Estimate, Suite, SuiteEntry, SuiteRow, SuiteTable, suite, suites
from setpiece._vector import FootballVectorEnv, make_vec
from setpiece._vocabulary import Action, GameMode, Role

__all__ = [
    "Action",
    "ActionError",
    "CallbackError",
    "CompileError",
    "Curriculum",
    "Diagnostic",
    "DrawError",
    "Entry",
    "Estimate",
    "FileError",
    "FootballEnv",
    "FootballGroups",
    "FootballVectorEnv",
    "FormatError",
    "GameMode",
    "GrfScriptError",
    "InUseError",
    "Label",
    "Level",
    "LevelError",
    "LevelResult",
    "MissingPackageError",
    "Moment",
    "OpponentError",
    "Param",
    "ParameterError",
    "Played",
    "Policy",
    "Reload",
    "Replay",
    "ReplayError",
    "RewardError",
    "Role",
    "Scenario",
    "ScenarioDict",
    "ScriptError",
    "SetpieceError",
    "SnapshotError",
    "Step",
    "Studio",
    "Suite",
    "SuiteEntry",
    "SuiteRow",
    "SuiteTable",
    "UnavailableError",
    "UnknownScenarioError",
    "__version__",
    "compile",
    "curriculum",
    "evaluate",
    "list",
    "load",
    "make",
    "make_groups",
    "make_vec",
    "onnx_policy",
    "parallel_env",
    "pitch_text",
    "play",
    "register_envs",
    "register_pettingzoo",
    "samplers",
    "studio",
    "suite",
    "suites",
]

register_envs()
