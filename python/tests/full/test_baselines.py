"""baselines/ppo.py learns, continues where it was interrupted, and says what is wrong."""

import json
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import setpiece

torch = pytest.importorskip("torch")

BASELINES = Path(__file__).parents[3] / "baselines"
SMALL = {"envs": 16, "decisions": 8, "minibatch": 64}
THREE = "academy_3_vs_1_with_keeper"

pytestmark = pytest.mark.filterwarnings("default")


@pytest.fixture
def ppo(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(BASELINES))
    yield import_module("ppo")
    for name in ("ppo", "run", "runs"):
        sys.modules.pop(name, None)


def test_it_learns(ppo: Any) -> None:
    training = ppo.Training(ppo.Settings(steps=200_000, envs=64))
    before = training.evaluate(100, drawn=True).mean()
    training.run()
    assert before < 0.6
    assert training.evaluate(100, drawn=True).mean() > 0.8
    assert training.evaluate(100, drawn=False).mean() > 0.9
    assert training.curve[-1]["score"] > training.curve[0]["score"] + 0.3
    assert training.curve[-1]["entropy"] < training.curve[0]["entropy"]
    assert training.curve[-1]["steps"] == training.updates * training.steps_of_update


@pytest.mark.parametrize(
    "settings",
    [
        {"repeat": 4},
        {"players": 3, "masks": True, "observation": "simple115v2+sticky", "repeat": 1},
        {"observation": "smm", "stack": 2, "repeat": 3},
    ],
    ids=["one player", "three players", "maps"],
)
def test_it_continues_bit_for_bit(ppo: Any, tmp_path: Path, settings: dict[str, Any]) -> None:
    chosen = ppo.Settings(scenario=THREE, steps=16 * 8 * 4 * 12, seed=3, **SMALL, **settings)
    whole, first, second = (ppo.Training(chosen) for _ in range(3))
    whole.run(until=12)
    first.run(until=5)
    assert any(":" in level.rpartition("#")[2] for level in first.matches.envs.levels)
    assert len(set(first.matches.began)) > 1
    first.save(tmp_path / "checkpoint.pt")
    second.load(tmp_path / "checkpoint.pt")
    assert np.array_equal(first.matches.rows, second.matches.rows)
    assert np.array_equal(first.matches.masks, second.matches.masks)
    second.run(until=12)
    assert second.update == whole.update
    assert second.curve == whole.curve
    assert len(whole.curve) > 1
    trained = whole.policy.state_dict()
    for name, value in second.policy.state_dict().items():
        assert torch.equal(value, trained[name]), name
    untrained = ppo.Training(chosen).policy.state_dict()
    assert not torch.equal(untrained["actor.0.weight"], trained["actor.0.weight"])


def test_every_episode_begins_with_a_decision(ppo: Any) -> None:
    matches = ppo.Matches(ppo.Settings(scenario=THREE, seed=5, envs=8, repeat=7), 1)
    begun = 0
    for _ in range(30):
        matches.decide(np.full(8, setpiece.Action.SHOT))
        for at in np.flatnonzero(matches.began == len(matches.acts)):
            shown, _ = setpiece.make(matches.envs.levels[at]).reset()
            assert np.array_equal(matches.rows[at, :115], shown)
            begun += 1
    assert begun >= 8


CURRICULUM = """
curriculum course {
    stage near = academy_empty_goal_close until episodes > 15
    stage far = academy_empty_goal
}
"""


def test_it_trains_on_a_curriculum_and_checks_the_scenario(ppo: Any, tmp_path: Path) -> None:
    file = tmp_path / "course.pitch"
    file.write_text(CURRICULUM, encoding="utf-8")
    settings = ppo.Settings(
        "academy_empty_goal", str(file), steps=16 * 8 * 4 * 12, check=1024, **SMALL
    )
    first, second = (ppo.Training(settings) for _ in range(2))
    first.run(until=8)
    assert any(level.startswith("academy_empty_goal{") for level in first.matches.envs.levels)
    assert [check["steps"] for check in first.checks] == [1024, 2048, 3072, 4096]
    assert first.checks[0]["stage"] == "near"
    assert first.checks[-1]["stage"] == "far"
    first.save(tmp_path / "checkpoint.pt")
    second.load(tmp_path / "checkpoint.pt")
    assert second.matches.envs.levels == first.matches.envs.levels
    assert second.matches.stage() == first.matches.stage()
    assert np.array_equal(first.matches.rows, second.matches.rows)
    assert second.checks == first.checks


