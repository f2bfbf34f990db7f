"""EnvPool's build of GRF: the same scenarios, one random agent, bots for everyone else."""

from __future__ import annotations

from contests import Contest, native_steps, per_cpu_second


def envpool_steps(scenario: str, seconds: float) -> float:
    """Steps per CPU-second of EnvPool's build of GRF."""
    import envpool
    import numpy as np

    n = 4
    envs = envpool.make(
        f"gfootball/{scenario}-v1", env_type="gymnasium", num_envs=n, num_threads=1, seed=1
    )
    envs.reset()
    random = np.random.default_rng(0)
    return per_cpu_second(lambda: envs.step(random.integers(0, 19, n).astype(np.int32)), n, seconds)


def vector_steps(scenario: str, seconds: float) -> float:
    """Steps per CPU-second of `setpiece.make_vec`, 64 environments, arrays written in place."""
    import numpy as np
    import setpiece

    n = 64
    envs = setpiece.make_vec(scenario, n, threads=1, observation="smm", copy=False, seed=1)
    envs.reset()
    random = np.random.default_rng(0)
    return per_cpu_second(lambda: envs.step(random.integers(0, 19, n)), n, seconds)


GFOOTBALL = Contest(
    title="Google Research Football",
    unit="steps per CPU-second",
    text="One agent at random, bots for everyone else, resets included, the super mini map (72 x 96 x 4 bytes, the\n"
    "only observation that EnvPool's build has) after every step but where it says floats. `setpiece bench` (64\n"
    "matches) begins at different moments of its matches; the others (4 environments of EnvPool's, 64 of make_vec)\n"
    "begin all together, and of a long match play what comes first.",
    packages=("envpool",),
    cases=("11_vs_11_stochastic", "academy_3_vs_1_with_keeper", "academy_empty_goal_close"),
    players={
        "EnvPool's GRF": envpool_steps,
        "setpiece": lambda scenario, seconds: native_steps(scenario, seconds, "smm"),
        "setpiece, floats": lambda scenario, seconds: native_steps(
            scenario, seconds, "simple115v2"
        ),
        "setpiece.make_vec": vector_steps,
    },
)
