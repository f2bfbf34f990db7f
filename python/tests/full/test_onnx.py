import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import play, same

import setpiece
from setpiece import Action, Policy, parallel_env
from setpiece._native import BASELINES, baseline_file

pytest.importorskip("onnxruntime")
onnx = pytest.importorskip("onnx")

from onnx import TensorProto, helper, numpy_helper

DUEL = "1_vs_1_easy"

pytestmark = pytest.mark.filterwarnings("default")


def save(
    path: Path,
    shape: tuple[int, ...] = (115,),
    favourite: int = Action.RIGHT,
    n_actions: int = 19,
    batch: Any = "batch",
    kind: int = TensorProto.FLOAT,
    repeat: str | None = None,
    **metadata: str,
) -> Path:
    """Writes a linear model with one favourite action."""
    size = int(np.prod(shape))
    bias = np.zeros(n_actions, np.float32)
    bias[favourite] = 1e6
    weights = np.random.default_rng(0).normal(size=(size, n_actions)).astype(np.float32)
    graph = helper.make_graph(
        [
            helper.make_node("Cast", ["observation"], ["cast"], to=TensorProto.FLOAT),
            helper.make_node("Flatten", ["cast"], ["flat"]),
            helper.make_node("Gemm", ["flat", "weights", "bias"], ["logits"]),
        ],
        "policy",
        [helper.make_tensor_value_info("observation", kind, [batch, *shape])],
        [helper.make_tensor_value_info("logits", TensorProto.FLOAT, [batch, n_actions])],
        [numpy_helper.from_array(weights, "weights"), numpy_helper.from_array(bias, "bias")],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=9)
    if repeat is not None:
        metadata["repeat"] = repeat
    helper.set_model_props(model, metadata)
    onnx.checker.check_model(model)
    onnx.save(model, path)
    return path


def test_a_model_plays_what_it_likes_best(tmp_path: Path) -> None:
    model = save(tmp_path / "policy.onnx")
    trained = setpiece.make(DUEL, right=1, opponents={"right": str(model)})
    simple = setpiece.make(DUEL, right=1, opponents={"right": lambda _: Action.RIGHT})
    assert same(play(trained, 1, lambda: Action.LEFT), play(simple, 1, lambda: Action.LEFT))


@pytest.mark.parametrize("batch", ["batch", 1])
def test_it_plays_every_agent_of_its_side(tmp_path: Path, batch: Any) -> None:
    model = save(tmp_path / "policy.onnx", batch=batch)
    env = parallel_env(
        "academy_3_vs_1_with_keeper", left=3, right="all", opponents={"right": model}
    )
    env.reset(seed=1)
    env.step(dict.fromkeys(env.agents, 0))
    played = env.env.played()
    assert played["right_GK_1"] == played["right_CB_1"] == Action.RIGHT


@pytest.mark.parametrize("kind", [TensorProto.UINT8, TensorProto.FLOAT, TensorProto.DOUBLE])
def test_it_can_see_another_observation_than_the_caller(tmp_path: Path, kind: int) -> None:
    model = save(
        tmp_path / "pixels.onnx",
        shape=(72, 96, 4),
        kind=kind,
        n_actions=20,
        favourite=Action.BUILTIN_AI,
    )
    env = setpiece.make(DUEL, right=1, opponents={"right": Policy(model, observation="smm")})
    bot = setpiece.make(DUEL, right=1, opponents={"right": "bot"})
    assert same(
        play(env, 1, lambda: Action.LEFT, steps=50), play(bot, 1, lambda: Action.LEFT, steps=50)
    )


def test_the_greatest_logit_wins(tmp_path: Path) -> None:
    policy = setpiece.onnx_policy(save(tmp_path / "policy.onnx", favourite=Action.SHOT))
    actions = policy(np.zeros((5, 115), np.float32))
    assert actions.tolist() == [Action.SHOT] * 5
    assert actions.dtype == np.int64


