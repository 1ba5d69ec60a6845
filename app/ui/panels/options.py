"""Other options for a dropdown that stands."""

from __future__ import annotations

from collections.abc import Sequence

import viser

from app.ui.viser_adapter import show_value


def show_options(dropdown: viser.GuiDropdownHandle[str], options: Sequence[str], value: str) -> None:
    """Offer these options with `value` chosen, without calling the dropdown's listeners.

    viser chooses, aloud, the first option when the old one is gone; so it goes last.
    """
    if tuple(options) != dropdown.options:
        dropdown.options = tuple(dict.fromkeys((*options, dropdown.value)))
        show_value(dropdown, value)
        dropdown.options = tuple(options)
    show_value(dropdown, value)
