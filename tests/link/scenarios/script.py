"""The language of scenarios: one line, one thing that happens or one thing that must be so."""

from __future__ import annotations

import os
import random
import re
import signal
import subprocess
import sys
from collections.abc import Callable
from typing import TypeAlias

from app.link.programs import Jog
from app.link.protocol.codes import Command, Fault, Flag, State, TargetKind
from app.link.protocol.frames import encode_frame
from app.link.protocol.messages import Order, Set, Setpoint, pack
from tests.link.scenarios.world import World
from tests.support.imports import ROOT

Line: TypeAlias = Callable[..., None]

SOON_S = 3.0
STILL_S = 0.15
OTHER_HOST_S = 15.0
HOMING_S = 8.0
ATTEMPTS = 3
LINES: list[tuple[re.Pattern[str], Line]] = []


def line(pattern: str) -> Callable[[Line], Line]:
    """What a line like this does."""

    def learn(what: Line) -> Line:
        LINES.append((re.compile(pattern), what))
        return what

    return learn


def play(world: World, script: str) -> None:
    """All lines in their order; the first that is not so ends the play with its text."""
    for text in filter(None, (row.strip() for row in script.splitlines())):
        play_line(world, text)


def play_line(world: World, text: str) -> None:
    sentence, _, refused = text.partition(" -> refused ")
    world.refusal = ""
    for pattern, what in LINES:
        if found := pattern.fullmatch(sentence):
            what(world, *found.groups())
            break
    else:
        raise ValueError(f"no line of the language: {sentence}")
    if refused:
        assert refused.strip('"') in world.refusal, f"{text}: but {world.refusal or 'it was done'}"
    else:
        assert not world.refusal, f"{text}: refused, {world.refusal}"


@line(r"connect(?: expecting (\w+))?")
def connect(world: World, robot: str | None) -> None:
    world.ask(lambda: world.link.connect(world.cable.port, robot))
    world.until(lambda: world.status.phase in ("ready", "refused", "none"), 6.0)
    if world.status.phase != "ready":
        world.refusal = world.status.sentence


@line(r"disconnect")
def disconnect(world: World) -> None:
    world.ask(world.link.disconnect)


@line(r"(\w+) (requests|releases|stops|powers off|clears|enables|resumes|pauses|cancels|ends the mirror)")
def person_does(world: World, name: str, verb: str) -> None:
    link = world.link
    deeds = {
        "requests": link.request,
        "releases": link.release,
        "stops": link.stop,
        "powers off": link.power_off,
        "clears": link.clear,
        "enables": link.enable,
        "resumes": link.resume,
        "pauses": link.pause,
        "cancels": link.cancel,
        "ends the mirror": link.mirror_end,
    }
    world.ask(lambda: deeds[verb](world.person(name)))


@line(r"(\w+) homes")
def home(world: World, name: str) -> None:
    """A live board holds when this computer is busy for 0.1 s; then it is told again."""
    person = world.person(name)
    for _ in range(ATTEMPTS if world.board.live else 1):
        world.ask(lambda: world.link.home(person))
        if world.refusal:
            return
        world.until(lambda: _state(world) in (State.HELD, State.FAULT) or _came_home(world), HOMING_S)
        if _came_home(world):
            return
        if _state(world) == State.HELD:
            world.ask(lambda: world.link.resume(person))
    raise AssertionError(f"homing ends in {_state(world)!r}: {world.status.sentence}")


@line(r"(\w+) starts homing")
def start_homing(world: World, name: str) -> None:
    world.ask(lambda: world.link.home(world.person(name)))


@line(r"instructor (\w+) takes over")
def take_over(world: World, name: str) -> None:
    world.ask(lambda: world.link.take_over(world.person(name, instructor=True)))


@line(r"(\w+) takes over")
def take_over_without_right(world: World, name: str) -> None:
    world.ask(lambda: world.link.take_over(world.person(name)))


@line(r"(\w+) is ready")
def make_ready(world: World, name: str) -> None:
    """Connected, in control, switched on and homed."""
    for deed in ("connect", f"{name} requests", f"{name} enables", f"{name} homes"):
        play_line(world, deed)


