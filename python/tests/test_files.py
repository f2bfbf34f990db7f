"""Files of every kind: unreadable ones are rejected at once, written ones are complete."""

import os
import resource
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

import setpiece

PITCH = "scenario {name} extends academy {{ ball at (0.6, 0) team left {{ CM at (0.5, 0) }} }}\n"

pytestmark = pytest.mark.skipif(
    sys.platform == "win32", reason="pipes, limits and bytes of paths are Unix's"
)


@contextmanager
def small_disk(most: int) -> Iterator[None]:
    """Writing fails beyond this many bytes of a file, as on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def played(env: setpiece.FootballEnv, seed: int = 1) -> dict[str, Any]:
    env.reset(seed=seed)
    while True:
        *_, terminated, truncated, info = env.step(0)
        if terminated or truncated:
            return info


def test_a_pipe_is_refused_wherever_a_file_is_read(
    tmp_path: Path, pitch_file: Callable[[str], Path]
) -> None:
    pipe = tmp_path / "pipe.pitch"
    os.mkfifo(pipe)
    env = setpiece.make(pitch_file(PITCH.format(name="mine")))
    env.reset(seed=1)
    reading: list[Callable[[], Any]] = [
        lambda: setpiece.load(pipe),
        lambda: setpiece.make(pipe, watch=True),
        lambda: setpiece.Replay(pipe),
        lambda: setpiece.load("/dev/zero"),
    ]
    for read in reading:
        with pytest.raises(setpiece.FileError, match="is not a regular file") as caught:
            read()
        assert caught.value.code == "SP0017"
    for line in (
        'import "pipe.pitch"\n' + PITCH,
        PITCH.replace("}} }}", '}} reward script "pipe.pitch" }}'),
    ):
        file = pitch_file(line.format(name="mine"))
        with pytest.raises(setpiece.CompileError) as broken:
            setpiece.load(file)
        assert "is not a regular file" in broken.value.diagnostics[0].message


def test_a_watched_file_that_becomes_a_pipe_keeps_the_last_scenario(
    pitch_file: Callable[[str], Path],
) -> None:
    from time import sleep

    file = pitch_file(PITCH.format(name="mine"))
    env = setpiece.make(file, watch=True)
    env.reset(seed=1)
    file.unlink()
    os.mkfifo(file)
    sleep(0.1)
    with pytest.warns(UserWarning, match="not a regular file"):
        env.reset(seed=1)
    assert env.last_reload is not None
    assert env.last_reload.state == "broken"
    assert isinstance(env.last_reload.error, setpiece.FileError)


def test_a_watch_holds_neither_threads_nor_files(pitch_file: Callable[[str], Path]) -> None:
    def held() -> tuple[int, int]:
        return len([*Path("/proc/self/fd").iterdir()]), len([*Path("/proc/self/task").iterdir()])

    if not Path("/proc/self/task").exists():
        pytest.skip("open descriptors are listed in /proc, which only Linux has")
    before = held()
    envs = [setpiece.make(pitch_file(PITCH.format(name="mine")), watch=True) for _ in range(3)]
    assert held() == before
    for env in envs:
        env.close()
    assert held() == before


def test_a_replay_that_does_not_fit_leaves_the_earlier_one(tmp_path: Path) -> None:
    env = setpiece.make("academy_empty_goal_close")
    env.reset(seed=1)
    path = tmp_path / "kept.pitchr"
    env.save_replay(path)
    before = path.read_bytes()
    env.step(0)
    with (
        small_disk(100),
        pytest.raises(setpiece.FileError, match=r"kept\.pitchr` can't be written"),
    ):
        env.save_replay(path)
    assert path.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["kept.pitchr"]
    env.save_replay(path)
    assert setpiece.Replay(path).length == 1


def test_recording_on_a_full_disk_raises_once_and_leaves_nothing(tmp_path: Path) -> None:
    env = setpiece.make("academy_empty_goal_close", record=tmp_path / "runs")
    first = played(env)["setpiece"]["replay"]
    with small_disk(100):
        with pytest.raises(setpiece.FileError, match="can't be written") as caught:
            played(env, seed=2)
        assert "no further episode" in str(caught.value)
        assert played(env, seed=3)["setpiece"]["replay"] is None
    assert played(env, seed=4)["setpiece"]["replay"] is None
    assert [str(file) for file in (tmp_path / "runs").iterdir()] == [first]


def test_a_compiled_scenario_does_not_name_its_way_out_of_a_folder(tmp_path: Path) -> None:
    import json
    import zlib

    path = tmp_path / "evil.pitchc"
    setpiece.load("academy_corner").save(path)
    text = path.read_text()
    body = json.loads(text)["scenario"]
    raw = text[text.index('"scenario":') + len('"scenario":') : -1]
    changed = raw.replace(f'"name":"{body["name"]}"', '"name":"../../x/evil"', 1)
    checksum = zlib.crc32(changed.encode())
    head = text[: text.index('"checksum"')] + f'"checksum":"{checksum:08x}","scenario":'
    path.write_text(head + changed + "}")
    with pytest.raises(setpiece.FormatError, match="is not a name"):
        setpiece.load(path)


def test_a_recorder_writes_into_its_folder_alone(tmp_path: Path) -> None:
    from setpiece._record import _write_beside

    with pytest.raises(setpiece.FileError, match="doesn't lie in"):
        _write_beside(tmp_path / "runs", "../evil", b"")
    assert not [*tmp_path.iterdir()]


def test_paths_that_are_not_unicode_are_paths(tmp_path: Path) -> None:
    name = os.fsdecode(b"caf\xe9")
    folder = tmp_path / name
    folder.mkdir()
    (folder / "rewards.pitch").write_text("reward paid { give 1 when goal by us }\n")
    file = folder / f"{name}.pitch"
    text = PITCH.replace("}} }}", "}} reward paid }}").format(name="mine")
    file.write_text(f'import "rewards.pitch"\n{text}')
    assert setpiece.load(file).rewards[-1] == "paid"
    env = setpiece.make(str(file), watch=True, record=folder / "runs")
    path = played(env)["setpiece"]["replay"]
    assert setpiece.Replay(path).scenario.name == "mine"
    env.scenario.save(folder / "mine.pitchc")
    assert setpiece.load(folder / "mine.pitchc").digest == env.scenario.digest
    (folder / "rewards.pitch").write_text("reward paid { give 2 when goal by us }\n")
    from time import sleep

    sleep(0.1)
    env.reset(seed=1)
    assert env.last_reload is not None
    assert env.last_reload.state == "applied"
    with pytest.raises(setpiece.FileError, match="no file"):
        setpiece.load(folder / "absent.pitch")


LONE = "\ud800"


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: setpiece.compile(5),  # type: ignore[arg-type]
        lambda: setpiece.compile(LONE),
        lambda: setpiece.compile("scenario s { }", LONE),
        lambda: setpiece.load(LONE),
        lambda: setpiece.load("a\0b"),
        lambda: setpiece.make("scenario s { " + LONE + " }"),
        lambda: setpiece.make("academy_corner", switching=5),  # type: ignore[arg-type]
        lambda: setpiece.make("academy_corner", switching=LONE),  # type: ignore[arg-type]
        lambda: setpiece.make_vec("academy_corner", 2, switching=5),  # type: ignore[arg-type]
        lambda: setpiece.make("academy_corner", rewards=LONE),
        lambda: setpiece.make("academy_corner", left=[LONE]),
        lambda: setpiece.make("academy_corner", opponents={"right": LONE}),
        lambda: setpiece.make("academy_corner", record=LONE),
        lambda: setpiece.make("academy_corner", record="a\0b"),
        lambda: setpiece.make("academy_corner", params={"difficulty": LONE}),
        lambda: setpiece.make("academy_corner", params={LONE: 1}),
        lambda: setpiece.Replay(LONE),
        lambda: setpiece.Replay(5),  # type: ignore[arg-type]
        lambda: setpiece.load("academy_corner").save(5),  # type: ignore[arg-type]
        lambda: setpiece.load("academy_corner").save(LONE),
        lambda: setpiece.load("academy_corner").with_params(difficulty=LONE),
    ],
)
def test_what_is_no_text_or_path_is_a_parameter_error(wrong: Callable[[], Any]) -> None:
    with pytest.raises(setpiece.ParameterError):
        wrong()


def test_the_command_of_the_package_draws_pictures_too(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "setpiece", "render", "academy_corner", "-o", "x.png"],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "x.png").read_bytes().startswith(b"\x89PNG")


def test_the_command_takes_paths_that_are_not_unicode(tmp_path: Path) -> None:
    file = tmp_path / os.fsdecode(b"caf\xe9.pitch")
    file.write_text(PITCH.format(name="mine"))
    done = subprocess.run(
        [sys.executable, "-m", "setpiece", "check", str(file)], capture_output=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_a_replay_or_snapshot_is_no_scenario(tmp_path: Path) -> None:
    env = setpiece.make("academy_corner")
    env.reset(seed=1)
    env.save_replay(tmp_path / "a.pitchr")
    (tmp_path / "a.pitchs").write_bytes(env.snapshot())
    with pytest.raises(setpiece.FileError, match="is a replay, not a scenario"):
        setpiece.load(tmp_path / "a.pitchr")
    with pytest.raises(setpiece.FileError, match="is a snapshot, not a scenario"):
        setpiece.load(tmp_path / "a.pitchs")
