"""Docstrings and stubs for `help()` and editors: meanings, keywords, types."""

from __future__ import annotations

import importlib.util
import inspect
import pydoc
from pathlib import Path
from typing import Any

import pytest

import stargrip_cam as sg

HERE = Path(__file__).resolve().parents[1]
CLASSES = [getattr(sg, name) for name in sg.__all__ if inspect.isclass(getattr(sg, name))]
FUNCTIONS = [getattr(sg, name) for name in sg.__all__ if inspect.isroutine(getattr(sg, name))]


def test_the_stubs_have_the_docstrings_of_the_compiled_code() -> None:
    found = importlib.util.spec_from_file_location("stubs", HERE / "stubs.py")
    assert found is not None and found.loader is not None
    stubs = importlib.util.module_from_spec(found)
    found.loader.exec_module(stubs)
    kept = (HERE / "package" / "stargrip_cam" / "_native.pyi").read_text()
    assert stubs.text(kept) == kept, "run `python python/stubs.py` with the package installed"


@pytest.mark.parametrize("of", CLASSES, ids=lambda of: of.__name__)
def test_every_attribute_of_a_class_has_its_meaning(of: Any) -> None:
    assert len(inspect.getdoc(of) or "") > 20
    public = [name for name in vars(of) if not name.startswith("_")]
    for name in public:
        value = inspect.getattr_static(of, name)
        # Fields of dataclasses are documented in their source only.
        assert value is None or len(inspect.getdoc(value) or "") > 5, f"{of.__name__}.{name}"
    page = pydoc.render_doc(of, renderer=pydoc.plaintext)
    assert all(name in page for name in public)


def test_help_of_a_prediction_says_what_its_numbers_are() -> None:
    page = pydoc.render_doc(sg.Prediction, renderer=pydoc.plaintext)
    assert "Inner radius of the inflated, empty star, mm" in page and "final_radius_mm" in page


@pytest.mark.parametrize("of", FUNCTIONS, ids=lambda of: of.__name__)
def test_every_keyword_shows_and_is_explained(of: Any) -> None:
    doc, names = inspect.getdoc(of) or "", list(inspect.signature(of).parameters)
    assert "question" not in names and "kwargs" not in names and (names or of is sg.machines)
    if of is not sg.verify:
        assert all(name in doc for name in names), names


def test_keywords_are_the_options_of_the_commands() -> None:
    spec = sg.Spec.starter("x")
    shown = {of: set(inspect.signature(of).parameters) - {"spec", "progress"} for of in (sg.optimize, sg.actuator)}
    for of, arguments in ((sg.optimize, [spec]), (sg.actuator, [])):
        with pytest.raises(TypeError) as caught:
            of(*arguments, zzz=1)  # type: ignore[operator]
        allowed = str(caught.value).split("Allowed are ")[1].split(", ")
        assert set(allowed) == shown[of]


def test_the_package_lists_its_own_names_only() -> None:
    assert "annotations" not in dir(sg) and set(sg.__all__) <= set(dir(sg))
