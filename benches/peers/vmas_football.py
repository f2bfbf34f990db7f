"""VMAS's football: teams of one size, one side random, the other its built-in opponent."""

from __future__ import annotations

import tempfile
from pathlib import Path

from contests import Contest, native_steps, per_cpu_second

# VMAS is made for many environments at once; more than this don't make it faster on a processor.
ENVIRONMENTS = 256


def vmas_steps(case: str, seconds: float) -> float:
    """Steps per CPU-second of VMAS's football on one thread."""
    import torch
    import vmas

    torch.set_num_threads(1)
    n = int(case.split()[0])
    env = vmas.make_env(
        "football", ENVIRONMENTS, n_blue_agents=n, n_red_agents=n, ai_red_agents=True, max_steps=400
    )
    env.reset()

    def step() -> None:
        _, _, done, _ = env.step([env.get_random_action(agent) for agent in env.agents])
        for index in torch.nonzero(done).flatten().tolist():
            env.reset_at(index)

    return per_cpu_second(step, ENVIRONMENTS, seconds)


def pitch(n: int) -> str:
    """A match of n a side: every left player an agent, bots on the right."""
    rows = [
        f"        CM at (-{0.1 + 0.2 * (i % 4):.1f}, {0.3 * (i // 4 - 1):.1f})"
        for i in range(n - 1)
    ]
    team = "\n".join(["        GK at (-1, 0)", *rows])
    mirrored = team.replace("(-", "(")
    return f"""scenario {"abcdefghijk"[n - 1]}_side {{
    agents {{ left: all }}
    ball at (0, 0)
    team left {{
{team}
    }}
    team right {{
{mirrored}
    }}
    end limit 400 steps
}}
"""


def our_steps(case: str, seconds: float) -> float:
    """Steps of a match per CPU-second of the same by `setpiece bench`."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "match.pitch"
        path.write_text(pitch(int(case.split()[0])), encoding="utf-8")
        return native_steps(str(path), seconds, "simple115v2")


VMAS = Contest(
    title="VMAS football",
    unit="steps of a match per CPU-second",
    text="Every player of one side at random, the other side the built-in opponent, episodes of 400 steps of 0.1 s,\n"
    "floats for every agent. "
    f"VMAS moves discs in the plane, {ENVIRONMENTS} matches at once; ours plays football's rules.",
    packages=("vmas", "torch"),
    cases=("3 a side", "11 a side"),
    players={"VMAS": vmas_steps, "setpiece": our_steps},
)