@line(r"(\w+) holds joint (\d) (up|down) at ([\d.]+) (?:deg|mm)/s")
def hold(world: World, name: str, joint: str, way: str, speed: str) -> None:
    jog = Jog("joint", int(joint) - 1, 1 if way == "down" else -1, float(speed) * world.per_unit)
    world.hold(world.person(name), jog)


@line(r"(\w+) lets go")
def let_go(world: World, name: str) -> None:
    world.let_go()
    world.ask(lambda: world.link.jog_release(world.person(name)))


@line(r"(\w+)'s browser hangs")
def browser_hangs(world: World, _name: str) -> None:
    world.let_go()


@line(r"(\w+) steps joint (\d) by (-?[\d.]+) (?:deg|mm)")
def step_joint(world: World, name: str, joint: str, size: str) -> None:
    by = float(size) * world.per_unit
    jog = Jog("joint", int(joint) - 1, 1 if by > 0 else -1, 20.0 * world.per_unit)
    world.ask(lambda: world.link.step(world.person(name), jog, abs(by)))


@line(r"(\w+) steps (x|y|z) by (-?[\d.]+) mm")
def step_axis(world: World, name: str, axis: str, size: str) -> None:
    by = 1e-3 * float(size)
    jog = Jog("pose", "xyz".index(axis), 1 if by > 0 else -1, 0.05)
    world.ask(lambda: world.link.step(world.person(name), jog, abs(by)))


@line(r"(\w+) mirrors (-?[\d.]+) (-?[\d.]+) (-?[\d.]+) mm")
def mirror(world: World, name: str, x: str, y: str, z: str) -> None:
    robot = world.status.robot
    assert robot is not None
    pose = (1e-3 * float(x), 1e-3 * float(y), 1e-3 * float(z), *robot.home[3:].tolist())
    world.ask(lambda: world.link.mirror(world.person(name), pose))


@line(r"(\w+) runs a wave of (-?[\d.]+) (?:deg|mm) in ([\d.]+) s( with the laser)?")
def run_wave(world: World, name: str, amplitude: str, duration: str, laser: str | None) -> None:
    program = world.wave(float(amplitude) * world.per_unit, float(duration), 0.5 if laser else 0.0)
    world.ask(lambda: world.link.run(world.person(name), program))


@line(r"(\w+) sets the speed to (\d+) %")
def override(world: World, name: str, share: str) -> None:
    world.ask(lambda: world.link.set_override(world.person(name), float(share) / 100))


@line(r"(\w+) sets (\d+) to (-?[\d.]+)( and saves)?")
def apply_setting(world: World, name: str, number: str, value: str, save: str | None) -> None:
    world.ask(lambda: world.link.apply_settings(world.person(name), {int(number): float(value)}, save=bool(save)))


@line(r"setting (\d+) is (-?[\d.]+)")
def setting_is(world: World, number: str, value: str) -> None:
    def read() -> bool:
        return abs(world.status.settings.get(int(number), 1e9) - float(value)) < 1e-3

    world.until(read, SOON_S)
    assert read(), f"it is {world.status.settings.get(int(number))}"


@line(r"wait ([\d.]+) s")
def wait(world: World, seconds: str) -> None:
    world.pass_time(float(seconds))


@line(r"(pull|plug in) the cable")
def move_cable(world: World, what: str) -> None:
    world.cable.pull() if what == "pull" else world.cable.plug_in()


@line(r"garble (\d+) % of the bytes")
def garble(world: World, percent: str) -> None:
    world.disturb(noise=float(percent) / 100)


@line(r"lose (\d+) % of the bytes")
def lose(world: World, percent: str) -> None:
    world.disturb(loss=float(percent) / 100)


@line(r"delay by (\d+) ms")
def delay(world: World, ms: str) -> None:
    world.disturb(delay_s=1e-3 * float(ms))


