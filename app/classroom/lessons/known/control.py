"""The control lab: one drive and its controller, its step response, the robot's runs, the motor's identification.

A step response is there once it belongs to the present settings; until then its facts have no value. Facts of runs are
those of the run that is shown, and say how that was set.
"""

from __future__ import annotations

from app.classroom.lessons.known.kind import FactKind, Facts, choice, flag, number, setting, switch, word

TUNINGS = (
    "By hand",
    "Paper, Table 2 (MATLAB)",
    "Paper, Table 3 (reaction curve)",
    "Tuner: two sliders",
    "Reaction curve (Par4 paper)",
    "Ziegler-Nichols",
    "Cohen-Coon",
    "CHR, set-point, 0 %",
    "CHR, set-point, 20 %",
    "CHR, disturbance",
    "Lambda (IMC)",
    "SIMC",
    "SIMC, PI only",
    "Relay test, Ziegler-Nichols",
    "Relay test, Tyreus-Luyben",
)
PATHS = ("circle", "square", "lemniscate", "point-to-point")
STARTS = ("rest", "reference", "smooth")

SETTINGS: dict[str, FactKind] = {
    "kp": setting("Proportional gain, V per deg (mm on linear); setting a gain makes tuning `By hand`"),
    "ki": setting("Integral gain, V per deg s"),
    "kd": setting("Derivative gain, V s per deg"),
    "n": setting("Cut-off of the derivative's filter; inf for none", "rad/s"),
    "setpoint_weight": setting("Weight b of the set-point in the proportional part"),
    "derivative_on_measurement": switch("Whether the set-point is left out of the derivative"),
    "tuning": choice("How the gains are found", *TUNINGS),
    "response_time": setting("Of the tuner: 2 / crossover", "s"),
    "transient": setting("Of the tuner: 0 quick, 1 calm"),
    "period": setting("Between two looks of the controller at the sensor", "ms"),
    "method": choice("How the controller is made discrete", "backward Euler", "Tustin"),
    "anti_windup": choice("What keeps the integral from growing at the limit", "none", "clamping", "back-calculation"),
    "supply": setting("Largest voltage; inf for no limit", "V"),
    "pwm_steps": setting("Steps of the pulse width; 0 for none"),
    "adc_bits": setting("Bits of the position reading; 0 for a perfect one"),
    "noise": setting("Standard deviation of the reading", "deg", "mm"),
    "delay": setting("From computed to applied voltage", "ms"),
    "dry_friction": setting("Voltage at which the motor begins to turn", "V"),
    "viscous": setting("Viscous friction, added to the motor's own damping", "1/s"),
    "inertia": setting("Inertia, in times the usual"),
    "backlash": setting("Play between motor and joint", "deg", "mm"),
    "setpoint": setting("Height of the step", "deg", "mm"),
    "duration": setting("Length of the step experiment", "s"),
}

STEP: dict[str, FactKind] = {
    "overshoot": number("Beyond the set-point", "%"),
    "rise": number("From 10 to 90 % of the step", "s"),
    "settling": number("Until the output stays within 2 % of the step", "s"),
    "peak": number("Highest output", "deg", "mm"),
    "peak_time": number("When the output is highest", "s"),
    "steady_error": number("Set-point minus output at the end, of the step", "%"),
    "ise": number("Integral of the squared error", "deg^2 s", "mm^2 s"),
    "iae": number("Integral of the absolute error", "deg s", "mm s"),
    "peak_control": number("Largest voltage of the controller", "V"),
    "ripple": number("Standard deviation of the voltage in the last fifth: how nervous the motor is", "V"),
    "energy": number("Integral of the squared voltage", "V^2 s"),
    "saturation": number("Share of the time at the supply's limit", "%"),
}

MARGINS: dict[str, FactKind] = {
    "phase": number("Phase margin", "deg"),
    "gain": number("Gain margin; inf where there is none", "dB"),
    "crossover": number("Frequency at which the open loop has gain 1", "rad/s"),
    "dead_time": number("Delay that the loop still bears", "ms"),
    "Ms": number("Largest sensitivity"),
    "bandwidth": number("Of the closed loop", "rad/s"),
    "stable": flag("Whether every closed-loop pole decays"),
}


