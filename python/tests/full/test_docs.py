"""The examples of docs/python.md that need heavy packages also run."""

from typing import Any

import pytest
from pages import examples

pytest.importorskip("stable_baselines3")
pytest.importorskip("ray")
pytest.importorskip("syllabus")

pytestmark = pytest.mark.filterwarnings("default")


def test_every_example_with_heavy_packages_runs() -> None:
    names: dict[str, Any] = {}
    blocks = examples("python.md", heavy=True)
    for block in blocks:
        exec(compile(block, "python.md", "exec"), names)
    assert len(blocks) == 4
    assert names["model"].num_timesteps == 512
    assert names["config"].env_config["scenario"] == "academy_corner"
