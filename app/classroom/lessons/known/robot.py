"""The robot on the page: which, where it stands, what is shown."""

from __future__ import annotations

from app.classroom.lessons.known.kind import Facts, choice, flag, number, setting, switch, word

ROBOT: Facts = {
    "robot": choice(
        "The robot; setting it brings its usual dimensions, at home", "par4", "delta3", "linear", "fivebar"
    ),
    "preset": choice(
        "Named set of dimensions, `changed` for others", "paper", "desk_A4", "classic", "thesis", "changed"
    ),
    "geometry.*": setting("A dimension by its symbol, say geometry.L or geometry.theta_max", "mm", "deg"),
    "pose.x": setting("Where the tool stands", "mm"),
    "pose.y": setting("Where the tool stands", "mm"),
    "pose.z": setting("Where the tool stands; negative below the base", "mm"),
    "pose.theta": setting("Turn of the Par4's tool", "deg"),
    "pose.phi": setting("Turn of the five-bar's tool", "deg"),
    "pose.radius": number("Distance of the tool from the z axis", "mm"),
    "wish.x": setting("Where the gizmo is held; equals the pose once it is let go, and in reach", "mm"),
    "wish.y": setting("Where the gizmo is held", "mm"),
    "wish.z": setting("Where the gizmo is held", "mm"),
    "wish.theta": setting("Turn at which the Par4's gizmo is held", "deg"),
    "wish.phi": setting("Turn at which the five-bar's gizmo is held", "deg"),
    "joint.*": setting("A joint by its name: joint.q1 (deg), or joint.d1 (mm) of linear", "deg", "mm"),
    "reach.ok": flag("Whether the last wish, typed pose or set of joints could be reached"),
    "reach.kind": word(
        "What kind of limit that is",
        "in reach",
        "arm stop",
        "too short",
        "too long",
        "turn",
        "singular",
        "floor",
        "rods too flat",
        "no assembly",
        "other",
    ),
    "reach.reason": word("Why not, in a sentence; empty in reach"),
    "reach.leg": number("The leg that stops the robot, from 1; 0 for none"),
    "conditioning": number("1 where the robot moves equally well in all directions, inf at a singularity"),
    "solutions.elbows": number("Number of elbow solutions of the pose, the present one included"),
    "solutions.assemblies": number("Number of assembly modes of the joints, the present one included"),
    "view.workspace": choice("How the workspace is shown", "Off", "Surface", "Cloud"),
    "view.workspace_angle": setting("Turn of the tool at which the workspace is cut", "deg"),
    "view.vectors": setting("Leg whose loop is drawn as vectors, from 1; 0 for none"),
    "view.frames": switch("Frames at the joints"),
    "view.trace": switch("Trace of the tool"),
    "view.elbows": switch("Ghosts of the other elbow solutions"),
    "view.assemblies": switch("Ghosts of the other assembly modes"),
    "tab": choice("The tab in front", "Robot", "Control", "Motion", "Draw", "Hardware", "View"),
}

ROBOT_PRESSES = {
    "home": "The button Home: the robot goes to the middle of its reach.",
    "release": "Let the gizmo go: it returns to the robot.",
    "reset_geometry": "The button Reset geometry.",
}