@line(r"(\d+) random bytes reach the board")
def random_bytes(world: World, count: str) -> None:
    world.cable.inject(random.Random(int(count)).randbytes(int(count)))


@line(r"a set-point, cut at every byte, reaches the board")
def cut_frames(world: World) -> None:
    q = world.board.joints()
    frame = encode_frame(pack(Setpoint(TargetKind.JOINTS, tuple(value + 0.2 for value in q), manual=True), 1))
    for length in range(len(frame) - 1):
        world.cable.inject(frame[:length])


@line(r"somebody orders (\w+) past the host")
def order_past_host(world: World, command: str) -> None:
    world.cable.inject(encode_frame(pack(Order(Command[command]), 7)))


@line(r"somebody sets (\d+) to (-?[\d.]+) past the host")
def set_past_host(world: World, number: str, value: str) -> None:
    world.cable.inject(encode_frame(pack(Set(int(number), float(value)), 7)))
    world.pass_time(0.1)


@line(r"set-points (-?[\d.]+) (?:deg|mm) away reach the board for ([\d.]+) s")
def setpoints_past_host(world: World, away: str, seconds: str) -> None:
    """As of a host that heeds no limit, at 100 Hz."""
    start = world.status.telemetry
    assert start is not None
    target = tuple(value + float(away) * world.per_unit for value in start.setpoint)
    for number in range(int(100 * float(seconds))):
        world.cable.inject(encode_frame(pack(Setpoint(TargetKind.JOINTS, target, manual=True), number)))
        world.pass_time(0.01)


@line(r"press the reset button")
def reset(world: World) -> None:
    world.board.reset()


@line(r"the processor hangs")
def hang(world: World) -> None:
    world.board.hang()


@line(r"(press|release) the emergency stop")
def emergency(world: World, what: str) -> None:
    world.board.estop(what == "press")


@line(r"joint (\d) jams")
def jam(world: World, joint: str) -> None:
    world.board.jam(int(joint) - 1)


@line(r"the sensor of joint (\d) breaks")
def break_sensor(world: World, joint: str) -> None:
    world.board.break_sensor(int(joint) - 1)


@line(r"the switch of joint (\d) closes")
def close_switch(world: World, joint: str) -> None:
    world.board.close_switch(int(joint) - 1)


@line(r"another host moves the robot and is killed")
def kill_a_host(world: World) -> None:
    """A process of its own, with SIGKILL, so that nothing of it can say goodbye."""
    command = [sys.executable, "-m", "tests.link.scenarios.another_host", world.cable.port]
    host = subprocess.Popen(command, stdout=subprocess.PIPE, cwd=ROOT)
    try:
        output = host.stdout
        assert output is not None
        os.set_blocking(output.fileno(), False)
        assert world.until(lambda: output.read() == b"moving\n", OTHER_HOST_S), "the other host does not move"
    finally:
        os.kill(host.pid, signal.SIGKILL)
        host.communicate()


@line(r"the host is slow for ([\d.]+) s")
def slow_host(world: World, seconds: str) -> None:
    """Nothing leaves it for so long, then everything at once, as from a computer that swaps."""
    world.cable.frozen = True
    world.pass_time(float(seconds))
    world.cable.frozen = False


@line(r"state (\w+)(?: within ([\d.]+) s)?")
def state_is(world: World, name: str, within: str | None) -> None:
    limit = float(within) if within else SOON_S
    assert world.until(lambda: _state(world) == State[name], limit), f"state is {_state(world)!r}"


@line(r"fault (\w+)")
def fault_is(world: World, name: str) -> None:
    def seen() -> bool:
        telemetry = world.status.telemetry
        return telemetry is not None and (telemetry.state, telemetry.fault) == (State.FAULT, Fault[name])

    assert world.until(seen, SOON_S), f"{world.status.telemetry}"


@line(r"(none|connecting|ready|lost|refused) within ([\d.]+) s")
def phase_is(world: World, phase: str, within: str) -> None:
    assert world.until(lambda: world.status.phase == phase, float(within)), f"phase is {world.status.phase}"


