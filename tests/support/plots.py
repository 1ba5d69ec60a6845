"""What a chart on the page really holds, read from uPlot itself."""

from __future__ import annotations

import math

from playwright.sync_api import Page

_READ = """(title) => {
  for (const {chart} of Object.values(window.__viserTestpoints.uplots ?? {})) {
    if (chart.root.querySelector(".u-title")?.textContent !== title) continue;
    const labels = chart.series.map(s => s.label);
    return {
      labels, data: chart.data.map(a => Array.from(a, v => Number.isFinite(v) ? v : null)),
      axes: chart.axes.map(a => a.label), scale: [chart.scales.y.min, chart.scales.y.max],
      shown: [...chart.root.querySelectorAll(".u-legend .u-series")]
        .filter(e => getComputedStyle(e).display !== "none").map(e => e.textContent),
    };
  }
  return null;
}"""


class Chart:
    """A snapshot of one chart."""

    def __init__(self, found: dict) -> None:
        self.axes: list[str] = found["axes"]
        self.legend: list[str] = [entry for entry in found["shown"] if entry]
        self.scale: list[float] = found["scale"]
        columns = [[math.nan if value is None else value for value in column] for column in found["data"]]
        self.x = columns[0]
        self.curves = dict(zip(found["labels"][1:], columns[1:], strict=True))

    def last(self, curve: str) -> float:
        return self.curves[curve][-1]


def chart(page: Page, title: str) -> Chart | None:
    """The chart with this title; None where it is not on the page, or its tab is not open."""
    found = page.evaluate(_READ, title)
    return found and Chart(found)
