"""Draws a recorded episode with kloppy and mplsoccer: its frames, and its passes and shots.

`setpiece.make(…, record="replays")` records one.

pip install setpiece[kloppy] mplsoccer
setpiece replay replays/….pitchr --format cdf -o episode
python draw_tracking.py episode episode.png
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt
from kloppy.domain import EventType, ShotResult
from mplsoccer import Pitch

from setpiece.kloppy import load_event, load_tracking

COLOURS = {"left": "#e2574c", "right": "#3f7fbf"}


def draw(folder: Path, picture: Path) -> None:
    """Draws the data of a folder into a file.

    - `folder`: what `setpiece replay FILE --format cdf|csv -o FOLDER` wrote.
    - `picture`: a PNG; its left half shows how everyone and the ball moved, its right half the
      passes (arrows) and shots (thick; a star where one went in).
    """
    tracking, events = load_tracking(folder), load_event(folder)
    size = tracking.metadata.pitch_dimensions
    # The origin of the data is the centre spot; mplsoccer's custom pitch begins in a corner.
    middle_x, middle_y = size.pitch_length / 2, size.pitch_width / 2
    pitch = Pitch(
        pitch_type="custom",
        pitch_length=size.pitch_length,
        pitch_width=size.pitch_width,
        pitch_color="#f4f7f2",
        line_color="#9aa89a",
        line_zorder=1,
    )
    figure, (left, right) = pitch.draw(ncols=2, figsize=(16, 5.8))

    left.set_title(f"{tracking.metadata.game_id}: {len(tracking)} frames, 10 per second")
    paths: dict[str, list[tuple[float, float]]] = {}
    for frame in tracking.frames:
        for player, data in frame.players_data.items():
            at = data.coordinates
            paths.setdefault(player.player_id, []).append((at.x + middle_x, at.y + middle_y))
    teams = {
        player.player_id: team.team_id
        for team in tracking.metadata.teams
        for player in team.players
    }
    for player_id, points in paths.items():
        x, y = zip(*points, strict=True)
        colour = COLOURS[teams[player_id]]
        pitch.plot(x, y, ax=left, color=colour, linewidth=1, alpha=0.6)
        pitch.scatter(x[-1:], y[-1:], ax=left, color=colour, s=60, edgecolors="white")
    ball = [frame.ball_coordinates for frame in tracking.frames]
    x, y = [at.x + middle_x for at in ball], [at.y + middle_y for at in ball]
    pitch.plot(x, y, ax=left, color="black", linewidth=1.2)

    score = events.metadata.score
    right.set_title(f"passes and shots, {score.home} : {score.away}")
    for event in events:
        if event.event_type == EventType.PASS:
            end, width = event.receiver_coordinates, 1.5
        elif event.event_type == EventType.SHOT:
            end, width = event.result_coordinates, 4
        else:
            continue
        start, colour = event.coordinates, COLOURS[event.team.team_id]
        pitch.arrows(
            start.x + middle_x,
            start.y + middle_y,
            end.x + middle_x,
            end.y + middle_y,
            ax=right,
            color=colour,
            width=width,
            alpha=0.9 if event.result.is_success else 0.35,
        )
        if event.result == ShotResult.GOAL:
            pitch.scatter(
                [end.x + middle_x], [end.y + middle_y], ax=right, marker="*", s=200, color=colour
            )
    figure.savefig(picture, dpi=110, bbox_inches="tight")
    plt.close(figure)


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path, help="what `setpiece replay --format cdf` wrote")
    parser.add_argument("picture", type=Path, help="the PNG to write")
    arguments = parser.parse_args()
    draw(arguments.folder, arguments.picture)


if __name__ == "__main__":
    main()
