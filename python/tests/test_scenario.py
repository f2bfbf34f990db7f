import copy
import json
import pickle
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import play, same

import setpiece

PitchFile = Callable[..., Path]
CLOSE = "academy_empty_goal_close"


def test_list_names_titles_players() -> None:
    entries = setpiece.list()
    assert len(entries) == 41
    assert entries == sorted(entries)
    corner = next(entry for entry in entries if entry == "academy_corner")
    assert corner.players == (11, 11)
    assert corner.title
    assert pickle.loads(pickle.dumps(corner)).players == (11, 11)
    assert "academy" not in entries, "an abstract parent can't be run"


def test_every_scenario_of_the_library_loads_with_both_difficulties() -> None:
    for entry in setpiece.list():
        scenario = setpiece.load(entry)
        assert scenario.name == entry
        assert scenario.title == entry.title
        assert {"difficulty", "left_difficulty"} <= scenario.params.keys()
        assert scenario.with_params(difficulty=0.95).params["difficulty"].default == 0.95


def test_params_say_what_they_are() -> None:
    param = setpiece.load(CLOSE).params["difficulty"]
    assert (param.name, param.type, param.range, param.choices) == (
        "difficulty",
        "number",
        (0.0, 1.0),
        (),
    )
    assert "right team" in param.doc
    assert repr(param) == "Param(difficulty: number = 0.6, 0..1)"


def test_with_params_leaves_the_original() -> None:
    scenario = setpiece.load(CLOSE)
    other = scenario.with_params(difficulty="90%")
    assert other.params["difficulty"].default == 0.9
    assert scenario.params["difficulty"].default == 0.6
    assert "difficulty=0.9" in repr(other)
    with pytest.raises(TypeError):
        scenario.params["difficulty"] = 1  # type: ignore[index]


@pytest.mark.parametrize(
    ("params", "message", "name"),
    [
        ({"dificulty": 0.5}, "did you mean `difficulty`?", "dificulty"),
        ({"difficulty": 1.5}, "parameter `difficulty` is 1.5, outside 0..1", "difficulty"),
        ({"difficulty": float("nan")}, "expected a number", "difficulty"),
        ({"difficulty": "hard"}, "expected a number, found `hard`", "difficulty"),
        ({"difficulty": None}, "expected a number, found `None`", "difficulty"),
        ({"difficulty": True}, "expected a number, found `True`", "difficulty"),
        ({"difficulty": [0.5]}, "expected a number, found `[0.5]`", "difficulty"),
    ],
)
def test_wrong_params_are_named(params: dict[str, object], message: str, name: str) -> None:
    with pytest.raises(setpiece.ParameterError) as caught:
        setpiece.load(CLOSE).with_params(**params)  # type: ignore[arg-type]
    assert message in str(caught.value)
    assert caught.value.name == name
    assert caught.value.code == "SP0008"
    with pytest.raises(setpiece.ParameterError):
        setpiece.make(CLOSE).reset(options={"params": params})


def test_saved_scenario_plays_the_same(tmp_path: Path) -> None:
    path = tmp_path / "close.pitchc"
    scenario = setpiece.load(CLOSE).with_params(difficulty=0.25)
    scenario.save(path)
    loaded = setpiece.load(path)
    assert loaded.params["difficulty"].default == 0.25
    assert loaded.with_params(difficulty=0.5).params["difficulty"].default == 0.5
    assert loaded.doc == scenario.doc
    assert same(play(setpiece.make(path), 3), play(setpiece.make(scenario), 3))


def test_pickled_and_copied_scenario_plays_the_same() -> None:
    scenario = setpiece.load(CLOSE).with_params(difficulty=0.25)
    twin = pickle.loads(pickle.dumps(scenario))
    assert twin.params["difficulty"].default == 0.25
    assert copy.deepcopy(scenario) is scenario
    assert same(play(setpiece.make(twin), 3), play(setpiece.make(scenario), 3))


def cut_in_half(text: str) -> str:
    return text[: len(text) // 2]


def change_a_value(text: str) -> str:
    return text.replace('"name":"academy_empty_goal_close"', '"name":"academy_empty_goal_far"')


def raise_version(text: str) -> str:
    return json.dumps({**json.loads(text), "version": 99})


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (cut_in_half, "truncated"),
        (change_a_value, "checksum"),
        (raise_version, "version 99"),
        (str.upper, "not a compiled"),
    ],
)
def test_damaged_file_is_refused(tmp_path: Path, damage: Callable[[str], str], words: str) -> None:
    path = tmp_path / "close.pitchc"
    setpiece.load(CLOSE).save(path)
    path.write_text(damage(path.read_text()))
    with pytest.raises(setpiece.FormatError, match=words):
        setpiece.load(path)