@line(r"the screen says \"(.*)\"")
def says(world: World, words: str) -> None:
    assert world.until(lambda: words in world.status.sentence, SOON_S), f"it says: {world.status.sentence}"


@line(r"the log says \"(.*)\"")
def log_says(world: World, words: str) -> None:
    def logged() -> bool:
        return any(words in entry.sentence for entry in world.status.log)

    assert world.until(logged, SOON_S), [entry.sentence for entry in world.status.log]


@line(r"(nobody|\w+) holds the robot(?:, (\w+) waits)?")
def holder_is(world: World, name: str, waits: str | None) -> None:
    wanted = None if name == "nobody" else name
    queue = [waits] if waits else []

    def so() -> bool:
        holder = world.status.holder
        return (holder and holder.name) == wanted and [person.name for person in world.status.queue] == queue

    assert world.until(so, SOON_S), f"{world.status.holder}, {world.status.queue}"


@line(r"the joints stand still(?: after ([\d.]+) s)?")
def still(world: World, after: str | None) -> None:
    """Within 0.4 deg or mm: a potentiometer's step, or what rest is left of a swing."""
    world.pass_time(float(after or 0.25) + STILL_S)
    assert world.travel(STILL_S) < 0.4 * world.per_unit, f"they move {world.travel(STILL_S) / world.per_unit:.2f}"


@line(r"the joints move")
def moving(world: World) -> None:
    assert world.until(lambda: world.travel(STILL_S) > 1.0 * world.per_unit, SOON_S)


@line(r"the robot arrives")
def arrives(world: World) -> None:
    def there() -> bool:
        return world.status.activity == "idle" and _state(world) == State.READY

    assert world.until(there, SOON_S), f"{world.status.activity}, {_state(world)!r}"


@line(r"joint (\d) moved by (-?[\d.]+) (?:deg|mm) from home")
def moved_from_home(world: World, joint: str, by: str) -> None:
    robot = world.status.robot
    assert robot is not None
    goal = float(robot.inverse(robot.home)[int(joint) - 1]) + float(by) * world.per_unit

    def there() -> bool:
        return abs(world.board.joints()[int(joint) - 1] - goal) < 1.5 * world.per_unit

    assert world.until(there, SOON_S), f"off by {(world.board.joints()[int(joint) - 1] - goal) / world.per_unit:.2f}"


@line(r"no joint was faster than (\d+) (?:deg|mm)/s")
def speed_limit(world: World, limit: str) -> None:
    assert world.top_speed() < float(limit) * world.per_unit, f"{world.top_speed() / world.per_unit:.0f}"


@line(r"the motors are (on|off)")
def motors(world: World, what: str) -> None:
    assert world.until(lambda: world.board.powered() == (what == "on"), SOON_S), f"they are not {what}"


@line(r"the laser is (on|off)")
def laser(world: World, what: str) -> None:
    assert world.until(lambda: (world.board.laser() > 0.0) == (what == "on"), SOON_S), f"it is not {what}"


@line(r"the robot is (not )?homed")
def homed(world: World, no: str | None) -> None:
    assert world.until(lambda: _homed(world) != bool(no), SOON_S)


@line(r"the program has ended")
def program_ended(world: World) -> None:
    assert world.until(lambda: world.status.activity == "idle", 12.0), world.status.activity


@line(r"the program is (run|paused|idle)")
def activity_is(world: World, what: str) -> None:
    assert world.until(lambda: world.status.activity == what, SOON_S), world.status.activity


@line(r"bad frames were counted")
def bad_frames(world: World) -> None:
    def counted() -> bool:
        return world.status.telemetry is not None and world.status.telemetry.bad > 0

    assert world.until(counted, SOON_S)


def _state(world: World) -> State | None:
    return None if world.status.telemetry is None else State(world.status.telemetry.state)


def _homed(world: World) -> bool:
    telemetry = world.status.telemetry
    return telemetry is not None and bool(telemetry.flags & Flag.HOMED)


def _came_home(world: World) -> bool:
    return _homed(world) and _state(world) == State.READY
