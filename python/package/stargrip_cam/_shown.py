"""Answers in a notebook: small tables, and the preview of a build."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from stargrip_cam import ActuatorPrediction, Build, DrawnPrediction, Prediction


def _table(rows: Iterable[tuple[str, ...]], head: tuple[str, ...]) -> str:
    def line(cells: tuple[str, ...], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag} style='text-align:left'>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return "<table>" + line(head, "th") + "".join(line(row, "td") for row in rows) + "</table>"


def _number(value: Any) -> str:
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def _range(value: Any) -> str:
    return "unknown" if value is None else f"{_number(value[0])} to {_number(value[1])}"


def prediction(of: Prediction | DrawnPrediction | ActuatorPrediction) -> str:
    """The verdict, every plain number with its range, if any, then reasons and warnings."""
    said = of.to_dict()
    ranges = said.get("ranges", {})
    rows = [
        (name, _number(value), _range(ranges[name]) if name in ranges else "")
        for name, value in said.items()
        if isinstance(value, (int, float, str)) and not isinstance(value, bool)
    ]
    verdict = said.get("verdict") or {}
    if verdict:
        rows.insert(0, ("verdict.holds", verdict["holds"], ""))
    remarks = [*verdict.get("reasons", []), *said.get("evidence", {}).get("warnings", [])]
    listed = "".join(f"<li>{escape(remark)}</li>" for remark in remarks)
    return _table(rows, ("", "value", "range")) + (f"<ul>{listed}</ul>" if listed else "")


def build(of: Build) -> str:
    """The preview, if it was built, and the files."""
    files = of.files
    rows = [(name, f"{len(content):,}") for name, content in files.items()]
    return (of._repr_svg_() or "") + _table(rows, ("file", "bytes"))
