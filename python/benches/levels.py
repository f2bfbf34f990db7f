"""What levels cost: `python python/benches/levels.py`.

Two vectors of 4096 environments play three against one, in turn, so that other load on the machine
affects both equally. One has no source of levels. The other has a curriculum of three stages, whose
scenarios differ only in name, with a fifth of the episodes from earlier stages. Both play the same
football, so the ratio of their times is the cost of choosing levels, changing scenarios and
measuring results. The goal is at most 1.03.
"""

import time

import numpy as np

import setpiece

COURSE = """
scenario first extends academy_3_vs_1_with_keeper {
    param value = 0.5 in 0..1
    end limit 40 steps
}
scenario second extends first {}
curriculum course {
    stage one = first until success_rate(last: 200) > 99% or episodes >= 2000
    stage two = second(value: 0.7) until episodes >= 2000
    stage three = first(value: v) adapt v from 0 to 1 keeping success_rate(last: 200) in 20%..70%
    mix current: 80%, earlier: 20%
}
scenario last extends first {}
"""

ENVS, STEPS, ROUNDS = 4096, 20, 12


def main() -> None:
    """Measures and prints."""
    actions = np.full(ENVS, setpiece.Action.RIGHT)
    vectors = {
        "without": setpiece.make_vec(COURSE, ENVS, seed=1, copy=False),
        "curriculum": setpiece.make_vec(COURSE, ENVS, seed=1, copy=False, levels="course"),
    }
    seconds: dict[str, list[float]] = {name: [] for name in vectors}
    ended = dict.fromkeys(vectors, 0)
    for envs in vectors.values():
        envs.reset()
    for _ in range(ROUNDS):
        for name, envs in vectors.items():
            begun = time.perf_counter()
            for _ in range(STEPS):
                _, _, terminated, truncated, _ = envs.step(actions)
                ended[name] += int((terminated | truncated).sum())
            seconds[name].append(time.perf_counter() - begun)
    for name, times in seconds.items():
        each = sum(times) / (ENVS * STEPS * ROUNDS) * 1e6
        print(f"{name:10}  {each:6.3f} µs a step and match, {ended[name]} episodes")
    ratios = np.array(seconds["curriculum"]) / np.array(seconds["without"])
    print(f"ratio       {sum(seconds['curriculum']) / sum(seconds['without']):.3f}", end="")
    print(f" (of the rounds: {np.round(np.sort(ratios), 3)})")
    source = vectors["curriculum"].level_source
    print(f"curriculum  {source}")


if __name__ == "__main__":
    main()