def test_a_model_says_how_long_a_decision_lasts(tmp_path: Path) -> None:
    policy = setpiece.onnx_policy(save(tmp_path / "policy.onnx", repeat="4"))
    assert policy.repeat == 4
    assert setpiece.onnx_policy(save(tmp_path / "policy.onnx")).repeat == 1
    for wrong in ("0", "often", "-1", "1.5", "1001"):
        with pytest.raises(setpiece.FormatError, match="expected a number of steps"):
            setpiece.onnx_policy(save(tmp_path / "wrong.onnx", repeat=wrong))


def test_a_model_names_what_it_sees(tmp_path: Path) -> None:
    pixels = save(
        tmp_path / "policy.onnx", shape=(72, 96, 4), kind=TensorProto.UINT8, observation="smm"
    )
    named = setpiece.make(DUEL, right=1, opponents={"right": pixels})
    asked = setpiece.make(DUEL, right=1, opponents={"right": Policy(pixels, observation="smm")})
    assert same(play(named, 1), play(asked, 1))
    scaled = setpiece.onnx_policy(save(tmp_path / "s.onnx", observation="egocentric", scale="true"))
    assert (scaled.observation, scaled.scale) == ("egocentric", True)
    # A stack is the caller's.
    stacked = setpiece.onnx_policy(save(tmp_path / "4.onnx", observation="smm", stack="4"))
    assert stacked.observation is None
    with pytest.raises(setpiece.FormatError, match="`observation` is `radar`"):
        setpiece.onnx_policy(save(tmp_path / "wrong.onnx", observation="radar"))


def linear(n: int, torch: Any) -> Any:
    """Three layers that see `n` numbers, standardised as in `baselines`."""
    nn = torch.nn
    layers = [nn.LayerNorm(n), nn.Linear(n, 32), nn.Tanh(), nn.Linear(32, 32), nn.ReLU()]
    return nn.Sequential(*layers, nn.Linear(32, 19))


def filters(planes: int, torch: Any) -> Any:
    """Filters over maps, as in `baselines`."""

    class Filters(torch.nn.Module):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__()
            nn = torch.nn
            layers = [nn.Conv2d(planes, 4, 8, 4), nn.ReLU(), nn.Conv2d(4, 8, 4, 2), nn.ReLU()]
            self.layers = nn.Sequential(*layers, nn.Flatten(), nn.Linear(560, 20))

        def forward(self, maps: Any) -> Any:
            return self.layers(maps.permute(0, 3, 1, 2).float() / 255).log_softmax(-1)

    return Filters()


@pytest.mark.parametrize(
    ("observation", "stack", "scale"),
    [("simple115v2", 1, ""), ("simple115v2", 4, ""), ("egocentric", 1, "true"), ("smm", 2, "")],
)
def test_the_command_plays_the_episodes_of_python(
    tmp_path: Path, observation: str, stack: int, scale: str
) -> None:
    """To the digest, with another runtime: what is wide, stacked, scaled, and held for 3 steps."""
    torch = pytest.importorskip("torch")
    torch.manual_seed(1)
    scenario, file = "academy_3_vs_1_with_keeper", tmp_path / "policy.onnx"
    env = setpiece.make(scenario, observation=observation, stack=stack, scale=scale == "true")
    shown = torch.from_numpy(env.reset(seed=1)[0][None])
    network = filters(4 * stack, torch) if observation == "smm" else linear(shown.shape[1], torch)
    # Large weights: what it presses depends on what it sees.
    for weights in network.parameters():
        torch.nn.init.normal_(weights)
    axes = {"observation": {0: "batch"}}
    torch.onnx.export(
        network.eval(), (shown,), file, input_names=["observation"], dynamic_axes=axes, dynamo=False
    )
    model = onnx.load(file)
    said = {"repeat": "3", "observation": observation, "scale": scale, "stack": str(stack)}
    helper.set_model_props(model, said)
    onnx.save(model, file)
    line = [sys.executable, "-m", "setpiece", "run", scenario, "--agent", str(file)]
    line += ["--episodes", "40", "--format", "json"]
    played = json.loads(subprocess.run(line, capture_output=True, check=True).stdout)
    (row,) = setpiece.evaluate(
        file, scenario, episodes=40, observation=observation, stack=stack, scale=scale == "true"
    ).rows
    assert played["digest"] == row.digest
    # It does something.
    assert row.digest != setpiece.evaluate("idle", scenario, episodes=40).rows[0].digest


