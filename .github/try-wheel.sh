#!/bin/sh
# Installs a wheel or source distribution into a fresh environment and runs README's Python example
# and the command there: try-wheel.sh FILE PYTHON
set -eu
file=$1 python=$2
venv=$(mktemp -d)/venv
"$python" -m venv "$venv"
bin=$venv/bin
[ -d "$bin" ] || bin=$venv/Scripts
"$bin/python" -m pip install --quiet --disable-pip-version-check "$file" pytest
"$bin/python" -c '
import sys, setpiece
print("setpiece", setpiece.__version__, "on Python", sys.version)
locked = getattr(sys, "_is_gil_enabled", lambda: True)()
assert locked or "free-threading" in sys.version
assert not locked or "free-threading" not in sys.version, "the module turns the lock on"
'
# From the folder of the tests, so that the installed package is imported and not the sources.
cd "$(dirname "$0")/../python/tests"
"$bin/python" -m pytest --quiet -p no:cacheprovider test_readme.py -k project
"$bin/setpiece" run academy_empty_goal_close --agent bot --episodes 3
