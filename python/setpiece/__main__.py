"""The command `setpiece`, as `python -m setpiece` and as the script that the wheel installs."""

import logging
import signal
import sys

from setpiece._native import run_command


def main() -> int:
    """Runs the command with the process's arguments; returns its exit code.

    The codes are 0, 1 (input) or 2 (usage).
    """
    # Python only records an interrupt and lets native code continue; the default action ends the
    # process at once.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # Commands that read scripts or write dumps are Python and run here; the others needn't import
    # it.
    if sys.argv[1:2] == ["import"]:
        from setpiece.gfootball._import import main as import_main

        return import_main(sys.argv[2:])
    if sys.argv[1:2] == ["replay"]:
        from setpiece._replay_command import main as replay_main

        return replay_main(sys.argv[2:])
    # What scripts print is the command's to show.
    printed = logging.getLogger("setpiece.script")
    printed.addHandler(logging.StreamHandler())
    printed.setLevel(logging.DEBUG)
    return run_command(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
