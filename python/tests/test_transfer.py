"""What `lab/transfer` reads from super mini maps, and policies trained on them."""

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest

import setpiece

LAB = Path(__file__).resolve().parents[2] / "lab" / "transfer"
sys.path.insert(0, str(LAB))
options = importlib.import_module("options")
places = importlib.import_module("places")
intervals = importlib.import_module("intervals")
policy = importlib.import_module("policy")
ppo = importlib.import_module("ppo")
games = importlib.import_module("games")

CELL_M = 2 * places.EDGES_M / (places.WIDTH, places.HEIGHT)


def real_maps() -> np.ndarray:
    """31 maps of the real game, academy_run_to_score_with_keeper, right and sprint.

    uint8 `(31, 72, 96, 4)`.
    """
    with np.load(LAB / "recorded" / "real_maps.npz") as file:
        shape = tuple(file["shape"])
        return (np.unpackbits(file["bits"], count=int(np.prod(shape))).reshape(shape) * 255).astype(
            np.uint8
        )


def stacked(maps: np.ndarray) -> np.ndarray:
    """The same maps in stacks of four on the last axis, oldest first, as both games' packages make
    them.
    """
    padded = np.concatenate([maps[:1]] * 3 + [maps])
    return np.concatenate([padded[k : k + len(maps)] for k in range(4)], -1)


def features(maps: np.ndarray, roster: object = None) -> np.ndarray:
    """The features of an episode's maps, one after another."""
    tracker = places.Tracker(roster or places.Roster.of(maps[:10]), 1)
    return np.concatenate(
        [tracker.see(maps[k : k + 1], np.array([k == 0])) for k in range(len(maps))]
    )


def test_real_maps_give_the_same_features_in_either_layout() -> None:
    maps = real_maps()
    single, four = features(maps), features(stacked(maps))
    assert single.dtype == np.float32
    assert np.array_equal(single, four)
    assert single.shape == (31, places.Roster.of(maps).features)


def test_a_roster_of_ours_reads_the_real_maps() -> None:
    maps = real_maps()
    game = games.Here("academy_run_to_score_with_keeper", 1, 1)
    ours = ppo.opening(game)
    game.close()
    theirs = places.Roster.of(maps)
    assert ours.players == theirs.players == 8
    # Every slot is the same player in both games; they start at most a cell apart.
    read = features(maps, ours)[:1, 4 : 4 + 16].reshape(8, 2)
    start = places.metres(np.concatenate([ours.own, ours.opponents]))
    assert (np.abs(read - start) <= CELL_M * 1.01).all()


def test_the_first_map_of_the_real_game_does_not_show_who_is_controlled() -> None:
    maps = real_maps()
    _, _, ball, me = places.marks(maps)
    assert np.abs(me[0] - ball[0]).max() > 40
    assert np.abs(me[1] - ball[1]).max() <= 1
    read = features(maps)
    assert (np.abs(read[0, :2] - read[0, 2:4]) <= CELL_M * 1.01).all()


@pytest.mark.parametrize("name", ["academy_3_vs_1_with_keeper", "academy_counterattack_easy"])
def test_places_of_ours_come_back_within_a_cell(name: str) -> None:
    envs = 8
    shown = setpiece.make_vec(name, envs, threads=1, observation="smm")
    known = setpiece.make_vec(name, envs, threads=1, observation="simple115v2")
    maps, truth = shown.reset(seed=5)[0], known.reset(seed=5)[0]
    game = games.Here(name, 1, 5)
    roster = ppo.opening(game)
    game.close()
    tracker, first, over = places.Tracker(roster, envs), np.ones(envs, bool), np.zeros(envs, bool)
    rng = np.random.default_rng(0)
    unit = np.array([54.4, 83.6])
    half = CELL_M / 2 * 1.001
    checked = 0
    for _ in range(60):
        read = tracker.see(maps, first)
        assert read.shape == (envs, roster.features)
        got = read[:, 4 : 4 + 2 * roster.players].reshape(envs, -1, 2)
        for env in range(envs):
            for side, slots in (
                (truth[env, :22], got[env, : len(roster.own)]),
                (truth[env, 44:66], got[env, len(roster.own) :]),
            ):
                for place in side.reshape(11, 2):
                    true = place * unit
                    if (np.abs(true) < places.EDGES_M).all() and not (place == -1).all():
                        assert (np.abs(slots - true) <= half).all(1).any()
                        checked += 1
            ball = truth[env, 88:90] * unit
            if (np.abs(ball) < places.EDGES_M).all():
                assert (np.abs(read[env, :2] - ball) <= half).all()
        actions = rng.integers(0, 19, envs)
        maps, _, terminated, truncated, _ = shown.step(actions)
        truth = known.step(actions)[0]
        first, over = over, terminated | truncated
    assert checked > 1000
    shown.close()
    known.close()