def test_a_decision_is_credited_with_what_comes_after_it(ppo: Any) -> None:
    """Three decisions; an episode ends with the second in the first environment.

    In the second environment a time limit ends it, and the rest is worth 4.
    """
    training = ppo.Training(
        ppo.Settings(envs=2, decisions=3, gamma=0.5, smoothing=0.5, steps=1, minibatch=8)
    )
    training.rewards = torch.tensor([[1.0, 1.0], [2.0, 2.0], [3.0, 3.0]])
    training.ended = torch.tensor([[0.0, 0.0], [1.0, 1.0], [0.0, 0.0]])
    training.rest = torch.tensor([[0.0, 0.0], [0.0, 4.0], [0.0, 0.0]])
    values, after = torch.ones(3, 2), torch.tensor([8.0, 8.0])
    # Backwards: 3 + 0.5 * 8 - 1 = 6; 2 - 1 and 2 + 0.5 * 4 - 1; 1 + 0.5 * 1 - 1 + 0.25 * later.
    wanted = [[0.75, 1.25], [1.0, 3.0], [6.0, 6.0]]
    assert training.advantages(values, after).tolist() == wanted


def test_numbers_are_standardised_by_all_that_was_seen(ppo: Any) -> None:
    numbers = np.random.default_rng(1).normal(3, [0.1, 2, 0], (500, 3)).astype(np.float32)
    running = ppo.Running(3, least=0.01)
    for part in np.split(numbers, [100, 350]):
        running.take(torch.from_numpy(part))
    seen = running(torch.from_numpy(numbers)).numpy()
    assert np.allclose(seen.mean(0), 0, atol=1e-3)
    assert np.allclose(seen.std(0), [1, 1, 0], atol=1e-3)
    assert running(torch.tensor([[9.0, 3.0, 4.0]])).abs().max() == 10
    for _ in range(50):
        running.take(torch.full((100, 3), 7.0), memory=200)
    assert torch.allclose(running.mean, torch.full((3,), 7.0))


@pytest.mark.parametrize(
    ("scores", "low", "high"),
    [
        ([1] * 480 + [0] * 20, 0.939, 0.974),
        ([1] * 500, 0.992, 1.0),
        ([2] * 250 + [-2] * 250, -0.175, 0.175),
    ],
)
def test_the_interval_of_a_score(ppo: Any, scores: list[int], low: float, high: float) -> None:
    found = ppo.estimate(np.array(scores))
    assert found["mean"] == pytest.approx(np.mean(scores))
    assert (found["low"], found["high"]) == pytest.approx((low, high), abs=1e-3)


def test_the_command(ppo: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("onnx")
    runtime = pytest.importorskip("onnxruntime")
    options = f"--steps 2048 --envs 16 --decisions 8 --episodes 20 --out {tmp_path}".split()
    found = ppo.main(options)
    assert "steps per CPU second (acting" in capsys.readouterr().out
    assert json.loads((tmp_path / "result.json").read_text(encoding="utf-8")) == found
    assert found["steps"] == 2048
    # Seconds are rounded to tenths, and the command took some.
    assert {"acting", "environment", "learning", "wall"} == {*found["seconds"]}
    session = runtime.InferenceSession(tmp_path / "policy.onnx")
    training = ppo.Training(ppo.Settings(steps=2048, envs=16, decisions=8))
    training.load(tmp_path / "checkpoint.pt")
    rows = training.matches.rows
    (logits,) = session.run(None, {"observation": rows})
    assert np.allclose(logits, training.policy(torch.from_numpy(rows)).detach(), atol=1e-4)
    # What is done isn't trained again.
    again = ppo.main(options)
    assert again["curve"] == found["curve"]
    assert again["drawn"] == found["drawn"]


@pytest.mark.parametrize(
    ("options", "why"),
    [
        (["--scenario", "academy_3_vs_1"], "academy_3_vs_1_with_keeper"),
        (["--observation", "simple"], "did you mean `simple115`?"),
        (["--rewards", "scorin"], "scoring"),
        (["--stepss", "5"], "--stepss"),
        (["--repeat", "0"], "repeat"),
    ],
)
def test_a_mistake_is_explained(
    ppo: Any,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    options: list[str],
    why: str,
) -> None:
    with pytest.raises(SystemExit):
        ppo.main([*options, "--out", str(tmp_path / "mine")])
    said = capsys.readouterr().err
    assert "error: " in said
    assert why in said.splitlines()[-1]


def test_a_checkpoint_of_other_settings_is_refused(
    ppo: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = ppo.Settings(**SMALL, steps=512)
    ppo.Training(settings).save(tmp_path / "checkpoint.pt")
    with pytest.raises(SystemExit):
        ppo.main(["--steps", "512", "--seed", "7", "--out", str(tmp_path)])
    assert "other settings (seed 0, envs 16" in capsys.readouterr().err
