"""The learners of baselines/ learn, continue where they were interrupted, and say what is wrong."""

import csv
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
MULTI = "multi_3_vs_1_with_keeper"

pytestmark = pytest.mark.filterwarnings("default")


@pytest.fixture
def baseline(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Imports a file of baselines/ by its name."""
    monkeypatch.syspath_prepend(str(BASELINES))
    yield import_module
    for path in BASELINES.glob("*.py"):
        sys.modules.pop(path.stem, None)


@pytest.fixture
def ppo(baseline: Any) -> Any:
    return baseline("ppo")


@pytest.fixture
def mappo(baseline: Any) -> Any:
    return baseline("mappo")


def test_it_learns(ppo: Any) -> None:
    training = ppo.Training(ppo.Settings(steps=300_000, envs=64))
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
    continues(ppo.Training, chosen, tmp_path)


def test_a_team_continues_bit_for_bit(mappo: Any, tmp_path: Path) -> None:
    chosen = mappo.Settings(scenario=MULTI, steps=16 * 8 * 4 * 12, seed=3, **SMALL)
    continues(mappo.Training, chosen, tmp_path)


def continues(learner: Any, chosen: Any, tmp_path: Path) -> None:
    """Compares a run with one that is continued from a checkpoint."""
    whole, first, second = (learner(chosen) for _ in range(3))
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
    untrained = learner(chosen).policy.state_dict()
    assert not torch.equal(untrained["actor.0.weight"], trained["actor.0.weight"])


def test_every_episode_begins_with_a_decision(ppo: Any) -> None:
    matches = ppo.Matches(ppo.Settings(scenario=THREE, seed=5, envs=8, repeat=7), 1)
    begun = 0
    for _ in range(30):
        matches.decide(np.full((8, 1), setpiece.Action.SHOT))
        for at in np.flatnonzero(matches.began == len(matches.acts)):
            shown, _ = setpiece.make(matches.envs.levels[at]).reset()
            assert np.array_equal(matches.rows[at, 0], shown)
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
    training.rewards = torch.tensor([[1.0, 1.0], [2.0, 2.0], [3.0, 3.0]])[..., None]
    training.ended = torch.tensor([[0.0, 0.0], [1.0, 1.0], [0.0, 0.0]])[..., None]
    training.rest = torch.tensor([[0.0, 0.0], [0.0, 4.0], [0.0, 0.0]])[..., None]
    values, after = torch.ones(3, 2, 1), torch.tensor([[8.0], [8.0]])
    # Backwards: 3 + 0.5 * 8 - 1 = 6; 2 - 1 and 2 + 0.5 * 4 - 1; 1 + 0.5 * 1 - 1 + 0.25 * later.
    wanted = [[0.75, 1.25], [1.0, 3.0], [6.0, 6.0]]
    assert training.advantages(values, after)[..., 0].tolist() == wanted


def test_numbers_are_standardised_by_all_that_was_seen(baseline: Any) -> None:
    numbers = np.random.default_rng(1).normal(3, [0.1, 2, 0], (500, 3)).astype(np.float32)
    running = baseline("networks").Running(3, least=0.01)
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
def test_the_interval_of_a_score(baseline: Any, scores: list[int], low: float, high: float) -> None:
    found = baseline("measure").estimate(np.array(scores))
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
    rows = training.matches.rows[:, 0]
    (logits,) = session.run(None, {"observation": rows})
    assert np.allclose(logits, training.policy(torch.from_numpy(rows)).detach(), atol=1e-4)
    # What is done isn't trained again.
    again = ppo.main(options)
    assert again["curve"] == found["curve"]
    assert again["drawn"] == found["drawn"]


def test_a_policy_of_pictures_is_exported_for_any_number_of_them(ppo: Any, tmp_path: Path) -> None:
    pytest.importorskip("onnx")
    pytest.importorskip("onnxruntime")
    training = ppo.Training(ppo.Settings(observation="smm", stack=2, **SMALL))
    rows = training.matches.rows
    training.policy.export(tmp_path / "policy.onnx", rows[:, 0], None, training.settings)
    policy = setpiece.onnx_policy(tmp_path / "policy.onnx")
    assert policy.repeat == 4
    for number in (1, 7):
        assert (policy(rows[:number, 0]) == training.choose(rows)[:number, 0]).all()


@pytest.mark.parametrize(
    ("options", "why"),
    [
        (["--scenario", "academy_3_vs_1"], "academy_3_vs_1_with_keeper"),
        (["--observation", "simple"], "did you mean `simple115`?"),
        (["--rewards", "scorin"], "scoring"),
        (["--stepss", "5"], "--stepss"),
        (["--repeat", "0"], "repeat"),
        (["--players", "-1"], "players"),
        (["--evaluate", "academi"], "did you mean `academy`?"),
        (["--evaluate", "academy", "--every", "0"], "every"),
        (["--video-every", "-2"], "video-every"),
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


def test_a_team_learns(mappo: Any) -> None:
    """Two players: the score of a policy that has learnt nothing is about 0.05."""
    settings = mappo.Settings(
        scenario="multi_pass_and_shoot_with_keeper", steps=1_000_000, seed=100
    )
    training = mappo.Training(settings)
    assert training.agents == 2
    before = training.evaluate(100, drawn=False).mean()
    training.run()
    assert training.evaluate(100, drawn=False).mean() > before + 0.1
    assert training.curve[-1]["score"] > training.curve[0]["score"] + 0.1


def test_the_value_of_a_player_depends_on_what_the_others_see(ppo: Any, mappo: Any) -> None:
    seen = torch.rand(5, 3, 115)
    other = seen.clone()
    other[:, 2] = torch.rand(5, 115)
    plain = {"observation": "simple115v2", "masks": False, **SMALL}
    alone, team = (
        learner(chosen(scenario=MULTI, players=3, **plain)).policy
        for learner, chosen in (
            (ppo.Training, ppo.Settings),
            (mappo.Training, mappo.Settings),
        )
    )
    for policy, depends in ((alone, False), (team, True)):
        changed = policy.values(seen) != policy.values(other)
        assert changed.shape == (5, 3)
        assert changed[:, 2].all()
        assert changed[:, 0].all().item() is depends
        # Actions depend on what the player sees themselves.
        assert torch.equal(policy(seen)[:, 0], policy(other)[:, 0])
        assert torch.allclose(policy(seen)[:, 0], policy(seen[:, 0]), atol=1e-6)


SUITE = """
suite both {
    academy_empty_goal_close for 10 episodes
    academy_3_vs_1_with_keeper for 5 episodes seed 3
}
"""


def test_what_is_watched_changes_nothing(ppo: Any, baseline: Any, tmp_path: Path) -> None:
    pytest.importorskip("tensorboard")
    file = tmp_path / "both.pitch"
    file.write_text(SUITE, encoding="utf-8")
    settings = ppo.Settings(steps=16 * 8 * 4 * 10, **SMALL)
    watch = baseline("watch").Watch(settings, tmp_path, suite=str(file), every=4, video_every=6)
    plain, first, second = (ppo.Training(settings) for _ in range(3))
    plain.run()
    first.run(tmp_path, until=5, watch=watch)
    first.save(tmp_path / "checkpoint.pt")
    second.load(tmp_path / "checkpoint.pt")
    second.run(tmp_path, watch=watch)
    for name, value in second.policy.state_dict().items():
        assert torch.equal(value, plain.policy.state_dict()[name]), name
    # Both entries after the updates 4, 8 and 10, the last.
    wanted = [steps for update in (4, 8, 10) for steps in [update * 512] * 2]
    assert [row["steps"] for row in second.tables] == wanted
    with (tmp_path / "suites.csv").open(encoding="utf-8") as lines:
        rows = [*csv.DictReader(lines)]
    assert [int(row["steps"]) for row in rows] == wanted
    assert rows[1]["entry"] == "academy_3_vs_1_with_keeper"
    assert all(float(row["mean_score_low"]) <= float(row["mean_score"]) for row in rows)
    videos = tmp_path / "videos"
    assert sorted(path.name for path in videos.glob("*.mp4")) == ["000003072.mp4", "000005120.mp4"]
    assert all(path.read_bytes()[4:8] == b"ftyp" for path in videos.glob("*.mp4"))
    for path in videos.glob("*.pitchr"):
        recorded = setpiece.Replay(path)
        assert (recorded.seed, recorded.index) == (baseline("measure").EVALUATION_SEED, 0)


@pytest.mark.parametrize("masks", ["--masks", "--no-masks"])
def test_a_suite_is_played_as_its_policy_s_file_plays_it(
    mappo: Any, tmp_path: Path, masks: str
) -> None:
    pytest.importorskip("onnx")
    pytest.importorskip("onnxruntime")
    suite = f"suite three {{ {MULTI} for 20 episodes }}"
    options = f"--scenario {MULTI} --steps 4096 --envs 16 --decisions 8 --episodes 10".split()
    watched = ["--evaluate", suite, "--every", "3", "--video-every", "8"]
    mappo.main([*options, masks, *watched, "--out", str(tmp_path)])
    assert (tmp_path / "videos" / "000004096.mp4").is_file()
    table = setpiece.evaluate(tmp_path / "policy.onnx", suite, observation="simple115v2+sticky")
    assert setpiece.onnx_policy(tmp_path / "policy.onnx").masks is (masks == "--masks")
    with (tmp_path / "suites.csv").open(encoding="utf-8") as lines:
        last = [*csv.DictReader(lines)][-1]
    assert last["digest"] == table.rows[0].digest
    assert float(last["mean_return"]) == table.rows[0].mean_return.value


def test_every_term_of_the_reward_has_a_curve(ppo: Any, tmp_path: Path) -> None:
    pytest.importorskip("tensorboard")
    from tensorboard.backend.event_processing.event_accumulator import EventAccumulator

    training = ppo.Training(ppo.Settings(scenario=THREE, steps=60_000))
    training.run(tmp_path)
    log = EventAccumulator(str(tmp_path)).Reload()
    terms = {
        f"terms/{name}"
        for name in setpiece.make_vec(THREE, rewards="scoring,checkpoints").reset()[1][
            "reward_terms"
        ]
    }
    assert len(terms) >= 3
    assert {*log.Tags()["scalars"]} >= terms | {"score", "length", "entropy", "value_loss"}
    paid = [point.value for point in log.Scalars("terms/checkpoints/carried")]
    assert max(paid) > 0
    scored, conceded = (
        [point.value for point in log.Scalars(f"terms/scoring/{name}")]
        for name in ("goal", "conceded")
    )
    scores = [point.value for point in log.Scalars("score")]
    assert np.allclose(np.array(scored) + conceded, scores, atol=1e-5)
