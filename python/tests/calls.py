"""What programs ask of this package: its names, and the keywords of its functions.

Modules whose libraries aren't installed are read instead of imported.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import re
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import setpiece
from setpiece import _env_options


def faults(program: str) -> Iterator[str]:
    """Yields what a program asks of this package that isn't there."""
    tree = ast.parse(program)
    known: dict[str, Any] = {"setpiece": setpiece}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names if alias.name.split(".")[0] == "setpiece"]
            yield from (f"no module `{name}`" for name in names if find_spec(name) is None)
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "setpiece":
            for alias in node.names:
                thing = found(f"{node.module}.{alias.name}")
                known[alias.asname or alias.name] = thing
                if thing is None:
                    yield f"`{node.module}` has no `{alias.name}`"
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and (name := dotted(node)):
            if name.startswith("setpiece.") and found(name) is None:
                yield f"no `{name}`"
        elif isinstance(node, ast.Call) and (name := dotted(node.func)):
            thing = found(name) if name.startswith("setpiece.") else known.get(name)
            words = {keyword.arg for keyword in node.keywords if keyword.arg}
            if (takes := keywords(thing)) is not None:
                yield from (f"`{name}` takes no `{word}`" for word in sorted(words - takes))


def dotted(node: ast.expr) -> str | None:
    """Returns the name that an expression writes with dots."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute) and (before := dotted(node.value)):
        return f"{before}.{node.attr}"
    return None


def found(name: str) -> Any:
    """Returns what a name with dots stands for: a thing, or its definition in a module's text."""
    thing: Any = setpiece
    module = "setpiece"
    for word in name.split(".")[1:]:
        if isinstance(thing, ast.Module):
            thing = definition(thing, word)
        elif hasattr(thing, word):
            thing = getattr(thing, word)
        elif inspect.ismodule(thing) and find_spec(f"{module}.{word}"):
            thing = read(f"{module}.{word}")
        else:
            return None
        module += f".{word}"
    return thing


def read(module: str) -> Any:
    """Imports a module; returns its text where its library isn't installed."""
    try:
        return importlib.import_module(module)
    except ImportError:
        spec = find_spec(module)
        assert spec
        assert spec.origin
        return ast.parse(Path(spec.origin).read_text(encoding="utf-8"))


def definition(module: ast.Module, name: str) -> ast.stmt | None:
    """Returns where a module's text defines a name."""
    for node in module.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name == name:
            return node
        if isinstance(node, ast.ImportFrom) and name in (
            alias.asname or alias.name for alias in node.names
        ):
            return node
        targets = node.targets if isinstance(node, ast.Assign) else []
        if any(isinstance(target, ast.Name) and target.id == name for target in targets):
            return node
    return None


def keywords(thing: Any) -> set[str] | None:
    """Returns the keywords that a function takes, or nothing if it takes any or isn't known."""
    if isinstance(thing, ast.FunctionDef):
        given = thing.args
        taken = {each.arg for each in given.args + given.kwonlyargs}
        rest = given.kwarg and ast.unparse(given.kwarg.annotation or ast.Constant(None))
    elif callable(thing):
        try:
            parameters = inspect.signature(thing).parameters
        except ValueError:
            return None
        taken = {*parameters}
        any_word = inspect.Parameter.VAR_KEYWORD
        rest = next(
            (str(each.annotation) for each in parameters.values() if each.kind == any_word), None
        )
    else:
        return None
    if rest is None:
        return taken
    spread = re.search(r"Unpack\[(\w+)]", rest)
    return taken | {*getattr(_env_options, spread[1]).__annotations__} if spread else None
