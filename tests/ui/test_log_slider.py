"""A gain on a logarithmic scale: typed and pulled, over the wire of a small server."""

from __future__ import annotations

import pytest

from app.ui.panels.lab.log_slider import LogSlider
from tests.support.small_lab import SmallLab, eventually, guarded_lab
from tests.support.wire import WireClient, run_async


@pytest.fixture
def lab():
    with guarded_lab() as running:
        yield running


async def furnished(lab: SmallLab, client: WireClient) -> tuple[LogSlider, list[float]]:
    heard: list[float] = []
    slider = LogSlider(lab.client_of(client).gui, "kp", 4.3621, (-2, 2), heard.append)
    await client.wait_for(lambda: client.has("kp, slider"), "slider")
    return slider, heard


def test_typing_moves_the_slider_and_pulling_changes_the_number(lab: SmallLab):
    async def scene() -> None:
        async with lab.visit() as client:
            slider, heard = await furnished(lab, client)
            assert client.value_of("kp") == 4.3621 and client.value_of("kp, slider") == 106
            await client.set_value("kp", 1.0)
            await client.wait_for(lambda: client.value_of("kp, slider") == 80, "slider at 1")
            await client.set_value("kp, slider", 120)
            await client.wait_for(lambda: client.value_of("kp") == 10.0, "number 10")
            await client.set_value("kp, slider", 0)
            await client.wait_for(lambda: client.value_of("kp") == 0.0, "nothing at the lowest end")
            await eventually(lambda: heard == [1.0, 10.0, 0.0], "every change once")
            slider.show(0.123456789)
            await client.wait_for(lambda: client.value_of("kp") == 0.123457, "a computed gain")
            assert heard == [1.0, 10.0, 0.0], "what was shown is not heard"

    run_async(scene())


def test_a_value_beyond_the_scale_stands_at_its_end(lab: SmallLab):
    async def scene() -> None:
        async with lab.visit() as client:
            slider, _ = await furnished(lab, client)
            slider.show(500.0)
            await client.wait_for(lambda: client.value_of("kp, slider") == 160, "upper end")
            slider.show(1e-5)
            await client.wait_for(lambda: client.value_of("kp, slider") == 0, "lower end")
            await client.set_value("kp", -3.0)
            await client.set_value("kp", 2.0)
            await client.wait_for(lambda: client.value_of("kp, slider") == 92, "a value that is taken")

    run_async(scene())
