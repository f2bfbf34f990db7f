import os
import time
import warnings
from collections.abc import Callable
from pathlib import Path

import gymnasium
import pytest

import setpiece

SHOT = """scenario shot extends academy {
    ball at (0.6, 0)
    team left { CM at (0.5, 0) }
    end limit LIMIT steps
}
"""


def save(path: Path, text: str) -> None:
    """Saves like editors do: a new file replaces the old one."""
    fresh = path.with_suffix(".tmp")
    fresh.write_text(text, encoding="utf-8")
    fresh.replace(path)


def wait_for_reload(env: setpiece.FootballEnv, before: setpiece.Reload | None) -> setpiece.Reload:
    """Resets until the change has been noticed."""
    end = time.monotonic() + 20
    while time.monotonic() < end:
        env.reset()
        if env.last_reload is not None and env.last_reload is not before:
            return env.last_reload
        time.sleep(0.02)
    raise AssertionError("the change was never noticed")


def length(env: setpiece.FootballEnv) -> int:
    env.reset()
    for steps in range(1, 1000):
        _, _, terminated, truncated, info = env.step(setpiece.Action.IDLE)
        if terminated or truncated:
            assert info["setpiece"]["scenario"] == env.scenario.digest
            return steps
    raise AssertionError("the episode has no end")


def test_a_watched_file_takes_effect_at_the_next_reset(pitch_file: Callable[[str], Path]) -> None:
    path = pitch_file(SHOT.replace("LIMIT", "5"))
    reloads: list[setpiece.Reload] = []
    env = setpiece.make(path, watch=True, on_reload=reloads.append)
    _, info = env.reset(seed=1)
    first = info["scenario"]
    assert first == env.scenario.digest
    assert env.last_reload is None
    save(path, SHOT.replace("LIMIT", "7"))
    assert wait_for_reload(env, None).state == "applied"
    assert length(env) == 7
    assert env.scenario.digest != first
    # A broken file leaves the last good scenario in place.
    save(path, SHOT.replace("LIMIT", "7").replace("CM at", "CMM at"))
    broken = wait_for_reload(env, env.last_reload)
    assert broken.state == "broken"
    assert isinstance(broken.error, setpiece.CompileError)
    assert length(env) == 7
    # A change of the agents is held back.
    save(
        path,
        SHOT.replace("LIMIT", "7").replace("CM at (0.5, 0)", "CM at (0.5, 0)  CFF at (0.4, 0)"),
    )
    assert wait_for_reload(env, broken).state == "broken"
    two = SHOT.replace("LIMIT", "9").replace(
        "CM at (0.5, 0) }", "CM at (0.5, 0)  CF at (0.4, 0) }\n    agents { left: all }"
    )
    save(path, two)
    held = wait_for_reload(env, env.last_reload)
    assert held.state == "held back"
    assert "agents" in held.why
    assert length(env) == 7
    save(path, SHOT.replace("LIMIT", "11"))
    wait_for_reload(env, held)
    assert length(env) == 11
    assert [reload.state for reload in reloads] == [
        "applied",
        "broken",
        "broken",
        "held back",
        "applied",
    ]


def test_a_file_that_is_deleted_and_comes_back_is_taken(pitch_file: Callable[[str], Path]) -> None:
    path = pitch_file(SHOT.replace("LIMIT", "5"))
    env = setpiece.make(path, watch=True)
    path.unlink()
    time.sleep(0.2)
    assert length(env) == 5
    save(path, SHOT.replace("LIMIT", "6"))
    assert wait_for_reload(env, env.last_reload).state == "applied"
    assert length(env) == 6


