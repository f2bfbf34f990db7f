"""Agents in both games, on one page: `cargo xtask transfer` sets up and runs this.

Trains policies here and plays them in both games (`trained.py`), plays rule-based agents
(`compare.py`), and writes `docs/transfer.md`.
"""

from __future__ import annotations

import sys
from pathlib import Path

import box
import compare
import trained
from options import is_match, parse

PAGE = Path(__file__).resolve().parents[2] / "docs" / "transfer.md"
HEAD = """# Transfer

How much of its score an agent keeps when it moves from Setpiece to the real game, Google Research Football.
`cargo xtask transfer` trains and plays the agents of this page and writes it. The results are stored in
`lab/transfer/recorded/`. "here" is Setpiece, "there" the real game.

```console
$ cargo xtask transfer                                        # all of it: hours
$ cargo xtask transfer --scenario academy_corner --steps 2000000
$ cargo xtask transfer --recorded                             # stored policies, without the real game
```

`--recorded` plays the stored policies here again, beside the scores that the same weights had in the real game. It
shows what a change of this game does to these policies. It can't show how policies trained after the change would
score in the real game: that takes a run without `--recorded`.

## Policies trained here

One policy per scenario, trained by PPO in Setpiece alone. It sees only what the super mini map shows: the places of the
players, the ball and the controlled player, decoded from the planes of the newest four maps. `lab/transfer/places.py`
decodes the maps of both games. The real game is EnvPool's, with 19 actions and one controlled player.

- A score is the mean goal difference of an episode, with its 95 % interval in brackets.
- "kept" is the score there divided by the score here.
- "likeliest" presses the policy's likeliest action; "drawn" draws an action by its probability, as in training.
- Policies are trained with the rewards `scoring` and `checkpoints`. In a scene the training ends early once the last
  1,000 episodes score 0.97.
- The policies of this table were trained in earlier builds, most of them before the touches of a dribble became
  motions. The scores here are of this build.

"""
BOXED = """
The policies in the box (`baselines/policies`) see numbers, `simple115v2`. Those of `academy_3_vs_1_with_keeper` and
`academy_run_to_score_with_keeper` were trained in this build, the others in the one before. `box.py` plays
them where the package `gfootball` is installed. "here" is the score of their likeliest actions on their cards.

"""
DIFFERENCES = """
The maps have the same form in both games: 72 rows, 96 columns, and the planes own team, opponents, ball and controlled
player with the values 0 and 255. Some differences still matter to a policy that reads them:

- On the first map of an episode the real game often marks another player than the one at the ball, and in the Academy
  the keeper. From the second map on it marks the player at the ball. For both games the first map is read as if the
  player nearest to the ball was marked.
- A player whose place is on the border of two cells can be drawn in either. Many start a cell apart in the two games.
- Two players in one cell are one mark, and no mark says which player it is. Players are identified by their places at
  the start and followed from map to map.
- A place that never changes here can change by a cell there. Inputs are divided by at least 0.5 m.

Policies train on places that are moved by up to 0.6 m for an episode and by 0.2 m from step to step. A policy that has
only seen exact places presses other keys as soon as a mark lies one cell further.

What was found by playing the same keys in both games, step by step, and built:

- A rival's ball is reached for where it will be, some ticks ahead. A touch in between leaves the foot beside it.
  A player who hasn't seen the last touch yet goes by the ball's way before it.
- A ball that a rival has just touched springs off the legs of whoever stands in its way. Who takes the ball, or stops
  it, minds their own motion to its end: a ball that is touched meanwhile rolls on between their feet.
- How somebody takes a rival's ball depends on the angle between their run and the way that they want with it.
- A shooter turns in the swing: a shot across the run goes where it is aimed.
- An opponent close by makes a dribbler push the ball further, most a nervous one.
- The swing of a shot brakes the runner, who follows through and only then speeds up again.
- A shot struck while setting off scatters twice as much as one on the run.
- A keeper who faces the ball sets off slowly.
- Touches of a dribble and kicks are motions, each made for one place of the ball. Where the ball may be instead follows
  one rule: far behind that place but hardly ahead of it, less aside, and hardly any way off right after the player's
  own touch. So a kick leaves as soon as one of its swings meets the ball, with or without a first touch.
- A dribbler runs at full speed between two touches, and finishes a stride before the next one.
- A pushed ball hops and turns as there: walkers touch it every 0.25 s, sprinters every 0.72 s.
- Whoever has the ball at a start waits for up to 0.2 s; whoever hasn't sets off at once.
- The foot that leads decides which of a kick's swings is tried first. The feet change with every stride: a walker's
  pass takes 0.1 s or 0.27 s.
- Each swing has its strength: a standing player passes at 26 m/s at most, a walker at 30, to the side at 24. What is
  missing becomes height. A ball that is far from the foot, fast, or just played by a rival leaves slower, higher and
  more along the swing's own way.
- A ball springs off a body only within 0.2 s of a rival's touch. Later it is played, or passes by.
- A rolling ball lends half of its speed to a pass. A ball kicked off the grass gets topspin, so that floating passes
  fly lower: receivers meet them, and strike them first time.
- The grass brakes a ball that slides over it until it rolls: a shot along the ground loses 4 m/s in its first steps.
- A shot is as hard as the body's motion in its swing makes it, however fast the player is. It keeps three tenths of
  the ball's spin, so those of runners dip and stay low.
- A keeper's hands have motions too, and no chance decides a save. Every few ticks a keeper tries whether the hands of
  one of 28 motions meet the ball where it will be, those that hold it first. A ball that is too fast, or was just
  touched, can't be held: it is pushed away along the keeper's way. A ball that a rival touches after the hands went
  out springs off them, or gets past.
- A keeper comes out for a free ball only if they are first at it and it isn't bound for goal. For one that is, they
  move into its way.
- A ball that gets past the player who is first at it, without a motion of theirs, comes off their body. So a
  keeper far out stops many shots that go straight at them.
- A fast ball is met between two points of its forecast too: it doesn't fly through whoever stands in its way.
- A body leans to the ball until the touch and then comes back, and it is drawn to where the ball will be, or away from
  a ball that is too near. So a runner's touches come as late as there.

What remains:

- Standing shots from 18 m score in 1 of 200 here, in 10 of 30 there: keepers reach too many of them.
- A defender stands nearer to a sprinter's line here. There they are often 0.6 m to 0.9 m beside it, slide as the
  sprinter passes, and foul. Sprinters who hold their direction get past both opponents of `academy_3_vs_1_with_keeper`
  in none of 60 episodes here, in 15 of 40 there. In `academy_run_to_score_with_keeper` they score in 12 of 60 here, in
  12 of 40 there.
- A sprinter who zigzags from the start keeps their pace there and walks here, where an early turn is made at a walk.
- A player slows down here to take a ball that lies across their way; in the real game they run on.
- Bots pass more often and more safely here once they have won the ball. Agents have it for fewer steps and play fewer
  passes.
- Drawn actions keep less than likeliest ones: the real game's episodes differ more from each other.

"""
RULES = """## Agents by rules

Twelve agents that press the same keys for the same places. They see raw observations and play the left team against
the built-in bots. The runs there are recorded from Google Research Football 2.10.2: `matches.py` makes them where the
package `gfootball` is installed. Every figure is a mean over episodes: here / there.

"""


def write_page() -> None:
    """Writes the page from the stored results."""
    records = trained.stored()
    policies = trained.table(records) if records else "No policy has been trained yet.\n"
    PAGE.write_text(
        HEAD + policies + BOXED + box.stored() + DIFFERENCES + RULES + compare.sections()
    )


def main(argv: list[str]) -> None:
    """Trains and plays; writes the page after every scenario, so that nothing is lost."""
    options = parse(argv)
    for scenario in sorted(options.scenario, key=is_match):
        if not options.recorded:
            trained.both(scenario, options)
        elif (trained.POLICIES / f"{scenario}.json").exists():
            trained.again(scenario, options)
        else:
            print(f"{scenario}: no stored policy")
        write_page()
    compare.play_here(options.scenario, options.episodes)
    write_page()
    print(f"wrote {PAGE}")


if __name__ == "__main__":
    main(sys.argv[1:])
