"""The example that finds starts where a policy fails."""

from pathlib import Path

import pytest

pytest.importorskip("ribs")
pytest.importorskip("matplotlib")

pytestmark = pytest.mark.filterwarnings("default")

EXAMPLES = Path(__file__).parents[3] / "examples"

# A wall of keepers: whoever runs straight on scores only where the gap is wide.
TEXT = """
scenario gate extends academy {
    param out = 20m in 12m..30m
    param ahead = 8m in 1m..10m
    ball at (54m - out, 0m)
    team left { CF at (53.5m - out, 0m) }
    team right { CB at (54m - out + ahead, 0m) { ai: hold } }
}
"""


def test_it_finds_starts_where_an_agent_scores_less_than_half_its_mean(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.syspath_prepend(str(EXAMPLES))
    import find_failures

    path, picture = tmp_path / "gate.pitch", tmp_path / "archive.png"
    path.write_text(TEXT, encoding="utf-8")
    options = "--policy run_and_shoot --over out ahead --rounds 3 --batch 8 --episodes 4"
    shape = "--cells 5 --worst 4"
    given = ["--scenario", str(path), "--out", str(picture)]
    found = find_failures.main([*given, *options.split(), *shape.split()])
    printed = capsys.readouterr().out
    assert len(found.failures) == 4
    assert [it.score.value for it in found.failures] == sorted(
        it.score.value for it in found.failures
    )
    for failure in found.failures:
        assert f"setpiece render {path} --level '{failure.level}' -o worst.mp4" in printed
        assert failure.level.startswith("gate")
        assert failure.level.endswith("#1000000")
    assert found.is_failure
    assert "the worst is below half the mean" in printed
    assert picture.read_bytes().startswith(b"\x89PNG")
    with pytest.raises(SystemExit):
        find_failures.main(["--scenario", "academy_empty_goal_close", "--over", "a", "difficulty"])
