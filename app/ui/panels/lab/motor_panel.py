"""The tab `Motor`: move it, record it, and find its model; or bring a recording of a real one."""

from __future__ import annotations

import html

import numpy as np
import viser

from app.control.drives import DRIVES
from app.control.identification.excitation import EXCITATIONS
from app.control.identification.recordings import write_recording
from app.control.motor import Motor
from app.ui import theme
from app.ui.downloads import send
from app.ui.lab.motor_desk import MotorDesk, TestSettings
from app.ui.lab.motor_jobs import Identified, thinned
from app.ui.panels.lab.metrics_table import shown
from app.ui.panels.motion.knob import Knob
from app.ui.panels.text import small
from app.ui.plots import Axes, Curve, Plot, csv_table
from app.ui.refusal import Refusal
from app.ui.viser_adapter import show_value

POINTS = 400
NOISE = "Standard deviation, deg or mm"
TITLES = {excitation.title: name for name, excitation in EXCITATIONS.items()}


class MotorPanel:
    """Excitation, recording, result."""

    def __init__(self, client: viser.ClientHandle, desk: MotorDesk) -> None:
        self._client = client
        self._desk = desk
        gui = client.gui
        self._about = gui.add_html(small("Move the motor, record it, and let the output-error method find its model."))
        self._add_test(gui)
        self._bar = gui.add_progress_bar(100.0, animated=True, visible=False)
        self._answer = gui.add_html("")
        self._use = gui.add_button("Use this motor", icon=viser.Icon.CHECK, visible=False)
        self._save = gui.add_button("Save recording as CSV", icon=viser.Icon.DOWNLOAD, color="gray", visible=False)
        self._save_fit = gui.add_button("Save fit as CSV", icon=viser.Icon.DOWNLOAD, color="gray", visible=False)
        self._plots = MotorPlots(gui)
        self._listen_to_test()
        self._listen_to_result()
        desk.settings_changed.connect(self._follow)
        desk.busy_changed.connect(lambda busy: setattr(self._bar, "visible", busy))
        desk.answered.connect(self._receive)
        self._follow(desk.settings)
        if desk.result is not None:
            self._receive(desk.result)

    def _add_test(self, gui: viser.GuiApi) -> None:
        excitation = EXCITATIONS[self._desk.settings.excitation]
        self._excitation = gui.add_dropdown("Signal", tuple(TITLES), initial_value=excitation.title)
        self._explanation = gui.add_html(small(html.escape(excitation.explanation)))
        self._knobs = [
            Knob(gui, "Voltage (V)", (0.5, 48.0, 0.5), "amplitude_v", 1.0, self._desk.change),
            Knob(gui, "Duration (s)", (2.0, 120.0, 1.0), "duration_s", 1.0, self._desk.change),
            Knob(gui, "Sensor noise", (0.0, 2.0, 0.05), "noise", 1.0, self._desk.change, NOISE),
        ]
        self._record = gui.add_button("Record and identify", icon=viser.Icon.PLAYER_RECORD)
        self._upload = gui.add_upload_button("Read a CSV file", icon=viser.Icon.UPLOAD, mime_type=".csv,.txt,text/csv")

    def _listen_to_test(self) -> None:
        desk = self._desk

        @self._excitation.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.change(excitation=TITLES[event.target.value])

        @self._record.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            desk.record()

        @self._upload.on_upload
        async def _(event: viser.GuiEvent[viser.GuiUploadButtonHandle]) -> None:
            desk.read(event.target.value.name, event.target.value.content)

    def _listen_to_result(self) -> None:
        desk = self._desk

        @self._use.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            desk.use()

        @self._save.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            if desk.result is not None:
                send(self._client, "recording.csv", write_recording(desk.result.recording).encode())

        @self._save_fit.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            if desk.result is not None:
                send(self._client, "fit.csv", fit_csv(desk.result).encode())

    def _follow(self, test: TestSettings) -> None:
        excitation = EXCITATIONS[test.excitation]
        show_value(self._excitation, excitation.title)
        explanation = small(html.escape(excitation.explanation))
        if explanation != self._explanation.content:
            self._explanation.content = explanation
        for knob in self._knobs:
            knob.show(getattr(test, knob.name))
        for element in (self._use, self._save, self._save_fit):
            if self._desk.result is None and element.visible:  # that was another robot's motor
                element.visible = False

    def _receive(self, result: Identified | Refusal) -> None:
        if isinstance(result, Refusal):
            color = theme.css(theme.WARNING)
            self._answer.content = small(f'<b style="color:{color}">▲ {html.escape(result.reason)}</b>')
            return
        self._use.visible = self._save.visible = self._save_fit.visible = True
        self._answer.content = result_table(result, DRIVES[self._desk.known].motor)
        self._plots.show(result)