@pytest.mark.parametrize("name", BASELINES)
def test_a_policy_in_the_box_plays_the_same_everywhere(tmp_path: Path, name: str) -> None:
    file = tmp_path / "policy.onnx"
    file.write_bytes(baseline_file(setpiece.load(name))[1])
    boxed, opened = (
        setpiece.evaluate(policy, name, episodes=50, observation="egocentric").rows[0].digest
        for policy in ("baseline", file)
    )
    assert boxed == opened
    env, same_env = (
        setpiece.make(name, right=1, opponents={"left": policy}) for policy in ("baseline", file)
    )
    assert same(play(env, 1), play(same_env, 1))
    envs = setpiece.make_vec(name, 3, right=1, opponents={"left": "baseline"})
    envs.reset(seed=1)
    envs.step(np.zeros(3, int))


def test_a_scenario_without_a_baseline_says_which_have_one() -> None:
    for play_with in (
        lambda: setpiece.make(DUEL, right=1, opponents={"right": "baseline"}),
        lambda: setpiece.evaluate("baseline", DUEL),
        lambda: setpiece.play(DUEL, "baseline", "bot"),
    ):
        with pytest.raises(setpiece.ParameterError, match="has no baseline") as caught:
            play_with()
        assert caught.value.code == "SP0024"
        assert "`academy_empty_goal_close`" in str(caught.value.help)


@pytest.mark.parametrize("kind", [TensorProto.BOOL, TensorProto.FLOAT, TensorProto.UINT8])
@pytest.mark.parametrize("n_actions", [19, 20])
def test_a_model_takes_masks(tmp_path: Path, kind: int, n_actions: int) -> None:
    """Its logits are the mask, so that it presses the first action that has an effect."""
    graph = helper.make_graph(
        [
            helper.make_node("Cast", ["mask"], ["rated"], to=TensorProto.FLOAT),
            helper.make_node("ReduceSum", ["observation", "axis"], ["sum"], keepdims=1),
            helper.make_node("Mul", ["sum", "zero"], ["nothing"]),
            helper.make_node("Add", ["rated", "nothing"], ["logits"]),
        ],
        "masked",
        [
            helper.make_tensor_value_info("observation", TensorProto.FLOAT, ["batch", 115]),
            helper.make_tensor_value_info("mask", kind, ["batch", n_actions]),
        ],
        [helper.make_tensor_value_info("logits", TensorProto.FLOAT, ["batch", n_actions])],
        [
            numpy_helper.from_array(np.array([1]), "axis"),
            numpy_helper.from_array(np.zeros(1, np.float32), "zero"),
        ],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=9)
    onnx.save(model, tmp_path / "masked.onnx")
    policy = setpiece.onnx_policy(tmp_path / "masked.onnx")
    assert policy.masks
    masks = np.zeros((2, 20), np.int8)
    masks[0, 3:6], masks[1, 18] = 1, 1
    assert policy(np.zeros((2, 115), np.float32), masks).tolist() == [3, 18]
    with pytest.raises(setpiece.ParameterError, match="takes masks"):
        policy(np.zeros((2, 115), np.float32))
    suite = "suite s { academy_3_vs_1_with_keeper for 5 episodes }"
    first = Policy(lambda _, masks: masks.argmax(-1), masks=True)
    played = setpiece.evaluate(tmp_path / "masked.onnx", suite).rows
    assert played == setpiece.evaluate(first, suite).rows
    assert not setpiece.onnx_policy(save(tmp_path / "policy.onnx")).masks