def test_a_file_that_is_gone_is_reported_once_and_when_it_is_back(
    pitch_file: Callable[[str], Path],
) -> None:
    path = pitch_file(SHOT.replace("LIMIT", "5"))
    env = setpiece.make(path, watch=True)

    def warned_of(text: str) -> bool:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            env.reset()
        assert len(caught) <= 1
        return any(str(path) in str(one.message) and text in str(one.message) for one in caught)

    def wait_for_warning(text: str) -> None:
        end = time.monotonic() + 20
        while not warned_of(text):
            assert time.monotonic() < end, f"nothing said that the file {text}"
            time.sleep(0.02)

    path.unlink()
    wait_for_warning("is gone")
    assert not any(warned_of("is gone") for _ in range(50))
    assert length(env) == 5
    # It is back as it was: there is nothing to reload.
    save(path, SHOT.replace("LIMIT", "5"))
    wait_for_warning("is back")
    assert length(env) == 5
    path.unlink()
    wait_for_warning("is gone")


def test_only_files_can_be_watched() -> None:
    with pytest.raises(setpiece.ParameterError, match="nothing to watch"):
        setpiece.make("academy_corner", watch=True)
    with pytest.raises(setpiece.ParameterError, match="give its path"):
        setpiece.make(setpiece.load("academy_corner"), watch=True)


def scripted(pay: str, limit: int = 400) -> str:
    return f"""
        scenario followed extends academy {{
            ball at (0.5, 0)
            team left {{ GK  CM at (0.4, 0) }}
            reward script rhai \"\"\"
                fn reward(ctx, now, prev, events) {{ this.n = (this.n ?? 0) + 1; {pay} }}
            \"\"\"
            end limit {limit} steps
        }}
    """


def step_until(env: setpiece.FootballEnv, noticed: Callable[[], bool]) -> float:
    """Steps until a change has been noticed; returns the last reward."""
    for _ in range(600):
        reward = env.step(0)[1]
        if noticed():
            return float(reward)
        time.sleep(0.01)
    raise AssertionError("the change was never noticed")


def test_scripts_are_taken_over_at_once_if_asked(pitch_file: Callable[[str], Path]) -> None:
    path = pitch_file(scripted("1.0"))
    env = setpiece.make(path, watch="now")
    first = env.reset(seed=1)[1]["scenario"]
    assert env.step(0)[1] == 1.0
    # Only the script has changed: it keeps its memory, in this episode.
    path.write_text(scripted("100.0 + this.n"))
    assert step_until(env, lambda: env.last_reload is not None) > 101.0
    assert env.last_reload is not None
    assert env.last_reload.state == "applied"
    assert env.scenario.digest != first
    with pytest.raises(setpiece.ReplayError, match="changed scripts"):
        env.save_replay(path.with_suffix(".pitchr"))
    # A broken script is reported at once, and the last good one stays in use.
    path.write_text(scripted("100.0 +"))
    with pytest.warns(UserWarning, match="the changed file is broken") as warned:
        paid = step_until(
            env, lambda: env.last_reload is not None and env.last_reload.state == "broken"
        )
    assert paid > 101.0
    # The next step would raise a second warning.
    assert env.step(0)[1] > 101.0
    assert len(warned) == 1
    # Any other change waits for the next episode.
    path.write_text(scripted("5.0", limit=7))
    for _ in range(30):
        assert env.step(0)[1] > 101.0
        time.sleep(0.01)
    env.reset()
    assert env.last_reload.state == "applied"
    assert env.step(0)[1] == 5.0
    with pytest.raises(setpiece.ParameterError, match="'soon'"):
        setpiece.make(path, watch="soon")  # type: ignore[arg-type]


def test_an_on_reload_that_fails_is_reported_and_loses_nothing(
    pitch_file: Callable[[str], Path],
) -> None:
    path = pitch_file(SHOT.replace("LIMIT", "5"))
    reloads: list[setpiece.Reload] = []

    def fails(reload: setpiece.Reload) -> None:
        reloads.append(reload)
        raise ValueError("a full disk")

    env = setpiece.make(path, watch=True, on_reload=fails)
    env.reset(seed=1)
    save(path, SHOT.replace("LIMIT", "7"))
    with pytest.raises(setpiece.CallbackError, match="`fails` failed: ValueError: a full disk"):
        wait_for_reload(env, None)
    assert [reload.state for reload in reloads] == ["applied"]
    assert length(env) == 7


