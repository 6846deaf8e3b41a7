"""Gray codes against SymPy, encoders of several turns and of a wanted size against figures of data sheets."""

from __future__ import annotations

from math import degrees
from pathlib import Path

import pytest
from sympy.combinatorics.graycode import bin_to_gray

from derive.errors import SheetErrors
from tests.kinds.test_sensor_kinds import ask, value


@pytest.mark.parametrize(("bits", "position"), [(1, 1), (4, 0), (4, 11), (4, 15), (13, 7079), (20, 999)])
def test_gray_code_there_and_back(tmp_path: Path, bits: int, position: int) -> None:
    sensor = f"sensor: {{encoder: absolute, bits: {bits}, gear: 50}}"
    there = ask(tmp_path, sensor, "gray-code", f"position: {position}").results
    binary, gray = (
        "".join(str(round(value(row[0]))) for row in there[name].rows) for name in ("binary", "gray")
    )
    assert binary == format(position, f"0{bits}b")
    assert gray == bin_to_gray(binary)
    back = ask(tmp_path, sensor, "gray-code", f'code: "{gray}"').results
    assert value(back["position"]) == position
    assert degrees(value(back["angle"])) == pytest.approx(position * 360 / 2**bits / 50)


def test_several_turns(tmp_path: Path) -> None:
    # Singleturn 13 bits, multiturn 12 bits: 8192 positions and 4096 turns, as data sheets have it.
    sensor = "sensor: {encoder: absolute, bits: 13, turn_bits: 12, gear: 100}"
    found = ask(tmp_path, sensor, "multi-turn").results
    assert [value(found[name]) for name in ("turns", "bits", "counts")] == [4096, 25, 33554432]
    assert degrees(value(found["range"])) == pytest.approx(4096 * 3.6)


@pytest.mark.parametrize(
    ("sensor", "asked", "sizes"),
    [
        (
            "encoder: absolute, gear: 100",
            ["resolution: 0.001 deg", "range: 270 deg"],
            {"bits": 12, "turn_bits": 7},
        ),
        ("encoder: absolute, gear: 128", ["range: 1 rad"], {"turn_bits": 5}),
        ("encoder: absolute", ["resolution: 2*pi/1024"], {"bits": 10}),
        ("encoder: absolute", ["resolution: 6.2 rad"], {"bits": 1}),
        ("encoder: absolute", ["resolution: 0.0061 rad"], {"bits": 11}),
        ("encoder: incremental, edges: 4, gear: 20", ["resolution: 0.02 deg"], {"lines": 225}),
        ("encoder: incremental, edges: 2", ["resolution: 0.7 deg"], {"lines": 258}),
    ],
)
def test_the_size_that_is_needed(
    tmp_path: Path, sensor: str, asked: list[str], sizes: dict[str, int]
) -> None:
    found = ask(tmp_path, f"sensor: {{{sensor}}}", "encoder-size", *asked).results
    assert {name: round(value(tree)) for name, tree in found.items()} == sizes


@pytest.mark.parametrize(
    ("sensor", "kind", "option", "message"),
    [
        ("encoder: absolute, bits: 12", "gray-code", "position: 4096", "the positions 0 to 4095"),
        ("encoder: absolute, bits: 12", "gray-code", 'code: "010"', "3 digits, and the encoder 12 bits"),
        ("encoder: absolute, bits: 3", "gray-code", 'code: "012"', "the digits 0 and 1"),
        ("encoder: absolute, bits: b", "gray-code", "position: 1", "bits are a number"),
        ("encoder: absolute, bits: 40", "gray-code", "position: 1", "at most 32"),
        ("encoder: absolute, bits: 8, turn_bits: 2", "gray-code", "position: 1", "'turn_bits' is not used"),
        ("encoder: absolute, bits: 8", "multi-turn", "marks: 1", "'turn_bits' is missing"),
        ("encoder: absolute", "resolution", "marks: 1", "'bits' is missing"),
        ("encoder: incremental", "resolution", "marks: 1", "'lines' is missing"),
        ("encoder: incremental, lines: 4", "gray-code", "position: 1", "this is no absolute encoder"),
        ("encoder: absolute", "encoder-size", "resolution: -1 deg", "must be positive"),
        ("encoder: absolute", "encoder-size", "resolution: a", "takes numbers"),
        ("encoder: incremental", "encoder-size", "range: 1", "counts its turns by itself"),
        ("encoder: absolute, bits: 3", "encoder-size", "range: 1", "'bits' is not used"),
    ],
)
def test_what_no_encoder_answers(tmp_path: Path, sensor: str, kind: str, option: str, message: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        ask(tmp_path, f"sensor: {{{sensor}}}", kind, option)
    assert any(message in each.message for each in caught.value.errors)
