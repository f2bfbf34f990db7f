"""What a replay's file holds: a head (mark, version, checksum, length), then CBOR (RFC 8949), deflated.

The engine writes these files and has the last word on them; this reads what playing one from Python needs.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from functools import reduce
from typing import Any

MARK = b"\x8bpitchr\n"
VERSION = 1
FILE_MAX = 64 << 20
BODY_MAX = 256 << 20
HEAD = struct.Struct("<8sIQQ")

FNV_START, FNV_PRIME = 0xCBF29CE484222325, 0x100000001B3

Seats = int | str | list[str] | None


class DamagedError(ValueError):
    """Bytes are no replay that this version reads; its text says why."""


@dataclass(frozen=True)
class Recorded:
    """What was written down of an episode."""

    scenario: bytes
    """The compiled scenario, in its compact form."""
    rewards: list[str] | None
    params: list[float]
    """The parameters' values, in their order."""
    left: Seats
    right: Seats
    switching: str | None
    seed: int
    index: int
    start: bytes | None
    """The snapshot that it began in."""
    length: int
    """Steps."""
    digest: int
    """The fingerprint of its last state."""
    actions: list[int]
    """What every agent pressed, agent by agent, step by step."""
    steers: list[list[float]]
    """For each of these x and y of the way and the power of a kick, where agents steered; else empty."""


def read(file: bytes) -> Recorded:
    """Returns what a file holds; `DamagedError` for anything but an unchanged replay of this version."""
    if not file.startswith(MARK):
        raise DamagedError("it doesn't begin as a replay")
    if len(file) < HEAD.size:
        raise DamagedError("it is cut off")
    _, version, checksum, length = HEAD.unpack_from(file)
    if version != VERSION:
        raise DamagedError(f"it has version {version}; this build plays version {VERSION}")
    body = file[HEAD.size :]
    if len(body) < length:
        raise DamagedError("it is cut off")
    if len(body) > length or _checksum(body) != checksum:
        raise DamagedError("it was changed after it was written: its checksum differs")
    try:
        recorded = _recorded(_Cbor(_inflated(body)).value())
    except DamagedError:
        raise
    except (KeyError, IndexError, TypeError, ValueError, RecursionError, OverflowError, struct.error, zlib.error):
        raise DamagedError("it is damaged") from None
    return recorded


def _checksum(body: bytes) -> int:
    """FNV-1a, 64 bits."""
    return reduce(lambda number, byte: (number ^ byte) * FNV_PRIME % 2**64, body, FNV_START)


def _inflated(body: bytes) -> bytes:
    inflater = zlib.decompressobj(-zlib.MAX_WBITS)
    inflated = inflater.decompress(body, BODY_MAX)
    if not inflater.eof:
        raise ValueError
    return inflated


def _recorded(values: dict[str, Any]) -> Recorded:
    if values["physics"] is not None:
        raise DamagedError("it was played with other physics than environments of this package have")
    if None in values["steers"]:
        raise DamagedError("keys and continuous actions are mixed in it")
    if not all(-1 <= number <= 1 for steer in values["steers"] for number in steer):
        raise ValueError
    agents = values["agents"] or {"sides": ["Scenario", "Scenario"], "fixed": None}
    left, right = (_seats(side) for side in agents["sides"])
    start = values["from"]
    return Recorded(
        scenario=bytes(values["scenario"]),
        rewards=None if values["rewards"] is None else [str(name) for name in values["rewards"]],
        params=[float(value) for value in values["params"]],
        left=left,
        right=right,
        switching={None: None, False: "auto", True: "fixed"}[agents["fixed"]],
        seed=_count(values["seed"]),
        index=_count(values["index"]),
        start=None if start is None else bytes(start),
        length=_count(values["length"]),
        digest=_count(values["digest"]),
        actions=[_count(number) for number in values["acts"]],
        steers=list(values["steers"]),
    )


def _count(value: Any) -> int:
    if not isinstance(value, int) or value < 0:
        raise ValueError
    return value


def _seats(side: Any) -> Seats:
    """Who played on a side, as `setpiece.make` takes it."""
    words: dict[str, Seats] = {"Scenario": None, "All": "all"}
    if isinstance(side, str):
        return words[side]
    [(kind, value)] = side.items()
    return int(value) if kind == "Count" else [str(name) for name in value]


class _Cbor:
    """Reads the values of CBOR that replays are made of: those of definite length, without tags."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._at = 0

    def value(self) -> Any:
        """Returns the next value."""
        kind, low = divmod(self._data[self._at], 32)
        self._at += 1
        if kind == 7:
            return self._simple(low)
        size = low if low < 24 else self._unpack(">BHIQ"[low - 23])
        if kind == 0:
            return size
        if kind == 1:
            return -1 - size
        if kind == 2:
            return self._take(size)
        if kind == 3:
            return self._take(size).decode()
        if kind == 4:
            return [self.value() for _ in range(size)]
        if kind == 5:
            return {self.value(): self.value() for _ in range(size)}
        raise ValueError

    def _simple(self, low: int) -> Any:
        if low in (20, 21, 22):
            return {20: False, 21: True, 22: None}[low]
        return self._unpack({25: "e", 26: "f", 27: "d"}[low])

    def _unpack(self, code: str) -> Any:
        form = struct.Struct(f">{code}")
        return form.unpack(self._take(form.size))[0]

    def _take(self, size: int) -> bytes:
        taken = self._data[self._at : self._at + size]
        if len(taken) < size:
            raise ValueError
        self._at += size
        return taken