def test_an_on_reload_that_fails_in_a_step_ends_the_episode(
    pitch_file: Callable[[str], Path],
) -> None:
    def fails(_reload: setpiece.Reload) -> None:
        raise ValueError("a full disk")

    path = pitch_file(scripted("1.0"))
    env = setpiece.make(path, watch="now", on_reload=fails)
    env.reset(seed=1)
    path.write_text(scripted("2.0"))
    with pytest.raises(setpiece.CallbackError, match="a full disk"):
        step_until(env, lambda: False)
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)
    env.reset()
    assert env.step(0)[1] == 2.0, "the change has been taken over"


def test_an_on_reload_can_not_play_the_environment_that_tells_it(
    pitch_file: Callable[[str], Path],
) -> None:
    path = pitch_file(SHOT.replace("LIMIT", "5"))
    env = setpiece.make(path, watch=True, on_reload=lambda _: env.reset())
    env.reset(seed=1)
    save(path, SHOT.replace("LIMIT", "7"))
    with pytest.raises(setpiece.CallbackError, match="InUseError"):
        wait_for_reload(env, None)
    assert length(env) == 7


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="counts what Linux lists in /proc")
def test_a_watching_environment_holds_neither_threads_nor_files(tmp_path: Path) -> None:
    def held() -> tuple[int, int]:
        return len(os.listdir("/proc/self/task")), len(os.listdir("/proc/self/fd"))  # noqa: PTH208

    path = tmp_path / "s.pitch"
    path.write_text("scenario s extends academy { ball at (0, 0) team left { CM at (0.1, 0) } }\n")
    before = held()
    env = setpiece.make(path, watch="now")
    env.reset(seed=1)
    for _ in range(3):
        env.step(0)
    assert held() == before
    env.close()
    assert held() == before


def test_a_module_of_a_script_is_watched(tmp_path: Path) -> None:
    hook = 'import "lib" as lib;\nfn reward(ctx, now, prev, events) { lib::pay() }'
    (tmp_path / "hook.rhai").write_text(hook, encoding="utf-8")
    save(tmp_path / "lib.rhai", "fn pay() { 1 }")
    text = SHOT.replace("LIMIT", "50").replace(
        "end limit", 'reward script "hook.rhai"\n    end limit'
    )
    path = tmp_path / "s.pitch"
    path.write_text(text, encoding="utf-8")
    env = setpiece.make(path, watch=True)
    env.reset(seed=1)
    assert env.step(0)[4]["reward_terms"]["hook/script"] == 1.0
    save(tmp_path / "lib.rhai", "fn pay() { #{step: 3, side: 0.5} }")
    save(path, text.replace('"hook.rhai"', '"hook.rhai" as ["step", "side"]'))
    assert wait_for_reload(env, None).state == "applied"
    terms = env.step(0)[4]["reward_terms"]
    assert (terms["hook/step"], terms["hook/side"]) == (3.0, 0.5)
    save(tmp_path / "lib.rhai", "fn pay() { #{step: 4, side: 0.5} }")
    assert wait_for_reload(env, env.last_reload).state == "applied"
    assert env.step(0)[4]["reward_terms"]["hook/step"] == 4.0


def test_what_a_script_prints_is_logged(
    pitch_file: Callable[[str], Path], caplog: pytest.LogCaptureFixture
) -> None:
    env = setpiece.make(pitch_file(scripted('print(this.n); debug("x"); 1.0')))
    env.reset(seed=1)
    with caplog.at_level("DEBUG", logger="setpiece.script"):
        env.step(0)
    printed = [record for record in caplog.records if record.name == "setpiece.script"]
    assert [record.levelname for record in printed] == ["INFO", "DEBUG"]
    assert printed[0].getMessage().endswith(": 1")
    assert printed[1].getMessage().endswith(': "x"')