def test_files_that_cannot_be_used(tmp_path: Path, pitch_file: PitchFile) -> None:
    mine = pitch_file("scenario s {}\n")
    with pytest.raises(setpiece.FileError) as caught:
        setpiece.load(mine.with_name("mime.pitch"))
    assert caught.value.path.endswith("mime.pitch")
    assert caught.value.help == "did you mean `mine.pitch`?"
    assert isinstance(caught.value, OSError)
    with pytest.raises(setpiece.FileError, match="directory"):
        setpiece.load(tmp_path)
    mine.write_bytes(b"scenario\n\xff")
    with pytest.raises(setpiece.FileError, match="line 2"):
        setpiece.load(mine)
    with pytest.raises(setpiece.FileError):
        setpiece.load(CLOSE).save(tmp_path / "no" / "such" / "folder.pitchc")
    with pytest.raises(setpiece.FileError, match="directory"):
        setpiece.load(CLOSE).save(tmp_path)


def test_unknown_scenario_is_named_with_the_nearest() -> None:
    with pytest.raises(setpiece.UnknownScenarioError) as caught:
        setpiece.make("academy_3_vs_1_with_keper")
    assert caught.value.name == "academy_3_vs_1_with_keper"
    assert "did you mean `academy_3_vs_1_with_keeper`?" in str(caught.value)
    assert caught.value.code == "SP0005"
    assert isinstance(caught.value, LookupError)


WRONG = """scenario wrong {
    ball at (0.5, 0)
    team left {
        CBB at (0.4, 0)
    }
    reward mine {
        give 1 on gaol by us
        give 1s as "time"
    }
    end limit 100 steps
}
"""


def test_three_mistakes_are_three_diagnostics() -> None:
    with pytest.raises(setpiece.CompileError) as caught:
        setpiece.compile(WRONG, name="wrong.pitch")
    errors = [one for one in caught.value.diagnostics if one.severity == "error"]
    assert [one.labels[0].line for one in errors] == [4, 7, 8]
    role = errors[0]
    assert (role.labels[0].file, role.labels[0].column, role.labels[0].end_column) == (
        "wrong.pitch",
        9,
        12,
    )
    assert role.code == "SP0203"
    assert "`CBB`" in role.message
    assert role.help == "did you mean `CB`?"
    assert str(role).startswith("wrong.pitch:4:9: SP0203: ")
    for code in (one.code for one in errors):
        assert code in str(caught.value), "the rendered report shows every problem"
    with pytest.raises(AttributeError):
        role.code = "SP0001"  # type: ignore[misc]


def test_columns_count_characters() -> None:
    with pytest.raises(setpiece.CompileError) as caught:
        setpiece.compile("scenario s {\n  /* äöü⚽ */ team left { CBB at (0, 0) }\n}\n")
    label = next(one for one in caught.value.diagnostics if one.code == "SP0203").labels[0]
    assert (label.file, label.line, label.column, label.end_line, label.end_column) == (
        "<text>",
        2,
        26,
        2,
        29,
    )


@pytest.mark.parametrize(
    "text", ["", "\n\n", "// nothing\n", "\0", "scenario", "(" * 10_000, "x" * 10_000]
)
def test_odd_texts_are_compile_errors(text: str) -> None:
    with pytest.raises(setpiece.CompileError) as caught:
        setpiece.compile(text)
    assert caught.value.diagnostics


def test_a_text_of_two_megabytes_is_refused() -> None:
    with pytest.raises(setpiece.FileError, match="larger than 1 MiB"):
        setpiece.compile("// long\n" * 250_000)


def test_errors_survive_pickling() -> None:
    with pytest.raises(setpiece.CompileError) as caught:
        setpiece.compile(WRONG)
    twin = pickle.loads(pickle.dumps(caught.value))
    assert twin.diagnostics == caught.value.diagnostics
    assert str(twin) == str(caught.value)
    for error in (
        setpiece.FileError("no file", path="a.pitch", help="b"),
        setpiece.UnknownScenarioError("no scenario", name="a"),
        setpiece.ScriptError(
            "failed", script="a.rhai", line=3, column=1, hook="reward", seed=5, step=6
        ),
    ):
        assert vars(pickle.loads(pickle.dumps(error))) == vars(error)
        assert str(pickle.loads(pickle.dumps(error))) == str(error)


def test_a_compiled_scenario_is_never_saved_over_a_source(pitch_file: PitchFile) -> None:
    path = pitch_file(
        "scenario s { ball at centre  team left { CM at (-0.1, 0) }  end limit 5 steps }"
    )
    text = path.read_text()
    with pytest.raises(setpiece.SetpieceError, match=r"ends in \.pitchc"):
        setpiece.load(path).save(path)
    assert path.read_text() == text