class MotorPlots:
    """Input, output beside the model's, and what is left between them."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._unit = "deg"
        measured = Curve("measured", theme.REFERENCE, 1.5)
        model = Curve("model", theme.ACTUAL, 2.0)
        self._output = Plot(gui, self._axes("Position"), (measured, model), "Output", 220)
        residual = Curve("model minus measured", theme.MARK, 1.0)
        self._left = Plot(gui, self._axes("Residual"), (residual,), "Residual", 170)
        volts = Axes("Time (s)", "Voltage (V)")
        self._input = Plot(gui, volts, (Curve("voltage", theme.LEGS[0], 1.5),), "Input", 150)

    def show(self, result: Identified) -> None:
        recording, found = result.recording, result.found
        if recording.unit != self._unit:
            self._unit = recording.unit
            self._output.rename(self._axes("Position"))
            self._left.rename(self._axes("Residual"))
        chosen = thinned(recording, POINTS)
        t = found.t[chosen]
        measured = found.model_output - found.residuals
        self._output.show(t, measured[chosen], found.model_output[chosen])
        self._left.show(t, found.residuals[chosen])
        self._input.show(t, np.interp(t, recording.t, recording.u))

    def _axes(self, name: str) -> Axes:
        return Axes("Time (s)", f"{name} ({self._unit})")


def fit_csv(result: Identified) -> str:
    """Measured output, the model's, and the residual, at full rate."""
    found, unit = result.found, result.recording.unit
    head = ["t_s", f"measured_{unit}", f"model_{unit}", f"residual_{unit}"]
    measured = found.model_output - found.residuals
    return csv_table(head, np.column_stack([found.t, measured, found.model_output, found.residuals]))


def result_table(result: Identified, known: Motor) -> str:
    """HTML: each parameter with its 95 % interval, beside the value the lab started with."""
    found = result.found
    units = (f"{found.motor.unit}/(V s²)", "1/s", "1/s²")
    rows = "".join(
        f"<tr><td>{name} <span style='opacity:.65'>{unit}</span></td>"
        f'<td style="text-align:right"><b>{shown(getattr(found.motor, name))}</b></td>'
        f'<td style="text-align:right">{shown(low)} … {shown(high)}</td>'
        f'<td style="text-align:right">{shown(getattr(known, name))}</td></tr>'
        for name, unit, (low, high) in zip(("K", "T1", "T2"), units, found.confidence.tolist(), strict=True)
    )
    warnings = "".join(f"<div>▲ {html.escape(warning)}</div>" for warning in found.warnings)
    return (
        '<div style="padding:4px 12px 8px;font-size:0.82em"><b>'
        f"{html.escape(result.source)}: fit {found.fit_percent:.2f} %</b>"
        '<table style="width:100%;border-collapse:collapse;line-height:1.6;font-variant-numeric:tabular-nums">'
        '<tr><th></th><th style="text-align:right">found</th><th style="text-align:right">95 % interval</th>'
        f'<th style="text-align:right">known</th></tr>{rows}</table>{warnings}</div>'
    )
