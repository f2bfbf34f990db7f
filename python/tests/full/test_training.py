import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import setpiece

torch = pytest.importorskip("torch")
pytest.importorskip("tensorboard")
pytest.importorskip("onnx")

EXAMPLES = Path(__file__).parents[3] / "examples"
CLOSE = ["--scenario", "academy_empty_goal_close", "--threads", "1"]
CURVES = {
    "episode/score",
    "episode/return",
    "episode/length",
    "terms/scoring/goal",
    "terms/scoring/conceded",
}

pytestmark = pytest.mark.filterwarnings("default")


@pytest.fixture
def example(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Imports an example by its name."""
    monkeypatch.syspath_prepend(str(EXAMPLES))
    yield import_module
    for name in ("train_cleanrl", "train_sb3", "plot_training"):
        sys.modules.pop(name, None)


def curves(folder: Path) -> set[str]:
    from tensorboard.backend.event_processing.event_accumulator import EventAccumulator

    return set(EventAccumulator(str(folder)).Reload().Tags()["scalars"])


def test_plain_ppo_scores(example: Any, tmp_path: Path) -> None:
    score = example("train_cleanrl").main([*CLOSE, "--steps", "100000", "--out", str(tmp_path)])
    assert score >= 0.9
    assert curves(tmp_path) >= CURVES
    assert (tmp_path / "policy.pt").is_file()
    pytest.importorskip("onnxruntime")
    suite = setpiece.suite("suite close { academy_empty_goal_close for 20 episodes }")
    assert suite.evaluate(tmp_path / "policy.onnx").rows[0].mean_score.value >= 0.9


def test_plain_ppo_standardises_by_all_that_it_has_seen(example: Any) -> None:
    numbers = np.random.default_rng(1).normal(3, [0.01, 2, 0], (500, 3)).astype(np.float32)
    standard = example("train_cleanrl").Standard(3)
    for part in np.split(numbers, [100, 350]):
        standard.take(torch.from_numpy(part))
    seen = standard(torch.from_numpy(numbers)).numpy()
    assert np.allclose(seen.mean(0), 0, atol=1e-3)
    assert np.allclose(seen.std(0), [1, 1, 0], atol=1e-3)
    assert standard(torch.tensor([[9.0, 3.0, 4.0]])).abs().max() == 10


def test_plain_ppo_on_a_curriculum_until_a_score(
    example: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = (
        "--levels learn_3_vs_1 --envs 16 --repeat 2 --steps 8192 --evaluate-every 1 --until -1"
    )
    example("train_cleanrl").main([*CLOSE, *options.split(), "--out", str(tmp_path)])
    assert " after 2048 steps\n" in capsys.readouterr().out
    assert curves(tmp_path) >= {"episode/score", "evaluation/score"}


def test_plain_ppo_with_masks_and_other_rewards(example: Any, tmp_path: Path) -> None:
    options = [
        "--steps",
        "8192",
        "--masks",
        "--rewards",
        "scoring,checkpoints",
        "--out",
        str(tmp_path),
    ]
    assert -1 <= example("train_cleanrl").main([*CLOSE, *options]) <= 1
    assert curves(tmp_path) >= {*CURVES, "terms/checkpoints/carried", "terms/checkpoints/goal"}


@pytest.mark.parametrize("observation", ["pixels_gray", "smm"])
def test_plain_ppo_sees_pictures(example: Any, tmp_path: Path, observation: str) -> None:
    options = ["--steps", "2048", "--envs", "32", "--observation", observation, "--stack", "2"]
    assert -1 <= example("train_cleanrl").main([*CLOSE, *options, "--out", str(tmp_path)]) <= 1
    assert curves(tmp_path) >= CURVES


@pytest.mark.parametrize("masks", [[], ["--masks"]])
def test_stable_baselines3(example: Any, tmp_path: Path, masks: list[str]) -> None:
    pytest.importorskip("stable_baselines3")
    if masks:
        pytest.importorskip("sb3_contrib")
    score = example("train_sb3").main([*CLOSE, *masks, "--steps", "8192", "--out", str(tmp_path)])
    assert -1 <= score <= 1
    assert curves(tmp_path) >= CURVES
    assert (tmp_path / "policy.zip").is_file()


def test_rllib(tmp_path: Path) -> None:
    pytest.importorskip("ray.rllib")
    # Separate, because Ray's runners import the program's module.
    command = [*CLOSE, "--steps", "4000", "--envs", "8", "--out", str(tmp_path)]
    run = subprocess.run(
        [sys.executable, str(EXAMPLES / "train_rllib.py"), *command],
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert run.returncode == 0, run.stderr
    assert "mean score of 100 episodes: " in run.stdout
    assert curves(tmp_path) >= CURVES
    assert (tmp_path / "policy").is_dir()


def test_the_plot(example: Any, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    example("train_cleanrl").main([*CLOSE, "--steps", "8192", "--out", str(tmp_path)])
    example("plot_training").main([f"close={tmp_path}", "--out", str(tmp_path / "plot.png")])
    assert (tmp_path / "plot.png").is_file()