def test_a_match_of_two_models(tmp_path: Path) -> None:
    model = save(tmp_path / "policy.onnx")
    played = setpiece.play(DUEL, str(model), "bot", seed=2)
    assert set(played.actions[:, 0]) == {Action.RIGHT}


def test_files_that_are_no_policies(tmp_path: Path) -> None:
    with pytest.raises(setpiece.FileError, match="there is no file"):
        setpiece.onnx_policy(tmp_path / "nowhere.onnx")
    (tmp_path / "text.onnx").write_text("no model")
    with pytest.raises(setpiece.FormatError, match="no ONNX model"):
        setpiece.onnx_policy(tmp_path / "text.onnx")
    seven = save(tmp_path / "seven.onnx", n_actions=7, favourite=1)
    with pytest.raises(setpiece.FormatError, match=r"\[1, 19\]"):
        setpiece.make(DUEL, right=1, opponents={"right": seven})
    with pytest.raises(setpiece.FormatError, match="expected one"):
        setpiece.onnx_policy(save(tmp_path / "int.onnx", kind=TensorProto.INT32))
    wide = setpiece.make(
        DUEL, right=1, opponents={"right": save(tmp_path / "wide.onnx", shape=(116,))}
    )
    wide.reset(seed=1)
    with pytest.raises(setpiece.OpponentError, match="of `right_GK_1` failed") as caught:
        wide.step(0)
    assert caught.value.code == "SP0023"
    assert "observation=" in str(caught.value.help)


def two_inputs(path: Path) -> Path:
    """Writes a model of two observations."""
    shown = [
        helper.make_tensor_value_info(name, TensorProto.FLOAT, ["batch", 19]) for name in ("a", "b")
    ]
    logits = helper.make_tensor_value_info("logits", TensorProto.FLOAT, ["batch", 19])
    graph = helper.make_graph(
        [helper.make_node("Add", ["a", "b"], ["logits"])], "two", shown, [logits]
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=9)
    onnx.save(model, path)
    return path


def undefined(path: Path) -> Path:
    """Writes a model whose logits are no numbers, as those of a training that diverged."""
    model = onnx.load(save(path))
    for weights in model.graph.initializer:
        numbers = np.full_like(numpy_helper.to_array(weights), np.nan)
        weights.CopyFrom(numpy_helper.from_array(numbers, weights.name))
    onnx.save(model, path)
    return path


def odd(kind: str, path: Path) -> Path:
    """Writes a file that is no policy."""
    whole = save(path).read_bytes()
    if kind in ("text", "empty", "cut"):
        path.write_bytes({"text": b"no model", "empty": b"", "cut": whole[: len(whole) // 2]}[kind])
        return path
    if kind == "several inputs":
        return two_inputs(path)
    if kind == "no numbers":
        return undefined(path)
    shapes = {"wide": (116,), "flat picture": (72, 96)}
    if kind in shapes:
        return save(path, shape=shapes[kind])
    return save(path, n_actions=33)


ODD = ("text", "empty", "cut", "several inputs", "no numbers", "many actions", "wide")


@pytest.mark.parametrize("kind", [*ODD, "flat picture"])
def test_an_odd_file_is_refused_as_by_the_command(tmp_path: Path, kind: str) -> None:
    file = odd(kind, tmp_path / "odd.onnx")
    line = [sys.executable, "-m", "setpiece", "run", DUEL, "--agent", str(file)]
    said = subprocess.run(line, capture_output=True, check=False)
    assert said.returncode == 1
    assert b"SP0023" in said.stderr, said.stderr
    with pytest.raises(setpiece.SetpieceError, match=r"the policy `.*` can't be played") as caught:
        setpiece.evaluate(file, DUEL, episodes=1)
    assert caught.value.code == "SP0023"
    if b"help:" in said.stderr:
        assert caught.value.help
    with pytest.raises(setpiece.SetpieceError, match="can't be played") as caught:
        play(setpiece.make(DUEL, right=1, opponents={"right": file}), 1)
    assert caught.value.code == "SP0023"
