"""Optional packages."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from setpiece._errors import MissingPackageError


def need(module: str, extra: str, what: str) -> ModuleType:
    """Imports a module, or raises `MissingPackageError` naming the extra that installs it."""
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        # A package that exists but lacks a dependency raises a better error itself.
        if error.name is None or error.name.split(".")[0] != module.split(".")[0]:
            raise
        package = module.split(".")[0]
        raise MissingPackageError(
            f"{what} needs the package `{package}`",
            name=package,
            help=f"pip install 'setpiece[{extra}]'",
        ) from None
