"""Motions, the five-bar's work cycle, maps, and controllers compared.

What is computed is there once it belongs to the present settings; until then its facts have no value.
"""

from __future__ import annotations

from app.classroom.lessons.known.kind import Facts, choice, flag, number, setting, switch, word

CURVES = ("line", "circle", "helix", "lemniscate", "arch", "polygon")
PROFILES = ("cubic", "quintic", "trapezoidal", "jerk-limited", "sin2", "time-optimal")
LAWS = ("PD", "PID", "PD+", "PDff", "CTC", "CTC+DOB", "MPC", "SMC", "TSIDC", "TSIIDC")
QUANTITIES = ("torque share", "available", "joint torque", "joint speed", "conditioning")

MOTION: Facts = {
    "motion.curve": choice("What the tool follows", *CURVES),
    "motion.profile": choice("How it speeds up and slows down", *PROFILES),
    "motion.size": setting("Radius of the curve, seen from above", "mm"),
    "motion.height": setting("Rise of a line or helix, lift of an arch", "mm"),
    "motion.lower": setting("The curve's middle below home", "mm"),
    "motion.turns": setting("Of a helix"),
    "motion.sides": setting("Corners of a polygon"),
    "motion.laps": setting("Rounds of a closed curve"),
    "motion.turn": setting("Turn of the tool along the curve", "deg"),
    "motion.fastest": switch("As short as the limits allow"),
    "motion.duration": setting("How long it takes; setting it ends `fastest`", "s"),
    "motion.payload": setting("Carried mass", "kg"),
    "motion.speed_share": setting("Of the drives' speed that may be used", "%"),
    "motion.acceleration_share": setting("Of their acceleration", "%"),
    "motion.effort_share": setting("Of their torque or force", "%"),
    "motion.planned": flag("Whether there is a plan for what is set"),
    "motion.refused": flag("Whether what is set cannot be"),
    "motion.refusal": word("Why not, in a sentence"),
    "motion.usage": number("Largest share of any limit that the motion keeps to", "%"),
    "motion.limit_kind": word("What comes nearest to its limit", "speed", "acceleration", "effort"),
    "motion.limit_joint": word("Whose limit that is, say q1"),
    "motion.tool_speed": number("Largest speed of the tool", "mm/s"),
    "motion.tool_acceleration": number("Largest acceleration of the tool", "m/s^2"),
    "motion.peak_speed.*": number("Largest speed of a joint: motion.peak_speed.q1", "deg/s", "mm/s"),
    "motion.peak_acceleration.*": number("Largest acceleration of a joint", "deg/s^2", "mm/s^2"),
    "motion.peak_effort.*": number("Largest torque or force of a joint", "N m", "N"),
    "motion.speed_usage.*": number("Share of one joint's speed limit: motion.speed_usage.q3", "%"),
    "motion.speed_usage": number("Largest share of the speed limits", "%"),
    "motion.acceleration_usage": number("Largest share of the acceleration limits", "%"),
    "motion.effort_usage": number("Largest share of the torque or force limits", "%"),
    "motion.playing": flag("Whether the robot moves along it"),
    "motion.played": number("Share of the motion that was played", "%"),
    "cycle.on": switch("Show the work cycle between two belts (fivebar)"),
    "cycle.name": choice("Reference cycle, `changed` for another", "W1", "W2", "changed"),
    "cycle.belt_speed": setting("Of both belts", "mm/s"),
    "cycle.stroke": setting("How far the tool goes down", "mm"),
    "cycle.period": setting("One item each period", "s"),
    "cycle.transfer": setting("From belt to belt", "s"),
    "cycle.pick_x": setting("Where items are taken", "mm"),
    "cycle.place_x": setting("Where they are placed", "mm"),
    "cycle.turn": setting("By which an item is turned", "deg"),
    "cycle.payload": setting("Mass of an item", "kg"),
    "cycle.enforce_speed": switch("Refuse a cycle in which a motor would turn too fast"),
}

