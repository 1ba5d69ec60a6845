"""The robot on the table, real or emulated."""

from __future__ import annotations

from app.classroom.lessons.known.kind import Facts, flag, number, setting, switch, word

STATES = ("none", "off", "ready", "moving", "homing", "testing", "held", "stopped", "fault")
FAULTS = ("none", "estop", "limit", "sensor", "following", "homing", "switch", "watchdog")
ACTIVITIES = ("idle", "jog", "step", "mirror", "run", "paused", "test")

LINK: Facts = {
    "link.phase": word("Of the connection", "none", "connecting", "ready", "lost", "refused"),
    "link.connected": flag("Whether a board is connected"),
    "link.emulated": flag("Whether that board is an emulated one"),
    "link.robot": word("Its robot", "par4", "delta3", "linear", "fivebar"),
    "link.same_robot": flag("Whether the page shows the same robot with the same dimensions"),
    "link.state": word("What the board is doing; none without a board", *STATES),
    "link.enabled": flag("Whether the motors have power"),
    "link.homed": flag("Whether it was homed on this connection"),
    "link.stopped": flag("Whether somebody pressed Stop, and nobody Clear yet"),
    "link.held": flag("Whether it holds because set-points stopped coming"),
    "link.fault": word("Why the motors were switched off", *FAULTS),
    "link.holder": word("Who has the robot", "me", "other", "none"),
    "link.place": number("My place in the queue, from 1; 0 without one"),
    "link.activity": word("What the robot is moved for", *ACTIVITIES),
    "link.progress": number("Of the program that runs", "%"),
    "link.finished": switch("Whether a program that was begun on this page ran to its end; set it false to begin anew"),
    "link.drawn": switch(
        "Whether a drawing that was begun on this page was drawn to its end; set it false to begin anew"
    ),
    "link.jogged": setting(
        "Farthest that its holder on this page moved the tool from where it was; set it 0 to begin anew", "mm"
    ),
    "link.frames_ok": number("Good frames that the board counts, up to 65535"),
    "link.frames_bad": number("Damaged frames that the board counts, up to 65535"),
    "link.round_trip": number("From a set-point to the answer that names it, median", "ms"),
    "link.board_load": number("Of the board's processor", "%"),
    "link.pose_error": number("Distance of the tool from its set-point", "mm"),
    "link.pose.*": number("Where its sensors see the tool: link.pose.x, link.pose.theta", "mm", "deg"),
    "link.joint.*": number("Where its sensors see a joint: link.joint.q1", "deg", "mm"),
    "link.override": setting("Speed override", "%"),
    "link.recording": flag("Whether a recording runs"),
    "link.recorded": number("Length of the newest recording; 0 for none", "s"),
    "twin.lag": number("By which the robot was later than its simulated twin", "ms"),
    "twin.tool_rms": number("Distance of the tool from its twin's", "mm"),
    "twin.tool_peak": number("Largest distance of the tool from its twin's", "mm"),
    "link.line_noise": setting("Share of garbled bytes on an emulated cable", "%"),
    "link.line_loss": setting("Share of lost bytes on an emulated cable", "%"),
    "link.line_delay": setting("Of an emulated cable, each way", "ms"),
    "link.unplugged": switch("An emulated cable is pulled"),
    "link.estop": switch("The emergency stop of an emulated board is pressed"),
    "link.stuck_joint": setting("Joint of an emulated board that something holds, from 1; 0 for none"),
    "report.exported": switch("Whether the student's own report was saved; set it false to begin anew"),
}

LINK_PRESSES = {
    "connect": "Connect the emulated board of the robot on the page, if no board is connected.",
    "disconnect": "Disconnect the board.",
    "request": "Request control of the robot.",
    "hand_over": "Give control of the robot up.",
    "enable": "Enable: the motors get power.",
    "home_robot": "Home the robot on the table.",
    "jog": "Move the tool of the robot on the table 5 mm up.",
    "stop": "Stop.",
    "clear": "Clear after a stop or fault.",
    "continue": "Continue after a hold or a pause.",
    "power_off": "Switch the motors off.",
    "run_drawing": "Let the robot on the table draw the drawing, to its end.",
    "run_run": "Let the robot on the table follow the run of the control lab, to its end.",
    "record": "Begin a recording.",
    "stop_recording": "End the recording.",
    "twin": "Compare the newest recording with the simulated twin.",
    "heal": "Take every fault from the emulated board.",
    "show_robot": "Show the robot on the table on the page.",
    "export": "Save the student's own report.",
}
