"""A class that a module's tests share: each has students of its own."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.support.class_lab import ClassLab, class_lab


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ClassLab]:
    with class_lab(tmp_path_factory.mktemp("class")) as running:
        yield running