MAP: Facts = {
    "map.on": switch("Whether a map of the workspace is shown"),
    "map.quantity": choice("What it shows", *QUANTITIES),
    "map.height": setting("z of the slice", "mm"),
    "map.angle": setting("Turn of the tool in the slice", "deg"),
    "map.acceleration": setting("Of the tool", "m/s^2"),
    "map.speed": setting("Of the tool", "m/s"),
    "map.payload": setting("Carried mass", "kg"),
    "map.joint": setting("Whose torque, from 1"),
    "map.ready": flag("Whether the map is there"),
    "map.at_tool": number("Its value at the tool, in the map's own unit"),
    "map.lowest": number("Smallest value of the slice, in the map's own unit"),
    "map.highest": number("Largest value of the slice, in the map's own unit"),
    "map.beyond": number("Share of the slice in which a drive is over its limit", "%"),
}

COMPARE: Facts = {
    "compare.task": choice("What the robot does", "T1", "T2", "W1", "W2", "planned"),
    "compare.laws": choice(f"Controllers with commas, say `PD, PID, CTC`; there are {', '.join(LAWS)}"),
    "compare.gains": choice("Where gains come from", "standard", "equal", "own"),
    "compare.own_hz.*": setting("Bandwidth of one law, with `own`: compare.own_hz.PD", "Hz"),
    "compare.bandwidth": setting("Of all laws, where it is equal", "Hz"),
    "compare.friction": setting("In times the declared friction"),
    "compare.payload": setting("Load that the controllers do not know of", "kg"),
    "compare.model_error": setting("Of the masses in the controllers' model", "%"),
    "compare.encoder_step": setting("Smallest step that a joint's sensor sees; 0 for ideal", "mrad", "mm"),
    "compare.delay": setting("In samples"),
    "compare.filter": setting("Of the measured speed; 0 for ideal", "Hz"),
    "compare.limit_effort": switch("Torque limits"),
    "compare.limit_speed": switch("Speed limits"),
    "compare.plant": choice("What stands in for the real robot", "exact", "mujoco"),
    "compare.quantity": choice("What the results are looked at in: position, in plane, x, y, z, θ or φ"),
    "compare.stretch": choice("Which part of the runs is looked at", "Whole run", "After 1 s", "First 1 s"),
    "compare.looked_best": word("The best law for what is looked at", *LAWS),
    "compare.count": setting("Laws that have answered, with what is set now; setting it to 0 forgets them"),
    "compare.rms.*": number("RMS error of the tool under a law: compare.rms.PD+", "mm"),
    "compare.peak.*": number("Largest error of the tool under a law", "mm"),
    "compare.later_rms.*": number("RMS error of the tool after the first second", "mm"),
    "compare.later_peak.*": number("Largest error of the tool after the first second", "mm"),
    "compare.plane_rms.*": number("RMS error in the horizontal plane", "mm"),
    "compare.z_rms.*": number("RMS error in height", "mm"),
    "compare.later_plane_rms.*": number("RMS error in the plane after the first second", "mm"),
    "compare.later_z_rms.*": number("RMS error in height after the first second", "mm"),
    "compare.turn_rms.*": number("RMS error of the tool's turn", "mrad"),
    "compare.effort_peak.*": number("Largest torque, of its limit", "%"),
    "compare.saturation.*": number("Share of the time that the worst joint stands at its limit", "%"),
    "compare.place.*": number("Place of a law by its RMS error, from 1"),
    "compare.later_place.*": number("The same after the first second"),
    "compare.best": word("Law with the smallest RMS error", *LAWS),
    "compare.later_best": word("The same after the first second", *LAWS),
    "compare_before.rms.*": number("RMS error of the tool in the comparison before", "mm"),
    "compare_before.later_rms.*": number("The same after the first second", "mm"),
    "compare_before.place.*": number("Place of a law in the comparison before"),
}

MOTION_PRESSES = {
    "plan": "Wait until the motion or the work cycle is planned.",
    "play": "Play the motion to its end.",
    "reset_motion": "The button Reset the motion.",
    "compare": "Compare the controllers, as it is set.",
}