def _of_run(what: str) -> dict[str, FactKind]:
    return {
        "ise": number(f"Integral of the squared error of all joints, of {what}", "deg^2 s", "mm^2 s"),
        "ise.*": number(f"The same of one joint of {what}: ise.q1", "deg^2 s", "mm^2 s"),
        "jump_share": number(f"Share of that ISE in the first second of {what}", "%"),
        "late_ise": number(f"ISE after the first 5 s of {what}", "deg^2 s", "mm^2 s"),
        "tool_rms": number(f"Error of the tool in {what}", "mm"),
        "tool_peak": number(f"Largest error of the tool in {what}", "mm"),
        "saturation": number(f"Share of all voltages at their limit, of {what}", "%"),
        "used_tuning": word(f"Tuning of {what}", *TUNINGS),
        "used_start": word(f"Start of {what}", *STARTS),
        "used_path": word(f"Path of {what}", *PATHS),
        "used_supply": number(f"Supply's limit in {what}; inf for none", "V"),
        "used_as_in_paper": flag(f"Whether the paper's own simulation made {what}"),
    }


RUN: dict[str, FactKind] = {
    "path": choice("What the next run follows", *PATHS),
    "size": setting("Radius of the circle around the path", "mm"),
    "lap": setting("Time of a lap", "s"),
    "start": choice("How a run begins", *STARTS),
    "clockwise": switch("Seen from above"),
    "as_in_paper": switch("The paper's own simulation (Par4)"),
    "count": setting("Runs that are kept; setting it to 0 forgets them"),
    **_of_run("the run that is shown"),
}

MOTOR: Facts = {
    "motor.K": number("Gain of the motor in use", "deg/(V s^2)", "mm/(V s^2)"),
    "motor.T1": number("Its damping", "1/s"),
    "motor.T2": number("Its droop", "1/s^2"),
    "motor.time_constant": number("1 / T1", "s"),
    "motor.identified": flag("Whether it was identified by the student"),
    "identify.signal": choice("Voltage that moves the motor", "step", "square", "prbs", "steps", "pulses"),
    "identify.voltage": setting("Its height", "V"),
    "identify.duration": setting("Length of the recording", "s"),
    "identify.noise": setting("Standard deviation of the reading", "deg", "mm"),
    "found.K": number("Gain that was found with this signal, voltage, duration and noise", "deg/(V s^2)", "mm/(V s^2)"),
    "found.T1": number("Damping that was found", "1/s"),
    "found.T2": number("Droop that was found", "1/s^2"),
    "found.fit": number("How well the model follows the recording", "%"),
    "found.error_K": number("Distance of K from the known value", "%"),
    "found.error_T1": number("Distance of T1 from the known value", "%"),
    "found.error_T2": number("Distance of T2 from the known value (no value without droop)", "%"),
    "found.width_K": number("Width of the 95 % interval of K, of K", "%"),
    "found.width_T1": number("Width of the 95 % interval of T1, of T1", "%"),
    "found.swing": number("Largest position in the recording", "deg", "mm"),
    "found.count": setting("Identifications made with this robot; setting it to 0 forgets them"),
    "found.warnings": number("Number of warnings about the recording"),
}


def _named(prefix: str, facts: Facts, *, read_only: bool = False) -> dict[str, FactKind]:
    if read_only:
        facts = {
            name: FactKind(f"{kind.text}, of the baseline that was kept", kind.kind, kind.unit, kind.other_units)
            for name, kind in facts.items()
        }
    return {f"{prefix}.{name}": kind for name, kind in facts.items()}


CONTROL: Facts = {
    **_named("control", SETTINGS),
    "control.refused": flag("Whether the tuning method does not apply"),
    **_named("step", STEP),
    **_named("ideal", STEP),
    **_named("margin", MARGINS),
    "kept.on": switch("Whether a baseline is kept; setting it keeps the present one, or forgets it"),
    **_named("kept", {**SETTINGS, **STEP, **MARGINS}, read_only=True),
    **_named("run", RUN),
    **_named("before", _of_run("the run before")),
    **MOTOR,
}

CONTROL_PRESSES = {
    "keep": "Keep the present step response as baseline.",
    "forget": "Forget the baseline.",
    "reset_control": "The button Reset the lab.",
    "run": "Run on the robot, as it is set.",
    "forget_runs": "Forget all runs.",
    "identify": "Record the motor and identify it.",
    "use_motor": "Use the motor that was identified.",
}