def drawn_map(own: list[tuple[int, int]], ball: tuple[int, int] = (10, 10)) -> np.ndarray:
    """A map with own players and opponents in a corner, columns and rows."""
    made = np.zeros((1, 72, 96, 4), np.uint8)
    for column, row in own:
        made[0, row, column, 0] = 255
    made[0, 0, 0, 1] = made[0, ball[1], ball[0], 2] = made[0, own[0][1], own[0][0], 3] = 255
    return made


def test_a_player_keeps_its_slot_through_a_shared_cell() -> None:
    maps = [drawn_map([(10, 10), (14, 10)]), drawn_map([(11, 10), (13, 10)]), drawn_map([(12, 10)])]
    maps += [drawn_map([(12, 11), (13, 10)])]
    tracker = places.Tracker(places.Roster.of(maps[0]), 1)
    for at, one in enumerate(maps):
        read = tracker.see(one, np.array([at == 0]))
        assert read[0, 12:15].tolist() == [1, 1, 1]
    cells = tracker.cells[0][0].tolist()
    assert sorted(cells) == [[12, 11], [13, 10]]


def test_a_player_who_is_gone_is_flagged_and_keeps_its_place() -> None:
    tracker = places.Tracker(places.Roster.of(drawn_map([(10, 10), (40, 40)])), 1)
    tracker.see(drawn_map([(10, 10), (40, 40)]), np.array([True]))
    read = tracker.see(drawn_map([(10, 10)]), np.array([False]))
    assert read[0, 12:15].tolist() == [1, 0, 1]
    assert np.allclose(read[0, 6:8], places.metres([40, 40]))


def test_differences_show_where_players_come_from() -> None:
    maps = np.concatenate([drawn_map([(10 + k, 10), (40, 40)]) for k in range(4)])
    read = features(maps)
    ways = read[3, 15:].reshape(3, 5, 2)
    assert np.allclose(ways[:, 2, 0], CELL_M[0] * np.array([1, 2, 3]), atol=1e-4)
    assert not ways[:, 3].any()
    assert not features(maps[:1])[0, 15:].any()


def test_players_who_start_in_one_cell_are_counted() -> None:
    maps = np.concatenate(
        [drawn_map([(10, 10), (40, 40)]), drawn_map([(10, 11), (40, 40), (41, 40)])]
    )
    roster = places.Roster.of(maps)
    assert sorted(roster.own.tolist()) == [[10, 10], [40, 40], [40, 40]]
    assert features(maps, roster)[:, 14:18].all()


def test_intervals() -> None:
    low, high = intervals.mean_interval(np.ones(100))
    assert 0.95 < low < 0.97
    assert high == 1
    share, low, high = intervals.share_interval(
        np.repeat([0, 1], [20, 80]), np.repeat([0, 1], [36, 64])
    )
    assert share == pytest.approx(0.8)
    assert low < 0.8 < high
    assert intervals.share_interval(np.zeros(10), np.ones(10)) is None


def test_a_policy_is_trained_stored_and_played(tmp_path: Path) -> None:
    trained = ppo.train("academy_empty_goal_close", 16_384, 0)
    file = tmp_path / "policy.npz"
    trained.policy.save(file)
    read = policy.Policy.load(file)
    seen = np.random.default_rng(0).normal(0, 20, (5, read.roster.features)).astype(np.float32)
    assert np.allclose(read.logits(seen), trained.policy.logits(seen), atol=0.05)
    ends = []
    for _ in range(2):
        game = games.Here("academy_empty_goal_close", 4, 7)
        ends.append(games.play(read, game, 6, True, 3))
        game.close()
    assert ends[0].shape == (6,)
    assert np.array_equal(*ends)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--scenario", "academy_3vs1"], "did you mean `academy_3_vs_1_with_keeper`?"),
        (["--steps", "5"], "expected at least 16384 steps, found 5"),
        (["--episodes", "many"], "expected a whole number of episodes, found `many`"),
        (["--seed", "-1"], "expected a seed from 0 to 1000000, found `-1`"),
        (["--recorded", "--steps", "20000"], "--steps has no meaning with --recorded"),
    ],
)
def test_a_mistyped_option_is_reported(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as stopped:
        options.parse(words)
    assert stopped.value.code == 2
    assert message in capsys.readouterr().err
